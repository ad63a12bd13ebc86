// The tooth of an involute spur gear, external or internal, with profile shift.
//
//   r = m z / 2 ,  r_b = r cos alpha_0 ,  inv a = tan a - a                                             [G-inv]
//   external  r_a = r + m (h_a + x - k) ,  r_f = r - m (h_a + c - x) ,
//             half tooth angle at r_b:  alpha_2 = (pi/2 + 2 x tan alpha_0) / z + inv alpha_0
//   internal  r_a = r - m (h_a - x - k) ,  r_f = r + m (h_a + c + x) ,
//             alpha_2 = (pi/2 - 2 x tan alpha_0) / z - inv alpha_0  (may be negative)                   [G-tooth]
//   half tooth angle at radius R, pressure angle a:  external alpha_2 - inv a ,  internal alpha_2 + inv a
//   involute begins at  r_F^2 = r_b^2 + (r sin alpha_0 - m (h_F - x) / sin alpha_0)^2  (rack-cut)          [G-form]
//     of an undercut tooth, x < h_F - z sin^2 alpha_0 / 2, where the fillet crosses the involute
//   rack-cut fillet, rounding rho = c' m / (1 - sin alpha_0), pi/2 >= gamma >= alpha_0:                   [G-fillet]
//     phi = (a_1 / tan gamma + b_1) / r ,  a_1 = m (h_F + c' - x) - rho ,  b_1 = pi m / 4 + h_F m tan alpha_0
//           + rho cos alpha_0
//     c' = min(c, (pi/4 - h_t tan alpha_0) cos alpha_0) ,  h_t = (r - r_f)/m + x = h_a + c ,  h_F = h_t - c'
//     X = r sin phi - (a_1 / sin gamma + rho) cos(gamma - phi) ,  Y = r cos phi - (a_1 / sin gamma + rho) sin(gamma -
//     phi)
//
// The second bound on c' is that of a full tip radius, the widest that the rack's tooth has room for (at 25 degrees
// c = 0.25 would need more). k is the tip shortening. Lengths in mm, angles in rad. Source: DIN 3960 and any textbook;
// x is positive where it makes the external tooth, and the ring's space, thicker. The fillet is derived from the
// rolling rack (Litvin; Ma et al., Eng. Failure Analysis 2014). Limits: spur gears, involute flanks, rack-cut external
// teeth. Smoothness: analytic on each of flank and fillet, which join with a common tangent at r_F.
#pragma once

#include <optional>

namespace epicyclic::gear {

enum class ReliefShape { linear, parabolic, circular };

/// Material taken off a flank towards the tip or the root [G-relief, gear/loaded_contact.hpp].
struct Relief {
  double amount_um = 0;  ///< at the tip circle, or at the lowest point of contact [um]
  ReliefShape shape = ReliefShape::linear;
  std::optional<double> start_diameter_mm{};  ///< where it starts, by the diameter ...
  std::optional<double> start_roll_mm{};      ///< ... or by the length of roll, sqrt(r^2 - r_b^2)
};

/// A gear as its drawing gives it.
struct GearData {
  int teeth = 0;                           ///< z
  double module_mm = 0;                    ///< m
  double pressure_angle_deg = 20;          ///< alpha_0 of the reference profile
  double profile_shift = 0;                ///< x [-]
  double addendum_coefficient = 1;         ///< h_a* [-]
  double clearance_coefficient = 0.25;     ///< c* [-]
  double width_mm = 0;                     ///< face width
  std::optional<double> tip_diameter_mm;   ///< decides over coefficients and shortening
  std::optional<double> root_diameter_mm;  ///< decides over coefficients
  std::optional<Relief> tip_relief{}, root_relief{};
  std::optional<double> crowning_um{};  ///< parabolic, over the whole face width [um]

  [[nodiscard]] bool is_modified() const { return tip_relief || root_relief || crowning_um; }
};

/// tan a - a
[[nodiscard]] double involute(double angle);

/// The angle in [0, pi/2) whose involute is v >= 0.
/// @throws DomainError for v < 0
[[nodiscard]] double inverse_involute(double v);

/// Point of a profile in the tooth's own frame, y along its centre line from the gear's axis outwards, x across. [mm]
struct ProfilePoint {
  double x, y;
};

struct Tooth {
  bool internal = false;
  int teeth = 0;
  double module_mm = 0, pressure_angle = 0, width_mm = 0;  ///< of the reference profile; [mm], [rad], [mm]
  double profile_shift = 0, addendum_coefficient = 0, clearance_coefficient = 0;
  double reference_radius_mm = 0, base_radius_mm = 0, tip_radius_mm = 0, root_radius_mm = 0;
  double base_half_angle = 0;  ///< alpha_2 [rad]

  [[nodiscard]] double base_pitch_mm() const;
  /// Pressure angle of the involute at a radius; 0 inside the base circle [rad].
  [[nodiscard]] double pressure_angle_at(double radius_mm) const;
  /// Half of the angle that the tooth takes at a radius [rad].
  [[nodiscard]] double half_angle_at(double radius_mm) const;
  /// Tooth thickness on the arc of a radius [mm].
  [[nodiscard]] double thickness_at(double radius_mm) const { return 2.0 * radius_mm * half_angle_at(radius_mm); }

  /// Radius at which a rack-cut involute begins, of an undercut tooth what is left of it [mm]; external teeth, else the
  /// root radius.
  [[nodiscard]] double form_radius_mm() const;
  /// Least profile shift without undercut, h_F - z sin^2 alpha_0 / 2 [-]; external teeth.
  [[nodiscard]] double undercut_limit() const;
  /// Depth of the rack's tip below its reference line, h_a + c unless a root circle is given [modules].
  [[nodiscard]] double rack_depth() const;
  /// How much of its pitch the rack is wide at its tip; negative where its flanks meet before it [modules].
  [[nodiscard]] double rack_tip_width() const;
  /// Clearance c' that the rack's rounding takes: c, or less where a full tip radius is all that fits [modules].
  [[nodiscard]] double rounding_clearance() const;
  /// Depth of the rack's straight flank, h_F [modules].
  [[nodiscard]] double flank_depth() const { return rack_depth() - rounding_clearance(); }
  /// Rounding of the rack's tip, rho [mm].
  [[nodiscard]] double fillet_rounding_mm() const;
  /// Point of the rack-cut fillet [G-fillet] at gamma in [alpha_0, pi/2] [mm].
  [[nodiscard]] ProfilePoint fillet(double gamma) const;
  /// d/d gamma of fillet().
  [[nodiscard]] ProfilePoint fillet_slope(double gamma) const;

 private:
  /// Centre of the rack's rounding, a_1 below the pitch line and b_1 from the tooth's centre, and rho [mm].
  struct RackTip {
    double a_1, b_1, rho;
  };
  [[nodiscard]] RackTip rack_tip() const;
  [[nodiscard]] double undercut_radius_mm() const;
};

/// @throws DomainError when the data make no tooth (tip below root, module not positive, ...)
/// @param tip_shortening  k [-], in modules
[[nodiscard]] Tooth external_tooth(const GearData& data, double tip_shortening = 0);
[[nodiscard]] Tooth internal_tooth(const GearData& data, double tip_shortening = 0);

}  // namespace epicyclic::gear
