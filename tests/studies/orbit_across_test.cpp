// Orbits followed from one value of a parameter to another one, of systems whose multipliers are known.

#include "studies/orbit_across.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "integrate/make_field.hpp"

namespace epicyclic::studies::orbit_across_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double error = 1e-5;  // of multipliers, by a relative tolerance of 1e-7 over a period

/// x'' + c x' + (a + q cos s) x + x^3 = 0. The orbit x = 0 has the multipliers of Mathieu's equation.
VectorField mathieu(double c, double a, double q) {
  return integrate::make_field(2, two_pi, [=](std::size_t, double s, const auto* y, auto* d) {
    d[0] = y[1];
    d[1] = -c * y[1] - (a + q * std::cos(s)) * y[0] - y[0] * y[0] * y[0];
  });
}

/// y' = p - y^2: two orbits for p > 0, which meet at p = 0.
VectorField saddle_node(double p) {
  return integrate::make_field(1, two_pi, [=](std::size_t, double, const auto* y, auto* d) { d[0] = p - y[0] * y[0]; });
}

std::optional<OrbitAcross> follow(const FieldFamily& field_at, std::vector<double> start) {
  integrate::IntegratorOptions options;
  options.relative_tolerance = 1e-9;
  options.absolute_tolerance = 1e-11;
  return orbit_across(field_at, start, 1, options);
}

std::optional<OrbitAcross> across(const VectorField& here, const VectorField& there, std::vector<double> start) {
  return follow([&](double part) { return part < 1.0 ? here : there; }, std::move(start));
}

TEST(OrbitAcross, PairLeavesAtATorusBifurcation) {
  // Without the forcing: exp(-pi c) in modulus.
  const auto result = across(mathieu(0.1, 0.09, 0.0), mathieu(-0.1, 0.09, 0.0), {0.0, 0.0});
  ASSERT_TRUE(result && result->found);
  EXPECT_NEAR(std::abs(result->here), std::exp(-0.1 * std::numbers::pi), error);
  EXPECT_NEAR(std::abs(result->there), std::exp(0.1 * std::numbers::pi), error);
  EXPECT_GT(result->there.imag(), 0.1);
  EXPECT_EQ(result->unstable, 2);
  EXPECT_TRUE(result->one_kind);
}

TEST(OrbitAcross, RealMultipliersKeepTheirSign) {
  // Principal parametric resonance at a = 1/4: a period doubling. Second one at a = 1: multiplier + 1.
  const auto doubling = across(mathieu(0.1, 0.25, 0.01), mathieu(0.1, 0.25, 0.3), {0.0, 0.0});
  ASSERT_TRUE(doubling && doubling->found);
  EXPECT_LT(std::abs(doubling->here), 1.0);
  EXPECT_LT(doubling->there.real(), -1.0);
  EXPECT_EQ(doubling->there.imag(), 0.0);
  EXPECT_EQ(doubling->unstable, 1);

  const auto pitchfork = across(mathieu(0.05, 0.1, 0.0), mathieu(0.05, -0.1, 0.0), {0.0, 0.0});
  ASSERT_TRUE(pitchfork && pitchfork->found);
  EXPECT_NEAR(pitchfork->there.real(), std::exp(two_pi * (std::sqrt(0.100625) - 0.025)), 1e-4);
  EXPECT_EQ(pitchfork->unstable, 1);
}

TEST(OrbitAcross, ProductOfMultipliersIsThatOfLiouville) {
  const auto result = across(mathieu(0.2, 0.09, 0.02), mathieu(0.2, 0.09, 0.03), {0.0, 0.0});
  ASSERT_TRUE(result && result->found);
  EXPECT_EQ(result->unstable, 0);
  EXPECT_NEAR(std::norm(result->there), std::exp(-0.2 * two_pi), error);
}

TEST(OrbitAcross, NoOrbitBeyondAFold) {
  // The largest multiplier is exp(-4 pi sqrt(p)).
  const auto result = follow([](double part) { return saddle_node(0.01 - 0.018 * part); }, {0.1});
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->here.real(), std::exp(-0.2 * two_pi), error);
  EXPECT_FALSE(result->found);
  EXPECT_TRUE(result->fold);
  EXPECT_GT(result->part, 0.5);
  EXPECT_LE(result->part, 0.01 / 0.018);
  EXPECT_NEAR(result->there.real(), std::exp(-2.0 * two_pi * std::sqrt(0.01 - 0.018 * result->part)), 1e-3);
  // Nor is one found from a state that is on none.
  EXPECT_FALSE(across(saddle_node(-0.01), saddle_node(0.01), {0.1}));
}

TEST(OrbitAcross, OrbitThatIsLostWithoutAMultiplierNearOneIsNoFold) {
  const auto result = across(saddle_node(0.01), saddle_node(-0.01), {0.1});
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->found);
  EXPECT_FALSE(result->fold);
  EXPECT_NEAR(result->there.real(), std::exp(-0.2 * two_pi), error);
}

TEST(OrbitAcross, ShorterStepsFollowAnOrbitThatMovesFar) {
  // y' = (part - y) / 10: the orbit y = part moves farther than one step may.
  const auto field = [](double part) {
    return integrate::make_field(1, two_pi,
                                 [part](std::size_t, double, const auto* y, auto* d) { d[0] = 0.1 * (part - y[0]); });
  };
  const auto result = follow(field, {0.0});
  ASSERT_TRUE(result && result->found);
  EXPECT_EQ(result->part, 1.0);
  EXPECT_EQ(result->unstable, 0);
  EXPECT_NEAR(result->there.real(), std::exp(-0.1 * two_pi), error);
}

}  // namespace
}  // namespace epicyclic::studies::orbit_across_test
