#include "studies/short_history.hpp"

#include <memory>

#include "integrate/flow.hpp"
#include "studies/classification.hpp"

namespace epicyclic::studies {

std::optional<ShortHistory> short_history(const model::DynamicModel& model, std::span<const double> state,
                                          const integrate::IntegratorOptions& integrator, int periods, int phases) {
  ShortHistory history;
  model::MeshDeflections d;
  model::StageForces f;
  const auto see = [&](double s, const double* y) {
    model.deflections(s, y, d);
    model.forces(s, y, f);
    const std::array<double, ShortHistory::names.size()> row = {d.sun_planet.front(),
                                                                d.ring_planet.front(),
                                                                d.sun_planet_rate.front(),
                                                                d.ring_planet_rate.front(),
                                                                model.scales.force_newton(f.sun_planet.front()),
                                                                model.scales.force_newton(f.ring_planet.front())};
    for (std::size_t k = 0; k < row.size(); ++k) history.columns[k].push_back(row[k]);
  };
  std::vector<double> samples;
  for (int k = 1; k <= periods * phases; ++k) samples.push_back(model.period * k / phases);
  std::vector<double> y(state.begin(), state.end());
  see(0.0, y.data());
  const std::unique_ptr<integrate::Flow> flow = make_flow_of_one_trajectory(model, integrator);
  const auto evolution = flow->evolve(y, 0.0, samples.back(), samples,
                                      [&](std::size_t, double s, std::span<const double> at) { see(s, at.data()); });
  if (!evolution.reached()) return std::nullopt;
  return history;
}

}  // namespace epicyclic::studies
