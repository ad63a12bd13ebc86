#include "studies/plane.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "model/layout.hpp"

namespace epicyclic::studies {

namespace {

/// Displacements and velocities with planet i's parts at i + steps, all vectors turned along.
std::vector<double> turned(const model::DynamicModel& model, int steps, std::span<const double> state) {
  using model::Slots;
  const auto planets = static_cast<std::size_t>(model.planets);
  const double angle = 2.0 * std::numbers::pi * steps / model.planets;
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  std::vector<double> result(state.begin(), state.end());
  for (std::size_t half = 0; half < 2; ++half) {
    const double* from = state.data() + half * model.dimension / 2;
    double* to = result.data() + half * model.dimension / 2;
    const auto turn = [&](std::size_t x, std::size_t x_to) {
      to[x_to] = cosine * from[x] - sine * from[x + 1];
      to[x_to + 1] = sine * from[x] + cosine * from[x + 1];
    };
    for (const std::size_t x : {Slots::x_s, Slots::x_r(planets), Slots::x_c(planets)}) turn(x, x);
    for (std::size_t i = 0; i < planets; ++i) {
      const std::size_t j = (i + static_cast<std::size_t>(steps)) % planets;
      turn(Slots::x_p(i), Slots::x_p(j));
      to[Slots::w_p(j)] = from[Slots::w_p(i)];
    }
  }
  return result;
}

}  // namespace

double axis_value(const Axis& axis, std::size_t point) {
  const double share = axis.points == 1 ? 0.0 : static_cast<double>(point) / static_cast<double>(axis.points - 1);
  return grid_value(axis.from, axis.to, share);
}

std::vector<double> axis_values(const Axis& axis) {
  std::vector<double> values;
  for (std::size_t k = 0; k < static_cast<std::size_t>(axis.points); ++k) values.push_back(axis_value(axis, k));
  return values;
}

SweepPlan plan_map(const SweepOptions& sweep, const PlaneOptions& plane) {
  SweepPlan plan;
  const auto columns = static_cast<std::size_t>(plane.first.points);
  const auto rows = static_cast<std::size_t>(plane.second.points);
  for (const Direction direction : sweep.directions)
    for (std::size_t row = 0; row < rows; ++row) {
      std::vector<std::size_t> chain;
      for (std::size_t k = 0; k < columns; ++k) {
        const std::size_t column = direction == Direction::up ? k : columns - 1 - k;
        chain.push_back(plan.points.size());
        plan.points.push_back(
            {plan.points.size(), direction, axis_value(plane.first, column), axis_value(plane.second, row)});
      }
      if (sweep.start == Start::carried) {
        plan.chains.push_back(std::move(chain));
      } else {
        for (const std::size_t point : chain) plan.chains.push_back({point});
      }
    }
  return plan;
}

SweepPlan plan_basins(const PlaneOptions& plane) {
  SweepOptions cells;
  cells.start = Start::cold;
  return plan_map(cells, plane);
}

std::vector<double> start_in_plane(const model::DynamicModel& model, const PlaneOptions& plane,
                                   const GridPoint& point) {
  std::vector<double> start = model.default_start;
  const auto set = [&](const std::string& name, double value) {
    const auto found = std::find(model.state_names.begin(), model.state_names.end(), name);
    if (found == model.state_names.end()) throw InputError("the state has no component '" + name + "'");
    start[static_cast<std::size_t>(found - model.state_names.begin())] = value;
  };
  for (const auto& [name, value] : plane.base) set(name, value);
  set(plane.first.name, point.value);
  set(plane.second.name, point.second_value);
  return start;
}

std::vector<PlanetTurn> planet_turns(const model::DynamicModel& model) {
  std::vector<PlanetTurn> turns;
  for (int steps = 1; steps < model.planets; ++steps)
    turns.push_back({steps, [model, steps](std::span<const double> state) { return turned(model, steps, state); }});
  return turns;
}

analysis::Attractors attractors_of(std::vector<PointResult>& results, const std::vector<PlanetTurn>& turns) {
  std::vector<analysis::AttractorRecord> records;
  records.reserve(results.size());
  for (PointResult& r : results) records.push_back(std::move(r.attractor));
  std::vector<analysis::Symmetry> symmetries;
  for (const PlanetTurn& turn : turns) symmetries.push_back(turn.map);
  return analysis::tell_attractors(records, {}, symmetries);
}

}  // namespace epicyclic::studies
