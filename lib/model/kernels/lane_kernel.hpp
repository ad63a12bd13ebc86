// The right-hand side of W operating points side by side, compiled for each instruction set, the wider ones
// kernel_copies times [core/instruction_set.hpp], and chosen at run time.
//
// The text is that of model/right_hand_side.hpp, with lanes for scalars. Each lane's bits depend neither on the others
// nor on W nor on the instruction set; they differ from those of model/kernels/stage_kernel.hpp by the rounding of
// sine, cosine and of places in tables. Limits: relative coordinates, but for looks.
#pragma once

#include <cstddef>

#include "model/instant.hpp"
#include "model/kernels/stage_kernel.hpp"
#include "model/lane_parameters.hpp"
#include "model/layout.hpp"
#include "model/stage_look.hpp"

namespace epicyclic::model {

template <std::size_t N, std::size_t W>
struct LaneKernel {
  using Instants = Instant<Lanes<W>, N>;

  /// `count` instants of W phases each, all in the lanes' segments.
  void (*prepare)(const LaneParameters<N, W>& p, std::size_t count, const double* s, Instants* instants) = nullptr;

  /// y and dyds have 2 degrees_of_freedom(L, N) times W numbers, component by component, aligned to 64 bytes.
  void (*evaluate)(const LaneParameters<N, W>& p, const Instants& now, const double* y, double* dyds) = nullptr;

  /// dy/ds, and (dg/dy) v of a tangent vector in each lane, which is as long as y.
  void (*push)(Layout layout, const LaneParameters<N, W>& p, const Instants& now, const double* y, const double* v,
               double* dyds, double* dvds) = nullptr;

  /// contact_distances(), contacts_of(p) times W numbers each.
  void (*measure_contacts)(const LaneParameters<N, W>& p, const Instants& now, const double* y, double* distances,
                           double* rates) = nullptr;
};

/// Looks at W instants of one operating point [model/stage_look.hpp], in any coordinates.
template <std::size_t N, std::size_t W>
struct LookKernel {
  /// As LaneKernel::prepare().
  void (*prepare)(const LaneParameters<N, W>& p, std::size_t count, const double* s,
                  Instant<Lanes<W>, N>* instants) = nullptr;

  /// Of `looks_together` numbers in each row of y and of `rows`, the first W.
  void (*look)(Layout layout, const LaneParameters<N, W>& p, const Instant<Lanes<W>, N>& now, const double* y,
               double* rows) = nullptr;
};

/// That of one instruction set, empty if it was not compiled or this machine does not run it.
template <std::size_t N, std::size_t W>
[[nodiscard]] LookKernel<N, W> look_kernel(const char* name);

/// That of one instruction set, empty if it was not compiled or this machine does not run it, and in full coordinates.
/// @param name "baseline" (W = 2), "avx2" (4) or "avx512" (8)
/// @param copy  any number: kernel_copies of them are taken in turn
template <std::size_t N, std::size_t W>
[[nodiscard]] LaneKernel<N, W> lane_kernel(Layout layout, const char* name, std::size_t copy);

}  // namespace epicyclic::model
