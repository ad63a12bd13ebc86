#include "core/matrix_product.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <Eigen/Jacobi>
#include <Eigen/QR>

#include "core/dense.hpp"
#include "core/random_numbers.hpp"

namespace epicyclic {

namespace {

using Complex = std::complex<double>;
using Matrix = Eigen::MatrixXcd;
using Index = Eigen::Index;
using Rotation = Eigen::JacobiRotation<Complex>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// The periodic Schur form of p >= 1 complex factors: the first one is a Hessenberg matrix until it is triangular, the
/// others are triangular.
class PeriodicSchur {
 public:
  explicit PeriodicSchur(const std::vector<Matrix>& factors) : n_(factors.front().rows()), p_(factors.size()) {
    for (const Matrix& m : factors) {
      scales_.push_back(std::max(m.norm(), std::numeric_limits<double>::min()));
      a_.push_back(m / scales_.back());
    }
    triangularise();
    reduce_to_hessenberg();
  }

  /// @returns nothing if the iteration did not come to an end
  std::vector<Complex> eigenvalues() {
    Index high = n_ - 1;
    int since = 0;
    while (high > 0) {
      Index low = high;
      while (low > 0 && !negligible(low)) --low;
      if (low > 0) a_[0](low, low - 1) = 0.0;
      if (low == high) {
        --high;
        since = 0;
        continue;
      }
      constexpr int patience = 60;
      if (++since > patience) return {};
      sweep(low, high, since);
    }
    std::vector<Complex> values;
    for (Index k = 0; k < n_; ++k) {
      Complex value = 1.0;
      for (std::size_t i = 0; i < p_; ++i) value *= scales_[i] * a_[i](k, k);
      values.push_back(value);
    }
    return values;
  }

 private:
  void triangularise() {
    for (std::size_t i = 1; i < p_; ++i) {
      const Eigen::HouseholderQR<Matrix> qr(a_[i]);
      const Matrix q = qr.householderQ();
      a_[i] = qr.matrixQR().triangularView<Eigen::Upper>();
      Matrix& next = a_[(i + 1) % p_];
      next = next * q;
    }
  }

  /// The rotation of two neighbouring rows of a factor that makes the lower one's element in a column zero. Rows of
  /// M_i are columns of M_i+1.
  void rotate_rows(std::size_t i, Index upper, Index column) {
    Rotation r;
    Complex length;
    r.makeGivens(a_[i](upper, column), a_[i](upper + 1, column), &length);
    a_[i].applyOnTheLeft(upper, upper + 1, r.adjoint());
    a_[i](upper + 1, column) = 0.0;
    a_[(i + 1) % p_].applyOnTheRight(upper, upper + 1, r);
  }

  /// Around all factors, from one that makes an element of the Hessenberg matrix zero to the columns of that matrix.
  void chase(Index upper, Index column) {
    rotate_rows(0, upper, column);
    for (std::size_t i = 1; i < p_; ++i) rotate_rows(i, upper, upper);
  }

  void reduce_to_hessenberg() {
    for (Index column = 0; column + 2 < n_; ++column)
      for (Index row = n_ - 1; row >= column + 2; --row) chase(row - 1, column);
  }

  [[nodiscard]] bool negligible(Index row) const {
    const Matrix& h = a_[0];
    const double neighbours = std::abs(h(row, row)) + std::abs(h(row - 1, row - 1));
    // The factor's norm is 1.
    return std::abs(h(row, row - 1)) <= epsilon * (neighbours > 0.0 ? neighbours : 1.0);
  }

  /// Eigenvalue of the product's last 2 x 2 block that is nearer to its last element.
  [[nodiscard]] Complex shift(Index high) const {
    Eigen::Matrix2cd b = a_[0].block<2, 2>(high - 1, high - 1);
    for (std::size_t i = 1; i < p_; ++i) b = a_[i].block<2, 2>(high - 1, high - 1).triangularView<Eigen::Upper>() * b;
    const Complex half = 0.5 * (b(0, 0) - b(1, 1));
    const Complex root = std::sqrt(half * half + b(0, 1) * b(1, 0));
    const Complex middle = 0.5 * (b(0, 0) + b(1, 1));
    const Complex one = middle + root;
    const Complex other = middle - root;
    return std::abs(one - b(1, 1)) < std::abs(other - b(1, 1)) ? one : other;
  }

  /// An implicit QR step with a single shift on the rows low ... high.
  void sweep(Index low, Index high, int since) {
    // The product's first column, two elements of it.
    Complex x = a_[0](low, low);
    Complex y = a_[0](low + 1, low);
    for (std::size_t i = 1; i < p_; ++i) {
      x = a_[i](low, low) * x + a_[i](low, low + 1) * y;
      y = a_[i](low + 1, low + 1) * y;
    }
    constexpr int exceptional = 10;
    x -= since % exceptional == 0 ? Complex(0.75 * std::abs(y), 0.25 * std::abs(x)) : shift(high);
    Rotation r;
    Complex length;
    r.makeGivens(x, y, &length);
    a_[0].applyOnTheRight(low, low + 1, r);
    if (p_ == 1) {
      a_[0].applyOnTheLeft(low, low + 1, r.adjoint());
    } else {
      // From the last factor's rows to the first one's: column rotations make each factor triangular again.
      a_[p_ - 1].applyOnTheLeft(low, low + 1, r.adjoint());
      for (std::size_t i = p_ - 1; i >= 1; --i) {
        Rotation c;
        // The first column is that of (g, -f), so that the row (f, g) has no first element any more.
        const Complex f = a_[i](low + 1, low);
        const Complex g = a_[i](low + 1, low + 1);
        c.makeGivens(g, -f, &length);
        a_[i].applyOnTheRight(low, low + 1, c);
        a_[i](low + 1, low) = 0.0;
        a_[i - 1].applyOnTheLeft(low, low + 1, c.adjoint());
      }
    }
    for (Index k = low; k + 2 <= high; ++k) chase(k + 1, k);
  }

  Index n_;
  std::size_t p_;
  std::vector<Matrix> a_;
  std::vector<double> scales_;
};

void sort_by_modulus(std::vector<Complex>& values) {
  std::sort(values.begin(), values.end(), [](const Complex& a, const Complex& b) {
    return std::abs(a) != std::abs(b) ? std::abs(a) > std::abs(b) : a.imag() > b.imag();
  });
}

/// Real values and conjugate pairs of what is that to rounding.
void pair_conjugates(std::vector<Complex>& values) {
  std::vector<bool> done(values.size(), false);
  // The farthest from the real axis first: their partners are beyond doubt.
  std::vector<std::size_t> order(values.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(values[a].imag()) > std::abs(values[b].imag());
  });
  for (const std::size_t k : order) {
    if (done[k]) continue;
    done[k] = true;
    std::size_t partner = k;
    double least = 2.0 * std::abs(values[k].imag());
    for (const std::size_t other : order) {
      const double apart = std::abs(values[other] - std::conj(values[k]));
      if (!done[other] && apart < least) {
        partner = other;
        least = apart;
      }
    }
    if (partner == k) {
      values[k] = values[k].real();
    } else {
      done[partner] = true;
      const Complex mean = 0.5 * (values[k] + std::conj(values[partner]));
      values[k] = mean;
      values[partner] = std::conj(mean);
    }
  }
}

std::vector<Complex> of_factors(const std::vector<Matrix>& factors) {
  std::vector<Complex> values = PeriodicSchur(factors).eigenvalues();
  if (!values.empty()) return values;
  const Eigen::VectorXcd e = complex_eigenvalues(ComplexMatrixProduct{factors}.product());
  return {e.begin(), e.end()};
}

/// M with each factor changed at random by `part` of its norm, both of Frobenius.
template <class Matrix>
FactorsOf<Matrix> perturbed(const FactorsOf<Matrix>& m, double part, int draw) {
  FactorsOf<Matrix> changed = m;
  std::uint64_t number = 0;
  for (Matrix& f : changed.factors) {
    // The norm of a matrix with uniform entries in (-a, a) is a n / sqrt(3).
    const double size = part * f.norm() * std::sqrt(3.0) / static_cast<double>(f.rows());
    for (auto& x : f.reshaped()) x += size * (2.0 * random_uniform(static_cast<std::uint64_t>(draw), ++number) - 1.0);
  }
  return changed;
}

}  // namespace

std::vector<Complex> eigenvalues(const MatrixProduct& m) {
  if (m.empty()) return {};
  std::vector<Complex> values;
  if (m.factors.size() == 1) {
    const Eigen::VectorXcd e = eigenvalues(m.factors.front());
    values.assign(e.begin(), e.end());
  } else {
    std::vector<Matrix> factors;
    for (const Eigen::MatrixXd& f : m.factors) factors.push_back(f.cast<Complex>());
    values = of_factors(factors);
    pair_conjugates(values);
  }
  sort_by_modulus(values);
  return values;
}

std::vector<Complex> eigenvalues(const ComplexMatrixProduct& m) {
  if (m.empty()) return {};
  std::vector<Complex> values;
  if (m.factors.size() == 1) {
    const Eigen::VectorXcd e = complex_eigenvalues(m.factors.front());
    values.assign(e.begin(), e.end());
  } else {
    values = of_factors(m.factors);
  }
  sort_by_modulus(values);
  return values;
}

namespace {

template <class Matrix>
std::vector<double> errors_of(const FactorsOf<Matrix>& m) {
  // Some times what rotations change a factor by. Not scaled down from a larger perturbation: of eigenvalues that
  // nearly coincide the change goes with its root. Fewer draws may all miss the direction that an eigenvalue is
  // sensitive to.
  constexpr double several = 16.0;
  constexpr int draws = 10;
  const double size = several * static_cast<double>(m.rows()) * epsilon;
  const std::vector<Complex> values = eigenvalues(m);
  std::vector<double> errors(values.size(), 0.0);
  for (int draw = 1; draw <= draws; ++draw) {
    std::vector<Complex> others = eigenvalues(perturbed(m, size, draw));
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto nearest = std::min_element(others.begin(), others.end(), [&](const auto& a, const auto& b) {
        return std::abs(a - values[k]) < std::abs(b - values[k]);
      });
      errors[k] = std::max(errors[k], std::abs(*nearest - values[k]));
      others.erase(nearest);
    }
  }
  return errors;
}

}  // namespace

std::vector<double> eigenvalue_errors(const MatrixProduct& m) { return errors_of(m); }
std::vector<double> eigenvalue_errors(const ComplexMatrixProduct& m) { return errors_of(m); }

}  // namespace epicyclic
