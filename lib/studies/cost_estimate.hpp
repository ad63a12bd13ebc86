// Models, evaluated before a study runs: its cost, and whether two models are the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "studies/sweep.hpp"

namespace epicyclic::studies {

/// Work of the points of a study.
struct Cost {
  std::size_t points = 0;
  std::size_t chains = 0;         ///< that can run at the same time
  std::int64_t mesh_periods = 0;  ///< in all
  std::size_t dimension = 0;      ///< of the state
  double rhs_per_period = 0;      ///< right-hand sides per mesh period, mean of a few periods at three points
  [[nodiscard]] double rhs_evaluations() const { return rhs_per_period * static_cast<double>(mesh_periods); }
};

/// Transients and records of all points.
[[nodiscard]] std::int64_t mesh_periods_of(const SweepPlan& plan, const RecordingOptions& recording);

/// Counts, and evaluates the first point, the last and the middle one from the default start.
/// @param go_on  called now and then; once it returns false, the right-hand sides are those counted by then
[[nodiscard]] Cost estimate_cost(
    const SweepPlan& plan, const RecordingOptions& recording, const integrate::IntegratorOptions& integrator,
    const ModelAtPoint& model_at, const std::function<bool()>& go_on = [] { return true; });

/// The same ranges with fewer values, each in the middle of its part, in as many chains as that allows.
/// @param points  about as many are left, never more than there were
[[nodiscard]] SweepPlan in_miniature(const SweepPlan& plan, std::size_t points);

/// Processor time of this process so far, of all its threads together.
[[nodiscard]] double processor_seconds();

/// Measurements of a miniature.
struct Measured {
  std::size_t points = 0;
  double processor_seconds = 0;       ///< of all threads together
  std::optional<double> occupancy{};  ///< of lanes, if there were any
  std::size_t chains = 0;
  std::size_t finished = 0;  ///< of the points; fewer than all where it was stopped
};

/// Processor time of all points, from the measurements of a miniature. If the plan has more chains for its lanes than
/// the miniature had, the lanes' common occupancy is assumed.
[[nodiscard]] double processor_seconds_of(const SweepPlan& plan, const Measured& miniature, int threads);

/// Points of the smallest useful miniature: enough for lanes to be shared.
[[nodiscard]] std::size_t smallest_miniature(const integrate::IntegratorOptions& integrator, int threads);

/// Computes miniatures, each with four times the points of the one before, while the next one is likely to be done
/// within `seconds` of processor time for each thread.
/// @param first    points of the first of them
/// @param compute  the points of a miniature, and what lanes did; returns how many points it finished, which are fewer
///                 than all only where it was stopped from outside: then no more is computed
/// @returns the last of them that was finished; if none was, the first
[[nodiscard]] Measured measure_miniatures(const SweepPlan& plan, std::size_t first, double seconds, int threads,
                                          const std::function<std::size_t(const SweepPlan&, LaneUse&)>& compute);

/// Do two models have the same right-hand sides at all states? Compared at states of all sizes, so that gaps of any
/// width are crossed.
[[nodiscard]] bool same_equations(const model::DynamicModel& a, const model::DynamicModel& b);

}  // namespace epicyclic::studies
