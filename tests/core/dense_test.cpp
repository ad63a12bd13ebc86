// Each decomposition by what defines it, on matrices that are hard for it.

#include "core/dense.hpp"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace epicyclic::dense_test {
namespace {

constexpr double rounding = 1e-13;

Eigen::MatrixXd some_matrix(Eigen::Index rows, Eigen::Index columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [](Eigen::Index i, Eigen::Index j) {
    return std::sin(0.7 * static_cast<double>((i + 1) * (2 + j * j)));
  });
}

TEST(Dense, TheSolutionOfASingularSystemIsTheShortest) {
  Eigen::MatrixXd a = some_matrix(5, 5);
  a.row(4) = a.row(0) - 2.0 * a.row(1);
  const Eigen::VectorXd b = a * some_matrix(5, 1);
  const Eigen::VectorXd x = least_norm_solution(a, b);
  EXPECT_LT((a * x - b).norm(), rounding);
  const Eigen::MatrixXd kernel = null_space(a);
  ASSERT_EQ(kernel.cols(), 1);
  EXPECT_LT((a * kernel).norm(), rounding);
  EXPECT_NEAR(kernel.norm(), 1.0, rounding);
  EXPECT_LT((kernel.transpose() * x).norm(), rounding);
}

TEST(Dense, SingularValuesMakeTheMatrixAgain) {
  const Eigen::MatrixXd a = some_matrix(6, 6);
  const SingularValues svd = singular_values(a);
  EXPECT_LT((svd.u * svd.s.asDiagonal() * svd.v.transpose() - a).norm(), 10.0 * rounding);
  for (Eigen::Index i = 1; i < svd.s.size(); ++i) EXPECT_LE(svd.s(i), svd.s(i - 1));
}

TEST(Dense, ModesSolveTheirEquation) {
  const Eigen::MatrixXd a = some_matrix(4, 4) + some_matrix(4, 4).transpose();
  const Eigen::MatrixXd b = some_matrix(4, 4) * some_matrix(4, 4).transpose() + Eigen::MatrixXd::Identity(4, 4);
  const SymmetricModes of_two = symmetric_modes(a, b);
  EXPECT_LT((a * of_two.vectors - b * of_two.vectors * of_two.values.asDiagonal()).norm(), 10.0 * rounding);
  EXPECT_LT((of_two.vectors.transpose() * b * of_two.vectors - Eigen::MatrixXd::Identity(4, 4)).norm(),
            10.0 * rounding);
  const SymmetricModes of_one = symmetric_modes(a);
  EXPECT_LT((a * of_one.vectors - of_one.vectors * of_one.values.asDiagonal()).norm(), 10.0 * rounding);
  EXPECT_NEAR(eigenvalues(a).real().sum(), a.trace(), rounding);
  Eigen::MatrixXd turn(2, 2);
  turn << 0.0, -1.0, 1.0, 0.0;
  EXPECT_NEAR(std::abs(eigenvalues(turn)(0).imag()), 1.0, rounding);
}

TEST(Dense, AnOrthonormalBasisKeepsTheStretching) {
  Eigen::MatrixXd v = some_matrix(5, 3);
  const Eigen::MatrixXd before = v;
  const Eigen::VectorXd r = orthonormalise(v);
  EXPECT_LT((v.transpose() * v - Eigen::MatrixXd::Identity(3, 3)).norm(), rounding);
  EXPECT_NEAR(std::abs(r(0)), before.col(0).norm(), rounding);
  const double volume = std::sqrt((before.transpose() * before).determinant());
  EXPECT_NEAR(std::abs(r.prod()), volume, rounding);
}

}  // namespace
}  // namespace epicyclic::dense_test
