// Speeds, torques and angles of a planetary stage.
//
//   fixed ring, `as_printed`:  omega_c = omega_s z_s / (z_s + z_r) ,  omega_m = z_s (omega_s - omega_c) = z_r omega_c
//   star, pair:                omega_c = 0 ,                          omega_m = z_s omega_s
//   fixed sun:                 omega_s = 0 ,                          omega_m = z_s omega_c
//   free:                      omega_c = rho omega_s ,                omega_m = z_s (omega_s - omega_c)
//   T_D = P / omega_s or given ;  T_c = (1 + z_r / z_s) T_D ;  T_r = (z_r / z_s) T_D
//   of a fixed sun             T_c = P / omega_c
//   centrifugal force of a planet  M_p omega_c^2 r_c                                                   [G-cf]
//   cos alpha_sp = (r_bs + r_bp) / r_c ,  cos alpha_rp = (r_br - r_bp) / r_c                           [G-kin]
//
// Source: docs/theory/model.md, section 4; any textbook on epicyclic trains. Limits: a stage that passes
// problems_for_dynamics().
#pragma once

#include <numbers>

#include "gear/stage.hpp"

namespace epicyclic::gear {

/// 1 rad/s [rpm].
inline constexpr double rpm = 30.0 / std::numbers::pi;

/// Speeds at a mesh frequency omega_m [rad/s], in the direction of the torque on the sun, or against it if the stage
/// runs backward. Of a fixed sun the carrier's magnitude: its direction is the opposite one.
struct Speeds {
  double sun;      ///< omega_s [rad/s]
  double carrier;  ///< omega_c [rad/s]
};

[[nodiscard]] Speeds speeds(const Stage& stage, double mesh_frequency);

/// Torques on the members, positive in the direction of the sun's; signs as in Eqs. (17)-(20): T_D and T_r drive u_s
/// and u_r forward, T_c holds u_c back.
struct Torques {
  double sun;      ///< T_D [N m], of a fixed sun its support's
  double ring;     ///< T_r [N m], 0 if the ring is held or without torque
  double carrier;  ///< T_c [N m], 0 if the carrier is held in `star`
};

/// omega_c in the direction of omega_s - omega_c: that of Speeds, of a fixed sun with the negative sign [rad/s].
[[nodiscard]] double carrier_speed(const Stage& stage, double mesh_frequency);

[[nodiscard]] Torques torques(const Stage& stage, double mesh_frequency);

/// Centrifugal force of one planet by the carrier's rotation, along its radius [N]: the load on its bearing without
/// torque. [G-cf]
[[nodiscard]] double planet_centrifugal_force(const Stage& stage, double mesh_frequency, double mass_kg);
/// Of a planet with the mean mass.
[[nodiscard]] double planet_centrifugal_force(const Stage& stage, double mesh_frequency);

/// Operating pressure angles [rad]: from radii and centre distance if all are given (they have more digits than an
/// angle in degrees), else as given.
struct PressureAngles {
  double sun_planet, ring_planet;
};

[[nodiscard]] PressureAngles pressure_angles(const Stage& stage);

}  // namespace epicyclic::gear
