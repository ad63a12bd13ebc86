// K periodic functions given by one table over the mesh phase, ready to evaluate: cubics on intervals of the mesh's own
// phase, grouped in pieces between breakpoints.
//
//   within a piece Steffen's monotone cubic through the rows (straight for two rows), extended by its outermost cubics
//   beyond the piece, so that a step that ends on a breakpoint sees the left side                          [M-track]
//
// Source: M. Steffen, Astron. Astrophys. 239 (1990) 443, as in GSL. Limits: rows as documented at
// gear::Friction::Table. Smoothness: C1 within a piece; jumps at breakpoints, which the integrator steps onto.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "core/cubics.hpp"
#include "core/dual.hpp"
#include "core/row.hpp"
#include "core/scalar.hpp"

namespace epicyclic::model {

/// Intervals lo..hi (inclusive) that make one smooth piece.
struct TrackPiece {
  std::size_t lo = 0, hi = 0;
  double start = 0;                ///< of interval lo
  double intervals_per_phase = 0;  ///< mean, from the starts of the first and the last interval
  bool even = false;               ///< all intervals are of one length, to rounding
};

/// The piece that holds a phase, and where: phases are met within half a turn of it, so that they may count whole turns
/// and a phase on a breakpoint is on the side of the place.
struct TrackPlace {
  TrackPiece piece;
  double centre = 0;
};

/// One row of a table: phase and K values.
template <std::size_t K>
struct TrackRow {
  double phase;
  std::array<double, K> value;
};

template <std::size_t K>
class PeriodicTrack {
 public:
  PeriodicTrack() = default;

  /// @param given_rows   phases rising, a jump as two rows of one phase
  /// @param given_breakpoints  phases of the rows where the functions jump or kink
  /// @param lead         added to all phases
  /// @throws InputError when a piece has no rows at its ends, or rows cannot be told apart
  PeriodicTrack(const std::vector<TrackRow<K>>& given_rows, const std::vector<double>& given_breakpoints, double lead);

  /// The same functions, which at a dual number also carry their derivative with respect to a parameter, in its first
  /// direction.
  /// @param near  the functions at the parameter's values - 2 h, - h, + h, + 2 h
  /// @throws InputError when the rows of those have other phases
  [[nodiscard]] PeriodicTrack with_parameter_derivative(const std::array<const PeriodicTrack*, 4>& near,
                                                        double h) const;

  /// Breakpoints on the mesh's own phase, rising, in [0, 1).
  [[nodiscard]] const std::vector<double>& breakpoints() const { return breakpoints_; }

  [[nodiscard]] TrackPlace place(double phase) const;

  /// Values at a phase within half a turn of the place, whole turns apart, by the cubics of its piece.
  template <class T>
  [[nodiscard]] Row<T, K> at(const TrackPlace& place, const T& phase) const {
    const T x = phase - T(nearest_whole(static_cast<double>(value_of(phase)) - place.centre));
    const std::size_t k = interval(place.piece, value_of(x));
    if constexpr (std::is_same_v<T, double>) {
      return on_interval(k, x);
    } else {
      const T t = x - starts_[k];
      const Cubics<K>& c = cubics_[k];
      Row<T, K> values =
          Row<T, K>::of([&](std::size_t j) { return c[0][j] + t * (c[1][j] + t * (c[2][j] + t * c[3][j])); });
      if constexpr (is_dual<T>) {
        if (!parameter_cubics_.empty()) {
          values.derivative[0] += cubics_at(parameter_cubics_[k], value_of(t));
        }
      }
      return values;
    }
  }

  /// What at() does after whole turns are taken off, for callers that guess for several lanes at once.
  /// @param x      within half a turn of the place's centre
  /// @param guess  interval that x is in, or near, counted from the piece's first one; any number within the piece
  [[nodiscard]] Row<double, K> at(const TrackPiece& piece, double x, std::size_t guess) const {
    return on_interval(walked(piece, x, piece.lo + guess), x);
  }
  [[nodiscard]] const Cubics<K>* cubics(const TrackPiece& piece) const { return cubics_.data() + piece.lo; }

 private:
  [[nodiscard]] Row<double, K> on_interval(std::size_t k, double x) const {
    return cubics_at(cubics_[k], x - starts_[k]);
  }

  /// Guessed as if the intervals were equal, which they mostly are, then walked to.
  template <class V>
  [[nodiscard]] std::size_t interval(const TrackPiece& piece, V x) const {
    const double guess = (static_cast<double>(x) - piece.start) * piece.intervals_per_phase;
    const auto most = static_cast<double>(piece.hi - piece.lo);
    const double above = guess > 0.0 ? guess : 0.0;  // no number is 0
    const double within = above < most ? above : most;
    return walked(piece, x, piece.lo + static_cast<std::size_t>(static_cast<long long>(within)));
  }
  template <class V>
  [[nodiscard]] std::size_t walked(const TrackPiece& piece, V x, std::size_t k) const {
    while (k > piece.lo && x < starts_[k]) --k;
    while (k < piece.hi && x >= starts_[k + 1]) ++k;
    return k;
  }

  [[nodiscard]] TrackPiece piece(std::size_t lo, std::size_t hi) const;
  void append_piece(const std::vector<TrackRow<K>>& rows);

  std::vector<double> starts_;
  std::vector<Cubics<K>> cubics_;
  std::vector<Cubics<K>> parameter_cubics_;  ///< their derivatives with respect to a parameter; empty without one
  std::vector<TrackPiece> pieces_;
  std::vector<double> breakpoints_;
};

extern template class PeriodicTrack<1>;
extern template class PeriodicTrack<3>;

}  // namespace epicyclic::model
