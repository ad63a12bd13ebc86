// One list of columns behind points.csv, results.h5 and the documentation: the three say the same.

#include "store/point_columns.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "problems/numbered_points.hpp"
#include "reports/sweep_output.hpp"
#include "store/branch_columns.hpp"
#include "store/hdf5_file.hpp"
#include "studies/point_source.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::reports::point_columns_test {
namespace {

using studies::PointResult;
using test::contents;
using test::numbered_points;
using test::TemporaryFolder;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line + ",");
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST(PointColumns, AreTheSameInTablesAndInHdf5) {
  constexpr std::size_t planets = 2;
  const TemporaryFolder folder;
  const std::vector<PointResult> all = numbered_points(planets);
  const studies::PointSource source = studies::points_in_memory(all);
  write_points_csv(folder / "points.csv", source);
  {
    store::Hdf5File h5(folder / "results.h5");
    write_point_columns(h5, source);
    h5.close();
  }
  std::ifstream table(folder / "points.csv");
  std::string line;
  ASSERT_TRUE(std::getline(table, line));
  const std::vector<std::string> names = cells_of(line);
  std::vector<std::vector<std::string>> rows;
  while (std::getline(table, line)) rows.push_back(cells_of(line));
  ASSERT_EQ(rows.size(), all.size());
  const std::vector<store::PointColumn> columns = store::point_columns(planets);
  ASSERT_EQ(names.size(), columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const store::PointColumn& column = columns[k];
    SCOPED_TRACE(column.name);
    EXPECT_EQ(names[k], column.name);
    EXPECT_FALSE(column.meaning.empty());
    const std::string dataset = "/points/" + column.name;
    EXPECT_EQ(store::read_hdf5_attribute(folder / "results.h5", dataset, "meaning"), column.meaning);
    if (std::holds_alternative<store::PointColumn::Getter<std::string>>(column.value)) {
      const std::vector<std::string> texts = store::read_hdf5_texts(folder / "results.h5", dataset);
      ASSERT_EQ(texts.size(), rows.size());
      for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(texts[i], rows[i].at(k));
      continue;
    }
    EXPECT_EQ(store::read_hdf5_attribute(folder / "results.h5", dataset, "units"), column.unit);
    const store::Hdf5Dataset numbers = store::read_hdf5(folder / "results.h5", dataset);
    ASSERT_EQ(numbers.values.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::string& cell = rows[i].at(k);
      if (cell.empty()) {
        EXPECT_TRUE(std::isnan(numbers.values[i]));
      } else {
        EXPECT_EQ(numbers.values[i], std::stod(cell));
      }
    }
  }
}

/// Items of the page's lists, in the order of the columns, behind a place of the page.
template <class Row>
void expect_documented(const std::vector<store::Column<Row>>& columns, const std::string& page, std::size_t& from) {
  for (const store::Column<Row>& column : columns) {
    const std::string unit = column.unit.empty() ? "" : " [" + std::string(column.unit) + "]";
    const std::string item = "- `" + column.name + "`" + unit + ": " + column.meaning + "\n";
    const std::size_t at = page.find(item, from);
    EXPECT_NE(at, std::string::npos) << "missing, or not in this place: " << item;
    if (at != std::string::npos) from = at;
  }
}

TEST(PointColumns, AreEachOfANumberOfItsOwn) {
  // Two columns that read the same place would be the same in each row, but for planet 1's, which stand twice, K_v of
  // the mesh with the largest force, which is planet 2's here, as is the bearing's, and the longest time out of
  // contact, which is planet 1's.
  constexpr std::size_t planets = 2;
  const std::vector<PointResult> all = numbered_points(planets);
  std::map<std::pair<double, double>, std::string> seen;
  std::size_t numbers = 0;
  for (const store::PointColumn& column : store::point_columns(planets)) {
    const auto* of = std::get_if<store::PointColumn::Getter<double>>(&column.value);
    if (of == nullptr) continue;
    const std::pair values((*of)(all[0]), (*of)(all[1]));
    if (std::isnan(values.first) || std::isnan(values.second)) continue;
    ++numbers;
    const auto [known, is_new] = seen.emplace(values, column.name);
    if (is_new || (known->second.starts_with("kv_") && column.name == known->second + "_2") ||
        (known->second.starts_with("loss_time_") && column.name == known->second + "_1") ||
        (known->second == "force_bearing_max" && column.name == "force_bearing_2_max"))
      continue;
    const std::string of_planet_1 =
        known->second.substr(0, known->second.rfind('_')) + "_1" + known->second.substr(known->second.rfind('_'));
    EXPECT_EQ(column.name, of_planet_1);
  }
  EXPECT_GT(numbers, 90U);
}

TEST(PointColumns, StandInTheDocumentation) {
  std::string page = contents("docs/reference/columns.md");
  for (std::size_t at = 0; (at = page.find("\n  ", at)) != std::string::npos;) page.replace(at, 3, " ");
  std::size_t from = 0;
  expect_documented(store::point_columns(0), page, from);
  expect_documented(store::branch_columns(0), page, from);
  expect_documented(store::special_columns(), page, from);
  expect_documented(store::locus_columns(), page, from);
}

}  // namespace
}  // namespace epicyclic::reports::point_columns_test
