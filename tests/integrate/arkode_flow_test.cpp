#include "integrate/sundials/arkode_flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "integrate/methods.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::integrate::arkode_flow_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

IntegratorOptions tolerance(double t) {
  IntegratorOptions o;
  o.relative_tolerance = t;
  o.absolute_tolerance = t;
  return o;
}

VectorField field_of(std::size_t dimension, std::function<void(double, const double*, double*)> f, double period = 0) {
  VectorField v;
  v.dimension = dimension;
  v.period = period;
  v.right_hand_side = [f = std::move(f)](std::size_t, double s, const double* y, double* d) { f(s, y, d); };
  return v;
}

/// What must hold of every test here: nothing is printed.
class Silent : public ::testing::Test {
 protected:
  void SetUp() override {
    ::testing::internal::CaptureStderr();
    ::testing::internal::CaptureStdout();
  }
  void TearDown() override {
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  }
};

// ---- breakpoints ------------------------------------------------------------------------------------------------

double end_of_jumping(const std::string& method, int steps_per_segment_length, bool declared) {
  IntegratorOptions o;
  o.method = method;
  const auto flow = make_arkode_fixed_step_flow(problems::jumping(declared), o, 1.0 / steps_per_segment_length);
  std::array<double, 1> y = {0.4};
  EXPECT_TRUE(flow->evolve(y, 0.0, 2.0).reached());
  return y[0];
}

TEST(ArkodeFlow, DeclaredJumpsKeepTheOrder) {
  const std::string method = "arkode-dopri5";
  const double exact = end_of_jumping("arkode-fehlberg78", 400, true);
  // Three refinements by 2; the steps at the segments' ends are shorter, which scatters the measured order.
  constexpr double order_tolerance = 0.3;
  const double coarse = std::abs(end_of_jumping(method, 12, true) - exact);
  const double fine = std::abs(end_of_jumping(method, 96, true) - exact);
  EXPECT_NEAR(std::log2(coarse / fine) / 3.0, 5.0, order_tolerance);
  // Undeclared they cost it: the error of the same steps is that of a first-order method.
  const double undeclared = std::abs(end_of_jumping(method, 96, false) - exact);
  EXPECT_GT(undeclared, 1e4 * fine);
}

TEST(ArkodeFlow, DeclaredJumpsAreSteppedOntoAndSeenFromTheirOwnSide) {
  VectorField f;
  f.dimension = 1;
  f.period = 1.0;
  f.breakpoints = {0.25, 0.5};
  std::vector<std::pair<std::size_t, double>> calls;
  f.right_hand_side = [&](std::size_t segment, double s, const double*, double* d) {
    calls.emplace_back(segment, s);
    d[0] = segment == 0 ? 1.0 : 10.0;
  };
  const auto flow = make_arkode_flow(f, tolerance(1e-8));
  std::array<double, 1> y = {0.0};
  ASSERT_TRUE(flow->evolve(y, 0.0, 3.0).reached());
  // 0.25 of each period at 1, the rest at 10: no error but rounding.
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(y[0], 3.0 * (0.25 + 7.5), rounding);
  for (const auto& [segment, s] : calls) {
    const double phase = s - std::floor(s + rounding);
    if (segment == 0) {
      EXPECT_TRUE(phase > 0.25 - rounding && phase < 0.5 + rounding) << s;
    } else {
      EXPECT_TRUE(phase < 0.25 + rounding || phase > 0.5 - rounding) << s;
    }
  }
}

TEST(Flow, BreakpointsBetweenAreThoseStrictlyInside) {
  VectorField f;
  f.period = two_pi;
  f.breakpoints = {0.0, 1.0, 5.0};
  EXPECT_EQ(breakpoints_between(f, 0.0, two_pi), (std::vector<double>{1.0, 5.0}));
  EXPECT_EQ(breakpoints_between(f, 0.0, two_pi + 1.5), (std::vector<double>{1.0, 5.0, two_pi, two_pi + 1.0}));
  EXPECT_EQ(breakpoints_between(f, 1.0, 5.0), std::vector<double>{});
  EXPECT_EQ(breakpoints_between(f, 1.0 - 1e-13, 5.0 + 1e-13), std::vector<double>{});
  EXPECT_EQ(breakpoints_between(f, -two_pi + 2.0, 0.5), (std::vector<double>{5.0 - two_pi, 0.0}));
  f.breakpoints.clear();
  EXPECT_TRUE(breakpoints_between(f, 0.0, 100.0).empty());
}

TEST(Flow, SegmentAfterIsThatOfTheRightSide) {
  VectorField f;
  f.period = two_pi;
  f.breakpoints = {0.5, 1.0, 5.0};
  EXPECT_EQ(segment_after(f, 0.0), 2U);
  EXPECT_EQ(segment_after(f, 0.5), 0U);
  EXPECT_EQ(segment_after(f, 0.7), 0U);
  EXPECT_EQ(segment_after(f, 1.0), 1U);
  EXPECT_EQ(segment_after(f, 1.0 - 1e-13), 1U);  // rounding of a breakpoint is the breakpoint
  EXPECT_EQ(segment_after(f, 6.0), 2U);
  for (const double turns : {-1.0, 1.0, 100.0}) {
    EXPECT_EQ(segment_after(f, two_pi * turns + 0.5), 0U) << turns;
    EXPECT_EQ(segment_after(f, two_pi * turns + 0.4), 2U) << turns;
    EXPECT_EQ(segment_after(f, two_pi * turns + 5.0), 2U) << turns;
  }
  f.breakpoints.clear();
  EXPECT_EQ(segment_after(f, 3.0), 0U);
}

// ---- samples ----------------------------------------------------------------------------------------------------

TEST(ArkodeFlow, NumberOfSamplesDoesNotChangeTheEnd) {
  for (const Method& method : methods()) {
    if (method.family != Family::erk) continue;
    IntegratorOptions o = tolerance(1e-7);
    o.method = method.name;
    o.max_steps_per_period = 1000000;
    std::vector<std::array<double, 2>> ends;
    for (const int count : {0, 1, 7, 64, 1000}) {
      std::vector<double> samples;
      for (int k = 1; k <= count; ++k) samples.push_back(3.0 * two_pi * k / count);
      const auto flow = make_arkode_flow(problems::clearance_oscillator(0.85), o);
      std::array<double, 2> y = {1.1, 0.0};
      int seen = 0;
      ASSERT_TRUE(flow->evolve(y, 0.0, 3.0 * two_pi, samples,
                               [&](std::size_t index, double, std::span<const double>) {
                                 EXPECT_EQ(index, static_cast<std::size_t>(seen));
                                 ++seen;
                               })
                      .reached());
      EXPECT_EQ(seen, count);
      ends.push_back(y);
    }
    for (const auto& end : ends) EXPECT_EQ(end, ends.front()) << method.name;
  }
}

TEST(ArkodeFlow, SamplesAreTheSolutionAndTheLastIsTheEnd) {
  const auto flow = make_arkode_flow(problems::smooth_nonlinear(), tolerance(1e-10));
  std::array<double, 4> y = problems::smooth_nonlinear_solution(0.0);
  std::vector<double> samples;
  for (int k = 1; k <= 50; ++k) samples.push_back(k / 50.0);
  std::array<double, 4> last{};
  // Cubic Hermite between steps: fourth order in steps of some 0.02.
  constexpr double dense_output = 1e-5;
  const auto observer = [&](std::size_t k, double s, std::span<const double> at) {
    EXPECT_EQ(s, samples[k]);
    const auto exact = problems::smooth_nonlinear_solution(s);
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(at[j], exact[j], dense_output * std::abs(exact[j]) + dense_output);
    std::copy(at.begin(), at.end(), last.begin());
  };
  ASSERT_TRUE(flow->evolve(y, 0.0, 1.0, samples, observer).reached());
  EXPECT_EQ(last, y);
}

TEST(ArkodeFlow, AForgetfulFlowDependsOnItsArgumentsAlone) {
  const auto flow = make_arkode_flow(problems::clearance_oscillator(1.0), tolerance(1e-8));
  const auto run = [&] {
    std::array<double, 2> y = {1.1, 0.0};
    EXPECT_TRUE(flow->evolve(y, 0.0, two_pi).reached());
    return y;
  };
  const auto first = run();
  std::array<double, 2> other = {3.0, 7.0};
  ASSERT_TRUE(flow->evolve(other, 0.0, 10.0 * two_pi).reached());
  flow->forget();
  EXPECT_EQ(run(), first);
}

TEST(ArkodeFlow, CountsItsRightHandSides) {
  long calls = 0;
  const auto flow = make_arkode_flow(field_of(1,
                                              [&](double, const double* y, double* d) {
                                                ++calls;
                                                d[0] = -y[0];
                                              }),
                                     tolerance(1e-8));
  std::array<double, 1> y = {1.0};
  ASSERT_TRUE(flow->evolve(y, 0.0, 5.0).reached());
  EXPECT_GT(calls, 0);
  EXPECT_EQ(flow->right_hand_side_calls(), calls);
}

// ---- outcomes ---------------------------------------------------------------------------------------------------

using ArkodeOutcome = Silent;

TEST_F(ArkodeOutcome, GrowthBeyondTheBoundIsDiverged) {
  IntegratorOptions o = tolerance(1e-8);
  o.escape_bound = 1e3;
  const auto flow = make_arkode_flow(field_of(2,
                                              [](double, const double* y, double* d) {
                                                d[0] = -y[0];
                                                d[1] = y[1];
                                              }),
                                     o);
  std::array<double, 2> y = {1.0, -1.0};
  const Evolution e = flow->evolve(y, 0.0, 100.0);
  EXPECT_EQ(e.outcome, Outcome::diverged);
  EXPECT_FALSE(e.message.empty());
  // The state is the last accepted one, at e.s, just beyond the bound: integrator tolerance times growth.
  constexpr double accuracy = 1e-5;
  EXPECT_GT(-y[1], 1e3);
  EXPECT_NEAR(-y[1] / std::exp(e.s), 1.0, accuracy);
  EXPECT_LT(e.s, 10.0);
}

TEST_F(ArkodeOutcome, BlowUpInFiniteTimeIsNeverReached) {
  // y' = y^2 blows up at s = 1.
  const auto flow =
      make_arkode_flow(field_of(1, [](double, const double* y, double* d) { d[0] = y[0] * y[0]; }), tolerance(1e-8));
  std::array<double, 1> y = {1.0};
  const Evolution e = flow->evolve(y, 0.0, 2.0);
  EXPECT_EQ(e.outcome, Outcome::diverged);
  EXPECT_LT(e.s, 1.0);
  EXPECT_GT(y[0], 1e6);
}

TEST_F(ArkodeOutcome, TooManyStepsAreAStepLimit) {
  IntegratorOptions o = tolerance(1e-10);
  o.max_steps_per_period = 50;
  const auto flow = make_arkode_flow(field_of(
                                         2,
                                         [](double, const double* y, double* d) {
                                           d[0] = 100.0 * y[1];
                                           d[1] = -100.0 * y[0];
                                         },
                                         two_pi),
                                     o);
  std::array<double, 2> y = {1.0, 0.0};
  const Evolution e = flow->evolve(y, 0.0, two_pi);
  EXPECT_EQ(e.outcome, Outcome::step_limit);
  EXPECT_GT(e.s, 0.0);
  EXPECT_LT(e.s, two_pi);
  // The state is that at e.s: tolerance times steps.
  constexpr double accuracy = 1e-7;
  EXPECT_NEAR(y[0], std::cos(100.0 * e.s), accuracy);
}

TEST_F(ArkodeOutcome, StepsAreCountedPerPeriodAndNotPerSegment) {
  // Ten segments of few steps each are more steps than allowed in one period.
  VectorField f = field_of(
      1, [](double s, const double*, double* d) { d[0] = std::cos(50.0 * s); }, 1.0);
  for (int k = 0; k < 10; ++k) f.breakpoints.push_back(0.1 * k);
  IntegratorOptions o = tolerance(1e-12);
  std::array<double, 1> y = {0.0};
  o.max_steps_per_period = 1000000;
  ASSERT_TRUE(make_arkode_flow(f, o)->evolve(y, 0.0, 1.0).reached());
  o.max_steps_per_period = 40;
  y = {0.0};
  EXPECT_EQ(make_arkode_flow(f, o)->evolve(y, 0.0, 1.0).outcome, Outcome::step_limit);
}

TEST_F(ArkodeOutcome, ARightHandSideThatIsNotFiniteIsFailed) {
  for (const bool at_once : {true, false}) {
    const auto flow =
        make_arkode_flow(field_of(1,
                                  [at_once](double s, const double* y, double* d) {
                                    d[0] = at_once || s > 0.5 ? std::numeric_limits<double>::quiet_NaN() : -y[0];
                                  }),
                         tolerance(1e-8));
    std::array<double, 1> y = {1.0};
    const Evolution e = flow->evolve(y, 0.0, 1.0);
    EXPECT_EQ(e.outcome, Outcome::failed) << at_once;
    EXPECT_FALSE(e.message.empty());
    EXPECT_LE(e.s, 0.5);
    EXPECT_TRUE(std::isfinite(y[0]));
    constexpr double accuracy = 1e-6;
    EXPECT_NEAR(y[0], std::exp(-e.s), accuracy);
  }
}

TEST_F(ArkodeOutcome, FixedStepsFailTooOnARightHandSideThatIsNotFinite) {
  const auto flow = make_arkode_fixed_step_flow(
      field_of(1, [](double s, const double*,
                     double* d) { d[0] = s > 0.5 ? std::numeric_limits<double>::infinity() : 1.0; }),
      tolerance(1e-8), 0.1);
  std::array<double, 1> y = {0.0};
  EXPECT_EQ(flow->evolve(y, 0.0, 1.0).outcome, Outcome::failed);
  EXPECT_TRUE(std::isfinite(y[0]));
}

struct Special : std::runtime_error {
  int number;
  explicit Special(int n) : std::runtime_error("special"), number(n) {}
};

TEST_F(ArkodeOutcome, AnExceptionOfTheRightHandSideArrivesUnchangedAndTheFlowLivesOn) {
  bool throwing = true;
  const auto flow = make_arkode_flow(field_of(1,
                                              [&](double s, const double* y, double* d) {
                                                if (throwing && s > 0.3) throw Special(42);
                                                d[0] = -y[0];
                                              }),
                                     tolerance(1e-8));
  std::array<double, 1> y = {1.0};
  try {
    flow->evolve(y, 0.0, 1.0);
    FAIL() << "no exception";
  } catch (const Special& e) {
    EXPECT_EQ(e.number, 42);
  }
  throwing = false;
  y = {1.0};
  ASSERT_TRUE(flow->evolve(y, 0.0, 1.0).reached());
  constexpr double accuracy = 1e-6;
  EXPECT_NEAR(y[0], std::exp(-1.0), accuracy);
}

TEST_F(ArkodeOutcome, AToleranceBelowRoundingIsAResultOrIsMet) {
  // Whatever ARKODE decides, it must neither hang, throw nor print.
  IntegratorOptions o = tolerance(1e-19);
  o.max_steps_per_period = 2000;
  const auto flow = make_arkode_flow(problems::clearance_oscillator(1.0), o);
  std::array<double, 2> y = {1.1, 0.0};
  const Evolution e = flow->evolve(y, 0.0, two_pi);
  EXPECT_FALSE(e.reached());
  EXPECT_FALSE(e.message.empty());
}

// ---- the smallest gear --------------------------------------------------------------------------------------------

TEST(ClearanceOscillator, PoincarePointsAreThePublishedOnes) {
  // docs/theory/published_results.md, section 4, twelve decimals from closed-form pieces. Integrator tolerance 1e-13 a
  // step times some hundred steps of memory (damping 0.05).
  constexpr double accuracy = 1e-10;
  struct Row {
    double w, x, v;
  };
  const Row rows[] = {{0.85, 0.876227879084, -0.132089512752},
                      {1.0, 0.994165539631, -0.160125205036},
                      {1.3, 1.077129458286, -0.147560033051}};
  for (const Row& r : rows) {
    IntegratorOptions o = tolerance(1e-13);
    const auto flow = make_arkode_flow(problems::clearance_oscillator(r.w), o);
    std::array<double, 2> y = {1.1, 0.0};
    for (int k = 0; k < 200; ++k) ASSERT_TRUE(flow->evolve(y, 0.0, two_pi).reached());
    EXPECT_NEAR(y[0], r.x, accuracy) << r.w;
    EXPECT_NEAR(y[1], r.v, accuracy) << r.w;
  }
}

}  // namespace
}  // namespace epicyclic::integrate::arkode_flow_test
