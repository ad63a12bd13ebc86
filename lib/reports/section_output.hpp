// Columns of states, deflections and forces with unit and meaning: the groups /poincare, /history and /crossing of
// results.h5.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "store/hdf5_file.hpp"

namespace epicyclic::reports {

struct ColumnWords {
  std::string unit;     ///< "1" of pure numbers
  std::string meaning;  ///< a line; empty of a name that is not known
};

/// @param column  name as in poincare.csv, history.csv or crossing.csv
[[nodiscard]] ColumnWords column_words(std::string_view column);

/// One dataset a column, with units and meaning as attributes; the axis is "row".
/// @param row_values  fills a value of each column; rows are required in order, each once
/// @param units       of each column; empty: those of column_words()
/// @throws OutputError, and what row_values() throws
void write_section_h5(store::Hdf5File& h5, const std::string& group, const std::vector<std::string>& columns,
                      std::size_t rows,
                      const std::function<void(std::size_t row, std::span<double> values)>& row_values,
                      const std::vector<std::string>& units = {});

}  // namespace epicyclic::reports
