// When a mesh is told to pull [S-pull].
#pragma once

namespace epicyclic::studies {

/// A tension as it is told: nothing below a thousandth of the static mesh force, where a smoothed clearance leaves
/// traces of stiffness and damping all through the gap.
[[nodiscard]] constexpr double told_pull(double tension, double static_force) {
  constexpr double least = 1e-3;
  return tension > least * static_force ? tension : 0.0;
}

}  // namespace epicyclic::studies
