#include "gear/tooth_compliance.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/root_finding.hpp"
#include "gear/gear_set.hpp"
#include "gear/pair.hpp"
#include "problems/table1.hpp"

namespace epicyclic::gear::tooth_compliance_test {
namespace {

using problems::degree;
constexpr double pi = std::numbers::pi;

/// Double exponential quadrature: to rounding also where f has a branch point at an end, as the flank's thickness over
/// its height has at the base circle.
double integral(const std::function<double(double)>& f, double a, double b) {
  constexpr double step = 1.0 / 32.0;
  const double half = 0.5 * (b - a);
  double sum = 0.0;
  for (int k = -110; k <= 110; ++k) {
    const double t = step * k;
    const double u = 0.5 * pi * std::sinh(t);
    // Distance from the nearer end, without cancellation: 1 - tanh u = 2 / (1 + exp 2u).
    const double from_end = 2.0 * half / (1.0 + std::exp(2.0 * std::abs(u)));
    const double weight = half * 0.5 * pi * std::cosh(t) / (std::cosh(u) * std::cosh(u));
    if (!(std::abs(from_end) > 1e-17 * std::abs(half)) || !(std::abs(weight) > 0.0)) continue;
    sum += weight * f(t < 0.0 ? a + from_end : b - from_end);
  }
  return step * sum;
}

/// A tooth as a cantilever of half thickness h(y), brute force: mm, N, MPa; compliances in m/N like the library's.
struct Cantilever {
  std::function<double(double)> half_thickness;
  std::vector<double> heights;  ///< from the root to the contact or from the contact to the root, broken where h kinks
  double contact_height, contact_half, force_angle;

  [[nodiscard]] ToothCompliance compliance(const Material& material, double width) const {
    const double e = material.youngs_modulus_GPa * 1e3;
    const double g = e / (2.0 * (1.0 + material.poisson_ratio));
    const double across = std::cos(force_angle);
    const double along = std::sin(force_angle);
    ToothCompliance c;
    for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
      const auto piece = [&](const std::function<double(double, double)>& density) {
        return std::abs(integral([&](double y) { return density(y, half_thickness(y)); }, heights[k], heights[k + 1]));
      };
      c.bending += piece([&](double y, double h) {
        const double moment = across * std::abs(contact_height - y) - along * contact_half;
        const double second_moment = width * std::pow(2.0 * h, 3) / 12.0;
        return moment * moment / (e * second_moment);
      });
      c.shear += piece([&](double, double h) { return 1.2 * across * across / (g * width * 2.0 * h); });
      c.axial += piece([&](double, double h) { return along * along / (e * width * 2.0 * h); });
    }
    constexpr double m_per_mm = 1e-3;
    c.bending *= m_per_mm;
    c.shear *= m_per_mm;
    c.axial *= m_per_mm;
    return c;
  }
};

ProfilePoint on_flank(const Tooth& t, double radius) {
  const double half = t.half_angle_at(radius);
  return {radius * std::sin(half), radius * std::cos(half)};
}

/// Half thickness of the involute at a height, by the radius whose point has that height.
double involute_at(const Tooth& t, double height, double low, double high) {
  const double low_height = on_flank(t, low).y;
  const double high_height = on_flank(t, high).y;
  if (height <= low_height) return on_flank(t, low).x;
  if (height >= high_height) return on_flank(t, high).x;
  return on_flank(t, find_root([&](double r) { return on_flank(t, r).y - height; }, low, high)).x;
}

Cantilever external_cantilever(const Tooth& t, double radius, Fillet fillet) {
  Cantilever c;
  const ProfilePoint contact = on_flank(t, radius);
  c.contact_height = contact.y;
  c.contact_half = contact.x;
  // The force is normal to the flank: its angle to the line across the tooth is the pressure angle less the half angle.
  c.force_angle = t.pressure_angle_at(radius) - t.half_angle_at(radius);
  if (fillet == Fillet::trochoid) {
    const double form = t.form_radius_mm();
    const double joint = on_flank(t, form).y;
    const double foot = t.fillet(0.5 * pi).y;
    c.heights = {foot, joint, contact.y};
    c.half_thickness = [=](double y) {
      if (y >= joint) return involute_at(t, y, form, radius);
      if (y <= foot) return t.fillet(0.5 * pi).x;
      const double gamma = find_root([&](double g) { return t.fillet(g).y - y; }, t.pressure_angle, 0.5 * pi);
      return t.fillet(gamma).x;
    };
    return c;
  }
  const double lowest = std::max(t.root_radius_mm, t.base_radius_mm);
  const ProfilePoint end = on_flank(t, lowest);
  c.heights = {end.y, contact.y};
  if (t.root_radius_mm < t.base_radius_mm)
    c.heights.insert(c.heights.begin(), std::sqrt(t.root_radius_mm * t.root_radius_mm - end.x * end.x));
  c.half_thickness = [=](double y) { return y <= end.y ? end.x : involute_at(t, y, lowest, radius); };
  return c;
}

Cantilever internal_cantilever(const Tooth& t, double radius) {
  Cantilever c;
  const ProfilePoint contact = on_flank(t, radius);
  c.contact_height = contact.y;
  c.contact_half = contact.x;
  c.force_angle = t.pressure_angle_at(radius) + t.half_angle_at(radius);
  c.heights = {contact.y, on_flank(t, t.root_radius_mm).y};
  c.half_thickness = [=](double y) { return involute_at(t, y, radius, t.root_radius_mm); };
  return c;
}

// The source's claim for its own check, and more than the brute force needs.
constexpr double brute_force = 1e-8;

void expect_same(const ToothBody& body, double radius, const ComplianceOptions& o, const std::string& where) {
  const Tooth& t = body.tooth;
  const Cantilever c = t.internal ? internal_cantilever(t, radius) : external_cantilever(t, radius, o.fillet);
  const ToothCompliance expected = c.compliance(body.material, t.width_mm);
  const ToothCompliance got = tooth_compliance(body, radius, o);
  const auto tolerance = [](double value) { return brute_force * value; };
  EXPECT_NEAR(got.bending, expected.bending, tolerance(expected.bending)) << where << " at " << radius;
  EXPECT_NEAR(got.shear, expected.shear, tolerance(expected.shear)) << where << " at " << radius;
  EXPECT_NEAR(got.axial, expected.axial, tolerance(expected.axial)) << where << " at " << radius;
}

/// Radii from just above the lowest to the tip.
std::vector<double> contacts(const Tooth& t, double lowest) {
  std::vector<double> r;
  for (const double share : {0.02, 0.3, 0.6, 0.9, 1.0}) r.push_back(lowest + share * (t.tip_radius_mm - lowest));
  return r;
}

GearSet table1() {
  Stage s = problems::table1();
  s.catalogue->stiffness.harmonics = 0;
  return make_gear_set(s);
}

const Material steel;

TEST(ToothCompliance, IsThatOfABruteForceCantileverWithTheRootOutsideTheBaseCircle) {
  const GearSet g = table1();
  for (const Tooth* t : {&g.sun, &g.planet}) {
    ASSERT_GT(t->root_radius_mm, t->base_radius_mm);
    for (const double radius : contacts(*t, t->root_radius_mm))
      expect_same({*t, steel, 2.0, {}}, radius, {}, std::to_string(t->teeth));
  }
}

TEST(ToothCompliance, IsThatOfABruteForceCantileverWithTheRootInsideTheBaseCircle) {
  for (const int teeth : {19, 30}) {
    const Tooth t = external_tooth({teeth, 3.175, 20, 0, 1, 0.25, 16, {}, {}});
    ASSERT_LT(t.root_radius_mm, t.base_radius_mm);
    for (const double radius : contacts(t, t.base_radius_mm))
      expect_same({t, {206.8, 0.3, 7850}, 2.0, {}}, radius, {}, std::to_string(teeth));
  }
}

TEST(ToothCompliance, IsThatOfABruteForceCantileverWithTheRacksFillet) {
  const GearSet g = table1();
  ComplianceOptions o;
  o.fillet = Fillet::trochoid;
  const Tooth standard = external_tooth({62, 2, 20, 0, 1, 0.25, 20, {}, {}});
  const Tooth few = external_tooth({19, 3.175, 20, 0, 1, 0.25, 16, {}, {}});
  for (const Tooth* t : {&g.sun, &g.planet, &standard, &few})
    for (const double radius : contacts(*t, t->form_radius_mm()))
      expect_same({*t, steel, 2.0, {}}, radius, o, std::to_string(t->teeth) + " with fillet");
}

TEST(ToothCompliance, IsThatOfABruteForceCantileverForTheRing) {
  const GearSet g = table1();
  const Tooth standard = internal_tooth({72, 2, 20, 0, 0.8, 0.25, 20, {}, {}});
  for (const Tooth* t : {&g.ring, &standard})
    for (const double radius : contacts(*t, t->root_radius_mm)) {
      if (radius > 0.5 * (t->root_radius_mm + t->tip_radius_mm)) {
        expect_same({*t, steel, 2.0, {}}, radius, {}, "ring");
      }
      expect_same({*t, steel, 2.0, {}}, t->tip_radius_mm, {}, "ring at its tip");
    }
}

TEST(ToothCompliance, TeethOfTable1AreAsPrinted) {
  // docs/theory/gears.md, section 9.5, to five digits; mm/N there. The planet's foundation is printed for h_f = 1.44,
  // its bore of 44 mm gives 1.4375.
  struct Row {
    ToothBody body;
    double radius, bending, shear, axial, foundation;
    double bending_digit, shear_digit, axial_digit, foundation_digit;
  };
  const GearSet g = table1();
  ToothBody planet = g.sun_planet.driven;
  constexpr double second_digit = 0.5e-2;  // half a unit of it
  EXPECT_NEAR(planet.radius_ratio, 1.44, second_digit);
  planet.radius_ratio = 1.44;
  const Row rows[] = {
      {g.sun_planet.driving, 37.24, 1.8637e-8, 1.2879e-7, 1.0802e-8, 2.7478e-7, 1e-12, 1e-11, 1e-12, 1e-11},
      {planet, 34.48, 8.9797e-9, 1.0427e-7, 8.2328e-9, 2.0283e-7, 1e-13, 1e-11, 1e-13, 1e-11},
      {g.ring_planet.driven, 105.5, 6.3583e-8, 1.9599e-7, 1.3157e-8, 2.1589e-7, 1e-12, 1e-11, 1e-12, 1e-11},
  };
  constexpr double half = 0.5001;
  constexpr double mm_per_m = 1e3;
  for (const Row& r : rows) {
    const ToothCompliance c = tooth_compliance(r.body, r.radius, {});
    EXPECT_NEAR(c.bending * mm_per_m, r.bending, half * r.bending_digit) << r.radius;
    EXPECT_NEAR(c.shear * mm_per_m, r.shear, half * r.shear_digit) << r.radius;
    EXPECT_NEAR(c.axial * mm_per_m, r.axial, half * r.axial_digit) << r.radius;
    EXPECT_NEAR(c.foundation * mm_per_m, r.foundation, half * r.foundation_digit) << r.radius;
  }
  constexpr double sixth_digit = 0.5e-6;  // half a unit of it
  EXPECT_NEAR(g.ring.base_half_angle, -0.011656, sixth_digit);
}

TEST(ToothCompliance, DefaultPanelsAreConvergedToRounding) {
  const GearSet g = table1();
  ComplianceOptions many;
  many.panels = 64;
  // Sums of some hundred terms of one sign, and the cancellation of the lever near the contact.
  constexpr double rounding = 1e-13;
  struct Case {
    Tooth tooth;
    Fillet fillet;
    double lowest;
  };
  const Tooth few = external_tooth({19, 3.175, 20, 0, 1, 0.25, 16, {}, {}});
  const Case cases[] = {{g.sun, Fillet::none, g.sun.root_radius_mm},
                        {g.sun, Fillet::trochoid, g.sun.form_radius_mm()},
                        {few, Fillet::none, few.base_radius_mm},
                        {few, Fillet::trochoid, few.form_radius_mm()},
                        {g.ring, Fillet::none, 0.5 * (g.ring.tip_radius_mm + g.ring.root_radius_mm)}};
  for (const Case& k : cases)
    for (const double radius : contacts(k.tooth, k.lowest)) {
      ComplianceOptions few_panels;
      few_panels.fillet = many.fillet = k.fillet;
      const ToothBody body{k.tooth, steel, 2.0, {}};
      const ToothCompliance a = tooth_compliance(body, radius, few_panels);
      const ToothCompliance b = tooth_compliance(body, radius, many);
      // At the root circle itself bending is all cancellation.
      EXPECT_NEAR(a.bending, b.bending, rounding * (b.bending + b.shear)) << k.tooth.teeth << " " << radius;
      EXPECT_NEAR(a.shear, b.shear, rounding * b.shear) << k.tooth.teeth << " " << radius;
      EXPECT_NEAR(a.axial, b.axial, rounding * b.axial) << k.tooth.teeth << " " << radius;
    }
}

TEST(ToothCompliance, SwitchesLeaveTheirPartOut) {
  const GearSet g = table1();
  for (const ToothBody* body : {&g.sun_planet.driving, &g.ring_planet.driven}) {
    const double radius = body->tooth.internal ? 105.5 : 37.24;
    const ToothCompliance all = tooth_compliance(*body, radius, {});
    EXPECT_EQ(all.sum(), all.bending + all.shear + all.axial + all.foundation);
    ComplianceOptions o;
    o.bending = false;
    EXPECT_EQ(tooth_compliance(*body, radius, o).bending, 0.0);
    EXPECT_EQ(tooth_compliance(*body, radius, o).shear, all.shear);
    o = {};
    o.shear = false;
    EXPECT_EQ(tooth_compliance(*body, radius, o).shear, 0.0);
    EXPECT_EQ(tooth_compliance(*body, radius, o).axial, all.axial);
    o = {};
    o.axial = false;
    EXPECT_EQ(tooth_compliance(*body, radius, o).axial, 0.0);
    EXPECT_EQ(tooth_compliance(*body, radius, o).bending, all.bending);
    o = {};
    o.foundation = false;
    EXPECT_EQ(tooth_compliance(*body, radius, o).foundation, 0.0);
    EXPECT_EQ(tooth_compliance(*body, radius, o).bending, all.bending);
  }
  ComplianceOptions rigid_ring;
  rigid_ring.ring_foundation = RingFoundation::rigid;
  EXPECT_EQ(tooth_compliance(g.ring_planet.driven, 105.5, rigid_ring).foundation, 0.0);
  EXPECT_GT(tooth_compliance(g.sun_planet.driving, 37.24, rigid_ring).foundation, 0.0);
}

TEST(ToothCompliance, IsInverseToModulusAndWidth) {
  constexpr double rounding = 1e-14;
  const GearSet g = table1();
  ToothBody softer = g.sun_planet.driving;
  softer.material.youngs_modulus_GPa *= 0.5;
  ToothBody wider = g.sun_planet.driving;
  wider.tooth.width_mm *= 3.0;
  const double one = tooth_compliance(g.sun_planet.driving, 37.24, {}).sum();
  EXPECT_NEAR(tooth_compliance(softer, 37.24, {}).sum(), 2.0 * one, rounding * one);
  EXPECT_NEAR(tooth_compliance(wider, 37.24, {}).sum(), one / 3.0, rounding * one);
  // A tooth drawn twice as large is as stiff.
  GearData d = problems::table1_sun();
  const ToothBody small{external_tooth(d), steel, 2.0, {}};
  d.module_mm *= 2.0;
  const ToothBody large{external_tooth(d), steel, 2.0, {}};
  EXPECT_NEAR(tooth_compliance(large, 2.0 * 37.24, {}).sum(), tooth_compliance(small, 37.24, {}).sum(),
              10.0 * rounding * one);
}

TEST(ToothCompliance, IsContinuousWhereTheRootCircleCrossesTheBaseCircle) {
  // Whatever the branch, a root circle that moves by 1e-7 moves the compliance by that order; the straight flank adds
  // its length at the base circle, and none there.
  GearData d{42, 2, 20, 0, 1, 0.25, 20, {}, {}};
  const double base = external_tooth(d).base_radius_mm;
  const auto at = [&](double root) {
    d.root_diameter_mm = 2.0 * root;
    return tooth_compliance({external_tooth(d), steel, 2.0, {}}, 42.0, {});
  };
  const ToothCompliance in = at(base - 1e-7);
  const ToothCompliance out = at(base + 1e-7);
  constexpr double movement = 1e-6;
  EXPECT_NEAR(in.bending / out.bending, 1.0, movement);
  EXPECT_NEAR(in.shear / out.shear, 1.0, movement);
  EXPECT_NEAR(in.axial / out.axial, 1.0, movement);
  EXPECT_NEAR(in.foundation / out.foundation, 1.0, movement);
}

TEST(ToothCompliance, OnlyFlanksCarry) {
  const GearSet g = table1();
  const auto at = [](const ToothBody& body, double radius, Fillet fillet = Fillet::none) {
    ComplianceOptions o;
    o.fillet = fillet;
    return tooth_compliance(body, radius, o).sum();
  };
  const ToothBody& sun = g.sun_planet.driving;
  EXPECT_THROW((void)at(sun, sun.tooth.tip_radius_mm * 1.001), DomainError);
  EXPECT_THROW((void)at(sun, sun.tooth.root_radius_mm * 0.999), DomainError);
  EXPECT_THROW((void)at(sun, std::nan("")), DomainError);
  EXPECT_THROW((void)at(sun, 0.5 * (sun.tooth.root_radius_mm + sun.tooth.form_radius_mm()), Fillet::trochoid),
               DomainError);
  const ToothBody& ring = g.ring_planet.driven;
  EXPECT_THROW((void)at(ring, ring.tooth.tip_radius_mm * 0.999), DomainError);
  EXPECT_THROW((void)at(ring, ring.tooth.root_radius_mm * 1.001), DomainError);
  const ToothBody undercut{external_tooth({10, 3, 20, 0, 1, 0.25, 10, {}, {}}), steel, 2.0, {}};
  EXPECT_NO_THROW((void)at(undercut, 16.0));
  EXPECT_THROW((void)at(undercut, 16.0, Fillet::trochoid), DomainError);
}

TEST(ToothCompliance, ContactMayBeWhereTheInvoluteBegins) {
  // The end of the involute belongs to the flank, as the base circle and the tip do; rounding must not decide.
  ComplianceOptions o;
  o.fillet = Fillet::trochoid;
  for (int teeth = 20; teeth < 120; ++teeth) {
    const ToothBody body{external_tooth({teeth, 2, 20, 0, 1, 0.25, 20, {}, {}}), steel, 2.0, {}};
    EXPECT_NO_THROW((void)tooth_compliance(body, body.tooth.form_radius_mm(), o)) << teeth;
  }
}

TEST(Foundation, SainsotsCoefficientsAreAsPublishedCodeHasThem) {
  // docs/theory/gears.md, section 9.1: 62 teeth, module 2 mm, 20 deg, bore 35 mm; petrobras/ross prints the same four.
  const double alpha = 0.349066;
  const double rounding_rack = 0.25 / (1.0 - std::sin(alpha));
  const double theta =
      (0.5 * pi + 2.0 * std::tan(alpha) * (1.0 - rounding_rack) + 2.0 * rounding_rack / std::cos(alpha)) / 62.0;
  constexpr double digit = 0.501e-5;
  const SainsotCoefficients c = sainsot_coefficients(theta, 59.5 / 17.5);
  EXPECT_NEAR(c.l, 6.93414, digit);
  EXPECT_NEAR(c.m, 1.23528, digit);
  EXPECT_NEAR(c.p, 4.97563, digit);
  EXPECT_NEAR(c.q, 0.40621, digit);
  EXPECT_TRUE(c.in_range);
}

TEST(Foundation, RootAngleOfARackCutToothIsThatOfTheRoundingsCentre) {
  // At the root circle the rounding's centre is above its foot: half space of the rack at the depth of the centre, and
  // rho / cos alpha. (The expression of Ma et al. 2014, as petrobras/ross has it, leaves c* out of that depth.)
  for (const double shift : {0.0, 0.3}) {
    const Tooth t = external_tooth({62, 2, 20, shift, 1, 0.25, 20, {}, {}});
    const double alpha = 20.0 * degree;
    const double rho = 0.25 / (1.0 - std::sin(alpha));
    const double theta = (0.5 * pi + 2.0 * std::tan(alpha) * (1.0 + 0.25 - rho) + 2.0 * rho / std::cos(alpha)) / 62.0;
    constexpr double rounding = 1e-16;  // of some ten operations on numbers of order 1, over 62
    EXPECT_NEAR(root_half_angle(t, Fillet::trochoid), theta, rounding);
  }
}

TEST(Foundation, CoefficientsAreThePolynomialsOfTheTable) {
  // Sainsot, Velex, Duverger 2004, Table 1, as docs/theory/gears.md, section 5, has it, typed once more.
  struct Row {
    double a, b, c, d, e, f;
    [[nodiscard]] double at(double theta, double h) const {
      return a / (theta * theta) + b * h * h + c * h / theta + d / theta + e * h + f;
    }
  };
  const Row l{-0.00005574, -0.0019986, -0.00023015, 0.0047702, 0.0271, 6.8045};
  const Row m{0.00060111, 0.0281, -0.0083431, -0.0099256, 0.1624, 0.9086};
  const Row p{-0.00050952, 0.1855, 0.00000538, 0.0533, 0.2895, 0.9236};
  const Row q{-0.000062042, 0.0090889, -0.00040964, 0.0078297, -0.1472, 0.6904};
  constexpr double rounding = 1e-14;
  for (const double h : {1.4, 2.0, 4.5, 7.0})
    for (const double theta : {0.01, 0.03, 0.05, 0.12}) {
      const SainsotCoefficients c = sainsot_coefficients(theta, h);
      EXPECT_TRUE(c.in_range);
      EXPECT_NEAR(c.l, l.at(theta, h), 10.0 * rounding);
      EXPECT_NEAR(c.m, m.at(theta, h), 10.0 * rounding);
      EXPECT_NEAR(c.p, p.at(theta, h), 20.0 * rounding);
      EXPECT_NEAR(c.q, q.at(theta, h), 10.0 * rounding);
    }
  EXPECT_FALSE(sainsot_coefficients(0.05, 1.39).in_range);
  EXPECT_FALSE(sainsot_coefficients(0.05, 7.01).in_range);
  EXPECT_FALSE(sainsot_coefficients(0.0099, 3.0).in_range);
  EXPECT_FALSE(sainsot_coefficients(0.121, 3.0).in_range);
}

TEST(Foundation, IsSainsotsFormulaAtTheCrossingWithTheCentreLine) {
  const GearSet g = table1();
  const ToothBody& body = g.sun_planet.driving;
  const Tooth& t = body.tooth;
  const double radius = 38.0;
  // The line of action through the contact at its angle to the line across the tooth meets the centre line at u + r_f.
  const ProfilePoint contact = on_flank(t, radius);
  const double angle = t.pressure_angle_at(radius) - t.half_angle_at(radius);
  const double u = contact.y - contact.x * std::tan(angle) - t.root_radius_mm;
  const double theta = t.half_angle_at(t.root_radius_mm);
  const double s = 2.0 * t.root_radius_mm * theta;
  const SainsotCoefficients c = sainsot_coefficients(theta, 2.0);
  const double expected = std::pow(std::cos(angle), 2) / (206e9 * 0.06) *
                          (c.l * u * u / (s * s) + c.m * u / s + c.p * (1.0 + c.q * std::pow(std::tan(angle), 2)));
  constexpr double rounding = 1e-13;
  EXPECT_NEAR(tooth_compliance(body, radius, {}).foundation, expected, rounding * expected);
  ComplianceOptions height;
  height.lever = FoundationLever::contact_height;
  EXPECT_GT(tooth_compliance(body, radius, height).foundation, expected);
}

TEST(Foundation, GivenRootAngleDecides) {
  const GearSet g = table1();
  ToothBody body = g.sun_planet.driving;
  const double own = root_half_angle(body.tooth, Fillet::none);
  const double before = tooth_compliance(body, 38.0, {}).foundation;
  body.root_half_angle = own;
  EXPECT_EQ(tooth_compliance(body, 38.0, {}).foundation, before);
  body.root_half_angle = 1.1 * own;
  EXPECT_LT(tooth_compliance(body, 38.0, {}).foundation, before);
}

TEST(Foundation, RootHalfAngleIsThatOfTheProfileAtTheRootCircle) {
  const Tooth few = external_tooth({19, 3.175, 20, 0, 1, 0.25, 16, {}, {}});
  // Straight flank: as thick at the root circle as at the base circle.
  constexpr double rounding_mm = 1e-14;  // of a few operations on some 2 mm
  EXPECT_NEAR(few.root_radius_mm * std::sin(root_half_angle(few, Fillet::none)),
              few.base_radius_mm * std::sin(few.base_half_angle), rounding_mm);
  const GearSet g = table1();
  EXPECT_EQ(root_half_angle(g.sun, Fillet::none), g.sun.half_angle_at(g.sun.root_radius_mm));
  EXPECT_EQ(root_half_angle(g.ring, Fillet::none), g.ring.half_angle_at(g.ring.root_radius_mm));
  EXPECT_GT(root_half_angle(g.sun, Fillet::trochoid), root_half_angle(g.sun, Fillet::none));
}

TEST(Hertz, ComplianceIsThatOfALineContact) {
  // 4 (1 - nu^2) / (pi E L), steel, 60 mm.
  constexpr double rounding = 1e-15;
  EXPECT_NEAR(hertz_compliance(steel, 60.0), 4.0 * 0.91 / (pi * 206e9 * 0.06), rounding * 1e-9);
}

TEST(ToothCompliance, ReproducesThePublishedNumberOfRoss) {
  // petrobras/ross, gear_element.py, docstring of Mesh: 62/62 teeth, module 2 mm, width 20 mm, bore 35 mm, pressure
  // angle 0.349066 rad, steel of E 211 GPa and G 81.2 GPa: 429787128.434 N/m is the greatest stiffness at 1000 points
  // of a mesh period. That code advances both contact points linearly in their pressure angles, gear 1 from where its
  // involute begins to its tip, gear 2 the other way.
  constexpr double published = 429787128.434;
  // 429787095.1 here; the source's own digits are those of its rounded pressure angle and quadrature.
  constexpr double agreement = 1e-7;
  const double alpha = 0.349066;
  const Material ross_steel{211, 211.0 / (2.0 * 81.2) - 1.0, 7810};
  const Tooth t = external_tooth({62, 2, alpha / degree, 0, 1, 0.25, 20, {}, {}});
  const double rho = 0.25 / (1.0 - std::sin(alpha));
  const double theta = (0.5 * pi + 2.0 * std::tan(alpha) * (1.0 - rho) + 2.0 * rho / std::cos(alpha)) / 62.0;
  const ToothBody body{t, ross_steel, t.root_radius_mm / 17.5, theta};
  ComplianceOptions o;
  o.fillet = Fillet::trochoid;
  o.lever = FoundationLever::contact_height;
  constexpr double above_rounding = 1.0 + 1e-14;
  const double begin = t.pressure_angle_at(t.form_radius_mm() * above_rounding);
  const double end = t.pressure_angle_at(t.tip_radius_mm);
  const double ratio = make_pair(t, t, 124.0).contact_ratio();
  constexpr double ratio_digits = 0.5e-6;  // half a unit of the sixth decimal
  EXPECT_NEAR(ratio, 1.789779, ratio_digits);
  const double hertz = hertz_compliance(ross_steel, 20.0);
  const auto pair_stiffness = [&](double periods) {
    const double share = periods / ratio;
    const auto compliance = [&](double angle) {
      return tooth_compliance(body, t.base_radius_mm / std::cos(angle), o).sum();
    };
    return 1.0 / (hertz + compliance(begin + share * (end - begin)) + compliance(end - share * (end - begin)));
  };
  double greatest = 0.0;
  constexpr int points = 1000;
  for (int k = 0; k < points; ++k) {
    const double periods = static_cast<double>(k) / (points - 1);
    const double second = periods + 1.0 <= ratio ? pair_stiffness(periods + 1.0) : 0.0;
    greatest = std::max(greatest, pair_stiffness(periods) + second);
  }
  EXPECT_NEAR(greatest / published, 1.0, agreement);
  RecordProperty("greatest_N_per_m", std::to_string(greatest));
}

TEST(ToothCompliance, SainsotsBodyWithoutItsWindUpIsAnElasticDisc) {
  // [G-disc]: a solid disc under a tangential load spread over the tooth's foot, referred to its rigid-body motion;
  // the annulus of the fit without the torsion about its held inner circle, (1 + nu)/(2 pi) (h^2 - 1).
  constexpr double nu = 0.3;
  const auto disc = [&](double theta) {
    double sum = 0.0;
    for (int n = 2; n < 20000; ++n) {
      const double spread = std::sin(n * theta) / (n * theta);
      sum += spread * spread * ((3.0 - nu) / (n + 1) + (1.0 + nu) / (n - 1));
    }
    return (1.0 + nu) / (6.0 * pi) + (3.0 + nu) / (2.0 * pi) + sum / (2.0 * pi);
  };
  constexpr double of_the_fit = 0.02;
  const double h = solid_body_ratio;
  const double wind_up = (1.0 + nu) / (2.0 * pi) * (h * h - 1.0);
  for (const double theta : {0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09}) {
    const SainsotCoefficients c = sainsot_coefficients(theta, h);
    EXPECT_TRUE(c.in_range);
    EXPECT_NEAR((c.p - wind_up) / disc(theta), 1.0, of_the_fit) << theta;
    EXPECT_LT(c.p / disc(theta), 1.12) << theta;
    EXPECT_GT(sainsot_coefficients(theta, 7.0).p / disc(theta), 4.0) << theta;
  }
}

}  // namespace
}  // namespace epicyclic::gear::tooth_compliance_test
