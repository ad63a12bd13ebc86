// Masses and moments of inertia of the members, as bodies of simple shape.
//
//   disc or ring   M = rho b pi (R^2 - r^2) ,  I = M (R^2 + r^2) / 2                                     [G-M]
//   carrier        discs (plates) and N pins on the centre distance: M = sum M_plate + N M_pin ,
//                  I = sum I_plate + N M_pin r_c^2 (+ each pin about its own axis)                       [G-Mc]
//
// A toothed body counts as a disc to the mean of tip and root radius. Source: any textbook; the mean radius is the
// convention of ISO 6336-1 for the moment of inertia of gear blanks. Limits: no webs, no rims, no oil.
#pragma once

#include "gear/material.hpp"
#include "gear/tooth.hpp"

namespace epicyclic::gear {

struct MassAndInertia {
  double mass_kg = 0;
  double inertia_kg_m2 = 0;
};

/// Hollow cylinder. @throws DomainError unless 0 <= inner < outer and the length is positive
[[nodiscard]] MassAndInertia cylinder(double outer_radius_mm, double inner_radius_mm, double length_mm,
                                      double density_kg_per_m3);

/// Mean of tip and root radius [mm].
[[nodiscard]] double body_radius_mm(const Tooth& tooth);

/// A carrier of plates and pins.
struct CarrierBody {
  int plates = 2;
  double plate_thickness_mm = 0;
  double outer_diameter_mm = 0;
  double inner_diameter_mm = 0;
  double pin_diameter_mm = 0;
  double pin_length_mm = 0;  ///< between the plates: what of a pin is within them counts as theirs
};

/// @param planets  one pin each, on the centre distance
[[nodiscard]] MassAndInertia carrier(const CarrierBody& body, int planets, double centre_distance_mm,
                                     double density_kg_per_m3);

/// Torsional stiffness G pi (D^4 - d^4) / (32 L) of a shaft [N m / rad].                                [G-GJ]
[[nodiscard]] double shaft_torsion(double outer_diameter_mm, double inner_diameter_mm, double length_mm,
                                   double shear_modulus_Pa);

}  // namespace epicyclic::gear
