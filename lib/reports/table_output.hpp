// A table of columns [store/point_columns.hpp] as CSV and as a group of results.h5.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
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

/// One dataset a column, with units and meaning as attributes.
/// @param row_at  Row row_at(i), asked for each row once a column: a row of all columns at once would need each
///                column's chunk in memory
/// @throws OutputError, and what row_at() throws
template <class Row, class RowAt>
void write_table_h5(store::Hdf5File& h5, const std::string& group, const std::vector<store::Column<Row>>& columns,
                    std::size_t rows, RowAt row_at) {
  h5.create_group(group);
  for (const auto& column : columns) {
    const std::string path = group + "/" + column.name;
    std::visit(
        [&]<class Value>(const std::function<Value(const Row&)>& value) {
          h5.write(path, rows, store::Hdf5File::Column<Value>([&](std::size_t i) { return value(row_at(i)); }));
        },
        column.value);
    if (!column.unit.empty()) h5.set_units(path, column.unit);
    h5.set_attribute(path, "meaning", column.meaning);
  }
}

}  // namespace epicyclic::reports
