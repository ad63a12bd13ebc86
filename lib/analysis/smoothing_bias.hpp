// A number that depends on the width of a smooth clearance, extrapolated to the exact one.
//
// The smooth force exceeds the exact one by (sqrt(x^2 + w^2) - |x|) / 2 at a distance x from an edge. A trajectory that
// crosses the edge at the speed u, x = u t, receives the impulse
//
//   (1 / 2u) int (sqrt(x^2 + w^2) - |x|) dx = w^2 / 2u (ln(2 L / w) + 1/2) + O(w^4 / L^2)
//
// over |x| < L, so that to the first order a result of the trajectory is
//
//   v(w) = v_0 + a w^2 ln w + b w^2                                                                     [A-smooth]
//
// With the three finest widths that gives v_0, with the three next ones another; bound = safety |difference|.
//
// Limits: an orbit near grazing crosses slowly, u of the order of sqrt(w): until w is finer than that the law does not
// hold. The two estimates then differ by much, and the bound says so.
#pragma once

#include <span>

namespace epicyclic::analysis {

struct SmoothedValue {
  double width = 0;  ///< w
  double value = 0;  ///< v(w)
};

struct ExactValue {
  double value = 0;  ///< v_0
  double bound = 0;
};

/// @param values  of four or more widths, falling
/// @throws DomainError for fewer, or widths that are not positive and falling
[[nodiscard]] ExactValue extrapolated_to_exact(std::span<const SmoothedValue> values, double safety = 2.0);

}  // namespace epicyclic::analysis
