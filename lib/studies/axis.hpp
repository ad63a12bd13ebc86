// A parameter, or a component of the state, and its values on an even grid.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace epicyclic::studies {

struct Axis {
  std::string name;  ///< of a sweep parameter, a JSON pointer to a number of the input, or a component of the state
  double from = 0;
  double to = 1;
  int points = 50;

  /// @throws InputError for ends that are not finite or fall, for no points, and for one point on a range with two ends
  void validate() const;
};

/// The value at a fraction of the interval. Both ends are exactly as given. Values between them are rounded to 12
/// digits, so that 1.1 is 1.1, and a value typed from a table is the computed value.
[[nodiscard]] double grid_value(double from, double to, double share);

/// The value of an axis at one of its points; as grid_value().
[[nodiscard]] double axis_value(const Axis& axis, std::size_t point);

/// Are values of two grids the same but for their rounding?
[[nodiscard]] bool is_same_value(double a, double b);

/// Is a value above a bound, or the bound itself but for rounding?
[[nodiscard]] inline bool is_at_least(double value, double bound) {
  return value >= bound || is_same_value(value, bound);
}
[[nodiscard]] inline bool is_at_most(double value, double bound) {
  return value <= bound || is_same_value(value, bound);
}

/// All values of an axis.
[[nodiscard]] std::vector<double> axis_values(const Axis& axis);

}  // namespace epicyclic::studies
