// Meshes that run backward: the sun is driven through the planets and rotates against its torque.
//
// All data of a stage are for a sun that rotates forward, in the direction of its torque. Backward, the same flanks are
// loaded and the gears pass the same positions in the opposite order. With x the phase of a mesh in time, its position
// is the phase - x of the data:
//
//   k(x) -> k(-x) ,   e(x) -> e(-x) ,   A(x) -> - A(-x) ,   B(x) -> - B(-x)                              [G-rev]
//
// Friction changes its sign, because the teeth slide in the opposite direction. Coulomb's coefficient and that of
// lubricated contact do not depend on this direction. Source: kinematics of involutes; docs/theory/model.md, section 4.
#pragma once

#include <vector>

#include "core/interval_grid.hpp"
#include "gear/stage.hpp"

namespace epicyclic::gear {

/// Are the other flanks loaded, so that the stage is the mirror image of its data?
[[nodiscard]] bool is_mirrored(const Stage& stage);

[[nodiscard]] StiffnessCurve reversed(const StiffnessCurve& curve);
[[nodiscard]] ErrorCurve reversed(const ErrorCurve& curve);
[[nodiscard]] FrictionTable reversed(const FrictionTable& table);

/// Grids of a table whose first breakpoint is 0.
[[nodiscard]] std::vector<IntervalGrid> reversed(std::vector<IntervalGrid> grids);

}  // namespace epicyclic::gear
