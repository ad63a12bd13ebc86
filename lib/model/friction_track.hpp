// Periodic friction ratios of one mesh, ready to evaluate: cubics on intervals of the mesh's own phase, grouped in
// pieces between breakpoints.
//
//   A(s), B_1(s), B_2(s): within a piece Steffen's monotone cubic through the table's rows (straight for two rows),
//   extended by its outermost cubics beyond the piece, so that a step that ends on a breakpoint sees the left side
//   [M-AB]
//
// Source: rows from a table or from gear/friction_path; M. Steffen, Astron. Astrophys. 239 (1990) 443, as in GSL.
// Smoothness: C1 within a piece; jumps at breakpoints, which the integrator steps onto.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/lanes.hpp"
#include "core/scalar.hpp"
#include "gear/stage.hpp"

namespace epicyclic::model {

/// A, B_1 and B_2 at one phase; the moments as ratios to the members' base radii.
template <class T>
struct FrictionRatios {
  T force;           ///< A [-]
  T moment_driving;  ///< B_1 / r_b1 [-]
  T moment_driven;   ///< B_2 / r_b2 [-]
};

class FrictionTrack {
 public:
  using Cubics = std::array<std::array<double, 4>, 3>;  ///< of A, B_1/r_b1, B_2/r_b2 in powers of phase - start

  /// Intervals lo..hi (inclusive) that make one smooth piece.
  struct Piece {
    std::size_t lo = 0, hi = 0;
  };

  FrictionTrack() = default;

  /// @param table  rows on the mesh's own phase after `lead` is added to its phases [-]
  /// @throws InputError when the rows are not as documented at gear::Friction::Table
  FrictionTrack(const gear::Friction::Table& table, double lead, double driving_radius_mm, double driven_radius_mm);

  /// Breakpoints on the mesh's own phase, rising, in [0, 1).
  [[nodiscard]] const std::vector<double>& breakpoints() const { return breakpoints_; }

  /// The piece that holds this phase, and where: phases are met within half a turn of it, so that they may count whole
  /// turns and a phase on a breakpoint is on the side of the place.
  struct Place {
    Piece piece;
    double centre = 0;
  };
  [[nodiscard]] Place place(double phase) const;

  /// Ratios at a phase within half a turn of the place, whole turns apart, by the cubics of its piece.
  template <class T>
  [[nodiscard]] FrictionRatios<T> at(const Place& place, const T& phase) const {
    const T x = phase - T(static_cast<double>(std::round(value_of(phase) - place.centre)));
    const std::size_t k = interval(place.piece, value_of(x));
    const T t = x - starts_[k];
    const auto value = [&](std::size_t j) {
      const auto& c = cubics_[k][j];
      return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
    };
    return {value(0), value(1), value(2)};
  }

  template <std::size_t W>
  [[nodiscard]] FrictionRatios<Lanes<W>> at(const Place& place, const Lanes<W>& phase) const {
    FrictionRatios<Lanes<W>> r;
    for (std::size_t lane = 0; lane < W; ++lane) {
      const FrictionRatios<double> one = at(place, phase[lane]);
      r.force.set(lane, one.force);
      r.moment_driving.set(lane, one.moment_driving);
      r.moment_driven.set(lane, one.moment_driven);
    }
    return r;
  }

 private:
  template <class V>
  [[nodiscard]] std::size_t interval(const Piece& piece, V x) const {
    std::size_t k = piece.lo;
    while (k < piece.hi && x >= starts_[k + 1]) ++k;
    return k;
  }

  void append_piece(const std::vector<std::array<double, 4>>& rows);

  std::vector<double> starts_;
  std::vector<Cubics> cubics_;
  std::vector<Piece> pieces_;
  std::vector<double> breakpoints_;
};

}  // namespace epicyclic::model
