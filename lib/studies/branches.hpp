// Branches of periodic motions of a gear train along a parameter: analysis/branch_tree.hpp on its models.
//
// The integrator is the explicit pair of the library's reference orbits: with an exact clearance steps end where
// contact is made or lost, so that places come out to the tolerance, and tangents count in the error of a step. Where
// planets are alike, spaced equally and in phase, orbits in which all of them move alike are followed among themselves,
// and what breaks that is told by its wave around the stage [A-blocks].
//
// Limits: forces may not jump at contact (analysis needs tangents). A radial clearance of the sun's bearing along x and
// y is no part of the symmetry; motions in which all planets move alike do not reach it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/branch_tree.hpp"
#include "studies/branches_options.hpp"
#include "studies/mesh_watch.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies {

/// What a tree of branches is grown with.
struct BranchSystem {
  analysis::OrbitFamily system;
  analysis::TreeOptions options;
};

/// @param models    at a value of the parameter, with its derivative where there is one; called from one thread
/// @throws InputError for options out of range, and of a model that has no tangents
[[nodiscard]] BranchSystem branch_system(const ModelAt& models, const BranchesOptions& options,
                                         const model::DynamicModel& first_model);

/// The orbit that the motion from the model's default start has settled to.
struct SettledStart {
  std::optional<analysis::BranchOrbit> orbit;
  bool keeps_symmetry = false;  ///< all planets move alike
  std::string message;          ///< why there is none
};
[[nodiscard]] SettledStart settled_start(const BranchSystem& system, const model::DynamicModel& model, double value,
                                         int settle_periods);

/// What is told of one orbit of a branch.
struct BranchRow {
  double value = 0;
  bool stable = false;          ///< all multipliers inside the unit circle
  int unstable = 0;             ///< number of multipliers beyond it
  double multiplier_max = 0;    ///< greatest modulus
  MeshRecords meshes;           ///< over the orbit's own periods
  std::vector<double> section;  ///< n states at s = 0, one behind the other
};

/// @param model  at the orbit's value
/// @param phases of the dense output a mesh period, as of a sweep
/// @returns nothing if the orbit could not be carried
[[nodiscard]] std::optional<BranchRow> branch_row(const analysis::OrbitFamily& family,
                                                  const analysis::BranchOrbit& orbit, const model::DynamicModel& model,
                                                  int phases);

}  // namespace epicyclic::studies
