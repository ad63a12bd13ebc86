// One operating point: where the model (of a gear train) and analysis (of any flow) meet.
#pragma once

#include <string>
#include <string_view>

#include "gear/stage.hpp"
#include "integrate/flow.hpp"
#include "integrate/lanes/lane_ensemble.hpp"
#include "model/dynamic_model.hpp"
#include "model/options.hpp"

namespace epicyclic::studies {

/// What a sweep parameter may change.
struct OperatingPoint {
  gear::Stage stage;
  double mesh_frequency_ratio = 1;  ///< Omega [-]
  model::ModelOptions model;
};

/// Sets a sweep parameter of architecture section 6 by its name. Backlash and clearance are half gaps in b_c.
/// @returns false if there is no parameter of that name
[[nodiscard]] bool set_parameter(OperatingPoint& point, std::string_view name, double value);

/// The model as an integrator sees it; period 2 pi in the mesh phase; the switching surfaces are those of
/// DynamicModel::contact_distances.
[[nodiscard]] integrate::VectorField vector_field(const model::DynamicModel& model);

/// Lanes for models of one structure, as the kernels have them; each by its own right-hand side where the model layer
/// has no lanes (full coordinates).
///
/// Its load() takes fields that vector_field() made.
[[nodiscard]] integrate::LaneField lane_field(const model::DynamicModel& like, const integrate::StepLoops& kernels);

}  // namespace epicyclic::studies
