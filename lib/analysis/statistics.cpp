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

/// Frequencies 2 q + 1 to 6 q show how the spectrum rises towards those of the estimate.
constexpr std::size_t steep = 6;
constexpr std::size_t steep_from = 2;

/// Factor of the half width from the lower half of the frequencies. With it, the larger of both half widths holds at
/// its nominal rate for uncorrelated values.
constexpr double of_fewer = 0.8;

/// (I_first + ... + I_last) / their number.
double mean_power(std::span<const double> power, std::size_t first, std::size_t last) {
  double sum = 0.0;
  for (std::size_t j = first; j <= last; ++j) sum += power[j];
  return sum / static_cast<double>(last - first + 1);
}

/// S(0) over the mean power of the first frequencies, by [A-rise].
/// @param of  number of frequencies that stand for S(0)
/// @param q   number of frequencies of the estimate: 2 q + 1 ... 6 q are compared with these
double rise_to_zero(std::span<const double> power, std::size_t of, std::size_t q) {
  if (power.size() <= steep * q) return 1.0;
  const auto centre = [](std::size_t first, std::size_t last) { return 0.5 * static_cast<double>(first + last); };
  const double near = centre(1, of);
  const double far = centre(steep_from * q + 1, steep * q);
  const double ratio = mean_power(power, 1, of) / mean_power(power, steep_from * q + 1, steep * q);
  if (!(ratio > 1.0)) return 1.0;
  const double divisor = far * far - ratio * near * near;
  // A record that is shorter than 2 pi correlation times does not say how much longer they are.
  const double square = divisor > 0.0 ? std::min((ratio - 1.0) / divisor, 1.0) : 1.0;
  return 1.0 + near * near * square;
}

}  // namespace

bool overlap(const Estimate& a, const Estimate& b) { return a.low() <= b.high() && b.low() <= a.high(); }

Estimate series_mean(std::span<const double> series, int frequencies, double confidence) {
  if (series.empty()) throw DomainError("an empty series has no mean");
  if (frequencies < 1) throw DomainError("number of sine pairs = " + std::to_string(frequencies) + ", must be >= 1");
  if (!(confidence > 0.0 && confidence < 1.0))
    throw DomainError("confidence = " + std::to_string(confidence) + ", must be in (0, 1)");
  const std::size_t n = series.size();
  Estimate e{gsl_stats_mean(series.data(), 1, n), std::numeric_limits<double>::infinity()};
  const std::size_t all = (n - 1) / 2;
  const std::size_t q = std::min(static_cast<std::size_t>(frequencies), all);
  if (q == 0) return e;
  std::vector<double> power = {0.0};
  const std::size_t needed = steep * q <= all ? steep * q : q;
  for (std::size_t j = 1; j <= needed; ++j) power.push_back(periodogram(series, e.value, j));
  const std::size_t slow = (q + 1) / 2;
  const double tail = 0.5 * (1.0 + confidence);
  const auto half_width = [&](std::size_t of) {
    const double t = gsl_cdf_tdist_Pinv(tail, 2.0 * static_cast<double>(of));
    return t * std::sqrt(mean_power(power, 1, of) * rise_to_zero(power, of, q) / static_cast<double>(n));
  };
  e.half_width = std::max(half_width(q), of_fewer * half_width(slow));
  return e;
}

Estimate series_deviation(std::span<const double> series, int frequencies, double confidence) {
  const double mean = series_mean(series, frequencies, confidence).value;
  std::vector<double> squares;
  for (const double x : series) squares.push_back((x - mean) * (x - mean));
  const Estimate variance = series_mean(squares, frequencies, confidence);
  const double deviation = std::sqrt(variance.value);
  return {deviation, deviation > 0.0 ? variance.half_width / (2.0 * deviation) : 0.0};
}

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double two_sided = 1.959963984540054;  // quantile of the normal distribution at 97.5 %

bool varies(std::span<const double> values) {
  return std::ranges::any_of(values, [&](double v) { return v != values.front(); });
}

}  // namespace

Interval fraction(std::size_t successes, std::size_t n) {
  if (n == 0) return {none, none, none};
  const auto trials = static_cast<double>(n);
  const double p = static_cast<double>(successes) / trials;
  const double z2 = two_sided * two_sided;
  const double middle = p + 0.5 * z2 / trials;
  const double half = two_sided * std::sqrt(p * (1.0 - p) / trials + 0.25 * z2 / (trials * trials));
  const double divisor = 1.0 + z2 / trials;
  // At both ends exactly, whatever rounding leaves.
  return {p, successes == 0 ? 0.0 : (middle - half) / divisor, successes == n ? 1.0 : (middle + half) / divisor};
}

double correlation(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size()) throw DomainError("correlation of series of different lengths");
  if (x.size() < 2 || !varies(x) || !varies(y)) return 0.0;
  return gsl_stats_correlation(x.data(), 1, y.data(), 1, x.size());
}

Interval rank_correlation(std::span<const double> x, std::span<const double> y) {
  constexpr std::size_t fewest = 4;
  if (x.size() != y.size()) throw DomainError("ranks of series of different lengths");
  if (x.size() < fewest || !varies(x) || !varies(y)) return {none, none, none};
  std::vector<double> work(2 * x.size());
  const double r = gsl_stats_spearman(x.data(), 1, y.data(), 1, x.size(), work.data());
  constexpr double variance = 1.06;  // of ranks, beside that of a normal distribution
  const auto n = static_cast<double>(x.size());
  const double half = two_sided * std::sqrt(variance / (n - 3.0));
  // Ranks have no correlation between that of two neighbours exchanged, 1 - 12 / (n^3 - n), and 1: one of 1 may be any
  // that is nearer to it than to the other. Taken as 1 itself it would leave no interval, however few there are.
  const double most = 1.0 - 6.0 / (n * n * n - n);
  const double z = std::atanh(std::clamp(r, -most, most));
  return {r, std::min(r, std::tanh(z - half)), std::max(r, std::tanh(z + half))};
}

}  // namespace epicyclic::analysis
