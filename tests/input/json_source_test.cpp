#include "input/json_source.hpp"

#include <random>

#include <gtest/gtest.h>

#include "temporary_folder.hpp"

namespace epicyclic::input::json_source_test {
namespace {

using nlohmann::json;

std::string all_text(const JsonSource& source) {
  std::string text;
  for (const auto& problem : source.problems) text += problem.text() + "\n";
  return text;
}

const std::string good = R"({
  "first": 1.5,
  "nested": {
    "list": [
      10,
      -2.5e-3
    ],
    "last": 7
  },
  "a/b": true, "tilde~": "text",
  "null": null
}
)";

TEST(JsonSource, ReadsWhatTheLibraryReads) {
  const auto source = parse_json(good, "good.json");
  EXPECT_TRUE(source.complete);
  EXPECT_EQ(all_text(source), "");
  EXPECT_EQ(source.value, json::parse(good));
  EXPECT_EQ(source.bytes, good);
}

TEST(JsonSource, KnowsTheLineOfEveryKeyAndElement) {
  const auto source = parse_json(good, "good.json");
  const std::map<std::string, int, std::less<>> expected = {{"", 1},
                                                            {"/first", 2},
                                                            {"/nested", 3},
                                                            {"/nested/list", 4},
                                                            {"/nested/list/0", 5},
                                                            {"/nested/list/1", 6},
                                                            {"/nested/last", 8},
                                                            {"/a~1b", 10},
                                                            {"/tilde~0", 10},
                                                            {"/null", 11}};
  EXPECT_EQ(source.line, expected);
  EXPECT_EQ(source.line_of("/nested/missing/deeper"), 3);
  EXPECT_EQ(source.line_of("/missing"), 1);
}

TEST(JsonSource, KnowsTheLineOfANumberWhateverFollowsIt) {
  for (const std::string after : {"\n]", "]", " ]", "\n\n\n]", "\r\n]", ",\n2]", "\n,2]"}) {
    const auto source = parse_json("[\n\n12.5" + after, "x");
    EXPECT_TRUE(source.complete) << after;
    EXPECT_EQ(source.line_of("/0"), 3) << after;
  }
  EXPECT_EQ(parse_json("\n\n3", "x").line_of(""), 3);
}

TEST(JsonSource, TellsEveryProblemOfAText) {
  const auto source = parse_json(R"({
  "a": NaN,
  "b": 1e999, // no
  "c": 12345678901234567890123,
  "d": [1, 2,],
  "e": 1, "e": 2,
  "f": 9007199254740993,
  "g": -Infinity
})",
                                 "x.json");
  EXPECT_TRUE(source.complete);
  EXPECT_EQ(all_text(source),
            "x.json:2: /a: 'NaN' is not a number in JSON: give a finite number\n"
            "x.json:3: /b: number overflow: 1e999 is beyond what a double holds (about 1.8e308)\n"
            "x.json:3: a comment is not JSON: use a \"note\" key\n"
            "x.json:4: /c: the integer 12345678901234567890123 is beyond 2^53 = 9007199254740992 and not exact in a "
            "double\n"
            "x.json:5: /d: a comma before ']' is not JSON\n"
            "x.json:6: /e: duplicate key 'e': it stands on line 6 already\n"
            "x.json:7: /f: the integer 9007199254740993 is beyond 2^53 = 9007199254740992 and not exact in a double\n"
            "x.json:8: /g: '-Infinity' is not a number in JSON: give a finite number\n");
  EXPECT_EQ(source.unreadable, (std::set<std::string, std::less<>>{"/a", "/b", "/c", "/f", "/g"}));
}

TEST(JsonSource, TellsWhichElementIsNotANumber) {
  const auto pointer = [](const std::string& text) {
    const auto source = parse_json(text, "x");
    EXPECT_TRUE(source.complete) << text;
    EXPECT_EQ(source.problems.size(), 1U) << all_text(source);
    EXPECT_EQ(source.unreadable.size(), 1U) << text;
    return source.unreadable.empty() ? "none" : *source.unreadable.begin();
  };
  // Its beginning is a number, which is read before what makes it none.
  EXPECT_EQ(pointer("[7, 1e-1jjjj3, 8]"), "/1");
  EXPECT_EQ(pointer("[7, 3 mm, 8]"), "/1");
  EXPECT_EQ(pointer("[7, 3mm, 8]"), "/1");
  EXPECT_EQ(pointer("[7, nan, 8]"), "/1");
  EXPECT_EQ(pointer("[7, 1e999, 8]"), "/1");
  EXPECT_EQ(pointer("{\"a\": [7], \"b\": 3mm}"), "/b");
}

TEST(JsonSource, TakesIntegersThatADoubleHolds) {
  const auto source = parse_json("[9007199254740992, -9007199254740992, 1e300, 0.0, 0e5, 4.9e-324]", "x");
  EXPECT_EQ(all_text(source), "");
}

TEST(JsonSource, ReportsDuplicateKeysOfOneObjectOnly) {
  EXPECT_EQ(all_text(parse_json(R"({"a": {"k": 1}, "b": {"k": 1}})", "x")), "");
  EXPECT_EQ(all_text(parse_json("{\"a\":\n1,\n\"a\": 2}", "x")),
            "x:3: /a: duplicate key 'a': it stands on line 1 already\n");
  // An escape does not hide a duplicate.
  EXPECT_EQ(parse_json(R"({"a": 1, "\u0061": 2})", "x").problems.size(), 1U);
}

TEST(JsonSource, SaysWhereATextBreaksOff) {
  for (std::size_t length = 1; length + 2 < good.size(); ++length) {
    const auto source = parse_json(good.substr(0, length), "x");
    ASSERT_FALSE(source.complete) << length;
    ASSERT_EQ(source.problems.size(), 1U) << length;
    EXPECT_NE(source.problems[0].message.find("breaks off here"), std::string::npos)
        << length << ": " << source.problems[0].text();
  }
}

TEST(JsonSource, LimitsDepth) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_EQ(all_text(parse_json(nested(json_depth_max), "x")), "");
  EXPECT_NE(all_text(parse_json(nested(json_depth_max + 1), "x")).find("deeper than 32"), std::string::npos);
  EXPECT_NE(all_text(parse_json(nested(1000000), "x")).find("deeper than 32"), std::string::npos);
}

TEST(JsonSource, LimitsSize) {
  const auto source = parse_json("[" + std::string(json_bytes_max, ' ') + "]", "x");
  EXPECT_EQ(all_text(source), "x: the file is larger than 16 MiB\n");
}

TEST(JsonSource, RefusesWhatIsNotUtf8) {
  for (const std::string bad :
       {"\xC0\x80", "\xED\xA0\x80", "\xF5\x80\x80\x80", "\xE2\x82", "\xFF", "\xF0\x8F\xBF\xBF"}) {
    const auto source = parse_json("{\n\"k\": \"" + bad + "\"}", "x");
    EXPECT_FALSE(source.complete);
    EXPECT_NE(all_text(source).find("x:2: byte 0x"), std::string::npos);
  }
  for (const std::string fine : {"\xC2\x80", "\xED\x9F\xBF", "\xF4\x8F\xBF\xBF", "\xE2\x82\xAC"})
    EXPECT_EQ(all_text(parse_json("[\"" + fine + "\"]", "x")), "");
}

// A byte changed anywhere: what JSON does not allow is told, what it allows is read as the library reads it.
TEST(JsonSource, AgreesWithTheLibraryOnWhatIsJson) {
  std::mt19937 random(1);
  constexpr std::string_view alphabet = "{}[]:,\"\\ \n019.-+eEtfnux/#*NaI";
  int accepted = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text = good;
    for (unsigned change = 0; change <= random() % 2; ++change)
      text[random() % text.size()] = alphabet[random() % alphabet.size()];
    const auto source = parse_json(text, "x");
    if (json::accept(text)) {
      ++accepted;
      ASSERT_TRUE(source.complete) << text;
      for (const auto& problem : source.problems)
        ASSERT_TRUE(problem.message.find("duplicate key") == 0 || problem.message.find("the integer") == 0 ||
                    problem.message.find("too small") != std::string::npos)
            << text << problem.text();
      if (source.problems.empty()) {
        ASSERT_EQ(source.value, json::parse(text));
      }
    } else {
      ASSERT_FALSE(source.problems.empty()) << text;
      for (const auto& problem : source.problems) {
        ASSERT_GE(problem.line, 1) << text << problem.text();
        ASSERT_LE(problem.line, 14) << text << problem.text();
      }
    }
  }
  EXPECT_GT(accepted, 1000);
}

TEST(JsonSource, SaysWhyAFileCannotBeRead) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(all_text(read_json_file(folder / "none.json", "none.json")), "none.json: no such file\n");
  EXPECT_EQ(all_text(read_json_file(folder.path(), "folder")), "folder: is a directory, not a JSON file\n");
  EXPECT_EQ(all_text(read_json_file("/dev/null", "null")), "null: is not a regular file\n");
  test::put_file(folder / "empty.json", " \n ");
  EXPECT_EQ(all_text(read_json_file(folder / "empty.json", "empty.json")), "empty.json: the file is empty\n");
  test::put_file(folder / "good.json", good);
  EXPECT_EQ(read_json_file(folder / "good.json").bytes, good);
}

TEST(JsonPointer, TakesStepsApart) {
  EXPECT_EQ(pointer_step("a/b~c"), "/a~1b~0c");
  EXPECT_EQ(pointer_leaf("/x/a~1b~0c"), "a/b~c");
  EXPECT_EQ(pointer_leaf("/x/~01"), "~1");
  EXPECT_EQ(pointer_parent("/x/y"), "/x");
  EXPECT_EQ(pointer_parent("/x"), "");
  EXPECT_TRUE(pointer_within("/x/y", "/x"));
  EXPECT_TRUE(pointer_within("/x", "/x"));
  EXPECT_TRUE(pointer_within("/x", ""));
  EXPECT_FALSE(pointer_within("/xy", "/x"));
}

}  // namespace
}  // namespace epicyclic::input::json_source_test
