#include "analysis/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include "core/errors.hpp"

namespace epicyclic::analysis {

namespace {

/// I_j of [A-mean].
double periodogram(std::span<const double> series, double mean, std::size_t j) {
  const std::size_t n = series.size();
  double re = 0.0;
  double im = 0.0;
  for (std::size_t t = 0; t < n; ++t) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(j * t % n) / static_cast<double>(n);
    re += (series[t] - mean) * std::cos(angle);
    im += (series[t] - mean) * std::sin(angle);
  }
  return (re * re + im * im) / static_cast<double>(n);
}

}  // namespace

bool overlap(const Estimate& a, const Estimate& b) { return a.low() <= b.high() && b.low() <= a.high(); }

Estimate series_mean(std::span<const double> series, int waves, double confidence) {
  if (series.empty()) throw DomainError("the mean of an empty series is asked for");
  if (waves < 1) throw DomainError("waves = " + std::to_string(waves) + ", must be >= 1");
  if (!(confidence > 0.0 && confidence < 1.0))
    throw DomainError("confidence = " + std::to_string(confidence) + ", must be in (0, 1)");
  const std::size_t n = series.size();
  Estimate e{gsl_stats_mean(series.data(), 1, n), std::numeric_limits<double>::infinity()};
  const std::size_t q = std::min(static_cast<std::size_t>(waves), (n - 1) / 2);
  if (q == 0) return e;
  double sum = 0.0;
  for (std::size_t j = 1; j <= q; ++j) sum += periodogram(series, e.value, j);
  const double t = gsl_cdf_tdist_Pinv(0.5 * (1.0 + confidence), 2.0 * static_cast<double>(q));
  e.half_width = t * std::sqrt(sum / static_cast<double>(q * n));
  return e;
}

Estimate series_deviation(std::span<const double> series, int waves, double confidence) {
  const double mean = series_mean(series, waves, confidence).value;
  std::vector<double> squares;
  for (const double x : series) squares.push_back((x - mean) * (x - mean));
  const Estimate variance = series_mean(squares, waves, confidence);
  const double deviation = std::sqrt(variance.value);
  return {deviation, deviation > 0.0 ? variance.half_width / (2.0 * deviation) : 0.0};
}

}  // namespace epicyclic::analysis
