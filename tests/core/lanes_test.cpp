#include "core/lanes.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <gtest/gtest.h>

namespace epicyclic::lanes_test {
namespace {

using L = Lanes<4>;

L of(const std::array<double, 4>& x) {
  L r;
  for (std::size_t k = 0; k < 4; ++k) r.set(k, x[k]);
  return r;
}

TEST(Lanes, ArithmeticIsThatOfEachLaneToTheBit) {
  const std::array<double, 4> a = {1.5, -2.25, 1e-7, 3e5};
  const std::array<double, 4> b = {0.1, 7.0, -3.3, 1e-3};
  const L x = of(a);
  const L y = of(b);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ((x + y)[k], a[k] + b[k]);
    EXPECT_EQ((x - y)[k], a[k] - b[k]);
    EXPECT_EQ((x * y)[k], a[k] * b[k]);
    EXPECT_EQ((x / y)[k], a[k] / b[k]);
    EXPECT_EQ((-x)[k], -a[k]);
    EXPECT_EQ(sqrt(x * x)[k], std::sqrt(a[k] * a[k]));
    EXPECT_EQ(power_3_2(x * x)[k], (a[k] * a[k]) * std::sqrt(a[k] * a[k]));
  }
}

TEST(Lanes, AreAlignedAsTheKernelsLoadThem) {
  EXPECT_EQ(alignof(Lanes<4>), 32U);
  EXPECT_EQ(alignof(Lanes<8>), 64U);
}

TEST(Lanes, SelectPicksPerLane) {
  const L x = of({-3.0, -0.5, 0.5, 3.0});
  const L y = limited(x, L(-1.0), L(1.0));
  EXPECT_EQ(y[0], -1.0);
  EXPECT_EQ(y[1], -0.5);
  EXPECT_EQ(y[2], 0.5);
  EXPECT_EQ(y[3], 1.0);
}

TEST(Lanes, SineAndCosineAreThoseOfTheLibrary) {
  // One rounding of the result; the pack's own sine may round otherwise than the scalar one.
  constexpr double rounding = 2 * std::numeric_limits<double>::epsilon();
  const std::array<double, 4> a = {0.0, 1.0, -2.5, 6.2};
  const SineCosine<L> both = sine_cosine(of(a));
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(both.sine[k], std::sin(a[k]), rounding);
    EXPECT_NEAR(both.cosine[k], std::cos(a[k]), rounding);
  }
}

TEST(Lanes, ANumberIsTheSameInEveryLane) {
  const L x = 2.5;
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(x[k], 2.5);
}

}  // namespace
}  // namespace epicyclic::lanes_test
