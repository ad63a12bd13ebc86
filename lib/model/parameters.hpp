// Dimensionless constants of one operating point, folded once before integration.
//
// Everything that a right-hand side needs and nothing that it could compute itself: sines and cosines of fixed angles,
// inverse masses, Fourier coefficients already rotated to each planet's phase, so that with s the common mesh phase
//
//   s_spi = s - z_s (phi_i - phi_1) ,  s_rpi = s + z_r (phi_i - phi_1) + 2 pi lambda_sr                  [M-phase]
//   k_i(s) = k_0 + sum_h [ C_hi cos h s + S_hi sin h s ]  or a table over s_i                            [M-4]
//   e_i(s) = sum_h [ a_hi cos h s + b_hi sin h s ] + e_0i   from   E_i sin(s_i + phi_0i), harmonics and constant
//            errors, and a table over s_i                                                                [M-e]
//
// Units: displacements in b_c, time in tau, masses in m_0 (model/scales.hpp). Source: docs/theory/model.md, section 5;
// Eq. (4) with a time shift inside the cosine, Eq. (1) with opposite signs. T is the scalar of the kernel: one lane,
// one parameter point.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include "core/row.hpp"
#include "core/scalar.hpp"
#include "gear/stage.hpp"
#include "model/friction_track.hpp"
#include "model/options.hpp"
#include "model/scales.hpp"

namespace epicyclic::model {

/// Errors that repeat with a member's rotation relative to the carrier [M-shaft]:
/// sum_h [ A_hi cos(h nu s) + B_hi sin(h nu s) ].
template <class T, std::size_t N>
struct ShaftErrors {
  T order;                              ///< nu = 1 / teeth
  std::vector<Row<T, N>> cosine, sine;  ///< A_hi, B_hi; [harmonics][N]
};

/// One kind of mesh of N planets.
template <class T, std::size_t N>
struct MeshParameters {
  Row<T, N> sine{}, cosine{};  ///< of phi_spi = alpha_sp - phi_i, or phi_rpi = alpha_rp + phi_i
  T half_gap;                  ///< b
  T damping;                   ///< c
  T stiffness;                 ///< k_0
  std::size_t harmonics = 0;
  std::vector<Row<T, N>> stiffness_cos, stiffness_sin;          ///< C_hi, S_hi; [harmonics][N]
  Row<T, N> error_cos{}, error_sin{};                           ///< a_1i, b_1i
  std::vector<Row<T, N>> further_error_cos, further_error_sin;  ///< a_hi, b_hi, h = 2, 3, ...; as many of both
  Row<T, N> error_mean{};                                       ///< e_0i [M-e]
  std::vector<ShaftErrors<T, N>> shafts;                        ///< one for each member with errors of its own
  std::shared_ptr<const PeriodicTrack<1>> stiffness_curve;      ///< in place of k_0 and harmonics; null without
  std::shared_ptr<const PeriodicTrack<3>> error_curve;          ///< e and de/ds [M-e-curve]; null without
  std::shared_ptr<const FrictionTrack> friction;                ///< null without friction
  Row<double, N> phase_cycles{};                                ///< mesh phase of planet i over 2 pi, at s = 0
  bool in_phase = false;                                        ///< the same for all planets, to rounding
};

/// Places of one kind of mesh in its tables while s is between two neighbouring breakpoints.
template <std::size_t N>
struct MeshPlaces {
  std::array<TrackPlace, N> stiffness, friction, error;
};

template <std::size_t N>
struct Segment {
  MeshPlaces<N> sun_planet, ring_planet;
};

template <class T, std::size_t N>
struct Parameters {
  T omega;                         ///< Omega = omega_m / omega_sn
  Row<T, N> sin_phi{}, cos_phi{};  ///< of the planets' angles
  T cos_alpha_sp, cos_alpha_rp;
  T mass_s, mass_r, mass_c;                          ///< M
  T inertia_s, inertia_r, inertia_c;                 ///< I / r^2
  T inverse_mass_s, inverse_mass_r, inverse_mass_c;  ///< 1 / M
  T inverse_inertia_s, inverse_inertia_r, inverse_inertia_c;
  Row<T, N> mass_p{}, inertia_p{}, inverse_mass_p{}, inverse_inertia_p{};  ///< of each planet
  T planets_mass;                                                          ///< sum M_p
  T support_s, support_r, support_c;                                       ///< k of the translations
  T damping_s, damping_r, damping_c;                                       ///< c of the translations
  T torsion_r, torsion_c;                                                  ///< k_ru, k_cu
  T torsion_damping_r, torsion_damping_c;
  Row<T, N> bearing_p{}, bearing_damping_p{};  ///< k_p, c_p of each planet
  bool planet_gap = false;                     ///< is a clearance of the planets' bearings given?
  T planet_half_gap;                           ///< b_p
  T sun_half_gap;                              ///< b_s
  gear::BearingLaw sun_law = gear::BearingLaw::linear_xy;
  T sun_hertz;                        ///< K of the Palmgren laws, force K d^(3/2)
  T drive, ring_drive, carrier_load;  ///< T_D / r_bs, T_r / r_br, T_c / r_c
  /// k_su, c_su of a sun that is held; of a pair [M-pair]: k_u and c_u of gear 1 and gear 2, T_2 / r_b2.
  T torsion_s, torsion_p, torsion_damping_s, torsion_damping_p, output_load;
  std::size_t torque_harmonics = 0;
  std::vector<T> input_cos, input_sin, output_cos, output_sin;  ///< over the mean torques; [torque_harmonics]
  MeshParameters<T, N> sun_planet, ring_planet;
  T carrier_speed;          ///< omega_c / omega_sn; 0 if the gyroscopic terms are off
  Row<T, N> centrifugal{};  ///< M_p omega_c^2 r_c of each planet [M-cf]; 0 if it is left out
  gear::Boundary boundary = gear::Boundary::fixed_ring;
  bool gyroscopic_relative = false;     ///< planets' terms in X_i, Y_i with their reaction on the carrier [M-inv]
  bool gyroscopic_carrier_row = false;  ///< N M_p omega_c^2 u_c added to the carrier row
  bool smooth = false;
  T smoothing;  ///< w
  GapDamping gap_damping = GapDamping::always;
  int mesh_periods = 1;                   ///< mesh periods after which everything repeats
  std::vector<double> breakpoints;        ///< of the common s, in [0, 2 pi mesh_periods), rising
  std::vector<Segment<N>> segments;       ///< segment k follows breakpoint k (the last one wraps); one if no breakpoint
  std::vector<double> sampling_interval;  ///< of g in each segment [M-rows]
};

/// Sines and cosines only: what deflections() of model/right_hand_side.hpp needs.
///
/// @param stage  passes gear::problems_for_modes()
template <std::size_t N>
[[nodiscard]] Parameters<double, N> make_geometry(const gear::Stage& stage);

/// Folds a stage at one operating point.
///
/// @param stage   passes gear::problems_for_dynamics()
/// @param scales  those of the stage as given, whatever a sweep has changed in `stage` since
/// @param mesh_frequency_ratio Omega [-]
/// @param like    whose computed tables' grids are taken, so that rows can be compared; null: as their errors require
/// @throws InputError for options that do not fit the boundary
template <std::size_t N>
[[nodiscard]] Parameters<double, N> make_parameters(const gear::Stage& stage, const Scales& scales,
                                                    double mesh_frequency_ratio, const ModelOptions& options,
                                                    const Parameters<double, N>* like = nullptr);

/// f(constant) for each constant of the scalar type, in a fixed order: sums, differences and conversions of whole sets.
template <class P, class F>
void for_each_constant(P& p, const F& f) {
  const auto all = [&](auto& array) {
    for (std::size_t i = 0; i < array.size(); ++i) {
      auto x = array[i];
      f(x);
      if constexpr (!std::is_const_v<std::remove_reference_t<decltype(array)>>) array.set(i, x);
    }
  };
  const auto mesh = [&](auto& m) {
    all(m.sine);
    all(m.cosine);
    f(m.half_gap);
    f(m.damping);
    f(m.stiffness);
    for (auto& harmonic : m.stiffness_cos) all(harmonic);
    for (auto& harmonic : m.stiffness_sin) all(harmonic);
    all(m.error_cos);
    all(m.error_sin);
    all(m.error_mean);
    for (auto& shaft : m.shafts) {
      f(shaft.order);
      for (auto& harmonic : shaft.cosine) all(harmonic);
      for (auto& harmonic : shaft.sine) all(harmonic);
    }
    for (auto& harmonic : m.further_error_cos) all(harmonic);
    for (auto& harmonic : m.further_error_sin) all(harmonic);
  };
  const auto each = [&](auto&... constants) { (f(constants), ...); };
  f(p.omega);
  all(p.sin_phi);
  all(p.cos_phi);
  each(p.cos_alpha_sp, p.cos_alpha_rp);
  each(p.mass_s, p.mass_r, p.mass_c, p.planets_mass);
  each(p.inertia_s, p.inertia_r, p.inertia_c);
  each(p.inverse_mass_s, p.inverse_mass_r, p.inverse_mass_c);
  each(p.inverse_inertia_s, p.inverse_inertia_r, p.inverse_inertia_c);
  for (auto* row : {&p.mass_p, &p.inertia_p, &p.inverse_mass_p, &p.inverse_inertia_p, &p.bearing_p,
                    &p.bearing_damping_p, &p.centrifugal})
    all(*row);
  each(p.support_s, p.support_r, p.support_c);
  each(p.damping_s, p.damping_r, p.damping_c);
  each(p.torsion_r, p.torsion_c, p.torsion_damping_r, p.torsion_damping_c);
  each(p.planet_half_gap, p.sun_half_gap, p.sun_hertz);
  each(p.drive, p.ring_drive, p.carrier_load);
  each(p.torsion_s, p.torsion_p, p.torsion_damping_s, p.torsion_damping_p, p.output_load);
  for (auto* list : {&p.input_cos, &p.input_sin, &p.output_cos, &p.output_sin})
    for (auto& ratio : *list) f(ratio);
  mesh(p.sun_planet);
  mesh(p.ring_planet);
  each(p.carrier_speed, p.smoothing);
}

/// All of them in that order.
template <std::size_t N>
[[nodiscard]] std::vector<double> constant_values(const Parameters<double, N>& p);

/// All but the constants, which are of another scalar type and not set to anything; tables as they are.
template <class T, std::size_t N>
[[nodiscard]] Parameters<T, N> without_constants(const Parameters<double, N>& p) {
  Parameters<T, N> r;
  const auto mesh = [](const MeshParameters<double, N>& from, MeshParameters<T, N>& to) {
    to.harmonics = from.harmonics;
    to.stiffness_cos.resize(from.stiffness_cos.size());
    to.stiffness_sin.resize(from.stiffness_sin.size());
    to.further_error_cos.resize(from.further_error_cos.size());
    to.further_error_sin.resize(from.further_error_sin.size());
    to.stiffness_curve = from.stiffness_curve;
    to.error_curve = from.error_curve;
    to.friction = from.friction;
    to.phase_cycles = from.phase_cycles;
    to.in_phase = from.in_phase;
    to.shafts.resize(from.shafts.size());
    for (std::size_t k = 0; k < from.shafts.size(); ++k) {
      to.shafts[k].cosine.resize(from.shafts[k].cosine.size());
      to.shafts[k].sine.resize(from.shafts[k].sine.size());
    }
  };
  mesh(p.sun_planet, r.sun_planet);
  mesh(p.ring_planet, r.ring_planet);
  r.torque_harmonics = p.torque_harmonics;
  for (auto* list : {&r.input_cos, &r.input_sin, &r.output_cos, &r.output_sin}) list->resize(p.torque_harmonics);
  r.sun_law = p.sun_law;
  r.boundary = p.boundary;
  r.mesh_periods = p.mesh_periods;
  r.planet_gap = p.planet_gap;
  r.gyroscopic_relative = p.gyroscopic_relative;
  r.gyroscopic_carrier_row = p.gyroscopic_carrier_row;
  r.smooth = p.smooth;
  r.gap_damping = p.gap_damping;
  r.breakpoints = p.breakpoints;
  r.segments = p.segments;
  r.sampling_interval = p.sampling_interval;
  return r;
}

/// Constants of doubles in another scalar type; tables as they are.
template <class T, std::size_t N>
[[nodiscard]] Parameters<T, N> convert(const Parameters<double, N>& p) {
  auto r = without_constants<T>(p);
  const std::vector<double> constants = constant_values(p);
  auto next = constants.begin();
  for_each_constant(r, [&](T& x) { x = T(*next++); });
  return r;
}

}  // namespace epicyclic::model
