#include "core/fit.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace epicyclic::fit_test {
namespace {

TEST(FittedSlope, IsThatOfLeastSquares) {
  const std::vector<double> x = {0.0, 1.0, 2.0, 3.0};
  const std::vector<double> line = {1.0, 3.0, 5.0, 7.0};
  EXPECT_DOUBLE_EQ(fitted_slope(x, line), 2.0);
  // Normal equations by hand: sum (x - 1.5)(y - mean) / 5 for y = 0, 1, 0, 3.
  const std::vector<double> scattered = {0.0, 1.0, 0.0, 3.0};
  EXPECT_DOUBLE_EQ(fitted_slope(x, scattered), 0.8);
}

TEST(FittedSlope, NeedsThreePoints) {
  const std::vector<double> two = {0.0, 1.0};
  EXPECT_TRUE(std::isnan(fitted_slope(two, two)));
  EXPECT_THROW((void)fitted_slope(two, std::vector<double>{1.0}), std::invalid_argument);
}

TEST(PooledSlope, IsTheSameWhateverTheLevelsAre) {
  const std::vector<double> x = {0.0, 1.0, 2.0};
  PooledSlope pooled;
  for (const double level : {-3.0, 0.0, 100.0}) {
    std::vector<double> y;
    for (const double value : x) y.push_back(level - 2.0 * value + (value == 1.0 ? 0.3 : 0.0));
    pooled.add(x, y);
  }
  EXPECT_EQ(pooled.points(), 9U);
  constexpr double rounding = 1e-13;  // of levels of 100
  EXPECT_NEAR(pooled.slope(), -2.0, rounding);
  EXPECT_THROW(pooled.add(x, std::vector<double>(2)), std::invalid_argument);
}

}  // namespace
}  // namespace epicyclic::fit_test
