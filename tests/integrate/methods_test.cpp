#include "integrate/methods.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/fit.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/sundials/arkode_flow.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::integrate::methods_test {
namespace {

/// Relative error of n fixed steps; y_4 is of order 1.
double error_of_fixed_steps(const Method& method, int n) {
  IntegratorOptions options;
  options.method = method.name;
  // Of Newton's method in implicit stages.
  options.relative_tolerance = 1e-13;
  options.absolute_tolerance = 1e-13;
  if (method.order >= 8) {
    constexpr double end = 2.4;
    const auto flow = make_arkode_fixed_step_flow(problems::smooth_bell(), options, end / n);
    std::array<double, 1> y = {problems::smooth_bell_solution(0.0)};
    EXPECT_TRUE(flow->evolve(y, 0.0, end).reached());
    return std::abs(y[0] / problems::smooth_bell_solution(end) - 1.0);
  }
  constexpr double end = 1.3;
  const auto flow = make_arkode_fixed_step_flow(problems::smooth_nonlinear(), options, end / n);
  std::array<double, 4> y = problems::smooth_nonlinear_solution(0.0);
  EXPECT_TRUE(flow->evolve(y, 0.0, end).reached());
  const std::array<double, 4> exact = problems::smooth_nonlinear_solution(end);
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) sum = std::hypot(sum, (y[k] - exact[k]) / (k == 3 ? 1.0 : exact[k]));
  return sum;
}

/// Slope of log error over log step by least squares: steps so short that the leading term rules, so long that
/// rounding does not.
double observed_order(const Method& method) {
  const int first = method.order >= 8 ? 18 : method.order == 6 ? 56 : 112;
  std::vector<double> steps;
  std::vector<double> errors;
  constexpr int count = 5;
  for (int k = 0; k < count; ++k) {
    const int n = static_cast<int>(std::lround(first * std::exp2(k / (count - 1.0))));
    steps.push_back(-std::log(n));
    errors.push_back(std::log(error_of_fixed_steps(method, n)));
  }
  return fitted_slope(steps, errors);
}

TEST(Methods, NoneCarriesAMotionBackwardsOrNowhere) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const char* name : {"arkode-dopri5", "cvode-adams", "lanes-cash-karp"}) {
    IntegratorOptions options;
    options.method = name;
    const auto flow = make_flow(problems::duffing(0.3, -1.0, 0.2, 1.2), options);
    std::vector<double> y = {1.0, 0.0};
    EXPECT_THROW((void)flow->evolve(y, 6.0, 3.0), InputError) << name;
    EXPECT_THROW((void)flow->evolve(y, 0.0, nan), InputError) << name;
    EXPECT_THROW((void)flow->evolve(y, nan, 1.0), InputError) << name;
    const std::vector<double> unsorted = {0.9, 0.3, 0.6};
    EXPECT_ANY_THROW((void)flow->evolve(y, 0.0, 1.0, unsorted, [](auto&&...) {})) << name;
  }
}

TEST(Methods, EachConvergesWithItsOrder) {
  // How far a measured order may be from the theory at finite steps.
  constexpr double order_tolerance = 0.2;
  for (const Method& method : methods()) {
    if (method.multistep() || method.family == Family::lanes) continue;
    const std::string name(method.name);
    const double order = observed_order(method);
    EXPECT_NEAR(order, method.order, order_tolerance) << name;
    RecordProperty(name, std::to_string(order));
  }
}

TEST(Methods, AdaptiveErrorFallsWithTheTolerance) {
  for (const Method& method : methods()) {
    double last = 1.0;
    // BDF of order 5 takes as many steps as a pair of order 4; what it may add up is more.
    const double tightest = method.order <= 2 ? 1e-8 : 1e-11;
    for (double tolerance = 1e-5; tolerance > 0.5 * tightest; tolerance *= 1e-3) {
      IntegratorOptions options;
      options.method = method.name;
      options.relative_tolerance = tolerance;
      options.absolute_tolerance = tolerance;
      options.max_steps_per_period = 10000000;
      const auto flow = make_flow(problems::smooth_nonlinear(), options);
      std::array<double, 4> y = problems::smooth_nonlinear_solution(0.0);
      ASSERT_TRUE(flow->evolve(y, 0.0, 1.0).reached()) << method.name;
      const std::array<double, 4> exact = problems::smooth_nonlinear_solution(1.0);
      double error = 0.0;
      for (std::size_t k = 0; k < 4; ++k) error = std::max(error, std::abs(y[k] - exact[k]));
      // Errors add up over some hundred steps, and the flow stretches them (y_2 grows from 1 to 67).
      constexpr double accumulation = 5000.0;
      EXPECT_LT(error, accumulation * tolerance) << method.name;
      // A thousandth of the tolerance must gain at least a factor of ten.
      EXPECT_LT(error, 0.1 * last) << method.name << " at " << tolerance;
      last = error;
    }
  }
}

TEST(Methods, NamesAreFoundAndDistinct) {
  const std::vector<std::string> names = method_names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), methods().size());
  for (const std::string& name : names) {
    ASSERT_NE(find_method(name), nullptr);
    const Method& method = *find_method(name);
    EXPECT_TRUE(name.starts_with(method.multistep()               ? "cvode-"
                                 : method.family == Family::lanes ? "lanes-"
                                                                  : "arkode-"));
    EXPECT_EQ(find_method(name)->name, name);
    const Method* twin = find_method(arkode_twin(name));
    ASSERT_NE(twin, nullptr);
    EXPECT_EQ(twin->family, method.family == Family::lanes ? Family::erk : method.family);
    EXPECT_EQ(twin->stages, method.stages);
  }
  EXPECT_EQ(find_method("dopri5"), nullptr);
  EXPECT_NE(find_method(IntegratorOptions{}.method), nullptr);
}

TEST(Methods, OrdersAndStagesAreThoseOfTheTables) {
  for (const Method& m : methods()) {
    if (m.table.empty()) continue;
    // ARKODE's names end in stages_embedded_order.
    const std::string end =
        "_" + std::to_string(m.stages) + "_" + std::to_string(m.embedded_order) + "_" + std::to_string(m.order);
    EXPECT_TRUE(m.table.ends_with(end)) << m.table;
  }
  EXPECT_TRUE(std::is_sorted(methods().begin(), methods().end(), [](const Method& a, const Method& b) {
    return a.family != b.family ? a.family < b.family : a.order < b.order;
  }));
}

TEST(Methods, AnUnknownMethodIsAnInputError) {
  IntegratorOptions options;
  options.method = "arkode-euler";
  EXPECT_THROW((void)make_flow(problems::smooth_nonlinear(), options), InputError);
}

}  // namespace
}  // namespace epicyclic::integrate::methods_test
