#include "core/csv.hpp"

#include <bit>
#include <charconv>
#include <clocale>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::csv_test {
namespace {

using test::contents;
using test::TemporaryFolder;

std::string number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

TEST(Csv, WritesHeaderAndRows) {
  CsvWriter table({"point", "value", "status", "stable"});
  table.row(0, 0.1, "ok", true);
  table.row(std::size_t{18446744073709551615U}, -2.5e-300, std::string("failed"), false);
  table.row(std::int64_t{-7}, 0.25F, std::string_view(), 1);
  EXPECT_EQ(table.text(),
            "point,value,status,stable\n"
            "0,0.1,ok,1\n"
            "18446744073709551615,-2.5e-300,failed,0\n"
            "-7,0.25,,1\n");
}

TEST(Csv, NumbersReadBackAsTheSameBits) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const auto value = std::bit_cast<double>(random());
    if (value != value) continue;
    const std::string text = number(value);
    double back = 0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value)) << text;
  }
}

TEST(Csv, NumbersAreShort) {
  EXPECT_EQ(number(0.1), "0.1");
  EXPECT_EQ(number(1.0 / 3.0), "0.3333333333333333");
  EXPECT_EQ(number(5e-324), "5e-324");
  EXPECT_EQ(number(-0.0), "-0");
}

TEST(Csv, NanIsAnEmptyCellAndInfinityAWord) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CsvWriter table({"a", "b", "c", "d"});
  table.row(std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(table.text(), "a,b,c,d\n,inf,-inf,\n");
}

TEST(Csv, QuotesOnlyWhatMustBeQuoted) {
  CsvWriter table({"plain name", "with, comma"});
  table.row("drive+loss", "say \"no\"");
  table.row("two\nlines", "semi;colon");
  EXPECT_EQ(table.text(),
            "plain name,\"with, comma\"\n"
            "drive+loss,\"say \"\"no\"\"\"\n"
            "\"two\nlines\",semi;colon\n");
}

TEST(Csv, SingleEmptyCellIsNoBlankLine) {
  CsvWriter table({"a"});
  table.row(std::numeric_limits<double>::quiet_NaN());
  table.row(1);
  EXPECT_EQ(table.text(), "a\n\"\"\n1\n");
}

TEST(Csv, DoesNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  bool changed = false;
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", ""})
    changed = changed || std::setlocale(LC_ALL, name);
  CsvWriter table({"a", "b"});
  table.row(1234567.5, 1234567);
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_EQ(table.text(), "a,b\n1234567.5,1234567\n");
}

TEST(Csv, FileHoldsTheSameBytesAsMemoryAcrossBlocks) {
  const TemporaryFolder folder;
  const std::vector<std::string> columns{"i", "x"};
  CsvWriter memory(columns);
  CsvWriter file(folder / "t.csv", columns);
  // Some 3 MB: more than two of the blocks in which the file is written.
  for (int i = 0; i < 120000; ++i) {
    memory.row(i, 1.0 / (i + 1));
    file.cell(i).cell(1.0 / (i + 1)).end_row();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "t.csv"));
  file.commit();
  EXPECT_EQ(contents(folder / "t.csv"), memory.text());
}

TEST(Csv, FullDiskLeavesNoFile) {
  const TemporaryFolder folder;
  {
    const test::FileSizeLimit limit(100'000);
    EXPECT_THROW(
        {
          CsvWriter file(folder / "t.csv", {"x"});
          for (int i = 0; i < 200000; ++i) file.row(i);
          file.commit();
        },
        OutputError);
  }
  EXPECT_EQ(test::entries(folder.path()), 0U);
}

TEST(Csv, RowOfTheWrongWidthIsALogicError) {
  CsvWriter table({"a", "b"});
  EXPECT_THROW(table.row(1), std::logic_error);
  CsvWriter other({"a", "b"});
  EXPECT_THROW(other.row(1, 2, 3), std::logic_error);
}

TEST(Csv, IsReadAsItWasWritten) {
  CsvWriter table({"a", "with, a comma", "c"});
  table.row(1.5, "plain", 3);
  table.row(std::numeric_limits<double>::quiet_NaN(), "a \"quote\", and\nlines", -1);
  const auto read = parse_csv(table.text());
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->columns, (std::vector<std::string>{"a", "with, a comma", "c"}));
  ASSERT_EQ(read->rows.size(), 2U);
  EXPECT_EQ(read->rows[0], (std::vector<std::string>{"1.5", "plain", "3"}));
  EXPECT_EQ(read->rows[1], (std::vector<std::string>{"", "a \"quote\", and\nlines", "-1"}));
  EXPECT_EQ(read->index_of("c"), 2U);
  EXPECT_EQ(read->index_of("d"), 3U);
}

TEST(Csv, WhatIsNoTableIsNotRead) {
  for (const char* text : {"", "a,b", "a,b\n1\n", "a,b\n1,2,3\n", "a,b\n1,2", "a\n\"open\n"})
    EXPECT_FALSE(parse_csv(text).has_value()) << text;
}

}  // namespace
}  // namespace epicyclic::csv_test
