// What reports about other integrators found wrong, asked of all methods here; the reports are in
// validation/public_reports/README.md under their letters.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "integrate/each_method.hpp"
#include "integrate/make_field.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/methods.hpp"
#include "problems/clearance_exact.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::integrate::public_reports_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

IntegratorOptions options(std::string_view method, double tolerance) {
  IntegratorOptions o;
  o.method = method;
  o.relative_tolerance = tolerance;
  o.absolute_tolerance = tolerance;
  o.max_steps_per_period = 10000000;
  return o;
}

class ReportedIntegration : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Methods, ReportedIntegration, ::testing::ValuesIn(methods()), name_of);

/// [M] A start that is no number made a solver search for its first step for ever.
TEST_P(ReportedIntegration, AStartThatIsNoNumberEndsAtOnce) {
  long calls = 0;
  VectorField field = problems::smooth_follower();
  const auto inner = field.right_hand_side;
  field.right_hand_side = [&](std::size_t k, double s, const double* y, double* d) {
    if (++calls > 1000) throw std::runtime_error("it does not end");
    inner(k, s, y, d);
  };
  const auto flow = make_flow(field, options(GetParam().name, 1e-8));
  std::array<double, 1> y = {std::numeric_limits<double>::quiet_NaN()};
  const Evolution e = flow->evolve(y, 0.0, 1.0);
  EXPECT_NE(e.outcome, Outcome::reached);
  EXPECT_FALSE(e.message.empty());
}

/// [N] A trial step outside the domain of the right-hand side ended the integration early, as a success.
TEST_P(ReportedIntegration, ATrialStepOutsideTheDomainIsTakenAgain) {
  // y' = y while y < 20, not a number beyond; to 19.9.
  const VectorField field = make_field(1, 0.0, [](std::size_t, double, const auto* y, auto* d) {
    using std::sqrt;
    d[0] = y[0] + 0.0 * sqrt(20.0 - y[0]);
  });
  const double end = std::log(19.9);
  for (const double tolerance : {1e-4, 1e-7}) {
    const auto flow = make_flow(field, options(GetParam().name, tolerance));
    std::array<double, 1> y = {1.0};
    const Evolution e = flow->evolve(y, 0.0, end);
    if (!e.reached()) continue;  // it may say that it cannot go on
    EXPECT_NEAR(y[0] / 19.9, 1.0, 2000.0 * tolerance) << tolerance;
  }
}

/// [O] The right-hand side was asked beyond the interval, where it may not be defined.
TEST_P(ReportedIntegration, NoSlopeIsAskedBeyondThePieceOfABreakpoint) {
  double beyond = 0.0;
  VectorField field = make_field(1, two_pi, [&beyond](std::size_t k, double s, const auto* y, auto* d) {
    const double low = k == 0 ? 0.0 : 1.0;
    const double high = k == 0 ? 1.0 : two_pi;
    beyond = std::max({beyond, low - s, s - high});
    d[0] = (k == 0 ? 1.0 : -0.5) - 0.1 * y[0];
  });
  field.breakpoints = {0.0, 1.0};
  // Stages of some published implicit tables lie beyond the end of their step. The piece's own formula is asked there,
  // which the segment names.
  const double allowed = GetParam().family == Family::dirk ? 0.25 : 1e-14;
  const auto flow = make_flow(field, options(GetParam().name, 1e-8));
  std::array<double, 1> y = {0.3};
  for (int period = 0; period < 3; ++period) ASSERT_TRUE(flow->evolve(y, 0.0, two_pi).reached());
  EXPECT_LE(beyond, allowed);
  // Very short intervals too, where a first guess of the step may be longer.
  beyond = 0.0;
  flow->forget();
  ASSERT_TRUE(flow->evolve(y, 1.0 - 1e-6, 1.0).reached());
  EXPECT_LE(beyond, allowed);
}

/// [P] Piecewise smooth systems were off by far more than the tolerance.
TEST_P(ReportedIntegration, ErrorsOfAPiecewiseSmoothSystemFallWithTheTolerance) {
  if (GetParam().misses_kinks || GetParam().order <= 3) GTEST_SKIP() << "pairs that are told to miss kinks";
  const double w = 0.85;
  const problems::ClearanceExact exact(w);
  constexpr int periods = 5;
  const auto right = exact.periods({0.3, 0.8}, periods);
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    const auto flow = make_flow(problems::clearance_oscillator(w), options(GetParam().name, tolerance));
    std::array<double, 2> y = {0.3, 0.8};
    for (int k = 0; k < periods; ++k) ASSERT_TRUE(flow->evolve(y, 0.0, two_pi).reached());
    EXPECT_LT(std::hypot(y[0] - right[0], y[1] - right[1]), 5000.0 * tolerance) << tolerance;
  }
}

/// [Q] A ball fell through the floor after some bounces.
TEST_P(ReportedIntegration, NoBounceIsMissedOnAStiffFloor) {
  if (GetParam().misses_kinks || GetParam().order <= 3) GTEST_SKIP() << "pairs that are told to miss kinks";
  // x'' = -1 + k max(-x, 0) from x = 1: the energy stays, and the ball goes no deeper than (1 + sqrt(1 + 2 k)) / k.
  constexpr double k = 1e4;
  VectorField field = make_field(2, 0.0, [](std::size_t, double, const auto* y, auto* d) {
    d[0] = y[1];
    d[1] = -1.0 - k * select(y[0] < 0.0, y[0], 0.0 * y[0]);
  });
  field.surfaces = {1, [](double, const double* y, double* value, double* rate) {
                      *value = y[0];
                      *rate = y[1];
                    }};
  IntegratorOptions o = options(GetParam().name, 1e-10);
  o.escape_bound = 100.0;
  const auto flow = make_flow(field, o);
  std::vector<double> y = {1.0, 0.0};
  std::vector<double> samples;
  for (int j = 1; j <= 20; ++j) samples.push_back(0.05 * j);
  double deepest = 0.0;
  constexpr double integrated = 1e-4;  // some thousand tolerances times sqrt(k) at each of 14 contacts
  for (int second = 0; second < 40; ++second) {
    ASSERT_TRUE(
        flow->evolve(y, 0.0, 1.0, samples,
                     [&](std::size_t, double, std::span<const double> at) { deepest = std::min(deepest, at[0]); })
            .reached());
    const double below = std::min(y[0], 0.0);
    EXPECT_NEAR(0.5 * y[1] * y[1] + y[0] + 0.5 * k * below * below, 1.0, integrated) << second;
  }
  EXPECT_GT(deepest, -(1.0 + std::sqrt(1.0 + 2.0 * k)) / k);
}

}  // namespace
}  // namespace epicyclic::integrate::public_reports_test
