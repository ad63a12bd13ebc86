// Which points of a finished study are, to the last bit, points of a larger one that differs from it in its grid alone.
//
// A point is a pure function of its values and its initial state. It starts
//   - cold, or first in its direction: from the default start;
//   - first of a later segment: from the coarse pass, which has gone through all values before it [coarse_pass.hpp];
//   - else: from the end of the point before it in its chain.
// So a cold point is the same wherever its values are the same. A point of a continued sweep is the same if its
// direction has the same values before it, and the same segments.
#pragma once

#include <cstddef>
#include <functional>

#include "studies/sweep_plan.hpp"

namespace epicyclic::studies {

/// @param there  of the finished study
/// @param same   called for each point of `here` that is one of `there`, in order
/// @returns how many
std::size_t points_in_common(const SweepPlan& there, const SweepPlan& here,
                             const std::function<void(std::size_t point_there, std::size_t point_here)>& same);

}  // namespace epicyclic::studies
