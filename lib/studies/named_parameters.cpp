#include "studies/named_parameters.hpp"

#include <algorithm>

#include "model/scales.hpp"

namespace epicyclic::studies {

namespace {

/// Half gaps are given in b_c.
constexpr double micrometres_per_length_scale = model::length_scale_m * 1e6;
double micrometres(double gap) { return gap * micrometres_per_length_scale; }
double in_length_scales(double gap_um) { return gap_um / micrometres_per_length_scale; }

constexpr double gap_max = 1e4;

}  // namespace

const std::vector<NamedParameter>& named_parameters() {
  using model::OperatingPoint;
  static const std::vector<NamedParameter> all = {
      {"mesh_frequency_ratio",
       "mesh frequency over omega_sn [-]",
       "Mesh frequency ratio",
       "Ω",
       " = ω_m / ω_{sn}",
       1e-6,
       100,
       {"/operation/mesh_frequency_ratio"},
       [](OperatingPoint& point, double value) { point.mesh_frequency_ratio = value; },
       [](const OperatingPoint& point) { return point.mesh_frequency_ratio; }},
      {"damping_ratio",
       "damping ratio of both meshes [-]",
       "Mesh damping ratio",
       "ζ",
       "",
       0,
       10,
       {"/stage/lumped/sun_planet_mesh/damping_ratio", "/stage/lumped/ring_planet_mesh/damping_ratio"},
       [](OperatingPoint& point, double value) {
         point.stage.sun_planet_mesh.damping_ratio = value;
         point.stage.ring_planet_mesh.damping_ratio = value;
       },
       [](const OperatingPoint& point) { return point.stage.sun_planet_mesh.damping_ratio.value_or(0.0); }},
      {"sun_planet_backlash",
       "half the backlash of the sun-planet mesh [b_c]",
       "Half backlash of the sun-planet mesh",
       "b_{sp}",
       " / b_c",
       0,
       gap_max,
       {"/stage/lumped/sun_planet_mesh/backlash_half_um"},
       [](OperatingPoint& point, double value) { point.stage.sun_planet_mesh.backlash_half_um = micrometres(value); },
       [](const OperatingPoint& point) { return in_length_scales(point.stage.sun_planet_mesh.backlash_half_um); }},
      {"ring_planet_backlash",
       "half the backlash of the ring-planet mesh [b_c]",
       "Half backlash of the ring-planet mesh",
       "b_{rp}",
       " / b_c",
       0,
       gap_max,
       {"/stage/lumped/ring_planet_mesh/backlash_half_um"},
       [](OperatingPoint& point, double value) { point.stage.ring_planet_mesh.backlash_half_um = micrometres(value); },
       [](const OperatingPoint& point) { return in_length_scales(point.stage.ring_planet_mesh.backlash_half_um); }},
      {"sun_bearing_clearance",
       "half the clearance of the sun's bearing [b_c]",
       "Half clearance of the sun bearing",
       "b_s",
       " / b_c",
       0,
       gap_max,
       {"/stage/lumped/sun/bearing_clearance_half_um"},
       [](OperatingPoint& point, double value) { point.stage.sun_bearing.clearance_half_um = micrometres(value); },
       [](const OperatingPoint& point) { return in_length_scales(point.stage.sun_bearing.clearance_half_um); }}};
  return all;
}

const NamedParameter* find_parameter(std::string_view name) {
  const auto& all = named_parameters();
  const auto found = std::ranges::find_if(all, [&](const NamedParameter& p) { return p.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace epicyclic::studies
