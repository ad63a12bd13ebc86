#include "integrate/methods.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "integrate/arkode_flow.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::integrate {
namespace {

/// Error at s = 1 of n fixed steps.
double error_of_fixed_steps(const std::string& method, int n) {
  IntegratorOptions options;
  options.method = method;
  const auto flow = make_arkode_fixed_step_flow(problems::smooth_nonlinear(), options, 1.0 / n);
  std::array<double, 4> y = problems::smooth_nonlinear_solution(0.0);
  EXPECT_TRUE(flow->evolve(y, 0.0, 1.0).reached());
  const std::array<double, 4> exact = problems::smooth_nonlinear_solution(1.0);
  double worst = 0.0;
  for (std::size_t k = 0; k < 4; ++k) worst = std::max(worst, std::abs(y[k] - exact[k]));
  return worst;
}

/// Slope of log error over log n by least squares, where the error is above rounding.
double observed_order(const std::string& method, int order) {
  constexpr double rounding = 2e-12;
  const int first = order >= 8 ? 8 : order >= 5 ? 24 : 64;
  std::vector<double> x;
  std::vector<double> y;
  for (int n = first; x.size() < 5; n = n * 5 / 4) {
    const double error = error_of_fixed_steps(method, n);
    if (error < rounding) break;
    x.push_back(-std::log(n));
    y.push_back(std::log(error));
  }
  EXPECT_GE(x.size(), 3U) << method;
  double sx = 0.0;
  double sy = 0.0;
  double sxx = 0.0;
  double sxy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    sx += x[k];
    sy += y[k];
    sxx += x[k] * x[k];
    sxy += x[k] * y[k];
  }
  const auto m = static_cast<double>(x.size());
  return (m * sxy - sx * sy) / (m * sxx - sx * sx);
}

TEST(ErkMethods, EachConvergesWithItsOrder) {
  // How far a measured order may be from the theory at finite steps.
  constexpr double order_tolerance = 0.2;
  for (const ErkMethod& method : erk_methods()) {
    const std::string name(method.name);
    const double order = observed_order(name, method.order);
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
      // Errors add up over the steps and y grows to 67: within some hundred times the tolerance.
      constexpr double accumulation = 1000.0;
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
    const std::string end = "_" + std::to_string(m.stages) + "_" + std::to_string(m.embedded_order) + "_" +
                            std::to_string(m.order);
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
