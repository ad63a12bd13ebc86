#include "model/scales.hpp"

#include <cmath>

namespace epicyclic::model {

double Scales::hertz(double newton_per_m_1_5) const { return stiffness(newton_per_m_1_5 * std::sqrt(length_scale_m)); }

Scales scales_of(const gear::Stage& stage) {
  const double inverse = 1.0 / stage.sun.inertia_over_r2_kg + 1.0 / stage.planet.inertia_over_r2_kg;
  return {std::sqrt(stage.sun_planet_mesh.stiffness_N_per_m * inverse), 1.0 / inverse};
}

}  // namespace epicyclic::model
