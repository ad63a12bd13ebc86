// Which branches of periodic orbits a study follows (studies/branches.hpp).
#pragma once

#include <string>
#include <vector>

#include "studies/named_parameters.hpp"

namespace epicyclic::studies {

struct BranchesOptions {
  std::string parameter = "mesh_frequency_ratio";  ///< its name, or a JSON pointer to a number of the input
  double from = 0.2, to = 3.5;                     ///< range of its values, from < to

  std::vector<double> starts{};  ///< values at which a motion settles from the default start, and is followed
  int settle_periods = 400;      ///< mesh periods that it is given for it
  int period = 1;                ///< of these motions [mesh periods]
  std::vector<double> values{};  ///< at which orbits are wanted exactly

  int largest_period = 2;     ///< that flips are followed to [mesh periods]
  bool branch_points = true;  ///< are the branches followed that leave branch points?
  int pieces = 1;             ///< of multiple shooting, per orbit of `period`
  int orbits = 5000;          ///< most on a branch, each way
  int branches = 50;          ///< most

  double tolerance = 1e-10;   ///< of the integrator, relative and absolute; bounds are from a tenth of it
  double largest_step = 0.1;  ///< of the arc length [-]

  /// @throws InputError for an empty range, no starts or starts outside it, and numbers out of range
  void validate() const;
};

}  // namespace epicyclic::studies
