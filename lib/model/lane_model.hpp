// Operating points of one structure side by side, for any layout and number of planets chosen at run time.
#pragma once

#include <cstddef>
#include <functional>

#include "model/dynamic_model.hpp"

namespace epicyclic::model {

/// W points, one SIMD lane each. Component i of lane w lies at [i W + w], memory is aligned to 64 bytes.
struct LaneModel {
  std::size_t width = 0;
  std::size_t dimension = 0;

  /// Puts an operating point into a lane, its segment the first.
  /// @throws InputError when its structure is not that of the model the lanes were made of
  std::function<void(std::size_t lane, const DynamicModel& model)> load;
  /// Segment k follows breakpoint k of the lane's own model.
  std::function<void(std::size_t lane, std::size_t segment)> set_segment;
  /// Mesh phases that right-hand sides will be wanted at, W numbers each, in the lanes' present segments.
  std::function<void(std::size_t count, const double* s)> set_places;
  /// dy/ds of all lanes at one of those places.
  std::function<void(std::size_t place, const double* y, double* dyds)> right_hand_side;

  std::size_t contacts = 0;
  /// As of DynamicModel, of all lanes at one of those places: `contacts` times W numbers each.
  std::function<void(std::size_t place, const double* y, double* distances, double* rates)> contact_distances;
};

/// @param like             each lane begins with it, and others have to have its structure
/// @param instruction_set  "baseline", "avx2" or "avx512"
/// @param copy             of its kernels; any number
/// @returns lanes of width 0 where there are none: in full coordinates, or on a machine without the instruction set
[[nodiscard]] LaneModel make_lane_model(const DynamicModel& like, const char* instruction_set, std::size_t copy = 0);

}  // namespace epicyclic::model
