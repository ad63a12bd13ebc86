#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "integrate/arkode_flow.hpp"
#include "integrate/methods.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::integrate {
namespace {

/// Relative error of n fixed steps; y_4 is of order 1.
double error_of_fixed_steps(const ErkMethod& method, int n) {
  IntegratorOptions options;
  options.method = method.name;
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
double observed_order(const ErkMethod& method) {
  const int first = method.order >= 8 ? 18 : method.order == 6 ? 56 : 112;
  double sx = 0.0;
  double sy = 0.0;
  double sxx = 0.0;
  double sxy = 0.0;
  constexpr int count = 5;
  for (int k = 0; k < count; ++k) {
    const int n = static_cast<int>(std::lround(first * std::exp2(k / (count - 1.0))));
    const double x = -std::log(n);
    const double y = std::log(error_of_fixed_steps(method, n));
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

TEST(ErkMethods, EachConvergesWithItsOrder) {
  // How far a measured order may be from the theory at finite steps.
  constexpr double order_tolerance = 0.2;
  for (const ErkMethod& method : erk_methods()) {
    const std::string name(method.name);
    const double order = observed_order(method);
    EXPECT_NEAR(order, method.order, order_tolerance) << name;
    RecordProperty(name, std::to_string(order));
  }
}

TEST(ErkMethods, AdaptiveErrorFallsWithTheTolerance) {
  for (const ErkMethod& method : erk_methods()) {
    double last = 1.0;
    const double tightest = method.order <= 2 ? 1e-8 : 1e-11;
    for (double tolerance = 1e-5; tolerance > 0.5 * tightest; tolerance *= 1e-3) {
      IntegratorOptions options;
      options.method = method.name;
      options.relative_tolerance = tolerance;
      options.absolute_tolerance = tolerance;
      options.max_steps_per_period = 10000000;
      const auto flow = make_arkode_flow(problems::smooth_nonlinear(), options);
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

TEST(ErkMethods, NamesAreFoundAndDistinct) {
  const std::vector<std::string> names = arkode_method_names();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), erk_methods().size());
  for (const std::string& name : names) {
    EXPECT_TRUE(name.starts_with("arkode-"));
    ASSERT_NE(find_erk_method(name), nullptr);
    EXPECT_EQ(find_erk_method(name)->name, name);
  }
  EXPECT_EQ(find_erk_method("dopri5"), nullptr);
  EXPECT_NE(find_erk_method(IntegratorOptions{}.method), nullptr);
}

TEST(ErkMethods, OrdersAndStagesAreThoseOfTheTables) {
  for (const ErkMethod& m : erk_methods()) {
    // ARKODE's names end in stages_embedded_order.
    const std::string end =
        "_" + std::to_string(m.stages) + "_" + std::to_string(m.embedded_order) + "_" + std::to_string(m.order);
    EXPECT_TRUE(m.table.ends_with(end)) << m.table;
  }
  EXPECT_TRUE(std::is_sorted(erk_methods().begin(), erk_methods().end(),
                             [](const ErkMethod& a, const ErkMethod& b) { return a.order < b.order; }));
}

TEST(ErkMethods, AnUnknownMethodIsAnInputError) {
  IntegratorOptions options;
  options.method = "arkode-euler";
  EXPECT_THROW((void)make_arkode_flow(problems::smooth_nonlinear(), options), InputError);
}

}  // namespace
}  // namespace epicyclic::integrate
