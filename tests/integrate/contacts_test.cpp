// What kinks do to the order of a method, what locating them gives back, and what smoothing costs: the clearance
// oscillator, whose solution is known in closed form.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/fit.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/methods.hpp"
#include "integrate/sundials/arkode_flow.hpp"
#include "problems/clearance_exact.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::integrate::contacts_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double w = 0.85;

IntegratorOptions options(std::string_view method, double tolerance, bool locate) {
  IntegratorOptions o;
  o.method = method;
  o.relative_tolerance = tolerance;
  o.absolute_tolerance = tolerance;
  o.max_steps_per_period = 10000000;
  o.locate_contacts = locate;
  return o;
}

/// The periodic orbit in closed form; its transients are gone to rounding after 300 periods (damping 0.05).
const std::array<double, 2>& orbit() {
  static const std::array<double, 2> start = problems::ClearanceExact(w).periods({1.1, 0.0}, 300);
  return start;
}

struct Run {
  double error;  ///< of the state after the periods
  double right_hand_sides;
};

/// Where steps meet kinks hangs on the last bits of the start, and the error with it by a factor of several: the
/// geometric mean of five starts that differ by those.
Run run(const IntegratorOptions& o, int periods = 10) {
  constexpr std::array<double, 5> last_bits = {0.0, 1e-15, -1e-15, 2e-15, -2e-15};
  const auto flow = make_flow(problems::clearance_oscillator(w), o);
  double logarithms = 0.0;
  for (const double bits : last_bits) {
    std::array<double, 2> y = {orbit()[0] + bits, orbit()[1]};
    flow->forget();
    for (int k = 0; k < periods; ++k) EXPECT_TRUE(flow->evolve(y, 0.0, two_pi).reached());
    logarithms += std::log(std::hypot(y[0] - orbit()[0], y[1] - orbit()[1]));
  }
  return {std::exp(logarithms / last_bits.size()),
          static_cast<double>(flow->right_hand_side_calls()) / last_bits.size()};
}

/// Slope of log error over log tolerance from 1e-5 to `finest`.
double tolerance_slope(std::string_view method, bool locate, double finest) {
  std::vector<double> x;
  std::vector<double> y;
  for (double tolerance = 1e-5; tolerance > 0.9 * finest; tolerance *= std::sqrt(0.1)) {
    x.push_back(std::log(tolerance));
    y.push_back(std::log(run(options(method, tolerance, locate)).error));
  }
  return fitted_slope(x, y);
}

TEST(Contacts, ErrorFallsInProportionToTheToleranceDownTo1em12) {
  // Error control per step: the error of an orbit is the tolerance times a constant, kinks or not.
  for (const bool locate : {false, true})
    for (const char* method : {"arkode-bogacki-shampine", "arkode-dopri5", "arkode-verner65"}) {
      constexpr double slope_tolerance = 0.15;
      EXPECT_NEAR(tolerance_slope(method, locate, 1e-12), 1.0, slope_tolerance) << method << locate;
    }
  constexpr double roundings = 1e-12;  // of one period, which adds up some thousand
  for (const bool locate : {false, true}) EXPECT_LT(run(options("arkode-dopri5", 1e-14, locate), 1).error, roundings);
}

TEST(Contacts, LocatingThemSavesThePairsThatMissKinks) {
  for (const Method& method : methods()) {
    if (method.family != Family::erk || !method.misses_kinks) continue;
    const double ignored = run(options(method.name, 1e-10, false)).error;
    const double located = run(options(method.name, 1e-10, true)).error;
    constexpr double saved = 1e-3;  // measured: less than half of that
    EXPECT_LT(located, saved * ignored) << method.name;
  }
}

/// x'' = -x - k max(0, x - 1) from rest at -(1 + depth), after 2 pi. It is beyond 1 for 2 sqrt(2 depth) or less.
std::array<double, 2> after_a_visit(double depth, double k) {
  const double amplitude = 1.0 + depth;
  const double w1 = std::sqrt(1.0 + k);
  const double entry = std::acos(-1.0 / amplitude);
  const double speed = std::sqrt(amplitude * amplitude - 1.0);
  // Beyond 1: x - k / w1^2 turns with w1; it leaves with the speed that it came with.
  const double inside = 2.0 * std::atan2(speed / w1, 1.0 / (w1 * w1)) / w1;
  const double left = two_pi - entry - inside;
  return {std::cos(left) - speed * std::sin(left), -std::sin(left) - speed * std::cos(left)};
}

TEST(Contacts, AVisitBetweenTheEndsOfAStepIsNotMissed) {
  constexpr double k = 100.0;
  VectorField field;
  field.dimension = 2;
  field.period = two_pi;
  field.right_hand_side = [](std::size_t, double, const double* y, double* f) {
    f[0] = y[1];
    f[1] = -y[0] - k * std::max(0.0, y[0] - 1.0);
  };
  field.surfaces = {1, [](double, const double* y, double* values, double* rates) {
                      values[0] = y[0] - 1.0;
                      rates[0] = y[1];
                    }};
  for (const char* method : {"arkode-dopri5", "arkode-verner65", "arkode-fehlberg78"})
    for (double depth = 1e-7; depth < 0.1; depth *= 1.7) {
      const auto flow = make_flow(field, options(method, 1e-11, true));
      std::array<double, 2> y = {-1.0 - depth, 0.0};
      ASSERT_TRUE(flow->evolve(y, 0.0, two_pi).reached());
      const auto exact = after_a_visit(depth, k);
      // A visit of that depth that is missed is an error of k depth^1.5.
      constexpr double tolerance_times_condition = 2e-9;
      EXPECT_NEAR(y[0], exact[0], tolerance_times_condition) << method << " " << depth;
      EXPECT_NEAR(y[1], exact[1], tolerance_times_condition) << method << " " << depth;
    }
}

/// Error of one period in n equal steps: the order of convergence where kinks fall anywhere in a step.
double fixed_step_error(std::string_view method, int n) {
  IntegratorOptions o = options(method, 1e-13, false);
  const auto flow = make_arkode_fixed_step_flow(problems::clearance_oscillator(w), o, two_pi / n);
  std::array<double, 2> y = orbit();
  EXPECT_TRUE(flow->evolve(y, 0.0, two_pi).reached());
  return std::hypot(y[0] - orbit()[0], y[1] - orbit()[1]);
}

TEST(Contacts, AKinkInsideAStepMakesEveryMethodOfSecondOrder) {
  // A step of length h across a kink has the error h^2 times a factor that depends on where in the step it falls:
  // averaged over many step lengths, order 2 whatever the method's.
  for (const char* method : {"arkode-bogacki-shampine", "arkode-dopri5", "arkode-fehlberg78", "arkode-kvaerno5"}) {
    double slope[2] = {0.0, 0.0};
    constexpr int each = 60;
    for (int k = 0; k < each; ++k) {
      slope[0] += std::log(fixed_step_error(method, 400 + 3 * k));
      slope[1] += std::log(fixed_step_error(method, 3200 + 24 * k));
    }
    const double order = (slope[0] - slope[1]) / each / std::log(8.0);
    constexpr double scatter = 0.25;
    EXPECT_NEAR(order, 2.0, scatter) << method;
    RecordProperty(method, std::to_string(order));
  }
}

TEST(Contacts, SmoothingBiasesTheOrbitByTheSquareOfItsWidth) {
  // f_w - f is w^2 / (4 |x - b|) away from a kink and w / 2 on it, on a stretch of w: the orbit moves by w^2 log w.
  const auto distance = [](double width) {
    const auto flow = make_flow(problems::clearance_oscillator(w, width), options("arkode-dopri5", 1e-12, false));
    std::array<double, 2> y = orbit();
    for (int k = 0; k < 300; ++k) EXPECT_TRUE(flow->evolve(y, 0.0, two_pi).reached());
    return std::hypot(y[0] - orbit()[0], y[1] - orbit()[1]);
  };
  const double coarse = distance(0.02);
  const double fine = distance(0.002);
  const double slope = std::log10(coarse / fine);
  EXPECT_GT(slope, 1.5);
  EXPECT_LT(slope, 2.2);
  RecordProperty("bias_0.02", std::to_string(coarse));
}

TEST(Contacts, OnlyExplicitMethodsLocateThem) {
  for (const Method& method : methods()) {
    if (method.family == Family::erk) continue;
    EXPECT_THROW((void)make_flow(problems::clearance_oscillator(w), options(method.name, 1e-8, true)), InputError);
  }
}

TEST(Contacts, LocatedRunsAreTheSameWithAnyNumberOfSamples) {
  std::vector<std::array<double, 2>> ends;
  for (const int count : {0, 1, 64, 1000}) {
    std::vector<double> samples;
    for (int k = 1; k <= count; ++k) samples.push_back(two_pi * k / count);
    const auto flow = make_flow(problems::clearance_oscillator(w), options("arkode-dopri5", 1e-9, true));
    std::array<double, 2> y = {1.1, 0.0};
    int seen = 0;
    double last = 0.0;
    ASSERT_TRUE(flow->evolve(y, 0.0, two_pi, samples,
                             [&](std::size_t, double s, std::span<const double>) {
                               EXPECT_GT(s, last);
                               last = s;
                               ++seen;
                             })
                    .reached());
    EXPECT_EQ(seen, count);
    ends.push_back(y);
  }
  for (const auto& end : ends) EXPECT_EQ(end, ends.front());
}

}  // namespace
}  // namespace epicyclic::integrate::contacts_test
