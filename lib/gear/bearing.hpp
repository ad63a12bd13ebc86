// Rolling bearing: radial stiffness and force, and the inner geometry of some deep groove ball bearings.
//
//   k(d) = 32900 Z (D_w d cos^5 alpha)^(1/2)  [N/mm], lengths in mm: the tangent stiffness                [G-11]
//   F(d) = (2/3) k(d) d                       [N]: its integral
//   k(F) = 3400 Z^0.9 l^0.8 F^0.1             [N/mm], F in N, l in mm: rollers, tangent stiffness         [G-roller]
//
// Of rollers: Palmgren's line contact, 7.68e-5 mm Q^0.9 / l^0.8 for both contacts of the roller under the greatest load
// Q = 5 F / Z; Gargiulo, Machine Design 52 (1980) has the same as 0.3e6 lb/in. Without clearance, rings stiff.
//
// Source: Tang et al. 2020, Eq. (11), Table 3, from Palmgren's point contact (docs/theory/parameters.md, section 5;
// 32953 with all digits of the constants, 32900 as printed). Limits: d >= 0 is the elastic approach beyond the
// clearance. Smoothness: k is C0 at d = 0 with infinite slope there, F is C1.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "gear/stage.hpp"

namespace epicyclic::gear {

/// K of k(d) = K sqrt(d), d in metres. [N/m^1.5]
[[nodiscard]] double palmgren_coefficient(int balls, double ball_diameter_mm, double contact_angle_deg);

/// @throws DomainError when balls or their diameter are missing
[[nodiscard]] double palmgren_coefficient(const SunBearing& bearing);

/// k = K sqrt(d) at an approach d >= 0 [m], K by palmgren_coefficient() [N/m].
[[nodiscard]] double palmgren_stiffness(double coefficient, double approach_m);
/// F = k d at an approach d >= 0 [m] [N].
[[nodiscard]] double palmgren_force(double coefficient, double approach_m);

/// k of Z cylindrical rollers or needles of a length under a radial load, by [G-roller] [N/m].
[[nodiscard]] double roller_stiffness(double load_N, int rollers, double length_mm);

/// A deep groove ball bearing with what [G-11] needs.
struct BearingType {
  std::string_view designation;
  double bore_mm, outer_diameter_mm, width_mm;
  int balls;                ///< Z
  double ball_diameter_mm;  ///< D_w
  std::string_view origin;
};

/// All that are known here, rising. Makers differ in Z and D_w of one designation: give your own data where it matters.
[[nodiscard]] std::span<const BearingType> bearing_types();

/// @returns nothing for an unknown designation
[[nodiscard]] std::optional<BearingType> find_bearing(std::string_view designation);

/// What [G-11] needs of a bearing.
struct BearingData {
  std::string name;  ///< designation, or "own data"
  int balls = 0;
  double ball_diameter_mm = 0;
  double contact_angle_deg = 0;
  std::string origin;

  /// K [N/m^1.5].
  [[nodiscard]] double coefficient() const { return palmgren_coefficient(balls, ball_diameter_mm, contact_angle_deg); }
};

/// Own data if they are given, else those of the type; nothing for an unknown type.
[[nodiscard]] std::optional<BearingData> bearing_data(const SupportBearing& bearing);

}  // namespace epicyclic::gear
