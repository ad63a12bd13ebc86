// Two involute gears in mesh at a centre distance: angles, path of contact, speeds, backlash, clearances.
//
//   external  cos alpha = (r_b1 + r_b2) / a ,  r_w = r_b / cos alpha ,  N_1 N_2 = a sin alpha
//   internal  cos alpha = (r_b2 - r_b1) / a                                                             [G-pair]
//   contact at distance l = N_1 P from the tangent point of member 1:
//     external  h_1 = l , h_2 = N_1 N_2 - l ;  starts at N_1 N_2 - sqrt(r_a2^2 - r_b2^2) , ends at sqrt(r_a1^2 -
//     r_b1^2) internal  h_1 = l , h_2 = N_1 N_2 + l ;  starts at sqrt(r_a2^2 - r_b2^2) - N_1 N_2 , ends likewise
//     [G-path]
//   epsilon = (end - start) / p_b ;  pitch point at l = r_b1 tan alpha
//   backlash on the operating pitch circle  j_t = p_w - s_w1 - s_w2 ,  on the line of action j_bn = j_t cos alpha [G-j]
//   no backlash:  external  inv alpha = (z_1 alpha_21 + z_2 alpha_22 - pi) / (z_1 + z_2)
//                 internal  inv alpha = (pi - z_1 alpha_21 - z_2 alpha_22) / (z_2 - z_1)                [G-a0]
//   V_1 = omega_1 h_1 , V_2 = omega_2 h_2 , relative to the carrier; sliding V_1 - V_2, rolling (V_1 + V_2) / 2 [G-9]
//
// Member 1 is external and drives. Both must have one base pitch. Lengths in mm. Source: DIN 3960, Tang et al. 2020,
// Eqs. (2), (3), (9) with the corrections of docs/theory/model.md, section 6; [G-j], [G-a0] hold for two different
// reference profiles, which the usual formula in x_1 + x_2 does not.
#pragma once

#include "gear/tooth.hpp"

namespace epicyclic::gear {

/// Where the path of contact lies.
enum class PitchSide {
  across,  ///< the pitch point is on the path: the sliding speed changes sign
  beyond,  ///< the path starts behind the pitch point
  before,  ///< the path ends before the pitch point
};

struct Pair {
  Tooth driving, driven;
  double centre_distance_mm = 0;
  double pressure_angle = 0;         ///< operating pressure angle alpha [rad]
  double base_pitch_mm = 0;          ///< of the driving member
  double theoretical_length_mm = 0;  ///< N_1 N_2
  double pitch_arm_mm = 0;           ///< l of the pitch point
  double start_mm = 0, end_mm = 0;   ///< l where contact starts and ends

  [[nodiscard]] bool internal() const { return driven.internal; }
  [[nodiscard]] double contact_ratio() const { return (end_mm - start_mm) / base_pitch_mm; }
  /// Friction arm of the driven member at l; its radius of curvature [mm].
  [[nodiscard]] double arm_2_mm(double l_mm) const {
    return internal() ? theoretical_length_mm + l_mm : theoretical_length_mm - l_mm;
  }
  /// Radius of the contact point on the driving and the driven member [mm].
  [[nodiscard]] double radius_1_mm(double l_mm) const;
  [[nodiscard]] double radius_2_mm(double l_mm) const;
  /// Reduced radius of curvature, 1 / (1/h_1 +- 1/h_2) [mm].
  [[nodiscard]] double curvature_radius_mm(double l_mm) const;
  [[nodiscard]] PitchSide side() const;
  /// Operating pitch radii [mm].
  [[nodiscard]] double pitch_radius_1_mm() const;
  [[nodiscard]] double pitch_radius_2_mm() const;
  /// j_t on the operating pitch circle; negative where teeth would overlap [mm].
  [[nodiscard]] double backlash_mm() const;
  /// j_bn on the line of action [mm].
  [[nodiscard]] double normal_backlash_mm() const;
  /// Least distance between the tip circle of one and the root circle of the other member [mm].
  [[nodiscard]] double tip_clearance_1_mm() const;  ///< tip of the driving member
  [[nodiscard]] double tip_clearance_2_mm() const;  ///< tip of the driven member
  /// Internal pairs: angle by which the tips pass one another outside the path of contact; negative where they
  /// collide (trochoid interference) [rad]. External pairs: +infinity.
  [[nodiscard]] double tip_passing_angle() const;
};

/// @throws DomainError when the pair cannot mesh at that distance
[[nodiscard]] Pair make_pair(const Tooth& driving, const Tooth& driven, double centre_distance_mm);

/// Centre distance without backlash [G-a0] [mm].
/// @throws DomainError when there is none
[[nodiscard]] double tight_centre_distance_mm(const Tooth& driving, const Tooth& driven);

/// Speeds at a contact, positive in the direction in which it moves along the path [m/s].
struct ContactSpeeds {
  double first, second;
  [[nodiscard]] double sliding() const { return first - second; }          ///< V_1 - V_2
  [[nodiscard]] double rolling() const { return 0.5 * (first + second); }  ///< V_e
};

/// @param base_speed  omega_1 r_b1 = omega_2 r_b2, relative to the carrier [m/s]
[[nodiscard]] ContactSpeeds contact_speeds(const Pair& pair, double l_mm, double base_speed);

}  // namespace epicyclic::gear
