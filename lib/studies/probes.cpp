#include "studies/probes.hpp"

#include <array>
#include <numbers>
#include <random>
#include <vector>

namespace epicyclic::studies {

Cost estimate_cost(const SweepPlan& plan, const LookOptions& look, const integrate::IntegratorOptions& integrator,
                   const ModelAtPoint& model_at) {
  Cost cost;
  cost.points = plan.points.size();
  cost.chains = plan.chains.size();
  cost.mesh_periods = static_cast<std::int64_t>(plan.points.size()) * (look.transient_periods + look.recorded_periods);
  constexpr int probed_periods = 4;
  LookOptions probe = by_recurrence_alone(look);
  probe.transient_periods = 0;
  probe.recorded_periods = probed_periods;
  double calls = 0.0;
  const std::array probed = {plan.points.front(), plan.points[plan.points.size() / 2], plan.points.back()};
  for (const GridPoint& point : probed) {
    const model::DynamicModel model = model_at(point);
    cost.dimension = model.dimension;
    const PointResult result = compute_point(point, model, {}, probe, integrator, [] { return true; });
    calls += static_cast<double>(result.rhs_evaluations);
  }
  cost.rhs_per_period = calls / static_cast<double>(probed_periods * probed.size());
  return cost;
}

bool same_motion(const model::DynamicModel& a, const model::DynamicModel& b) {
  if (a.dimension != b.dimension || a.breakpoints != b.breakpoints || a.omega != b.omega) return false;
  constexpr double size_max = 1e6;
  constexpr int phases = 8;
  std::minstd_rand random;
  std::vector<double> y(a.dimension);
  std::vector<double> rate_a(a.dimension);
  std::vector<double> rate_b(a.dimension);
  for (double size = 1e-3; size <= size_max; size *= 10.0)
    for (int k = 0; k < phases; ++k) {
      const double s = 2.0 * std::numbers::pi * (k + 0.5) / phases;
      for (double& component : y) component = size * std::uniform_real_distribution(-1.0, 1.0)(random);
      const std::size_t segment = model::segment_at(a.breakpoints, s);
      a.right_hand_side(segment, s, y.data(), rate_a.data());
      b.right_hand_side(segment, s, y.data(), rate_b.data());
      if (rate_a != rate_b) return false;
    }
  return true;
}

}  // namespace epicyclic::studies
