// Stages with known answers: the completed set R1 of docs/theory/published_results.md, section 5, its variants, and the
// train of Tang et al. 2020. Numbers are written here once more, apart from inputs/, so that neither can drift unseen.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include "gear/stage.hpp"

namespace epicyclic::problems {

/// I / r^2 of an inertia [kg m^2] on a radius [mm].
inline double over_r2(double inertia_kg_m2, double radius_mm) {
  return inertia_kg_m2 / (radius_mm * 1e-3 * radius_mm * 1e-3);
}

/// R1 as in docs/theory/published_results.md, section 5: `fixed_ring`, constant mean stiffness, no gap, no friction,
/// E = 8.5 um, 400 kW.
inline gear::Stage r1() {
  constexpr double r_bs = 32.17853;
  constexpr double r_bp = 29.79493;
  constexpr double r_br = 96.53557;
  constexpr double r_c = 71.72084;
  const gear::SupportDamping damping{0.05, std::nullopt};
  gear::Stage s;
  s.name = "r1";
  s.boundary = gear::Boundary::fixed_ring;
  s.planet_count = 3;
  s.centre_distance_mm = r_c;
  s.sun = {1.654, over_r2(1.297e-3, r_bs), 1e8, 0.0, damping, 27, r_bs};
  s.ring = {4.291, over_r2(5.557e-2, r_br), 1e8, 1e9, damping, 81, r_br};
  s.carrier = {7.553, over_r2(3.990e-2, r_c), 1e8, 0.0, damping, std::nullopt, std::nullopt};
  s.planet = {1.037, over_r2(8.647e-4, r_bp), 1e8, damping, 25, r_bp};
  s.sun_planet_mesh.stiffness_N_per_m = 1.258e9;
  s.ring_planet_mesh.stiffness_N_per_m = 1.316e9;
  for (gear::Mesh* mesh : {&s.sun_planet_mesh, &s.ring_planet_mesh}) {
    mesh->damping_ratio = 0.05;
    mesh->error_amplitude_um = {8.5};
  }
  s.load.power_kW = 400.0;
  return s;
}

/// The ring free and without torque, the carrier grounded: the paper as printed.
inline gear::Stage as_printed(gear::Stage s) {
  s.boundary = gear::Boundary::as_printed;
  s.ring.torsional_support_N_per_m = 0.0;
  s.carrier.torsional_support_N_per_m = 1.3e8;
  return s;
}

/// The ring is the output, the carrier grounded.
inline gear::Stage star(gear::Stage s) {
  s = as_printed(std::move(s));
  s.boundary = gear::Boundary::star;
  return s;
}

/// The sun grounded, driven by the carrier; the ring is the output.
inline gear::Stage fixed_sun(gear::Stage s) {
  s.boundary = gear::Boundary::fixed_sun;
  s.driver = gear::Driver::carrier;
  s.ring.torsional_support_N_per_m = s.carrier.torsional_support_N_per_m = 0.0;
  s.sun.torsional_support_N_per_m = 6e8;
  return s;
}

/// A differential: no member is grounded.
inline gear::Stage differential(gear::Stage s) {
  s.boundary = gear::Boundary::free;
  s.carrier_to_sun_speed = -0.4;
  s.ring.torsional_support_N_per_m = s.carrier.torsional_support_N_per_m = 0.0;
  s.load = {std::nullopt, 600.0};
  return s;
}

/// Masses, inertias and bearings of three planets differ.
inline gear::Stage with_unlike_planets(gear::Stage s) {
  s.planet.mass_kg = std::vector<double>{1.037, 1.2, 0.9};
  s.planet.inertia_over_r2_kg = std::vector<double>{0.974, 1.1, 0.8};
  s.planet.bearing_N_per_m = std::vector<double>{1e8, 1.3e8, 0.7e8};
  return s;
}

inline gear::Stage rigid_ring(gear::Stage s) {
  s.ring.torsional_support_N_per_m = gear::rigid;
  return s;
}

/// Half gap of both meshes [um].
inline gear::Stage with_gap(gear::Stage s, double half_gap_um = 40.0) {
  s.sun_planet_mesh.backlash_half_um = half_gap_um;
  s.ring_planet_mesh.backlash_half_um = half_gap_um;
  return s;
}

/// A curve in place of harmonics on both meshes: with a jump, and with rows that are even in one piece and not in the
/// other.
inline gear::Stage with_stiffness_curve(gear::Stage s) {
  for (gear::Mesh* mesh : {&s.sun_planet_mesh, &s.ring_planet_mesh}) {
    mesh->stiffness_cos_N_per_m.clear();
    mesh->stiffness_sin_N_per_m.clear();
    const double k = mesh->stiffness_N_per_m;
    mesh->stiffness_curve =
        gear::StiffnessCurve{{0.0, 0.0, 0.3, 0.3, 0.6}, {k, 1.3 * k, 1.2 * k, 0.8 * k, 0.9 * k}, {0.0, 0.3}};
  }
  return s;
}

/// Harmonics of the error and a curve with a kink on both meshes, its rows even in one part and not in the other.
inline gear::Stage with_error_curve(gear::Stage s) {
  double sign = 1.0;
  for (gear::Mesh* mesh : {&s.sun_planet_mesh, &s.ring_planet_mesh}) {
    mesh->error_cos_um = {sign * 1.5, -0.7, 0.4};
    mesh->error_sin_um = {0.8, sign * 1.1};
    mesh->error_curve = gear::ErrorCurve{{0.0, 0.1, 0.2, 0.3, 0.45, 0.8}, {0.0, 2.0, 1.0, 0.5, 3.0, 1.5}, {0.0, 0.3}};
    sign = -1.0;
  }
  return s;
}

/// Fourier stiffness of docs/theory/parameters.md, section 3, with its means.
inline gear::Stage with_moving_stiffness(gear::Stage s) {
  s.sun_planet_mesh.stiffness_N_per_m = 1.2589e9;
  s.sun_planet_mesh.stiffness_cos_N_per_m = {1.6636e8, 7.143e7};
  s.sun_planet_mesh.stiffness_sin_N_per_m = {1.2810e8, 2.2474e8};
  s.ring_planet_mesh.stiffness_N_per_m = 1.3165e9;
  s.ring_planet_mesh.stiffness_cos_N_per_m = {2.0219e8, 9.008e7};
  s.ring_planet_mesh.stiffness_sin_N_per_m = {1.0712e8, 2.3471e8};
  s.ring_mesh_lead_1 = 0.3023;
  return s;
}

/// Coulomb friction on the contact paths of docs/theory/gears.md, section 8. The coefficients are larger than
/// those of Table 1's gears so that friction weighs in tests.
inline gear::Stage with_friction(gear::Stage s, double mu = 0.08) {
  s.sun_planet_mesh.friction.coefficient = {mu, 1.200, 13.814};
  s.ring_planet_mesh.friction.coefficient = {0.8 * mu, 1.196, 13.332};
  return s;
}

/// Planets that differ: the motion is no longer symmetric.
inline gear::Stage with_unequal_errors(gear::Stage s) {
  s.sun_planet_mesh.error_amplitude_um = {8.5, 10.2, 7.65};
  s.sun_planet_mesh.error_phase_deg = {0.0, 40.0, -25.0};
  s.ring_planet_mesh.error_amplitude_um = {9.0, 7.2, 9.9};
  s.ring_planet_mesh.error_phase_deg = {10.0, 0.0, 65.0};
  return s;
}

/// Planets at 0, 110 and 250 deg, which 27 + 81 teeth let be assembled; their meshes are out of phase.
inline gear::Stage with_unequal_angles(gear::Stage s) {
  s.angles_deg = {0.0, 110.0, 250.0};
  return s;
}

/// Everything at once: gap, moving stiffness, friction, unequal errors.
inline gear::Stage r1_nonlinear() { return with_unequal_errors(with_friction(with_moving_stiffness(with_gap(r1())))); }

/// The same bodies with other teeth of the same base pitch, for other phases; (z_s + z_r) / N must be whole.
inline gear::Stage with_teeth(gear::Stage s, int z_s, int z_p, int z_r, int planets) {
  constexpr double base_radius_per_tooth = 29.79493 / 25.0;
  const double cosine = std::cos(25.0 * std::numbers::pi / 180.0);
  s.planet_count = planets;
  s.sun.teeth = z_s;
  s.planet.teeth = z_p;
  s.ring.teeth = z_r;
  s.sun.base_radius_mm = base_radius_per_tooth * z_s;
  s.planet.base_radius_mm = base_radius_per_tooth * z_p;
  s.ring.base_radius_mm = base_radius_per_tooth * z_r;
  s.centre_distance_mm = base_radius_per_tooth * (z_s + z_p) / cosine;
  // Paths of contact symmetric about the pitch point: those of Table 1 do not fit other teeth.
  for (gear::Mesh* mesh : {&s.sun_planet_mesh, &s.ring_planet_mesh})
    if (mesh->friction.coefficient) mesh->friction.coefficient->path_start_mm.reset();
  return s;
}

/// The train of Tang et al. 2020, Tables 1, 3, 4, completed as in inputs/tang2020.json but for its friction:
/// coefficients in place of the law of the lubricated contact.
inline gear::Stage tang2020() {
  const gear::SupportDamping damping{0.05, std::nullopt};
  gear::Stage s;
  s.name = "tang2020";
  s.boundary = gear::Boundary::as_printed;
  s.planet_count = 3;
  s.centre_distance_mm = 71.7208387735735;
  s.sun = {1.65427459540885, 1.25253437366918, 1e8, 0.0, damping, 27, 32.1784579787363};
  s.sun_bearing = {10.0, gear::BearingLaw::linear_xy, 10, 16.67, 0.0};
  s.ring = {4.29136781065456, 5.96333932670039, 1e8, 0.0, damping, 81, 96.5353739362088};
  s.carrier = {7.55307831881732, 7.75686047515218, 1e8, 1.3e8, damping, std::nullopt, std::nullopt};
  s.planet = {1.03652127341393, 0.974072305017875, 1e8, damping, 25, 29.7948684988299};
  s = with_moving_stiffness(with_gap(std::move(s)));
  s.sun_planet_mesh.damping_ratio = 0.05;
  s.sun_planet_mesh.error_amplitude_um = {8.5};
  s.sun_planet_mesh.friction.coefficient = {0.012, 1.2, 13.814};
  s.ring_planet_mesh.damping_ratio = 0.05;
  s.ring_planet_mesh.error_amplitude_um = {9.0};
  s.ring_planet_mesh.friction.coefficient = {0.003, 1.196, 13.332};
  s.load.power_kW = 400.0;
  return s;
}

}  // namespace epicyclic::problems
