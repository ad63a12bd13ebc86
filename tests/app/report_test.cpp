#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "report/report_data.hpp"
#include "report/report_page.hpp"

namespace epicyclic::app {
namespace report_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t buffer = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    buffer = buffer << 6 | static_cast<std::uint32_t>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(buffer >> bits & 0xffU);
  }
  return bytes;
}

/// A payload as a page reads it.
struct Read {
  explicit Read(const std::string& encoded) {
    const std::string deflated = decoded(encoded);
    std::string bytes(1 << 22, '\0');
    uLongf size = static_cast<uLongf>(bytes.size());
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(deflated.data()),
                         static_cast<uLong>(deflated.size())),
              Z_OK);
    bytes.resize(size);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data(), 4);
    header = nlohmann::json::parse(bytes.substr(4, length));
    body = bytes.substr((4 + length + 7) / 8 * 8);
  }

  template <class Number>
  [[nodiscard]] Number at(const nlohmann::json& column, std::size_t row) const {
    Number number{};
    std::memcpy(&number, body.data() + column["at"].get<std::size_t>() + row * sizeof(Number), sizeof(Number));
    return number;
  }

  [[nodiscard]] double number(const nlohmann::json& column, std::size_t row, std::size_t rows) const {
    const auto* bytes = reinterpret_cast<const unsigned char*>(body.data()) + column["at"].get<std::size_t>();
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < 8; ++k) bits |= std::uint64_t{bytes[k * rows + row]} << (8 * k);
    return std::bit_cast<double>(bits);
  }

  nlohmann::json header;
  std::string body;
};

// RFC 4648, section 10.
TEST(ReportData, EncodesAsTheStandardSays) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe"), "//4=");
}

TEST(ReportData, KeepsColumnsInTheirForms) {
  const std::vector<double> exact = {0.1, -3e300, nan, 5e-324, -0.0};
  const std::vector<double> rough = {1.0, nan, 2.0, 1.25, std::numeric_limits<double>::infinity()};
  const std::vector<double> counts = {0, 1, 4294967295.0, 7, 7};
  const std::vector<std::string> words = {"up", "", "up", "ü<b>", "down"};
  ReportData data;
  ReportTable table("points.csv", "points", exact.size());
  table.add(data.numbers({"exact", "b_c", "to the last bit"}, exact, ReportData::Form::float64));
  table.add(data.numbers({"rough", "1", ""}, rough, ReportData::Form::quantised));
  table.add(data.numbers({"count", "1", ""}, counts, ReportData::Form::uint32));
  table.add(data.words({"word", "", ""}, words));
  table.leave_out("another");
  const Read read(data.encoded({{"tables", {table.to_json()}}}));
  const nlohmann::json& columns = read.header["tables"][0]["columns"];
  ASSERT_EQ(columns.size(), 4U);
  EXPECT_EQ(read.header["tables"][0]["left_out"], nlohmann::json::array({"another"}));
  EXPECT_EQ(columns[0]["unit"], "b_c");
  EXPECT_EQ(columns[0]["meaning"], "to the last bit");
  for (std::size_t row = 0; row < exact.size(); ++row) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read.number(columns[0], row, exact.size())),
              std::bit_cast<std::uint64_t>(exact[row]));
    const std::uint16_t level = read.at<std::uint16_t>(columns[1], row);
    const double value = columns[1]["low"].get<double>() + columns[1]["step"].get<double>() * level;
    if (std::isfinite(rough[row]))
      EXPECT_NEAR(value, rough[row], 0.5 / 65534 * (1 + 1e-9));
    else
      EXPECT_EQ(level, 65535);
    EXPECT_EQ(read.at<std::uint32_t>(columns[2], row), static_cast<std::uint32_t>(counts[row]));
    EXPECT_EQ(columns[3]["words"][read.at<std::uint16_t>(columns[3], row)], words[row]);
  }
  for (const auto& column : columns) EXPECT_EQ(column["at"].get<std::size_t>() % 8, 0U);
}

TEST(ReportData, QuantisesRangesOfAnyKind) {
  constexpr double most = std::numeric_limits<double>::max();
  for (const std::vector<double>& values :
       {std::vector<double>{}, {nan, nan}, {3.0, 3.0}, {-most / 4, most / 4}, {0.0, 1e-300}, {-1e-300, 1e300}}) {
    ReportData data;
    const nlohmann::json column = data.numbers({"x", "1", ""}, values, ReportData::Form::quantised);
    const Read read(data.encoded({{"column", column}}));
    const double step = column["step"].get<double>();
    EXPECT_TRUE(std::isfinite(step));
    for (std::size_t row = 0; row < values.size(); ++row) {
      const std::uint16_t level = read.at<std::uint16_t>(column, row);
      if (std::isnan(values[row])) {
        EXPECT_EQ(level, 65535);
        continue;
      }
      // The rounding of the sum comes on top of half a step.
      EXPECT_NEAR(column["low"].get<double>() + step * level, values[row], 0.51 * step + 1e-15 * std::abs(values[row]));
    }
  }
}

TEST(ReportData, RefusesMoreWordsThanIndices) {
  std::vector<std::string> words;
  for (int k = 0; k < 65535; ++k) words.push_back(std::to_string(k));
  ReportData data;
  EXPECT_FALSE(data.words({"w", "", ""}, words).is_null());
  const std::size_t size = data.size();
  words.emplace_back("one more");
  EXPECT_TRUE(data.words({"w", "", ""}, words).is_null());
  EXPECT_EQ(data.size(), size);
}

TEST(ReportData, KnowsCounts) {
  EXPECT_TRUE(are_counts(std::vector<double>{0, 1, 4294967295.0}));
  EXPECT_FALSE(are_counts(std::vector<double>{0, nan}));
  EXPECT_FALSE(are_counts(std::vector<double>{0.5}));
  EXPECT_FALSE(are_counts(std::vector<double>{-1}));
  EXPECT_FALSE(are_counts(std::vector<double>{4294967296.0}));
}

TEST(ReportData, TakesTextThatIsNotUnicode) {
  ReportData data;
  const Read read(data.encoded({{"title",
                                 "a\xff"
                                 "b"}}));
  EXPECT_EQ(read.header["title"],
            "a\xef\xbf\xbd"
            "b");
}

// What a page says of itself: sha256 of what stands between the tags [openssl dgst -sha256 -binary | base64].
TEST(ReportPage, AllowsItsOwnScriptsAlone) {
  const std::string page = report_page("a", "1.2.3", "AAAA");
  EXPECT_NE(page.find("default-src 'none'; script-src 'sha256-"), std::string::npos);
  EXPECT_NE(page.find("style-src 'sha256-"), std::string::npos);
  EXPECT_EQ(page.find("unsafe"), std::string::npos);
  std::size_t hashes = 0;
  for (std::size_t at = page.find("'sha256-"); at != std::string::npos; at = page.find("'sha256-", at + 1)) ++hashes;
  EXPECT_EQ(hashes, 3U);
  EXPECT_NE(page.find("<script type=\"application/octet-stream\" id=\"data\">AAAA</script>"), std::string::npos);
  EXPECT_NE(page.find("Written by epicyclic 1.2.3."), std::string::npos);
}

// The parser of HTML ends a script at the first of these, whatever stands around it.
TEST(ReportPage, HasNoEndOfAScriptWithinOne) {
  for (const std::string_view text : {browser::plot, browser::program}) {
    EXPECT_EQ(text.find("</script"), std::string_view::npos);
    EXPECT_EQ(text.find("<!--"), std::string_view::npos);
  }
  EXPECT_EQ(browser::style.find("</style"), std::string_view::npos);
  EXPECT_EQ(browser::program.find("\nimport "), std::string_view::npos);
  EXPECT_EQ(browser::program.find("\nexport "), std::string_view::npos);
  EXPECT_NE(browser::plot.find("Permission is hereby granted"), std::string_view::npos);
}

TEST(ReportPage, TakesAnyTitleAsText) {
  const std::string page = report_page("<img src=x onerror=\"1\">&@DATA@</title>\n", "1", "AAAA");
  EXPECT_NE(page.find("<title>&lt;img src=x onerror=&quot;1&quot;&gt;&amp;@DATA@&lt;/title&gt; </title>"),
            std::string::npos);
  EXPECT_EQ(page.find("<img"), std::string::npos);
}

}  // namespace
}  // namespace report_test
}  // namespace epicyclic::app
