// Branches of periodic motions of a gear train along a parameter: analysis/bifurcation_diagram.hpp on its models.
//
// The integrator is the explicit pair of the library's reference orbits: with an exact clearance steps end where
// contact is made or lost, so that places come out to the tolerance, and tangents count in the error of a step. Where
// planets are alike, spaced equally and in phase, orbits in which all of them move alike are followed among themselves,
// and what breaks that is told by its wave around the stage [A-blocks].
//
// Limits: forces may not jump at contact (analysis needs tangents). A radial clearance of the sun's bearing along x and
// y is no part of the symmetry; motions in which all planets move alike do not reach it.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "analysis/bifurcation_diagram.hpp"
#include "analysis/smoothing_bias.hpp"
#include "studies/branches_options.hpp"
#include "studies/response_statistics.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies {

/// How branches are integrated: tangents under error control.
/// @param contacts  are steps to end where contact is made or lost, by a method that can?
[[nodiscard]] integrate::IntegratorOptions branch_integrator(const std::string& method, double tolerance,
                                                             bool contacts);

/// What a tree of branches is grown with.
struct BranchSystem {
  analysis::OrbitFamily system;
  analysis::TreeOptions options;
};

/// @param models    at a value of the parameter, with its derivative where there is one; called from one thread
/// @throws InputError for options out of range, and of a model that has no tangents
[[nodiscard]] BranchSystem branch_system(const ModelAt& models, const BranchesOptions& options,
                                         const model::DynamicModel& first_model);

/// The orbit that a branch is to be followed from.
struct BranchOrigin {
  std::optional<analysis::BranchOrbit> orbit;
  int period = 1;               ///< its least one: half of that asked for, say
  int shooting_intervals = 1;   ///< of its states
  bool keeps_symmetry = false;  ///< all planets move alike
  double distance = 0;          ///< from the state that it was looked for near [b_c, b_c per tau]
  std::string message{};        ///< why there is none
};

/// The one that the motion from the model's default start has settled to.
[[nodiscard]] BranchOrigin settled_start(const BranchSystem& system, const model::DynamicModel& model, double value,
                                         int transient_periods);

/// The one near a seed.
[[nodiscard]] BranchOrigin seed_start(const BranchSystem& system, const BranchSeed& seed);

/// What is told of one orbit of a branch.
struct BranchRow {
  double value = 0;
  int period = 1;                                 ///< n [mesh periods]
  bool stable = false;                            ///< all multipliers inside the unit circle
  int unstable = 0;                               ///< number of multipliers beyond it
  double residual = 0;                            ///< by which it did not close before the last step [b_c, b_c per tau]
  std::vector<std::complex<double>> multipliers;  ///< by falling modulus
  bool carried = false;                           ///< what follows is known
  StageRecord meshes;                             ///< over the orbit's own periods
  std::vector<double> section;                    ///< n rows of poincare_columns()
  double omega = 0;                               ///< Omega

  /// Greatest modulus of a multiplier.
  [[nodiscard]] double multiplier_max() const { return multipliers.empty() ? 0.0 : std::abs(multipliers.front()); }
};

/// @param model  at the orbit's value
/// @param phases of the dense output a mesh period, as of a sweep
[[nodiscard]] BranchRow branch_row(const analysis::OrbitFamily& family, const analysis::BranchOrbit& orbit,
                                   const model::DynamicModel& model, int phases);

/// An orbit where a branch is born or dies has a multiplier at 1 to rounding: whether it is stable its neighbour says.
void settle_stability(const analysis::Branch& branch, std::vector<BranchRow>& rows);

/// What is told of special points: one of a branch, or several contacts that alike planets make at once.
struct SpecialRow {
  std::size_t branch = 0;
  std::size_t point = 0;  ///< on the branch, the first of them
  std::size_t after = 0;  ///< index of the orbit before it
  analysis::SpecialKind kind = analysis::SpecialKind::unresolved;
  double value = 0, error_bound = 0;
  int period = 1;
  std::vector<std::complex<double>> multipliers;  ///< that are on the unit circle there
  int resonance = 0;                              ///< k of a strong resonance 1:k of a Neimark-Sacker point; 0: none
  std::string broken_symmetry;                    ///< of the motions that leave it: "wave 1 of 3"; empty: none
  /// Of a grazing, which contact is first made or lost: "sp_1+sp_2+sp_3:loss", "rp_1:back", "sun_bearing_x:touch".
  std::string contact;
  std::optional<analysis::SpecialPlace> same_as{};  ///< the point of an earlier branch that it is
  std::optional<analysis::ExactValue> exact{};      ///< with a smooth clearance: the value with the exact one
  std::string note;
  double mesh_frequency = 0;  ///< omega_m there [rad/s]
  gear::Speeds speeds{};      ///< there
};

/// The kind as it stands in tables: "fold", ..., "resonance_1_3".
[[nodiscard]] std::string kind_word(const SpecialRow& row);

/// Where branches were started from, and what came of it.
struct BranchAttempt {
  double value = 0;
  int period = 1;
  bool seed = false;      ///< else a settled motion
  bool found = false;     ///< an orbit
  double distance = 0;    ///< of it from the state that it was looked for near [b_c, b_c per tau]
  std::string message{};  ///< why none
};

/// An orbit found further away from a seed is likely not the one that was meant [b_c, b_c per tau].
inline constexpr double far_from_its_start = 0.05;

/// All that a study of branches comes to.
struct TracedBranches {
  std::vector<BranchAttempt> attempts;
  std::vector<analysis::Branch> branches;
  bool full = false;                         ///< more branches were there than asked for
  std::vector<std::vector<BranchRow>> rows;  ///< of each branch's orbits
  std::vector<SpecialRow> special;
  std::vector<BranchRow> at_special;  ///< of the orbit at each of these

  /// Row of `special` where the stability changes between an orbit of a branch and the next: of several the one beside
  /// the stable side; nothing where neither or both are stable, or the point is not known.
  [[nodiscard]] std::optional<std::size_t> change_behind(std::size_t branch, std::size_t before) const;

  /// Ways that ended before an end of the range, where they were born or as many orbits as asked for.
  [[nodiscard]] std::size_t broken_off() const;
};

/// Those of all branches, in their order.
/// @param contacts  of the model's surfaces
[[nodiscard]] std::vector<SpecialRow> special_rows(const std::vector<analysis::Branch>& branches,
                                                   const std::vector<model::ContactSurface>& contacts);

}  // namespace epicyclic::studies
