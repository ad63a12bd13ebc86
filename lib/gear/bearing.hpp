// Rolling bearing: radial stiffness and force, and the inner geometry and load ratings of some bearings.
//
//   k(d) = 32900 Z (D_w d cos^5 alpha)^(1/2)  [N/mm], lengths in mm: the tangent stiffness                [G-11]
//   F(d) = (2/3) k(d) d                       [N]: its integral
//   k(F) = 3400 Z^0.9 l^0.8 F^0.1             [N/mm], F in N, l in mm: rollers, tangent stiffness         [G-roller]
//   F(d) = (Z/5) (d l^0.8 / 7.68e-5)^(10/9)   [N], d and l in mm: the same law of rollers, inverted
//
// Of rollers: Palmgren's line contact, 7.68e-5 mm Q^0.9 / l^0.8 for both contacts of the roller under the greatest load
// Q = 5 F / Z; Gargiulo, Machine Design 52 (1980) has the same as 0.3e6 lb/in. Without clearance, rings stiff.
//
// Source: Tang et al. 2020, Eq. (11), Table 3, from Palmgren's point contact (docs/theory/parameters.md, section 5;
// 32953 with all digits of the constants, 32900 as printed). Limits: d >= 0 is the elastic approach beyond the
// clearance. Smoothness: k of balls is C0 at d = 0 with infinite slope there, F is C1; k of rollers likewise.
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

/// F of the same at an approach d >= 0 [m] [N].
[[nodiscard]] double roller_force(double approach_m, int rollers, double length_mm);

/// A bearing of one row with what its stiffness and its life need.
struct BearingType {
  std::string_view designation;
  double bore_mm, outer_diameter_mm, width_mm;
  int elements;                ///< Z, number of balls or rollers
  double diameter_mm;          ///< D_w, of a ball or roller
  double length_mm;            ///< l, effective length of a roller; 0 of balls
  double dynamic_rating_kN;    ///< C
  double static_rating_kN;     ///< C0
  std::string_view origin;     ///< of Z, D_w and l
  std::string_view ratings{};  ///< origin of C and C0

  [[nodiscard]] bool has_balls() const { return length_mm == 0.0; }
};

/// All that are known here, rising: deep groove ball bearings 60, 62, 63, cylindrical roller bearings NU 2 and NU 3,
/// needle roller bearings NA 49, full complement cylindrical roller bearings NCF 30. Makers differ in Z, D_w and l of
/// one designation: give your own data where it matters.
[[nodiscard]] std::span<const BearingType> bearing_types();

/// @returns nothing for an unknown designation
[[nodiscard]] std::optional<BearingType> find_bearing(std::string_view designation);

/// What the stiffness and the life of a bearing need.
struct BearingData {
  std::string name;  ///< designation, or "own data"
  RollingElements kind = RollingElements::balls;
  int elements = 0;                           ///< Z
  double ball_diameter_mm = 0;                ///< of balls
  double contact_angle_deg = 0;               ///< of balls
  double roller_length_mm = 0;                ///< of rollers
  std::optional<double> dynamic_rating_kN{};  ///< C of a type
  std::string origin;
  std::string ratings{};  ///< origin of C

  /// Tangent stiffness [N/m] and radial force [N] at an approach d >= 0 [m].
  [[nodiscard]] double stiffness(double approach_m) const;
  [[nodiscard]] double force(double approach_m) const;
};

/// Own data if they are given, else those of the type; nothing for an unknown type.
[[nodiscard]] std::optional<BearingData> bearing_data(const SupportBearing& bearing);

}  // namespace epicyclic::gear
