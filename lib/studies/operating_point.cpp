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
  const auto flank = [&](std::string name, auto member, std::size_t planet, double gap) {
    field.surfaces.push_back(
        {std::move(name), [deflections = model.deflections, member, planet, gap](double s, std::span<const double> y) {
           model::MeshDeflections d;
           deflections(s, y.data(), d);
           return (d.*member)[planet] - gap;
         }});
  };
  for (std::size_t i = 0; i < static_cast<std::size_t>(model.planets); ++i) {
    const std::string planet = std::to_string(i + 1);
    const double b_sp = model.sun_planet_half_gap;
    const double b_rp = model.ring_planet_half_gap;
    flank("drive_sp_" + planet, &model::MeshDeflections::sun_planet, i, b_sp);
    flank("back_sp_" + planet, &model::MeshDeflections::sun_planet, i, -b_sp);
    flank("drive_rp_" + planet, &model::MeshDeflections::ring_planet, i, b_rp);
    flank("back_rp_" + planet, &model::MeshDeflections::ring_planet, i, -b_rp);
  }
  return field;
}

integrate::LaneField lane_field(const model::DynamicModel& like, const integrate::LaneKernels& kernels) {
  const model::LaneModel lanes = model::make_lane_model(like, kernels.name);
  if (lanes.width != kernels.width) return integrate::one_by_one(kernels.width, like.dimension);
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
  return field;
}

}  // namespace epicyclic::studies
