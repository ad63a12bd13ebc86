#include "gear/bearing.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/quadrature.hpp"
#include "gear/bearing_life.hpp"

namespace epicyclic::gear::bearing_test {
namespace {

constexpr double um = 1e-6;

double coefficient_of(const std::string& designation) {
  const BearingType type = find_bearing(designation).value();
  return palmgren_coefficient(type.elements, type.diameter_mm, 0.0);
}

double pitch_mm(const BearingType& b) { return 0.5 * (b.bore_mm + b.outer_diameter_mm); }

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
  EXPECT_EQ(sun.elements, 10);
  EXPECT_EQ(sun.diameter_mm, 16.67);
  EXPECT_EQ(sun.bore_mm, 65.0);
  const BearingType carrier = find_bearing("6020").value();
  EXPECT_EQ(carrier.elements, 14);
  EXPECT_EQ(carrier.diameter_mm, 16.0);
  EXPECT_EQ(carrier.bore_mm, 100.0);
}

TEST(BearingCatalogue, UnknownDesignationsAreNotFound) {
  for (const char* unknown : {"", "6", "62130", "6213-2RS", "NU 213", "NU2213", " 6213"})
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
    EXPECT_EQ(find_bearing(name).value().elements, b.elements);
    EXPECT_FALSE(b.origin.empty() || b.ratings.empty()) << name;
    // ISO 15: bore is five times the last two digits from 04 on.
    EXPECT_EQ(b.bore_mm, 5.0 * std::stoi(name.substr(name.find_last_of("0123456789") - 1, 2))) << name;
    EXPECT_GT(b.outer_diameter_mm, b.bore_mm) << name;
    // They fit radially with rings around them, and on their pitch circle with room between; the groove is as wide.
    EXPECT_LT(b.diameter_mm, 0.5 * (b.outer_diameter_mm - b.bore_mm)) << name;
    EXPECT_LT(b.has_balls() ? b.diameter_mm : b.length_mm, b.width_mm) << name;
    EXPECT_LT(b.elements * b.diameter_mm, 3.14159 * pitch_mm(b)) << name;
  }
  EXPECT_GE(seen.size(), 100U);
}

/// Factor f_0 of ISO 76, table 1, by gamma in hundredths.
double f_0(double gamma) {
  constexpr std::array table = {14.7, 14.9, 15.1, 15.3, 15.5, 15.7, 15.9, 16.1, 16.3, 16.5, 16.4, 16.1, 15.9,
                                15.6, 15.4, 15.2, 14.9, 14.7, 14.4, 14.2, 14.0, 13.7, 13.5, 13.2, 13.0, 12.8,
                                12.5, 12.3, 12.1, 11.8, 11.6, 11.4, 11.2, 10.9, 10.7, 10.5, 10.3};
  const double at = 100.0 * gamma;
  const auto k = static_cast<std::size_t>(at);
  return table.at(k) + (at - static_cast<double>(k)) * (table.at(k + 1) - table.at(k));
}

TEST(BearingCatalogue, LoadRatingsAreThoseOfIso76AndIso281) {
  // ISO 76 and ISO/TR 1281-1: balls with grooves of 0.52 D_w and their reduction factor 0.95; rollers with 0.83.
  // Load ratings have three digits and the 6020 of Table 3 is none of NSK's.
  constexpr double makers = 0.03;
  for (const BearingType& b : bearing_types()) {
    if (b.designation == "6020") continue;
    const double g = b.diameter_mm / pitch_mm(b);
    const double z = b.elements;
    const double d = b.diameter_mm;
    double static_N = 0.0;
    double dynamic_N = 0.0;
    if (b.has_balls()) {
      const double f_c = 0.95 * 39.9 *
                         std::pow(1.0 + std::pow(1.04 * std::pow((1.0 - g) / (1.0 + g), 1.72), 10.0 / 3.0), -0.3) *
                         std::pow(g, 0.3) * std::pow(1.0 - g, 1.39) / std::cbrt(1.0 + g) * std::pow(1.04 / 0.04, 0.41);
      static_N = f_0(g) * z * d * d;
      dynamic_N = 1.3 * f_c * std::pow(z, 2.0 / 3.0) * (d <= 25.4 ? std::pow(d, 1.8) : 3.647 * std::pow(d, 1.4));
    } else {
      const double f_c =
          0.83 * 208.0 *
          std::pow(1.0 + std::pow(1.04 * std::pow((1.0 - g) / (1.0 + g), 143.0 / 108.0), 4.5), -2.0 / 9.0) *
          std::pow(g, 2.0 / 9.0) * std::pow(1.0 - g, 29.0 / 27.0) / std::pow(1.0 + g, 0.25);
      static_N = 44.0 * (1.0 - g) * z * b.length_mm * d;
      dynamic_N = 1.1 * f_c * std::pow(b.length_mm, 7.0 / 9.0) * std::pow(z, 0.75) * std::pow(d, 29.0 / 27.0);
    }
    EXPECT_NEAR(1e-3 * static_N / b.static_rating_kN, 1.0, makers) << b.designation;
    EXPECT_NEAR(1e-3 * dynamic_N / b.dynamic_rating_kN, 1.0, makers) << b.designation;
  }
}

TEST(BearingLife, IsThatOfIso281) {
  // By hand: C / P = 2 gives 8 million revolutions of balls, 2^(10/3) of rollers; at 1000 rpm 1e6/6e4 h each million.
  constexpr double rounding = 1e-13;
  const double speed = 1000.0 * 2.0 * std::numbers::pi / 60.0;
  const BearingLife balls = bearing_life({20e3, 3.0, speed}, 10e3);
  EXPECT_NEAR(balls.million_revolutions, 8.0, 8.0 * rounding);
  EXPECT_NEAR(balls.hours, 8e6 / 60e3, 8e6 / 60e3 * rounding);
  EXPECT_NEAR(bearing_life({20e3, 10.0 / 3.0, speed}, 10e3).million_revolutions, std::pow(2.0, 10.0 / 3.0), 1e-12);
  EXPECT_EQ(bearing_life({20e3, 3.0, speed}, 20e3).million_revolutions, 1.0);
  EXPECT_TRUE(std::isinf(bearing_life({20e3, 3.0, speed}, 0.0).hours));
}

TEST(BearingLife, SpeedsAreThoseOfTheRings) {
  gear::Stage stage;
  stage.boundary = Boundary::fixed_ring;
  stage.sun.teeth = 20;
  stage.planet.teeth = 30;
  stage.ring.teeth = 80;
  EXPECT_FALSE(bearing_loads(stage, 1.0).sun || bearing_loads(stage, 1.0).planet);
  stage.sun_bearing.rating.dynamic_load_rating_kN = 50.0;
  stage.planet.rating = {40.0, RollingElements::balls};
  const BearingLoads loads = bearing_loads(stage, 800.0);
  ASSERT_TRUE(loads.sun && loads.planet);
  // Willis: the carrier turns with 800 / 80, the sun with five times that, a planet against the carrier with 800 / 30.
  constexpr double rounding = 1e-13;
  EXPECT_NEAR(loads.sun->speed_rad_per_s, 50.0, 50.0 * rounding);
  EXPECT_NEAR(loads.planet->speed_rad_per_s, 800.0 / 30.0, 30.0 * rounding);
  EXPECT_EQ(loads.sun->exponent, 3.0);
  EXPECT_EQ(loads.planet->exponent, 3.0);
  stage.planet.rating.rolling_elements.reset();
  EXPECT_EQ(bearing_loads(stage, 800.0).planet->exponent, 10.0 / 3.0);
  EXPECT_EQ(loads.planet->rating_N, 40e3);
}

TEST(RollerBearing, ForceIsPalmgrensLineContactInverted) {
  constexpr int rollers = 14;
  constexpr double length_mm = 11.0;
  for (const double load_N : {200.0, 2000.0, 20000.0}) {
    const double approach_mm = 7.68e-5 * std::pow(5.0 * load_N / rollers, 0.9) / std::pow(length_mm, 0.8);
    EXPECT_NEAR(roller_force(1e-3 * approach_mm, rollers, length_mm) / load_N, 1.0, 1e-12);
  }
  const BearingData data = bearing_data({.type = "NU209"}).value();
  EXPECT_EQ(data.kind, RollingElements::rollers);
  EXPECT_EQ(data.force(5e-6), roller_force(5e-6, 15, 11.0));
  EXPECT_EQ(data.stiffness(5e-6), roller_stiffness(data.force(5e-6), 15, 11.0));
  EXPECT_EQ(bearing_data({.type = "", .rollers = 15, .roller_length_mm = 11.0})->force(5e-6), data.force(5e-6));
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
