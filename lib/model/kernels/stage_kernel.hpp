// The right-hand side in double precision and with tangent vectors (dual numbers), compiled once per instruction set
// and chosen at run time.
//
// The text is that of model/right_hand_side.hpp for each of them, and so are the bits: a row's values have lanes of
// their own (core/row.hpp), sums keep their order, and nothing is contracted to a fused multiply-add
// (-ffp-contract=off). Each planet is a lane; AVX-512 has no more to offer four of them than AVX2.
//
// Limits: every configuration but the optimised ones has the baseline only, because an inline function that is not
// inlined must not exist in an instruction set of its own. Wide kernels of plain numbers are compiled for each layout,
// which is worth some 4 %, and not for full coordinates, which nothing but comparisons integrate.
#pragma once

#include <cstddef>

#include "core/dual.hpp"
#include "model/layout.hpp"
#include "model/parameters.hpp"

namespace epicyclic::model {

/// right_hand_side() of N planets.
/// @param layout  the layout that the kernel was requested for
template <std::size_t N>
using StageKernel = void (*)(Layout layout, const Parameters<double, N>& p, std::size_t segment, double s,
                             const double* y, double* dyds);

/// The fastest that this machine runs.
template <std::size_t N>
[[nodiscard]] StageKernel<N> stage_kernel(Layout layout);

/// That of one instruction set, or nullptr if it was not compiled or this machine does not run it.
/// @param name "baseline" or "avx2"; of full coordinates "baseline"
template <std::size_t N>
[[nodiscard]] StageKernel<N> stage_kernel(Layout layout, const char* name);

/// right_hand_side() of any layout with M directions, M = 1 or 4. Four at a time need wide registers, and are compiled
/// for AVX2 only: nullptr elsewhere.
template <std::size_t N, std::size_t M>
using TangentKernel = void (*)(Layout layout, const Parameters<double, N>& p, std::size_t segment, double s,
                               const Dual<M>* y, Dual<M>* dyds);

template <std::size_t N, std::size_t M>
[[nodiscard]] TangentKernel<N, M> tangent_kernel();
template <std::size_t N, std::size_t M>
[[nodiscard]] TangentKernel<N, M> tangent_kernel(const char* name);

}  // namespace epicyclic::model
