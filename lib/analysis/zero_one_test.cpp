#include "analysis/zero_one_test.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gsl/gsl_statistics_double.h>

#include "core/errors.hpp"

namespace epicyclic::analysis {

namespace {

/// K_c of a series of mean 0.
double growth_of_walk(std::span<const double> series, double c) {
  const std::size_t size = series.size();
  const std::size_t longest = size / 10;
  std::vector<double> p(size + 1, 0.0);
  std::vector<double> q(size + 1, 0.0);
  for (std::size_t j = 0; j < size; ++j) {
    const double angle = static_cast<double>(j + 1) * c;
    p[j + 1] = p[j] + series[j] * std::cos(angle);
    q[j + 1] = q[j] + series[j] * std::sin(angle);
  }
  std::vector<double> steps;
  std::vector<double> displacement;
  const std::size_t starts = size - longest;
  for (std::size_t n = 1; n <= longest; ++n) {
    // Four sums, none of which waits for another.
    std::array<double, 4> sums{};
    const auto add = [&](std::size_t j, double& sum) {
      const double dp = p[j + n] - p[j];
      const double dq = q[j + n] - q[j];
      sum += dp * dp + dq * dq;
    };
    std::size_t j = 1;
    for (; j + 3 <= starts; j += 4)
      for (std::size_t k = 0; k < 4; ++k) add(j + k, sums[k]);
    for (; j <= starts; ++j) add(j, sums[0]);
    const double sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    steps.push_back(static_cast<double>(n));
    displacement.push_back(sum / static_cast<double>(starts));
  }
  return gsl_stats_correlation(steps.data(), 1, displacement.data(), 1, steps.size());
}

}  // namespace

double zero_one_test(std::span<const double> series, double noise, int angles) {
  constexpr std::size_t least = 100;
  if (series.size() < least)
    throw DomainError("the 0-1 test of " + std::to_string(series.size()) + " points is requested, at least " +
                      std::to_string(least) + " are needed");
  if (angles < 1)
    throw DomainError("the 0-1 test with " + std::to_string(angles) + " angles is requested, must be >= 1");
  const auto [low, high] = std::minmax_element(series.begin(), series.end());
  if (*high - *low <= noise) return 0.0;
  // In parts of its range about its mean: the walk of a large constant would drown what moves.
  std::vector<double> phi(series.begin(), series.end());
  const double mean = gsl_stats_mean(phi.data(), 1, phi.size());
  for (double& x : phi) x = (x - mean) / (*high - *low);
  std::vector<double> k;
  for (int i = 0; i < angles; ++i) {
    const double fraction = std::fmod((i + 0.5) * (std::numbers::phi - 1.0), 1.0);
    k.push_back(growth_of_walk(phi, std::numbers::pi * (0.2 + 0.6 * fraction)));
  }
  std::sort(k.begin(), k.end());
  return gsl_stats_median_from_sorted_data(k.data(), 1, k.size());
}

}  // namespace epicyclic::analysis
