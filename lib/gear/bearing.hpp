// Rolling bearing, radial stiffness and force.
//
//   k(d) = 32900 Z (D_w d cos^5 alpha)^(1/2)  [N/mm], lengths in mm: the tangent stiffness                [G-11]
//   F(d) = (2/3) k(d) d                       [N]: its integral
//
// Source: Tang et al. 2020, Eq. (11), Table 3, from Palmgren's point contact (parameters.md section 5; 32953 when the
// constants are carried to all digits, 32900 as printed). Limits: d >= 0 is the elastic approach beyond the clearance.
// Smoothness: k is C0 at d = 0 with infinite slope there, F is C1.
#pragma once

#include <cmath>
#include <numbers>

#include "core/errors.hpp"
#include "gear/stage.hpp"

namespace epicyclic::gear {

/// K of k(d) = K sqrt(d), d in metres. [N/m^1.5]
/// @throws DomainError when balls or their diameter are missing
[[nodiscard]] inline double palmgren_coefficient(const SunBearing& bearing) {
  if (!bearing.balls || !bearing.ball_diameter_mm) throw DomainError("Eq. (11) needs balls and ball_diameter_mm");
  constexpr double newton_per_mm_1_5 = 32900.0;
  constexpr double mm_per_m = 1e3;
  const double cosine = std::cos(bearing.contact_angle_deg * std::numbers::pi / 180.0);
  const double per_mm = newton_per_mm_1_5 * *bearing.balls * std::sqrt(*bearing.ball_diameter_mm * std::pow(cosine, 5));
  return per_mm * mm_per_m * std::sqrt(mm_per_m);
}

}  // namespace epicyclic::gear
