// The columns of a study's points: one list behind points.csv, the group /points of results.h5 and docs/output.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "studies/sweep.hpp"

namespace epicyclic::store {

/// Status of a point: ok, diverged, step_limit, failed.
[[nodiscard]] std::string status_word(integrate::Outcome outcome);

/// "up" or "down".
[[nodiscard]] std::string direction_word(studies::Direction direction);

/// Regime of a point: periodic, quasiperiodic, chaotic, undecided; empty unless ok.
[[nodiscard]] std::string regime_word(const studies::PointSummary& result);

/// A column of a table of rows. A number that is not known is none: an empty cell, NaN in a dataset.
template <class Row>
struct Column {
  template <class Value>
  using Getter = std::function<Value(const Row&)>;

  std::string name;
  std::string unit;     ///< "1" of pure numbers; empty of words
  std::string meaning;  ///< a line, for the documentation and results.h5
  std::variant<Getter<std::int64_t>, Getter<double>, Getter<std::string>> value;
};

using PointColumn = Column<studies::PointSummary>;

/// All of them, in the order of points.csv.
/// @param planets  number N: three columns for each mesh of each
/// @param more     that a kind of study adds, behind `value`
[[nodiscard]] std::vector<PointColumn> point_columns(std::size_t planets, const std::vector<PointColumn>& more = {});

}  // namespace epicyclic::store
