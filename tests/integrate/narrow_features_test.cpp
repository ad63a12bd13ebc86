// Forces that act during a small part of the period: the error estimate of a step knows them only if it evaluates them.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/random_numbers.hpp"
#include "integrate/make_field.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/methods.hpp"

namespace epicyclic::integrate::narrow_features_test {
namespace {

constexpr double period = 6.0;

/// A force of triangular course, of unit impulse.
struct Pulse {
  double centre = 0;      ///< of the period
  double half_width = 0;  ///< of the period
};

/// x'' + 0.2 x' + x = the pulse.
VectorField oscillator(const Pulse& p) {
  return make_field(2, period, [p](std::size_t, double s, const auto* y, auto* dyds) {
    const double phase = s / period - std::floor(s / period);
    const double height = std::max(0.0, 1.0 - std::abs(phase - p.centre) / p.half_width) / (p.half_width * period);
    dyds[0] = y[1];
    dyds[1] = height - 0.2 * y[1] - y[0];
  });
}

VectorField with_breakpoints(const Pulse& p) {
  VectorField field = oscillator(p);
  for (const double edge : {-1.0, 0.0, 1.0}) field.breakpoints.push_back(period * (p.centre + edge * p.half_width));
  return field;
}

/// From rest, or another state, over one period.
std::array<double, 2> after_a_period(const VectorField& field, const IntegratorOptions& options,
                                     std::array<double, 2> y = {}) {
  EXPECT_TRUE(make_flow(field, options)->evolve(y, 0.0, period).reached()) << options.method;
  return y;
}

IntegratorOptions options_of(std::string method, double tolerance) {
  IntegratorOptions o;
  o.method = std::move(method);
  o.relative_tolerance = o.absolute_tolerance = tolerance;
  o.max_steps_per_period = 10'000'000;
  return o;
}

double apart(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return std::max(std::abs(a[0] - b[0]), std::abs(a[1] - b[1]));
}

/// Of widths from 0.05 % to 5 % of the period.
Pulse random_pulse(std::uint64_t k) {
  Pulse p;
  p.half_width = 0.5 * std::pow(10.0, -1.3 - 2.0 * random_uniform(11, 2 * k));
  p.centre = p.half_width + 1e-3 + (1.0 - 2.0 * p.half_width - 2e-3) * random_uniform(11, 2 * k + 1);
  return p;
}

/// With three kinks of a pulse inside of steps, whose error estimates are less than the errors. A pulse that is stepped
/// over leaves an error of 1.
constexpr double of_a_tolerance = 1e4;

TEST(NarrowFeatures, ASamplingIntervalKeepsEachMethodFromSteppingOverThem) {
  constexpr double tolerance = 1e-6;
  for (const Method& method : methods()) {
    if (method.misses_kinks) continue;
    for (std::uint64_t k = 0; k < 10; ++k) {
      const Pulse p = random_pulse(k);
      VectorField field = oscillator(p);
      field.sampling_interval = {period * p.half_width};
      const auto expected = after_a_period(with_breakpoints(p), options_of("arkode-dopri5", 1e-11));
      EXPECT_LT(apart(after_a_period(field, options_of(std::string(method.name), tolerance)), expected),
                of_a_tolerance * tolerance)
          << method.name << " at " << p.centre << ", " << p.half_width;
    }
  }
}

TEST(NarrowFeatures, OfAThousandRandomPulsesNoneIsSteppedOver) {
  constexpr double tolerance = 1e-8;
  for (const char* name : {"arkode-dopri5", "lanes-dopri5"}) {
    for (std::uint64_t k = 0; k < 1000; ++k) {
      const Pulse p = random_pulse(k);
      VectorField field = oscillator(p);
      field.sampling_interval = {period * p.half_width};
      const auto expected = after_a_period(with_breakpoints(p), options_of("arkode-dopri5", 1e-12));
      ASSERT_LT(apart(after_a_period(field, options_of(name, tolerance)), expected), of_a_tolerance * tolerance)
          << name << " at " << p.centre << ", " << p.half_width;
    }
  }
}

TEST(NarrowFeatures, ALongestStepFindsWhatAFieldDoesNotTellOf) {
  constexpr double tolerance = 1e-8;
  for (const char* name : {"arkode-dopri5", "cvode-adams", "lanes-cash-karp"}) {
    const Pulse p{0.61, 5e-4};
    const auto expected = after_a_period(with_breakpoints(p), options_of("arkode-dopri5", 1e-12));
    IntegratorOptions o = options_of(name, tolerance);
    o.max_step_periods = p.half_width;
    EXPECT_LT(apart(after_a_period(oscillator(p), o), expected), of_a_tolerance * tolerance) << name;
    // The fault that it is for: without it the whole pulse is stepped over at this tolerance.
    o.max_step_periods = 0.0;
    EXPECT_LT(std::abs(after_a_period(oscillator(p), o)[1]), tolerance) << name;
  }
}

TEST(NarrowFeatures, ALimitChangesNoBitOfStepsThatAreShorter) {
  const Pulse p{0.5, 0.4};
  for (const char* name : {"arkode-dopri5", "cvode-adams", "cvode-bdf", "arkode-kvaerno5", "lanes-dopri5"}) {
    IntegratorOptions o = options_of(name, 1e-9);
    const auto free = after_a_period(oscillator(p), o, {1.0, 0.0});
    o.max_step_periods = 0.5;
    EXPECT_EQ(after_a_period(oscillator(p), o, {1.0, 0.0}), free) << name;
  }
}

TEST(NarrowFeatures, ASegmentHasALimitOfItsOwn) {
  VectorField field = oscillator({0.5, 0.1});
  field.breakpoints = {1.0, 2.0};
  field.sampling_interval = {0.25, 1.0};
  IntegratorOptions o;
  EXPECT_EQ(longest_step(field, o, 0, 0.5), 0.5);
  EXPECT_EQ(longest_step(field, o, 1, 0.5), 2.0);
  o.max_step_periods = 0.05;
  EXPECT_EQ(longest_step(field, o, 1, 0.5), 0.05 * period);
}

TEST(NarrowFeatures, ANegativeLimitIsRefused) {
  IntegratorOptions o;
  o.max_step_periods = -0.1;
  EXPECT_THROW(o.validate(), InputError);
}

TEST(NarrowFeatures, TheWidestGapIsThatOfAllNodes) {
  EXPECT_EQ(widest_gap(std::array{0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0}), 0.5);
  EXPECT_EQ(widest_gap(std::array{0.75}), 0.75);
}

}  // namespace
}  // namespace epicyclic::integrate::narrow_features_test
