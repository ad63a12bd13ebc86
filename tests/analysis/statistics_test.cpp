#include "analysis/statistics.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace epicyclic::analysis {
namespace {

TEST(BatchMean, OfAKnownSeriesIsTheTextbookInterval) {
  // Four batches of two with means 1, 2, 3, 4: mean 2.5, s = 1.2909944487, t_3(0.975) = 3.1824463053.
  const std::vector<double> series = {0.0, 2.0, 1.0, 3.0, 2.0, 4.0, 3.0, 5.0};
  const Estimate e = batch_mean(series, 4);
  constexpr double digits = 1e-9;
  EXPECT_DOUBLE_EQ(e.value, 2.5);
  EXPECT_NEAR(e.half_width, 3.1824463053 * 1.2909944487 / 2.0, digits);
}

TEST(BatchMean, IntervalsHoldTheTruthAsOftenAsTheySay) {
  // A first-order autoregressive series, correlated over some ten values; batches of 125.
  std::mt19937_64 random(7);
  std::normal_distribution<double> step;
  int held = 0;
  int held_deviation = 0;
  constexpr int runs = 1000;
  constexpr double memory = 0.8;
  for (int r = 0; r < runs; ++r) {
    std::vector<double> series(2000);
    double x = step(random) / std::sqrt(1.0 - memory * memory);
    for (double& value : series) {
      x = memory * x + step(random);
      value = x;
    }
    const Estimate mean = batch_mean(series);
    held += mean.low() <= 0.0 && mean.high() >= 0.0 ? 1 : 0;
    const Estimate deviation = batch_deviation(series);
    const double exact = 1.0 / std::sqrt(1.0 - memory * memory);
    held_deviation += deviation.low() <= exact && deviation.high() >= exact ? 1 : 0;
  }
  // 95 % with the scatter of 1000 runs (0.7 %); batches that remember a little of each other cost a percent or two.
  EXPECT_NEAR(held / static_cast<double>(runs), 0.95, 0.03);
  EXPECT_NEAR(held_deviation / static_cast<double>(runs), 0.95, 0.04);
}

TEST(BatchMean, SmallAndWrongSeries) {
  EXPECT_THROW((void)batch_mean({}), DomainError);
  const std::vector<double> one = {3.0};
  EXPECT_EQ(batch_mean(one).value, 3.0);
  EXPECT_TRUE(std::isinf(batch_mean(one).half_width));
  EXPECT_THROW((void)batch_mean(one, 0), DomainError);
  EXPECT_THROW((void)batch_mean(one, 4, 1.0), DomainError);
  EXPECT_TRUE(overlap({1.0, 0.5}, {2.0, 0.5}));
  EXPECT_FALSE(overlap({1.0, 0.4}, {2.0, 0.5}));
}

}  // namespace
}  // namespace epicyclic::analysis
