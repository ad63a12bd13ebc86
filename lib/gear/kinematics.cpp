#include "gear/kinematics.hpp"

#include <cmath>
#include <numbers>

#include "core/errors.hpp"

namespace epicyclic::gear {

namespace {

double teeth(const std::optional<int>& z, const char* member) {
  if (!z) throw DomainError(std::string("speeds and torques need the teeth of the ") + member);
  return static_cast<double>(*z);
}

constexpr double radian = std::numbers::pi / 180.0;

}  // namespace

Speeds speeds(const Stage& stage, double mesh_frequency) {
  const double z_s = teeth(stage.sun.teeth, "sun");
  if (stage.is_pair()) return {mesh_frequency / z_s, 0.0};
  const double z_r = teeth(stage.ring.teeth, "ring");
  if (stage.boundary == Boundary::star) return {mesh_frequency / z_s, 0.0};
  if (stage.boundary == Boundary::fixed_sun) return {0.0, mesh_frequency / z_s};
  if (stage.boundary == Boundary::free) {
    const double ratio = stage.carrier_to_sun_speed.value();
    const double sun = mesh_frequency / (z_s * (1.0 - ratio));
    return {sun, ratio * sun};
  }
  const double carrier = mesh_frequency / z_r;
  return {carrier * (z_s + z_r) / z_s, carrier};
}

double carrier_speed(const Stage& stage, double mesh_frequency) {
  const double carrier = speeds(stage, mesh_frequency).carrier;
  return stage.boundary == Boundary::fixed_sun ? -carrier : carrier;
}

Torques torques(const Stage& stage, double mesh_frequency) {
  const bool held_sun = stage.boundary == Boundary::fixed_sun;
  const double ratio = stage.is_pair() ? 0.0 : teeth(stage.ring.teeth, "ring") / teeth(stage.sun.teeth, "sun");
  const auto of_power = [&](double watt) {
    const Speeds w = speeds(stage, mesh_frequency);
    return held_sun ? watt / (w.carrier * (1.0 + ratio)) : watt / w.sun;
  };
  const double drive =
      stage.load.power_kW ? of_power(*stage.load.power_kW * 1e3) : std::abs(stage.load.torque_Nm.value());
  if (stage.is_pair()) return {drive, 0.0, 0.0};
  if (stage.boundary == Boundary::star) return {drive, ratio * drive, 0.0};
  const bool has_ring_torque = held_sun || stage.boundary == Boundary::free;
  return {drive, has_ring_torque ? ratio * drive : 0.0, (1.0 + ratio) * drive};
}

double planet_centrifugal_force(const Stage& stage, double mesh_frequency) {
  return planet_centrifugal_force(stage, mesh_frequency, stage.planet.mass_kg);
}

double planet_centrifugal_force(const Stage& stage, double mesh_frequency, double mass_kg) {
  const double carrier = speeds(stage, mesh_frequency).carrier;
  if (carrier == 0.0) return 0.0;
  return mass_kg * carrier * carrier * stage.centre_distance_mm.value() * 1e-3;
}

PressureAngles pressure_angles(const Stage& stage) {
  const auto angle = [&](const Mesh& mesh, std::optional<double> base_sum) {
    if (base_sum && stage.centre_distance_mm) return std::acos(*base_sum / *stage.centre_distance_mm);
    if (!mesh.operating_pressure_angle_deg)
      throw DomainError("a mesh without pressure angle, base radii or centre distance");
    return *mesh.operating_pressure_angle_deg * radian;
  };
  std::optional<double> sun_sum;
  std::optional<double> ring_difference;
  if (stage.sun.base_radius_mm && stage.planet.base_radius_mm)
    sun_sum = *stage.sun.base_radius_mm + *stage.planet.base_radius_mm;
  if (stage.ring.base_radius_mm && stage.planet.base_radius_mm)
    ring_difference = *stage.ring.base_radius_mm - *stage.planet.base_radius_mm;
  if (stage.is_pair()) return {angle(stage.sun_planet_mesh, sun_sum), 0.0};
  return {angle(stage.sun_planet_mesh, sun_sum), angle(stage.ring_planet_mesh, ring_difference)};
}

}  // namespace epicyclic::gear
