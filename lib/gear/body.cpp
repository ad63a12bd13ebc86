#include "gear/body.hpp"

#include <cmath>
#include <numbers>

#include "core/errors.hpp"

namespace epicyclic::gear {

namespace {

constexpr double m_per_mm = 1e-3;

}  // namespace

MassAndInertia cylinder(double outer_radius_mm, double inner_radius_mm, double length_mm, double density) {
  if (!(inner_radius_mm >= 0.0) || !(outer_radius_mm > inner_radius_mm) || !(length_mm > 0.0))
    throw DomainError("a hollow cylinder needs 0 <= inner radius < outer radius and a length");
  const double outer = outer_radius_mm * m_per_mm;
  const double inner = inner_radius_mm * m_per_mm;
  const double mass = density * length_mm * m_per_mm * std::numbers::pi * (outer * outer - inner * inner);
  return {mass, 0.5 * mass * (outer * outer + inner * inner)};
}

double body_radius_mm(const Tooth& tooth) { return 0.5 * (tooth.tip_radius_mm + tooth.root_radius_mm); }

MassAndInertia carrier(const CarrierBody& b, int planets, double centre_distance_mm, double density) {
  const MassAndInertia plate =
      cylinder(0.5 * b.outer_diameter_mm, 0.5 * b.inner_diameter_mm, b.plate_thickness_mm, density);
  const MassAndInertia pin = cylinder(0.5 * b.pin_diameter_mm, 0.0, b.pin_length_mm, density);
  const double distance = centre_distance_mm * m_per_mm;
  return {b.plates * plate.mass_kg + planets * pin.mass_kg,
          b.plates * plate.inertia_kg_m2 + planets * (pin.inertia_kg_m2 + pin.mass_kg * distance * distance)};
}

double shaft_torsion(double outer_diameter_mm, double inner_diameter_mm, double length_mm, double shear_modulus) {
  const double outer = outer_diameter_mm * m_per_mm;
  const double inner = inner_diameter_mm * m_per_mm;
  return shear_modulus * std::numbers::pi * (std::pow(outer, 4) - std::pow(inner, 4)) / (32.0 * length_mm * m_per_mm);
}

}  // namespace epicyclic::gear
