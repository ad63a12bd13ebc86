// What a sweep is: a parameter and its grid, directions, start, and how long to look.
#pragma once

#include <string>
#include <vector>

#include "studies/axis.hpp"
#include "studies/recording_options.hpp"

namespace epicyclic::studies {

enum class Direction { up, down };

enum class Start {
  continued,  ///< each point starts from the end state of the one before: follows a branch, shows hysteresis
  cold,       ///< each point starts from the default start
};

/// Name of the parameter Omega [studies/named_parameters.hpp].
inline constexpr const char* speed_parameter = "mesh_frequency_ratio";

/// Points of the finished sweep that are computed again by other methods and compared [studies/crosscheck.hpp].
struct SweepCheck {
  int points = 0;  ///< at most; shared out among the regimes
  std::vector<std::string> methods = {"arkode-dopri5", "cvode-adams"};
  double orbit_tolerance = 1e-6;  ///< two orbits are the same if no component differs by more [b_c, b_c per tau]

  /// @throws InputError for a negative number of points, no method, or a tolerance that is not positive
  void validate() const;
};

struct SweepOptions {
  Axis axis = {speed_parameter, 0.2, 3.5, 661};  ///< the parameter
  std::vector<Direction> directions = {Direction::up};
  Start start = Start::continued;
  int segments = 0;         ///< chains per direction of a carried sweep; 0: segments_of()
  int coarse_periods = 30;  ///< mesh periods of a point in the pass that says where segments start [coarse_pass.hpp]
  RecordingOptions recording;
  SweepCheck check;

  /// @throws InputError for what axis, look and check refuse, no directions, and segments that the points do not give
  void validate() const;
};

/// Chains per direction: segments, or where it is left to the number of points, 1 of fewer than 64 and else one for
/// each 8 of them, so that lanes are busy; 1 of points that start cold.
[[nodiscard]] int segments_of(const SweepOptions& options);

/// Of one point.
[[nodiscard]] SweepOptions sweep_of_one(double mesh_frequency_ratio, const RecordingOptions& recording);

}  // namespace epicyclic::studies
