// The example of Lin and Parker, with published natural frequencies.
#pragma once

#include "gear/stage.hpp"

namespace epicyclic::problems {

inline gear::CentralMember undamped_member(double mass_kg, double inertia_over_r2_kg, double support_N_per_m,
                                           double torsional_support_N_per_m = 0.0) {
  gear::CentralMember m;
  m.mass_kg = mass_kg;
  m.inertia_over_r2_kg = inertia_over_r2_kg;
  m.support_N_per_m = support_N_per_m;
  m.torsional_support_N_per_m = torsional_support_N_per_m;
  return m;
}

inline gear::Planet undamped_planet(double mass_kg, double inertia_over_r2_kg, double bearing_N_per_m) {
  gear::Planet p;
  p.mass_kg = mass_kg;
  p.inertia_over_r2_kg = inertia_over_r2_kg;
  p.bearing_N_per_m = bearing_N_per_m;
  return p;
}

/// Lin and Parker, J. Vib. Acoust. 121 (1999) 316, Table 1: masses and stiffnesses only, the ring fixed.
inline gear::Stage lin_parker(int planets) {
  gear::Stage s;
  s.name = "lin_parker_1999";
  s.boundary = gear::Boundary::fixed_ring;
  s.planet_count = planets;
  s.sun = undamped_member(0.4, 0.39, 1e8);
  s.ring = undamped_member(2.35, 3.0, 1e8, 1e9);
  s.carrier = undamped_member(5.43, 6.29, 1e8);
  s.planet = undamped_planet(0.66, 0.61, 1e8);
  s.sun_planet_mesh.stiffness_N_per_m = s.ring_planet_mesh.stiffness_N_per_m = 5e8;
  s.sun_planet_mesh.operating_pressure_angle_deg = s.ring_planet_mesh.operating_pressure_angle_deg = 24.6;
  return s;
}

}  // namespace epicyclic::problems
