// Straight lines through points.
#pragma once

#include <span>

namespace epicyclic {

/// Slope of the straight line that is nearest to the points in y (least squares, GSL).
/// @returns not a number for fewer than three points
/// @throws std::invalid_argument when x and y differ in length
[[nodiscard]] double fitted_slope(std::span<const double> x, std::span<const double> y);

}  // namespace epicyclic
