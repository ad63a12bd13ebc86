#include "core/dual.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace epicyclic::dual_test {
namespace {

// One rounding of a value of order 1, with room for a handful of operations.
constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();

using D = Dual<2>;

TEST(Dual, ArithmeticFollowsTheRulesOfDifferentiation) {
  const double a = 1.7;
  const double b = -0.6;
  const D x = D::variable(a, 0);
  const D y = D::variable(b, 1);
  struct Case {
    D result;
    double value, dx, dy;
  };
  const Case cases[] = {
      {x + y, a + b, 1.0, 1.0},
      {x - y, a - b, 1.0, -1.0},
      {x * y, a * b, b, a},
      {x / y, a / b, 1.0 / b, -a / (b * b)},
      {-x, -a, -1.0, 0.0},
      {2.0 / x + 3.0 * y - 1.0, 2.0 / a + 3.0 * b - 1.0, -2.0 / (a * a), 3.0},
      {sqrt(x * y * y), std::sqrt(a * b * b), 0.5 * std::abs(b) / std::sqrt(a), -std::sqrt(a)},
      {power_3_2(x), std::pow(a, 1.5), 1.5 * std::sqrt(a), 0.0},
      {sine_cosine(x * y).sine, std::sin(a * b), b * std::cos(a * b), a * std::cos(a * b)},
      {sine_cosine(x * y).cosine, std::cos(a * b), -b * std::sin(a * b), -a * std::sin(a * b)},
  };
  for (const Case& c : cases) {
    EXPECT_NEAR(c.result.value, c.value, rounding);
    EXPECT_NEAR(c.result.derivative[0], c.dx, rounding);
    EXPECT_NEAR(c.result.derivative[1], c.dy, rounding);
  }
}

TEST(Dual, CompoundAssignmentToItselfIsRight) {
  D x = D::variable(3.0, 0);
  D& same_x = x;  // by another name, or clang takes it for a slip
  x *= same_x;
  EXPECT_EQ(x.value, 9.0);
  EXPECT_EQ(x.derivative[0], 6.0);
  D y = D::variable(3.0, 0);
  D& same_y = y;
  y /= same_y;
  EXPECT_NEAR(y.value, 1.0, rounding);
  EXPECT_NEAR(y.derivative[0], 0.0, rounding);
}

TEST(Dual, SelectFollowsTheBranchOfTheValue) {
  const D x = D::variable(0.3, 0);
  EXPECT_EQ(limited(x, D(-1.0), D(1.0)).derivative[0], 1.0);
  EXPECT_EQ(limited(x, D(-0.1), D(0.1)).derivative[0], 0.0);
  EXPECT_EQ(limited(-x, D(-0.1), D(0.1)).value, -0.1);
}

TEST(Dual, ThreeHalvesPowerHasAFiniteSlopeAtZero) {
  const D zero = power_3_2(D::variable(0.0, 0));
  EXPECT_EQ(zero.value, 0.0);
  EXPECT_EQ(zero.derivative[0], 0.0);
}

}  // namespace
}  // namespace epicyclic::dual_test
