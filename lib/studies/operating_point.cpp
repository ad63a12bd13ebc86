#include "studies/operating_point.hpp"

#include <memory>
#include <numbers>
#include <vector>

#include "core/errors.hpp"
#include "model/lane_model.hpp"

namespace epicyclic::studies {

bool set_parameter(OperatingPoint& point, std::string_view name, double value) {
  constexpr double um_per_length_scale = model::length_scale_m * 1e6;
  gear::Stage& stage = point.stage;
  if (name == "mesh_frequency_ratio") {
    point.mesh_frequency_ratio = value;
  } else if (name == "damping_ratio") {
    stage.sun_planet_mesh.damping_ratio = value;
    stage.ring_planet_mesh.damping_ratio = value;
  } else if (name == "sun_planet_backlash") {
    stage.sun_planet_mesh.backlash_half_um = value * um_per_length_scale;
  } else if (name == "ring_planet_backlash") {
    stage.ring_planet_mesh.backlash_half_um = value * um_per_length_scale;
  } else if (name == "sun_bearing_clearance") {
    stage.sun_bearing.clearance_half_um = value * um_per_length_scale;
  } else {
    return false;
  }
  return true;
}

integrate::VectorField vector_field(const model::DynamicModel& model) {
  integrate::VectorField field;
  field.dimension = model.dimension;
  field.period = 2.0 * std::numbers::pi;
  field.origin = std::make_shared<const model::DynamicModel>(model);
  field.breakpoints = model.breakpoints;
  field.right_hand_side = model.right_hand_side;
  field.tangents = model.tangents;
  field.parameter_derivative = model.parameter_derivative;
  field.jumps_at_surfaces = model.jumps_at_contact;
  field.surfaces = {model.contacts, model.contact_distances};
  return field;
}

integrate::LaneField lane_field(const model::DynamicModel& like, const integrate::StepLoops& kernels) {
  const model::LaneModel lanes = model::make_lane_model(like, kernels.name, kernels.copy);
  if (lanes.width != kernels.width) return integrate::one_by_one(kernels.width, like.dimension, like.contacts);
  integrate::LaneField field;
  field.dimension = lanes.dimension;
  field.load = [lanes](std::size_t lane, const integrate::VectorField& system) {
    const auto* const made_of = static_cast<const model::DynamicModel*>(system.origin.get());
    if (made_of == nullptr) throw InputError("a system that is not a stage in a stage's lane");
    lanes.load(lane, *made_of);
  };
  field.set_segment = lanes.set_segment;
  field.set_places = lanes.set_places;
  field.right_hand_side = lanes.right_hand_side;
  field.surfaces = lanes.contacts;
  field.surface_values = lanes.contact_distances;
  return field;
}

}  // namespace epicyclic::studies
