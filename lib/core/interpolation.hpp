// Curves through rows: a cubic on each interval, by the values at its ends and the slopes there.
//
//   linear     the chord                                                                            error ~ h^2
//   monotone   Steffen's slopes, at the ends by his one-sided parabola: never beyond its rows       error ~ h^2, away
//              from extrema h^3                                                                     [M-track]
//   smooth     slopes of the quartic through five neighbouring rows: for rows of a smooth function  error ~ h^4
//
// Source: M. Steffen, Astron. Astrophys. 239 (1990) 443; derivatives of Lagrange's polynomial by its barycentric
// weights (Berrut and Trefethen, SIAM Rev. 46 (2004) 501). Limits: two rows at least, rising. Smoothness: C1; linear
// C0.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace epicyclic {

enum class Interpolation { linear, monotone, smooth };

/// Coefficients of the powers, from 0 on, of what is beyond the interval's start.
using CubicCoefficients = std::array<double, 4>;

/// One cubic for each interval.
/// @param first, count  of the intervals in the result: rows beyond them only determine slopes
/// @throws InputError when rows do not rise
[[nodiscard]] std::vector<CubicCoefficients> cubics_through(Interpolation how, std::span<const double> x,
                                                            std::span<const double> y, std::size_t first,
                                                            std::size_t count);
[[nodiscard]] inline std::vector<CubicCoefficients> cubics_through(Interpolation how, std::span<const double> x,
                                                                   std::span<const double> y) {
  return cubics_through(how, x, y, 0, x.size() - 1);
}

[[nodiscard]] inline double at(const CubicCoefficients& c, double t) {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

/// Which of rows to keep for a table half as fine: those on breakpoints, and every second one between them.
/// @param x  rising; a jump stands twice
[[nodiscard]] std::vector<std::size_t> every_second(std::span<const double> x, std::span<const double> breakpoints);

}  // namespace epicyclic
