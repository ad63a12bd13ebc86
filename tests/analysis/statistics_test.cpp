#include "analysis/statistics.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace epicyclic::analysis {
namespace {

TEST(SeriesMean, OfAKnownSeriesIsTheTextbookInterval) {
  // Four values and one wave, the one of period 4: I_1 = ((1 - 4)^2 + (7 - 2)^2) / 4 = 8.5, t_2(0.975) = 4.3026527299.
  const std::vector<double> series = {1.0, 7.0, 4.0, 2.0};
  const Estimate e = series_mean(series, 1);
  constexpr double digits = 1e-9;
  EXPECT_DOUBLE_EQ(e.value, 3.5);
  EXPECT_NEAR(e.half_width, 4.3026527299 * std::sqrt(8.5 / 4.0), digits);
  EXPECT_EQ(series_mean(series, 7).half_width, e.half_width);  // there is no second wave
}

TEST(SeriesMean, WhatIsTakenBackDoesNotWidenIt) {
  // Differences u_t+1 - u_t of noise: of their sum only the two ends are left, and the interval shrinks like 1 / N.
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise;
  std::vector<double> series(4000);
  double u = noise(random);
  for (double& x : series) {
    const double next = noise(random);
    x = next - u;
    u = next;
  }
  // sqrt(2) / N is the deviation of the mean; sqrt(2 / N) would be the one of independent values, 63 times as much.
  EXPECT_LT(series_mean(series).half_width, 10.0 * std::numbers::sqrt2 / 4000.0);
}

TEST(SeriesMean, OfAnOscillationHoldsItsMean) {
  // All phases of one that never repeats, of a slow one that comes round 12 times, and of period 2: deterministic, so
  // that not 95 % but all intervals hold. In whole periods the mean is exact and nothing is left but rounding.
  for (const double frequency : {2.399963, 2.0 * std::numbers::pi * 12.3 / 301.0, std::numbers::pi}) {
    for (int k = 0; k < 100; ++k) {
      std::vector<double> series(301);
      for (std::size_t t = 0; t < series.size(); ++t)
        series[t] = std::cos(frequency * static_cast<double>(t) + 0.1 * k);
      const Estimate e = series_mean(series);
      EXPECT_LE(std::abs(e.value), e.half_width) << frequency << ' ' << k;
      EXPECT_LT(e.half_width, 0.1) << frequency << ' ' << k;
    }
  }
}

TEST(SeriesMean, OfAConstantIsItself) {
  const Estimate e = series_mean(std::vector<double>(100, 0.25));
  EXPECT_EQ(e.value, 0.25);
  EXPECT_EQ(e.half_width, 0.0);
}

TEST(SeriesDeviation, IntervalsHoldTheTruthAsOftenAsTheySay) {
  // A first-order autoregressive series, correlated over some ten values.
  std::mt19937_64 random(7);
  std::normal_distribution<double> step;
  int held = 0;
  constexpr int runs = 1000;
  constexpr double memory = 0.8;
  const double exact = 1.0 / std::sqrt(1.0 - memory * memory);
  for (int r = 0; r < runs; ++r) {
    std::vector<double> series(2000);
    double x = exact * step(random);
    for (double& value : series) value = x = memory * x + step(random);
    const Estimate deviation = series_deviation(series);
    held += deviation.low() <= exact && deviation.high() >= exact ? 1 : 0;
  }
  // 95 % of 1000 runs scatter by 0.7 %.
  constexpr double three_times_the_scatter = 0.021;
  EXPECT_NEAR(held / static_cast<double>(runs), 0.95, three_times_the_scatter);
}

TEST(SeriesMean, SmallAndWrongSeries) {
  EXPECT_THROW((void)series_mean({}), DomainError);
  const std::vector<double> one = {3.0};
  EXPECT_EQ(series_mean(one).value, 3.0);
  EXPECT_TRUE(std::isinf(series_mean(one).half_width));
  EXPECT_TRUE(std::isinf(series_mean(std::vector<double>{3.0, 4.0}).half_width));
  EXPECT_FALSE(std::isinf(series_mean(std::vector<double>{3.0, 4.0, 6.0}).half_width));
  EXPECT_THROW((void)series_mean(one, 0), DomainError);
  EXPECT_THROW((void)series_mean(one, 4, 1.0), DomainError);
  EXPECT_TRUE(overlap({1.0, 0.5}, {2.0, 0.5}));
  EXPECT_FALSE(overlap({1.0, 0.4}, {2.0, 0.5}));
}

}  // namespace
}  // namespace epicyclic::analysis
