#include "studies/operating_point.hpp"

#include <memory>
#include <numbers>
#include <vector>

#include "core/errors.hpp"
#include "model/lane_model.hpp"

namespace epicyclic::studies {

namespace {

/// Of a stage's field.
struct ModelOrigin : integrate::Origin {
  explicit ModelOrigin(const model::DynamicModel& of) : model(of) {}
  model::DynamicModel model;
};

}  // namespace

integrate::VectorField vector_field(const model::DynamicModel& model) {
  integrate::VectorField field;
  field.dimension = model.dimension;
  field.period = 2.0 * std::numbers::pi;
  field.origin = std::make_shared<const ModelOrigin>(model);
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
    const auto* const made_of = dynamic_cast<const ModelOrigin*>(system.origin.get());
    if (made_of == nullptr) throw InputError("a system that is not a stage in a stage's lane");
    lanes.load(lane, made_of->model);
  };
  field.set_segment = lanes.set_segment;
  field.set_places = lanes.set_places;
  field.right_hand_side = lanes.right_hand_side;
  field.surfaces = lanes.contacts;
  field.surface_values = lanes.contact_distances;
  return field;
}

}  // namespace epicyclic::studies
