// K periodic functions given by one table over the mesh phase, ready to evaluate: cubics on intervals of the mesh's own
// phase, grouped in segments between breakpoints.
//
//   within a segment a cubic on each interval [core/interpolation.hpp], extended by its outermost cubics beyond the
//   segment, so that a step that ends on a breakpoint gets the left side [M-track]
//
// Limits: rows as documented at gear::FrictionTable. Smoothness: C1 within a segment (C0 if straight); jumps at
// breakpoints, which the integrator steps onto.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "core/cubics.hpp"
#include "core/dual.hpp"
#include "core/interpolation.hpp"
#include "core/interval_grid.hpp"
#include "core/row.hpp"
#include "core/scalar.hpp"
#include "model/row_spacing.hpp"

namespace epicyclic::model {

/// Intervals of one smooth segment. Their cubics are in powers of v - grid.node(k), v = grid.offset + (phase - origin)
/// slope. If the intervals are not on such a grid, the cubics are in powers of phase - start, and the grid's number is
/// a guess.
struct TrackSegment {
  std::size_t lo = 0;  ///< first interval
  IntervalGrid grid;
  double start = 0;  ///< phase at which the segment begins
  double origin = 0, slope = 1;
  bool regular = false;  ///< the intervals are those of the grid, to rounding

  [[nodiscard]] std::size_t hi() const { return lo + grid.count - 1; }
  template <class T>
  [[nodiscard]] T place(const T& phase) const {
    return grid.offset + (phase - origin) * slope;
  }
};

/// The segment of a phase, and its centre. Phases are within half a period of the centre, modulo whole periods, so that
/// a phase on a breakpoint is on the side of the place.
struct TrackPlace {
  TrackSegment segment;
  double centre = 0;
};

/// One row of a table: phase and K values.
template <std::size_t K>
struct TrackRow {
  double phase;
  std::array<double, K> value;
};

template <std::size_t K>
class PeriodicTrack;

/// A track whose second function is, in the place of its rows, the derivative of the first one with respect to the
/// phase, of a table without jumps: exactly that of the cubics. Three functions fill the registers that two would.
/// @param unit  that the derivative is multiplied by
[[nodiscard]] PeriodicTrack<3> with_slope(PeriodicTrack<3> track, double unit = 1.0);

template <std::size_t K>
class PeriodicTrack {
 public:
  PeriodicTrack() = default;

  /// @param given_rows   phases rising, a jump as two rows of one phase
  /// @param given_breakpoints  phases of the rows where the functions jump or kink
  /// @param lead         added to all phases
  /// @param grids        of the rows of each segment, in the order of the breakpoints; empty: derived from the rows.
  ///                     Rows on grids are those of functions that are smooth between the breakpoints
  /// @param rows_per_feature  c of [M-rows] for rows that are on no grids
  /// @throws InputError if a segment has no rows at its ends, or if two rows coincide
  PeriodicTrack(const std::vector<TrackRow<K>>& given_rows, const std::vector<double>& given_breakpoints, double lead,
                Interpolation interpolation = Interpolation::monotone, std::span<const IntervalGrid> grids = {},
                double rows_per_feature = 1.0);

  /// These functions with their derivative with respect to a parameter. At a dual number it is the derivative in the
  /// first direction.
  /// @param near  the functions at the parameter's values - 2 h, - h, + h, + 2 h
  /// @throws InputError when the rows of those have other phases
  [[nodiscard]] PeriodicTrack with_parameter_derivative(const std::array<const PeriodicTrack*, 4>& near,
                                                        double h) const;

  /// Breakpoints on the mesh's own phase, rising, in [0, 1).
  [[nodiscard]] const std::vector<double>& breakpoints() const { return breakpoints_; }

  /// Of the rows, on the mesh's own phase.
  [[nodiscard]] const RowSpacing& spacing() const { return spacing_; }

  [[nodiscard]] TrackPlace place(double phase) const;

  /// Values at a phase within half a period of the place, modulo whole periods, by the cubics of its segment.
  template <class T>
  [[nodiscard]] Row<T, K> at(const TrackPlace& place, const T& phase) const {
    const TrackSegment& segment = place.segment;
    const T x = phase - T(nearest_whole(static_cast<double>(value_of(phase)) - place.centre));
    const T v = segment.place(x);
    std::size_t k = segment.grid.number(static_cast<double>(value_of(v)));
    T t = v - segment.grid.node(k);
    k += segment.lo;
    if (!segment.regular) {
      k = walked(segment, value_of(x), k);
      t = x - starts_[k];
    }
    if constexpr (std::is_same_v<T, double>) {
      return cubics_at(cubics_[k], t);
    } else {
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

  /// The value of at() without whole periods, if intervals do not lie on a grid.
  /// @param x      within half a period of the place's centre
  /// @param guess  interval that x is in, or near, counted from the segment's first one; any number within the segment
  [[nodiscard]] Row<double, K> at(const TrackSegment& segment, double x, std::size_t guess) const {
    const std::size_t k = walked(segment, x, segment.lo + guess);
    return cubics_at(cubics_[k], x - starts_[k]);
  }
  [[nodiscard]] const Cubics<K>* cubics(const TrackSegment& segment) const { return cubics_.data() + segment.lo; }

 private:
  friend PeriodicTrack<3> with_slope(PeriodicTrack<3> track, double unit);

  template <class V>
  [[nodiscard]] std::size_t walked(const TrackSegment& segment, V x, std::size_t k) const {
    while (k > segment.lo && x < starts_[k]) --k;
    while (k < segment.hi() && x >= starts_[k + 1]) ++k;
    return k;
  }

  /// @param rows  of the segment, and `beyond` of its neighbours' at either end
  /// @param grid  of the rows; null: derived from them
  void append_segment(const std::vector<TrackRow<K>>& rows, std::size_t beyond, Interpolation interpolation,
                      const IntervalGrid* grid);

  std::vector<double> starts_;  ///< phases where intervals begin; on a grid that counts from its end, where they end
  std::vector<Cubics<K>> cubics_;
  std::vector<Cubics<K>> parameter_cubics_;  ///< their derivatives with respect to a parameter; empty without one
  std::vector<TrackSegment> segments_;
  std::vector<double> breakpoints_;
  RowSpacing spacing_;
};

extern template class PeriodicTrack<1>;
extern template class PeriodicTrack<3>;

}  // namespace epicyclic::model
