// What holds for every method, and the orders of the multistep ones.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/fit.hpp"
#include "integrate/each_method.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/methods.hpp"
#include "problems/clearance_exact.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::integrate::families_test {
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

class EachMethod : public ::testing::TestWithParam<Method> {
 protected:
  [[nodiscard]] static bool coarse() { return GetParam().order <= 3; }
};

TEST_P(EachMethod, FindsTheExactPeriodicOrbitOfTheClearanceOscillator) {
  const double w = 0.85;
  const problems::ClearanceExact exact(w);
  const std::array<double, 2> start = exact.periods({1.1, 0.0}, 300);
  // A pair that misses kinks is right where it is smooth, and told from the others where it is not.
  const bool misses = GetParam().misses_kinks;
  const double tolerance = misses ? 1e-12 : coarse() ? 1e-9 : 1e-10;
  const auto flow = make_flow(problems::clearance_oscillator(w), options(GetParam().name, tolerance));
  std::array<double, 2> y = start;
  ASSERT_TRUE(flow->evolve(y, 0.0, two_pi).reached());
  // One period: tolerance per step times some hundred to some ten thousand steps.
  const double accuracy = 2000.0 * tolerance;
  const double error = std::hypot(y[0] - start[0], y[1] - start[1]);
  if (misses) {
    EXPECT_GT(error, accuracy);
  } else {
    EXPECT_LT(error, accuracy);
  }
}

TEST_P(EachMethod, StepsOntoBreakpointsAndSeesThemFromTheirOwnSide) {
  const double tolerance = coarse() ? 1e-8 : 1e-10;
  const auto end = [&](std::string_view method, double t) {
    const auto flow = make_flow(problems::jumping(true), options(method, t));
    std::array<double, 1> y = {0.4};
    EXPECT_TRUE(flow->evolve(y, 0.0, 2.0).reached());
    return y[0];
  };
  const double exact = end("arkode-fehlberg78", 1e-14);
  // Tolerance per step times some hundred steps.
  const double accuracy = 1000.0 * tolerance;
  EXPECT_NEAR(end(GetParam().name, tolerance), exact, accuracy);
}

TEST_P(EachMethod, TheNumberOfSamplesDoesNotChangeTheEnd) {
  std::vector<std::array<double, 2>> ends;
  for (const int count : {0, 1, 7, 64, 1000}) {
    std::vector<double> samples;
    for (int k = 1; k <= count; ++k) samples.push_back(3.0 * two_pi * k / count);
    const auto flow = make_flow(problems::clearance_oscillator(0.85), options(GetParam().name, 1e-7));
    std::array<double, 2> y = {1.1, 0.0};
    int seen = 0;
    ASSERT_TRUE(
        flow->evolve(y, 0.0, 3.0 * two_pi, samples, [&](std::size_t, double, std::span<const double>) { ++seen; })
            .reached());
    EXPECT_EQ(seen, count);
    ends.push_back(y);
  }
  for (const auto& end : ends) EXPECT_EQ(end, ends.front());
}

TEST_P(EachMethod, DenseOutputIsTheSolution) {
  const auto flow = make_flow(problems::smooth_nonlinear(), options(GetParam().name, 1e-9));
  std::array<double, 4> y = problems::smooth_nonlinear_solution(0.0);
  std::vector<double> samples;
  for (int k = 1; k <= 20; ++k) samples.push_back(0.05 * k);
  // Cubic Hermite between steps (lower for order 2), or the method's polynomial; steps of order 8 are long.
  const double dense_output = GetParam().order == 8 ? 1e-2 : 2e-4;
  ASSERT_TRUE(flow->evolve(y, 0.0, 1.0, samples,
                           [&](std::size_t, double s, std::span<const double> at) {
                             const auto exact = problems::smooth_nonlinear_solution(s);
                             for (std::size_t j = 0; j < 4; ++j)
                               EXPECT_NEAR(at[j], exact[j], dense_output * (1.0 + std::abs(exact[j]))) << s;
                           })
                  .reached());
}

TEST_P(EachMethod, AForgetfulFlowDependsOnItsArgumentsAlone) {
  const auto flow = make_flow(problems::clearance_oscillator(1.0), options(GetParam().name, 1e-7));
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

INSTANTIATE_TEST_SUITE_P(Methods, EachMethod, ::testing::ValuesIn(methods()), name_of);

// ---- multistep orders ---------------------------------------------------------------------------------------------

/// Slope of log error over log (mean step) of a multistep method held at one order: with step control the local error
/// is constant, h^(q+1) ~ tolerance, and what it adds up to falls with h^q.
double observed_order(const std::string& method, int order) {
  std::vector<double> steps;
  std::vector<double> errors;
  constexpr int count = 9;
  for (int k = 0; k < count; ++k) {
    // From where the steps resolve the solution to where rounding comes near.
    const double coarsest = order <= 2 ? 1e-6 : order <= 4 ? 1e-7 : 1e-10;
    const double finest = order <= 2 ? 1e-9 : order <= 4 ? 1e-11 : 1e-13;
    const double tolerance = coarsest * std::pow(finest / coarsest, k / (count - 1.0));
    IntegratorOptions o = options(method, tolerance);
    o.max_order = order;
    constexpr double end = 400.0;
    const auto flow = make_flow(problems::smooth_follower(), o);
    std::array<double, 1> y = {1.0};
    std::vector<double> samples;
    for (double s = 10.0; s <= end; s += 0.37) samples.push_back(s);
    double square = 0.0;
    EXPECT_TRUE(flow->evolve(y, 0.0, end, samples,
                             [&](std::size_t, double s, std::span<const double> at) {
                               square += std::pow(at[0] - std::cos(s), 2);
                             })
                    .reached());
    steps.push_back(-std::log(static_cast<double>(flow->work().steps)));
    errors.push_back(0.5 * std::log(square));
  }
  return fitted_slope(steps, errors);
}

TEST(MultistepMethods, ConvergeWithTheOrderTheyAreHeldAt) {
  // How far a measured order may be from the theory at finite steps.
  constexpr double order_tolerance = 0.2;
  for (int order = 2; order <= 5; ++order) {
    const double bdf = observed_order("cvode-bdf", order);
    EXPECT_NEAR(bdf, order, order_tolerance) << "bdf";
    RecordProperty("bdf_" + std::to_string(order), std::to_string(bdf));
  }
  for (int order = 2; order <= 6; ++order) {
    const double adams = observed_order("cvode-adams", order);
    EXPECT_NEAR(adams, order, order_tolerance) << "adams";
    RecordProperty("adams_" + std::to_string(order), std::to_string(adams));
  }
}

// ---- restarts -----------------------------------------------------------------------------------------------------

TEST(ExplicitMethods, ARunSplitByARestartHasTheSameBits) {
  // Stopped after any accepted step, state and step length handed to a new flow.
  const problems::ClearanceExact exact(0.85);
  for (const Method& method : methods()) {
    if (method.family != Family::erk) continue;
    const IntegratorOptions whole = options(method.name, 1e-8);
    const auto field = problems::clearance_oscillator(0.85);
    std::array<double, 2> unsplit = {1.1, 0.0};
    ASSERT_TRUE(make_flow(field, whole)->evolve(unsplit, 0.0, two_pi).reached());
    for (const long steps : {1L, 2L, 7L, 15L}) {
      IntegratorOptions few = whole;
      few.max_steps_per_period = steps;
      const auto first = make_flow(field, few);
      std::array<double, 2> y = {1.1, 0.0};
      const Evolution e = first->evolve(y, 0.0, two_pi);
      ASSERT_EQ(e.outcome, Outcome::step_limit) << method.name << " after " << steps;
      const auto second = make_flow(field, whole);
      second->set_next_step(first->next_step());
      ASSERT_TRUE(second->evolve(y, e.s, two_pi).reached());
      EXPECT_EQ(y, unsplit) << method.name << " after " << steps;
    }
  }
}

TEST(ImplicitMethods, NeedAFieldWithTangents) {
  VectorField f;
  f.dimension = 1;
  f.right_hand_side = [](std::size_t, double, const double* y, double* d) { d[0] = -y[0]; };
  for (const Method& method : methods()) {
    if (method.implicit()) {
      EXPECT_THROW((void)make_flow(f, options(method.name, 1e-8)), InputError) << method.name;
    } else {
      EXPECT_NO_THROW((void)make_flow(f, options(method.name, 1e-8))) << method.name;
    }
  }
}

TEST(ImplicitMethods, AreNotHeldBackByAStiffSystem) {
  // y' = -1e5 (y - cos s): explicit steps are 3e-5, implicit ones are as long as the solution allows.
  const auto f =
      make_field(1, 0.0, [](std::size_t, double s, const auto* y, auto* d) { d[0] = -1e5 * (y[0] - std::cos(s)); });
  for (const Method& method : methods()) {
    if (!method.implicit()) continue;
    const auto flow = make_flow(f, options(method.name, 1e-6));
    std::array<double, 1> y = {1.0};
    const Evolution e = flow->evolve(y, 0.0, 3.0);
    ASSERT_TRUE(e.reached()) << method.name << ": " << e.message;
    constexpr double accuracy = 2e-5;
    EXPECT_NEAR(y[0], std::cos(3.0), accuracy) << method.name;
    constexpr long far_from_explicit = 10000;
    EXPECT_LT(flow->work().steps, far_from_explicit) << method.name;
    EXPECT_GT(flow->work().jacobians, 0) << method.name;
  }
}

}  // namespace
}  // namespace epicyclic::integrate::families_test
