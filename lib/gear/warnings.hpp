// Warnings: values that are allowed but rarely meant, with the number that shows it, ranked.
//
//   backlash        j_bn > 4 (2/3)(0.06 + 0.0005 a + 0.03 m) mm, four times the least that ISO/TR 10064-2
//                   recommends; or some, but below a hundredth of it
//   tip clearance   outside 0.1 to 0.6 m
//   sun's bearing   half clearance > m / 2: the sun may leave the mesh
//   error           amplitude > F_p of the coarsest grade of ISO 1328-1, its total pitch deviation
//   support         yields to the member's own weight by more than m
//   friction        another kind in one mesh than in the other
//   form            contact more than 0.1 m below the end of the rack-cut involute; less is a note. It is counted in
//   the
//                   path of contact and all that follows from it
//   speed           rho v^2 > 1000 MPa, the hoop stress of a thin ring at the base circle's speed (or at that of the
//                   planets' axes): the tensile strength of quenched and tempered gear steels
//   force           Hertz's pressure of the mean mesh force, load shared, > 2.64 GPa: sigma_H,lim 1650 MPa of the best
//                   case-hardened steel (ISO 6336-5, ME) times Z_NT = 1.6 of a static load (ISO 6336-2); or < 20 MPa,
//                   which is no load
//   deflection      of a mesh, a planet's bearing or a torsional support under the static load, > m
//   damping         at or above critical: zeta >= 1, c >= 2 sqrt(k m); of a mesh below 0.003, of a support none
//   mass            3 times that of the body on the drawing, or a third of it; a radius of gyration of twice the
//                   member's radius; I / r^2 below a tenth of the mass, where a solid disc has half of it
//   sign            of the ring's profile shift: with the opposite one both meshes fit, as it stands they do not
//   assembly        (z_s + z_r)(phi_i - phi_1) / 2 pi not whole: a planet's teeth fit one mesh alone
//   stiffness       of a mesh more than 30 % from c_gamma of [G-iso], ISO 6336-1:2006, 9.3: that is how far models of
//                   this kind differ
//   mean            stiffness of a mesh more than 1 % from the one that its harmonics were computed with
//   truncation      harmonics whose variation is more than 5 % off that of the curve that they stand for
//   width           of a gear 1.5 times that of the one it meshes with: what overhangs bears nothing
//   density         below 900 or above 20000 kg/m^3: no solid that gears are made of
//   carrier         pins' axes outside of the plates, pins thicker than the planets' bore or shorter than their width,
//                   plates thinner than 0.02 of it
//   rim             under external teeth thinner than 1.2 tooth heights, under a ring's than 3.5 m, where ISO 6336-3
//                   begins to count its bending (Y_B); [G-kf], [G-kfr] have no rim
//
// A stage without catalogue data has m = 2 r_bp / (z_p cos 20 deg). Bounds are wide: they find a wrong unit or tooth
// count, not an unusual design. Limits: nominal loads, no dynamic factor; no tooth-root stress.
#pragma once

#include <string>
#include <vector>

#include "gear/gear_set.hpp"
#include "gear/messages.hpp"
#include "gear/stage.hpp"

namespace epicyclic::gear {

/// What is allowed but rarely meant about the drawings: thin tips, undercut, little room, formulas out of range.
[[nodiscard]] std::vector<Warning> catalogue_warnings(const GearSet& set);

/// Data of the stage that do not fit its drawings: masses, mesh stiffness.
[[nodiscard]] std::vector<Warning> catalogue_warnings(const GearSet& set, const Stage& stage);

/// Masses and inertias of a stage without drawings against each other, whether it moves or is for modes alone.
[[nodiscard]] std::vector<Warning> mass_warnings(const Stage& stage);

/// Loss of variation of the mesh stiffness by the computed harmonics, if more than 5 % of it, peak to peak; none if the
/// stage has harmonics or a curve of its own.
[[nodiscard]] std::vector<Warning> truncation_warnings(const GearSet& set, const Stage& stage);

/// What is allowed but rarely meant in time integration: planets that cannot be assembled, supports without damping or
/// with more than critical, wide gaps. A stage for modes alone gets the warnings that its values allow.
[[nodiscard]] std::vector<Warning> warnings_for_dynamics(const Stage& stage);

/// Speeds, forces and deflections at an operating point; none of a stage that does not pass problems_for_dynamics().
/// @param mesh_frequency  omega_m [rad/s]
/// @param set  of the stage's catalogue data, for the pressure of its flanks; without it that of lubricated contact
[[nodiscard]] std::vector<Warning> warnings_at(const Stage& stage, double mesh_frequency, const GearSet* set = nullptr);

}  // namespace epicyclic::gear
