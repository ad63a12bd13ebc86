// The project's own N_Vector for SUNDIALS: aligned, padded memory, fused and vectorised operations.
//
// SUNDIALS' stock serial vector spends most of a small system's Runge-Kutta step in loops that go through memory once
// for each operand. Here a linear combination of many vectors is one pass, and the error weights one more. Every
// operation that ARKODE and CVODE may call is there; each states what it computes in the SUNDIALS user guide. Results
// do not depend on the instruction set (integrate/sundials/vector_kernels.hpp).
//
// A vector may have several columns of the same length, the state and its tangent vectors; norms that measure errors
// can be limited to the first column, and are then those of a vector of one column to the last bit.
//
// Limits: doubles, one process, one thread per vector. Its identity is SUNDIALS_NVEC_CUSTOM.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <type_traits>

#include <sundials/sundials_context.h>
#include <sundials/sundials_nvector.h>

#include "integrate/sundials/vector_kernels.hpp"

namespace epicyclic::integrate {

struct VectorDeleter {
  void operator()(N_Vector v) const { N_VDestroy(v); }
};
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, VectorDeleter>;

/// Columns of a vector, and how many of them weighted norms read.
struct VectorShape {
  std::size_t length = 0;  ///< true numbers in a column
  std::size_t columns = 1;
  std::size_t measured_columns = 1;
};

/// A vector of zeros.
///
/// @param kernels_to_use  outlives the vector and its clones
/// @throws SolverError when there is no memory
[[nodiscard]] Vector make_state_vector(const VectorShape& shape, SUNContext context,
                                       const VectorKernels& kernels_to_use = vector_kernels());

/// A vector of one column.
[[nodiscard]] inline Vector make_state_vector(std::size_t dimension, SUNContext context,
                                              const VectorKernels& kernels_to_use = vector_kernels()) {
  return make_state_vector(VectorShape{dimension, 1, 1}, context, kernels_to_use);
}

/// Content of the project's N_Vector.
struct StateVectorContent {
  VectorShape shape;
  std::size_t stride = 0;  ///< of a column, with padding
  const VectorKernels* kernels = nullptr;
  double* data = nullptr;
  bool owns = false;
};
[[nodiscard]] inline const StateVectorContent& content_of(N_Vector v) {
  return *static_cast<const StateVectorContent*>(v->content);
}

/// The numbers of a state vector; aligned to 64 bytes, each column padded with zeros to a multiple of `vector_block`.
[[nodiscard]] inline double* data_of(N_Vector v) { return content_of(v).data; }
/// Distance from the first number of a column to that of the next.
[[nodiscard]] inline std::size_t column_stride(N_Vector v) { return content_of(v).stride; }
[[nodiscard]] inline const VectorShape& shape_of(N_Vector v) { return content_of(v).shape; }
/// Numbers of all columns with padding.
[[nodiscard]] inline std::size_t padded_size(N_Vector v) { return column_stride(v) * shape_of(v).columns; }
[[nodiscard]] inline const VectorKernels& kernels_of(N_Vector v) { return *content_of(v).kernels; }
/// Is each number of each column?
[[nodiscard]] inline bool finite(N_Vector v) {
  return kernels_of(v).within(data_of(v), std::numeric_limits<double>::max(), padded_size(v));
}

}  // namespace epicyclic::integrate
