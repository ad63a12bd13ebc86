// Largest Lyapunov exponent of a periodically forced flow, from one tangent vector.
//
//   g_k = log | v(s_k + T) | / | v(s_k) | ,   v rescaled to length 1 after each period T of the forcing
//   lambda = mean(g) / T  per unit of s, with the interval of [A-mean]                                   [A-lyap]
//
// Source: Benettin et al., Meccanica 15 (1980) 9. Limits: if the two largest exponents are equal or nearly so, the
// vector does not converge to a direction, and the interval is wide. An interval is no proof beyond the time that it
// was measured over.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "analysis/statistics.hpp"
#include "integrate/flow.hpp"

namespace epicyclic::analysis {

struct LyapunovOptions {
  int aligning_periods = 50;  ///< before growth is counted, for the vector to rotate to the fastest direction
  int periods = 500;          ///< counted

  /// Projects a vector onto a subspace that the linearised flow leaves invariant, such as the directions that break a
  /// symmetry of the trajectory. The exponent is then the largest of that subspace. The projection removes rounding
  /// that leads out of it.
  std::function<void(std::span<double> v)> project{};

  /// @throws InputError for negative aligning periods, or no period counted
  void validate() const;
};

struct LargestExponent {
  integrate::Evolution evolution;  ///< how it ended; growth holds the periods until then
  Estimate per_s;                  ///< lambda [1 / unit of s]; not a number if an integration failed
  std::vector<double> growth;      ///< g_k, one per counted period
  std::vector<double> direction;   ///< v at the end, of length 1
};

/// @param state     initial state, replaced by the last state
/// @param observer  sees the state after each counted period; may be empty
/// @param go_on     called before each period; false ends the computation
/// @throws InputError for options out of range
[[nodiscard]] LargestExponent largest_exponent(integrate::Flow& flow, std::span<double> state,
                                               const LyapunovOptions& options, const integrate::Observer& observer,
                                               const std::function<bool()>& go_on);

/// Log growth of the tangent vector over the last half of a record g_k.
[[nodiscard]] double late_growth(std::span<const double> growth);

/// A growth within these limits counts as none. Beside a torus vectors separate linearly in time, by log 2 in the last
/// half, and the periods of the torus need some tolerance. An exponent of 0.001 per unit of time exceeds the limit in
/// 2000 units.
inline constexpr double neutral_growth = 2.0;

/// m exponents from m tangent vectors, orthonormalised after each interval T:
///
///   V(s_k + T) = Q_k R_k ,   V <- Q_k ,   g_ik = log | R_ii |
///   lambda_i = mean(g_i) / T  per unit of s ,   sum over all = mean divergence of the field [A-spectrum]
///
/// Within an interval V is orthonormalised as often as needed: R_ii of a contracting direction is what is left after
/// the faster ones are subtracted, so an error e of V leaves e max_j |R_jj| / |R_ii| of it. Parts of the interval are
/// halved until that ratio is at most 1e6 in each of them, and g_ik is the sum over the parts.
///
/// Source: Benettin et al., Meccanica 15 (1980) 9 and 21; Kaplan and Yorke, LNM 730 (1979) 204. QR by Householder
/// reflections (Eigen). Limits: contractions by more than that within a 65536th of an interval.
struct SpectrumOptions {
  std::size_t exponents = 0;    ///< m; 0 for all
  int aligning_intervals = 50;  ///< before growth is counted
  int intervals = 500;          ///< counted
  double interval = 0;          ///< T [units of s]; 0 for the field's period

  /// Sees the state at the beginning of each counted interval, and its s; may be empty.
  std::function<void(double s, std::span<const double> y)> begins{};

  /// @throws InputError for negative aligning intervals or length, or no interval counted
  void validate() const;
};

struct LyapunovSpectrum {
  integrate::Evolution evolution;
  std::size_t exponents = 0;
  double interval = 0;
  std::vector<double> growth;   ///< g_ik, m for each counted interval
  std::vector<Estimate> per_s;  ///< lambda_i [1 / unit of s], falling up to their intervals
  Estimate sum;                 ///< of the m exponents

  /// Running mean of exponent i over the counted intervals, for its convergence.
  [[nodiscard]] std::vector<double> history(std::size_t i) const;
};

/// @param state  initial state, replaced by the last state
/// @throws DomainError if more exponents than dimensions are requested, or neither options nor field have an interval;
/// InputError for options out of range
[[nodiscard]] LyapunovSpectrum lyapunov_spectrum(integrate::Flow& flow, std::span<double> state,
                                                 const SpectrumOptions& options, const std::function<bool()>& go_on);

/// Kaplan and Yorke's dimension, D = j + (lambda_1 + ... + lambda_j) / |lambda_j+1| with the largest j whose sum is not
/// negative; the number of exponents if their sum is not negative.
/// @param exponents  all of them, falling
[[nodiscard]] double kaplan_yorke_dimension(std::span<const double> exponents);

/// The field with one more component z, dz/ds = tr dg/dy: (z(s_1) - z(s_0)) / (s_1 - s_0) is the mean divergence along
/// the trajectory, which equals the sum of the exponents. Without tangents.
[[nodiscard]] VectorField with_divergence(const VectorField& field);

}  // namespace epicyclic::analysis
