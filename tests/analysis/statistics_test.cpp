#include "analysis/statistics.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace epicyclic::analysis::statistics_test {
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

// Wilson's score interval of 8 of 10 without correction for continuity, to the digits of Newcombe, Stat. Med. 17 (1998)
// 857, method 3: 0.4902 to 0.9433; of 0 of 20, 0 to 0.1611 (his table I).
TEST(Fraction, HasWilsonsInterval) {
  constexpr double printed = 5e-5;
  const Interval most = fraction(8, 10);
  EXPECT_EQ(most.value, 0.8);
  EXPECT_NEAR(most.low, 0.4902, printed);
  EXPECT_NEAR(most.high, 0.9433, printed);
  EXPECT_EQ(fraction(0, 20).low, 0.0);
  EXPECT_NEAR(fraction(0, 20).high, 0.1611, printed);
  EXPECT_EQ(fraction(20, 20).high, 1.0);
  EXPECT_TRUE(std::isnan(fraction(0, 0).value));
}

TEST(RankCorrelation, IsOfRanksAlone) {
  const std::vector<double> x = {1.0, 2.0, 3.0, 4.0, 5.0};
  // 1 - 6 sum d^2 / (n (n^2 - 1)) with d^2 of 1, 1, 1, 1, 0.
  const std::vector<double> y = {-2.0, -30.0, 1e6, 7.0, 1e9};
  const Interval r = rank_correlation(x, y);
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(r.value, 0.8, rounding);
  constexpr double normal = 1.959963984540054;
  const double half = normal * std::sqrt(1.06 / 2.0);
  EXPECT_NEAR(r.low, std::tanh(std::atanh(0.8) - half), rounding);
  EXPECT_NEAR(r.high, std::tanh(std::atanh(0.8) + half), rounding);
  EXPECT_NEAR(rank_correlation(x, x).value, 1.0, rounding);
  // The same order by chance: of four 1 in 24, of eight 1 in 40320.
  const std::vector<double> four = {1, 2, 3, 4};
  const std::vector<double> eight = {1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_LT(rank_correlation(four, four).low, 0.0);
  EXPECT_GE(rank_correlation(four, four).high, rank_correlation(four, four).value);
  EXPECT_GT(rank_correlation(eight, eight).low, 0.9);
  EXPECT_TRUE(std::isnan(rank_correlation(x, std::vector<double>(5, 1.0)).value));
  EXPECT_TRUE(std::isnan(rank_correlation(std::vector<double>{1, 2, 3}, std::vector<double>{1, 2, 3}).value));
  EXPECT_THROW((void)rank_correlation(x, std::vector<double>{1.0}), DomainError);
}

}  // namespace
}  // namespace epicyclic::analysis::statistics_test
