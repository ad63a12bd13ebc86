// Means of correlated series with confidence intervals, by batches.
//
//   B batches of equal length, batch means m_b:   mean(m) +- t_{B-1} std(m) / sqrt(B)                        [A-batch]
//
// Source: batch means as in L. W. Schruben, Oper. Res. 30 (1982) 569; Student's t by GSL. Limits: batches have to be
// longer than the series remembers; the beginning of the series that does not fill a batch is left out.
#pragma once

#include <span>

namespace epicyclic::analysis {

/// An estimate and the half width of its confidence interval.
struct Estimate {
  double value = 0;
  double half_width = 0;  ///< infinite for fewer than two batches

  [[nodiscard]] double low() const { return value - half_width; }
  [[nodiscard]] double high() const { return value + half_width; }
};

/// Do the intervals have a point in common?
[[nodiscard]] bool overlap(const Estimate& a, const Estimate& b);

inline constexpr int default_batches = 16;
inline constexpr double default_confidence = 0.95;

/// Mean of the series.
/// @throws DomainError for an empty series, fewer than 1 batch, or a confidence outside (0, 1)
[[nodiscard]] Estimate batch_mean(std::span<const double> series, int batches = default_batches,
                                  double confidence = default_confidence);

/// Standard deviation of the series' values about their mean, from the batch means of the squared deviations.
[[nodiscard]] Estimate batch_deviation(std::span<const double> series, int batches = default_batches,
                                       double confidence = default_confidence);

}  // namespace epicyclic::analysis
