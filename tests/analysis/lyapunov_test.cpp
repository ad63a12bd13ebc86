// Lyapunov spectra of systems whose exponents are published (docs/theory/published_results.md, section 3), and what
// exponents must obey.

#include "analysis/lyapunov.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/periodic_orbit.hpp"
#include "core/dense.hpp"
#include "core/errors.hpp"
#include "core/random_numbers.hpp"
#include "integrate/make_flow.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::analysis::lyapunov_test {
namespace {

integrate::IntegratorOptions tight(double tolerance) {
  integrate::IntegratorOptions o;
  o.relative_tolerance = tolerance;
  o.absolute_tolerance = tolerance;
  o.max_steps_per_period = 1000000;
  o.tangent_error_control = true;  // without it the sum is off by 1e4 tolerances, with it by 10 (Roessler)
  return o;
}

bool always() { return true; }

LyapunovSpectrum spectrum(const VectorField& field, std::vector<double> y, const SpectrumOptions& options,
                          double tolerance) {
  const auto flow = integrate::make_flow(field, tight(tolerance));
  return lyapunov_spectrum(*flow, y, options, always);
}

/// Largest within 0.002 or its own interval, the others likewise.
void expect_published(const LyapunovSpectrum& s, const std::vector<double>& published) {
  ASSERT_TRUE(s.evolution.reached());
  ASSERT_EQ(s.per_s.size(), published.size());
  for (std::size_t i = 0; i < published.size(); ++i)
    EXPECT_NEAR(s.per_s[i].value, published[i], std::max(0.002, s.per_s[i].half_width)) << i;
}

TEST(LyapunovSpectrum, OfLorenz) {
  const SpectrumOptions options{.aligning_intervals = 200, .intervals = 8000, .interval = 0.5};
  const LyapunovSpectrum s = spectrum(problems::lorenz(), {1.0, 1.0, 20.0}, options, 1e-8);
  expect_published(s, {0.9053, 0.0, -14.5719});
  EXPECT_GT(s.per_s[0].low(), 0.0);
  EXPECT_LT(s.per_s[0].half_width, 0.02);
  constexpr double source_digits = 0.5e-4;  // half a unit of the fourth decimal
  EXPECT_NEAR(kaplan_yorke_dimension(std::array{0.9053, 0.0, -14.5719}), 2.0621, source_digits);
}

TEST(LyapunovSpectrum, OfRoessler) {
  const SpectrumOptions options{.aligning_intervals = 200, .intervals = 8000, .interval = 1.0};
  expect_published(spectrum(problems::roessler(), {1.0, 1.0, 0.0}, options, 1e-8), {0.0711, 0.0, -5.3940});
}

TEST(LyapunovSpectrum, OfDuffing) {
  const SpectrumOptions options{.aligning_intervals = 100, .intervals = 12000};
  const LyapunovSpectrum s = spectrum(problems::duffing(0.25, -1.0, 0.4, 1.0), {1.0, 0.0}, options, 1e-8);
  expect_published(s, {0.1569, -0.4069});
}

TEST(LyapunovSpectrum, ComesBySizeWhateverSubspacesTheMotionKeeps) {
  // Of y_1' = -2 y_1, y_2' = -y_2 / 2, y_3' = -y_3 each axis is kept.
  const VectorField apart = integrate::make_field(3, 0.0, [](std::size_t, double, const auto* y, auto* d) {
    d[0] = -2.0 * y[0];
    d[1] = -0.5 * y[1];
    d[2] = -1.0 * y[2];
  });
  const SpectrumOptions options{.aligning_intervals = 60, .intervals = 20, .interval = 1.0};
  const LyapunovSpectrum s = spectrum(apart, {1.0, 1.0, 1.0}, options, 1e-10);
  constexpr double tolerance = 1e-8;
  EXPECT_NEAR(s.per_s[0].value, -0.5, tolerance);
  EXPECT_NEAR(s.per_s[1].value, -1.0, tolerance);
  EXPECT_NEAR(s.per_s[2].value, -2.0, tolerance);
}

/// Rates of dx_i/ds = -rate_i x_i + (a rotation of the axes), known exactly.
void expect_rates(const std::vector<double>& rates, double interval) {
  const std::size_t n = rates.size();
  const VectorField field = integrate::make_field(n, 0.0, [rates](std::size_t, double, const auto* y, auto* d) {
    for (std::size_t i = 0; i < rates.size(); ++i) {
      d[i] = rates[i] * y[i];
      // Each direction drives the slower ones: no axis but the first is kept.
      for (std::size_t j = i + 1; j < rates.size(); ++j) d[i] += 0.3 * y[j];
    }
  });
  const SpectrumOptions options{.aligning_intervals = 40, .intervals = 10, .interval = interval};
  const LyapunovSpectrum s = spectrum(field, std::vector<double>(n, 0.0), options, 1e-10);
  ASSERT_TRUE(s.evolution.reached());
  std::vector<double> falling = rates;
  std::sort(falling.rbegin(), falling.rend());
  // [A-spectrum]: an error of 1e-10 in parts that are 1e6 apart, over parts of some length.
  constexpr double tolerance = 1e-3;
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += falling[i];
    EXPECT_NEAR(s.per_s[i].value, falling[i], tolerance * std::max(1.0, std::abs(falling[i]))) << i;
  }
  EXPECT_NEAR(s.sum.value, sum, tolerance * std::abs(sum));
}

TEST(LyapunovSpectrum, OfAStrongContractionIsNotThatOfRounding) {
  expect_rates({-50.0, -1.0}, 1.0);
  expect_rates({0.1, -0.2, -30.0, -31.0}, 6.0);
}

TEST(LyapunovSpectrumLong, OfAThousandRandomContractionsNoneIsWrong) {
  for (std::uint64_t k = 0; k < 1000; ++k) {
    std::vector<double> rates;
    const auto draw = [&](std::uint64_t n) { return random_uniform(17, 16 * k + n); };
    const auto count = 2 + static_cast<std::size_t>(4.0 * draw(0));
    double rate = 0.5 - draw(1);
    for (std::size_t i = 0; i < count; ++i) {
      rates.push_back(rate);
      // Far enough apart to align within the intervals before the counted ones.
      rate -= 0.5 + std::pow(10.0, 2.0 * draw(2 + i)) - 1.0;
    }
    std::reverse(rates.begin(), rates.end());
    ASSERT_NO_FATAL_FAILURE(expect_rates(rates, 0.5 + 2.0 * draw(9))) << k;
    ASSERT_FALSE(testing::Test::HasFailure()) << k;
  }
}

TEST(LyapunovSpectrum, AddsUpToTheDivergence) {
  // Where the divergence is a number, and where it has to be taken along the motion.
  constexpr double tolerance = 1e-13;
  constexpr double times_the_condition = 1e-10;  // a hundred steps, and rates of some 10
  const SpectrumOptions lorenz{.aligning_intervals = 10, .intervals = 40, .interval = 0.25};
  const LyapunovSpectrum a = spectrum(problems::lorenz(), {1.0, 1.0, 20.0}, lorenz, tolerance);
  EXPECT_NEAR(a.sum.value, -41.0 / 3.0, times_the_condition);
  const SpectrumOptions duffing{.aligning_intervals = 10, .intervals = 40};
  const LyapunovSpectrum c = spectrum(problems::duffing(0.25, -1.0, 0.4, 1.0), {1.0, 0.0}, duffing, tolerance);
  EXPECT_NEAR(c.sum.value, -0.25, times_the_condition);

  const SpectrumOptions roessler{.aligning_intervals = 0, .intervals = 32, .interval = 0.25};
  const LyapunovSpectrum b = spectrum(problems::roessler(), {1.0, 1.0, 0.0}, roessler, tolerance);
  const auto flow = integrate::make_flow(with_divergence(problems::roessler()), tight(tolerance));
  std::vector<double> y = {1.0, 1.0, 0.0, 0.0};
  ASSERT_TRUE(flow->evolve(y, 0.0, 8.0).reached());
  EXPECT_NEAR(b.sum.value, y[3] / 8.0, times_the_condition);
}

TEST(LyapunovSpectrum, OfAPeriodicMotionAreTheLogarithmsOfItsMultipliers) {
  // Duffing with g = 0.2: period 1, Floquet multipliers by the orbit's monodromy.
  const VectorField field = problems::duffing(0.3, -1.0, 0.2, 1.2);
  const auto flow = integrate::make_flow(field, tight(1e-12));
  std::vector<double> y = {1.0, 0.0};
  for (int k = 0; k < 200; ++k) ASSERT_TRUE(flow->evolve(y, 0.0, field.period).reached());
  const PeriodicOrbit orbit = find_periodic_orbit(*flow, y, 1);
  ASSERT_TRUE(orbit.found());
  std::vector<double> moduli;
  for (const auto& multiplier : epicyclic::eigenvalues(orbit.monodromy)) moduli.push_back(std::abs(multiplier));
  std::sort(moduli.rbegin(), moduli.rend());
  const LyapunovSpectrum s = lyapunov_spectrum(*flow, y, {.aligning_intervals = 100, .intervals = 2000}, always);
  for (std::size_t i = 0; i < moduli.size(); ++i)
    EXPECT_NEAR(s.per_s[i].value, std::log(moduli[i]) / field.period, s.per_s[i].half_width) << i;
}

TEST(LyapunovSpectrum, DoesNotDependOnTheIntervalOrOnStepControlOfTangents) {
  const VectorField field = problems::duffing(0.25, -1.0, 0.4, 1.0);
  integrate::IntegratorOptions o = tight(1e-12);
  const auto controlled = integrate::make_flow(field, o);
  o.tangent_error_control = false;
  const auto other = integrate::make_flow(field, o);
  std::vector<double> a = {1.0, 0.0};
  std::vector<double> b = a;
  std::vector<double> c = a;
  // Few intervals: chaos would tell the three apart, not the method.
  const auto first = lyapunov_spectrum(*controlled, a, {.aligning_intervals = 0, .intervals = 4}, always);
  const auto second = lyapunov_spectrum(*other, b, {.aligning_intervals = 0, .intervals = 4}, always);
  const auto halves = lyapunov_spectrum(
      *controlled, c, {.aligning_intervals = 0, .intervals = 8, .interval = 0.5 * field.period}, always);
  constexpr double times_the_condition = 1e-11;  // tolerance 1e-12, rates of order 1
  constexpr double uncontrolled = 1e-9;          // measured: steps for the state alone leave 1e-11 in the tangents
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(first.per_s[i].value, second.per_s[i].value, uncontrolled);
    EXPECT_NEAR(first.per_s[i].value, halves.per_s[i].value, times_the_condition);
  }
}

TEST(LargestExponent, IsNoNumberWhereItWasStoppedOrThereIsNoPeriod) {
  const auto flow = integrate::make_flow(problems::duffing(0.3, -1.0, 0.5, 1.2), tight(1e-8));
  std::vector<double> y = {1.0, 0.0};
  int asked = 0;
  const LargestExponent stopped =
      largest_exponent(*flow, y, {.aligning_periods = 2, .periods = 20}, {}, [&] { return ++asked < 10; });
  EXPECT_TRUE(std::isnan(stopped.per_s.value));
  const auto autonomous = integrate::make_flow(problems::lorenz(), tight(1e-8));
  std::vector<double> z = {1.0, 1.0, 20.0};
  EXPECT_THROW((void)largest_exponent(*autonomous, z, {}, {}, always), DomainError);
  EXPECT_THROW((void)find_periodic_orbit(*autonomous, z, 1), DomainError);
  EXPECT_THROW((void)largest_multiplier(PeriodicOrbit{}), DomainError);
  EXPECT_THROW((void)floquet_multipliers(PeriodicOrbit{}, PeriodicOrbit{}), DomainError);
}

TEST(LyapunovSpectrum, HistoryEndsAtTheMean) {
  const LyapunovSpectrum s =
      spectrum(problems::duffing(0.25, -1.0, 0.4, 1.0), {1.0, 0.0}, {.aligning_intervals = 5, .intervals = 64}, 1e-6);
  ASSERT_EQ(s.history(1).size(), 64U);
  constexpr double rounding = 1e-14;  // of a mean of 64 numbers of order 0.1
  EXPECT_NEAR(s.history(0).back(), s.per_s[0].value, rounding);
  EXPECT_NEAR(s.history(1).back(), s.per_s[1].value, rounding);
}

TEST(LyapunovSpectrum, RefusesWhatItCannotDo) {
  const VectorField field = problems::lorenz();
  const auto flow = integrate::make_flow(field, {});
  std::vector<double> y = {1.0, 1.0, 20.0};
  EXPECT_THROW((void)lyapunov_spectrum(*flow, y, {.exponents = 4, .interval = 1.0}, always), DomainError);
  EXPECT_THROW((void)lyapunov_spectrum(*flow, y, {}, always), DomainError);  // no period, no interval
  EXPECT_EQ(kaplan_yorke_dimension(std::array{0.1, -0.05}), 2.0);
  EXPECT_EQ(kaplan_yorke_dimension(std::array{-0.1, -0.2}), 0.0);
}

}  // namespace
}  // namespace epicyclic::analysis::lyapunov_test
