// Tangent vectors through every method, against what is known of them.

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/dense.hpp"
#include "core/errors.hpp"
#include "integrate/each_method.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/methods.hpp"
#include "problems/clearance_exact.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::integrate::tangents_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
using Matrix2 = Eigen::Matrix2d;

IntegratorOptions options(std::string_view method, double tolerance, bool control = false) {
  IntegratorOptions o;
  o.method = method;
  o.relative_tolerance = tolerance;
  o.absolute_tolerance = tolerance;
  o.max_steps_per_period = 10000000;
  o.tangent_error_control = control;
  return o;
}

/// Monodromy over `periods` from y, which is replaced.
Matrix2 monodromy(Flow& flow, std::array<double, 2>& y, int periods) {
  std::array<double, 4> v = {1.0, 0.0, 0.0, 1.0};
  for (int k = 0; k < periods; ++k)
    EXPECT_TRUE(flow.evolve_tangents(y, v, 0.0, flow.field().period, LastTangent::homogeneous).reached());
  return Eigen::Map<Matrix2>(v.data());
}

TEST(Tangents, InLanesGoOverKinksWithoutAnErrorOfFirstOrder) {
  // Kinks at the ends of steps or within long ones would leave vectors, whose error does not count, up to b_1 h (J+ -
  // J-) v each at any tolerance: 2 to 10 % of these monodromies.
  constexpr double largest = 0.005;  // measured: 0.0033 where the kinks fall worst
  for (const double w : {0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 1.0, 1.1}) {
    const VectorField field = problems::clearance_oscillator(w);
    std::array<double, 2> orbit = {1.1, 0.0};
    const auto exact = make_flow(field, options("arkode-dopri5", 1e-13, true));
    for (int k = 0; k < 100; ++k) ASSERT_TRUE(exact->evolve(orbit, 0.0, field.period).reached());
    std::array<double, 2> y = orbit;
    const Matrix2 expected = monodromy(*exact, y, 1);
    for (const std::string_view method : {"lanes-dopri5", "lanes-cash-karp"})
      for (const double tolerance : {1e-6, 1e-7, 1e-8}) {
        const auto flow = make_flow(field, options(method, tolerance));
        y = orbit;
        EXPECT_LT((monodromy(*flow, y, 1) - expected).norm(), largest * expected.norm())
            << method << " " << w << " " << tolerance;
      }
  }
}

TEST(Tangents, DuffingFlipsWithThePublishedMultipliers) {
  // docs/theory/published_results.md, section 4; its digits.
  const auto flow = make_flow(problems::duffing(0.3, -1.0, 0.2655817861, 1.2), options("arkode-dopri5", 1e-13));
  std::array<double, 2> y = {0.4075754662, 0.3226140050};
  const Matrix2 m = monodromy(*flow, y, 1);
  constexpr double digits = 2e-8;
  EXPECT_NEAR(y[0], 0.4075754662, digits);
  EXPECT_NEAR(y[1], 0.3226140050, digits);
  Eigen::Vector2cd multipliers = epicyclic::eigenvalues(m);
  std::sort(multipliers.begin(), multipliers.end(), [](auto a, auto b) { return a.real() < b.real(); });
  EXPECT_NEAR(multipliers[0].real(), -1.0, digits);
  EXPECT_NEAR(multipliers[1].real(), -0.20787958, digits);
}

class TangentsOfEachMethod : public ::testing::TestWithParam<Method> {};

TEST_P(TangentsOfEachMethod, TheDeterminantObeysLiouville) {
  // The divergence is -0.3 everywhere.
  const bool coarse = GetParam().order <= 3;
  const auto flow =
      make_flow(problems::duffing(0.3, -1.0, 0.28, 1.2), options(GetParam().name, coarse ? 1e-8 : 1e-10, true));
  std::array<double, 2> y = {0.4, 0.3};
  const double det = monodromy(*flow, y, 3).determinant();
  const double exact = std::exp(-0.3 * 3.0 * flow->field().period);
  // Tolerance times steps times the tangents' growth in between.
  const double accuracy = coarse ? 1e-4 : 1e-6;
  EXPECT_NEAR(det / exact, 1.0, accuracy);
}

TEST_P(TangentsOfEachMethod, TheMonodromyIsTheDerivativeOfTheExactSolutionAcrossKinks) {
  // Three forcing periods of the clearance oscillator, both flanks of the gap crossed; derivative of the closed form by
  // central differences, whose error is 1e-10 of a curvature of order 1 and rounding over the step.
  const double w = 0.6;
  const problems::ClearanceExact exact(w);
  const std::array<double, 2> start = {1.1, 0.3};
  constexpr double h = 1e-5;
  Matrix2 expected;
  for (int j = 0; j < 2; ++j) {
    std::array<double, 2> up = start;
    std::array<double, 2> down = start;
    up[static_cast<std::size_t>(j)] += h;
    down[static_cast<std::size_t>(j)] -= h;
    up = exact.periods(up, 3);
    down = exact.periods(down, 3);
    for (int i = 0; i < 2; ++i)
      expected(i, j) = (up[static_cast<std::size_t>(i)] - down[static_cast<std::size_t>(i)]) / (2.0 * h);
  }
  const bool coarse = GetParam().order <= 3;
  if (GetParam().misses_kinks) return;  // its error estimate is not for kinks
  const auto flow = make_flow(problems::clearance_oscillator(w), options(GetParam().name, coarse ? 1e-9 : 1e-10, true));
  std::array<double, 2> y = start;
  const Matrix2 m = monodromy(*flow, y, 3);
  // A tangent's slope jumps where the state's has a kink: pairs whose error estimate sees a jump late (ark437) leave
  // 1e-5, the others 1e-6 and less.
  constexpr double accuracy = 2e-5;
  EXPECT_LT((m - expected).norm() / expected.norm(), accuracy);
}

TEST_P(TangentsOfEachMethod, UncontrolledTangentsLeaveTheStateToTheLastBit) {
  // In lanes but for the steps over kinks, whatever the number of vectors.
  constexpr double tolerance = 1e-7;
  constexpr double rest = 100.0 * tolerance;  // errors of some hundred steps
  std::array<double, 2> by_one{};
  for (const std::size_t m : {1U, 3U, 9U, 16U}) {
    const auto plain = make_flow(problems::clearance_oscillator(0.85), options(GetParam().name, tolerance));
    const auto tangent = make_flow(problems::clearance_oscillator(0.85), options(GetParam().name, tolerance));
    std::array<double, 2> y = {1.1, 0.0};
    std::array<double, 2> z = y;
    std::vector<double> v(2 * m, 0.5);
    for (int k = 0; k < 2; ++k) {
      ASSERT_TRUE(plain->evolve(y, 0.0, two_pi).reached());
      ASSERT_TRUE(tangent->evolve_tangents(z, v, 0.0, two_pi).reached());
    }
    if (GetParam().family == Family::lanes) {
      if (m == 1) by_one = z;
      EXPECT_EQ(z, by_one) << m;
      EXPECT_LT(std::hypot(y[0] - z[0], y[1] - z[1]), rest) << m;
    } else {
      EXPECT_EQ(y, z) << m;
      EXPECT_EQ(plain->work().steps, tangent->work().steps);
    }
    for (std::size_t j = 1; j < m; ++j) {
      EXPECT_EQ(v[2 * j], v[0]);
      EXPECT_EQ(v[2 * j + 1], v[1]);
    }
  }
}

TEST_P(TangentsOfEachMethod, TheParameterDerivativeIsThatOfTheExactSolution) {
  if (GetParam().misses_kinks) return;  // its error estimate is not for kinks
  const double w = 0.85;
  const std::array<double, 2> start = {1.1, 0.0};
  constexpr double h = 1e-5;
  const auto up = problems::ClearanceExact(w + h).periods(start, 2);
  const auto down = problems::ClearanceExact(w - h).periods(start, 2);
  const bool coarse = GetParam().order <= 3;
  const auto flow = make_flow(problems::clearance_oscillator(w), options(GetParam().name, coarse ? 1e-9 : 1e-10, true));
  std::array<double, 2> y = start;
  // A homogeneous vector beside it stays what it is alone.
  std::array<double, 4> v = {1.0, 0.0, 0.0, 0.0};
  for (int k = 0; k < 2; ++k) ASSERT_TRUE(flow->evolve_tangents(y, v, 0.0, two_pi, LastTangent::parameter).reached());
  constexpr double accuracy = 2e-5;
  EXPECT_NEAR(v[2], (up[0] - down[0]) / (2.0 * h), accuracy);
  EXPECT_NEAR(v[3], (up[1] - down[1]) / (2.0 * h), accuracy);
}

INSTANTIATE_TEST_SUITE_P(Methods, TangentsOfEachMethod, ::testing::ValuesIn(methods()), name_of);

TEST(Tangents, AFamilyHasTheDerivativeByItsParameter) {
  // y' = p sin(y): tan(y / 2) = tan(y_0 / 2) exp(p s), of which the derivative by p is that by s times s / p.
  const FlowFamily flows =
      make_flow_family(make_field_family(1, 0.0,
                                         [](const auto& p, std::size_t, double, const auto* y, auto* d) {
                                           using std::sin;
                                           d[0] = p * sin(y[0]);
                                         }),
                       options("arkode-dopri5", 1e-12, true));
  constexpr double start = 0.4;
  constexpr double s = 1.5;
  constexpr double accuracy = 1e-10;  // of the tolerance, over some ten steps
  for (const double p : {-0.7, 0.3, 1.1}) {
    std::array<double, 1> y = {start};
    std::array<double, 1> dydp = {0.0};
    ASSERT_TRUE(flows(p)->evolve_tangents(y, dydp, 0.0, s, LastTangent::parameter).reached());
    const double exact = 2.0 * std::atan(std::tan(0.5 * start) * std::exp(p * s));
    EXPECT_NEAR(y[0], exact, accuracy) << p;
    EXPECT_NEAR(dydp[0], s * std::sin(exact), accuracy) << p;
  }
}

TEST(Tangents, ControlMakesThemAsAccurateAsTheState) {
  // The state rests at 0, where a step of any length is right; its neighbourhood turns fast.
  const auto turning = make_field(2, 0.0, [](std::size_t, double, const auto* y, auto* d) {
    d[0] = 40.0 * y[1] - 0.1 * y[0];
    d[1] = -40.0 * y[0] - 0.1 * y[1];
  });
  double errors[2];
  long steps[2];
  for (const bool control : {false, true}) {
    const auto flow = make_flow(turning, options("arkode-dopri5", 1e-8, control));
    std::array<double, 2> y = {0.0, 0.0};
    std::array<double, 2> v = {1.0, 0.0};
    flow->set_next_step(1e-3);
    EXPECT_TRUE(flow->evolve_tangents(y, v, 0.0, 3.0).reached());
    const double decay = std::exp(-0.3);
    errors[control ? 1 : 0] = std::hypot(v[0] - decay * std::cos(120.0), v[1] + decay * std::sin(120.0));
    steps[control ? 1 : 0] = flow->work().steps;
  }
  constexpr double controlled = 1e-5;
  EXPECT_LT(errors[1], controlled);
  EXPECT_GT(errors[0], 1e3 * errors[1]);
  EXPECT_GT(steps[1], steps[0]);
}

TEST(Tangents, WrongRequestsAreInputErrors) {
  VectorField bare;
  bare.dimension = 1;
  bare.right_hand_side = [](std::size_t, double, const double* y, double* d) { d[0] = -y[0]; };
  std::array<double, 1> y = {1.0};
  std::array<double, 1> v = {1.0};
  EXPECT_THROW(make_flow(bare, {})->evolve_tangents(y, v, 0.0, 1.0), InputError);
  std::array<double, 1> j = {};
  EXPECT_THROW(jacobian(bare, 0, 0.0, y.data(), j), InputError);

  const auto flow = make_flow(problems::smooth_bell(), {});
  EXPECT_THROW(flow->evolve_tangents(y, v, 0.0, 1.0, LastTangent::parameter), InputError);
  EXPECT_THROW(flow->evolve_tangents(y, {}, 0.0, 1.0), InputError);
  std::array<double, 2> two = {1.0, 1.0};
  EXPECT_THROW(flow->evolve_tangents(two, v, 0.0, 1.0), InputError);
}

}  // namespace
}  // namespace epicyclic::integrate::tangents_test
