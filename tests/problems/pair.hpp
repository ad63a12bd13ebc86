// A lone pair of gears: torsional, the clearance oscillator of clearance_exact.hpp; and one on bearings and shafts.
#pragma once

#include <cmath>

#include "gear/stage.hpp"
#include "model/scales.hpp"

namespace epicyclic::problems {

/// delta'' + 2 z delta' + f(delta, 1) = F + e Omega^2 sin s: with b = 10 um = b_c the oscillator of ClearanceExact.
inline gear::Stage torsional_pair(double z = 0.05, double mean = 0.1, double e = 0.05) {
  gear::Stage s;
  s.name = "pair";
  s.boundary = gear::Boundary::pair;
  s.planet_count = 1;
  s.sun.mass_kg = 2.0;
  s.sun.inertia_over_r2_kg = 1.0;
  s.sun.support_N_per_m = gear::rigid;
  s.sun.teeth = 30;
  s.sun.base_radius_mm = 42.0;
  s.planet.mass_kg = 5.0;
  s.planet.inertia_over_r2_kg = 3.0;
  s.planet.bearing_N_per_m = gear::rigid;
  s.planet.teeth = 60;
  s.planet.base_radius_mm = 84.0;
  s.sun_planet_mesh.stiffness_N_per_m = 2e8;
  s.sun_planet_mesh.operating_pressure_angle_deg = 20.0;
  s.sun_planet_mesh.damping_ratio = z;
  s.sun_planet_mesh.backlash_half_um = model::length_scale_m * 1e6;
  s.sun_planet_mesh.error_amplitude_um = {e * model::length_scale_m * 1e6};
  s.load.torque_Nm = model::scales_of(s).force_newton(mean) * *s.sun.base_radius_mm * 1e-3;
  return s;
}

/// Moving stiffness, friction, bearings, clearance, shafts and torques with harmonics.
inline gear::Stage pair_on_shafts() {
  gear::Stage s = torsional_pair();
  s.sun_planet_mesh.stiffness_cos_N_per_m = {3e7, 1e7};
  s.sun_planet_mesh.stiffness_sin_N_per_m = {-2e7};
  s.sun_planet_mesh.error_phase_deg = {40.0};
  s.sun.support_N_per_m = 3e8;
  s.sun.damping.ratio = 0.03;
  s.sun_bearing.clearance_half_um = 4.0;
  s.sun.torsional_support_N_per_m = 1e7;
  s.planet.bearing_N_per_m = 5e8;
  s.planet.damping.ratio = 0.02;
  s.planet.torsional_support_N_per_m = 2e6;
  gear::FrictionTable constant;
  constant.phase = {0.0, 0.5};
  constant.force_ratio = {0.05, 0.05};
  constant.moment_driving_mm = {3.0, 3.0};
  constant.moment_driven_mm = {-2.0, -2.0};
  s.sun_planet_mesh.friction.table = constant;
  s.load.input_cos = {0.1};
  s.load.input_sin = {0.0, 0.2};
  s.load.output_sin = {0.3};
  return s;
}

}  // namespace epicyclic::problems
