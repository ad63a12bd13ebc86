// The threshold for a tensile force of a mesh [S-tension].
#pragma once

#include "core/scalar.hpp"

namespace epicyclic::studies {

/// A tension as it is reported. It is zero below a thousandth of the static mesh force, since a smoothed clearance
/// leaves small forces of stiffness and damping throughout the gap.
template <class T>
[[nodiscard]] T noticeable_tension(const T& tension, double static_force) {
  constexpr double least = 1e-3;
  return select(tension > T(least * static_force), tension, T(0.0));
}

}  // namespace epicyclic::studies
