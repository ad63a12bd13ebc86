// How densely the rows of a periodic table stand, as a bound for the integrator's steps.
//
//   d(phase) = c min_k h_k ,   h_k the distances of neighbouring rows in the run that holds the phase        [M-rows]
//
// Neighbouring intervals form a run while the widest is at most twice the narrowest. Steps have to end where a run
// ends, and on each row of a run of fewer than eight: there the slope changes much from row to row. A table may change
// from one row to the next. A method that evaluates it at least once in each interval of length d steps over none of
// its features.
//
// c = 1 for rows of unknown origin. Rows of a smooth function whose interpolation, of fourth order, has the known error
// e are denser than the function needs: c = (e_0 / e)^(1/4), so that every c-th row would interpolate it to
// e_0 = 1e-3 of its mean.
#pragma once

#include <span>
#include <vector>

namespace epicyclic::model {

class RowSpacing {
 public:
  /// No rows: no bound.
  RowSpacing() = default;

  /// @param phases  of the rows, within one period of 1, rising; a jump stands twice
  /// @param rows_per_feature  c, at least 1
  RowSpacing(std::span<const double> phases, double rows_per_feature);

  /// Phases in [0, 1), rising, of the rows that steps have to end on; none if all rows are one long run.
  [[nodiscard]] const std::vector<double>& stops() const { return starts_; }

  /// d [periods]; infinite without rows.
  [[nodiscard]] double at(double phase) const;

 private:
  std::vector<double> starts_;
  std::vector<double> spacings_;  ///< of the runs; one if there are no starts
};

/// c of a smooth function's rows.
/// @param error  e, relative to the mean [-]
[[nodiscard]] double rows_per_feature(double error);

}  // namespace epicyclic::model
