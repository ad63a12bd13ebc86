// The equations of motion, once, for every scalar type, number of planets and layout.
//
//   delta_spi = (x_s - x_pi) sin phi_spi + (y_s - y_pi) cos phi_spi + u_s + u_pi - e_spi                 [M-13]
//   delta_rpi = (x_pi - x_r) sin phi_rpi - (y_pi - y_r) cos phi_rpi + u_r - u_pi - e_rpi                 [M-14]
//   delta_picx = x_pi - x_c + u_c sin phi_i ,  delta_picy = y_pi - y_c - u_c cos phi_i                   [M-15]
//   F = k(s) f(delta, b) + c delta' ,  F_f = A(s) F ,  moments B(s) F                                    [M-27]
//   rows of sun, planets, ring, carrier                                                                  [M-17]..[M-20]
//   a pair: gear 1 as the sun, gear 2 as a planet on a bearing of its own, torque T_2 on it              [M-pair]
//   planets' rotating-frame terms: printed, or invariant in X_i = x_pi + u_c sin phi_i, Y_i = ...        [M-inv]
//
// all dimensionless (model/scales.hpp), the prime d/d tau; the state is advanced in the mesh phase s = Omega tau, so
// dy/ds = (dy/d tau) / Omega. Source: Tang et al. 2020, Eqs. (13)-(20), (27), in the consistent form of
// docs/theory/model.md. Limits: isotropic planet bearings (k_pix = k_piy = k_picu), one half gap per kind of mesh; the
// back flank keeps the line of action of the drive flank, as Eq. (27) does. T is the scalar of the state, P that of the
// parameters and of the phase: the same, or dual numbers and plain ones, so that tangents do not include the
// derivatives of constants. Smoothness: C0 in the state with kinks at delta = +-b (analytic for w > 0); with
// contact-slope damping and w = 0 it jumps there; in s analytic but for jumps of friction and of a stiffness curve at
// `breakpoints`.
//
// Planets are computed in groups. If a register holds one value of each planet, all are one group. Lanes take them one
// by one, so that the values of a planet stay in registers.
#pragma once

#include <cstddef>
#include <limits>
#include <type_traits>

#include "core/scalar.hpp"
#include "model/clearance.hpp"
#include "model/layout.hpp"
#include "model/parameters.hpp"
#include "model/phase_coefficients.hpp"
#include "model/stage_outputs.hpp"

namespace epicyclic::model {

/// Relative displacements without errors, or their rates: the linear part of [M-13], [M-14], [M-15].
template <class T, std::size_t N>
struct Deflections {
  Row<T, N> sun_planet, ring_planet;
  Row<T, N> carrier_x, carrier_y, carrier_u;
};

template <class T, class P, std::size_t N, std::size_t G>
[[nodiscard]] Deflections<T, G> deflections(const Parameters<P, N>& p, const Planets<N, G>& planets,
                                            const Coordinates<T, G>& q) {
  Deflections<T, G> d;
  const auto& sp = p.sun_planet;
  const auto& rp = p.ring_planet;
  const auto& sin_phi = planets(p.sin_phi);
  const auto& cos_phi = planets(p.cos_phi);
  d.sun_planet = (q.x_s - q.x_p) * planets(sp.sine) + (q.y_s - q.y_p) * planets(sp.cosine) + q.w_s + q.w_p;
  d.ring_planet = (q.x_p - q.x_r) * planets(rp.sine) - (q.y_p - q.y_r) * planets(rp.cosine) + q.u_r - q.w_p;
  d.carrier_x = q.x_p - q.x_c + q.u_c * sin_phi;
  d.carrier_y = q.y_p - q.y_c - q.u_c * cos_phi;
  d.carrier_u = -(q.x_p - q.x_c) * sin_phi + (q.y_p - q.y_c) * cos_phi - q.u_c;
  return d;
}

template <class T, class P, std::size_t N>
[[nodiscard]] Deflections<T, N> deflections(const Parameters<P, N>& p, const Coordinates<T, N>& q) {
  return deflections(p, Planets<N>{}, q);
}

/// Everything that one kind of mesh does at one instant.
template <class T, std::size_t N, class P = T>
struct MeshState {
  Row<T, N> delta, rate;     ///< delta and delta' with errors
  Row<P, N> stiffness;       ///< k_i(s)
  Row<T, N> elastic;         ///< k f(delta)
  Row<T, N> force;           ///< F
  Row<T, N> friction;        ///< F_f = A F
  Row<T, N> moment_driving;  ///< F_f h_1 / r_b1 = B_1 F / r_b1
  Row<T, N> moment_driven;   ///< F_f h_2 / r_b2
};

/// [M-27] of one kind of mesh, given what the phase decides.
template <class T, class P, std::size_t N, std::size_t G>
[[nodiscard]] MeshState<T, G, P> mesh_state(const Parameters<P, N>& p, const Planets<N, G>& planets,
                                            const MeshParameters<P, N>& mesh, const MeshCoefficients<P, N>& now,
                                            const Row<T, G>& displacement, const Row<T, G>& velocity) {
  using R = Row<T, G>;
  MeshState<T, G, P> m;
  m.delta = now.delta(planets, displacement);
  m.rate = now.rate(planets, velocity);
  m.stiffness = now.each(planets, now.stiffness);
  m.elastic = m.stiffness * closed_by<R>(m.delta, mesh.half_gap, p.smoothing, p.smooth);
  if (p.gap_damping == GapDamping::contact_slope) {
    m.force = m.elastic + mesh.damping * closure<R>(m.delta, mesh.half_gap, p.smoothing, p.smooth).slope * m.rate;
  } else {
    m.force = m.elastic + mesh.damping * m.rate;
  }
  if (mesh.friction) {
    m.friction = now.each(planets, now.friction) * m.force;
    m.moment_driving = now.each(planets, now.moment_driving) * m.force;
    m.moment_driven = now.each(planets, now.moment_driven) * m.force;
  } else {
    m.friction = m.moment_driving = m.moment_driven = T(0.0);
  }
  return m;
}

/// Force of the sun's bearing on its inner ring, per direction; acts against (x, y).
template <class T>
struct BearingForce {
  T x, y;
};

template <class T, class P, std::size_t N>
[[nodiscard]] BearingForce<T> sun_bearing_force(const Parameters<P, N>& p, const T& x, const T& y) {
  using epicyclic::power_3_2;
  using gear::BearingLaw;
  const auto gap = [&](const T& d) { return closed_by(d, p.sun_half_gap, p.smoothing, p.smooth); };
  // k(d) d of [G-11], odd in the closure d
  const auto hertz = [&](const T& d) {
    const T magnitude = select(d > T(0.0), d, T(-d));
    return select(d > T(0.0), T(1.0), T(-1.0)) * p.sun_hertz * power_3_2(magnitude);
  };
  switch (p.sun_law) {
    case BearingLaw::linear_xy:
      return {p.support_s * gap(x), p.support_s * gap(y)};
    case BearingLaw::palmgren_xy:
      return {hertz(gap(x)), hertz(gap(y))};
    case BearingLaw::linear_radial: {
      const T factor = p.support_s * radial_closure_factor(safe_radius(x, y), p.sun_half_gap, p.smoothing, p.smooth);
      return {factor * x, factor * y};
    }
    case BearingLaw::palmgren_radial: {
      const T r = safe_radius(x, y);
      const T closed = r * radial_closure_factor(r, p.sun_half_gap, p.smoothing, p.smooth);
      const T factor = (2.0 / 3.0) * p.sun_hertz * power_3_2(closed) / r;
      return {factor * x, factor * y};
    }
  }
  return {T(0.0), T(0.0)};
}

/// Part of its displacement by which the bearing of each planet is pressed, f(r, b_p) / r with the radius r of
/// delta_picx and delta_picy [M-gap-p].
template <class T, class P, std::size_t N, std::size_t G>
[[nodiscard]] Row<T, G> planet_bearing_factor(const Parameters<P, N>& p, const Deflections<T, G>& d) {
  return radial_closure_factor(safe_radius(d.carrier_x, d.carrier_y), p.planet_half_gap, p.smoothing, p.smooth);
}

/// Forces of the stage at one instant, before they act on masses, with a group of G planets. Each part is made where it
/// stays: copies of it would cost as much as its arithmetic.
template <class T, std::size_t G, class P = T>
struct StageState {
  Coordinates<T, G> q, v;
  Deflections<T, G> d, d_rate;
  MeshState<T, G, P> sun_planet, ring_planet;

  template <std::size_t N>
  StageState(Layout layout, const Parameters<P, N>& p, const Planets<N, G>& planets, const PhaseCoefficients<P, N>& now,
             const T* y)
      : q(unpack(layout, planets, y)),
        v(unpack(layout, planets, y + degrees_of_freedom(layout, N))),
        d(deflections(p, planets, q)),
        d_rate(deflections(p, planets, v)),
        sun_planet(mesh_state(p, planets, p.sun_planet, now.sun_planet, d.sun_planet, d_rate.sun_planet)),
        ring_planet(ring_state(p, planets, now)) {}

 private:
  template <std::size_t N>
  MeshState<T, G, P> ring_state(const Parameters<P, N>& p, const Planets<N, G>& planets,
                                const PhaseCoefficients<P, N>& now) const {
    if constexpr (N == 1) {
      MeshState<T, G, P> none;  // a pair has no ring
      none.stiffness = P(0.0);
      none.delta = none.rate = none.elastic = none.force = T(0.0);
      none.friction = none.moment_driving = none.moment_driven = T(0.0);
      return none;
    } else {
      return mesh_state(p, planets, p.ring_planet, now.ring_planet, d.ring_planet, d_rate.ring_planet);
    }
  }
};

/// With all planets.
template <class T, class P, std::size_t N>
[[nodiscard]] StageState<T, N, P> stage_state(Layout layout, const Parameters<P, N>& p, std::size_t segment,
                                              const std::type_identity_t<P>& s, const T* y) {
  return {layout, p, Planets<N>{}, PhaseCoefficients<P, N>(p, segment, s), y};
}

/// Sums over planets of what they do to the other members.
template <class T>
struct Reactions {
  T sun_x, sun_y, sun_u;              ///< of the sun's meshes
  T ring_x, ring_y, ring_u;           ///< of the ring's
  T carrier_x, carrier_y, carrier_u;  ///< of the planets' bearings
  T frame_u;                          ///< of their rotating-frame terms, on the carrier

  Reactions& operator+=(const Reactions& b) {
    sun_x += b.sun_x;
    sun_y += b.sun_y;
    sun_u += b.sun_u;
    ring_x += b.ring_x;
    ring_y += b.ring_y;
    ring_u += b.ring_u;
    carrier_x += b.carrier_x;
    carrier_y += b.carrier_y;
    carrier_u += b.carrier_u;
    frame_u += b.frame_u;
    return *this;
  }
};

/// Planets [M-18], full accelerations d^2/d tau^2.
/// @returns what they do to sun, ring and carrier
template <class T, class P, std::size_t N, std::size_t G>
[[nodiscard]] Reactions<T> accelerate_planets(const Parameters<P, N>& p, const Planets<N, G>& planets,
                                              const StageState<T, G, P>& g, Coordinates<T, G>& a) {
  using R = Row<T, G>;
  const Coordinates<T, G>& q = g.q;
  const Coordinates<T, G>& v = g.v;
  const MeshState<T, G, P>& sp = g.sun_planet;
  const MeshState<T, G, P>& rp = g.ring_planet;
  const auto& sin_sp = planets(p.sun_planet.sine);
  const auto& cos_sp = planets(p.sun_planet.cosine);
  const auto& sin_rp = planets(p.ring_planet.sine);
  const auto& cos_rp = planets(p.ring_planet.cosine);
  const auto& sin_phi = planets(p.sin_phi);
  const auto& cos_phi = planets(p.cos_phi);
  const P& wc = p.carrier_speed;
  const P wc2 = wc * wc;
  Reactions<T> r;

  r.sun_x = sum(sp.force * sin_sp + sp.friction * cos_sp);
  r.sun_y = sum(sp.force * cos_sp - sp.friction * sin_sp);
  r.sun_u = sum(sp.force - sp.moment_driving);

  const auto& bearing = planets(p.bearing_p);
  const auto& bearing_damping = planets(p.bearing_damping_p);
  const auto& inverse_mass = planets(p.inverse_mass_p);
  const auto& inverse_inertia = planets(p.inverse_inertia_p);
  R spring_x = bearing * g.d.carrier_x;
  R spring_y = bearing * g.d.carrier_y;
  R spring_u = bearing * g.d.carrier_u;
  if (p.planet_gap) {
    const R closed = planet_bearing_factor(p, g.d);
    spring_x = closed * spring_x;
    spring_y = closed * spring_y;
    spring_u = closed * spring_u;
  }
  spring_x += bearing_damping * g.d_rate.carrier_x;
  spring_y += bearing_damping * g.d_rate.carrier_y;
  spring_u += bearing_damping * g.d_rate.carrier_u;
  r.carrier_x = sum(spring_x);
  r.carrier_y = sum(spring_y);
  r.carrier_u = sum(spring_u);

  if constexpr (N == 1) {
    a.x_p = (sp.force * sin_sp + sp.friction * cos_sp - spring_x) * inverse_mass;
    a.y_p = (sp.force * cos_sp - sp.friction * sin_sp - spring_y) * inverse_mass;
    a.w_p = (sp.moment_driven - sp.force) * inverse_inertia;
    r.ring_x = r.ring_y = r.ring_u = r.frame_u = T(0.0);
    return r;
  }

  R x = q.x_p;
  R y = q.y_p;
  R x_rate = v.x_p;
  R y_rate = v.y_p;
  if (p.gyroscopic_relative) {
    x += q.u_c * sin_phi;
    y -= q.u_c * cos_phi;
    x_rate += v.u_c * sin_phi;
    y_rate -= v.u_c * cos_phi;
  }
  const auto& mass = planets(p.mass_p);
  const auto& centrifugal = planets(p.centrifugal);
  const R frame_x = mass * (wc2 * x + 2.0 * wc * y_rate);
  const R frame_y = mass * (wc2 * y - 2.0 * wc * x_rate);
  if (p.gyroscopic_relative) {
    r.frame_u = sum(frame_x * sin_phi - frame_y * cos_phi);
  } else {
    r.frame_u = T(0.0);
  }

  a.x_p = (frame_x + centrifugal * cos_phi - spring_x + sp.force * sin_sp + sp.friction * cos_sp - rp.force * sin_rp -
           rp.friction * cos_rp) *
          inverse_mass;
  a.y_p = (frame_y + centrifugal * sin_phi - spring_y + sp.force * cos_sp - sp.friction * sin_sp + rp.force * cos_rp -
           rp.friction * sin_rp) *
          inverse_mass;
  a.w_p = (-sp.force + sp.moment_driven + rp.force - rp.moment_driving) * inverse_inertia;

  r.ring_x = sum(rp.force * sin_rp + rp.friction * cos_rp);
  r.ring_y = sum(rp.force * cos_rp - rp.friction * sin_rp);
  r.ring_u = sum(rp.force - rp.moment_driven);
  return r;
}

/// Gear 1 of a pair, and the torque and torsional support of gear 2 [M-pair].
template <class T, class P>
void accelerate_pair(const Parameters<P, 1>& p, const TorqueRatios<P>& torques, const Coordinates<T, 1>& q,
                     const Coordinates<T, 1>& v, const Reactions<T>& r, Coordinates<T, 1>& a) {
  const BearingForce<T> bearing = sun_bearing_force(p, q.x_s, q.y_s);
  a.x_s = (-bearing.x - p.damping_s * v.x_s - r.sun_x) * p.inverse_mass_s;
  a.y_s = (-bearing.y - p.damping_s * v.y_s - r.sun_y) * p.inverse_mass_s;
  a.w_s = (p.drive * torques.input - p.torsion_s * q.w_s - p.torsion_damping_s * v.w_s - r.sun_u) * p.inverse_inertia_s;
  a.w_p += (p.output_load * torques.output - p.torsion_p * q.w_p - p.torsion_damping_p * v.w_p) * p.inverse_inertia_p;
  a.x_r = a.y_r = a.u_r = a.x_c = a.y_c = a.u_c = T(0.0);
}

/// Sun [M-17], ring [M-19] and carrier [M-20], full accelerations.
template <class T, class P, std::size_t N, std::size_t G, class Torques>
void accelerate_members(const Parameters<P, N>& p, const Torques& torques, const Coordinates<T, G>& q,
                        const Coordinates<T, G>& v, const Reactions<T>& r, Coordinates<T, N>& a) {
  if constexpr (N == 1) return accelerate_pair(p, torques, q, v, r, a);
  const P& wc = p.carrier_speed;
  const P wc2 = wc * wc;

  const BearingForce<T> bearing = sun_bearing_force(p, q.x_s, q.y_s);
  const T sun_x = -bearing.x - p.damping_s * v.x_s - r.sun_x;
  const T sun_y = -bearing.y - p.damping_s * v.y_s - r.sun_y;
  T sun_u = p.drive - r.sun_u;
  if (p.boundary == gear::Boundary::fixed_sun) sun_u -= p.torsion_s * q.w_s + p.torsion_damping_s * v.w_s;
  a.x_s = sun_x * p.inverse_mass_s + 2.0 * wc * v.y_s + wc2 * q.x_s;
  a.y_s = sun_y * p.inverse_mass_s - 2.0 * wc * v.x_s + wc2 * q.y_s;
  a.w_s = sun_u * p.inverse_inertia_s;

  const T ring_x = -p.support_r * q.x_r - p.damping_r * v.x_r + r.ring_x;
  const T ring_y = -p.support_r * q.y_r - p.damping_r * v.y_r - r.ring_y;
  const T ring_u = -p.torsion_r * q.u_r - p.torsion_damping_r * v.u_r + p.ring_drive - r.ring_u;
  a.x_r = ring_x * p.inverse_mass_r + 2.0 * wc * v.y_r + wc2 * q.x_r;
  a.y_r = ring_y * p.inverse_mass_r - 2.0 * wc * v.x_r + wc2 * q.y_r;
  a.u_r = ring_u * p.inverse_inertia_r;

  const T carrier_x = -p.support_c * q.x_c - p.damping_c * v.x_c + r.carrier_x;
  const T carrier_y = -p.support_c * q.y_c - p.damping_c * v.y_c + r.carrier_y;
  T carrier_u = -p.torsion_c * q.u_c - p.torsion_damping_c * v.u_c - p.carrier_load + r.carrier_u;
  if (p.gyroscopic_relative) carrier_u += r.frame_u;
  if (p.gyroscopic_carrier_row) carrier_u -= p.planets_mass * wc2 * q.u_c;
  a.x_c = carrier_x * p.inverse_mass_c + 2.0 * wc * v.y_c + wc2 * q.x_c;
  a.y_c = carrier_y * p.inverse_mass_c - 2.0 * wc * v.x_c + wc2 * q.y_c;
  a.u_c = carrier_u * p.inverse_inertia_c;
}

/// Accelerations d^2/d tau^2 of the full coordinates from [M-17]..[M-20].
template <class T, class P, std::size_t N, class Torques = ConstantTorques>
[[nodiscard]] Coordinates<T, N> accelerations(const Parameters<P, N>& p, const StageState<T, N, P>& g,
                                              const Torques& torques = {}) {
  Coordinates<T, N> a;
  const Reactions<T> r = accelerate_planets(p, Planets<N>{}, g, a);
  accelerate_members(p, torques, g.q, g.v, r, a);
  return a;
}

/// accelerations() with the planets one by one, for lanes; sums are in the same order.
template <class T, class P, std::size_t N>
[[nodiscard]] Coordinates<T, N> accelerations_by_planet(Layout layout, const Parameters<P, N>& p,
                                                        const PhaseCoefficients<P, N>& now, const T* y) {
  using Group = Planets<N, 1>;
  Coordinates<T, N> a;
  Reactions<T> total;
  // Each planet's arithmetic waits for itself: unrolled, the next one's fills the time.
#pragma GCC unroll 8
  for (std::size_t i = 0; i < N; ++i) {
    Coordinates<T, 1> own;
    const Reactions<T> r = accelerate_planets(p, Group{i}, StageState<T, 1, P>(layout, p, Group{i}, now, y), own);
    a.x_p.set(i, own.x_p[0]);
    a.y_p.set(i, own.y_p[0]);
    a.w_p.set(i, own.w_p[0]);
    if (i == 0) {
      total = r;
    } else {
      total += r;
    }
  }
  accelerate_members(p, now.torques, unpack(layout, Group{0}, y),
                     unpack(layout, Group{0}, y + degrees_of_freedom(layout, N)), total, a);
  return a;
}

/// Combines full accelerations to those of the layout's relative coordinates [M-rel].
template <class T, class P, std::size_t N>
void make_relative(Layout layout, const Parameters<P, N>& p, Coordinates<T, N>& a) {
  switch (layout) {
    case Layout::relative_to_ring:
      a.w_s += a.u_r;
      a.w_p -= a.u_r;
      return;
    case Layout::relative_to_carrier:
    case Layout::relative_to_carrier_rigid_ring:
      if (p.boundary == gear::Boundary::fixed_sun) {
        a.u_r -= a.u_c * (p.cos_alpha_sp + p.cos_alpha_rp);
        a.w_p -= a.u_c * p.cos_alpha_sp;
      } else {
        a.w_s -= a.u_c * (p.cos_alpha_sp + p.cos_alpha_rp);
        a.w_p += a.u_c * p.cos_alpha_rp;
      }
      if (p.boundary == gear::Boundary::free) {
        a.w_s += a.u_r;
        a.w_p -= a.u_r;
      }
      a.x_p += a.u_c * p.sin_phi;
      a.y_p -= a.u_c * p.cos_phi;
      return;
    case Layout::pair:
    case Layout::pair_torsional:
      a.w_s += a.w_p[0];
      return;
    case Layout::full:
    case Layout::pair_supported:
    case Layout::pair_torsional_supported:
      return;
  }
}

/// dy/ds at an instant.
///
/// @param y     2 n numbers, n = degrees_of_freedom(layout, N): displacements [b_c], then velocities [b_c per tau]
/// @param dyds  2 n numbers
template <class T, class P, std::size_t N>
void right_hand_side(Layout layout, const Parameters<P, N>& p, const PhaseCoefficients<P, N>& now, const T* y,
                     T* dyds) {
  const std::size_t n = degrees_of_freedom(layout, N);
  Coordinates<T, N> a;
  if constexpr (is_lanes<T>) {
    a = accelerations_by_planet(layout, p, now, y);
  } else {
    const StageState<T, N, P> g(layout, p, Planets<N>{}, now, y);
    a = accelerations(p, g, now.torques);
  }
  make_relative(layout, p, a);
  const P per_phase = 1.0 / p.omega;
  pack<N>(layout, a, dyds + n);
  const auto in_phase = [&](std::size_t k) {
    dyds[k] = y[n + k] * per_phase;
    dyds[n + k] = dyds[n + k] * per_phase;
  };
  constexpr std::size_t common = N == 1 ? 0 : Slots::common(N);
  for (std::size_t k = 0; k < common; ++k) in_phase(k);
  for (std::size_t k = common; k < n; ++k) in_phase(k);
}

/// Numbers of contact_distances().
template <class P, std::size_t N>
[[nodiscard]] std::size_t contacts_of(const Parameters<P, N>& p) {
  return (N == 1 ? 2 : 4 * N) + (gear::is_radial(p.sun_law) ? 1 : 4) + (p.planet_gap ? N : 0);
}

/// Distance of each contact from the kink of its clearance function: delta - b and delta + b of each planet's sun mesh
/// and ring mesh (a pair has no ring), then of the sun's bearing x - b, x + b, y - b, y + b, or r - b of a radial law,
/// and r - b of each planet's bearing if a clearance of it is given.
/// Infinite if b = 0: without a gap no contact opens or closes, and the force has no kink.
///
/// @param y          as of right_hand_side()
/// @param distances  contacts_of(p) numbers [b_c]
/// @param rates      d/ds of them
template <class T, class P, std::size_t N>
void contact_distances(Layout layout, const Parameters<P, N>& p, const PhaseCoefficients<P, N>& now, const T* y,
                       T* distances, T* rates) {
  const P per_phase = 1.0 / p.omega;
  const auto away = [](const P& half_gap) {
    return select(half_gap > P(0.0), P(0.0), P(std::numeric_limits<double>::infinity()));
  };
  const auto flanks = [&](const T& x, const T& rate, const P& half_gap) {
    const P nowhere = away(half_gap);
    *distances++ = x - half_gap + nowhere;
    *distances++ = x + half_gap + nowhere;
    const T along = rate * per_phase;
    *rates++ = along;
    *rates++ = along;
  };
  const T* const velocities = y + degrees_of_freedom(layout, N);
  for (std::size_t i = 0; i < N; ++i) {
    const Planets<N, 1> own{i};
    const Deflections<T, 1> d = deflections(p, own, unpack(layout, own, y));
    const Deflections<T, 1> d_rate = deflections(p, own, unpack(layout, own, velocities));
    const auto mesh = [&](const MeshParameters<P, N>& m, const MeshCoefficients<P, N>& coefficients, const Row<T, 1>& x,
                          const Row<T, 1>& rate) {
      flanks(coefficients.delta(own, x)[0], coefficients.rate(own, rate)[0], m.half_gap);
    };
    mesh(p.sun_planet, now.sun_planet, d.sun_planet, d_rate.sun_planet);
    if constexpr (N > 1) mesh(p.ring_planet, now.ring_planet, d.ring_planet, d_rate.ring_planet);
  }
  const Coordinates<T, 1> q = unpack(layout, Planets<N, 1>{}, y);
  const Coordinates<T, 1> v = unpack(layout, Planets<N, 1>{}, velocities);
  const T& x_s = q.x_s;
  const T& y_s = q.y_s;
  const T& x_rate = v.x_s;
  const T& y_rate = v.y_s;
  if (gear::is_radial(p.sun_law)) {
    const T r = safe_radius(x_s, y_s);
    *distances++ = r - p.sun_half_gap + away(p.sun_half_gap);
    *rates++ = (x_s * x_rate + y_s * y_rate) / r * per_phase;
  } else {
    flanks(x_s, x_rate, p.sun_half_gap);
    flanks(y_s, y_rate, p.sun_half_gap);
  }
  if (!p.planet_gap) return;
  for (std::size_t i = 0; i < N; ++i) {
    const Planets<N, 1> own{i};
    const Deflections<T, 1> d = deflections(p, own, unpack(layout, own, y));
    const Deflections<T, 1> d_rate = deflections(p, own, unpack(layout, own, velocities));
    const T along_x = d.carrier_x[0];
    const T along_y = d.carrier_y[0];
    const T r = safe_radius(along_x, along_y);
    *distances++ = r - p.planet_half_gap + away(p.planet_half_gap);
    *rates++ = (along_x * d_rate.carrier_x[0] + along_y * d_rate.carrier_y[0]) / r * per_phase;
  }
}

/// What meshes and bearings do at an instant: OutputRows::count() numbers.
///
/// @param y     as of right_hand_side()
template <class T, class P, std::size_t N>
void evaluate_outputs(Layout layout, const Parameters<P, N>& p, const PhaseCoefficients<P, N>& now, const T* y,
                      T* rows) {
  using epicyclic::sqrt;
  constexpr OutputRows at{N};
  const auto magnitude = [](const T& a, const T& b) { return sqrt(a * a + b * b); };
  for (std::size_t i = 0; i < N; ++i) {
    const StageState<T, 1, P> g(layout, p, Planets<N, 1>{i}, now, y);
    const auto mesh = [rows](const OutputRows::Mesh& place, const MeshState<T, 1, P>& m) {
      rows[place.delta()] = m.delta[0];
      rows[place.force()] = m.force[0];
      rows[place.elastic()] = m.elastic[0];
    };
    mesh(at.sun_planet(i), g.sun_planet);
    mesh(at.ring_planet(i), g.ring_planet);
    T spring_x = p.bearing_p[i] * g.d.carrier_x[0];
    T spring_y = p.bearing_p[i] * g.d.carrier_y[0];
    if (p.planet_gap) {
      const T closed = planet_bearing_factor(p, g.d)[0];
      spring_x = closed * spring_x;
      spring_y = closed * spring_y;
    }
    rows[at.planet_bearing(i)] = magnitude(spring_x + p.bearing_damping_p[i] * g.d_rate.carrier_x[0],
                                           spring_y + p.bearing_damping_p[i] * g.d_rate.carrier_y[0]);
  }
  const Coordinates<T, 1> q = unpack(layout, Planets<N, 1>{}, y);
  const Coordinates<T, 1> v = unpack(layout, Planets<N, 1>{}, y + degrees_of_freedom(layout, N));
  const BearingForce<T> sun = sun_bearing_force(p, q.x_s, q.y_s);
  rows[at.sun_bearing()] = magnitude(sun.x + p.damping_s * v.x_s, sun.y + p.damping_s * v.y_s);
  if constexpr (N == 1) {
    rows[at.transmission_error()] = q.w_s + q.w_p[0];
    return;
  }
  rows[at.transmission_error()] = q.w_s + q.u_r - q.u_c * (p.cos_alpha_sp + p.cos_alpha_rp);
}

/// dy/ds at mesh phase s.
///
/// @param segment  of p, that of s
template <class T, class P, std::size_t N>
void right_hand_side(Layout layout, const Parameters<P, N>& p, std::size_t segment, const std::type_identity_t<P>& s,
                     const T* y, T* dyds) {
  right_hand_side(layout, p, PhaseCoefficients<P, N>(p, segment, s), y, dyds);
}

}  // namespace epicyclic::model
