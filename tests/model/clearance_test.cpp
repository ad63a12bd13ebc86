#include "model/clearance.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/dual.hpp"

namespace epicyclic::model::clearance_test {
namespace {

// Roundings of numbers of order 10.
constexpr double rounding = 1e-14;

TEST(Clearance, ExactFormIsThatOfItsThreePieces) {
  constexpr double b = 4.0;
  struct Row {
    double d, value, slope;
  };
  for (const Row r : {Row{7.5, 3.5, 1.0}, Row{4.0, 0.0, 1.0}, Row{1.0, 0.0, 0.0}, Row{0.0, 0.0, 0.0},
                      Row{-4.0, 0.0, 1.0}, Row{-6.0, -2.0, 1.0}}) {
    const Closure<double> c = closure_exact(r.d, b);
    EXPECT_EQ(c.value, r.value) << r.d;
    EXPECT_EQ(c.slope, r.slope) << r.d;
  }
}

TEST(Clearance, WithoutGapItIsTheDisplacementItself) {
  for (const double d : {-3.3, -1e-9, 0.0, 1e-9, 3.3}) EXPECT_EQ(closure_exact(d, 0.0).value, d);
  for (const double d : {-3.3, -1e-9, 0.0, 1e-9, 3.3}) {
    EXPECT_EQ(closure_smooth(d, 0.0, 0.1).value, d);
    EXPECT_EQ(closure_smooth(d, 0.0, 0.1).slope, 1.0);
  }
}

TEST(Clearance, WithoutGapTheTangentIsOneEvenAtZero) {
  // Symmetric motions sit at exactly 0: a dead zone of no width must not cut their tangents.
  for (const double d : {-3.3, 0.0, 3.3}) {
    const Closure<Dual<1>> c = closure_exact(Dual<1>::variable(d, 0), Dual<1>(0.0));
    EXPECT_EQ(c.value.derivative[0], 1.0) << d;
    EXPECT_EQ(c.slope.value, 1.0) << d;
  }
}

TEST(Clearance, BothFormsAreOddWithEvenSlope) {
  for (const double d : {0.3, 1.9, 2.0, 2.1, 17.0}) {
    EXPECT_EQ(closure_exact(-d, 2.0).value, -closure_exact(d, 2.0).value);
    EXPECT_EQ(closure_exact(-d, 2.0).slope, closure_exact(d, 2.0).slope);
    EXPECT_NEAR(closure_smooth(-d, 2.0, 0.05).value, -closure_smooth(d, 2.0, 0.05).value, rounding);
    EXPECT_NEAR(closure_smooth(-d, 2.0, 0.05).slope, closure_smooth(d, 2.0, 0.05).slope, rounding);
  }
}

TEST(Clearance, SmoothFormTendsToTheExactOne) {
  // |f_w - f| <= w / 2, reached at d = b; away from the kinks the difference falls as w^2.
  constexpr double b = 2.0;
  for (const double w : {1e-1, 1e-3, 1e-5}) {
    for (double d = -5.0; d <= 5.0; d += 0.25)
      EXPECT_LE(std::abs(closure_smooth(d, b, w).value - closure_exact(d, b).value), 0.5 * w + rounding) << d;
    EXPECT_NEAR(closure_smooth(b, b, w).value, 0.5 * w, w * w);
    EXPECT_NEAR(closure_smooth(3.0, b, w).value, 1.0, w * w);
    EXPECT_NEAR(closure_smooth(1.0, b, w).value, 0.0, w * w);
    EXPECT_NEAR(closure_smooth(3.0, b, w).slope, 1.0, w * w);
    EXPECT_NEAR(closure_smooth(1.0, b, w).slope, 0.0, w * w);
  }
}

TEST(Clearance, FarAwayTheSmoothFormIsDMinusB) {
  constexpr double far = 1e6;
  // Rounding of far itself.
  constexpr double rounding_far = 1e-9;
  EXPECT_NEAR(closure_smooth(far, 2.0, 0.5).value, far - 2.0, rounding_far);
  EXPECT_NEAR(closure_smooth(-far, 2.0, 0.5).value, -far + 2.0, rounding_far);
}

TEST(Clearance, SlopeIsTheDerivative) {
  constexpr double b = 1.5;
  constexpr double w = 0.2;
  constexpr double h = 1e-4;
  // Fourth-order differences: h^4 / w^4 of truncation and rounding / h.
  constexpr double differences = 1e-10;
  for (double d = -4.0; d <= 4.0; d += 0.3) {
    const auto f = [&](double x) { return closure_smooth(x, b, w).value; };
    const double slope = (8.0 * (f(d + h) - f(d - h)) - (f(d + 2 * h) - f(d - 2 * h))) / (12.0 * h);
    EXPECT_NEAR(closure_smooth(d, b, w).slope, slope, differences) << d;
    EXPECT_NEAR(closure_smooth(Dual<1>::variable(d, 0), Dual<1>(b), Dual<1>(w)).value.derivative[0],
                closure_smooth(d, b, w).slope, rounding);
  }
}

TEST(Clearance, TheStudyPicksTheForm) {
  EXPECT_EQ(closure(2.5, 2.0, 0.3, true).value, closure_smooth(2.5, 2.0, 0.3).value);
  EXPECT_EQ(closure(2.5, 2.0, 0.3, false).value, 0.5);
}

TEST(Clearance, RadialFactorIsTheClosureOverTheRadius) {
  for (const double r : {0.5, 1.0, 2.0, 5.0})
    for (const double b : {0.0, 1.0, 3.0}) {
      EXPECT_NEAR(radial_closure_factor(r, b, 0.0, false) * r, closure_exact(r, b).value, rounding);
      EXPECT_NEAR(radial_closure_factor(r, b, 0.1, true) * r, closure_smooth(r, b, 0.1).value, rounding);
    }
}

TEST(Clearance, RadialFactorIsSafeAtTheCentre) {
  using D = Dual<2>;
  const D x = D::variable(0.0, 0);
  const D y = D::variable(0.0, 1);
  for (const bool smooth : {false, true})
    for (const double b : {0.0, 1.0}) {
      const D g = radial_closure_factor(safe_radius(x, y), D(b), D(0.2), smooth);
      // The smooth factor at 0 is 1 - b / sqrt(b^2 + w^2), the slope of f_w there.
      const double expected = smooth ? 1.0 - b / std::hypot(b, 0.2) : (b > 0.0 ? 0.0 : 1.0);
      EXPECT_NEAR(g.value, expected, rounding);
      EXPECT_EQ(g.derivative[0], 0.0);
      EXPECT_EQ(g.derivative[1], 0.0);
    }
}

TEST(Clearance, SafeRadiusIsTheRadius) {
  EXPECT_EQ(safe_radius(3.0, -4.0), 5.0);
  EXPECT_NEAR(safe_radius(3e-9, 4e-9) / 5e-9, 1.0, rounding);
  const auto r = safe_radius(Dual<2>::variable(3.0, 0), Dual<2>::variable(-4.0, 1));
  EXPECT_NEAR(r.derivative[0], 0.6, rounding);
  EXPECT_NEAR(r.derivative[1], -0.8, rounding);
}

}  // namespace
}  // namespace epicyclic::model::clearance_test
