// Stages of one structure side by side, for any layout and number of planets chosen at run time.
#pragma once

#include <cstddef>

#include "core/vector_field.hpp"
#include "model/dynamic_model.hpp"

namespace epicyclic::model {

/// The kernels' lanes; load() takes models of the structure of `like`, which each lane begins with.
/// @param instruction_set  "baseline", "avx2" or "avx512"
/// @param copy             of its kernels; any number
/// @param vectors          tangent vectors of each lane, behind its state; the dimension counts them
/// @returns lanes of width 0 where there are none: in full coordinates, or on a machine without the instruction set
[[nodiscard]] LaneField make_lane_field(const DynamicModel& like, const char* instruction_set, std::size_t copy = 0,
                                        std::size_t vectors = 0);

}  // namespace epicyclic::model
