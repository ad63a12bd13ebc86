// The equations of motion, once, for every scalar type, number of planets and layout.
//
//   delta_spi = (x_s - x_pi) sin phi_spi + (y_s - y_pi) cos phi_spi + u_s + u_pi - e_spi                 [M-13]
//   delta_rpi = (x_pi - x_r) sin phi_rpi - (y_pi - y_r) cos phi_rpi + u_r - u_pi - e_rpi                 [M-14]
//   delta_picx = x_pi - x_c + u_c sin phi_i ,  delta_picy = y_pi - y_c - u_c cos phi_i                   [M-15]
//   F = k(s) f(delta, b) + c delta' ,  F_f = A(s) F ,  moments B(s) F                                    [M-27]
//   rows of sun, planets, ring, carrier                                                                  [M-17]..[M-20]
//   planets' rotating-frame terms: printed, or invariant in X_i = x_pi + u_c sin phi_i, Y_i = ...        [M-inv]
//
// all dimensionless (model/scales.hpp), the prime d/d tau; the state is advanced in the mesh phase s = Omega tau, so
// dy/ds = (dy/d tau) / Omega. Source: Tang et al. 2020, Eqs. (13)-(20), (27), in the consistent form of model.md.
// Limits: isotropic planet bearings (k_pix = k_piy = k_picu), one half gap per kind of mesh; the back flank keeps the
// line of action of the drive flank, as Eq. (27) does.
// T is the scalar of the state, P that of the parameters and of the phase: the same, or dual numbers and plain ones, so
// that tangents do not carry the derivatives of constants along.
// Smoothness: C0 in the state with kinks at delta = +-b (analytic for w > 0); with contact-slope damping and w = 0 it
// jumps there; in s analytic but for jumps of friction and of a stiffness curve at `breakpoints`.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <type_traits>

#include "core/scalar.hpp"
#include "model/clearance.hpp"
#include "model/layout.hpp"
#include "model/parameters.hpp"

namespace epicyclic::model {

/// Relative displacements without errors, or their rates: the linear part of [M-13], [M-14], [M-15].
template <class T, std::size_t N>
struct Deflections {
  Row<T, N> sun_planet, ring_planet;
  Row<T, N> carrier_x, carrier_y, carrier_u;
};

template <class T, class P, std::size_t N>
[[nodiscard]] Deflections<T, N> deflections(const Parameters<P, N>& p, const Coordinates<T, N>& q) {
  Deflections<T, N> d;
  const auto& sp = p.sun_planet;
  const auto& rp = p.ring_planet;
  d.sun_planet = (q.x_s - q.x_p) * sp.sine + (q.y_s - q.y_p) * sp.cosine + q.w_s + q.w_p;
  d.ring_planet = (q.x_p - q.x_r) * rp.sine - (q.y_p - q.y_r) * rp.cosine + q.u_r - q.w_p;
  d.carrier_x = q.x_p - q.x_c + q.u_c * p.sin_phi;
  d.carrier_y = q.y_p - q.y_c - q.u_c * p.cos_phi;
  d.carrier_u = -(q.x_p - q.x_c) * p.sin_phi + (q.y_p - q.y_c) * p.cos_phi - q.u_c;
  return d;
}

/// cos h s and sin h s, h = 1 ... H, by the angle-addition theorem.
template <class T>
struct HarmonicBasis {
  std::array<T, gear::harmonics_max> cosine, sine;

  HarmonicBasis(const T& s, std::size_t harmonics) {
    const SineCosine<T> first = sine_cosine(s);
    cosine[0] = first.cosine;
    sine[0] = first.sine;
    for (std::size_t h = 1; h < harmonics; ++h) {
      cosine[h] = cosine[h - 1] * first.cosine - sine[h - 1] * first.sine;
      sine[h] = sine[h - 1] * first.cosine + cosine[h - 1] * first.sine;
    }
  }
};

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

/// [M-27] of one kind of mesh; `places` are those of the current segment (MeshPlaces, or one of them for each lane).
template <class T, class P, std::size_t N, class Places>
[[nodiscard]] MeshState<T, N, P> mesh_state(const Parameters<P, N>& p, const MeshParameters<P, N>& mesh,
                                            const Places& places, const P& s, const HarmonicBasis<P>& basis,
                                            const Row<T, N>& displacement, const Row<T, N>& velocity) {
  using R = Row<T, N>;
  const auto own_phase = [&](std::size_t i) -> P { return s * (0.5 * std::numbers::inv_pi) + mesh.turns[i]; };
  MeshState<T, N, P> m;
  m.delta = displacement - (mesh.error_cos * basis.cosine[0] + mesh.error_sin * basis.sine[0]);
  m.rate = velocity - p.omega * (mesh.error_sin * basis.cosine[0] - mesh.error_cos * basis.sine[0]);
  // Planets that mesh in phase have one stiffness and one friction. Where planets are in registers nothing is gained by
  // it, and where constants carry derivatives they are each planet's own.
  const bool shared = is_lanes<P> && mesh.in_phase;
  if (shared) {
    P stiffness = mesh.stiffness;
    for (std::size_t h = 0; h < mesh.harmonics; ++h)
      stiffness += mesh.stiffness_cos[h][0] * basis.cosine[h] + mesh.stiffness_sin[h][0] * basis.sine[h];
    if (mesh.stiffness_curve) stiffness = stiffness_at(mesh, places, 0, own_phase(0));
    m.stiffness = Row<P, N>(stiffness);
  } else {
    m.stiffness = mesh.stiffness;
    for (std::size_t h = 0; h < mesh.harmonics; ++h)
      m.stiffness += mesh.stiffness_cos[h] * basis.cosine[h] + mesh.stiffness_sin[h] * basis.sine[h];
    if (mesh.stiffness_curve)
      m.stiffness = Row<P, N>::of([&](std::size_t i) { return stiffness_at(mesh, places, i, own_phase(i)); });
  }
  m.elastic = m.stiffness * closed_by<R>(m.delta, mesh.half_gap, p.smoothing, p.smooth);
  if (p.gap_damping == GapDamping::contact_slope) {
    m.force = m.elastic + mesh.damping * closure<R>(m.delta, mesh.half_gap, p.smoothing, p.smooth).slope * m.rate;
  } else {
    m.force = m.elastic + mesh.damping * m.rate;
  }
  if (mesh.friction) {
    std::array<FrictionRatios<P>, N> ratios;
    for (std::size_t i = 0; i < (shared ? 1 : N); ++i) ratios[i] = friction_at(mesh, places, i, own_phase(i));
    m.friction = Row<P, N>::of([&](std::size_t i) { return ratios[shared ? 0 : i].force; }) * m.force;
    m.moment_driving = Row<P, N>::of([&](std::size_t i) { return ratios[shared ? 0 : i].moment_driving; }) * m.force;
    m.moment_driven = Row<P, N>::of([&](std::size_t i) { return ratios[shared ? 0 : i].moment_driven; }) * m.force;
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

/// Forces of the stage at one instant, before they act on masses. Each part is made where it stays: copies of it would
/// cost as much as its arithmetic.
template <class T, std::size_t N, class P = T>
struct StageState {
  Coordinates<T, N> q, v;
  Deflections<T, N> d, d_rate;
  MeshState<T, N, P> sun_planet, ring_planet;

  template <Layout L, class Places>
  StageState(Arranged<L> arranged, const Parameters<P, N>& p, const Places& places, const P& s,
             const HarmonicBasis<P>& basis, const T* y)
      : q(unpack<N>(arranged, y)),
        v(unpack<N>(arranged, y + degrees_of_freedom(L, N))),
        d(deflections(p, q)),
        d_rate(deflections(p, v)),
        sun_planet(mesh_state(p, p.sun_planet, places.sun_planet, s, basis, d.sun_planet, d_rate.sun_planet)),
        ring_planet(mesh_state(p, p.ring_planet, places.ring_planet, s, basis, d.ring_planet, d_rate.ring_planet)) {}
};

/// @param places  a segment of p, by its number or itself, or one for each lane
template <Layout L, class T, class P, std::size_t N, class Places>
[[nodiscard]] StageState<T, N, P> stage_state(const Parameters<P, N>& p, const Places& places,
                                              const std::type_identity_t<P>& s, const T* y) {
  const HarmonicBasis<P> basis(s, std::max(p.sun_planet.harmonics, p.ring_planet.harmonics));
  if constexpr (std::is_integral_v<Places>) {
    return {Arranged<L>{}, p, p.segments[static_cast<std::size_t>(places)], s, basis, y};
  } else {
    return {Arranged<L>{}, p, places, s, basis, y};
  }
}

/// Accelerations d^2/d tau^2 of the full coordinates from [M-17]..[M-20].
template <Layout L, class T, class P, std::size_t N>
[[nodiscard]] Coordinates<T, N> accelerations(const Parameters<P, N>& p, const StageState<T, N, P>& g) {
  using R = Row<T, N>;
  const Coordinates<T, N>& q = g.q;
  const Coordinates<T, N>& v = g.v;
  const MeshState<T, N, P>& sp = g.sun_planet;
  const MeshState<T, N, P>& rp = g.ring_planet;
  const P& wc = p.carrier_speed;
  const P wc2 = wc * wc;
  Coordinates<T, N> a;

  // Sun [M-17]
  const BearingForce<T> bearing = sun_bearing_force(p, q.x_s, q.y_s);
  T force_x = -bearing.x - p.damping_s * v.x_s;
  T force_y = -bearing.y - p.damping_s * v.y_s;
  T force_u = p.drive;
  force_x -= sum(sp.force * p.sun_planet.sine + sp.friction * p.sun_planet.cosine);
  force_y -= sum(sp.force * p.sun_planet.cosine - sp.friction * p.sun_planet.sine);
  force_u -= sum(sp.force - sp.moment_driving);
  a.x_s = force_x * p.inverse_mass_s + 2.0 * wc * v.y_s + wc2 * q.x_s;
  a.y_s = force_y * p.inverse_mass_s - 2.0 * wc * v.x_s + wc2 * q.y_s;
  a.w_s = force_u * p.inverse_inertia_s;

  // Planets [M-18] and what their bearings and rotating-frame terms do to the carrier
  T carrier_x = -p.support_c * q.x_c - p.damping_c * v.x_c;
  T carrier_y = -p.support_c * q.y_c - p.damping_c * v.y_c;
  T carrier_u = -p.torsion_c * q.u_c - p.torsion_damping_c * v.u_c - p.carrier_load;
  const R spring_x = p.bearing_p * g.d.carrier_x + p.bearing_damping_p * g.d_rate.carrier_x;
  const R spring_y = p.bearing_p * g.d.carrier_y + p.bearing_damping_p * g.d_rate.carrier_y;
  carrier_x += sum(spring_x);
  carrier_y += sum(spring_y);
  carrier_u += sum(p.bearing_p * g.d.carrier_u + p.bearing_damping_p * g.d_rate.carrier_u);

  R x = q.x_p;
  R y = q.y_p;
  R x_rate = v.x_p;
  R y_rate = v.y_p;
  if (p.gyroscopic_relative) {
    x += q.u_c * p.sin_phi;
    y -= q.u_c * p.cos_phi;
    x_rate += v.u_c * p.sin_phi;
    y_rate -= v.u_c * p.cos_phi;
  }
  const R frame_x = p.mass_p * (wc2 * x + 2.0 * wc * y_rate);
  const R frame_y = p.mass_p * (wc2 * y - 2.0 * wc * x_rate);
  if (p.gyroscopic_relative) carrier_u += sum(frame_x * p.sin_phi - frame_y * p.cos_phi);
  if (p.gyroscopic_carrier_row) carrier_u -= static_cast<double>(N) * p.mass_p * wc2 * q.u_c;

  a.x_p = (frame_x - spring_x + sp.force * p.sun_planet.sine + sp.friction * p.sun_planet.cosine -
           rp.force * p.ring_planet.sine - rp.friction * p.ring_planet.cosine) *
          p.inverse_mass_p;
  a.y_p = (frame_y - spring_y + sp.force * p.sun_planet.cosine - sp.friction * p.sun_planet.sine +
           rp.force * p.ring_planet.cosine - rp.friction * p.ring_planet.sine) *
          p.inverse_mass_p;
  a.w_p = (-sp.force + sp.moment_driven + rp.force - rp.moment_driving) * p.inverse_inertia_p;

  // Ring [M-19]
  force_x = -p.support_r * q.x_r - p.damping_r * v.x_r;
  force_y = -p.support_r * q.y_r - p.damping_r * v.y_r;
  force_u = -p.torsion_r * q.u_r - p.torsion_damping_r * v.u_r + p.ring_drive;
  force_x += sum(rp.force * p.ring_planet.sine + rp.friction * p.ring_planet.cosine);
  force_y -= sum(rp.force * p.ring_planet.cosine - rp.friction * p.ring_planet.sine);
  force_u -= sum(rp.force - rp.moment_driven);
  a.x_r = force_x * p.inverse_mass_r + 2.0 * wc * v.y_r + wc2 * q.x_r;
  a.y_r = force_y * p.inverse_mass_r - 2.0 * wc * v.x_r + wc2 * q.y_r;
  a.u_r = force_u * p.inverse_inertia_r;

  // Carrier [M-20]
  a.x_c = carrier_x * p.inverse_mass_c + 2.0 * wc * v.y_c + wc2 * q.x_c;
  a.y_c = carrier_y * p.inverse_mass_c - 2.0 * wc * v.x_c + wc2 * q.y_c;
  a.u_c = carrier_u * p.inverse_inertia_c;
  return a;
}

/// From full accelerations to the combinations of them that the layout's relative coordinates are [M-rel].
template <Layout L, class T, class P, std::size_t N>
void make_relative(const Parameters<P, N>& p, Coordinates<T, N>& a) {
  if constexpr (L == Layout::relative_to_ring) {
    a.w_s += a.u_r;
    a.w_p -= a.u_r;
  } else if constexpr (L == Layout::relative_to_carrier || L == Layout::relative_to_carrier_rigid_ring) {
    a.w_s -= a.u_c * (p.cos_alpha_sp + p.cos_alpha_rp);
    a.w_p += a.u_c * p.cos_alpha_rp;
    a.x_p += a.u_c * p.sin_phi;
    a.y_p -= a.u_c * p.cos_phi;
  }
}

/// dy/ds at mesh phase s.
///
/// @param places  as for stage_state()
/// @param y       2 n numbers, n = degrees_of_freedom(L, N): displacements [b_c], then velocities [b_c per tau]
/// @param dyds    2 n numbers
template <Layout L, class T, class P, std::size_t N, class Places>
void right_hand_side(const Parameters<P, N>& p, const Places& places, const std::type_identity_t<P>& s, const T* y,
                     T* dyds) {
  constexpr std::size_t n = degrees_of_freedom(L, N);
  const StageState<T, N, P> g = stage_state<L>(p, places, s, y);
  Coordinates<T, N> a = accelerations<L>(p, g);
  make_relative<L>(p, a);
  const P per_phase = 1.0 / p.omega;
  pack<L, N>(a, dyds + n);
  for (std::size_t k = 0; k < n; ++k) {
    dyds[k] = y[n + k] * per_phase;
    dyds[n + k] = dyds[n + k] * per_phase;
  }
}

}  // namespace epicyclic::model
