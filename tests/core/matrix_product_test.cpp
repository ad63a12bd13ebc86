#include "core/matrix_product.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <gtest/gtest.h>

#include "core/dense.hpp"
#include "core/random_numbers.hpp"

namespace epicyclic::matrix_product_test {
namespace {

using Complex = std::complex<double>;

/// Draws from [0, 1).
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}
  double operator()() { return random_uniform(seed_, ++number_); }

 private:
  std::uint64_t seed_;
  std::uint64_t number_ = 0;
};

struct KnownProduct {
  MatrixProduct m;
  std::vector<Complex> eigenvalues;
};

/// Factors that stretch and turn in the same planes, seen in another orthonormal basis at the end of each.
/// @param spread  log of the greatest modulus over the least, at most
KnownProduct random_product(Draw& draw, double spread) {
  const auto n = 2 + static_cast<Eigen::Index>(10.0 * draw());
  const auto p = 2 + static_cast<std::size_t>(8.0 * draw());
  std::vector<Eigen::MatrixXd> bases;
  for (std::size_t i = 0; i < p; ++i) {
    Eigen::MatrixXd any(n, n);
    for (double& x : any.reshaped()) x = draw() - 0.5;
    bases.emplace_back(Eigen::HouseholderQR<Eigen::MatrixXd>(any).householderQ());
  }
  KnownProduct known;
  std::vector<Eigen::MatrixXd> inner(p, Eigen::MatrixXd::Zero(n, n));
  const auto pieces = static_cast<double>(p);
  for (Eigen::Index k = 0; k < n;) {
    const double log = (draw() - 0.5) * spread;
    const double stretch = std::exp(log / pieces);
    if (k + 1 < n && draw() < 0.5) {
      const double angle = 0.1 + 2.9 * draw();
      const Eigen::Rotation2Dd turn(angle / pieces);
      for (Eigen::MatrixXd& d : inner) d.block<2, 2>(k, k) = stretch * turn.toRotationMatrix();
      known.eigenvalues.push_back(std::polar(std::exp(log), angle));
      known.eigenvalues.push_back(std::polar(std::exp(log), -angle));
      k += 2;
    } else {
      for (Eigen::MatrixXd& d : inner) d(k, k) = stretch;
      const double sign = draw() < 0.5 ? -1.0 : 1.0;
      inner[0](k, k) *= sign;
      known.eigenvalues.emplace_back(sign * std::exp(log));
      ++k;
    }
  }
  for (std::size_t i = 0; i < p; ++i)
    known.m.factors.emplace_back(bases[(i + 1) % p] * inner[i] * bases[i].transpose());
  return known;
}

std::size_t nearest(const std::vector<Complex>& values, Complex to) {
  const auto at = std::min_element(values.begin(), values.end(),
                                   [&](Complex a, Complex b) { return std::abs(a - to) < std::abs(b - to); });
  return static_cast<std::size_t>(at - values.begin());
}

TEST(MatrixProduct, EigenvaluesAreKnownToTheErrorsThatAreTold) {
  Draw draw(3);
  for (int k = 0; k < 1000; ++k) {
    const KnownProduct known = random_product(draw, 40.0 * draw());
    const std::vector<Complex> values = eigenvalues(known.m);
    const std::vector<double> errors = eigenvalue_errors(known.m);
    ASSERT_EQ(values.size(), known.eigenvalues.size());
    for (const Complex truth : known.eigenvalues) {
      const std::size_t at = nearest(values, truth);
      ASSERT_LE(std::abs(values[at] - truth), errors[at]) << "product " << k << ", eigenvalue " << truth;
    }
  }
}

TEST(MatrixProduct, SmallEigenvaluesArePreciseWhereTheProductHasLostThem) {
  // Moduli from 1e-13 to 1e13 by nine factors of 130 and less.
  Draw draw(7);
  double worst = 0.0;
  double worst_of_the_product = 0.0;
  for (int k = 0; k < 100; ++k) {
    KnownProduct known = random_product(draw, 60.0);
    if (known.m.factors.size() < 6) continue;
    const std::vector<Complex> values = eigenvalues(known.m);
    const Eigen::VectorXcd e = eigenvalues(known.m.product());
    const std::vector<Complex> of_the_product(e.begin(), e.end());
    for (const Complex truth : known.eigenvalues) {
      worst = std::max(worst, std::abs(values[nearest(values, truth)] / truth - 1.0));
      worst_of_the_product =
          std::max(worst_of_the_product, std::abs(of_the_product[nearest(of_the_product, truth)] / truth - 1.0));
    }
  }
  constexpr double rounding_times_condition = 1e-9;  // of factors of norms up to e^5, a hundred times
  EXPECT_LT(worst, rounding_times_condition);
  EXPECT_GT(worst_of_the_product, 1.0);
}

TEST(MatrixProduct, RealFactorsHaveRealEigenvaluesAndConjugatePairs) {
  Draw draw(5);
  for (int k = 0; k < 100; ++k) {
    const KnownProduct known = random_product(draw, 10.0);
    const std::vector<Complex> values = eigenvalues(known.m);
    std::size_t real = 0;
    std::size_t expected = 0;
    for (const Complex x : known.eigenvalues) expected += x.imag() == 0.0 ? 1 : 0;
    for (const Complex x : values) {
      real += x.imag() == 0.0 ? 1 : 0;
      EXPECT_EQ(values[nearest(values, std::conj(x))], std::conj(x));
    }
    EXPECT_EQ(real, expected);
  }
}

TEST(MatrixProduct, OneFactorIsEigensSchurForm) {
  Eigen::MatrixXd a(3, 3);
  a << 2.0, 1.0, 0.0, -1.0, 2.0, 0.3, 0.0, 0.1, -4.0;
  const Eigen::VectorXcd e = eigenvalues(a);
  const std::vector<Complex> values = eigenvalues(MatrixProduct{{a}});
  for (const Complex x : values) EXPECT_EQ(*std::find(e.begin(), e.end(), x), x);
  EXPECT_TRUE(
      std::is_sorted(values.begin(), values.end(), [](Complex p, Complex q) { return std::abs(p) > std::abs(q); }));
}

TEST(MatrixProduct, ComplexFactorsHaveTheSameEigenvalues) {
  Draw draw(9);
  const KnownProduct known = random_product(draw, 5.0);
  ComplexMatrixProduct m;
  for (const Eigen::MatrixXd& f : known.m.factors) m.factors.emplace_back(f.cast<Complex>());
  const std::vector<Complex> values = eigenvalues(m);
  for (const Complex truth : known.eigenvalues) EXPECT_LT(std::abs(values[nearest(values, truth)] - truth), 1e-11);
}

TEST(MatrixProduct, ASingularFactorHasAnEigenvalueOfZero) {
  Draw draw(13);
  KnownProduct known = random_product(draw, 4.0);
  known.m.factors[1].col(0).setZero();
  const std::vector<Complex> values = eigenvalues(known.m);
  ASSERT_FALSE(values.empty());
  EXPECT_LT(std::abs(values.back()), 1e-12);
}

TEST(MatrixProduct, TheCyclicMatrixIsSingularAtAnEigenvalueAndHasItsVector) {
  Draw draw(17);
  const KnownProduct known = random_product(draw, 3.0);
  const auto real =
      std::find_if(known.eigenvalues.begin(), known.eigenvalues.end(), [](Complex x) { return x.imag() == 0.0; });
  ASSERT_NE(real, known.eigenvalues.end());
  const double at = real->real();
  const SingularValues s = singular_values(known.m.cyclic(at));
  constexpr double rounding = 1e-12;
  EXPECT_LT(s.s(s.s.size() - 1), rounding);
  const Eigen::VectorXd v = s.v.col(s.s.size() - 1).head(known.m.rows());
  EXPECT_LT((known.m.product() * v - at * v).norm(), rounding * 1e2);
}

}  // namespace
}  // namespace epicyclic::matrix_product_test
