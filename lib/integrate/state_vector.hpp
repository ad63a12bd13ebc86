// The project's own N_Vector for SUNDIALS: aligned, padded memory, fused and vectorised operations.
//
// SUNDIALS' stock serial vector spends most of a small system's Runge-Kutta step in loops that go through memory once
// for each operand. Here a linear combination of many vectors is one pass, and the error weights one more. Every
// operation that ARKODE and CVODE may ask for is there; each states what it computes in the SUNDIALS user guide.
// Results do not depend on the instruction set (integrate/vector_kernels.hpp).
//
// Limits: doubles, one process, one thread per vector. Its identity is SUNDIALS_NVEC_CUSTOM.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

#include <sundials/sundials_context.h>
#include <sundials/sundials_nvector.h>

#include "integrate/vector_kernels.hpp"

namespace epicyclic::integrate {

struct VectorDeleter {
  void operator()(N_Vector v) const { N_VDestroy(v); }
};
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, VectorDeleter>;

/// A vector of zeros.
///
/// @param kernels_to_use  outlives the vector and its clones
/// @throws SolverError when there is no memory
[[nodiscard]] Vector make_state_vector(std::size_t dimension, SUNContext context,
                                       const VectorKernels& kernels_to_use = vector_kernels());

/// The numbers of a state vector; aligned to 64 bytes, padded with zeros to a multiple of `vector_block`.
[[nodiscard]] double* data_of(N_Vector v);
/// Numbers with padding.
[[nodiscard]] std::size_t padded_size(N_Vector v);
[[nodiscard]] const VectorKernels& kernels_of(N_Vector v);

}  // namespace epicyclic::integrate
