// The place of each coordinate of the stage in the state, and the member from which rotations are measured.
//
// Full coordinates (3N + 9, Eq. (12)): translations x, y and rotations u = r theta of sun, planets, ring and carrier.
// They contain one rigid rotation. It is eliminated by measuring rotations relative to one member [M-rel]:
//
//   ring      w_s = u_s + u_r ,  w_pi = u_pi - u_r                                   `as_printed`, `star`: 3N + 8
//   carrier   w_s = u_s - u_c (cos alpha_sp + cos alpha_rp) ,  w_pi = u_pi + u_c cos alpha_rp ,
//             X_i = x_pi + u_c sin phi_i ,  Y_i = y_pi - u_c cos phi_i               `fixed_ring`: 3N + 8
//   carrier, ring rigid in rotation (u_r = 0)                                        `fixed_ring`: 3N + 7
//   carrier   w_r = u_r - u_c (cos alpha_sp + cos alpha_rp) ,  w_pi = u_pi - u_c cos alpha_sp ,  X_i ,  Y_i ;  u_s
//             in the slot of w_s, w_r in that of u_r                                 `fixed_sun`: 3N + 8
//   carrier and ring   w_s = u_s + u_r - u_c (cos alpha_sp + cos alpha_rp) ,
//             w_pi = u_pi - u_r + u_c cos alpha_rp ,  X_i ,  Y_i                     `free`: 3N + 7, as a rigid ring
//
// A lone pair of gears has gear 1 in the place of the sun and gear 2 in that of its only planet [M-pair]. If both gears
// rotate freely, one rotation is left, w = u_1 + u_2. Translations are left out if the bearings are rigid.
//
//   pair              x_1, y_1, w, x_2, y_2             5     pair_supported            x_1, y_1, u_1, x_2, y_2, u_2 6
//   pair_torsional    w                                 1     pair_torsional_supported  u_1, u_2 2
//
// Source: docs/theory/model.md, section 4; Eqs. (21)-(22) eliminate the same rotation by differentiating e twice, which
// this avoids. Written once: every layout is read into the same Coordinates, in which the rotation of the reference
// member is 0, so that deflections have one formula. Linear maps: smooth everywhere. The layout is a value: it decides
// which of the last slots are there and what accelerations of rotations are combined to [make_relative()].
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/row.hpp"

namespace epicyclic::model {

enum class Layout {
  relative_to_ring,
  relative_to_carrier,
  relative_to_carrier_rigid_ring,
  full,
  pair,
  pair_supported,
  pair_torsional,
  pair_torsional_supported,
};

/// Of a lone pair of gears?
[[nodiscard]] constexpr bool is_pair(Layout l) {
  return l == Layout::pair || l == Layout::pair_supported || l == Layout::pair_torsional ||
         l == Layout::pair_torsional_supported;
}

/// Of a lone pair of gears: do its gears move sideways, and has each a rotation of its own?
[[nodiscard]] constexpr bool has_translations(Layout l) { return l == Layout::pair || l == Layout::pair_supported; }
[[nodiscard]] constexpr bool has_both_rotations(Layout l) {
  return l == Layout::pair_supported || l == Layout::pair_torsional_supported;
}

[[nodiscard]] constexpr bool has_ring_rotation(Layout l) {
  return l == Layout::relative_to_carrier || l == Layout::full;
}
[[nodiscard]] constexpr bool has_carrier_rotation(Layout l) {
  return l == Layout::relative_to_ring || l == Layout::full;
}

/// Degrees of freedom of N planets; one planet is gear 2 of a pair.
[[nodiscard]] constexpr std::size_t degrees_of_freedom(Layout l, std::size_t planets) {
  if (planets == 1 && l != Layout::full) return (has_translations(l) ? 4U : 0U) + (has_both_rotations(l) ? 2U : 1U);
  return 3 * planets + 7 + (has_ring_rotation(l) ? 1U : 0U) + (has_carrier_rotation(l) ? 1U : 0U);
}

/// Slots of the displacements in the state; the velocity of a slot stands degrees_of_freedom() further on.
struct Slots {
  static constexpr std::size_t x_s = 0, y_s = 1, w_s = 2;
  static constexpr std::size_t x_p(std::size_t i) { return 3 + 3 * i; }
  static constexpr std::size_t y_p(std::size_t i) { return 4 + 3 * i; }
  static constexpr std::size_t w_p(std::size_t i) { return 5 + 3 * i; }
  static constexpr std::size_t x_r(std::size_t n) { return 3 + 3 * n; }
  static constexpr std::size_t y_r(std::size_t n) { return 4 + 3 * n; }
  static constexpr std::size_t x_c(std::size_t n) { return 5 + 3 * n; }
  static constexpr std::size_t y_c(std::size_t n) { return 6 + 3 * n; }
  /// One past those that every layout has.
  static constexpr std::size_t common(std::size_t n) { return 7 + 3 * n; }
  static constexpr std::size_t u_r(std::size_t n) { return common(n); }
  static constexpr std::size_t u_c(Layout l, std::size_t n) { return common(n) + (has_ring_rotation(l) ? 1U : 0U); }
};

/// Displacements (or velocities, or accelerations) of all members; u_r or u_c is 0 where it is the reference.
template <class T, std::size_t N>
struct Coordinates {
  T x_s, y_s, w_s;
  Row<T, N> x_p, y_p, w_p;
  T x_r, y_r, u_r;
  T x_c, y_c, u_c;
};

/// Planets first, ..., first + G - 1 of N.
template <std::size_t N, std::size_t G = N>
struct Planets {
  std::size_t first = 0;

  /// Their part of a row.
  template <class T>
  [[nodiscard]] decltype(auto) operator()(const Row<T, N>& row) const {
    if constexpr (G == N) {
      return (row);
    } else {
      return Row<T, G>::of([&](std::size_t i) -> const T& { return row[first + i]; });
    }
  }
};

/// Both gears of a pair; what is not in the state is 0.
template <class T>
[[nodiscard]] Coordinates<T, 1> unpack_pair(Layout layout, const T* q) {
  const T nothing(0.0);
  Coordinates<T, 1> c;
  c.x_s = c.y_s = c.x_r = c.y_r = c.u_r = c.x_c = c.y_c = c.u_c = nothing;
  c.x_p = c.y_p = c.w_p = nothing;
  if (has_translations(layout)) {
    c.x_s = *q++;
    c.y_s = *q++;
  }
  c.w_s = *q++;
  if (has_translations(layout)) {
    c.x_p.set(0, *q++);
    c.y_p.set(0, *q++);
  }
  if (has_both_rotations(layout)) c.w_p.set(0, *q);
  return c;
}

template <class T>
void pack_pair(Layout layout, const Coordinates<T, 1>& c, T* q) {
  if (has_translations(layout)) {
    *q++ = c.x_s;
    *q++ = c.y_s;
  }
  *q++ = c.w_s;
  if (has_translations(layout)) {
    *q++ = c.x_p[0];
    *q++ = c.y_p[0];
  }
  if (has_both_rotations(layout)) *q = c.w_p[0];
}

/// All members with some of the planets.
template <class T, std::size_t N, std::size_t G>
[[nodiscard]] Coordinates<T, G> unpack(Layout layout, Planets<N, G> planets, const T* q) {
  if constexpr (N == 1)
    if (layout != Layout::full) return unpack_pair(layout, q);
  const std::size_t first = planets.first;
  Coordinates<T, G> c;
  c.x_s = q[Slots::x_s];
  c.y_s = q[Slots::y_s];
  c.w_s = q[Slots::w_s];
  c.x_p = Row<T, G>::of([q, first](std::size_t i) -> const T& { return q[Slots::x_p(first + i)]; });
  c.y_p = Row<T, G>::of([q, first](std::size_t i) -> const T& { return q[Slots::y_p(first + i)]; });
  c.w_p = Row<T, G>::of([q, first](std::size_t i) -> const T& { return q[Slots::w_p(first + i)]; });
  c.x_r = q[Slots::x_r(N)];
  c.y_r = q[Slots::y_r(N)];
  c.x_c = q[Slots::x_c(N)];
  c.y_c = q[Slots::y_c(N)];
  const T reference(0.0);
  c.u_r = *(has_ring_rotation(layout) ? q + Slots::u_r(N) : &reference);
  c.u_c = *(has_carrier_rotation(layout) ? q + Slots::u_c(layout, N) : &reference);
  return c;
}

template <std::size_t N, class T>
[[nodiscard]] Coordinates<T, N> unpack(Layout layout, const T* q) {
  return unpack(layout, Planets<N>{}, q);
}

template <std::size_t N, class T>
void pack(Layout layout, const Coordinates<T, N>& c, T* q) {
  if constexpr (N == 1)
    if (layout != Layout::full) return pack_pair(layout, c, q);
  q[Slots::x_s] = c.x_s;
  q[Slots::y_s] = c.y_s;
  q[Slots::w_s] = c.w_s;
  c.x_p.each([q](std::size_t i, const T& x) { q[Slots::x_p(i)] = x; });
  c.y_p.each([q](std::size_t i, const T& y) { q[Slots::y_p(i)] = y; });
  c.w_p.each([q](std::size_t i, const T& w) { q[Slots::w_p(i)] = w; });
  q[Slots::x_r(N)] = c.x_r;
  q[Slots::y_r(N)] = c.y_r;
  q[Slots::x_c(N)] = c.x_c;
  q[Slots::y_c(N)] = c.y_c;
  if (has_ring_rotation(layout)) q[Slots::u_r(N)] = c.u_r;
  if (has_carrier_rotation(layout)) q[Slots::u_c(layout, N)] = c.u_c;
}

/// Names of the displacements in order of their slots: x_s, y_s, w_s, x_p1, ... (u_s, u_p1 in full coordinates).
[[nodiscard]] std::vector<std::string> coordinate_names(Layout layout, int planets);

}  // namespace epicyclic::model

/// EPICYCLIC_FOR_PLANETS(X) for each number of planets: X(planets).
#define EPICYCLIC_FOR_PLANETS(X) X(1) X(2) X(3) X(4) X(5) X(6)
/// EPICYCLIC_FOR_LAYOUTS(X): X(layout, planets) for each that is integrated.
#define EPICYCLIC_FOR_LAYOUTS_OF(X, N) \
  X(Layout::relative_to_ring, N)       \
  X(Layout::relative_to_carrier, N)    \
  X(Layout::relative_to_carrier_rigid_ring, N)
#define EPICYCLIC_FOR_LAYOUTS(X)         \
  X(Layout::pair, 1)                     \
  X(Layout::pair_supported, 1)           \
  X(Layout::pair_torsional, 1)           \
  X(Layout::pair_torsional_supported, 1) \
  EPICYCLIC_FOR_LAYOUTS_OF(X, 2)         \
  EPICYCLIC_FOR_LAYOUTS_OF(X, 3)         \
  EPICYCLIC_FOR_LAYOUTS_OF(X, 4)         \
  EPICYCLIC_FOR_LAYOUTS_OF(X, 5)         \
  EPICYCLIC_FOR_LAYOUTS_OF(X, 6)
