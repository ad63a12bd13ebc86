// The columns of a study's points: one list behind points.csv, the group /points of results.h5 and
// docs/reference/columns.md.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "store/column.hpp"
#include "store/stage_columns.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::store {

/// Status of a point: ok, diverged, step_limit, failed.
[[nodiscard]] std::string status_word(integrate::Outcome outcome);

/// "up" or "down".
[[nodiscard]] std::string direction_word(studies::Direction direction);

/// Regime of a point: periodic, quasiperiodic, chaotic, undecided; empty unless ok.
[[nodiscard]] std::string regime_word(const studies::PointSummary& result);

using PointColumn = Column<studies::PointSummary>;

/// All of them, in the order of points.csv.
/// @param planets  number N: columns for each mesh and bearing of each
/// @param more     that a kind of study adds, behind `value`
/// @param lives    bearings whose lives are known
[[nodiscard]] std::vector<PointColumn> point_columns(std::size_t planets, const std::vector<PointColumn>& more = {},
                                                     const KnownLives& lives = {});

/// Those of a study with such points.
[[nodiscard]] std::vector<PointColumn> point_columns_like(const studies::PointSummary& point,
                                                          const std::vector<PointColumn>& more = {});

}  // namespace epicyclic::store
