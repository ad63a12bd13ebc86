// The 0-1 test on maps and flows whose regimes are known.

#include "analysis/zero_one_test.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "integrate/make_flow.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::analysis::zero_one {
namespace {

std::vector<double> logistic(double r, int count) {
  std::vector<double> series;
  double x = 0.3;
  for (int k = 0; k < 1000; ++k) x = r * x * (1.0 - x);
  for (int k = 0; k < count; ++k) series.push_back(x = r * x * (1.0 - x));
  return series;
}

TEST(ZeroOneTest, TellsTheLogisticMapsRegimes) {
  // Gottwald and Melbourne's own example: K near 0 at 3.55 (period 8), near 1 at 3.97 (chaos).
  EXPECT_LT(std::abs(zero_one_test(logistic(3.55, 1000))), 0.1);
  EXPECT_GT(zero_one_test(logistic(3.97, 1000)), 0.95);
  EXPECT_LT(std::abs(zero_one_test(logistic(3.835, 1000))), 0.1);  // the window of period 3
}

TEST(ZeroOneTest, ATorusIsRegular) {
  std::vector<double> series;
  for (int k = 0; k < 1000; ++k)
    series.push_back(std::sin(std::numbers::sqrt2 * k) + 0.3 * std::cos(std::numbers::phi * 2.0 * k) + 7.0);
  EXPECT_LT(std::abs(zero_one_test(series)), 0.15);
}

TEST(ZeroOneTest, DoesNotDependOnUnitsOrOffset) {
  const std::vector<double> x = logistic(3.9, 500);
  std::vector<double> y = x;
  for (double& v : y) v = 1e6 + 1e-3 * v;
  constexpr double rounding = 1e-8;  // beside 1e6 values of 1e-3 keep seven digits; sums over 500 average that
  EXPECT_NEAR(zero_one_test(x), zero_one_test(y), rounding);
}

TEST(ZeroOneTest, TellsDuffingsRegimes) {
  for (const auto& [g, chaotic] : {std::pair{0.20, false}, {0.28, false}, {0.50, true}}) {
    const VectorField field = problems::duffing(0.3, -1.0, g, 1.2);
    const auto flow = integrate::make_flow(field, {});
    std::vector<double> y = {1.0, 0.0};
    std::vector<double> series;
    for (int k = 0; k < 1300; ++k) {
      ASSERT_TRUE(flow->evolve(y, 0.0, field.period).reached());
      if (k >= 300) series.push_back(y[0]);
    }
    const double k = zero_one_test(series, 1e-6);
    if (chaotic)
      EXPECT_GT(k, 0.9) << g;
    else
      EXPECT_LT(std::abs(k), 0.2) << g;
  }
}

TEST(ZeroOneTest, RefusesShortSeriesAndTakesAConstantOne) {
  EXPECT_THROW((void)zero_one_test(std::vector<double>(99, 1.0)), DomainError);
  EXPECT_THROW((void)zero_one_test(std::vector<double>(100, 1.0), 0.0, 0), DomainError);
  EXPECT_EQ(zero_one_test(std::vector<double>(100, 1.0)), 0.0);
}

}  // namespace
}  // namespace epicyclic::analysis::zero_one
