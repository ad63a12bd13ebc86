#include "studies/sweep_plan.hpp"

#include <array>
#include <charconv>

namespace epicyclic::studies {

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

GridPoint PlanPoints::operator[](std::size_t index) const {
  const std::size_t columns = grid_.columns();
  const std::size_t line = index / columns;
  const std::size_t step = index % columns;
  const Direction direction = grid_.directions.at(line / grid_.rows());
  const std::size_t column = direction == Direction::up ? step : columns - 1 - step;
  return {index, direction, axis_value(grid_.first, column), axis_value(grid_.second, line % grid_.rows())};
}

Chain PlanChains::operator[](std::size_t chain) const {
  const std::size_t columns = grid_.columns();
  const std::size_t line = chain / grid_.chains_per_line;
  const std::size_t part = chain % grid_.chains_per_line;
  const std::size_t first = part * columns / grid_.chains_per_line;
  const std::size_t next = (part + 1) * columns / grid_.chains_per_line;
  return {line * columns + first, next - first};
}

SweepPlan plan_sweep(const SweepOptions& options) {
  PlanGrid grid;
  grid.first = {options.parameter, options.from, options.to, options.points};
  grid.directions = options.directions;
  grid.chains_per_line = static_cast<std::size_t>(options.start == Start::cold ? options.points : options.segments);
  return SweepPlan(grid);
}

}  // namespace epicyclic::studies
