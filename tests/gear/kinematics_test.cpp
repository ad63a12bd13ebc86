#include "gear/kinematics.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "gear/bearing.hpp"
#include "problems/r1.hpp"

namespace epicyclic::gear::kinematics_test {
namespace {

// A few roundings in a row.
constexpr double rounding = 1e-14;

constexpr double omega_sn = 47914.909944;  // of R1 [rad/s]
constexpr double rpm = 2.0 * std::numbers::pi / 60.0;

TEST(Kinematics, FixedRingMeshFrequencyIsThatOfBothMeshes) {
  const Stage s = problems::r1();
  const double mesh_frequency = 12345.0;
  const Speeds w = speeds(s, mesh_frequency);
  EXPECT_NEAR(27.0 * (w.sun - w.carrier), mesh_frequency, rounding * mesh_frequency);
  EXPECT_NEAR(81.0 * w.carrier, mesh_frequency, rounding * mesh_frequency);
  EXPECT_NEAR(w.carrier, w.sun * 27.0 / (27.0 + 81.0), rounding * w.sun);
}

TEST(Kinematics, LiteralTurnsAsTheFixedRingAndStarHoldsTheCarrier) {
  const Speeds fixed = speeds(problems::r1(), 1000.0);
  const Speeds as_printed = speeds(problems::as_printed(problems::r1()), 1000.0);
  const Speeds star = speeds(problems::star(problems::r1()), 1000.0);
  EXPECT_EQ(as_printed.sun, fixed.sun);
  EXPECT_EQ(as_printed.carrier, fixed.carrier);
  EXPECT_EQ(star.carrier, 0.0);
  EXPECT_NEAR(27.0 * star.sun, 1000.0, rounding * 1000.0);
}

TEST(Kinematics, TorquesBalanceAndTransmitThePower) {
  constexpr double mesh_frequency = 30000.0;
  const Stage fixed = problems::r1();
  const Torques t = torques(fixed, mesh_frequency);
  const Speeds w = speeds(fixed, mesh_frequency);
  EXPECT_NEAR(t.sun * w.sun, 400e3, rounding * 400e3);
  EXPECT_NEAR(t.carrier * w.carrier, 400e3, rounding * 400e3);
  EXPECT_NEAR(t.carrier, 4.0 * t.sun, rounding * t.carrier);
  EXPECT_EQ(t.ring, 0.0);

  const Torques as_printed = torques(problems::as_printed(problems::r1()), mesh_frequency);
  EXPECT_EQ(as_printed.carrier, t.carrier);
  EXPECT_EQ(as_printed.ring, 0.0);

  const Stage star_stage = problems::star(problems::r1());
  const Torques star = torques(star_stage, mesh_frequency);
  const Speeds star_speeds = speeds(star_stage, mesh_frequency);
  EXPECT_NEAR(star.sun * star_speeds.sun, 400e3, rounding * 400e3);
  EXPECT_NEAR(star.ring, 3.0 * star.sun, rounding * star.ring);
  EXPECT_EQ(star.carrier, 0.0);
}

TEST(Kinematics, GivenTorqueDoesNotDependOnSpeed) {
  Stage s = problems::r1();
  s.load = {std::nullopt, 752.0};
  EXPECT_EQ(torques(s, 100.0).sun, 752.0);
  EXPECT_EQ(torques(s, 9e4).sun, 752.0);
}

TEST(Kinematics, SpeedsAndLoadsAreThoseOfTheTable) {
  // docs/theory/parameters.md, section 1; each tolerance is one unit of the last printed digit (its inputs are rounded
  // too).
  struct Row {
    double omega, sun_rpm, torque, force, deflection_um, carrier_ratio;
    double torque_digit, force_digit;
  };
  const Row rows[] = {
      {0.20, 4519, 845, 8756, 6.96, 0.0025, 1.0, 1.0},  {0.60, 13557, 282, 2919, 2.32, 0.0074, 1.0, 1.0},
      {1.00, 22595, 169, 1751, 1.39, 0.0123, 1.0, 1.0}, {1.17, 26436, 144, 1497, 1.19, 0.0144, 1.0, 1.0},
      {2.05, 46320, 82.5, 854, 0.68, 0.0253, 0.1, 1.0}, {2.83, 63945, 59.7, 619, 0.49, 0.0349, 0.1, 1.0},
      {3.10, 70045, 54.5, 565, 0.45, 0.0383, 0.1, 1.0},
  };
  constexpr double half = 0.5;
  constexpr double rpm_digit = 1.0;
  constexpr double um_digit = 0.01;
  constexpr double ratio_digit = 1e-4;
  const Stage s = problems::r1();
  for (const Row& r : rows) {
    const double mesh_frequency = r.omega * omega_sn;
    const Speeds w = speeds(s, mesh_frequency);
    const Torques t = torques(s, mesh_frequency);
    const double force = t.sun / (3.0 * *s.sun.base_radius_mm * 1e-3);
    EXPECT_NEAR(w.sun / rpm, r.sun_rpm, half * rpm_digit) << r.omega;
    EXPECT_NEAR(t.sun, r.torque, half * r.torque_digit) << r.omega;
    EXPECT_NEAR(force, r.force, half * r.force_digit) << r.omega;
    EXPECT_NEAR(force / s.sun_planet_mesh.stiffness_N_per_m * 1e6, r.deflection_um, half * um_digit) << r.omega;
    EXPECT_NEAR(w.carrier / omega_sn, r.carrier_ratio, half * ratio_digit) << r.omega;
  }
}

TEST(Kinematics, PressureAnglesAreThoseOfTable1) {
  // 30.22094 and 21.47781 degrees of docs/theory/gears.md, section 8, to four digits.
  constexpr double digits_deg = 1e-4;
  const PressureAngles a = pressure_angles(problems::tang2020());
  EXPECT_NEAR(a.sun_planet * 180.0 / std::numbers::pi, 30.22094, digits_deg);
  EXPECT_NEAR(a.ring_planet * 180.0 / std::numbers::pi, 21.47781, digits_deg);
}

TEST(Kinematics, RadiiDecideTheAngleAndElseItIsAsGiven) {
  Stage s = problems::r1();
  s.sun_planet_mesh.operating_pressure_angle_deg = 30.22;
  const double cosine = (*s.sun.base_radius_mm + *s.planet.base_radius_mm) / *s.centre_distance_mm;
  EXPECT_NEAR(std::cos(pressure_angles(s).sun_planet), cosine, rounding);
  s.centre_distance_mm.reset();
  s.ring_planet_mesh.operating_pressure_angle_deg = 21.5;
  EXPECT_NEAR(pressure_angles(s).sun_planet, 30.22 * std::numbers::pi / 180.0, rounding);
  EXPECT_NEAR(pressure_angles(s).ring_planet, 21.5 * std::numbers::pi / 180.0, rounding);
  s.ring_planet_mesh.operating_pressure_angle_deg.reset();
  EXPECT_THROW((void)pressure_angles(s), DomainError);
}

TEST(Kinematics, MissingTeethAreADomainError) {
  Stage s = problems::r1();
  s.sun.teeth.reset();
  EXPECT_THROW((void)speeds(s, 1.0), DomainError);
}

TEST(Bearing, TangentStiffnessAndForceAreThoseOfTheTable) {
  // docs/theory/parameters.md, section 5: k_tan printed to four digits, F to 0.1 N.
  struct Row {
    int balls;
    double diameter_mm, approach_um, stiffness, force;
  };
  const Row rows[] = {
      {10, 16.67, 1, 4.248e7, 28.3},    {10, 16.67, 5, 9.498e7, 316.6}, {10, 16.67, 10, 1.343e8, 895.5},
      {10, 16.67, 20, 1.900e8, 2532.9}, {14, 16.0, 1, 5.826e7, 0.0},    {14, 16.0, 5, 1.303e8, 0.0},
      {14, 16.0, 10, 1.842e8, 0.0},     {14, 16.0, 20, 2.606e8, 0.0},
  };
  constexpr double digits = 5e-4;
  constexpr double newton_digit = 0.06;
  for (const Row& r : rows) {
    const SunBearing bearing{0.0, BearingLaw::palmgren_radial, r.balls, r.diameter_mm, 0.0};
    const double k = palmgren_coefficient(bearing) * std::sqrt(r.approach_um * 1e-6);
    EXPECT_NEAR(k / r.stiffness, 1.0, digits) << r.balls << " balls, " << r.approach_um << " um";
    if (r.force > 0.0) {
      EXPECT_NEAR(2.0 / 3.0 * k * r.approach_um * 1e-6, r.force, newton_digit);
    }
  }
}

TEST(Bearing, ContactAngleEntersByTheFiveHalvesPowerOfItsCosine) {
  const SunBearing straight{0.0, BearingLaw::palmgren_xy, 10, 16.67, 0.0};
  const SunBearing inclined{0.0, BearingLaw::palmgren_xy, 10, 16.67, 25.0};
  const double ratio = palmgren_coefficient(inclined) / palmgren_coefficient(straight);
  EXPECT_NEAR(ratio, std::pow(std::cos(25.0 * std::numbers::pi / 180.0), 2.5), rounding);
}

TEST(Bearing, MissingBallsAreADomainError) {
  EXPECT_THROW((void)palmgren_coefficient({0.0, BearingLaw::palmgren_xy, std::nullopt, 16.67, 0.0}), DomainError);
  EXPECT_THROW((void)palmgren_coefficient({0.0, BearingLaw::palmgren_xy, 10, std::nullopt, 0.0}), DomainError);
}

}  // namespace
}  // namespace epicyclic::gear::kinematics_test
