#include "studies/cost_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numbers>
#include <random>
#include <vector>

#include "integrate/lanes/step_loops.hpp"
#include "integrate/methods.hpp"

namespace epicyclic::studies {

std::int64_t mesh_periods_of(const SweepPlan& plan, const RecordingOptions& recording) {
  return static_cast<std::int64_t>(plan.points.size()) * (recording.transient_periods + recording.recorded_periods);
}

Cost estimate_cost(const SweepPlan& plan, const RecordingOptions& recording,
                   const integrate::IntegratorOptions& integrator, const ModelAtPoint& model_at,
                   const std::function<bool()>& go_on) {
  Cost cost;
  cost.points = plan.points.size();
  cost.chains = plan.chains.size();
  cost.mesh_periods = mesh_periods_of(plan, recording);
  constexpr int probed_periods = 4;
  RecordingOptions probe = by_recurrence_alone(recording);
  probe.transient_periods = 0;
  probe.recorded_periods = probed_periods;
  double calls = 0.0;
  const std::array probed = {plan.points.front(), plan.points[plan.points.size() / 2], plan.points.back()};
  for (const GridPoint& point : probed) {
    const model::DynamicModel model = model_at(point);
    cost.dimension = model.dimension;
    const PointResult result = compute_point(point, model, {}, probe, integrator, go_on);
    calls += static_cast<double>(result.rhs_evaluations);
  }
  cost.rhs_per_period = calls / static_cast<double>(probed_periods * probed.size());
  return cost;
}

namespace {

/// As many values as `points`, each in the middle of its part of the range.
Axis fewer(Axis axis, std::size_t points) {
  if (points >= static_cast<std::size_t>(axis.points)) return axis;
  const double half = 0.5 / static_cast<double>(points);
  const double from = grid_value(axis.from, axis.to, half);
  const double to = grid_value(axis.from, axis.to, 1.0 - half);
  axis.from = from;
  axis.to = points == 1 ? from : to;
  axis.points = static_cast<int>(points);
  return axis;
}

}  // namespace

SweepPlan in_miniature(const SweepPlan& plan, std::size_t points) {
  PlanGrid grid = plan.grid;
  const double share = static_cast<double>(points) / static_cast<double>(plan.points.size());
  if (share >= 1.0) return plan;
  const auto part = [](std::size_t of, double of_it) {
    return std::clamp(static_cast<std::size_t>(std::lround(static_cast<double>(of) * of_it)), std::size_t{1}, of);
  };
  // A plane leaves out as many rows as columns.
  const std::size_t rows = part(grid.rows(), std::sqrt(share));
  const double columns_left = share * static_cast<double>(grid.rows()) / static_cast<double>(rows);
  const std::size_t columns = part(grid.columns(), columns_left);
  grid.first = fewer(grid.first, columns);
  grid.second = fewer(grid.second, rows);
  grid.chains_per_line = std::min(grid.chains_per_line, columns);
  return SweepPlan(grid);
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::size_t smallest_miniature(const integrate::IntegratorOptions& integrator, int threads) {
  constexpr std::size_t for_lanes = 16;
  if (integrate::method_named(integrator.method).family != integrate::Family::lanes) return 2;
  return for_lanes * static_cast<std::size_t>(threads);
}

double processor_seconds_of(const SweepPlan& plan, const Measured& miniature, int threads) {
  // Measured 0.7 to 0.9; less towards the end, when only the longest points remain.
  const auto lanes = static_cast<double>(integrate::step_loops().width) * threads;
  const double commonly = 0.7 * std::min(1.0, static_cast<double>(plan.chains.size()) / lanes);
  double seconds =
      miniature.processor_seconds / static_cast<double>(miniature.points) * static_cast<double>(plan.points.size());
  if (miniature.occupancy && plan.chains.size() > miniature.chains)
    seconds *= std::min(1.0, *miniature.occupancy / commonly);
  return seconds;
}

Measured measure_miniatures(const SweepPlan& plan, std::size_t first, double seconds, int threads,
                            const std::function<std::size_t(const SweepPlan&, LaneUse&)>& compute) {
  constexpr std::size_t times = 4;
  std::optional<Measured> before;
  for (std::size_t points = first;; points *= times) {
    const SweepPlan miniature = in_miniature(plan, points);
    const double begun = processor_seconds();
    LaneUse lanes;
    const std::size_t finished = compute(miniature, lanes);
    const double spent = processor_seconds() - begun;
    const Measured last{miniature.points.size(), spent, lanes.occupancy(), miniature.chains.size(), finished};
    if (finished < last.points) return before.value_or(last);
    before = last;
    if (miniature.points.size() == plan.points.size() || static_cast<double>(times) * spent >= seconds * threads)
      return last;
  }
}

bool same_equations(const model::DynamicModel& a, const model::DynamicModel& b) {
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
