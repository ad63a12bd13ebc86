// A column of a table of rows: one list of them is behind a CSV file, a group of results.h5 and
// docs/reference/columns.md.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace epicyclic::store {

/// A number that is not known is none: an empty cell, NaN in a dataset.
template <class Row>
struct Column {
  template <class Value>
  using Getter = std::function<Value(const Row&)>;

  std::string name;
  std::string unit;     ///< "1" of pure numbers; empty of words
  std::string meaning;  ///< a line, for the documentation and results.h5
  std::variant<Getter<std::int64_t>, Getter<double>, Getter<std::string>> value;
};

/// A column of a part as one of the whole.
/// @param part  const Part& (const Row&)
template <class Row, class Part, class F>
[[nodiscard]] Column<Row> column_of_part(const Column<Part>& column, const F& part) {
  Column<Row> result{column.name, column.unit, column.meaning, {}};
  std::visit(
      [&]<class Value>(const std::function<Value(const Part&)>& value) {
        result.value = std::function<Value(const Row&)>([value, part](const Row& row) { return value(part(row)); });
      },
      column.value);
  return result;
}

}  // namespace epicyclic::store
