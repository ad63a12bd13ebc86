// A printed bifurcation diagram as its reader sees it: dots of ink on an axis [theory/published_results.md, section 7].
//
// The axis of a diagram spans all its Poincare points; its length is R. At one value of the parameter, neighbours among
// the sorted points that are nearer than a dot are one:
//
//   period n    n clusters, separated by gaps > d R, each at most h R tall, n <= n_most          [P-dots]
//   a cloud     anything else: as the diagram shows it, chaotic, quasiperiodic and aperiodic alike
//
// How much a column of dots lacks of a regime leads a search. With the column split at its n - 1 largest gaps, h_n is
// the tallest part over h R, g_n the least of these gaps over d R, and g_(n+1) the largest gap that is left:
//
//   period n    max( x(h_n, 6), 1 - g_n, x(g_(n+1), 15) ) , no term below 0 ,  x(r, w) = (r - 1) / (r - 1 + w)
//   [P-spread] a cloud     1/2 (1 - h_n) of the period n that it is + 1/2 (1 - R_column / (0.2 R)) not period 1    1 -
//   max(h_1, g_2)
//
// The lack is 0 exactly where the column has the regime.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace epicyclic::claims {

/// The ink of a diagram.
struct PrintedDots {
  double dot = 0.006;                   ///< d: 0.5 mm on an axis of 80 mm
  double height = 0.015;                ///< h: of a cluster that is still one dot to the eye
  int period_max = 8;                   ///< n_most: clusters that a reader counts
  std::vector<double> other_dots = {};  ///< sizes with which a scorecard compares its verdicts
};

/// Length of the axis of a diagram of these points [b_c]. At least ten recurrence tolerances, so that what recurs is
/// one dot on any axis.
[[nodiscard]] double axis_length(double low, double high, double recurrence_tolerance);

/// The dots at one value of the parameter.
class DotColumn {
 public:
  /// @param sorted  Poincare points [b_c], rising, at least one
  /// @param axis    its length [b_c]
  DotColumn(std::span<const double> sorted, double axis, const PrintedDots& ink);

  /// n of "period n"; 0 for a cloud.
  [[nodiscard]] int period() const;

  /// [P-spread]
  /// @param word  of is_regime_word()
  /// @returns nothing for "not period 2" and the like, and for periods that no reader counts
  [[nodiscard]] std::optional<double> lacks(std::string_view word) const;

 private:
  std::vector<double> heights_;  ///< h_n, n = 1 ... n_most
  std::vector<double> gaps_;     ///< g_n, n = 1 ... n_most + 1; the first is infinite
  double extent_ = 0;            ///< of the whole column, in parts of the axis

  [[nodiscard]] double lacks_of_period(int n) const;
  [[nodiscard]] double lacks_of_a_cloud() const;
};

}  // namespace epicyclic::claims
