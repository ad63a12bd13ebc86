#include "integrate/sundials/linear_solver.hpp"

#include <algorithm>
#include <new>

#include <Eigen/LU>
#include <sunmatrix/sunmatrix_dense.h>

#include "integrate/sundials/state_vector.hpp"

namespace epicyclic::integrate {

namespace {

using Factors = Eigen::PartialPivLU<Eigen::MatrixXd>;

Factors& factors_of(SUNLinearSolver s) { return *static_cast<Factors*>(s->content); }

SUNLinearSolver_Type type(SUNLinearSolver /*s*/) { return SUNLINEARSOLVER_DIRECT; }
SUNLinearSolver_ID identity(SUNLinearSolver /*s*/) { return SUNLINEARSOLVER_CUSTOM; }
int initialize(SUNLinearSolver /*s*/) { return SUNLS_SUCCESS; }

int setup(SUNLinearSolver s, SUNMatrix a) {
  Factors& factors = factors_of(s);
  const Eigen::Index n = factors.rows();
  factors.compute(Eigen::Map<const Eigen::MatrixXd>(data_of(a), n, n));
  // A singular or non-finite matrix: the caller tries a smaller step.
  const auto pivots = factors.matrixLU().diagonal().array().abs();
  return (pivots > 0.0).all() && pivots.isFinite().all() ? SUNLS_SUCCESS : SUNLS_LUFACT_FAIL;
}

int solve(SUNLinearSolver s, SUNMatrix /*a*/, N_Vector x, N_Vector b, realtype /*tolerance*/) {
  const Factors& factors = factors_of(s);
  const VectorShape shape = shape_of(x);
  const std::size_t stride = column_stride(x);
  for (std::size_t j = 0; j < shape.columns; ++j) {
    const Eigen::Map<const Eigen::VectorXd> right(data_of(b) + j * stride, factors.rows());
    Eigen::Map<Eigen::VectorXd> solution(data_of(x) + j * stride, factors.rows());
    solution = factors.solve(right);
  }
  return SUNLS_SUCCESS;
}

int destroy(SUNLinearSolver s) {
  if (s == nullptr) return SUNLS_SUCCESS;
  delete static_cast<Factors*>(s->content);
  s->content = nullptr;
  SUNLinSolFreeEmpty(s);
  return SUNLS_SUCCESS;
}

}  // namespace

Matrix make_dense_matrix(std::size_t dimension, SUNContext context) {
  const auto n = static_cast<sunindextype>(dimension);
  Matrix m(SUNDenseMatrix(n, n, context));
  if (!m) throw std::bad_alloc();
  SUNMatZero(m.get());
  return m;
}

double* data_of(SUNMatrix m) { return SUNDenseMatrix_Data(m); }

LinearSolver make_dense_solver(std::size_t dimension, SUNContext context) {
  LinearSolver s(SUNLinSolNewEmpty(context));
  if (!s) throw std::bad_alloc();
  s->ops->gettype = &type;
  s->ops->getid = &identity;
  s->ops->initialize = &initialize;
  s->ops->setup = &setup;
  s->ops->solve = &solve;
  s->ops->free = &destroy;
  s->content = new Factors(static_cast<Eigen::Index>(dimension));
  return s;
}

}  // namespace epicyclic::integrate
