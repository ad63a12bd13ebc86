// The motion that the benchmarks advance: a periodic orbit of the paper's stage, and where it leads.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/periodic_orbit.hpp"
#include "analysis/poincare.hpp"
#include "integrate/make_flow.hpp"
#include "model/dynamic_model.hpp"
#include "problems/r1.hpp"

namespace epicyclic::bench {

using State = std::vector<double>;
inline constexpr double period = 2.0 * std::numbers::pi;
inline constexpr int orbit_periods = 20;

inline model::DynamicModel model_at(double omega, bool friction = true) {
  const gear::Stage paper = problems::tang2020();
  gear::Stage stage = paper;
  for (auto* mesh : {&stage.sun_planet_mesh, &stage.ring_planet_mesh}) {
    if (friction) break;
    mesh->friction = {};
  }
  return model::make_dynamic_model(stage, model::scales_of(paper), omega, {});
}

inline integrate::IntegratorOptions options(double tolerance, std::string method = "arkode-dopri5") {
  integrate::IntegratorOptions o;
  o.method = std::move(method);
  o.relative_tolerance = tolerance;
  o.absolute_tolerance = 1e-2 * tolerance;
  return o;
}

inline State settled(const model::DynamicModel& model) {
  const auto flow = integrate::make_flow(model, options(1e-8));
  State y = model.default_start;
  for (int k = 0; k < 100; ++k) flow->evolve(y, 0.0, period);
  return y;
}

/// A state on the attracting periodic orbit beside the motion that settles, by Newton's method; empty without one.
inline State on_orbit(const model::DynamicModel& model) {
  const auto flow = integrate::make_flow(model, options(1e-11));
  State y = settled(model);
  analysis::StrobeOptions strobe;
  strobe.transient_periods = 300;
  strobe.recorded_periods = 64;
  strobe.phases = 1;
  const auto section = analysis::strobe(
                           *flow, y, strobe, [](std::size_t, double, std::span<const double>) {}, [] { return true; })
                           .section;
  const int n = analysis::recurrence(section, 12, 1e-3).best_period;
  const analysis::PeriodicOrbit orbit = analysis::find_periodic_orbit(*flow, y, n);
  return orbit.found() && analysis::largest_multiplier(orbit) < 1.0 ? orbit.state : State{};
}

/// Where `orbit_periods` lead from a state, by ARKODE at 1e-13.
inline State reference_from(const model::DynamicModel& model, State y) {
  const auto flow = integrate::make_flow(model, options(1e-13));
  for (int k = 0; k < orbit_periods; ++k) flow->evolve(y, 0.0, period);
  return y;
}

}  // namespace epicyclic::bench
