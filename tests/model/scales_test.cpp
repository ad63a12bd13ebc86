#include "model/scales.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "problems/r1.hpp"

namespace epicyclic::model::scales_test {
namespace {

// A few roundings in a row, relative.
constexpr double rounding = 1e-14;

TEST(Scales, NaturalFrequencyOfR1IsThatOfItsDigits) {
  // docs/theory/published_results.md, section 5: 47914.909944 rad/s, six decimals.
  constexpr double digits = 0.5e-6;
  EXPECT_NEAR(scales_of(problems::r1()).omega_sn, 47914.909944, digits);
}

TEST(Scales, MeanMeshStiffnessAndReducedMassAreOne) {
  const gear::Stage s = problems::r1();
  const Scales scales = scales_of(s);
  EXPECT_NEAR(scales.stiffness(s.sun_planet_mesh.stiffness_N_per_m), 1.0, rounding);
  const double m_s = scales.mass_ratio(s.sun.inertia_over_r2_kg);
  const double m_p = scales.mass_ratio(s.planet.inertia_over_r2_kg);
  EXPECT_NEAR(1.0 / m_s + 1.0 / m_p, 1.0, rounding);
}

TEST(Scales, RoundTripsAndUnitsAgree) {
  const Scales scales = scales_of(problems::r1());
  EXPECT_EQ(scales.displacement(1e-5), 1.0);
  EXPECT_NEAR(scales.displacement(40e-6), 4.0, rounding * 4.0);
  EXPECT_NEAR(scales.displacement_um(scales.displacement(12.3e-6)), 12.3, rounding * 12.3);
  EXPECT_NEAR(scales.force_newton(scales.force(1751.0)), 1751.0, rounding * 1751.0);
  // k d is a force, c v is a force, m a is a force.
  const double k = 1.1e8;
  const double d = 3e-6;
  EXPECT_NEAR(scales.stiffness(k) * scales.displacement(d), scales.force(k * d), rounding * scales.force(k * d));
  const double c = 2600.0;
  const double v = 0.02;
  const double v_scaled = v / (length_scale_m * scales.omega_sn);
  EXPECT_NEAR(scales.damping(c) * v_scaled, scales.force(c * v), rounding * scales.force(c * v));
  const double m = 1.3;
  const double a = 4e3;
  const double a_scaled = a / (length_scale_m * scales.omega_sn * scales.omega_sn);
  EXPECT_NEAR(scales.mass_ratio(m) * a_scaled, scales.force(m * a), rounding * scales.force(m * a));
  const double hertz = 4e10;
  EXPECT_NEAR(scales.hertz(hertz) * std::pow(scales.displacement(d), 1.5), scales.force(hertz * std::pow(d, 1.5)),
              rounding * scales.force(hertz * std::pow(d, 1.5)));
}

TEST(Scales, OnlyMeanStiffnessAndInertiasOfSunAndPlanetMatter) {
  gear::Stage s = problems::r1_nonlinear();
  const double omega_sn = scales_of(s).omega_sn;
  s.sun_planet_mesh.stiffness_cos_N_per_m = {2e8};
  s.sun_planet_mesh.backlash_half_um = 3.0;
  s.carrier.mass_kg = 99.0;
  s.ring_planet_mesh.stiffness_N_per_m = 2e9;
  EXPECT_EQ(scales_of(s).omega_sn, omega_sn);
  s.sun_planet_mesh.stiffness_N_per_m *= 4.0;
  EXPECT_NEAR(scales_of(s).omega_sn, 2.0 * omega_sn, rounding * omega_sn);
}

}  // namespace
}  // namespace epicyclic::model::scales_test
