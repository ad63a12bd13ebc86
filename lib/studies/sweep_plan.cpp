#include "studies/sweep_plan.hpp"

namespace epicyclic::studies {

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
  const std::size_t line = chain % grid_.lines();
  const std::size_t part = chain / grid_.lines();
  const std::size_t first = part * columns / grid_.chains_per_line;
  const std::size_t next = (part + 1) * columns / grid_.chains_per_line;
  return {line * columns + first, next - first};
}

SweepPlan plan_sweep(const SweepOptions& options) {
  options.validate();
  PlanGrid grid;
  grid.first = options.axis;
  grid.directions = options.directions;
  const bool cold = options.start == Start::cold;
  grid.chains_per_line = static_cast<std::size_t>(cold ? options.axis.points : segments_of(options));
  if (!cold && grid.chains_per_line > 1) grid.coarse_periods = options.coarse_periods;
  return SweepPlan(grid);
}

SweepPlan plan_map(const MapOptions& options) {
  options.validate();
  const Plane& plane = options.plane;
  const bool carried = options.start == Start::continued;
  return SweepPlan(
      {plane.first, plane.second, options.directions, carried ? 1 : static_cast<std::size_t>(plane.first.points)});
}

SweepPlan plan_basins(const BasinsOptions& options) {
  options.validate();
  const Plane& plane = options.plane;
  return SweepPlan({plane.first, plane.second, {Direction::up}, static_cast<std::size_t>(plane.first.points)});
}

}  // namespace epicyclic::studies
