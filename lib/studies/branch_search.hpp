// Orbits that coexist at one value of the parameter, stable or not: analysis/orbit_search.hpp on a gear train's models.
// Branches are followed from all of them.
//
// Initial states: half are states of the trajectory from the model's default start, one a mesh period, after the
// transient. The others are random, in a box about the first of these. The search includes orbits in which planets do
// not move alike. Such orbits count as one if a rotation that permutes the planets maps them onto each other.
#pragma once

#include <cstddef>
#include <vector>

#include "analysis/orbit_search.hpp"
#include "studies/branches.hpp"

namespace epicyclic::studies {

/// An orbit that was found.
struct CoexistingOrbit {
  analysis::BranchOrbit orbit;
  int period = 1;
  int shooting_intervals = 1;
  bool keeps_symmetry = false;  ///< all planets move alike
  int images = 1;               ///< orbits that rotations of the stage make of it, itself included
  int unstable = 0;             ///< multipliers beyond the unit circle
  double multiplier_max = 0;    ///< greatest modulus
  std::size_t starts = 0;       ///< that led to it
};

struct CoexistingOrbits {
  double value = 0;
  std::size_t starts = 0;  ///< in all
  std::size_t missed = 0;  ///< that led to no orbit
  std::vector<CoexistingOrbit> orbits{};
};

/// @param transient_periods  of the trajectory, before its states are used
[[nodiscard]] CoexistingOrbits search_coexisting_orbits(const BranchSystem& system, const model::DynamicModel& model,
                                                        double value, const BranchSearchOptions& options,
                                                        int transient_periods);

}  // namespace epicyclic::studies
