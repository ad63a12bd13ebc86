#include "gear/body.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/quadrature.hpp"
#include "gear/gear_set.hpp"
#include "problems/table1.hpp"

namespace epicyclic::gear::body_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-14;
// Half a unit of the last digit of docs/theory/parameters.md, section 2.
constexpr double second_digit = 0.5e-2;
constexpr double third_digit = 0.5e-3;
constexpr double steel = 7850.0;

GearSet table1() {
  Stage s = problems::table1();
  s.catalogue->stiffness.harmonics = 0;
  return make_gear_set(s);
}

double over_r2(const MassAndInertia& m, double radius_mm) { return problems::over_r2(m.inertia_kg_m2, radius_mm); }

TEST(Body, CylinderIsTheIntegralOfItsShells) {
  const MassAndInertia m = cylinder(36.65, 15.0, 60.0, steel);
  const auto shell = [](double r) { return steel * 0.06 * 2.0 * pi * r; };
  const double mass = gauss_legendre_16().integrate(shell, 0.015, 0.03665);
  const double inertia = gauss_legendre_16().integrate([&](double r) { return shell(r) * r * r; }, 0.015, 0.03665);
  EXPECT_NEAR(m.mass_kg, mass, 10.0 * rounding * mass);
  EXPECT_NEAR(m.inertia_kg_m2, inertia, 10.0 * rounding * inertia);
}

TEST(Body, HollowIsFullLessItsCore) {
  const MassAndInertia hollow = cylinder(40.0, 20.0, 10.0, steel);
  const MassAndInertia full = cylinder(40.0, 0.0, 10.0, steel);
  const MassAndInertia core = cylinder(20.0, 0.0, 10.0, steel);
  EXPECT_NEAR(hollow.mass_kg, full.mass_kg - core.mass_kg, rounding);
  EXPECT_NEAR(hollow.inertia_kg_m2, full.inertia_kg_m2 - core.inertia_kg_m2, rounding);
}

TEST(Body, MassesOfTable1AreAsPrinted) {
  // docs/theory/parameters.md, section 2, each to half a unit of its last digit.
  const GearSet g = table1();
  const Bodies b = bodies(g);
  EXPECT_NEAR(body_radius_mm(g.sun), 36.65, second_digit);
  EXPECT_NEAR(body_radius_mm(g.planet), 34.42, second_digit);
  EXPECT_NEAR(body_radius_mm(g.ring), 107.24, second_digit);
  EXPECT_NEAR(b.sun.mass_kg, 1.654, third_digit);
  EXPECT_NEAR(b.sun.inertia_kg_m2, 1.297e-3, third_digit * 1e-3);
  EXPECT_NEAR(over_r2(b.sun, g.sun.base_radius_mm), 1.253, third_digit);
  EXPECT_NEAR(b.planet.mass_kg, 1.037, third_digit);
  EXPECT_NEAR(b.planet.inertia_kg_m2, 8.647e-4, third_digit * 1e-4);
  EXPECT_NEAR(over_r2(b.planet, g.planet.base_radius_mm), 0.974, third_digit);
  ASSERT_TRUE(b.ring.has_value());
  EXPECT_NEAR(b.ring->mass_kg, 4.291, third_digit);
  EXPECT_NEAR(b.ring->inertia_kg_m2, 5.557e-2, third_digit * 1e-2);
  EXPECT_NEAR(over_r2(*b.ring, g.ring.base_radius_mm), 5.963, third_digit);
  ASSERT_TRUE(b.carrier.has_value());
  EXPECT_NEAR(b.carrier->mass_kg, 7.553, third_digit);
}

TEST(Body, CarriersInertiaIsThePrintedOneAndItsPinsAboutTheirOwnAxes) {
  // docs/theory/parameters.md, section 2, takes the pins as points, 3.990e-2 kg m^2 or 7.757 kg on r_c.
  const GearSet g = table1();
  const MassAndInertia c = bodies(g).carrier.value();
  const double pin_mass = steel * 0.09 * pi * 0.015 * 0.015;
  const double pins = 3.0 * 0.5 * pin_mass * 0.015 * 0.015;
  EXPECT_NEAR(c.inertia_kg_m2 - pins, 3.990e-2, third_digit * 1e-2);
  EXPECT_NEAR(over_r2({c.mass_kg, c.inertia_kg_m2 - pins}, g.centre_distance_mm), 7.757, third_digit);
}

TEST(Body, CarrierIsCheeksAndPins) {
  const CarrierBody body{3, 10, 100, 20, 8, 50};
  const MassAndInertia four = carrier(body, 4, 30.0, steel);
  const MassAndInertia none = carrier(body, 0, 30.0, steel);
  const MassAndInertia plate = cylinder(50.0, 10.0, 10.0, steel);
  EXPECT_NEAR(none.mass_kg, 3.0 * plate.mass_kg, rounding);
  EXPECT_NEAR(none.inertia_kg_m2, 3.0 * plate.inertia_kg_m2, rounding);
  const MassAndInertia pin = cylinder(4.0, 0.0, 50.0, steel);
  EXPECT_NEAR(four.mass_kg - none.mass_kg, 4.0 * pin.mass_kg, rounding);
  EXPECT_NEAR(four.inertia_kg_m2 - none.inertia_kg_m2, 4.0 * (pin.inertia_kg_m2 + pin.mass_kg * 0.03 * 0.03), rounding);
}

TEST(Body, OutputShaftOfTable1) {
  // docs/theory/parameters.md, section 3: 60 mm by 150 mm of steel give 6.7e5 N m/rad, 1.3e8 N/m on r_c.
  const Material material;
  const double k = shaft_torsion(60, 0, 150, material.shear_modulus());
  constexpr double first_digit = 0.5e-1;  // half a unit of it
  EXPECT_NEAR(k, 6.7e5, first_digit * 1e5);
  EXPECT_NEAR(problems::over_r2(k, table1().centre_distance_mm), 1.3e8, first_digit * 1e8);
  // G J / L, the polar moment by shells.
  const double polar = gauss_legendre_16().integrate([](double r) { return 2.0 * pi * r * r * r; }, 0.01, 0.03);
  const double expected = material.shear_modulus() * polar / 0.15;
  EXPECT_NEAR(shaft_torsion(60, 20, 150, material.shear_modulus()), expected, 10.0 * rounding * expected);
}

TEST(Body, BodiesAreMissingWhereDrawingsAre) {
  Stage s = problems::table1();
  s.catalogue->stiffness.harmonics = 0;
  s.catalogue->ring.outer_diameter_mm.reset();
  s.catalogue->carrier.body.reset();
  const Bodies b = bodies(make_gear_set(s));
  EXPECT_FALSE(b.ring.has_value());
  EXPECT_FALSE(b.carrier.has_value());
}

TEST(Body, WhatIsNoCylinderIsADomainError) {
  EXPECT_THROW((void)cylinder(10.0, 10.0, 5.0, steel), DomainError);
  EXPECT_THROW((void)cylinder(10.0, -1.0, 5.0, steel), DomainError);
  EXPECT_THROW((void)cylinder(10.0, 5.0, 0.0, steel), DomainError);
  EXPECT_THROW((void)cylinder(std::nan(""), 5.0, 1.0, steel), DomainError);
}

}  // namespace
}  // namespace epicyclic::gear::body_test
