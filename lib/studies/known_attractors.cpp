#include "studies/known_attractors.hpp"

#include <utility>

#include "analysis/attractors.hpp"
#include "analysis/periodic_orbit.hpp"
#include "studies/classification.hpp"

namespace epicyclic::studies {

namespace {

/// The record that determines the point's attractor: the kept one, else one made of its section. The second also serves
/// an undecided point.
analysis::AttractorRecord record_of(PointResult& r, const model::DynamicModel& model,
                                    const integrate::IntegratorOptions& integrator) {
  const std::size_t dimension = model.dimension;
  if (r.attractor.dimension > 0) return std::move(r.attractor);
  if (r.outcome != integrate::Outcome::reached || r.poincare_rows() == 0) return {};
  // Its record does not recur: it has not converged to the orbit, or no orbit is kept.
  if (r.regime == analysis::Regime::periodic && r.recurrence.period == 0) {
    if (r.orbit.empty()) return {};
    const auto flow = make_flow_of_one_trajectory(model, integrator);
    const analysis::PeriodicOrbit orbit = analysis::find_periodic_orbit(*flow, r.orbit, r.period);
    if (!orbit.found()) return {};
    return analysis::record_of_orbit(*flow, orbit, r.period, map_error(integrator));
  }
  return analysis::record_of_section(section_of(r, dimension), r.regime, r.recurrence, r.lyapunov_max(),
                                     map_error(integrator));
}

}  // namespace

std::vector<double> state_on(const PointResult& point, std::size_t dimension) {
  std::vector<double> state = point.orbit;
  if (state.empty() && point.poincare_rows() > 0)
    state.assign(point.poincare.end() - static_cast<std::ptrdiff_t>(point.poincare_columns),
                 point.poincare.end() - static_cast<std::ptrdiff_t>(point.poincare_columns - dimension));
  if (state.empty()) state = point.attractor.orbit;
  if (state.empty()) state = point.end_state;
  if (state.size() > dimension) state.resize(dimension);
  if (state.size() != dimension) state.clear();
  return state;
}

KnownAttractors attractors_known_at(const SweepPlan& plan, const PointSource& points, std::size_t point, bool basins,
                                    const model::DynamicModel& model, const integrate::IntegratorOptions& integrator) {
  const GridPoint here = plan.points[point];
  std::vector<std::size_t> considered;
  std::vector<PointSummary> results;
  for (const GridPoint& other : plan.points) {
    if (!basins && (other.value != here.value || other.second_value != here.second_value)) continue;
    PointResult r = points.read(other.index);
    r.attractor = record_of(r, model, integrator);
    considered.push_back(other.index);
    results.push_back(std::move(r));
  }
  std::vector<std::string> names;
  for (const PointSummary& r : results) names.push_back(regime_name(r));
  const analysis::Attractors attractors = attractors_of(results, planet_rotations(model, integrator));
  KnownAttractors known;
  known.considered = considered.size();
  for (const analysis::Attractor& a : attractors.all)
    known.all.push_back({considered[a.members.front()], names[a.members.front()], a.members.size(), a.image_of});
  for (std::size_t k = 0; k < considered.size(); ++k)
    if (considered[k] == point) known.here = attractors.number[k];
  return known;
}

}  // namespace epicyclic::studies
