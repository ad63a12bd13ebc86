// The right-hand side in double precision and with tangent vectors (dual numbers), compiled once per instruction set
// and chosen at run time.
//
// The text is that of model/right_hand_side.hpp for each of them, and so are the bits: a row's values have lanes of
// their own (core/row.hpp), sums keep their order, and nothing is contracted to a fused multiply-add
// (-ffp-contract=off). Each planet is a lane; AVX-512 has no more to offer four of them than AVX2.
//
// Limits: every configuration but the optimised ones has the baseline only, because an inline function that is not
// inlined must not exist in an instruction set of its own. Full coordinates, which nothing but comparisons integrate,
// have no kernels but the plain template (full_coordinates.cpp).
#pragma once

#include <cstddef>

#include "core/dual.hpp"
#include "model/layout.hpp"
#include "model/parameters.hpp"

namespace epicyclic::model {

/// right_hand_side() of one layout and number of planets.
template <std::size_t N>
using StageKernel = void (*)(const Parameters<double, N>& p, std::size_t segment, double s, const double* y,
                             double* dyds);

/// The fastest that this machine runs.
template <Layout L, std::size_t N>
[[nodiscard]] StageKernel<N> stage_kernel();

/// That of one instruction set, or nullptr if it was not compiled or this machine does not run it.
/// @param name "baseline" or "avx2"; of full coordinates "baseline"
template <Layout L, std::size_t N>
[[nodiscard]] StageKernel<N> stage_kernel(const char* name);

/// right_hand_side() with M directions, M = 1 or 4. Four at a time need wide registers, and are compiled for AVX2 and
/// relative coordinates only: nullptr elsewhere.
template <std::size_t N, std::size_t M>
using TangentKernel = void (*)(const Parameters<double, N>& p, std::size_t segment, double s, const Dual<M>* y,
                               Dual<M>* dyds);

template <Layout L, std::size_t N, std::size_t M>
[[nodiscard]] TangentKernel<N, M> tangent_kernel();
template <Layout L, std::size_t N, std::size_t M>
[[nodiscard]] TangentKernel<N, M> tangent_kernel(const char* name);

}  // namespace epicyclic::model

/// EPICYCLIC_FOR_KERNELS(X): X(layout, planets) for each kernel that there is.
/// EPICYCLIC_FOR_ALL_LAYOUTS(X): and for full coordinates.
/// EPICYCLIC_FOR_PLANETS(X) for each number of planets: X(planets).
#define EPICYCLIC_FOR_PLANETS(X) X(2) X(3) X(4) X(5) X(6)
#define EPICYCLIC_FOR_RELATIVE_LAYOUTS(X, N) \
  X(Layout::relative_to_ring, N)             \
  X(Layout::relative_to_carrier, N)          \
  X(Layout::relative_to_carrier_rigid_ring, N)
#define EPICYCLIC_FOR_KERNELS(X)       \
  EPICYCLIC_FOR_RELATIVE_LAYOUTS(X, 2) \
  EPICYCLIC_FOR_RELATIVE_LAYOUTS(X, 3) \
  EPICYCLIC_FOR_RELATIVE_LAYOUTS(X, 4) \
  EPICYCLIC_FOR_RELATIVE_LAYOUTS(X, 5) \
  EPICYCLIC_FOR_RELATIVE_LAYOUTS(X, 6)
#define EPICYCLIC_FOR_LAYOUTS(X, N) EPICYCLIC_FOR_RELATIVE_LAYOUTS(X, N) X(Layout::full, N)
#define EPICYCLIC_FOR_ALL_LAYOUTS(X) \
  EPICYCLIC_FOR_LAYOUTS(X, 2)        \
  EPICYCLIC_FOR_LAYOUTS(X, 3)        \
  EPICYCLIC_FOR_LAYOUTS(X, 4)        \
  EPICYCLIC_FOR_LAYOUTS(X, 5)        \
  EPICYCLIC_FOR_LAYOUTS(X, 6)
