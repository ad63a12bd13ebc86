// Straight lines through points.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace epicyclic {

/// Slope of the straight line that is nearest to the points in y (least squares, GSL).
/// @returns not a number for fewer than three points
/// @throws std::invalid_argument when x and y differ in length
[[nodiscard]] double fitted_slope(std::span<const double> x, std::span<const double> y);

/// Slope of straight lines through several sets of points that have one slope and levels of their own (least squares):
/// each set is moved to its mean.
class PooledSlope {
 public:
  /// @throws std::invalid_argument when x and y differ in length
  void add(std::span<const double> x, std::span<const double> y);
  [[nodiscard]] std::size_t points() const { return x_.size(); }
  [[nodiscard]] double slope() const { return fitted_slope(x_, y_); }

 private:
  std::vector<double> x_, y_;
};

}  // namespace epicyclic
