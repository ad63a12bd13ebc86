// A planetary gear set, or a lone pair, computed from its catalogue data: teeth, pairs, phases, stiffness, friction,
// masses, tolerances.
//
//   inv alpha_sp from sun and planet without backlash, unless the centre distance is given               [G-a0]
//   tip shortening  k = x_s + x_p - y ,  y = (a - (z_s + z_p) m / 2) / m                                 [G-k-tip]
//   ring, base pitch of the planet:  m_r = m_p cos alpha_p / cos alpha_r                                 [G-mr]
//   lambda_sr = frac{ [ r_bp (pi + alpha_sp + alpha_rp + 2 alpha_2p) - (N N_sp - start_sp) - start_rp ] / p_b } [G-1]
//
// lambda_sr is the phase of the ring mesh when a tooth of planet 1 begins contact with the sun: with the planet between
// the axes' line, its tangent points stand at pi + alpha_sp and - alpha_rp on its base circle, its two flanks
// 2 alpha_2p apart; a flank's contact is an arc from its tangent point as long as the line from there. Source: derived
// here; it is Eq. (1)'s dec(F'_2 B_r2 / p_b) of Tang et al. 2020 in terms of the pairs' own lengths.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gear/accuracy.hpp"
#include "gear/catalogue.hpp"
#include "gear/loaded_contact.hpp"
#include "gear/mesh_stiffness.hpp"
#include "gear/stage.hpp"

namespace epicyclic::gear {

struct GearSet {
  Catalogue catalogue;
  std::vector<double> angles_deg;  ///< of the planets
  Tooth sun, planet, ring;         ///< no ring of a pair
  double centre_distance_mm = 0;
  double tip_shortening = 0;           ///< k of sun and planet [-]
  double ring_module_mm = 0;           ///< as used
  double base_pitch_mismatch_mm = 0;   ///< p_b of the planet minus that of the ring as its data stand
  MeshedPair sun_planet, ring_planet;  ///< driving member first: sun, planet; no ring_planet of a pair
  double ring_mesh_lead = 0;           ///< lambda_sr [-]
  FourierSeries sun_planet_stiffness, ring_planet_stiffness;

  [[nodiscard]] bool is_pair() const { return !catalogue.has_ring(); }
};

/// @param stage  planets and, if given, the centre distance; `stage.catalogue` is set
/// @throws DomainError if the data make no gear set: call catalogue_problems() first; InputError if options of the
/// stiffness are out of range
[[nodiscard]] GearSet make_gear_set(const Stage& stage);

/// Torque on the sun for the contact of modified flanks [N m]; nothing if neither it nor a torque as load is given.
[[nodiscard]] std::optional<double> design_torque_Nm(const Stage& stage);

/// What is wrong with the catalogue data, "pointer: message" with pointers relative to the stage; empty if all is well.
[[nodiscard]] std::vector<std::string> catalogue_problems(const Stage& stage);

/// Mesh phases of planet i at s = 0, in periods, in [0, 1): [M-phase].
struct PlanetPhases {
  double sun_planet, ring_planet;
};
[[nodiscard]] std::vector<PlanetPhases> planet_phases(const GearSet& set);

/// Do both meshes fit, by a hundredth of the module, with the opposite sign of the ring's profile shift, and do not as
/// it stands? Then its drawing has the other convention.
[[nodiscard]] bool ring_shift_has_other_sign(const GearSet& set);

/// Tooth numbers or profile shifts for which the two meshes require different centre distances, as the end of a
/// message, from "; " on; empty if there are none. Shifts are compared for members of one module and pressure angle.
[[nodiscard]] std::string ring_misfit(const GearSet& set);

/// Least gap between the tip circles of neighbouring planets [mm]; negative where they overlap.
[[nodiscard]] double planet_gap_mm(const GearSet& set);

/// The whole stiffness curve of a mesh, both sides of each breakpoint.
/// @param tolerance  of what is between its rows, relative to the mean [-]
[[nodiscard]] StiffnessCurve stiffness_curve(const MeshedPair& mesh,
                                             double tolerance = StiffnessOptions{}.table_tolerance);

/// The transmission error of modified flanks without load, at their places [G-secant].
/// @param tolerance  of what is between its rows, relative to the largest one [-]
[[nodiscard]] ErrorCurve error_curve(const LoadedContact& contact,
                                     double tolerance = StiffnessOptions{}.table_tolerance);

/// The contact of the meshes under the mean force of a torque on the sun, also of flanks without modification.
struct LoadedContacts {
  LoadedContact sun_planet;
  std::optional<LoadedContact> ring_planet;  ///< none of a pair
};
[[nodiscard]] LoadedContacts loaded_contacts(const GearSet& set, double torque_Nm);

/// Friction by lubricated contact of a mesh, with its load sharing.
[[nodiscard]] EhlFriction ehl_of(const MeshedPair& mesh, const Lubrication& lubrication);

/// Bodies of the members; the ring's and the carrier's only if their drawings are given.
struct Bodies {
  MassAndInertia sun, planet;
  std::optional<MassAndInertia> ring, carrier;
};
[[nodiscard]] Bodies bodies(const GearSet& set);

/// Tolerances of the members whose accuracy grade is given.
struct MemberTolerances {
  std::optional<Tolerances> sun, planet, ring;
};
[[nodiscard]] MemberTolerances member_tolerances(const GearSet& set);

/// Amplitude of a mesh's transmission error [um], from the larger tolerance of its two members; none without a grade.
///
///   E = f_f alpha / 2 (profile_form) ,  E = f_pt (single_pitch)                                        [G-error]
///
/// What all teeth of a gear have in common is periodic with the mesh, the rest with the shaft (Mark, J. Acoust. Soc.
/// Am. 63 (1978) 1409). Pitch deviations add up to 0 around a gear: their mean excites nothing at mesh frequency
/// (Welbourn, Proc. IMechE 184 (1970) 131). The form deviation is the width of the band that holds the trace of a
/// flank, the peak-to-peak value of a sine in it. The larger of both members counts, as for the dynamic factor of ISO
/// 6336-1.
[[nodiscard]] std::optional<double> error_amplitude_um(ErrorAmplitude from, const std::optional<Tolerances>& first,
                                                       const std::optional<Tolerances>& second);

/// The addendum coefficient that the tip radius of an internal tooth stands for [-].
[[nodiscard]] double addendum_of(const Tooth& ring);

/// Addendum coefficients of the ring that ring_addendum_bound() tests [-].
inline constexpr std::pair<double, double> ring_addenda_searched = {0.1, 3.0};

/// Greatest addendum coefficient of the ring with which the ring-planet mesh lies wholly beyond its pitch point, found
/// by search on the set itself [-].
/// @throws DomainError when there is none among ring_addenda_searched
[[nodiscard]] double ring_addendum_bound(const Stage& stage);

}  // namespace epicyclic::gear
