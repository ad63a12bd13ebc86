#include "gear/reversal.hpp"

#include <algorithm>
#include <cstddef>

namespace epicyclic::gear {

namespace {

/// Rows of a table in the order of - phase, and their phases.
struct ReversedRows {
  std::vector<std::size_t> rows;
  std::vector<double> phase;

  explicit ReversedRows(const std::vector<double>& given) {
    for (std::size_t k = given.size(); k-- > 0;) rows.push_back(k);
    // The phase 0 stays; both sides of a jump there change places.
    const auto first = std::find_if(rows.begin(), rows.end(), [&](std::size_t k) { return given[k] == 0.0; });
    std::rotate(rows.begin(), first, rows.end());
    for (const std::size_t k : rows) phase.push_back(given[k] == 0.0 ? 0.0 : 1.0 - given[k]);
  }

  [[nodiscard]] std::vector<double> of(const std::vector<double>& values, double sign) const {
    std::vector<double> r;
    for (const std::size_t k : rows) r.push_back(sign * values[k]);
    return r;
  }
};

}  // namespace

bool is_mirrored(const Stage& stage) { return stage.load.torque_Nm.value_or(1.0) < 0.0; }

StiffnessCurve reversed(const StiffnessCurve& curve) {
  StiffnessCurve r = curve;
  const ReversedRows rows(curve.phase);
  r.phase = rows.phase;
  r.stiffness_N_per_m = rows.of(curve.stiffness_N_per_m, 1.0);
  r.breakpoints = ReversedRows(curve.breakpoints).phase;
  return r;
}

ErrorCurve reversed(const ErrorCurve& curve) {
  ErrorCurve r = curve;
  const ReversedRows rows(curve.phase);
  r.phase = rows.phase;
  r.error_um = rows.of(curve.error_um, 1.0);
  r.breakpoints = ReversedRows(curve.breakpoints).phase;
  return r;
}

FrictionTable reversed(const FrictionTable& table) {
  FrictionTable r = table;
  const ReversedRows rows(table.phase);
  r.phase = rows.phase;
  r.force_ratio = rows.of(table.force_ratio, -1.0);
  r.moment_driving_mm = rows.of(table.moment_driving_mm, -1.0);
  r.moment_driven_mm = rows.of(table.moment_driven_mm, -1.0);
  r.breakpoints = ReversedRows(table.breakpoints).phase;
  r.grids = reversed(table.grids);
  return r;
}

std::vector<IntervalGrid> reversed(std::vector<IntervalGrid> grids) {
  std::ranges::reverse(grids);
  for (IntervalGrid& g : grids)
    if (g.per_octave > 0) g.from_end = !g.from_end;
  return grids;
}

}  // namespace epicyclic::gear
