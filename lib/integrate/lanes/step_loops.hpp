// Loops of an explicit Runge-Kutta step over W trajectories side by side, compiled for each instruction set, the wider
// ones kernel_copies times [core/instruction_set.hpp], and chosen at run time.
//
// Component i of lane w lies at [i W + w], memory is aligned to 64 bytes. Each lane has its own operations in one fixed
// order: its bits depend neither on W nor on the instruction set nor on the other lanes. No fused multiply-add.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace epicyclic::integrate {

inline constexpr std::size_t most_lanes = 8;

/// An attempt of a step in each lane, and what it is decided by: W numbers each. Masks have all bits of a lane or none.
struct alignas(64) LaneSteps {
  template <class T>
  using Each = std::array<T, most_lanes>;
  static constexpr Each<double> no_limit() {
    Each<double> each{};
    each.fill(std::numeric_limits<double>::infinity());
    return each;
  }

  alignas(64) Each<double> s{};                   ///< where a lane is
  alignas(64) Each<double> stop{};                ///< where it has to stop next, a breakpoint or the end
  alignas(64) Each<double> sample{};              ///< the next place at which a sample is wanted; infinite if none is
  alignas(64) Each<double> proposed{};            ///< length of the next step; 0 if not known
  alignas(64) Each<double> longest = no_limit();  ///< limit of that length; infinite without one
  alignas(64) Each<double> hop{};          ///< length of the step over a surface that follows a landing; 0: none does
  alignas(64) Each<double> h{};            ///< length of this one
  alignas(64) Each<double> end{};          ///< where it ends: on a stop to the last bit
  alignas(64) Each<double> norm{};         ///< of its error, squared
  alignas(64) Each<double> largest{};      ///< component at its end
  alignas(64) Each<double> wanted{};       ///< factor of the next one by the norm
  alignas(64) Each<long long> running{};   ///< mask
  alignas(64) Each<long long> cut{};       ///< mask: the step is one to a stop
  alignas(64) Each<long long> hopping{};   ///< mask: the step is that over a surface
  alignas(64) Each<long long> crossing{};  ///< mask: refused for a surface that it crosses, and for nothing else
  alignas(64) Each<long long> accepted{};  ///< mask
  alignas(64) Each<long long> refused{};   ///< mask: the last attempt was refused
  alignas(64) Each<long long> again{};     ///< mask: and so was the one before
  alignas(64) Each<long long> event{};     ///< mask: more has to be thought of this lane
  alignas(64) Each<long long> attempts{};  ///< so far
  alignas(64) Each<long long> allowed{};   ///< attempts
};

/// Of an attempt of a step in each lane.
struct LaneVerdict {
  bool eventful = false;     ///< there is a lane with an event
  std::size_t accepted = 0;  ///< lanes
};

struct StepLoops {
  const char* name = nullptr;  ///< "baseline", "avx2", "avx512"
  std::size_t copy = 0;        ///< which one of kernel_copies
  std::size_t width = 0;       ///< W

  /// out = y + h sum_j a_j k_j, in the order of j; h has W numbers.
  void (*stage)(std::size_t dimension, std::size_t count, const double* a, const double* const* k, const double* h,
                const double* y, double* out) = nullptr;

  /// norm^2 = mean_i [ h sum_j e_j k_ij / (rtol |y_i| + atol) ]^2 and max_i |next_i|, W numbers each, as are the
  /// tolerances. A slope that is not a number makes the norm none; the maximum leaves such components out.
  void (*error)(std::size_t dimension, std::size_t count, const double* e, const double* const* k, const double* h,
                const double* y, const double* next, const double* relative, const double* absolute,
                double* norm_square, double* largest) = nullptr;

  /// norm^2 <- max(norm^2, mean_i [ h sum_j e_j k_ij / (rtol |v_i| + atol size) ]^2) of a tangent vector, whose size is
  /// its largest component or `least`, if that is more; 1 where both are 0.
  void (*vector_error)(std::size_t dimension, std::size_t count, const double* e, const double* const* k,
                       const double* h, const double* v, const double* relative, const double* absolute, double least,
                       double* norm_square) = nullptr;

  /// Sets h, end and cut, and out_k = s + c_k h for each of `count` nodes, the end itself where c_k = 1.
  void (*measure)(LaneSteps& steps, std::size_t count, const double* c, double* out) = nullptr;

  /// Sets `accepted`, `refused` and `again`, counts the attempts, and proposes the next steps as ARKODE's I controller
  /// does. Sets `event` where a stop or a sample is reached, the escape bound is left, no step is accepted or none is
  /// allowed any more.
  LaneVerdict (*judge)(LaneSteps& steps, double escape_bound) = nullptr;

  /// Sets `crossing`, and the norm so that the step is refused, where one that is not that over a surface crosses one
  /// of `count`. W numbers for each surface.
  void (*refuse_crossings)(LaneSteps& steps, std::size_t count, const double* values,
                           const double* values_at_end) = nullptr;

  /// A refused step that crosses one of `count` surfaces is followed by one that ends on the first crossing: the root
  /// of the cubic through the values at both ends of the step and d/ds of them. W numbers for each surface. With a
  /// margin it ends before it, by that part of the refused step, and twice the margin is the step after it; where there
  /// is no room for that, it goes over it at once.
  void (*land)(LaneSteps& steps, double margin, std::size_t count, const double* values, const double* rates,
               const double* values_at_end, const double* rates_at_end) = nullptr;

  /// to <- from in the lanes of the mask.
  void (*accept)(std::size_t dimension, const long long* accepted, const double* from, double* to) = nullptr;
};

/// The widest that this machine runs.
/// @param copy  any number: the kernel_copies copies are used cyclically
[[nodiscard]] const StepLoops& step_loops(std::size_t copy = 0);

/// Those of one instruction set, or nullptr if it was not compiled or this machine does not run it.
/// @param name "baseline", "avx2" or "avx512"
[[nodiscard]] const StepLoops* step_loops(const char* name, std::size_t copy = 0);

}  // namespace epicyclic::integrate
