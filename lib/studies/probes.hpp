// What is asked of models before a study runs.
#pragma once

#include <cstddef>
#include <cstdint>

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

/// Counts, and probes the first point, the last and the one between from the default start.
[[nodiscard]] Cost estimate_cost(const SweepPlan& plan, const LookOptions& look,
                                 const integrate::IntegratorOptions& integrator, const ModelAtPoint& model_at);

/// Do two models answer alike, wherever the state is? Looked at states of all sizes, so that gaps of any width are
/// crossed.
[[nodiscard]] bool same_motion(const model::DynamicModel& a, const model::DynamicModel& b);

}  // namespace epicyclic::studies
