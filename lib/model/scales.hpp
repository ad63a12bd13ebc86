// SI to dimensionless and back: the only place.
//
//   omega_sn = sqrt( k_sp (1/m_es + 1/m_ep) ) ,  m_e = I / r_b^2 , k_sp the mean stiffness               [M-23]
//   tau = omega_sn t ,  X_bar = X / b_c ,  b_c = 1e-5 m                                                  [M-24]
//   masses are divided by m_0 = 1 / (1/m_es + 1/m_ep), stiffnesses by m_0 omega_sn^2 (so the mean k_sp is 1),
//   damping by m_0 omega_sn, forces by m_0 omega_sn^2 b_c
//
// Source: Tang et al. 2020, Eqs. (23)-(25); b_c is printed as 1e-5 mm, but Fig. 16's thresholds and Table 4's 40 um = 4
// need 1e-5 m (docs/theory/model.md, section 5). Limits: k_sp > 0.
#pragma once

#include "gear/stage.hpp"

namespace epicyclic::model {

inline constexpr double length_scale_m = 1e-5;  ///< b_c [m]

struct Scales {
  double omega_sn = 0;  ///< [rad/s]
  double mass = 0;      ///< m_0 [kg]

  [[nodiscard]] double displacement(double metre) const { return metre / length_scale_m; }
  [[nodiscard]] double mass_ratio(double kg) const { return kg / mass; }
  [[nodiscard]] double stiffness(double newton_per_m) const { return newton_per_m / (mass * omega_sn * omega_sn); }
  [[nodiscard]] double damping(double newton_s_per_m) const { return newton_s_per_m / (mass * omega_sn); }
  [[nodiscard]] double force(double newton) const { return newton / (mass * omega_sn * omega_sn * length_scale_m); }
  /// Coefficient of a force K d^(3/2) [N/m^1.5].
  [[nodiscard]] double hertz(double newton_per_m_1_5) const;

  [[nodiscard]] double displacement_um(double dimensionless) const { return dimensionless * length_scale_m * 1e6; }
  [[nodiscard]] double force_newton(double dimensionless) const {
    return dimensionless * mass * omega_sn * omega_sn * length_scale_m;
  }
};

/// Scales of a stage, [M-23] and [M-24]. A sweep that changes a number of the stage keeps those of the stage as given.
[[nodiscard]] Scales scales_of(const gear::Stage& stage);

}  // namespace epicyclic::model
