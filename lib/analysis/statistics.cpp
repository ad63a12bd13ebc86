#include "analysis/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include "core/errors.hpp"

namespace epicyclic::analysis {

bool overlap(const Estimate& a, const Estimate& b) { return a.low() <= b.high() && b.low() <= a.high(); }

Estimate batch_mean(std::span<const double> series, int batches, double confidence) {
  if (series.empty()) throw DomainError("the mean of an empty series is asked for");
  if (batches < 1) throw DomainError("batches = " + std::to_string(batches) + ", must be >= 1");
  if (!(confidence > 0.0 && confidence < 1.0))
    throw DomainError("confidence = " + std::to_string(confidence) + ", must be in (0, 1)");
  const std::size_t count = std::min(static_cast<std::size_t>(batches), series.size());
  const std::size_t length = series.size() / count;
  const std::size_t skipped = series.size() - count * length;
  std::vector<double> means;
  for (std::size_t b = 0; b < count; ++b)
    means.push_back(gsl_stats_mean(series.data() + skipped + b * length, 1, length));
  Estimate e{gsl_stats_mean(means.data(), 1, count), std::numeric_limits<double>::infinity()};
  if (count < 2) return e;
  const double t = gsl_cdf_tdist_Pinv(0.5 * (1.0 + confidence), static_cast<double>(count - 1));
  e.half_width = t * gsl_stats_sd(means.data(), 1, count) / std::sqrt(static_cast<double>(count));
  return e;
}

Estimate batch_deviation(std::span<const double> series, int batches, double confidence) {
  const double mean = batch_mean(series, batches, confidence).value;
  std::vector<double> squares;
  for (const double x : series) squares.push_back((x - mean) * (x - mean));
  const Estimate variance = batch_mean(squares, batches, confidence);
  const double deviation = std::sqrt(variance.value);
  return {deviation, deviation > 0.0 ? variance.half_width / (2.0 * deviation) : 0.0};
}

}  // namespace epicyclic::analysis
