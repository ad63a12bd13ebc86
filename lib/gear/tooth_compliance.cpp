#include "gear/tooth_compliance.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "core/errors.hpp"
#include "core/quadrature.hpp"
#include "core/require.hpp"

namespace epicyclic::gear {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double m_per_mm = 1e-3;
// Rounding may put a contact at the tip a little beyond it.
constexpr double radius_rounding = 1e-9;

/// Bending, shear, axial, times E L.
using Energies = Eigen::Array3d;

double square(double x) { return x * x; }
double cube(double x) { return x * x * x; }

/// Sine and cosine of the direction of the force, one for all sections of a tooth.
struct Direction {
  explicit Direction(double angle) : cosine(std::cos(angle)), sine(std::sin(angle)) {}
  double cosine, sine;
};

/// [G-kb], [G-ks], [G-ka] at one angle of the involute of an external tooth.
Energies external_involute(double a, const Direction& alpha_1, double alpha_2, double nu) {
  const double rest = (alpha_2 - a) * std::cos(a);
  const double d = std::sin(a) + rest;
  const double lever = 1.0 + alpha_1.cosine * ((alpha_2 - a) * std::sin(a) - std::cos(a));
  return {3.0 * square(lever) * rest / (2.0 * cube(d)), 1.2 * (1.0 + nu) * rest * square(alpha_1.cosine) / d,
          rest * square(alpha_1.sine) / (2.0 * d)};
}

/// [G-kb], [G-ks], [G-ka] at a section of half thickness h and height y, per length of centre line; lengths over r_b.
Energies section(double y, double h, const Direction& alpha_1, double nu) {
  const double lever = 1.0 - y * alpha_1.cosine;
  return {1.5 * square(lever) / cube(h), 1.2 * (1.0 + nu) * square(alpha_1.cosine) / h, 0.5 * square(alpha_1.sine) / h};
}

/// Closed forms of the straight flank between base circle and root circle.
Energies straight_flank(const Tooth& t, double alpha_1, double nu) {
  const double alpha_2 = t.base_half_angle;
  const double half = std::sin(alpha_2);  // over r_b
  const double alpha_3 = std::asin(half * t.base_radius_mm / t.root_radius_mm);
  const double q = t.root_radius_mm * std::cos(alpha_3) / t.base_radius_mm;
  const double cosine = std::cos(alpha_1);
  const double length = std::cos(alpha_2) - q;
  // [(1 - q c)^3 - (1 - c cos alpha_2)^3] / (2 c sin^3 alpha_2), the difference of cubes as a product so that c = 0 is
  // no division by zero
  const double far = 1.0 - q * cosine;
  const double near = 1.0 - cosine * std::cos(alpha_2);
  return {length * (square(far) + far * near + square(near)) / (2.0 * cube(half)),
          1.2 * (1.0 + nu) * square(cosine) * length / half, square(std::sin(alpha_1)) * length / (2.0 * half)};
}

Energies internal_involute(double b, const Direction& b_c, double alpha_2, double nu) {
  const double rest = (b - alpha_2) * std::cos(b);
  const double d = std::sin(b) - rest;
  const double lever = b_c.cosine * (std::cos(b) + (b - alpha_2) * std::sin(b)) - 1.0;
  return {3.0 * square(lever) * rest / (2.0 * cube(d)), 1.2 * (1.0 + nu) * rest * square(b_c.cosine) / d,
          rest * square(b_c.sine) / (2.0 * d)};
}

Energies external_energies(const Tooth& t, double tan_contact, double alpha_1, double nu, const ComplianceOptions& o) {
  const GaussLegendre& rule = gauss_legendre_16();
  const double alpha_2 = t.base_half_angle;
  const Direction force(alpha_1);
  const auto involute_to = [&](double end) {
    return rule.integrate([&](double a) { return external_involute(a, force, alpha_2, nu); }, -alpha_1, end, o.panels);
  };
  const auto angle_at = [&](double radius) { return alpha_2 - std::sqrt(square(radius / t.base_radius_mm) - 1.0); };
  if (o.fillet == Fillet::none) {
    if (t.root_radius_mm >= t.base_radius_mm) return involute_to(angle_at(t.root_radius_mm));
    return involute_to(alpha_2) + straight_flank(t, alpha_1, nu);
  }
  if (t.profile_shift < t.undercut_limit())
    throw DomainError("the fillet of an undercut tooth does not join its involute");
  const double form = t.form_radius_mm();
  if (std::hypot(1.0, tan_contact) * t.base_radius_mm < form * (1.0 - radius_rounding))
    throw DomainError("contact below the end of the involute, on the fillet");
  const Energies fillet = rule.integrate(
      [&](double gamma) -> Energies {
        const ProfilePoint at = t.fillet(gamma);
        const double slope = std::abs(t.fillet_slope(gamma).y) / t.base_radius_mm;
        return slope * section(at.y / t.base_radius_mm, at.x / t.base_radius_mm, force, nu);
      },
      t.pressure_angle, 0.5 * pi, o.panels);
  return involute_to(angle_at(form)) + fillet;
}

/// [G-kf] times E L.
double external_foundation(const ToothBody& body, double alpha_1, double contact_height_mm,
                           const ComplianceOptions& o) {
  const Tooth& t = body.tooth;
  const double theta = body.root_half_angle.value_or(root_half_angle(t, o.fillet));
  const SainsotCoefficients c = sainsot_coefficients(theta, body.radius_ratio);
  const double foot = 2.0 * t.root_radius_mm * theta;
  const double height =
      o.lever == FoundationLever::centreline ? t.base_radius_mm / std::cos(alpha_1) : contact_height_mm;
  const double ratio = (height - t.root_radius_mm) / foot;
  return square(std::cos(alpha_1)) *
         (c.l * square(ratio) + c.m * ratio + c.p * (1.0 + c.q * square(std::tan(alpha_1))));
}

/// [G-kfr] times E L.
double ring_foundation(const ToothBody& body, double b_c) {
  const Tooth& t = body.tooth;
  const double nu = body.material.poisson_ratio;
  const double theta = body.root_half_angle.value_or(root_half_angle(t, Fillet::none));
  const double thickness = 2.0 * t.root_radius_mm * std::sin(theta);
  const double lever = t.root_radius_mm * std::cos(theta) - t.base_radius_mm / std::cos(b_c);
  const double ratio = lever / thickness;
  return square(std::cos(b_c)) * (1.0 - nu * nu) *
         (5.306 * square(ratio) + 2.0 * (1.0 - nu - 2.0 * nu * nu) / (1.0 - nu * nu) * ratio +
          1.534 * (1.0 + 0.4167 * square(std::tan(b_c)) / (1.0 + nu)));
}

}  // namespace

double root_half_angle(const Tooth& t, Fillet fillet) {
  if (t.internal) return t.half_angle_at(t.root_radius_mm);
  if (fillet == Fillet::trochoid) {
    const ProfilePoint foot = t.fillet(0.5 * pi);
    return std::atan2(foot.x, foot.y);
  }
  if (t.root_radius_mm >= t.base_radius_mm) return t.half_angle_at(t.root_radius_mm);
  return std::asin(t.base_radius_mm * std::sin(t.base_half_angle) / t.root_radius_mm);
}

SainsotCoefficients sainsot_coefficients(double theta_f, double radius_ratio) {
  const double theta = theta_f;
  const double h = radius_ratio;
  struct Row {
    double a, b, c, d, e, f;
  };
  constexpr Row l{-5.574e-5, -1.9986e-3, -2.3015e-4, 4.7702e-3, 0.0271, 6.8045};
  constexpr Row m{60.111e-5, 28.100e-3, -83.431e-4, -9.9256e-3, 0.1624, 0.9086};
  constexpr Row p{-50.952e-5, 185.50e-3, 0.0538e-4, 53.300e-3, 0.2895, 0.9236};
  constexpr Row q{-6.2042e-5, 9.0889e-3, -4.0964e-4, 7.8297e-3, -0.1472, 0.6904};
  const auto value = [&](const Row& r) {
    return r.a / square(theta) + r.b * square(h) + r.c * h / theta + r.d / theta + r.e * h + r.f;
  };
  return {value(l), value(m), value(p), value(q), h >= 1.4 && h <= 7.0 && theta >= 0.01 && theta <= 0.12};
}

double hertz_compliance(const Material& material, double width_mm) {
  const double nu = material.poisson_ratio;
  return 4.0 * (1.0 - nu * nu) / (pi * material.youngs_modulus() * width_mm * m_per_mm);
}

void ComplianceOptions::validate() const { require(panels >= 1, "panels", panels, ">= 1"); }

ToothCompliance tooth_compliance(const ToothBody& body, double contact_radius_mm, const ComplianceOptions& o) {
  o.validate();
  const Tooth& t = body.tooth;
  const double nu = body.material.poisson_ratio;
  const double outer = t.internal ? t.root_radius_mm : t.tip_radius_mm;
  const double inner = t.internal ? t.tip_radius_mm : std::max(t.base_radius_mm, t.root_radius_mm);
  if (!(contact_radius_mm >= inner * (1.0 - radius_rounding)) ||
      !(contact_radius_mm <= outer * (1.0 + radius_rounding)))
    throw DomainError("the contact is not on the flank of the tooth");
  const double per_unit = 1.0 / (body.material.youngs_modulus() * t.width_mm * m_per_mm);
  const double tan_contact = std::tan(t.pressure_angle_at(contact_radius_mm));
  Energies energies;
  double foundation = 0.0;
  if (t.internal) {
    const double alpha_2 = t.base_half_angle;
    const double b_c = tan_contact + alpha_2;
    const double b_f = std::sqrt(square(t.root_radius_mm / t.base_radius_mm) - 1.0) + alpha_2;
    const Direction force(b_c);
    energies = gauss_legendre_16().integrate([&](double b) { return internal_involute(b, force, alpha_2, nu); }, b_c,
                                             b_f, o.panels);
    if (o.ring_foundation == RingFoundation::half_plane) foundation = ring_foundation(body, b_c);
  } else {
    const double alpha_1 = tan_contact - t.base_half_angle;
    energies = external_energies(t, tan_contact, alpha_1, nu, o);
    const double height = t.base_radius_mm * (std::cos(alpha_1) + tan_contact * std::sin(alpha_1));
    foundation = external_foundation(body, alpha_1, height, o);
  }
  return {o.bending ? energies[0] * per_unit : 0.0, o.shear ? energies[1] * per_unit : 0.0,
          o.axial ? energies[2] * per_unit : 0.0, o.foundation ? foundation * per_unit : 0.0};
}

}  // namespace epicyclic::gear
