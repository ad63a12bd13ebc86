// Switching to another branch: at period doublings to orbits of twice the period, at branch points to the
// orbits of the branch that crosses.
//
// With v the eigenvector of the monodromy at the multiplier that is critical, the other branch leaves the point z_0 as
//
//   z_0 + e (v, 0) + O(e^2)                                                                            [A-switch]
//
// At a period doubling v becomes -v after n periods: e and -e are one orbit of 2 n periods, begun at another of them.
// At a branch point the part of (v, 0) along the known branch is removed, and e and -e may be two orbits. In a block
// that stands for two [A-blocks] v spans a plane. The symmetry decides which of its directions lead to orbits, so
// several are tried. Source: Seydel, 3rd ed., ch. 5.
//
// Limits: orbits in other directions, tori and their resonances are not searched for.
#pragma once

#include <vector>

#include "analysis/special_points.hpp"

namespace epicyclic::analysis {

struct SwitchOptions {
  double distance = 1e-2;  ///< e, as a length [A-length]
  int angles = 12;         ///< directions tried in a plane of them
  double same = 1e-3;      ///< distance up to which two orbits are one, in parts of e

  /// @throws InputError for a distance or angles out of range
  void validate() const;
};

/// One orbit on a branch that leaves a special point, going away from it.
struct BranchSwitch {
  OrbitFamily family;  ///< of that branch: of twice the period, or without the symmetry that is broken
  BranchOrbit origin;  ///< the point itself as an orbit of that family, with the direction of the new branch
  BranchOrbit orbit;
};

/// All that are found, each once; of those that are images of one another by the symmetry or by whole periods one.
/// Empty at folds and Neimark-Sacker points.
/// @param family  of the branch that the point is on
[[nodiscard]] std::vector<BranchSwitch> branch_switches(const OrbitFamily& family, const SpecialPoint& point,
                                                        const SwitchOptions& options = {});

/// States of an orbit at the beginnings of its n periods, one a column, without shifts along neutral directions.
/// @returns no columns if the integration failed
[[nodiscard]] Eigen::MatrixXd period_states(const OrbitFamily& family, const CurvePoint& at);

/// The fewest periods after which states repeat.
/// @param states      of period_states()
/// @param difference  most of any component
[[nodiscard]] int least_period(const Eigen::MatrixXd& states, double difference);

/// How far an orbit is from one of a shorter period, or from one that has the symmetry which the family does not keep:
/// the least over these of the largest difference of a component.
/// @returns infinity where there is nothing simpler, and for an orbit whose integration failed
[[nodiscard]] double distance_to_simpler(const OrbitFamily& family, const CurvePoint& at);

/// Distance of one orbit from the other, begun at another of its periods or rotated by the symmetry: the least over
/// these of the largest difference of a component.
/// @param a, b      of period_states()
/// @param symmetry  empty: without rotation
/// @returns infinity for different numbers of columns
[[nodiscard]] double image_distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const CyclicSymmetry& symmetry);

/// Is it no more than `difference`?
[[nodiscard]] bool are_images(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const CyclicSymmetry& symmetry,
                              double difference);

}  // namespace epicyclic::analysis
