// Rows of a known function, as many as an error bound requires.
//
// The rows are doubled until smooth interpolation [core/interpolation.hpp] of half of them agrees with the other half.
// The error of all of them is then a share of that difference, by its order,
//
//   even grids and all octaves but the first of graded ones   e(h) <= e(2h) / 8    (fourth order: 16)
//   the first octave, beside a singular point                  e(h) <= e(2h)        (x^p, p > 1)
//
// Limits: analytic functions, except for a point beside which they are as x^p, p > 1, at one end of the interval. If
// the largest number of rows is not enough, the result has the error that it reaches.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/interpolation.hpp"
#include "core/interval_grid.hpp"

namespace epicyclic {

enum class SingularEnd { none, start, end };

/// K functions on one interval.
template <std::size_t K>
struct FittedRows {
  IntervalGrid grid;
  std::vector<std::array<double, K>> rows;  ///< one for each node, in their order
  double error = 0;                         ///< greatest, of any of the functions
};

/// @param f  std::array<double, K> (double fraction): the functions at a fraction of the interval
/// @param half  rows at every second node, which are not computed again
template <std::size_t K, class F>
[[nodiscard]] FittedRows<K> rows_on(const IntervalGrid& grid, const F& f, const FittedRows<K>* half = nullptr) {
  const bool nested = half != nullptr && grid.can_be_halved() && grid.halved() == half->grid;
  FittedRows<K> r{grid, {}, 0.0};
  for (std::size_t k = 0; k <= grid.count; ++k)
    r.rows.push_back(nested && k % 2 == 0 ? half->rows[k / 2] : f(grid.fraction(k)));
  return r;
}

namespace detail {

struct RowErrors {
  double first_octave = 0, rest = 0;
};

template <std::size_t K>
[[nodiscard]] RowErrors estimated_errors(const FittedRows<K>& r) {
  RowErrors errors;
  std::vector<double> v;
  for (std::size_t k = 0; k <= r.grid.count; k += 2) v.push_back(r.grid.node(k));
  for (std::size_t j = 0; j < K; ++j) {
    std::vector<double> y;
    for (std::size_t k = 0; k <= r.grid.count; k += 2) y.push_back(r.rows[k][j]);
    const std::vector<CubicCoefficients> coarse = cubics_through(Interpolation::smooth, v, y);
    for (std::size_t k = 1; k < r.grid.count; k += 2) {
      const double off = std::abs(at(coarse[k / 2], r.grid.node(k) - v[k / 2]) - r.rows[k][j]);
      double& worst = k < r.grid.per_octave ? errors.first_octave : errors.rest;
      worst = std::max(worst, off);
    }
  }
  return {errors.first_octave, errors.rest / 8.0};
}

}  // namespace detail

/// @param tolerance  of the greatest error
/// @param features   intervals of equal width that the interval needs at least, so that no feature is between the rows
template <std::size_t K, class F>
[[nodiscard]] FittedRows<K> fit_rows(const F& f, double tolerance, SingularEnd singular = SingularEnd::none,
                                     double features = 0.0) {
  const bool graded = singular != SingularEnd::none;
  constexpr double at_most = 1 << 17;
  const auto at_least = std::bit_ceil(static_cast<std::size_t>(std::ceil(std::min(features, at_most))));
  const std::size_t most = std::max<std::size_t>(graded ? 128 : 2048, at_least);
  constexpr int most_octaves = 32;  // the shortest intervals are then 1e-11 of the whole
  std::size_t intervals = std::max<std::size_t>(graded ? 8 : 16, at_least);
  int octaves = 8;
  FittedRows<K> r;
  for (;;) {
    const IntervalGrid grid =
        graded ? IntervalGrid::graded(intervals, octaves, singular == SingularEnd::end) : IntervalGrid::even(intervals);
    r = rows_on<K>(grid, f, &r);
    const detail::RowErrors errors = detail::estimated_errors(r);
    r.error = std::max(errors.first_octave, errors.rest);
    bool refined = false;
    if (errors.first_octave > tolerance && octaves < most_octaves) {
      const auto more = static_cast<int>(std::ceil(std::log2(errors.first_octave / tolerance)));
      octaves = std::min(most_octaves, octaves + more);
      refined = true;
    }
    if (errors.rest > tolerance && intervals < most) {
      intervals *= 2;
      refined = true;
    }
    if (!refined) return r;
  }
}

}  // namespace epicyclic
