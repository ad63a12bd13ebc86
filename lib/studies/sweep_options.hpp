// What a sweep is: a parameter and its grid, directions, start, and how long to look.
#pragma once

#include <vector>

#include "studies/axis.hpp"
#include "studies/look_options.hpp"

namespace epicyclic::studies {

enum class Direction { up, down };

enum class Start {
  carried,  ///< each point starts from the end state of the one before: follows a branch, shows hysteresis
  cold,     ///< each point starts from the default start
};

/// Name of the parameter Omega [studies/named_parameters.hpp].
inline constexpr const char* speed_parameter = "mesh_frequency_ratio";

struct SweepOptions {
  Axis axis = {speed_parameter, 0.2, 3.5, 661};  ///< the parameter
  std::vector<Direction> directions = {Direction::up};
  Start start = Start::carried;
  int segments = 1;         ///< chains per direction of a carried sweep
  int coarse_periods = 30;  ///< mesh periods of a point in the pass that says where segments start [coarse_pass.hpp]
  LookOptions look;

  /// @throws InputError for what axis and look refuse, no directions, and segments that the points do not give
  void validate() const;
};

/// Of one point.
[[nodiscard]] SweepOptions sweep_of_one(double mesh_frequency_ratio, const LookOptions& look);

}  // namespace epicyclic::studies
