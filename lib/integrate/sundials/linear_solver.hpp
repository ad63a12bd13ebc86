// The dense linear solver of implicit methods for SUNDIALS: LU with partial pivoting (Eigen).
//
//   (I - gamma J) x_j = b_j   for each column j of a state vector                                          [A-newton]
//
// SUNDIALS' own dense solver takes its own vectors only. With tangent vectors the matrix is that of the state, used for
// every column: the coupling d(J v)/dy is dropped, which costs Newton's method an iteration where g is curved and
// nothing where it is piecewise linear, as gear meshes are.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

namespace epicyclic::integrate {

struct MatrixDeleter {
  void operator()(SUNMatrix m) const { SUNMatDestroy(m); }
};
struct LinearSolverDeleter {
  void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
};
using Matrix = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, MatrixDeleter>;
using LinearSolver = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, LinearSolverDeleter>;

/// A dense matrix of zeros.
/// @throws SolverError when there is no memory
[[nodiscard]] Matrix make_dense_matrix(std::size_t dimension, SUNContext context);

/// The numbers of a dense matrix, column by column.
[[nodiscard]] double* data_of(SUNMatrix m);

/// A solver for dense matrices and the state vectors of integrate/sundials/state_vector.hpp.
/// @throws SolverError when there is no memory
[[nodiscard]] LinearSolver make_dense_solver(std::size_t dimension, SUNContext context);

}  // namespace epicyclic::integrate
