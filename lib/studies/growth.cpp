#include "studies/growth.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace epicyclic::studies {

namespace {

using Steps = std::vector<std::optional<std::size_t>>;

/// For each of some values the place of the same one among others, which ascend.
Steps places_in(const Axis& others, const Axis& values) {
  const std::vector<double> all = axis_values(others);
  Steps places;
  for (const double value : axis_values(values)) {
    const auto found = std::ranges::lower_bound(all, value);
    places.push_back(found != all.end() && *found == value
                         ? std::optional(static_cast<std::size_t>(found - all.begin()))
                         : std::nullopt);
  }
  return places;
}

/// The first point of the chain that contains a step, along a line.
std::size_t chain_begin(const PlanGrid& grid, std::size_t step) {
  const std::size_t n = grid.columns();
  std::size_t part = step * grid.chains_per_line / n;
  while ((part + 1) * n / grid.chains_per_line <= step) ++part;
  while (part * n / grid.chains_per_line > step) --part;
  return part * n / grid.chains_per_line;
}

/// The steps of one line that are steps of another one; empty: none.
Steps same_steps(const PlanGrid& there, const PlanGrid& here, Direction direction, const Steps& columns) {
  const std::size_t n = here.columns();
  const std::size_t m = there.columns();
  // In the order of the computation.
  Steps steps(n);
  for (std::size_t step = 0; step < n; ++step) {
    const auto column = columns[direction == Direction::up ? step : n - 1 - step];
    if (column) steps[step] = direction == Direction::up ? *column : m - 1 - *column;
  }
  std::size_t alike = 0;  // so many first steps are the same
  while (alike < n && steps[alike] == alike) ++alike;
  const bool from_default = here.coarse_periods == 0 && there.coarse_periods == 0;
  Steps same(n);
  for (std::size_t step = 0; step < n; ++step) {
    if (!steps[step]) continue;
    const std::size_t other = *steps[step];
    if (chain_begin(here, step) != step) {
      if (same[step - 1] && *same[step - 1] + 1 == other && chain_begin(there, other) != other) same[step] = other;
      continue;
    }
    if (chain_begin(there, other) != other) continue;
    const bool first = step == 0 && other == 0;
    const bool by_same_pass = here.coarse_periods == there.coarse_periods && step < alike;
    if (from_default || first || by_same_pass) same[step] = other;
  }
  return same;
}

}  // namespace

std::size_t points_in_common(const SweepPlan& there, const SweepPlan& here,
                             const std::function<void(std::size_t point_there, std::size_t point_here)>& same) {
  const PlanGrid& from = there.grid;
  const PlanGrid& to = here.grid;
  const Steps columns = places_in(from.first, to.first);
  const Steps rows =
      to.second.name.empty() && from.second.name.empty() ? Steps{std::size_t{0}} : places_in(from.second, to.second);
  std::size_t count = 0;
  for (std::size_t d = 0; d < to.directions.size(); ++d) {
    const auto direction = std::ranges::find(from.directions, to.directions[d]);
    if (direction == from.directions.end()) continue;
    const auto other = static_cast<std::size_t>(direction - from.directions.begin());
    const Steps steps = same_steps(from, to, to.directions[d], columns);
    for (std::size_t row = 0; row < to.rows(); ++row) {
      if (!rows[row]) continue;
      for (std::size_t step = 0; step < to.columns(); ++step) {
        if (!steps[step]) continue;
        same((other * from.rows() + *rows[row]) * from.columns() + *steps[step],
             (d * to.rows() + row) * to.columns() + step);
        ++count;
      }
    }
  }
  return count;
}

}  // namespace epicyclic::studies
