// One operating point: where the model (of a gear train) and analysis (of any flow) meet.
#pragma once

#include "integrate/flow.hpp"
#include "integrate/lanes/lane_ensemble.hpp"
#include "model/dynamic_model.hpp"

namespace epicyclic::studies {

/// The model as an integrator sees it; period 2 pi in the mesh phase; the switching surfaces are those of
/// DynamicModel::contact_distances.
[[nodiscard]] integrate::VectorField vector_field(const model::DynamicModel& model);

/// Lanes for models of one structure, as the kernels have them; each by its own right-hand side where the model layer
/// has no lanes (full coordinates).
///
/// Its load() takes fields that vector_field() made.
[[nodiscard]] integrate::LaneField lane_field(const model::DynamicModel& like, const integrate::StepLoops& kernels);

}  // namespace epicyclic::studies
