#include "store/hdf5_file.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <hdf5.h>

#include "core/errors.hpp"
#include "temporary_folder.hpp"
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace epicyclic::store::hdf5_file_test {
namespace {

/// HDF5 1.10 does not free what it holds of a file whose last flush fails; while this lives, AddressSanitizer does not
/// ask.
#ifdef __SANITIZE_ADDRESS__
using LeaksOfHdf5 = __lsan::ScopedDisabler;
#else
struct LeaksOfHdf5 {};
#endif

using test::contents;
using test::message_of;
using test::TemporaryFolder;

std::vector<double> smooth_values(std::size_t count) {
  std::vector<double> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = std::sin(0.001 * static_cast<double>(i));
  return values;
}

void write_example(const std::filesystem::path& path) {
  Hdf5File file(path);
  file.set_attribute("/", "program", "epicyclic");
  file.set_attribute("/", "points", std::int64_t{661});
  file.set_attribute("/", "tolerance", 1e-8);
  file.write("/axis/value", std::vector<double>{0.2, 0.3, std::numeric_limits<double>::quiet_NaN()});
  file.set_units("/axis/value", "-");
  file.write("/points/period", std::vector<std::int64_t>{1, -2, std::int64_t{1} << 50});
  file.write("/points/regime", std::vector<std::string>{"periodic", "", "Ω̄"});
  file.write("/poincare/delta", smooth_values(3000 * 17), 3000, 17);
  file.set_units("/poincare/delta", "b_c");
  file.write("/poincare/index", std::vector<std::int64_t>{1, 2, 3, 4, 5, 6}, 2, 3);
  file.create_group("/empty/group");
  file.close();
}

TEST(Hdf5File, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const auto path = folder / "results.h5";
  write_example(path);

  const Hdf5Dataset value = read_hdf5(path, "/axis/value");
  EXPECT_EQ(value.shape, std::vector<std::size_t>{3});
  EXPECT_EQ(value.values[1], 0.3);
  EXPECT_TRUE(std::isnan(value.values[2]));
  EXPECT_EQ(read_hdf5(path, "/points/period").values, (std::vector<double>{1, -2, 1125899906842624}));
  EXPECT_EQ(read_hdf5_texts(path, "/points/regime"), (std::vector<std::string>{"periodic", "", "Ω̄"}));
  const Hdf5Dataset delta = read_hdf5(path, "/poincare/delta");
  EXPECT_EQ(delta.shape, (std::vector<std::size_t>{3000, 17}));
  EXPECT_EQ(delta.values, smooth_values(3000 * 17));
  EXPECT_EQ(read_hdf5(path, "/poincare/index").shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(read_hdf5_attribute(path, "/poincare/delta", "units"), "b_c");
  EXPECT_EQ(read_hdf5_attribute(path, "/", "program"), "epicyclic");
  EXPECT_EQ(test::entries(folder.path()), 1U);
}

TEST(Hdf5File, SameDataGiveSameBytes) {
  const TemporaryFolder folder;
  write_example(folder / "a.h5");
  // HDF5's time stamps have a resolution of one second.
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  write_example(folder / "b.h5");
  EXPECT_EQ(contents(folder / "a.h5"), contents(folder / "b.h5"));
}

TEST(Hdf5File, RowByRowGivesTheBytesOfTheWhole) {
  const TemporaryFolder folder;
  for (const std::size_t rows : {0U, 7U, 3000U, 70'001U}) {
    const std::vector<double> values = smooth_values(rows * 5);
    std::vector<std::int64_t> integers;
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < rows; ++i) {
      integers.push_back(static_cast<std::int64_t>(i * i));
      texts.push_back(std::string(i % 9, 'x'));
    }
    Hdf5File whole(folder / "whole.h5");
    whole.write("/a", std::span<const double>(values).first(rows));
    whole.write("/b", integers);
    whole.write("/c", texts);
    whole.write("/d", values, rows, 5);
    whole.close();
    Hdf5File by_row(folder / "by_row.h5");
    by_row.write("/a", rows, Hdf5File::Column<double>([&](std::size_t row) { return values[row]; }));
    by_row.write("/b", rows, Hdf5File::Column<std::int64_t>([&](std::size_t row) { return integers[row]; }));
    by_row.write("/c", rows, Hdf5File::Column<std::string>([&](std::size_t row) { return texts[row]; }));
    std::size_t next = 0;
    by_row.write("/d", rows, 5, [&](std::size_t row, std::span<double> to) {
      EXPECT_EQ(row, next++);
      for (std::size_t j = 0; j < 5; ++j) to[j] = values[5 * row + j];
    });
    by_row.close();
    EXPECT_EQ(contents(folder / "whole.h5"), contents(folder / "by_row.h5")) << rows;
    EXPECT_EQ(read_hdf5(folder / "by_row.h5", "/d").values, values);
    EXPECT_EQ(read_hdf5_texts(folder / "by_row.h5", "/c"), texts);
  }
}

// Whatever the number of blocks.
TEST(Hdf5File, ColumnsThatAreWrittenTogetherAreThoseWrittenAlone) {
  const TemporaryFolder folder;
  const std::vector<std::string> names = {"a", "b", "c"};
  for (const std::size_t rows : {0U, 7U, 9000U, 200'001U}) {
    const auto value = [](std::size_t row, std::size_t column) {
      return std::sin(0.001 * static_cast<double>(row)) + static_cast<double>(column);
    };
    Hdf5File file(folder / "a.h5");
    std::size_t next = 0;
    file.write_columns("/table", names, rows, [&](std::size_t row, std::span<double> to) {
      EXPECT_EQ(row, next++);
      for (std::size_t j = 0; j < to.size(); ++j) to[j] = value(row, j);
    });
    file.close();
    for (std::size_t j = 0; j < names.size(); ++j) {
      const Hdf5Dataset column = read_hdf5(folder / "a.h5", "/table/" + names[j]);
      ASSERT_EQ(column.shape, std::vector<std::size_t>{rows});
      for (std::size_t row = 0; row < rows; ++row) ASSERT_EQ(column.values[row], value(row, j)) << row;
    }
  }
}

TEST(Hdf5File, EachAxisHasAScale) {
  const TemporaryFolder folder;
  const auto path = folder / "a.h5";
  Hdf5File file(path);
  file.write("/points/point", std::vector<std::int64_t>{0, 1});
  file.write("/points/value", std::vector<double>{0.2, 0.3});
  file.name_axes("/points/point", {"point"});
  file.name_axes("/points/value", {"point"});
  file.write("/map/value", std::vector<double>{1, 2, 3});
  file.name_axes("/map/value", {"value"});
  file.write("/map/up/period", std::vector<std::int64_t>{1, 2, 3, 4, 5, 6}, 2, 3);
  file.name_axes("/map/up/period", {"second", "value"});
  file.write("/free/one", std::vector<double>{1, 2});
  file.write("/free/two", std::vector<double>{1, 2, 3});
  EXPECT_THROW(file.name_axes("/free/two", {"a", "b"}), std::logic_error);
  EXPECT_THROW(file.name_axes("/free/none", {"a"}), std::logic_error);
  file.close();
  for (const char* scale : {"/points/point", "/map/value", "/map/up/second", "/free/row", "/free/row_2"}) {
    EXPECT_EQ(read_hdf5_attribute(path, scale, "CLASS"), "DIMENSION_SCALE");
    EXPECT_EQ(read_hdf5_attribute(path, scale, "NAME"), std::string(scale).substr(std::string(scale).rfind('/') + 1));
  }
  EXPECT_EQ(read_hdf5(path, "/map/up/second").values, (std::vector<double>{0, 1}));
  EXPECT_EQ(read_hdf5(path, "/free/row_2").values, (std::vector<double>{0, 1, 2}));
  EXPECT_THROW(read_hdf5_attribute(path, "/points/value", "CLASS"), InputError);
  EXPECT_THROW(read_hdf5(path, "/points/row"), InputError);
}

// For readers that know no attributes.
TEST(Hdf5File, ListsUnitsAndMeanings) {
  const TemporaryFolder folder;
  const auto path = folder / "a.h5";
  Hdf5File file(path);
  file.write("/points/force", std::vector<double>{1});
  file.set_units("/points/force", "N");
  file.set_attribute("/points/force", "meaning", "largest force");
  file.write("/points/word", std::vector<std::string>{"a"});
  file.set_attribute("/points/word", "meaning", "K_γ");
  file.write("/points/none", std::vector<double>{1});
  file.close();
  EXPECT_EQ(read_hdf5_texts(path, "/columns/path"), (std::vector<std::string>{"points/force", "points/word"}));
  EXPECT_EQ(read_hdf5_texts(path, "/columns/units"), (std::vector<std::string>{"N", ""}));
  EXPECT_EQ(read_hdf5_texts(path, "/columns/meaning"), (std::vector<std::string>{"largest force", "K_γ"}));
}

// Octave stops at a dataset of texts that is marked as UTF-8.
TEST(Hdf5File, TextsAreMarkedAsAscii) {
  const TemporaryFolder folder;
  const auto path = folder / "a.h5";
  Hdf5File file(path);
  file.write("/texts", std::vector<std::string>{"plain", "Ω̄"});
  file.set_attribute("/texts", "meaning", "K_γ");
  file.close();
  const hid_t opened = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t dataset = H5Dopen2(opened, "/texts", H5P_DEFAULT);
  const hid_t type = H5Dget_type(dataset);
  EXPECT_EQ(H5Tget_cset(type), H5T_CSET_ASCII);
  H5Tclose(type);
  H5Dclose(dataset);
  H5Fclose(opened);
  EXPECT_EQ(read_hdf5_attribute(path, "/texts", "_Encoding"), "utf-8");
  EXPECT_EQ(read_hdf5_attribute(path, "/texts", "meaning"), "K_γ");
  EXPECT_EQ(read_hdf5_texts(path, "/texts").at(1), "Ω̄");
}

TEST(Hdf5File, LargeDataAreCompressed) {
  const TemporaryFolder folder;
  const std::size_t count = 400'000;
  Hdf5File file(folder / "a.h5");
  file.write("/constant", std::vector<double>(count, 1.5), count / 4, 4);
  // One row longer than a chunk.
  file.write("/wide", std::vector<double>(count, 2.5), 2, count / 2);
  file.write("/long", std::vector<std::int64_t>(count, 7));
  file.close();
  EXPECT_LT(std::filesystem::file_size(folder / "a.h5"), 3 * count * 8 / 20);
  EXPECT_EQ(read_hdf5(folder / "a.h5", "/constant").values, std::vector<double>(count, 1.5));
  EXPECT_EQ(read_hdf5(folder / "a.h5", "/wide").values, std::vector<double>(count, 2.5));
  EXPECT_EQ(read_hdf5(folder / "a.h5", "/long").values, std::vector<double>(count, 7));
}

TEST(Hdf5File, EmptyDataAndTextsAreAllowed) {
  const TemporaryFolder folder;
  Hdf5File file(folder / "a.h5");
  file.write("/none", std::vector<double>{});
  file.write("/no_rows", std::vector<double>{}, 0, 34);
  file.write("/no_texts", std::vector<std::string>{});
  file.set_attribute("/none", "units", "");
  file.close();
  EXPECT_TRUE(read_hdf5(folder / "a.h5", "/none").values.empty());
  EXPECT_EQ(read_hdf5(folder / "a.h5", "/no_rows").shape, (std::vector<std::size_t>{0, 34}));
  EXPECT_TRUE(read_hdf5_texts(folder / "a.h5", "/no_texts").empty());
  EXPECT_EQ(read_hdf5_attribute(folder / "a.h5", "/none", "units"), "");
}

TEST(Hdf5File, AttributeBeyond64KiBFits) {
  const TemporaryFolder folder;
  const std::string text(200'000, 'j');  // a resolved input may exceed the 64 KiB of older formats
  Hdf5File file(folder / "a.h5");
  file.set_attribute("/", "input", text);
  file.close();
  EXPECT_EQ(read_hdf5_attribute(folder / "a.h5", "/", "input"), text);
}

TEST(Hdf5File, AppearsOnlyWhenClosed) {
  const TemporaryFolder folder;
  {
    Hdf5File file(folder / "a.h5");
    file.write("/x", std::vector<double>{1});
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
    // What a killed program leaves is known by its name, and removed by the next.
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      EXPECT_TRUE(is_temporary_name(entry.path().filename().string()));
  }
  EXPECT_EQ(test::entries(folder.path()), 0U);
}

TEST(Hdf5File, FullDiskKeepsTheOldFile) {
  [[maybe_unused]] const LeaksOfHdf5 unseen{};  // from the first file on, whose memory HDF5 uses again
  const TemporaryFolder folder;
  const auto path = folder / "a.h5";
  write_example(path);
  const std::string before = contents(path);
  {
    testing::internal::CaptureStderr();
    for (const rlim_t most : {1U, 100U, 1000U, 4096U, 20'000U, 100'000U}) {
      const test::FileSizeLimit limit(most);
      const std::string message = message_of<OutputError>([&] { write_example(path); });
      EXPECT_NE(message.find(path.string()), std::string::npos) << message;
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }
  EXPECT_EQ(contents(path), before);
  EXPECT_EQ(test::entries(folder.path()), 1U);
}

TEST(Hdf5File, FailureNamesFileObjectAndReasonAndPrintsNothing) {
  const TemporaryFolder folder;
  Hdf5File file(folder / "a.h5");
  file.write("/x", std::vector<double>{1});
  testing::internal::CaptureStderr();
  const std::string twice = message_of<OutputError>([&] { file.write("/x", std::vector<double>{2}); });
  const std::string below = message_of<OutputError>([&] { file.write("/x/y", std::vector<double>{2}); });
  const std::string nowhere = message_of<OutputError>([&] { file.set_units("/z", "N"); });
  const std::string absent = message_of<InputError>([&] { read_hdf5(folder / "none.h5", "/x"); });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_NE(twice.find("already exists"), std::string::npos) << twice;
  EXPECT_NE(twice.find("/x"), std::string::npos) << twice;
  EXPECT_NE(twice.find("a.h5"), std::string::npos) << twice;
  EXPECT_NE(below.find("/x/y"), std::string::npos) << below;
  EXPECT_NE(nowhere.find("the attribute units of /z"), std::string::npos) << nowhere;
  EXPECT_NE(absent.find("none.h5"), std::string::npos) << absent;
  EXPECT_THROW(file.write("/m", std::vector<double>{1, 2, 3}, 2, 2), std::invalid_argument);
}

TEST(Hdf5File, DamagedFileIsAnInputError) {
  const TemporaryFolder folder;
  write_example(folder / "a.h5");
  const std::string bytes = contents(folder / "a.h5");
  test::put_file(folder / "cut.h5", std::string_view(bytes).substr(0, bytes.size() / 2));
  test::put_file(folder / "text.h5", "no HDF5 at all");
  EXPECT_THROW(read_hdf5(folder / "cut.h5", "/axis/value"), InputError);
  EXPECT_THROW(read_hdf5(folder / "text.h5", "/axis/value"), InputError);
  EXPECT_THROW(read_hdf5(folder / "a.h5", "/axis/no_such"), InputError);
  EXPECT_THROW(read_hdf5_texts(folder / "a.h5", "/axis/value"), InputError);
}

}  // namespace
}  // namespace epicyclic::store::hdf5_file_test
