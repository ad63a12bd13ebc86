// What is asked of models before a study runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "studies/sweep.hpp"

namespace epicyclic::studies {

/// What the points of a study will take.
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

/// Counts, and probes the first point, the last and the one between from the default start.
/// @param go_on  asked now and then; once it says false, the right-hand sides are those that were counted by then
[[nodiscard]] Cost estimate_cost(
    const SweepPlan& plan, const RecordingOptions& recording, const integrate::IntegratorOptions& integrator,
    const ModelAtPoint& model_at, const std::function<bool()>& go_on = [] { return true; });

/// The same ranges with fewer values, each in the middle of its part, in as many chains as that allows.
/// @param points  about as many are left, never more than there were
[[nodiscard]] SweepPlan in_miniature(const SweepPlan& plan, std::size_t points);

/// Processor time of this process so far, of all its threads together.
[[nodiscard]] double processor_seconds();

/// What was measured of a miniature.
struct Measured {
  std::size_t points = 0;
  double processor_seconds = 0;       ///< of all threads together
  std::optional<double> occupancy{};  ///< of lanes, if there were any
  std::size_t chains = 0;
  std::size_t finished = 0;  ///< of the points; fewer than all where it was stopped
};

/// Processor time of all points, by what a miniature of theirs took. Where the plan has more chains for its lanes than
/// the miniature had, they are as busy as they commonly are.
[[nodiscard]] double processor_seconds_of(const SweepPlan& plan, const Measured& miniature, int threads);

/// Points of the smallest miniature that tells anything: enough for lanes to be shared.
[[nodiscard]] std::size_t smallest_miniature(const integrate::IntegratorOptions& integrator, int threads);

/// Computes miniatures, each with four times the points of the one before, while the next one is likely to be done
/// within `seconds` of processor time for each thread.
/// @param first    points of the first of them
/// @param compute  the points of a miniature, and what lanes did; returns how many points it finished, which are fewer
///                 than all only where it was stopped from outside: then no more is computed
/// @returns the last of them that was finished; if none was, the first
[[nodiscard]] Measured measure_miniatures(const SweepPlan& plan, std::size_t first, double seconds, int threads,
                                          const std::function<std::size_t(const SweepPlan&, LaneUse&)>& compute);

/// Do two models answer alike, wherever the state is? Looked at states of all sizes, so that gaps of any width are
/// crossed.
[[nodiscard]] bool same_equations(const model::DynamicModel& a, const model::DynamicModel& b);

}  // namespace epicyclic::studies
