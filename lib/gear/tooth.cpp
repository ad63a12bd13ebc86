#include "gear/tooth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/errors.hpp"
#include "core/root_finding.hpp"

namespace epicyclic::gear {

namespace {

constexpr double pi = std::numbers::pi;

std::string radii(const Tooth& t) {
  return "r_b " + std::to_string(t.base_radius_mm) + ", r_a " + std::to_string(t.tip_radius_mm) + ", r_f " +
         std::to_string(t.root_radius_mm) + " mm";
}

Tooth common(const GearData& d, bool internal) {
  if (d.teeth < 3 || !(d.module_mm > 0.0) || !(d.pressure_angle_deg > 0.0) || !(d.pressure_angle_deg < 90.0) ||
      !(d.width_mm > 0.0))
    throw DomainError("a tooth needs at least 3 teeth, a module, a pressure angle in (0, 90) deg and a width");
  Tooth t;
  t.internal = internal;
  t.teeth = d.teeth;
  t.module_mm = d.module_mm;
  t.pressure_angle = d.pressure_angle_deg * pi / 180.0;
  t.width_mm = d.width_mm;
  t.profile_shift = d.profile_shift;
  t.addendum_coefficient = d.addendum_coefficient;
  t.clearance_coefficient = d.clearance_coefficient;
  t.reference_radius_mm = 0.5 * d.module_mm * d.teeth;
  t.base_radius_mm = t.reference_radius_mm * std::cos(t.pressure_angle);
  const double sign = internal ? -1.0 : 1.0;
  t.base_half_angle = (0.5 * pi + sign * 2.0 * d.profile_shift * std::tan(t.pressure_angle)) / d.teeth +
                      sign * involute(t.pressure_angle);
  return t;
}

}  // namespace

double involute(double angle) { return std::tan(angle) - angle; }

double inverse_involute(double v) {
  if (!(v >= 0.0)) throw DomainError("the involute of an angle is not negative");
  // For small angles t - atan t loses its digits; the series in q = (3 v)^(1/3), from a^3/3 + 2 a^5/15 + ..., does not.
  constexpr double series_below = 1e-6;
  if (v < series_below) {
    const double q = std::cbrt(3.0 * v);
    const double square = q * q;
    return q * (1.0 + square * (-2.0 / 15.0 + square * (3.0 / 175.0 - square * 2.0 / 1575.0)));
  }
  // Newton in t = tan a of the convex g(t) = t - atan t - v, from above: it falls to the root without passing it.
  double t = std::cbrt(3.0 * v) + v + 0.5 * pi * (v > 1.0 ? 1.0 : 0.0);
  constexpr int iterations_max = 100;
  for (int k = 0; k < iterations_max; ++k) {
    const double step = (t - std::atan(t) - v) * (1.0 + 1.0 / (t * t));
    t -= step;
    if (!(std::abs(step) > 1e-16 * t)) break;
  }
  return std::atan(t);
}

double Tooth::base_pitch_mm() const { return 2.0 * pi * base_radius_mm / teeth; }

double Tooth::pressure_angle_at(double radius_mm) const {
  return radius_mm > base_radius_mm ? std::acos(base_radius_mm / radius_mm) : 0.0;
}

double Tooth::half_angle_at(double radius_mm) const {
  return base_half_angle + (internal ? 1.0 : -1.0) * involute(pressure_angle_at(radius_mm));
}

double Tooth::form_radius_mm() const {
  if (internal) return root_radius_mm;
  if (profile_shift < undercut_limit()) return undercut_radius_mm();
  const double sine = std::sin(pressure_angle);
  const double length = reference_radius_mm * sine - module_mm * (flank_depth() - profile_shift) / sine;
  return std::hypot(base_radius_mm, length);
}

double Tooth::undercut_radius_mm() const {
  const auto radius = [this](double gamma) { return std::hypot(fillet(gamma).x, fillet(gamma).y); };
  // From its foot, which is below the base circle, the fillet rises to the far branch of the involute.
  const double at_base =
      find_root([&](double gamma) { return radius(gamma) - base_radius_mm; }, pressure_angle, 0.5 * pi);
  const auto outside_of_the_involute = [&](double gamma) {
    const ProfilePoint p = fillet(gamma);
    return std::atan2(p.x, p.y) - half_angle_at(std::hypot(p.x, p.y));
  };
  // Next to the limit rounding decides between what is hardly undercut and what is not.
  if (!(outside_of_the_involute(at_base) < 0.0 && outside_of_the_involute(pressure_angle) > 0.0)) return base_radius_mm;
  return radius(find_root(outside_of_the_involute, pressure_angle, at_base));
}

double Tooth::undercut_limit() const {
  const double sine = std::sin(pressure_angle);
  return flank_depth() - 0.5 * teeth * sine * sine;
}

double Tooth::rack_depth() const { return (reference_radius_mm - root_radius_mm) / module_mm + profile_shift; }

double Tooth::rack_tip_width() const { return 0.5 * pi - 2.0 * rack_depth() * std::tan(pressure_angle); }

double Tooth::rounding_clearance() const {
  const double full_tip = 0.5 * rack_tip_width() * std::cos(pressure_angle);
  return std::max(0.0, std::min(clearance_coefficient, full_tip));
}

double Tooth::fillet_rounding_mm() const { return rounding_clearance() * module_mm / (1.0 - std::sin(pressure_angle)); }

Tooth::RackTip Tooth::rack_tip() const {
  const double rho = fillet_rounding_mm();
  return {module_mm * (rack_depth() - profile_shift) - rho,
          0.25 * pi * module_mm + flank_depth() * module_mm * std::tan(pressure_angle) + rho * std::cos(pressure_angle),
          rho};
}

ProfilePoint Tooth::fillet(double gamma) const {
  const auto [a_1, b_1, rho] = rack_tip();
  const double phi = (a_1 / std::tan(gamma) + b_1) / reference_radius_mm;
  const double reach = a_1 / std::sin(gamma) + rho;
  return {reference_radius_mm * std::sin(phi) - reach * std::cos(gamma - phi),
          reference_radius_mm * std::cos(phi) - reach * std::sin(gamma - phi)};
}

ProfilePoint Tooth::fillet_slope(double gamma) const {
  const auto [a_1, b_1, rho] = rack_tip();
  const double sine = std::sin(gamma);
  const double phi = (a_1 / std::tan(gamma) + b_1) / reference_radius_mm;
  const double phi_slope = -a_1 / (sine * sine) / reference_radius_mm;
  const double reach = a_1 / sine + rho;
  const double reach_slope = -a_1 * std::cos(gamma) / (sine * sine);
  const double rotation = 1.0 - phi_slope;
  return {reference_radius_mm * std::cos(phi) * phi_slope - reach_slope * std::cos(gamma - phi) +
              reach * std::sin(gamma - phi) * rotation,
          -reference_radius_mm * std::sin(phi) * phi_slope - reach_slope * std::sin(gamma - phi) -
              reach * std::cos(gamma - phi) * rotation};
}

Tooth external_tooth(const GearData& d, double tip_shortening) {
  Tooth t = common(d, false);
  const double m = d.module_mm;
  const double tip = t.reference_radius_mm + m * (d.addendum_coefficient + d.profile_shift - tip_shortening);
  const double root = t.reference_radius_mm - m * (d.addendum_coefficient + d.clearance_coefficient - d.profile_shift);
  t.tip_radius_mm = d.tip_diameter_mm ? 0.5 * *d.tip_diameter_mm : tip;
  t.root_radius_mm = d.root_diameter_mm ? 0.5 * *d.root_diameter_mm : root;
  if (!(t.root_radius_mm > 0.0) || !(t.tip_radius_mm > t.root_radius_mm) || !(t.tip_radius_mm > t.base_radius_mm))
    throw DomainError("an external tooth needs 0 < r_f < r_a and r_b < r_a (" + radii(t) + ")");
  return t;
}

Tooth internal_tooth(const GearData& d, double tip_shortening) {
  Tooth t = common(d, true);
  const double m = d.module_mm;
  const double tip = t.reference_radius_mm - m * (d.addendum_coefficient - d.profile_shift - tip_shortening);
  const double root = t.reference_radius_mm + m * (d.addendum_coefficient + d.clearance_coefficient + d.profile_shift);
  t.tip_radius_mm = d.tip_diameter_mm ? 0.5 * *d.tip_diameter_mm : tip;
  t.root_radius_mm = d.root_diameter_mm ? 0.5 * *d.root_diameter_mm : root;
  if (!(t.tip_radius_mm > 0.0) || !(t.root_radius_mm > t.tip_radius_mm) || !(t.tip_radius_mm > t.base_radius_mm))
    throw DomainError("an internal tooth needs 0 < r_a < r_f and r_b < r_a (" + radii(t) + ")");
  return t;
}

}  // namespace epicyclic::gear
