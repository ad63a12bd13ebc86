#include "gear/tooth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "problems/table1.hpp"

namespace epicyclic::gear::tooth_test {
namespace {

using problems::degree;
constexpr double pi = std::numbers::pi;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

// Roundings of lengths of some 100 mm and of angles of order 1.
constexpr double rounding_mm = 1e-12;
constexpr double rounding = 1e-14;

/// External gears of different pressure angles, shifts and tooth numbers, none undercut.
std::vector<GearData> external_gears() {
  return {problems::table1_sun(),
          problems::table1_planet(),
          {19, 3.175, 20, 0, 1, 0.25, 16, {}, {}},
          {62, 2, 20, 0, 1, 0.25, 20, {}, {}},
          {12, 4, 20, 0.4, 1, 0.2, 20, {}, {}},
          {40, 1, 14.5, -0.2, 1, 0.157, 20, {}, {}},
          {25, 2.63, 25, 1.1, 1, 0.25, 60, {}, {}},  // the rounding's centre is outside the pitch line
          {200, 5, 22.5, -0.5, 0.8, 0.3, 20, {}, {}}};
}

/// tan a - a without cancellation, by its series.
double involute_series(double a) {
  const double s = a * a;
  return a * s * (1.0 / 3.0 + s * (2.0 / 15.0 + s * (17.0 / 315.0 + s * 62.0 / 2835.0)));
}

TEST(Involute, InverseReturnsTheAngle) {
  for (double angle = 0.05; angle < 1.56; angle += 0.05) {
    // inv a loses a / tan^3 a to cancellation, and its slope is tan^2 a.
    const double slope = std::tan(angle) * std::tan(angle);
    const double tolerance = 4.0 * epsilon * (std::tan(angle) / slope + angle);
    EXPECT_NEAR(inverse_involute(involute(angle)), angle, tolerance) << angle;
  }
}

TEST(Involute, InverseHoldsForSmallValues) {
  // t - atan t cancels: the angle is known to 4 eps / a^2 relative. The series ends with a^8, the next term of the
  // angle is 0.009 a^8.
  for (const double angle : {0.3, 0.1, 0.03, 0.0145, 0.0143, 0.01}) {
    const double cancellation = 4.0 * epsilon / (angle * angle) + 4.0 * epsilon;
    const double truncation = 0.01 * std::pow(angle, 8);
    EXPECT_NEAR(inverse_involute(involute_series(angle)) / angle, 1.0, cancellation + truncation) << angle;
  }
  EXPECT_EQ(inverse_involute(0.0), 0.0);
}

TEST(Involute, InverseHoldsForTinyValues) {
  // The condition of a = cbrt(3 v) is 1/3: v carries a to rounding.
  for (const double angle : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-12, 1e-50})
    EXPECT_NEAR(inverse_involute(involute_series(angle)) / angle, 1.0, rounding) << angle;
}

TEST(Involute, InverseHoldsForLargeValues) {
  for (const double v : {1.0, 10.0, 1e3, 1e6, 1e12}) {
    // inv a = tan a - a, so pi/2 - a = atan(1 / (v + a)).
    const double angle = inverse_involute(v);
    EXPECT_LT(angle, 0.5 * pi) << v;
    EXPECT_NEAR(angle, 0.5 * pi - std::atan(1.0 / (v + angle)), 4.0 * epsilon) << v;
  }
}

TEST(Involute, InverseRisesWithItsArgument) {
  double last = 0.0;
  for (double v = 1e-12; v < 1e6; v *= 1.7) {
    const double angle = inverse_involute(v);
    EXPECT_GT(angle, last) << v;
    last = angle;
  }
}

TEST(Involute, TableValues) {
  // Textbook tables of inv a, to their digits.
  constexpr double digits = 5e-7;
  EXPECT_NEAR(involute(20.0 * degree), 0.014904, digits);
  EXPECT_NEAR(involute(14.5 * degree), 0.0055448, digits);
  EXPECT_NEAR(involute(25.0 * degree), 0.029975, digits);
}

TEST(Involute, NegativeAndUndefinedValuesAreDomainErrors) {
  EXPECT_THROW((void)inverse_involute(-1e-300), DomainError);
  EXPECT_THROW((void)inverse_involute(std::numeric_limits<double>::quiet_NaN()), DomainError);
}

TEST(Tooth, HalfAngleAtTheReferenceCircleIsThatOfTheShiftedRack) {
  for (const GearData& d : external_gears()) {
    const Tooth t = external_tooth(d);
    const double expected =
        pi / (2.0 * d.teeth) + 2.0 * d.profile_shift * std::tan(d.pressure_angle_deg * degree) / d.teeth;
    EXPECT_NEAR(t.half_angle_at(t.reference_radius_mm), expected, rounding) << d.teeth;
    // The rack's space at the pitch line: pi m / 2 + 2 x m tan alpha.
    const double space =
        0.5 * pi * d.module_mm + 2.0 * d.profile_shift * d.module_mm * std::tan(d.pressure_angle_deg * degree);
    EXPECT_NEAR(t.thickness_at(t.reference_radius_mm), space, rounding_mm) << d.teeth;
  }
}

TEST(Tooth, PressureAngleAtTheReferenceCircleIsThatOfTheRack) {
  for (const GearData& d : external_gears()) {
    const Tooth t = external_tooth(d);
    EXPECT_NEAR(t.pressure_angle_at(t.reference_radius_mm), d.pressure_angle_deg * degree, rounding) << d.teeth;
    EXPECT_EQ(t.pressure_angle_at(0.9 * t.base_radius_mm), 0.0);
    EXPECT_EQ(t.half_angle_at(t.base_radius_mm), t.base_half_angle);
  }
}

TEST(Tooth, FlankIsTheStringUnwoundFromTheBaseCircle) {
  // The normal of the flank at any point touches the base circle, and its length there is the arc unwound.
  for (const GearData& d : external_gears())
    for (const bool internal : {false, true}) {
      if (internal && d.teeth < 50) continue;
      const Tooth t = internal ? internal_tooth(d) : external_tooth(d);
      const double low = std::max(t.base_radius_mm, std::min(t.root_radius_mm, t.tip_radius_mm)) * (1.0 + 1e-6);
      const double high = std::max(t.root_radius_mm, t.tip_radius_mm);
      for (const double share : {0.1, 0.5, 0.9}) {
        const double radius = low + share * (high - low);
        const auto point = [&](double r) {
          const double half = t.half_angle_at(r);
          return ProfilePoint{r * std::sin(half), r * std::cos(half)};
        };
        const double h = 1e-5 * radius;
        const ProfilePoint p = point(radius);
        const ProfilePoint a = point(radius - h);
        const ProfilePoint b = point(radius + h);
        const double dx = b.x - a.x;
        const double dy = b.y - a.y;
        // Distance of the normal from the axis: |p . tangent|.
        const double distance = std::abs(p.x * dx + p.y * dy) / std::hypot(dx, dy);
        // Central difference of step 1e-5 where the flank is not near its cusp at the base circle.
        constexpr double second_order = 1e-5;
        EXPECT_NEAR(distance / t.base_radius_mm, 1.0, second_order) << d.teeth << (internal ? " internal" : "");
      }
    }
}

TEST(Tooth, RadiiOfTheReferenceProfile) {
  const Tooth t = external_tooth({20, 3, 20, 0.3, 1.1, 0.2, 10, {}, {}}, 0.05);
  EXPECT_NEAR(t.tip_radius_mm, 30.0 + 3.0 * (1.1 + 0.3 - 0.05), rounding_mm);
  EXPECT_NEAR(t.root_radius_mm, 30.0 - 3.0 * (1.1 + 0.2 - 0.3), rounding_mm);
  EXPECT_NEAR(t.base_pitch_mm(), 3.0 * pi * std::cos(20.0 * degree), rounding_mm);
  const Tooth r = internal_tooth({60, 3, 20, 0.3, 1.1, 0.2, 10, {}, {}}, 0.05);
  EXPECT_NEAR(r.tip_radius_mm, 90.0 - 3.0 * (1.1 - 0.3 - 0.05), rounding_mm);
  EXPECT_NEAR(r.root_radius_mm, 90.0 + 3.0 * (1.1 + 0.2 + 0.3), rounding_mm);
}

TEST(Tooth, GivenDiametersDecide) {
  GearData d = problems::table1_sun();
  d.tip_diameter_mm = 79.0;
  d.root_diameter_mm = 67.0;
  const Tooth t = external_tooth(d, 0.2);
  EXPECT_EQ(t.tip_radius_mm, 39.5);
  EXPECT_EQ(t.root_radius_mm, 33.5);
  GearData ring = problems::table1_ring();
  ring.tip_diameter_mm = 208.0;
  ring.root_diameter_mm = 220.0;
  EXPECT_EQ(internal_tooth(ring, 0.2).tip_radius_mm, 104.0);
  EXPECT_EQ(internal_tooth(ring, 0.2).root_radius_mm, 110.0);
}

TEST(Tooth, SpaceOfTheRingIsThickerWithX) {
  GearData d = problems::table1_ring();
  const double alpha = d.pressure_angle_deg * degree;
  for (const double x : {-0.5, 0.0, 1.0}) {
    d.profile_shift = x;
    const Tooth t = internal_tooth(d);
    const double space = 2.0 * pi * t.reference_radius_mm / d.teeth - t.thickness_at(t.reference_radius_mm);
    EXPECT_NEAR(space, d.module_mm * (0.5 * pi + 2.0 * x * std::tan(alpha)), rounding_mm) << x;
  }
}

TEST(Tooth, SpaceOfTheRingIsTheToothOfTheSameExternalGear) {
  // Whoever cuts the ring with a gear of its own teeth, shift and module finds no backlash.
  GearData d = problems::table1_ring();
  const Tooth ring = internal_tooth(d);
  const Tooth gear = external_tooth(d);
  for (const double radius : {98.0, 104.0, 108.0})
    EXPECT_NEAR(ring.half_angle_at(radius) + gear.half_angle_at(radius), pi / d.teeth, rounding) << radius;
}

TEST(Tooth, RingToothGetsThickerTowardsItsRoot) {
  const Tooth t = internal_tooth(problems::table1_ring());
  EXPECT_GT(t.half_angle_at(t.root_radius_mm), t.half_angle_at(t.tip_radius_mm));
  const Tooth e = external_tooth(problems::table1_sun());
  EXPECT_LT(e.half_angle_at(e.tip_radius_mm), e.half_angle_at(e.root_radius_mm));
}

TEST(Fillet, JoinsTheInvoluteAtTheFormRadiusWithACommonTangent) {
  for (const GearData& d : external_gears()) {
    const Tooth t = external_tooth(d);
    const double radius = t.form_radius_mm();
    ASSERT_GE(radius, t.base_radius_mm) << d.teeth;
    const ProfilePoint p = t.fillet(t.pressure_angle);
    EXPECT_NEAR(std::hypot(p.x, p.y), radius, rounding_mm * 10.0) << d.teeth;
    EXPECT_NEAR(std::atan2(p.x, p.y), t.half_angle_at(radius), rounding * 10.0) << d.teeth;
    // The involute's tangent is inclined by its pressure angle to the radius; inwards it goes to larger x.
    const ProfilePoint slope = t.fillet_slope(t.pressure_angle);
    const double radial = (p.x * slope.x + p.y * slope.y) / radius;
    const double across = (p.y * slope.x - p.x * slope.y) / radius;
    EXPECT_NEAR(std::atan2(std::abs(across), std::abs(radial)), t.pressure_angle_at(radius), 1e3 * rounding) << d.teeth;
    EXPECT_LT(radial * across, 0.0) << d.teeth;
  }
}

TEST(Fillet, ReachesTheRootCircleAtARightAngleWithItsTangent) {
  for (const GearData& d : external_gears()) {
    const Tooth t = external_tooth(d);
    const ProfilePoint p = t.fillet(0.5 * pi);
    EXPECT_NEAR(std::hypot(p.x, p.y), t.root_radius_mm, rounding_mm) << d.teeth;
    const ProfilePoint slope = t.fillet_slope(0.5 * pi);
    EXPECT_NEAR((p.x * slope.x + p.y * slope.y) / (std::hypot(p.x, p.y) * std::hypot(slope.x, slope.y)), 0.0,
                1e2 * rounding)
        << d.teeth;
  }
}

TEST(Fillet, SlopeIsThatOfDifferences) {
  constexpr double h = 1e-6;
  // Central differences: h^2 times third derivatives that grow with 1 / tan gamma, and rounding / h.
  constexpr double difference = 1e-8;
  for (const GearData& d : external_gears()) {
    const Tooth t = external_tooth(d);
    for (double gamma = t.pressure_angle + 0.01; gamma < 0.5 * pi; gamma += 0.15) {
      const ProfilePoint a = t.fillet(gamma - h);
      const ProfilePoint b = t.fillet(gamma + h);
      const ProfilePoint s = t.fillet_slope(gamma);
      EXPECT_NEAR((b.x - a.x) / (2.0 * h), s.x, difference * t.reference_radius_mm) << d.teeth << " " << gamma;
      EXPECT_NEAR((b.y - a.y) / (2.0 * h), s.y, difference * t.reference_radius_mm) << d.teeth << " " << gamma;
    }
  }
}

TEST(Fillet, IsTheEnvelopeOfTheRollingRacksRounding) {
  // The rounding's centre, from the rack's drawing alone: tangent to its tip line and its flank. In the gear's frame it
  // moves as the rack rolls; the fillet is touched by the circle and never entered.
  for (const GearData& d : external_gears()) {
    const Tooth t = external_tooth(d);
    const double m = d.module_mm;
    const double alpha = d.pressure_angle_deg * degree;
    // A rounding that fits into the rack's tooth: at most a full tip radius.
    const double tip = d.addendum_coefficient + d.clearance_coefficient;
    const double full = (0.25 * pi - tip * std::tan(alpha)) * std::cos(alpha) / (1.0 - std::sin(alpha));
    const double rho = m * std::min(d.clearance_coefficient / (1.0 - std::sin(alpha)), full);
    EXPECT_NEAR(t.fillet_rounding_mm(), rho, rounding_mm);
    const double v = d.profile_shift * m - (d.addendum_coefficient + d.clearance_coefficient) * m + rho;
    const double u = 0.25 * pi * m + (d.profile_shift * m - v) * std::tan(alpha) + rho / std::cos(alpha);
    const double r = 0.5 * m * d.teeth;
    const auto distance = [&](const ProfilePoint& p, double turn) {
      const double x = u + r * turn;
      const double y = r + v;
      return std::hypot(x * std::cos(turn) - y * std::sin(turn) - p.x, x * std::sin(turn) + y * std::cos(turn) - p.y);
    };
    for (const double share : {0.02, 0.25, 0.5, 0.75, 0.98}) {
      const ProfilePoint p = t.fillet(t.pressure_angle + share * (0.5 * pi - t.pressure_angle));
      double least = 1e9;
      double at = 0.0;
      const double range = 16.0 / d.teeth;
      for (int k = -400; k <= 400; ++k) {
        const double turn = range * k / 400.0;
        if (distance(p, turn) < least) {
          least = distance(p, turn);
          at = turn;
        }
      }
      // Ternary search within the neighbours of the best sample.
      double low = at - range / 400.0;
      double high = at + range / 400.0;
      for (int k = 0; k < 100; ++k) {
        const double a = low + (high - low) / 3.0;
        const double b = high - (high - low) / 3.0;
        (distance(p, a) < distance(p, b) ? high : low) = distance(p, a) < distance(p, b) ? b : a;
      }
      EXPECT_NEAR(distance(p, 0.5 * (low + high)), rho, rounding_mm * 10.0) << d.teeth << " at " << share;
    }
  }
}

TEST(Fillet, StaysWithinItsHalfOfTheToothSpace) {
  // At 25 degrees a clearance of 0.25 asks for a rounding wider than the rack's tip: a full tip radius is taken.
  for (const double angle : {14.5, 20.0, 25.0, 28.0}) {
    const Tooth t = external_tooth({27, 2.63, angle, 0.3, 1, 0.25, 60, {}, {}});
    const ProfilePoint foot = t.fillet(0.5 * pi);
    EXPECT_LE(std::atan2(foot.x, foot.y), pi / t.teeth + rounding) << angle;
    EXPECT_NEAR(std::hypot(foot.x, foot.y), t.root_radius_mm, rounding_mm) << angle;
  }
}

TEST(Fillet, ReachesARootCircleThatIsGiven) {
  GearData d{40, 2, 20, 0.1, 1, 0.25, 20, {}, {}};
  d.root_diameter_mm = 75.6;
  const Tooth t = external_tooth(d);
  const ProfilePoint foot = t.fillet(0.5 * pi);
  EXPECT_NEAR(std::hypot(foot.x, foot.y), 37.8, rounding_mm);
}

TEST(Undercut, LimitIsThatOfTheTextbook) {
  // 17 teeth at 20 deg need 1 - 17 sin^2(20) / 2 = 0.00569 modules; 18 need none.
  constexpr double digits = 0.5e-7;  // half a unit of the seventh decimal
  EXPECT_NEAR(external_tooth({17, 1, 20, 0, 1, 0.25, 1, {}, {}}).undercut_limit(), 0.0056889, digits);
  EXPECT_LT(external_tooth({18, 1, 20, 0, 1, 0.25, 1, {}, {}}).undercut_limit(), 0.0);
}

TEST(Undercut, AtTheLimitTheInvoluteBeginsAtTheBaseCircle) {
  GearData d{12, 3, 20, 0, 1, 0.25, 10, {}, {}};
  d.profile_shift = external_tooth(d).undercut_limit();
  const Tooth t = external_tooth(d);
  EXPECT_NEAR(t.form_radius_mm(), t.base_radius_mm, rounding_mm);
}

TEST(Undercut, TheInvoluteEndsWhereTheFilletCrossesIt) {
  // By an independent intersection of the rack's fillet with the involute, module 1 but for the first.
  constexpr double digits = 1e-4;
  EXPECT_NEAR(external_tooth({15, 2, 20, 0, 1, 0.25, 1, {}, {}}).form_radius_mm(), 14.09957, digits);
  EXPECT_NEAR(external_tooth({14, 1, 20, 0, 1, 0.25, 1, {}, {}}).form_radius_mm(), 6.5825, digits);
  EXPECT_NEAR(external_tooth({12, 1, 20, 0, 1, 0.25, 1, {}, {}}).form_radius_mm(), 5.6514, digits);
  EXPECT_NEAR(external_tooth({12, 1, 20, -0.2, 1, 0.25, 1, {}, {}}).form_radius_mm(), 5.6706, digits);
  EXPECT_NEAR(external_tooth({24, 1, 20, -0.6, 1, 0.25, 1, {}, {}}).form_radius_mm(), 11.2797, digits);
  // From the limit on it rises from the base circle, without a jump.
  double before = 0.0;
  for (const double below : {1e-6, 1e-4, 1e-2, 0.1, 0.3}) {
    GearData d{12, 3, 20, 0, 1, 0.25, 10, {}, {}};
    d.profile_shift = external_tooth(d).undercut_limit() - below;
    const Tooth t = external_tooth(d);
    const double above_mm = t.form_radius_mm() - t.base_radius_mm;
    EXPECT_GE(above_mm, before) << below;
    EXPECT_LT(above_mm, 3.0 * below) << below;
    before = above_mm;
  }
}

TEST(Tooth, WhatMakesNoToothIsADomainError) {
  const GearData good = problems::table1_sun();
  const auto broken = [&](auto change) {
    GearData d = good;
    change(d);
    return d;
  };
  const std::vector<GearData> bad = {
      broken([](GearData& d) { d.teeth = 2; }),
      broken([](GearData& d) { d.module_mm = 0.0; }),
      broken([](GearData& d) { d.module_mm = std::numeric_limits<double>::quiet_NaN(); }),
      broken([](GearData& d) { d.pressure_angle_deg = 0.0; }),
      broken([](GearData& d) { d.pressure_angle_deg = 90.0; }),
      broken([](GearData& d) { d.width_mm = 0.0; }),
      broken([](GearData& d) { d.profile_shift = -20.0; }),
      broken([](GearData& d) { d.tip_diameter_mm = 60.0; }),
      broken([](GearData& d) { d.root_diameter_mm = 80.0; }),
  };
  for (std::size_t k = 0; k < bad.size(); ++k) EXPECT_THROW((void)external_tooth(bad[k]), DomainError) << k;
  GearData ring = problems::table1_ring();
  ring.tip_diameter_mm = 190.0;  // within the base circle
  EXPECT_THROW((void)internal_tooth(ring), DomainError);
  ring.tip_diameter_mm = 230.0;  // beyond the root
  EXPECT_THROW((void)internal_tooth(ring), DomainError);
}

}  // namespace
}  // namespace epicyclic::gear::tooth_test
