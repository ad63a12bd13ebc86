// The right-hand side of W operating points side by side, compiled for each instruction set, the wider ones
// kernel_copies times [core/instruction_set.hpp], and chosen at run time.
//
// The text is that of model/right_hand_side.hpp, with lanes for scalars. Each lane's bits depend neither on the others
// nor on W nor on the instruction set; they differ from those of model/kernels/stage_kernel.hpp by the rounding of
// sine, cosine and of places in tables. Limits: relative coordinates, except for outputs.
#pragma once

#include <cstddef>

#include "model/kernels/stage_kernel.hpp"
#include "model/lane_parameters.hpp"
#include "model/layout.hpp"
#include "model/phase_coefficients.hpp"
#include "model/stage_outputs.hpp"

namespace epicyclic::model {

template <std::size_t N, std::size_t W>
struct LaneKernel {
  using Instants = PhaseCoefficients<Lanes<W>, N>;

  /// `count` instants of W phases each, all in the lanes' segments.
  void (*prepare)(const LaneParameters<N, W>& p, std::size_t count, const double* s,
                  Instants* phase_coefficients) = nullptr;

  /// y and dyds have 2 degrees_of_freedom(L, N) times W numbers, component by component, aligned to 64 bytes.
  void (*evaluate)(const LaneParameters<N, W>& p, const Instants& now, const double* y, double* dyds) = nullptr;

  /// dy/ds, and (dg/dy) v of a tangent vector in each lane, which is as long as y.
  void (*push)(Layout layout, const LaneParameters<N, W>& p, const Instants& now, const double* y, const double* v,
               double* dyds, double* dvds) = nullptr;

  /// contact_distances(), contacts_of(p) times W numbers each.
  void (*measure_contacts)(const LaneParameters<N, W>& p, const Instants& now, const double* y, double* distances,
                           double* rates) = nullptr;
};

/// Evaluates the outputs at W instants of one operating point [model/stage_outputs.hpp], in any coordinates.
template <std::size_t N, std::size_t W>
struct OutputKernel {
  /// As LaneKernel::prepare().
  void (*prepare)(const LaneParameters<N, W>& p, std::size_t count, const double* s,
                  PhaseCoefficients<Lanes<W>, N>* phase_coefficients) = nullptr;

  /// Uses the first W of the `phases_together` numbers in each row of y and of `rows`.
  void (*evaluate_outputs)(Layout layout, const LaneParameters<N, W>& p, const PhaseCoefficients<Lanes<W>, N>& now,
                           const double* y, double* rows) = nullptr;
};

/// That of one instruction set, empty if it was not compiled or this machine does not run it.
template <std::size_t N, std::size_t W>
[[nodiscard]] OutputKernel<N, W> output_kernel(const char* name);

/// That of one instruction set, empty if it was not compiled or this machine does not run it, and in full coordinates.
/// @param name "baseline" (W = 2), "avx2" (4) or "avx512" (8)
/// @param copy  any number: the kernel_copies copies are used cyclically
template <std::size_t N, std::size_t W>
[[nodiscard]] LaneKernel<N, W> lane_kernel(Layout layout, const char* name, std::size_t copy);

}  // namespace epicyclic::model
