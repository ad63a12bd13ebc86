#include "studies/plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "model/layout.hpp"
#include "studies/motion.hpp"

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

std::vector<double> start_in_plane(const model::DynamicModel& model, const BasinsOptions& basins,
                                   const GridPoint& point) {
  std::vector<double> start = model.default_start;
  const auto set = [&](const std::string& name, double value) {
    const auto found = std::find(model.state_names.begin(), model.state_names.end(), name);
    if (found == model.state_names.end()) throw InputError("the state has no component '" + name + "'");
    start[static_cast<std::size_t>(found - model.state_names.begin())] = value;
  };
  for (const auto& [name, value] : basins.other_components) set(name, value);
  set(basins.plane.first.name, point.value);
  set(basins.plane.second.name, point.second_value);
  return start;
}

std::vector<PlanetTurn> planet_turns(const model::DynamicModel& model, const integrate::IntegratorOptions& integrator) {
  constexpr double rounding = 1e-9;  // of a turn
  std::vector<PlanetTurn> turns;
  for (int steps = 1; steps < model.planets; ++steps) {
    const double ahead = model.planet_phases.empty() ? 0.0 : model.planet_phases[static_cast<std::size_t>(steps)];
    const double part = ahead - std::floor(ahead);
    if (std::abs(ahead - std::round(ahead)) <= rounding) {
      turns.push_back({steps, [model, steps](std::span<const double> state) { return turned(model, steps, state); }});
      continue;
    }
    turns.push_back({steps, [model, steps, integrator, until = part * model.period](std::span<const double> state) {
                       std::vector<double> later(state.begin(), state.end());
                       // What cannot be carried on has no image.
                       if (!make_flow_of_one_trajectory(model, integrator)->evolve(later, 0.0, until).reached())
                         std::ranges::fill(later, std::numeric_limits<double>::infinity());
                       return turned(model, steps, later);
                     }});
  }
  return turns;
}

analysis::Attractors attractors_of(std::vector<PointSummary>& results, const std::vector<PlanetTurn>& turns) {
  std::vector<analysis::AttractorRecord> records;
  records.reserve(results.size());
  for (PointSummary& r : results) records.push_back(std::move(r.attractor));
  std::vector<analysis::Symmetry> symmetries;
  for (const PlanetTurn& turn : turns) symmetries.push_back(turn.map);
  return analysis::label_attractors(records, {}, symmetries);
}

}  // namespace epicyclic::studies
