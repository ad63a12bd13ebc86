// Decompositions of dense matrices by Eigen, compiled once: each of their instantiations costs seconds.
#pragma once

#include <Eigen/Core>

namespace epicyclic {

/// x with A x = b in the sense of least squares, of least norm where A is singular (complete orthogonal decomposition).
[[nodiscard]] Eigen::VectorXd least_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// Eigenvalues of a general matrix, in no particular order.
[[nodiscard]] Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);

/// A = U diag(s) V^T, singular values falling.
struct SingularValues {
  Eigen::MatrixXd u;
  Eigen::VectorXd s;
  Eigen::MatrixXd v;
};
[[nodiscard]] SingularValues singular_values(const Eigen::MatrixXd& a);

/// Eigenvalues, rising, and eigenvectors as columns.
struct SymmetricModes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
/// A x = lambda x of a symmetric matrix.
[[nodiscard]] SymmetricModes symmetric_modes(const Eigen::MatrixXd& a);
/// A x = lambda B x, B symmetric and positive definite; x^T B x = 1.
[[nodiscard]] SymmetricModes symmetric_modes(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Orthonormal basis of the vectors that all rows of A are orthogonal to, as columns.
[[nodiscard]] Eigen::MatrixXd null_space(const Eigen::MatrixXd& a);

/// V = Q R with orthonormal columns of Q, as many as V has: V becomes Q.
/// @returns the diagonal of R
Eigen::VectorXd orthonormalise(Eigen::MatrixXd& v);

}  // namespace epicyclic
