// Friction coefficient of a lubricated tooth contact (Xu), and the periodic ratios A(s), B(s) that follow along a path.
//
//   mu = exp(f) P_h^b2 |SR|^b3 V_e^b6 nu_0^b7 R^b8                                                      [G-5]
//   f  = b1 + b4 |SR| P_h log10 nu_0 + b5 exp(-|SR| P_h log10 nu_0) + b9 exp(S)                         [G-6]
//   P_h = sqrt(W' E' / (2 pi R))                                                                        [G-7]
//   SR = V_s / V_e ,  V_s = |V_1 - V_2| ,  V_e = (V_1 + V_2) / 2                                        [G-10]
//   A = sum_j L_j f_j ,  B = sum_j L_j f_j h_j ,  f_j = -mu_j sgn(V_1 - V_2)                            [G-AB]
//
// Units of the formula: P_h GPa, nu_0 mPa s, V_e m/s, R m, S um (RMS); W' GN/m, E' GPa. Source: Xu, Ph. D. thesis, Ohio
// State University 2005; Tang et al. 2020, Eqs. (5)-(10), whose Table 2 cuts the coefficients to 4 digits (here in
// full). Load share: that of the mean mesh force, quasi-static. Limits: Xu's regression was made for a 75W90 oil at
// about 0.5-2.5 GPa, 1-20 m/s, 5-100 mPa s and S 0.1-0.8 um; nu_0 below 1 mPa s would change the sign of the logarithm
// and is taken as 1. Smoothness: mu ~ |SR|^1.036 is continuous through the pitch point, with a kink there; jumps where
// a pair enters or leaves.
#pragma once

#include <span>

#include "gear/friction_path.hpp"
#include "gear/stage.hpp"

namespace epicyclic::gear {

/// What [G-5] depends on, in its own units.
struct LubricatedContact {
  double slide_to_roll = 0;    ///< SR [-]
  double pressure_GPa = 0;     ///< P_h
  double viscosity_mPas = 0;   ///< nu_0 at the oil's inlet
  double roughness_um = 0;     ///< S
  double rolling_m_per_s = 0;  ///< V_e
  double radius_m = 0;         ///< R
};

/// mu [-].
[[nodiscard]] double xu_friction_coefficient(const LubricatedContact& contact);

/// Is the contact within the range that the regression was made for?
[[nodiscard]] bool within_xu_range(const LubricatedContact& contact);

/// Extremes of pressure and rolling speed along a path, and whether all of it is within the range.
struct LubricationRange {
  double least_pressure_GPa, greatest_pressure_GPa;
  double least_rolling_m_per_s, greatest_rolling_m_per_s;
  bool within;
};

/// P_h of a line contact [GPa].
/// @param load_N_per_mm  W'
[[nodiscard]] double hertz_pressure(double load_N_per_mm, double equivalent_modulus_GPa, double radius_mm);

/// Load and speed that the friction of one operating point is computed for.
struct MeshLoad {
  double force_N = 0;             ///< mean mesh force F
  double base_speed_m_per_s = 0;  ///< omega_1 r_b1 = omega_2 r_b2, relative to the carrier
};

/// Each mesh of the static train transmits T_D / (N r_bs); both kinds of mesh run at the sun's base speed relative to
/// the carrier, omega_m p_b / 2 pi.
/// @param stage  passes problems_for_dynamics()
[[nodiscard]] MeshLoad mean_mesh_load(const Stage& stage, double mesh_frequency);

/// F / k_0: by what a mesh yields to the mean force [um].
[[nodiscard]] double static_deflection_um(const Mesh& mesh, const MeshLoad& load);

/// Load of both mean mesh forces on a planet's bearing [N].
[[nodiscard]] double mean_planet_load(const Stage& stage, double mesh_frequency);

/// The contact of the pair at a position [base pitches from the start of contact].
[[nodiscard]] LubricatedContact lubricated_contact(const EhlFriction& ehl, const LineOfAction& line,
                                                   const MeshLoad& load, double position, double load_share);

/// Along the rows of the load sharing.
[[nodiscard]] LubricationRange lubrication_range(const EhlFriction& ehl, const LineOfAction& line,
                                                 const MeshLoad& load);

/// A(s), B_1(s), B_2(s) on the mesh's own phase, two rows at each breakpoint: as many as table_tolerance requires,
/// closer towards the pitch point, beside which mu is as |SR|^1.036.
/// @param grids  those of another such table, in place of the tolerance: the same smooth parts, or this is a
///               DomainError
[[nodiscard]] FrictionTable friction_table(const EhlFriction& ehl, const LineOfAction& line, const MeshLoad& load,
                                           std::span<const IntervalGrid> grids = {});

}  // namespace epicyclic::gear
