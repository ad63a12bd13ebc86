// Which branches of periodic orbits a study follows (studies/branches.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/special_points.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::studies {

/// A state on or near a periodic orbit, to start a branch from.
struct BranchSeed {
  double value = 0;                      ///< of the parameter
  int period = 1;                        ///< n [mesh periods]
  std::vector<double> state;             ///< at s = 0
  std::optional<double> max_distance{};  ///< from `value` to the ends of its branches; none: those of the range

  /// @throws InputError for a period below 1, no state, and numbers that are not finite
  void validate() const;
};

/// Which loci of the special points are followed over a second parameter (studies/loci.hpp).
struct LociOptions {
  std::string parameter;    ///< its name, or a JSON pointer to a number of the input
  double from = 0, to = 1;  ///< range of its values, from < to, around the one that the study gives
  std::vector<analysis::SpecialKind> kinds = {analysis::SpecialKind::fold, analysis::SpecialKind::period_doubling,
                                              analysis::SpecialKind::neimark_sacker,
                                              analysis::SpecialKind::branch_point};
  std::vector<double> near{};  ///< values of the first parameter: of the points nearest to them alone; none: of all
  int points = 1000;           ///< most on a locus, in each direction

  /// @throws InputError for an empty range, no kinds, or no points
  void validate() const;
};

/// A search for orbits that coexist, stable or not (studies/branch_search.hpp).
struct BranchSearchOptions {
  std::vector<double> values{};  ///< of the parameter, at which it is made
  int starts = 60;     ///< half of them on a trajectory, half in a box about its first state after the transient
  double spread = 1;   ///< half width of the box [b_c, b_c per tau]
  int period_max = 1;  ///< of the orbits, from 1 [mesh periods]

  /// @throws InputError for no values, and counts or a spread out of range
  void validate() const;
};

struct BranchesOptions {
  std::string parameter = "mesh_frequency_ratio";  ///< its name, or a JSON pointer to a number of the input
  double from = 0.2, to = 3.5;                     ///< range of its values, from < to

  std::vector<double> starts{};  ///< values whose steady state from the default start begins a branch; without seeds
                                 ///< and search, none means the ends of the range and its middle
  int transient_periods = 400;   ///< mesh periods of the transient of such a start
  int period = 1;                ///< of these orbits [mesh periods]
  std::vector<BranchSeed> seeds{};
  std::vector<double> values{};  ///< at which orbits are wanted exactly

  int period_max = 2;          ///< to which period doublings are followed [mesh periods]
  bool branch_points = true;   ///< are the branches followed that leave branch points?
  int shooting_intervals = 1;  ///< of multiple shooting, per orbit of `period`
  int orbits = 5000;           ///< most on a branch, in each direction
  int branches = 50;           ///< most

  std::string method = "arkode-dopri5";  ///< of the integrator; contacts are located where it can
  double tolerance = 1e-10;              ///< of the integrator, relative and absolute; bounds are from a tenth of it
  double max_step = 0.1;                 ///< of the arc length [-]
  int output_phases = 64;                ///< for extrema of an orbit, in a mesh period, as in a sweep

  std::optional<BranchSearchOptions> search{};
  std::optional<LociOptions> loci{};

  /// The starts, with the default ones if none are given.
  [[nodiscard]] std::vector<double> all_starts() const;

  /// @throws InputError for an empty range, starts or seeds outside it, and numbers out of range
  void validate() const;
};

/// Step of the differences for derivatives of the models' constants, in the parameter's unit: the constants change over
/// the range.
[[nodiscard]] inline double family_step(const BranchesOptions& options) { return 1e-3 * (options.to - options.from); }

}  // namespace epicyclic::studies
