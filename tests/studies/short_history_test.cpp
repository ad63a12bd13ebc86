// A short history against an oscillator whose solution is known.

#include "studies/short_history.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace epicyclic::studies::short_history_test {
namespace {

constexpr double stiffness = 3.0;
constexpr double frequency = 2.0;
constexpr double error = 1e-8;  // of the method at a relative tolerance of 1e-10, over three periods

/// x'' = -frequency^2 x in s; the sun mesh deflects by x, the ring mesh by -2 x, forces are stiffness times these.
model::DynamicModel oscillator() {
  model::DynamicModel m;
  m.planets = 1;
  m.dimension = 2;
  m.scales = {10.0, 2.0};
  m.right_hand_side = [](std::size_t, double, const double* y, double* dyds) {
    dyds[0] = y[1];
    dyds[1] = -frequency * frequency * y[0];
  };
  m.deflections = [](double, const double* y, model::MeshDeflections& d) {
    d.sun_planet = {y[0]};
    d.ring_planet = {-2.0 * y[0]};
    d.sun_planet_rate = {y[1]};
    d.ring_planet_rate = {-2.0 * y[1]};
  };
  m.forces = [](double, const double* y, model::StageForces& f) {
    f.sun_planet = {stiffness * y[0]};
    f.ring_planet = {-2.0 * stiffness * y[0]};
  };
  return m;
}

integrate::IntegratorOptions fine() {
  integrate::IntegratorOptions options;
  options.relative_tolerance = 1e-10;
  options.absolute_tolerance = 1e-12;
  return options;
}

TEST(ShortHistory, IsTheSolutionWithBothEnds) {
  constexpr int periods = 3;
  constexpr int phases = 8;
  const model::DynamicModel m = oscillator();
  const auto history = short_history(m, std::vector{1.5, 0.0}, fine(), periods, phases);
  ASSERT_TRUE(history.has_value());
  for (const auto& column : history->columns) ASSERT_EQ(column.size(), 1U + periods * phases);
  const double newton = 2.0 * 10.0 * 10.0 * model::length_scale_m;  // m_0 omega_sn^2 b_c
  for (std::size_t k = 0; k <= periods * phases; ++k) {
    const double s = 2.0 * std::numbers::pi * static_cast<double>(k) / phases;
    const double x = 1.5 * std::cos(frequency * s);
    const double v = -1.5 * frequency * std::sin(frequency * s);
    const std::array expected = {x, -2.0 * x, v, -2.0 * v, stiffness * x * newton, -2.0 * stiffness * x * newton};
    for (std::size_t j = 0; j < expected.size(); ++j)
      EXPECT_NEAR(history->columns[j][k], expected[j], error) << ShortHistory::names[j] << " at " << k;
  }
}

TEST(ShortHistory, IsNothingWhereTheEndIsNotReached) {
  model::DynamicModel m = oscillator();
  m.right_hand_side = [](std::size_t, double, const double* y, double* dyds) {
    dyds[0] = y[0] * y[0];
    dyds[1] = 0.0;
  };
  EXPECT_FALSE(short_history(m, std::vector{1.0, 0.0}, fine(), 1, 4).has_value());
}

}  // namespace
}  // namespace epicyclic::studies::short_history_test
