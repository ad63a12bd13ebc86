#include "studies/axis.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/require.hpp"

namespace epicyclic::studies {

void Axis::validate() const {
  require(std::isfinite(from), "from", from, "finite");
  require(std::isfinite(to) && to >= from, "to", to, "finite and >= from");
  require(points >= 1, "points", points, ">= 1");
  require(points >= 2 || from == to, "points", points, ">= 2 for a range");
  require(points == 1 || from != to, "points", points, "1 where `from` and `to` are one value");
}

double grid_value(double from, double to, double share) {
  if (share == 0.0) return from;
  if (share == 1.0) return to;
  constexpr int digits = 12;
  std::array<char, 64> text;
  const double value = (1.0 - share) * from + share * to;
  const auto written =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, digits - 1);
  double rounded = value;
  std::from_chars(text.data(), written.ptr, rounded);
  return rounded;
}

double axis_value(const Axis& axis, std::size_t point) {
  const double share = axis.points == 1 ? 0.0 : static_cast<double>(point) / static_cast<double>(axis.points - 1);
  return grid_value(axis.from, axis.to, share);
}

bool is_same_value(double a, double b) {
  constexpr double rounding = 1e-9;
  return std::abs(a - b) <= rounding * std::max(1.0, std::abs(a));
}

std::vector<double> axis_values(const Axis& axis) {
  std::vector<double> values;
  for (std::size_t k = 0; k < static_cast<std::size_t>(axis.points); ++k) values.push_back(axis_value(axis, k));
  return values;
}

}  // namespace epicyclic::studies
