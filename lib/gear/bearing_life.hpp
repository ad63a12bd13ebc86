// Basic rating life of rolling bearings under a radial load that varies, at a constant speed.
//
//   P = (mean F^p)^(1/p) ,  L10 = (C / P)^p  [10^6 revolutions] ,  L10h = 10^6 L10 / (60 n)  [h]          [G-life]
//   p = 3 of balls, 10/3 of rollers;  n [rpm] of one ring against the other
//
// Source: ISO 281:2007, 5.3 and 7.3; the mean of F^p is Palmgren's linear rule of damage. Of a planet n is its speed
// against the carrier, omega_m / z_p; of the sun, and of both gears of a pair, its speed against the housing. Limits:
// radial load alone, so that the equivalent load is F; no a_1 and a_ISO, no load that is too small to roll. The law is
// smooth; without load there is no limit to the life, and it is infinite.
#pragma once

#include <limits>
#include <optional>

#include "gear/stage.hpp"

namespace epicyclic::gear {

/// A bearing with a load rating.
struct RatedBearing {
  double rating_N = 0;         ///< C
  double exponent = 3;         ///< p
  double speed_rad_per_s = 0;  ///< of one ring against the other
};

/// The bearings of a stage whose load rating is known.
struct BearingLoads {
  std::optional<RatedBearing> sun, planet;
};

/// @param stage  with teeth
[[nodiscard]] BearingLoads bearing_loads(const Stage& stage, double mesh_frequency);

/// Life of one bearing; not numbers where no force was seen.
struct BearingLife {
  double equivalent_load_N = std::numeric_limits<double>::quiet_NaN();    ///< P
  double million_revolutions = std::numeric_limits<double>::quiet_NaN();  ///< L10
  double hours = std::numeric_limits<double>::quiet_NaN();                ///< L10h
};

/// [G-life] at an equivalent load P >= 0 [N].
[[nodiscard]] BearingLife bearing_life(const RatedBearing& bearing, double equivalent_load_N);

}  // namespace epicyclic::gear
