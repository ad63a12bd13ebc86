// Models of gear trains side by side in the lanes of an integrator.
#pragma once

#include "core/vector_field.hpp"
#include "integrate/lanes/lane_pool.hpp"
#include "integrate/lanes/step_loops.hpp"
#include "integrate/options.hpp"
#include "model/dynamic_model.hpp"

namespace epicyclic::studies {

/// Lanes for models of one structure, as the kernels have them; each by its own right-hand side where the model layer
/// has no lanes (full coordinates).
/// @param vectors  tangent vectors of each lane; where the model layer has no lanes there are none: width 0
[[nodiscard]] LaneField stage_lanes(const model::DynamicModel& like, const integrate::StepLoops& loops,
                                    std::size_t vectors = 0);

/// Lanes that trajectories of such models share.
/// @param like  has to live as long as the pool
[[nodiscard]] integrate::LanePool stage_pool(const model::DynamicModel& like,
                                             const integrate::IntegratorOptions& integrator,
                                             const integrate::StepLoops& loops);

}  // namespace epicyclic::studies
