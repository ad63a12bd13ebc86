// A stage set in motion, for tests that need model and integrator.
#pragma once

#include <cstddef>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "integrate/sundials/arkode_flow.hpp"
#include "model/dynamic_model.hpp"

namespace epicyclic::problems {

inline integrate::IntegratorOptions tight(double tolerance = 1e-13) {
  integrate::IntegratorOptions o;
  o.relative_tolerance = tolerance;
  o.absolute_tolerance = tolerance;
  o.max_steps_per_period = 1000000;
  return o;
}

/// Values of s from 0 to `periods`, equally spaced, without 0.
inline std::vector<double> phases(int periods, int per_period) {
  std::vector<double> s;
  for (int k = 1; k <= periods * per_period; ++k) s.push_back(2.0 * std::numbers::pi * k / per_period);
  return s;
}

/// Deflections of all meshes at given phases: the state is stepped onto each, so that no dense output comes in.
/// Sun meshes first, then ring meshes [b_c].
inline std::vector<std::vector<double>> deflections_along(const model::DynamicModel& m, std::vector<double> state,
                                                          const std::vector<double>& at, double tolerance = 1e-13) {
  const auto flow = integrate::make_arkode_flow(m, tight(tolerance));
  std::vector<std::vector<double>> r;
  double from = 0.0;
  for (const double to : at) {
    const integrate::Evolution e = flow->evolve(state, from, to);
    if (!e.reached()) throw std::runtime_error("not reached: " + e.message);
    model::MeshDeflections d;
    m.deflections(to, state.data(), d);
    r.push_back(d.sun_planet);
    r.back().insert(r.back().end(), d.ring_planet.begin(), d.ring_planet.end());
    from = to;
  }
  return r;
}

}  // namespace epicyclic::problems
