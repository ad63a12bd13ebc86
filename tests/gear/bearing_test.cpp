#include "gear/bearing.hpp"

#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/quadrature.hpp"

namespace epicyclic::gear::bearing_test {
namespace {

constexpr double um = 1e-6;

double coefficient_of(const std::string& designation) {
  const BearingType type = find_bearing(designation).value();
  return palmgren_coefficient(type.balls, type.ball_diameter_mm, 0.0);
}

TEST(BearingCatalogue, StiffnessAndForceOfBothBearingsOfTable3) {
  // docs/theory/parameters.md, section 5: k_tan to four digits, F of the 6213 to 0.1 N.
  struct Row {
    const char* designation;
    double approach_um, stiffness, force;
  };
  const Row rows[] = {
      {"6213", 1, 4.248e7, 28.3},    {"6213", 5, 9.498e7, 316.6}, {"6213", 10, 1.343e8, 895.5},
      {"6213", 20, 1.900e8, 2532.9}, {"6020", 1, 5.826e7, 0.0},   {"6020", 5, 1.303e8, 0.0},
      {"6020", 10, 1.842e8, 0.0},    {"6020", 20, 2.606e8, 0.0},
  };
  constexpr double newton_digit = 0.05001;
  for (const Row& r : rows) {
    const double k = palmgren_stiffness(coefficient_of(r.designation), r.approach_um * um);
    const double digit = 0.5001 * std::pow(10.0, std::floor(std::log10(r.stiffness)) - 3.0);
    EXPECT_NEAR(k, r.stiffness, digit) << r.designation << " " << r.approach_um;
    if (r.force > 0.0) {
      EXPECT_NEAR(palmgren_force(coefficient_of(r.designation), r.approach_um * um), r.force, newton_digit);
    }
  }
}

TEST(BearingCatalogue, ForceIsTheIntegralOfTheTangentStiffness) {
  constexpr double rounding = 1e-14;
  const double c = coefficient_of("6213");
  for (const double approach : {1.0 * um, 7.5 * um, 40.0 * um}) {
    // d = t^2 takes the root out of the integrand.
    const double force = gauss_legendre_16().integrate([&](double t) { return 2.0 * t * palmgren_stiffness(c, t * t); },
                                                       0.0, std::sqrt(approach));
    EXPECT_NEAR(palmgren_force(c, approach), force, rounding * force * 10.0) << approach;
  }
}

TEST(BearingCatalogue, ForceIsPalmgrensPointContactInverted) {
  // delta = 4.36e-4 (Q^2 / D_w)^(1/3), Q = 5 F / Z: mm and N. 32900 is printed for 32953.
  const double force = 900.0;
  const double ball_load = 5.0 * force / 10.0;
  const double approach_mm = 4.36e-4 * std::cbrt(ball_load * ball_load / 16.67);
  constexpr double printed_constant = 2e-3;
  EXPECT_NEAR(palmgren_force(coefficient_of("6213"), approach_mm * 1e-3) / force, 1.0, printed_constant);
  EXPECT_NEAR(32900.0 / 32953.0, 1.0, printed_constant);
}

TEST(BearingCatalogue, NothingIsPressedWithoutApproach) {
  EXPECT_EQ(palmgren_stiffness(1e10, 0.0), 0.0);
  EXPECT_EQ(palmgren_force(1e10, 0.0), 0.0);
}

TEST(BearingCatalogue, BearingsOfTable3AreThoseOfThePaper) {
  const BearingType sun = find_bearing("6213").value();
  EXPECT_EQ(sun.balls, 10);
  EXPECT_EQ(sun.ball_diameter_mm, 16.67);
  EXPECT_EQ(sun.bore_mm, 65.0);
  const BearingType carrier = find_bearing("6020").value();
  EXPECT_EQ(carrier.balls, 14);
  EXPECT_EQ(carrier.ball_diameter_mm, 16.0);
  EXPECT_EQ(carrier.bore_mm, 100.0);
}

TEST(BearingCatalogue, UnknownDesignationsAreNotFound) {
  for (const char* unknown : {"", "6", "62130", "6213-2RS", "NU213", " 6213"})
    EXPECT_FALSE(find_bearing(unknown).has_value()) << unknown;
}

TEST(BearingCatalogue, EveryEntryIsABearingThatCanBeMade) {
  std::set<std::string> seen;
  std::string last;
  for (const BearingType& b : bearing_types()) {
    const std::string name(b.designation);
    EXPECT_TRUE(seen.insert(name).second) << name;
    EXPECT_LT(last, name);
    last = name;
    EXPECT_EQ(find_bearing(name).value().balls, b.balls);
    EXPECT_FALSE(b.origin.empty()) << name;
    // ISO 15: bore is five times the last two digits from 04 on.
    EXPECT_EQ(b.bore_mm, 5.0 * std::stoi(name.substr(2))) << name;
    EXPECT_GT(b.outer_diameter_mm, b.bore_mm) << name;
    // Balls fit radially with rings around them, and on their pitch circle with room between; the groove is as wide.
    EXPECT_LT(b.ball_diameter_mm, 0.5 * (b.outer_diameter_mm - b.bore_mm)) << name;
    EXPECT_LT(b.ball_diameter_mm, b.width_mm) << name;
    const double pitch = 0.5 * (b.bore_mm + b.outer_diameter_mm);
    EXPECT_LT(b.balls * b.ball_diameter_mm, 3.14159 * pitch) << name;
  }
  EXPECT_GE(seen.size(), 2U);
}

TEST(RollerBearing, StiffnessIsTheSlopeOfPalmgrensLineContact) {
  // 7.68e-5 mm Q^0.9 / l^0.8 at Q = 5 F / Z; the coefficient 3400 has two digits.
  constexpr int rollers = 11;
  constexpr double length_mm = 24.0;
  const auto yields_mm = [&](double load_N) {
    return 7.68e-5 * std::pow(5.0 * load_N / rollers, 0.9) / std::pow(length_mm, 0.8);
  };
  constexpr double printed_digits = 5e-3;
  for (const double load_N : {300.0, 3000.0, 30000.0}) {
    const double step = 1e-4 * load_N;
    const double slope = 2.0 * step / (yields_mm(load_N + step) - yields_mm(load_N - step));
    EXPECT_NEAR(1e-3 * roller_stiffness(load_N, rollers, length_mm) / slope, 1.0, printed_digits) << load_N;
  }
  // Gargiulo's 0.3e6 lb/in with lb and in.
  constexpr double newton_per_lb = 4.4482216;
  constexpr double mm_per_in = 25.4;
  const double gargiulo = 0.3e6 * newton_per_lb / mm_per_in * std::pow(3000.0 / newton_per_lb, 0.1) *
                          std::pow(rollers, 0.9) * std::pow(length_mm / mm_per_in, 0.8);
  EXPECT_NEAR(1e-3 * roller_stiffness(3000.0, rollers, length_mm) / gargiulo, 1.0, printed_digits);
}

}  // namespace
}  // namespace epicyclic::gear::bearing_test
