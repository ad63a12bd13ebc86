#include "gear/bearing_life.hpp"

#include <cmath>
#include <numbers>

#include "gear/kinematics.hpp"

namespace epicyclic::gear {

namespace {

std::optional<RatedBearing> rated(const BearingRating& rating, RollingElements usual, double speed) {
  if (!rating.dynamic_load_rating_kN) return std::nullopt;
  const bool balls = rating.rolling_elements.value_or(usual) == RollingElements::balls;
  return RatedBearing{*rating.dynamic_load_rating_kN * 1e3, balls ? 3.0 : 10.0 / 3.0, speed};
}

}  // namespace

BearingLoads bearing_loads(const Stage& stage, double mesh_frequency) {
  return {rated(stage.sun_bearing.rating, RollingElements::balls, speeds(stage, mesh_frequency).sun),
          rated(stage.planet.rating, RollingElements::rollers, mesh_frequency / stage.planet.teeth.value())};
}

BearingLife bearing_life(const RatedBearing& bearing, double equivalent_load_N) {
  constexpr double seconds_per_hour = 3600.0;
  const double million = std::pow(bearing.rating_N / equivalent_load_N, bearing.exponent);
  const double revolutions_per_hour = bearing.speed_rad_per_s / (2.0 * std::numbers::pi) * seconds_per_hour;
  return {equivalent_load_N, million, 1e6 * million / revolutions_per_hour};
}

}  // namespace epicyclic::gear
