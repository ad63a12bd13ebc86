// A square matrix that is known as a product of factors, and is not multiplied out: M = M_p-1 ... M_0.
//
// Rounding in the product of matrices is one of its norm. Where some directions grow and others decay, the small
// eigenvalues are lost in it. The periodic Schur form has none of that product: unitary Q_i, with Q_p = Q_0, make
//
//   Q_i+1^H M_i Q_i = R_i   upper triangular for all i ,   eigenvalues   lambda_k = prod_i (R_i)_kk        [A-schur]
//
// Each factor is changed by rounding in parts of its own norm only (backward stable). What that leaves of an eigenvalue
// is measured: by how much they move when factors are perturbed by several times that rounding.
//
// Sources: A. Bojanczyk, G. Golub, P. Van Dooren, Proc. SPIE 1770 (1992) 31; D. Kressner, Numerical Methods for General
// and Structured Eigenvalue Problems (2005), ch. 3. Single shifts on complex matrices; of real factors the eigenvalues
// are put together into real ones and conjugate pairs. One factor: Eigen's Schur form.
#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>

#include "core/dense.hpp"

namespace epicyclic {

template <class Matrix>
struct FactorsOf {
  std::vector<Matrix> factors;  ///< M_0 first; all square, of one size

  [[nodiscard]] Eigen::Index rows() const { return factors.empty() ? 0 : factors.front().rows(); }
  [[nodiscard]] bool empty() const { return rows() == 0; }

  /// M.
  [[nodiscard]] Matrix product() const {
    Matrix m = factors.at(0);
    for (std::size_t i = 1; i < factors.size(); ++i) m = epicyclic::product(factors[i], m);
    return m;
  }

  /// C with det C = +-det(M - at I). Its null vector is x_0 ... x_p-1, x_i+1 = M_i x_i, of one with M x_0 = at x_0.
  ///
  ///   C x = ( M_0 x_0 - x_1, ..., M_p-1 x_p-1 - at x_0 )
  [[nodiscard]] Matrix cyclic(double at) const {
    const Eigen::Index n = rows();
    const auto p = static_cast<Eigen::Index>(factors.size());
    Matrix c = Matrix::Zero(n * p, n * p);
    for (Eigen::Index i = 0; i < p; ++i) {
      c.block(i * n, i * n, n, n) = factors[static_cast<std::size_t>(i)];
      c.block(i * n, (i + 1) % p * n, n, n) -= (i + 1 == p ? at : 1.0) * Matrix::Identity(n, n);
    }
    return c;
  }
};

using MatrixProduct = FactorsOf<Eigen::MatrixXd>;
using ComplexMatrixProduct = FactorsOf<Eigen::MatrixXcd>;

/// By falling modulus; of a pair the one with positive imaginary part first. Eigenvalues that are not conjugate to any
/// other have no imaginary part.
[[nodiscard]] std::vector<std::complex<double>> eigenvalues(const MatrixProduct& m);
/// By falling modulus.
[[nodiscard]] std::vector<std::complex<double>> eigenvalues(const ComplexMatrixProduct& m);

/// How far rounding may have moved each of eigenvalues(m).
[[nodiscard]] std::vector<double> eigenvalue_errors(const MatrixProduct& m);
[[nodiscard]] std::vector<double> eigenvalue_errors(const ComplexMatrixProduct& m);

}  // namespace epicyclic
