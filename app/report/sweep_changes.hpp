// Changes of the regime along a sweep: multipliers of the periodic orbit beside each, for the page that lists them.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "studies/sweep.hpp"

namespace epicyclic::app {

struct ChangeMultipliers {
  /// `point` has the orbit, `other` is the neighbour at which the regime is another [studies/orbit_across.hpp]. The
  /// orbit was last found at `there_value`.
  static constexpr std::array<std::string_view, 11> names = {
      "point",    "other",      "here_real",       "here_imaginary", "found", "unstable",
      "one_kind", "there_real", "there_imaginary", "there_value",    "fold"};
  std::array<std::vector<double>, names.size()> columns;  ///< a row for each change beside a known orbit
  std::size_t left_out = 0;                               ///< changes whose orbits are too long to be integrated here
};

/// Neighbouring values of one direction whose regimes or periods differ; points that were not reached count for none.
/// Of two periodic neighbours the orbit is that of the period that divides the other one, or else that of the earlier
/// point of the sweep.
/// @param points     with `orbit`, in any order
/// @param model_at   also of values between those of the points; called from several threads at once
/// @param stop_here  called between changes, on each thread; may throw
/// @param threads    no effect on the result
[[nodiscard]] ChangeMultipliers change_multipliers(std::span<const studies::PointSummary> points,
                                                   const studies::ModelAtPoint& model_at,
                                                   const integrate::IntegratorOptions& integrator,
                                                   const std::function<void()>& stop_here, int threads = 1);

}  // namespace epicyclic::app
