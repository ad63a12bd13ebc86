// Decompositions and products of dense matrices by Eigen, compiled once: each of their instantiations costs seconds.
#pragma once

#include <Eigen/Core>

namespace epicyclic {

/// A B.
[[nodiscard]] Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
[[nodiscard]] Eigen::MatrixXcd product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);
/// A^T B.
[[nodiscard]] Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// A^H B.
[[nodiscard]] Eigen::MatrixXcd adjoint_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b);

/// x with A x = b in the sense of least squares, of least norm where A is singular (complete orthogonal decomposition).
[[nodiscard]] Eigen::VectorXd least_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// x with A x = b, A regular (LU with partial pivoting). For a singular A the result is not finite or undefined.
[[nodiscard]] Eigen::VectorXd solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// Eigenvalues of a general matrix, in no particular order; not numbers if the iteration does not converge.
[[nodiscard]] Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);
/// Those of a complex one.
[[nodiscard]] Eigen::VectorXcd complex_eigenvalues(const Eigen::MatrixXcd& a);

/// A = U diag(s) V^T of a square A, singular values falling.
struct SingularValues {
  Eigen::MatrixXd u;
  Eigen::VectorXd s;
  Eigen::MatrixXd v;
};
[[nodiscard]] SingularValues singular_values(const Eigen::MatrixXd& a);

/// v of length 1 with |A v| least, A square.
[[nodiscard]] Eigen::VectorXcd right_null_vector(const Eigen::MatrixXcd& a);

/// U alone, of a complex square matrix.
[[nodiscard]] Eigen::MatrixXcd left_singular_vectors(const Eigen::MatrixXcd& a);

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
