// When a mesh is told to pull [S-tension].
#pragma once

#include "core/scalar.hpp"

namespace epicyclic::studies {

/// A tension as it is told: nothing below a thousandth of the static mesh force, where a smoothed clearance leaves
/// traces of stiffness and damping all through the gap.
template <class T>
[[nodiscard]] T noticeable_tension(const T& tension, double static_force) {
  constexpr double least = 1e-3;
  return select(tension > T(least * static_force), tension, T(0.0));
}

}  // namespace epicyclic::studies
