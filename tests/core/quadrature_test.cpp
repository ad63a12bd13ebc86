#include "core/quadrature.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace epicyclic::quadrature_test {
namespace {

// A few roundings of sums of order 1.
constexpr double rounding = 1e-14;

TEST(GaussLegendre, IsExactForPolynomialsUpToTwiceItsPointsLessOne) {
  for (int points = 1; points <= 16; ++points) {
    const GaussLegendre rule(points);
    for (int power = 0; power <= 2 * points - 1; ++power) {
      const double exact = (1.0 - std::pow(-0.5, power + 1)) / (power + 1);
      EXPECT_NEAR(rule.integrate([&](double x) { return std::pow(x, power); }, -0.5, 1.0), exact, rounding)
          << points << " points, power " << power;
    }
  }
}

TEST(GaussLegendre, IsNotExactOnePowerFurther) {
  // Error of n points for x^2n on [-1, 1]: 2^(2n+1) (n!)^4 / ((2n+1) ((2n)!)^2).
  for (int points = 1; points <= 6; ++points) {
    const double n = points;
    const double ratio = std::tgamma(n + 1.0) * std::tgamma(n + 1.0) / std::tgamma(2.0 * n + 1.0);
    const double error = std::pow(2.0, 2.0 * n + 1.0) * ratio * ratio / (2.0 * n + 1.0);
    const GaussLegendre rule(points);
    const double value = rule.integrate([&](double x) { return std::pow(x, 2 * points); }, -1.0, 1.0);
    EXPECT_NEAR(2.0 / (2.0 * n + 1.0) - value, error, rounding) << points << " points";
  }
}

TEST(GaussLegendre, ErrorOfPanelsFallsWithTwiceThePoints) {
  // exp(x) on [0, 2]: the asymptotic error has no sign change and a known order.
  const double exact = std::exp(2.0) - 1.0;
  for (int points = 1; points <= 4; ++points) {
    const GaussLegendre rule(points);
    const auto error = [&](int panels) {
      return std::abs(rule.integrate([](double x) { return std::exp(x); }, 0.0, 2.0, panels) - exact);
    };
    // Fewer panels for more points: errors stay far above rounding.
    const int panels = points < 3 ? 16 : 2;
    const double order = std::log2(error(panels) / error(2 * panels));
    // Measured order: the next term of the error expansion bends it by O(h^2).
    constexpr double measured = 0.05;
    EXPECT_NEAR(order, 2.0 * points, measured) << points << " points";
  }
}

TEST(GaussLegendre, ConstantsMeanTheLengthWithItsSign) {
  for (const int panels : {1, 3, 7}) {
    const auto one = [](double) { return 1.0; };
    EXPECT_NEAR(gauss_legendre_16().integrate(one, 2.0, 5.0, panels), 3.0, 3.0 * rounding);
    EXPECT_NEAR(gauss_legendre_16().integrate(one, 5.0, 2.0, panels), -3.0, 3.0 * rounding);
    EXPECT_EQ(gauss_legendre_16().integrate(one, 5.0, 5.0, panels), 0.0);
  }
}

TEST(GaussLegendre, SixteenPointsGiveSmoothFunctionsToRounding) {
  const auto& rule = gauss_legendre_16();
  EXPECT_NEAR(rule.integrate([](double x) { return std::cos(x); }, 0.0, 0.5 * std::numbers::pi), 1.0, rounding);
  EXPECT_NEAR(rule.integrate([](double x) { return 4.0 / (1.0 + x * x); }, 0.0, 1.0), std::numbers::pi, 4.0 * rounding);
}

TEST(GaussLegendre, IntegratesArraysByTheirComponents) {
  const GaussLegendre rule(5);
  const auto f = [](double x) -> Eigen::Array2d { return {x, x * x}; };
  const Eigen::Array2d sum = rule.integrate(f, 0.0, 3.0, 2);
  EXPECT_NEAR(sum[0], 4.5, 10.0 * rounding);
  EXPECT_NEAR(sum[1], 9.0, 10.0 * rounding);
}

TEST(GaussLegendre, NeedsAPoint) {
  EXPECT_THROW(GaussLegendre(0), std::invalid_argument);
  EXPECT_THROW(GaussLegendre(-3), std::invalid_argument);
}

}  // namespace
}  // namespace epicyclic::quadrature_test
