#include "gear/pair.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "gear/gear_set.hpp"
#include "gear/kinematics.hpp"
#include "problems/table1.hpp"

namespace epicyclic::gear::pair_test {
namespace {

using problems::degree;
constexpr double pi = std::numbers::pi;

// Roundings of lengths of some 100 mm.
constexpr double rounding_mm = 1e-12;

/// Half a unit of the n-th decimal, and a little for the rounding of the printed number itself.
constexpr double digits(int decimals) {
  double unit = 1.0;
  for (int k = 0; k < decimals; ++k) unit /= 10.0;
  return 0.5001 * unit;
}

GearSet geometry(Tips tips = Tips::shortened, double addendum = 1.0, double ring_addendum = 1.0) {
  Stage s = problems::table1();
  s.catalogue->tips = tips;
  s.catalogue->sun.data.addendum_coefficient = addendum;
  s.catalogue->planet.data.addendum_coefficient = addendum;
  s.catalogue->ring.data.addendum_coefficient = ring_addendum;
  s.catalogue->stiffness.harmonics = 0;
  return make_gear_set(s);
}

TEST(PairOfTable1, AnglesRadiiAndPitchesAreAsPrinted) {
  // docs/theory/gears.md, section 8, and docs/theory/parameters.md, section 1.
  const GearSet g = geometry();
  const double reference = 0.5 * 2.63 * 52;
  EXPECT_NEAR(reference, 68.380, digits(3));
  EXPECT_NEAR(g.centre_distance_mm, 71.720839, digits(6));
  EXPECT_NEAR((g.centre_distance_mm - reference) / 2.63, 1.27028, digits(5));
  EXPECT_NEAR(g.tip_shortening, 0.12772, digits(5));
  EXPECT_NEAR(g.sun_planet.pair.pressure_angle / degree, 30.22094, digits(5));
  EXPECT_NEAR(g.ring_planet.pair.pressure_angle / degree, 21.47781, digits(5));
  EXPECT_NEAR(g.sun.base_radius_mm, 32.17846, digits(5));
  EXPECT_NEAR(g.planet.base_radius_mm, 29.79487, digits(5));
  EXPECT_NEAR(g.ring.base_radius_mm, 96.53537, digits(5));
  EXPECT_NEAR(g.ring_module_mm, 2.57627, digits(5));
  EXPECT_NEAR(g.sun_planet.pair.pitch_radius_1_mm(), 37.2397, digits(4));
  EXPECT_NEAR(g.sun_planet.pair.pitch_radius_2_mm(), 34.4812, digits(4));
  EXPECT_NEAR(g.ring_planet.pair.pitch_radius_1_mm(), 32.0182, digits(4));
  EXPECT_NEAR(g.ring_planet.pair.pitch_radius_2_mm(), 103.7391, digits(4));
  EXPECT_NEAR(g.sun.tip_radius_mm, 39.438, digits(3));
  EXPECT_NEAR(g.planet.tip_radius_mm, 37.207, digits(3));
  EXPECT_NEAR(g.ring.tip_radius_mm, 104.339, digits(3));
  EXPECT_NEAR(g.sun.root_radius_mm, 33.856, digits(3));
  EXPECT_NEAR(g.planet.root_radius_mm, 31.626, digits(3));
  EXPECT_NEAR(g.ring.root_radius_mm, 110.136, digits(3));
  for (const Tooth* t : {&g.sun, &g.planet}) EXPECT_GT(t->root_radius_mm, t->base_radius_mm);
  EXPECT_NEAR(g.sun_planet.pair.base_pitch_mm, 7.488267, digits(6));
  EXPECT_NEAR(g.ring_planet.pair.base_pitch_mm, 7.488267, digits(6));
  EXPECT_NEAR(g.ring.base_pitch_mm(), g.planet.base_pitch_mm(), rounding_mm);
}

TEST(PairOfTable1, PrintedRingModuleDoesNotFit) {
  const Tooth printed = internal_tooth(problems::table1_ring());
  EXPECT_NEAR(printed.base_radius_mm, 96.3005, digits(4));
  EXPECT_NEAR(printed.base_pitch_mm(), 7.470044, digits(6));
  const GearSet g = geometry();
  EXPECT_NEAR(g.base_pitch_mismatch_mm * 1e3, 18.22, digits(2));
  EXPECT_NEAR(g.base_pitch_mismatch_mm / printed.base_pitch_mm() * 100.0, 0.244, digits(3));
  EXPECT_NEAR(make_pair(g.planet, printed, g.centre_distance_mm).pressure_angle / degree, 21.9847, digits(4));
}

TEST(PairOfTable1, PlanetToothInTheRingsRackHasTheShift11571) {
  const GearSet g = geometry();
  // The same flanks cut by the ring's rack: module m_r, 22.3 deg, another x.
  const double alpha = 22.3 * degree;
  const double x = (25.0 * (g.planet.base_half_angle - involute(alpha)) - 0.5 * pi) / (2.0 * std::tan(alpha));
  EXPECT_NEAR(x, 1.1571, digits(4));
  const Tooth same = external_tooth({25, g.ring_module_mm, 22.3, x, 1, 0.25, 60, {}, {}});
  EXPECT_NEAR(same.base_radius_mm, g.planet.base_radius_mm, rounding_mm);
  EXPECT_NEAR(same.thickness_at(34.0), g.planet.thickness_at(34.0), rounding_mm);
}

TEST(PairOfTable1, BacklashIsAsPrintedForEachTreatmentOfTheRing) {
  const GearSet g = geometry();
  const double a = g.centre_distance_mm;
  EXPECT_NEAR(g.sun_planet.pair.backlash_mm(), 0.0, rounding_mm);
  EXPECT_NEAR(g.ring_planet.pair.backlash_mm(), 0.0022, digits(4));
  // With two base pitches "the" pitch is not one: -0.2155 mm is printed with that of the ring, a pair takes that of its
  // driving member.
  const Tooth printed = internal_tooth(problems::table1_ring());
  const Pair pair = make_pair(g.planet, printed, a);
  const double pitch_of_ring = (printed.base_pitch_mm() - g.planet.base_pitch_mm()) / std::cos(pair.pressure_angle);
  EXPECT_NEAR(pair.backlash_mm() + pitch_of_ring, -0.2155, digits(4));
  GearData steeper = problems::table1_ring();
  steeper.pressure_angle_deg = 21.957;
  EXPECT_NEAR(make_pair(g.planet, internal_tooth(steeper), a).backlash_mm(), -0.239, digits(3));
}

TEST(PairOfTable1, CentreDistancesWithoutBacklash) {
  const GearSet g = geometry();
  EXPECT_NEAR(tight_centre_distance_mm(g.sun, g.planet), 71.72084, digits(5));
  EXPECT_NEAR(tight_centre_distance_mm(g.planet, g.ring), 71.72370, digits(5));
}

TEST(PairOfTable1, ContactRatiosOfTheWholeTable) {
  struct Row {
    double addendum, ring_addendum, ring_tip, sp_short, sp_full, rp_short, rp_full, start;
  };
  const Row rows[] = {
      {1.0, 1.2, 103.824, 1.200, 1.351, 1.380, 1.454, 0.230}, {1.0, 1.0, 104.339, 1.200, 1.351, 1.196, 1.270, 1.609},
      {1.0, 0.9, 104.597, 1.200, 1.351, 1.106, 1.180, 2.283}, {1.0, 0.8, 104.854, 1.200, 1.351, 1.017, 1.091, 2.948},
      {0.9, 1.0, 104.339, 1.080, 1.233, 1.137, 1.212, 1.609},
  };
  for (const Row& r : rows) {
    const GearSet cut = geometry(Tips::shortened, r.addendum, r.ring_addendum);
    const GearSet full = geometry(Tips::full, r.addendum, r.ring_addendum);
    const std::string where = std::to_string(r.addendum) + ", ring " + std::to_string(r.ring_addendum);
    EXPECT_NEAR(cut.ring.tip_radius_mm, r.ring_tip, digits(3)) << where;
    EXPECT_NEAR(cut.sun_planet.contact_ratio(), r.sp_short, digits(3)) << where;
    EXPECT_NEAR(full.sun_planet.contact_ratio(), r.sp_full, digits(3)) << where;
    EXPECT_NEAR(cut.ring_planet.contact_ratio(), r.rp_short, digits(3)) << where;
    EXPECT_NEAR(full.ring_planet.contact_ratio(), r.rp_full, digits(3)) << where;
    const Pair& p = cut.ring_planet.pair;
    EXPECT_NEAR(p.start_mm - p.pitch_arm_mm, r.start, digits(3)) << where;
    EXPECT_EQ(p.side(), PitchSide::beyond) << where;
    EXPECT_EQ(cut.sun_planet.pair.side(), PitchSide::across) << where;
  }
}

TEST(PairOfTable1, PathsOfContactAreAsPrinted) {
  const GearSet g = geometry();
  const Pair& sp = g.sun_planet.pair;
  const Pair& rp = g.ring_planet.pair;
  EXPECT_NEAR(sp.theoretical_length_mm, 36.100, digits(3));
  EXPECT_NEAR(sp.start_mm, 13.814, digits(3));
  EXPECT_NEAR(sp.end_mm, 22.801, digits(3));
  EXPECT_NEAR(sp.pitch_arm_mm - sp.start_mm, 4.93, digits(2));
  EXPECT_NEAR(sp.end_mm - sp.pitch_arm_mm, 4.06, digits(2));
  EXPECT_NEAR(rp.pitch_arm_mm, 11.723, digits(3));
  EXPECT_NEAR(rp.start_mm, 13.332, digits(3));
  EXPECT_NEAR(rp.end_mm, 22.286, digits(3));
  // The planet's flank is used from 32.37 mm or above, within the involute that the rack cuts.
  for (const double radius : {sp.radius_2_mm(sp.end_mm), rp.radius_1_mm(rp.start_mm)}) {
    EXPECT_GT(radius, 32.37);
    EXPECT_GT(radius, g.planet.form_radius_mm());
  }
}

TEST(PairOfTable1, TipsAreAsPrinted) {
  const GearSet cut = geometry();
  const GearSet full = geometry(Tips::full);
  const auto tip = [](const Tooth& t) { return t.thickness_at(t.tip_radius_mm) / t.module_mm; };
  EXPECT_NEAR(tip(cut.sun), 0.53, digits(2));
  EXPECT_NEAR(tip(cut.planet), 0.45, digits(2));
  EXPECT_NEAR(tip(full.sun), 0.35, digits(2));
  EXPECT_NEAR(tip(full.planet), 0.26, digits(2));
  EXPECT_NEAR(cut.sun_planet.pair.tip_clearance_1_mm() / 2.63, 0.250, digits(3));
  EXPECT_NEAR(cut.sun_planet.pair.tip_clearance_2_mm() / 2.63, 0.250, digits(3));
  EXPECT_NEAR(full.sun_planet.pair.tip_clearance_1_mm() / 2.63, 0.122, digits(3));
  EXPECT_NEAR(cut.ring_planet.pair.tip_clearance_1_mm(), 1.21, digits(2));
}

TEST(PairOfTable1, PhaseGapAndBoundAreAsPrinted) {
  const GearSet g = geometry();
  EXPECT_NEAR(g.ring_mesh_lead, 0.3023, digits(4));
  // 49 mm with full tips; shortened ones leave 0.67 mm more.
  const GearSet full = geometry(Tips::full);
  EXPECT_NEAR(planet_gap_mm(full), 49.0, digits(0));
  EXPECT_NEAR(planet_gap_mm(g) - planet_gap_mm(full), 2.0 * g.tip_shortening * 2.63, rounding_mm * 10.0);
  EXPECT_NEAR(ring_addendum_bound(problems::table1()), 1.233, digits(3));
}

TEST(PairOfTable1, RingMeshIsBeyondThePitchPointExactlyWhereTheTipIsBeyondThePitchCircle) {
  const double bound = ring_addendum_bound(problems::table1());
  constexpr double step = 1e-4;
  const GearSet below = geometry(Tips::shortened, 1.0, bound - step);
  const GearSet above = geometry(Tips::shortened, 1.0, bound + step);
  EXPECT_EQ(below.ring_planet.pair.side(), PitchSide::beyond);
  EXPECT_EQ(above.ring_planet.pair.side(), PitchSide::across);
  EXPECT_GT(below.ring.tip_radius_mm, below.ring_planet.pair.pitch_radius_2_mm());
  EXPECT_LT(above.ring.tip_radius_mm, above.ring_planet.pair.pitch_radius_2_mm());
}

TEST(PairOfTable1, SlidingSpeedsAtTenThousandTurnsOfTheSun) {
  // docs/theory/friction.md, section 6, fixed ring: the sun turns at 0.75 omega_s relative to the
  // carrier.
  const GearSet g = geometry();
  const double sun = 1e4 * 2.0 * pi / 60.0;
  const double base_speed = 0.75 * sun * g.sun.base_radius_mm * 1e-3;
  const auto sliding = [&](const Pair& p, double l) { return contact_speeds(p, l, base_speed).sliding(); };
  const Pair& sp = g.sun_planet.pair;
  EXPECT_NEAR(sliding(sp, sp.start_mm), -8.1, digits(1));
  EXPECT_NEAR(sliding(sp, sp.pitch_arm_mm), 0.0, rounding_mm);
  EXPECT_NEAR(sliding(sp, sp.end_mm), 6.6, digits(1));
  const Pair& rp = g.ring_planet.pair;
  EXPECT_NEAR(sliding(rp, rp.start_mm), 0.94, digits(2));
  EXPECT_NEAR(sliding(rp, rp.end_mm), 6.2, digits(1));
  EXPECT_NEAR(sliding(rp, rp.pitch_arm_mm), 0.0, rounding_mm);
}

TEST(PairOfTable1, SpeedsOfTheSectionOnKinematics) {
  // omega_c = omega_s / 4, omega_sc = 0.75 omega_s, omega_m = 20.25 omega_s.
  const Stage s = problems::table1();
  const Speeds w = speeds(s, 20.25);
  constexpr double rounding = 1e-14;
  EXPECT_NEAR(w.sun, 1.0, rounding);
  EXPECT_NEAR(w.carrier, 0.25, rounding);
  const Torques t = torques(s, 20.25);
  EXPECT_NEAR(t.carrier, 4.0 * t.sun, rounding * t.carrier);
}

TEST(Pair, SlidingSpeedIsTheDifferenceOfTheFlanksVelocities) {
  // Velocities of both bodies at the contact, projected on the common tangent, from positions in the plane alone.
  const GearSet g = geometry();
  for (const MeshedPair* m : {&g.sun_planet, &g.ring_planet}) {
    const Pair& p = m->pair;
    const double speed = 3.0;
    const double alpha = p.pressure_angle;
    // Axis 1 at the origin, axis 2 at (-+a, 0); N_1 at angle -alpha, the line of action along (sin, cos).
    const double axis_2 = p.internal() ? -p.centre_distance_mm : p.centre_distance_mm;
    const double w_1 = speed / p.driving.base_radius_mm;
    const double w_2 = (p.internal() ? 1.0 : -1.0) * speed / p.driven.base_radius_mm;
    for (const double l : {p.start_mm, 0.5 * (p.start_mm + p.end_mm), p.end_mm}) {
      const double x = p.driving.base_radius_mm * std::cos(alpha) + l * std::sin(alpha);
      const double y = -p.driving.base_radius_mm * std::sin(alpha) + l * std::cos(alpha);
      EXPECT_NEAR(std::hypot(x, y), p.radius_1_mm(l), rounding_mm);
      EXPECT_NEAR(std::hypot(x - axis_2, y), p.radius_2_mm(l), 10.0 * rounding_mm);
      const double v_x = -w_1 * y + w_2 * y;
      const double v_y = w_1 * x - w_2 * (x - axis_2);
      // No approach along the line of action, and the sliding speed across it.
      EXPECT_NEAR(v_x * std::sin(alpha) + v_y * std::cos(alpha), 0.0, rounding_mm);
      const double across = -v_x * std::cos(alpha) + v_y * std::sin(alpha);
      EXPECT_NEAR(across, contact_speeds(p, l, speed).sliding(), rounding_mm) << p.internal() << " " << l;
    }
  }
}

TEST(Pair, ReducedCurvatureIsThatOfTwoCylinders) {
  const GearSet g = geometry();
  const Pair& sp = g.sun_planet.pair;
  const Pair& rp = g.ring_planet.pair;
  constexpr double rounding_per_mm = 1e-15;  // of three divisions
  EXPECT_NEAR(1.0 / sp.curvature_radius_mm(15.0), 1.0 / 15.0 + 1.0 / sp.arm_2_mm(15.0), rounding_per_mm);
  EXPECT_NEAR(1.0 / rp.curvature_radius_mm(15.0), 1.0 / 15.0 - 1.0 / rp.arm_2_mm(15.0), rounding_per_mm);
}

TEST(Pair, BacklashIsZeroAtTheTightCentreDistance) {
  const GearSet g = geometry();
  EXPECT_NEAR(make_pair(g.sun, g.planet, tight_centre_distance_mm(g.sun, g.planet)).backlash_mm(), 0.0, rounding_mm);
  EXPECT_NEAR(make_pair(g.planet, g.ring, tight_centre_distance_mm(g.planet, g.ring)).backlash_mm(), 0.0,
              10.0 * rounding_mm);
}

TEST(Pair, BacklashGrowsWithTheCentreDistanceByTwoSinesOfTheAngle) {
  // On the line of action the flanks part by d j_bn / da = 2 sin alpha; internally they approach.
  const GearSet g = geometry();
  constexpr double h = 1e-4;
  // Central difference: h^2 times derivatives of order 1 / mm^2, and rounding / h.
  constexpr double difference = 1e-8;
  const auto slope = [&](const Tooth& first, const Tooth& second) {
    const auto gap = [&](double a) { return make_pair(first, second, a).normal_backlash_mm(); };
    return (gap(g.centre_distance_mm + h) - gap(g.centre_distance_mm - h)) / (2.0 * h);
  };
  EXPECT_NEAR(slope(g.sun, g.planet), 2.0 * std::sin(g.sun_planet.pair.pressure_angle), difference);
  EXPECT_NEAR(slope(g.planet, g.ring), -2.0 * std::sin(g.ring_planet.pair.pressure_angle), difference);
}

TEST(Pair, UsualFormulaInTheShiftsHoldsForOneReferenceProfile) {
  // inv alpha = inv alpha_0 + 2 (x_1 + x_2) tan alpha_0 / (z_1 + z_2); internal with the differences.
  const double alpha = 25.0 * degree;
  const GearSet g = geometry();
  const double inv = involute(alpha) + 2.0 * (0.623 + 0.775) / 52.0 * std::tan(alpha);
  EXPECT_NEAR(tight_centre_distance_mm(g.sun, g.planet), 68.38 * std::cos(alpha) / std::cos(inverse_involute(inv)),
              10.0 * rounding_mm);
  const Tooth ring = internal_tooth({81, 2.63, 25, 1.1, 1, 0.25, 60, {}, {}});
  const double inv_ring = involute(alpha) + 2.0 * (1.1 - 0.775) / 56.0 * std::tan(alpha);
  EXPECT_NEAR(tight_centre_distance_mm(g.planet, ring),
              0.5 * 2.63 * 56.0 * std::cos(alpha) / std::cos(inverse_involute(inv_ring)), 10.0 * rounding_mm);
}

TEST(Pair, StandardGearsHaveTheContactRatioOfTheTextbook) {
  // eps = (sqrt(r_a1^2 - r_b1^2) + sqrt(r_a2^2 - r_b2^2) - a sin alpha) / p_b: 1.64563 for 19/48 teeth.
  EXPECT_NEAR(problems::tian_pair().contact_ratio(), 1.64563, digits(5));
  EXPECT_NEAR(problems::yi_pair().contact_ratio(), 1.55684, digits(5));
}

TEST(Pair, TipsOfAnInternalPairPassWithoutTouchingIfTheAngleSaysSo) {
  // The driving tip follows its circle; at the crossing of the tip circles its angle in the ring's frame is compared
  // with the ring tooth's tip, both from the flanks' own angles at contact.
  const GearSet g = geometry();
  EXPECT_GT(g.ring_planet.pair.tip_passing_angle(), 0.0);
  EXPECT_EQ(g.sun_planet.pair.tip_passing_angle(), std::numeric_limits<double>::infinity());
  // Near equal tooth numbers collide: 40 in 45 standard teeth at 20 deg.
  const Tooth pinion = external_tooth({40, 1, 20, 0, 1, 0.25, 10, {}, {}});
  const Tooth ring = internal_tooth({45, 1, 20, 0, 1, 0.25, 10, {}, {}});
  EXPECT_LT(make_pair(pinion, ring, 2.5).tip_passing_angle(), 0.0);
}

TEST(Pair, TipPassingAngleIsThatOfTurningBothGears) {
  // Brute force: turn the pinion from the pitch point's contact until its flank's tip crosses the ring's tip circle
  // outside the path, and measure how far the ring's flank tip is from it there.
  const GearSet g = geometry();
  const Pair& p = g.ring_planet.pair;
  const double r_1 = p.driving.tip_radius_mm;
  const double r_2 = p.driven.tip_radius_mm;
  // Flanks through the pitch point (on the line of centres), turned by t and t z_1 / z_2; angles from that line.
  const double tip_1 = involute(p.driving.pressure_angle_at(r_1)) - involute(p.pressure_angle);
  const double tip_2 = involute(p.driven.pressure_angle_at(r_2)) - involute(p.pressure_angle);
  const auto distance = [&](double turn) {
    const double angle = turn - tip_1;
    const double x = p.centre_distance_mm + r_1 * std::cos(angle);
    const double y = r_1 * std::sin(angle);
    return std::hypot(x, y) - r_2;
  };
  double low = tip_1;
  double high = tip_1 + pi;
  for (int k = 0; k < 100; ++k) (distance(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  const double turn = 0.5 * (low + high);
  const double place_1 = std::atan2(r_1 * std::sin(turn - tip_1), p.centre_distance_mm + r_1 * std::cos(turn - tip_1));
  const double place_2 = turn * p.driving.teeth / p.driven.teeth - tip_2;
  constexpr double rounding = 1e-13;  // of angles of order 1
  EXPECT_NEAR(std::abs(place_2 - place_1), std::abs(p.tip_passing_angle()), rounding);
}

TEST(Pair, WhatCannotMeshIsADomainError) {
  const GearSet g = geometry();
  EXPECT_THROW((void)make_pair(g.sun, g.planet, 61.0), DomainError);
  EXPECT_THROW((void)make_pair(g.planet, g.ring, 66.0), DomainError);
  EXPECT_THROW((void)make_pair(g.ring, g.planet, 71.72), DomainError);
}

}  // namespace
}  // namespace epicyclic::gear::pair_test
