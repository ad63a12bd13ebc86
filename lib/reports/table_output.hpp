// A table of columns [store/point_columns.hpp] as CSV and as a group of results.h5.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/csv.hpp"
#include "store/hdf5_file.hpp"
#include "store/point_columns.hpp"

namespace epicyclic::reports {

/// @param row_at  Row row_at(i), asked for each row once
/// @throws OutputError, and what row_at() throws
template <class Row, class RowAt>
void write_table_csv(const std::filesystem::path& file, const std::vector<store::Column<Row>>& columns,
                     std::size_t rows, RowAt row_at) {
  std::vector<std::string> names;
  for (const auto& column : columns) names.push_back(column.name);
  CsvWriter csv(file, names);
  for (std::size_t i = 0; i < rows; ++i) {
    const auto& row = row_at(i);
    for (const auto& column : columns) std::visit([&](const auto& value) { csv.cell(value(row)); }, column.value);
    csv.end_row();
  }
  csv.commit();
}

/// Columns whose values are in memory at once.
inline constexpr std::size_t columns_together = 16;

/// One dataset a column, with units and meaning as attributes.
/// @param row_at  Row row_at(i), asked for each row once every `columns_together` columns
/// @param axis    name of the rows' axis; a column of this name is its scale
/// @throws OutputError, and what row_at() throws
template <class Row, class RowAt>
void write_table_h5(store::Hdf5File& h5, const std::string& group, const std::vector<store::Column<Row>>& columns,
                    std::size_t rows, RowAt row_at, const std::string& axis = "row") {
  h5.create_group(group);
  using Values = std::variant<std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>>;
  for (std::size_t first = 0; first < columns.size(); first += columns_together) {
    const auto some = std::span(columns).subspan(first, std::min(columns_together, columns.size() - first));
    std::vector<Values> values;
    for (const auto& column : some)
      std::visit(
          [&]<class Value>(const std::function<Value(const Row&)>&) { values.emplace_back(std::vector<Value>()); },
          column.value);
    for (std::size_t i = 0; i < rows; ++i) {
      const auto& row = row_at(i);
      for (std::size_t k = 0; k < some.size(); ++k)
        std::visit(
            [&]<class Value>(const std::function<Value(const Row&)>& value) {
              std::get<std::vector<Value>>(values[k]).push_back(value(row));
            },
            some[k].value);
    }
    for (std::size_t k = 0; k < some.size(); ++k) {
      const std::string path = group + "/" + some[k].name;
      std::visit(
          [&]<class Value>(const std::vector<Value>& all) {
            h5.write(path, rows, store::Hdf5File::Column<Value>([&](std::size_t i) { return all[i]; }));
          },
          values[k]);
      if (!some[k].unit.empty()) h5.set_units(path, some[k].unit);
      h5.set_attribute(path, "meaning", some[k].meaning);
      h5.name_axes(path, {axis});
    }
  }
}

}  // namespace epicyclic::reports
