// Loops of an explicit Runge-Kutta step over W trajectories side by side, compiled once per instruction set and chosen
// at run time.
//
// Component i of lane w lies at [i W + w], memory is aligned to 64 bytes. Each lane has its own operations in one fixed
// order: its bits depend neither on W nor on the instruction set nor on the other lanes. No fused multiply-add.
#pragma once

#include <cstddef>

namespace epicyclic::integrate {

inline constexpr std::size_t most_lanes = 8;

struct LaneKernels {
  const char* name = nullptr;  ///< "baseline", "avx2", "avx512"
  std::size_t width = 0;       ///< W

  /// out = y + h sum_j a_j k_j, in the order of j; h has W numbers.
  void (*stage)(std::size_t dimension, std::size_t count, const double* a, const double* const* k, const double* h,
                const double* y, double* out) = nullptr;

  /// norm^2 = mean_i [ h sum_j e_j k_ij / (rtol |y_i| + atol) ]^2 and max_i |next_i|, W numbers each. A slope that is
  /// not a number makes the norm none; the maximum leaves such components out.
  void (*error)(std::size_t dimension, std::size_t count, const double* e, const double* const* k, const double* h,
                const double* y, const double* next, double relative, double absolute, double* norm_square,
                double* largest) = nullptr;

  /// to <- from in the lanes with accepted[w] != 0.
  void (*accept)(std::size_t dimension, const long long* accepted, const double* from, double* to) = nullptr;
};

/// The widest that this machine runs.
[[nodiscard]] const LaneKernels& lane_kernels();

/// Those of one instruction set, or nullptr if it was not compiled or this machine does not run it.
/// @param name "baseline", "avx2" or "avx512"
[[nodiscard]] const LaneKernels* lane_kernels(const char* name);

}  // namespace epicyclic::integrate
