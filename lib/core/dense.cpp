#include "core/dense.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <tuple>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

// Steps that Eigen's own functions join are called one by one where a function would instantiate more than is used:
// eigenvectors, blocked products with one column, decompositions of matrices that are not square. Each step and its
// operands are Eigen's, and so are the bits.
namespace epicyclic {

namespace {

using Eigen::Index;

// A square matrix needs no preconditioner.
using RealSvd = Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner>;
using ComplexSvd = Eigen::JacobiSVD<Eigen::MatrixXcd, Eigen::NoQRPreconditioner>;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The pair of a 2 x 2 block a, b; c, d of a real Schur form that is not triangular.
std::pair<std::complex<double>, std::complex<double>> pair_of(double a, double b, double c, double d) {
  const double p = 0.5 * (a - d);
  // Scaled, so that no square overflows.
  const double scale = std::max(std::abs(p), std::max(std::abs(c), std::abs(b)));
  const double root = scale * std::sqrt(std::abs((p / scale) * (p / scale) + (c / scale) * (b / scale)));
  return {{d + p, root}, {d + p, -root}};
}

}  // namespace

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return a * b; }

Eigen::MatrixXcd product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) { return a * b; }

Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return a.transpose() * b; }

Eigen::MatrixXcd adjoint_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) { return a.adjoint() * b; }

Eigen::VectorXd least_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> qtz(a);
  const Eigen::MatrixXd& packed = qtz.matrixQTZ();
  const Index rows = a.rows();
  const Index cols = a.cols();
  const Index rank = qtz.rank();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(cols);
  if (rank == 0) return x;

  double work = 0.0;
  Eigen::VectorXd c = b;
  for (Index k = 0; k < rank; ++k)
    c.bottomRightCorner(rows - k, c.cols())
        .applyHouseholderOnTheLeft(
            Eigen::Block<const Eigen::MatrixXd, Eigen::Dynamic, 1>(packed, k + 1, k, rows - k - 1, 1), qtz.hCoeffs()(k),
            &work);
  x.head(rank) = c.head(rank);
  auto determined = x.head(rank);
  packed.topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solveInPlace(determined);
  if (rank < cols)
    for (Index k = 0; k < rank; ++k) {
      std::swap(x(k), x(rank - 1));
      x.middleRows(rank - 1, cols - rank + 1)
          .applyHouseholderOnTheLeft(packed.row(k).tail(cols - rank).adjoint(), qtz.zCoeffs()(k), &work);
      std::swap(x(k), x(rank - 1));
    }
  return qtz.colsPermutation() * x;
}

Eigen::VectorXd solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) { return a.partialPivLu().solve(b); }

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a) {
  const Index n = a.rows();
  Eigen::VectorXcd values = Eigen::VectorXcd::Zero(n);
  const double scale = a.cwiseAbs().maxCoeff();
  if (scale < std::numeric_limits<double>::min()) return values;
  const Eigen::HessenbergDecomposition<Eigen::MatrixXd> hessenberg(a / scale);
  Eigen::RealSchur<Eigen::MatrixXd> schur(n);
  schur.computeFromHessenberg(hessenberg.matrixH(), Eigen::MatrixXd(), false);
  if (schur.info() != Eigen::Success) return Eigen::VectorXcd::Constant(n, not_a_number);
  const Eigen::MatrixXd t = schur.matrixT() * scale;
  for (Index i = 0; i < n; ++i) {
    if (i + 1 == n || t(i + 1, i) == 0.0) {
      values(i) = t(i, i);
    } else {
      std::tie(values(i), values(i + 1)) = pair_of(t(i, i), t(i, i + 1), t(i + 1, i), t(i + 1, i + 1));
      ++i;
    }
  }
  return values;
}

Eigen::VectorXcd complex_eigenvalues(const Eigen::MatrixXcd& a) {
  const Index n = a.rows();
  const Eigen::HessenbergDecomposition<Eigen::MatrixXcd> hessenberg(a);
  Eigen::ComplexSchur<Eigen::MatrixXcd> schur(n);
  schur.computeFromHessenberg(hessenberg.matrixH(), Eigen::MatrixXcd(), false);
  if (schur.info() != Eigen::Success) return Eigen::VectorXcd::Constant(n, not_a_number);
  Eigen::VectorXcd values = schur.matrixT().diagonal();
  const auto smaller = [](const auto& x, const auto& y) { return std::abs(x) < std::abs(y); };
  for (auto next = values.begin(); next != values.end(); ++next)
    std::iter_swap(next, std::min_element(next, values.end(), smaller));
  return values;
}

SingularValues singular_values(const Eigen::MatrixXd& a) {
  const RealSvd svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Eigen::MatrixXcd left_singular_vectors(const Eigen::MatrixXcd& a) {
  return ComplexSvd(a, Eigen::ComputeFullU).matrixU();
}

Eigen::VectorXcd right_null_vector(const Eigen::MatrixXcd& a) {
  return ComplexSvd(a, Eigen::ComputeFullV).matrixV().rightCols(1);
}

SymmetricModes symmetric_modes(const Eigen::MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricModes symmetric_modes(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  // B = L L^T; the modes y = L^T x of L^-1 A L^-T.
  const Eigen::LLT<Eigen::MatrixXd> cholesky(b);
  Eigen::MatrixXd reduced = a.selfadjointView<Eigen::Lower>();
  cholesky.matrixL().solveInPlace<Eigen::OnTheLeft>(reduced);
  cholesky.matrixU().solveInPlace<Eigen::OnTheRight>(reduced);
  SymmetricModes modes = symmetric_modes(reduced);
  cholesky.matrixU().solveInPlace(modes.vectors);
  return modes;
}

Eigen::MatrixXd null_space(const Eigen::MatrixXd& a) {
  const Eigen::FullPivHouseholderQR<Eigen::MatrixXd> qr(a.transpose());
  const Eigen::MatrixXd q = qr.matrixQ();
  return q.rightCols(a.cols() - qr.rank());
}

Eigen::VectorXd orthonormalise(Eigen::MatrixXd& v) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(v);
  v = qr.householderQ() * Eigen::MatrixXd::Identity(v.rows(), v.cols());
  return qr.matrixQR().diagonal();
}

}  // namespace epicyclic
