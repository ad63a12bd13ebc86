#include "core/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace epicyclic {

Eigen::VectorXd least_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

Eigen::VectorXd solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) { return a.partialPivLu().solve(b); }

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a) { return a.eigenvalues(); }

Eigen::VectorXcd complex_eigenvalues(const Eigen::MatrixXcd& a) {
  return Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(a, false).eigenvalues();
}

SingularValues singular_values(const Eigen::MatrixXd& a) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Eigen::MatrixXcd left_singular_vectors(const Eigen::MatrixXcd& a) {
  return Eigen::JacobiSVD<Eigen::MatrixXcd>(a, Eigen::ComputeFullU).matrixU();
}

Eigen::VectorXcd right_null_vector(const Eigen::MatrixXcd& a) {
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(a, Eigen::ComputeFullV);
  return svd.matrixV().rightCols(1);
}

SymmetricModes symmetric_modes(const Eigen::MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricModes symmetric_modes(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(a, b);
  return {solver.eigenvalues(), solver.eigenvectors()};
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
