#include "report_data.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include <zlib.h>

namespace epicyclic::app {

namespace {

constexpr std::size_t alignment = 8;

void append_little_endian(std::string& bytes, std::uint64_t value, int count) {
  for (int k = 0; k < count; ++k) bytes += static_cast<char>((value >> (8 * k)) & 0xffU);
}

}  // namespace

std::string base64(std::string_view bytes) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[three >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

bool are_counts(std::span<const double> values) {
  constexpr double most = std::numeric_limits<std::uint32_t>::max();
  return std::ranges::all_of(values, [](double x) { return x >= 0.0 && x <= most && x == std::floor(x); });
}

nlohmann::json ReportData::described(const ReportColumn& column, const char* form) {
  body_.resize((body_.size() + alignment - 1) / alignment * alignment, '\0');
  return {
      {"name", column.name}, {"unit", column.unit}, {"meaning", column.meaning}, {"form", form}, {"at", body_.size()}};
}

nlohmann::json ReportData::numbers(const ReportColumn& column, std::span<const double> values, Form form) {
  if (form == Form::uint32) {
    nlohmann::json json = described(column, "uint32");
    for (const double x : values) append_little_endian(body_, static_cast<std::uint32_t>(x), 4);
    return json;
  }
  if (form == Form::float64) {
    nlohmann::json json = described(column, "float64");
    for (int k = 0; k < 8; ++k)  // byte k of all numbers stands together, which deflates better
      for (const double x : values) append_little_endian(body_, std::bit_cast<std::uint64_t>(x) >> (8 * k), 1);
    return json;
  }
  nlohmann::json json = described(column, "quantised");
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double x : values)
    if (std::isfinite(x)) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
  if (!(low <= high)) low = high = 0.0;
  constexpr double levels = 65534;
  constexpr std::uint16_t missing = 65535;
  const double step = high / levels - low / levels;  // finite of any two numbers
  json["low"] = low;
  json["step"] = step;
  for (const double x : values) {
    const double level = step > 0.0 ? std::round((x - low) / step) : 0.0;
    append_little_endian(body_, std::isfinite(x) ? static_cast<std::uint16_t>(std::clamp(level, 0.0, levels)) : missing,
                         2);
  }
  return json;
}

nlohmann::json ReportData::words(const ReportColumn& column, std::span<const std::string> values) {
  std::map<std::string_view, std::size_t> places;
  nlohmann::json distinct = nlohmann::json::array();
  std::vector<std::size_t> of;
  of.reserve(values.size());
  for (const std::string& word : values) {
    const auto [found, is_new] = places.emplace(word, places.size());
    if (is_new) distinct.push_back(word);
    of.push_back(found->second);
  }
  if (places.size() > std::numeric_limits<std::uint16_t>::max()) return nullptr;
  nlohmann::json json = described(column, "words");
  json["words"] = std::move(distinct);
  for (const std::size_t place : of) append_little_endian(body_, place, 2);
  return json;
}

std::string ReportData::encoded(const nlohmann::json& header) const {
  const std::string text = header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string bytes;
  append_little_endian(bytes, text.size(), 4);
  bytes += text;
  bytes.resize((bytes.size() + alignment - 1) / alignment * alignment, '\0');
  bytes += body_;
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string deflated(size, '\0');
  const auto* from = reinterpret_cast<const Bytef*>(bytes.data());
  auto* to = reinterpret_cast<Bytef*>(deflated.data());
  if (const int code = compress2(to, &size, from, static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION); code != Z_OK)
    throw std::runtime_error("compress2 of zlib returned " + std::to_string(code));
  deflated.resize(size);
  return base64(deflated);
}

}  // namespace epicyclic::app
