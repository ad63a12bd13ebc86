// Motions that exist side by side at one value of the parameter, stable or not: analysis/orbit_search.hpp on a gear
// train's models. Branches are followed from all of them.
//
// Starts: states of the motion from the model's default start, one a mesh period, once it has settled; and as many
// random ones in a box about the first of these. Orbits in which planets do not move alike are sought too; turned by
// planets they are one.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/orbit_search.hpp"
#include "studies/branches.hpp"

namespace epicyclic::studies {

/// An orbit that was found.
struct FoundMotion {
  analysis::BranchOrbit orbit;
  int period = 1;
  int shooting_intervals = 1;
  bool keeps_symmetry = false;  ///< all planets move alike
  int images = 1;               ///< orbits that turns of the stage make of it, itself included
  int unstable = 0;             ///< multipliers beyond the unit circle
  double multiplier_max = 0;    ///< greatest modulus
  std::size_t starts = 0;       ///< that led to it
};

struct FoundMotions {
  double value = 0;
  std::size_t starts = 0;  ///< in all
  std::size_t missed = 0;  ///< that led to no motion
  std::vector<FoundMotion> motions{};
};

/// @param transient_periods  that the motion is given before its states are starts
[[nodiscard]] FoundMotions search_motions(const BranchSystem& system, const model::DynamicModel& model, double value,
                                          const BranchSearchOptions& options, int transient_periods);

}  // namespace epicyclic::studies
