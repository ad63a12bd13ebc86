// Options of a run-up or run-down.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/sweep_options.hpp"

namespace epicyclic::studies {

struct RampOptions {
  std::optional<double> from{}, to{};                              ///< Omega [-], or
  std::optional<double> from_sun_speed_rpm{}, to_sun_speed_rpm{};  ///< speeds of the sun
  std::optional<double> rate_per_tau{};                            ///< |d Omega / d tau| [-], or
  std::optional<double> rate_rpm_per_s{};                          ///< of the speed of the sun
  std::vector<Direction> directions = {Direction::up, Direction::down};
  int hold_periods = 200;               ///< mesh periods at constant speed before each ramp
  int window_periods = 16;              ///< mesh periods of a window of the order analysis
  int output_phases = 64;               ///< samples per mesh period
  int orders = 4;                       ///< highest order, of the mesh frequency
  std::vector<double> torque_time_s{};  ///< of a torque over time, from the beginning of the first ramp, rising [s]
  std::string torque_file{};            ///< that they are read from, until the input is loaded
  std::vector<double> torque_Nm{};      ///< as many; linear between, constant before and behind [N m]
};

}  // namespace epicyclic::studies
