// Means of correlated series with confidence intervals, from the lowest frequencies of the series.
//
//   I_j = | sum_t (x_t - mean) exp(-2 pi i j t / N) |^2 / N ,   S_m = ( I_1 + ... + I_m ) / m
//   mean(x) +- max( h_q , 0.8 h_q/2 ) ,   h_m = t_2m sqrt( r_m S_m / N )                                   [A-mean]
//
// N times the variance of the mean is what I_j would be at j = 0, were the truth subtracted and not the mean; its
// nearest neighbours stand in for it. They see the ends of the series with the weight that the mean gives them. A
// contribution that a later one cancels, as in the growth of a tangent vector, widens the interval by no more than it
// should. Means of batches would count it once for each batch: for Lorenz' exponent their intervals are nearly twice as
// wide as they should be (16 batches of 31 values), and hold the truth in 100 of 100 cases.
//
// If correlations are long, the spectrum rises towards zero frequency within the frequencies of the estimate, and S is
// too small. The lower half of the frequencies then is the better estimate. S is also raised by the factor that a
// spectrum of one correlation time, S(f) = S(0) / (1 + (f / f_0)^2), has between them and the frequencies 2 q + 1 ... 6
// q with the mean power F,
//
//   r_m = 1 + x j_m^2 ,   x = ( S_m / F - 1 ) / ( j_F^2 - j_m^2 S_m / F ) ,  at most 1 ; 1 unless S_m > F    [A-rise]
//
// j_m and j_F the middles of both. In a series shorter than 12 q values r is 1.
//
// Source: Heidelberger and Welch, Comm. ACM 24 (1981) 233; with equal weights and Student's t of 2q degrees of freedom:
// Lazarus et al., J. Bus. Econ. Stat. 36 (2018) 541. The larger of two, its 0.8 and [A-rise] are this project's own.
// Student's t by GSL. Limits: correlations have to decay by e within N / 25 values (then 93 of 100 intervals of 95 %
// hold the truth, or more), and oscillations have to complete some ten cycles. No interval accounts for rare events
// that are not in the record. See tests/analysis/coverage_test.cpp.
#pragma once

#include <cstddef>
#include <span>

namespace epicyclic::analysis {

/// An estimate and the half width of its confidence interval.
struct Estimate {
  double value = 0;
  double half_width = 0;  ///< infinite for fewer than three values

  [[nodiscard]] double low() const { return value - half_width; }
  [[nodiscard]] double high() const { return value + half_width; }

  /// In another unit; factor and divisor are positive.
  friend Estimate operator*(const Estimate& e, double factor) { return {e.value * factor, e.half_width * factor}; }
  friend Estimate operator/(const Estimate& e, double divisor) { return {e.value / divisor, e.half_width / divisor}; }
};

/// Do the intervals have a point in common?
[[nodiscard]] bool overlap(const Estimate& a, const Estimate& b);

inline constexpr double default_confidence = 0.95;

/// q. Twice as many narrow the interval by 6 % and reach frequencies that do not represent the mean.
inline constexpr int default_frequencies = 4;

/// Mean of the series. In a series too short for q frequencies, all that there are: (N - 1) / 2.
/// @throws DomainError for an empty series, fewer than 1 frequency, or a confidence outside (0, 1)
[[nodiscard]] Estimate series_mean(std::span<const double> series, int frequencies = default_frequencies,
                                   double confidence = default_confidence);

/// Standard deviation of the series' values about their mean, from the mean of the squared deviations.
[[nodiscard]] Estimate series_deviation(std::span<const double> series, int frequencies = default_frequencies,
                                        double confidence = default_confidence);

/// A value and its interval at 95 %, which need not lie evenly about it.
struct Interval {
  double value = 0;
  double low = 0;
  double high = 0;
};

/// The part of n independent trials that succeed, with Wilson's interval (J. Am. Stat. Assoc. 22 (1927) 209):
/// ( p + z^2 / 2n +- z sqrt( p (1 - p) / n + z^2 / 4n^2 ) ) / ( 1 + z^2 / n ) .
/// @returns no numbers for no trials
[[nodiscard]] Interval fraction(std::size_t successes, std::size_t n);

/// Pearson's correlation, by GSL; 0 for fewer than 2 pairs, or where one side does not vary.
[[nodiscard]] double correlation(std::span<const double> x, std::span<const double> y);

/// Spearman's rank correlation, by GSL, with Fisher's interval tanh( artanh(r) +- z sqrt(1.06 / (n - 3)) ) (Fieller,
/// Hartley and Pearson, Biometrika 44 (1957) 470).
/// @returns no numbers for fewer than 4 pairs, or where one side does not vary
[[nodiscard]] Interval rank_correlation(std::span<const double> x, std::span<const double> y);

}  // namespace epicyclic::analysis
