#include "analysis/invariant_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/dense.hpp"
#include "core/errors.hpp"

namespace epicyclic::analysis {

namespace {

// Rounding of maps that are made of sines, cosines and sums of a state's components.
constexpr double block_rounding = 1e-12;

/// Orthonormal basis of the range of a projector, whose trace is its rank.
Eigen::MatrixXcd range_of(const Eigen::MatrixXcd& projector) {
  const auto rank = static_cast<Eigen::Index>(std::lround(projector.trace().real()));
  return left_singular_vectors(projector).leftCols(rank);
}

/// Orthonormal basis of the columns' span.
Eigen::MatrixXcd span_of(const Eigen::MatrixXcd& columns) {
  Eigen::MatrixXcd q(columns.rows(), 0);
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    Eigen::VectorXcd v = columns.col(k);
    const double length = v.norm();
    // Twice is enough for orthogonality to rounding.
    for (int again = 0; again < 2; ++again) v -= q * (q.adjoint() * v);
    constexpr double dependent = 1e-10;
    if (!(v.norm() > dependent * length)) continue;
    q.conservativeResize(Eigen::NoChange, q.cols() + 1);
    q.rightCols(1) = v.normalized();
  }
  return q;
}

/// A block without what it has of the neutral directions [A-neutral].
InvariantBlock without_neutral(InvariantBlock block, const CyclicSymmetry& symmetry, int order) {
  // P_j C; rounding if the neutral directions have no component of this symmetry index.
  Eigen::MatrixXcd part = Eigen::MatrixXcd::Zero(symmetry.neutral.rows(), symmetry.neutral.cols());
  Eigen::MatrixXd moved = symmetry.neutral;
  for (int k = 0; k < order; ++k) {
    part += std::polar(1.0 / order, -2.0 * std::numbers::pi * block.symmetry_index * k / order) *
            moved.cast<std::complex<double>>();
    if (k + 1 < order) moved = product(symmetry.map, moved);
  }
  for (Eigen::Index k = 0; k < part.cols(); ++k)
    if (part.col(k).norm() <= block_rounding * symmetry.neutral.col(k).norm()) part.col(k).setZero();
  if (block.real) part = part.real().cast<std::complex<double>>();
  const Eigen::MatrixXcd q = span_of(adjoint_product(block.basis, part));
  if (q.cols() == 0) return block;
  const Eigen::Index size = block.basis.cols();
  block.basis = product(block.basis, range_of(Eigen::MatrixXcd::Identity(size, size) - product(q, q.adjoint())));
  return block;
}

std::vector<InvariantBlock> all_blocks(std::size_t dimension, const CyclicSymmetry& symmetry) {
  if (!symmetry.blocks.empty()) return symmetry.blocks;
  const auto n = static_cast<Eigen::Index>(dimension);
  const int order = symmetry.map.size() == 0 ? 1 : symmetry.order;
  std::vector<InvariantBlock> blocks;
  for (int j = 0; 2 * j <= order; ++j) {
    Eigen::MatrixXcd projector = Eigen::MatrixXcd::Zero(n, n);
    Eigen::MatrixXd power = Eigen::MatrixXd::Identity(n, n);
    for (int k = 0; k < order; ++k) {
      projector +=
          std::polar(1.0 / order, -2.0 * std::numbers::pi * j * k / order) * power.cast<std::complex<double>>();
      if (k + 1 < order) power = product(symmetry.map, power);
    }
    InvariantBlock block{j, j == 0 || 2 * j == order, {}};
    if (order == 1) {
      block.basis = projector;
    } else if (block.real) {
      // A real projector has a real basis.
      block.basis = range_of(projector.real().cast<std::complex<double>>());
    } else {
      block.basis = range_of(projector);
    }
    if (block.basis.cols() > 0) blocks.push_back(std::move(block));
  }
  return blocks;
}

}  // namespace

CyclicSymmetry cyclic_symmetry(std::size_t dimension, int order,
                               const std::function<std::vector<double>(std::span<const double>)>& map) {
  const auto n = static_cast<Eigen::Index>(dimension);
  CyclicSymmetry s{Eigen::MatrixXd(n, n), order};
  std::vector<double> unit(dimension, 0.0);
  for (Eigen::Index k = 0; k < n; ++k) {
    unit[static_cast<std::size_t>(k)] = 1.0;
    const std::vector<double> image = map(unit);
    s.map.col(k) = Eigen::Map<const Eigen::VectorXd>(image.data(), n);
    unit[static_cast<std::size_t>(k)] = 0.0;
  }
  Eigen::MatrixXd power = Eigen::MatrixXd::Identity(n, n);
  for (int k = 0; k < order; ++k) power = product(s.map, power);
  if (!((power - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff() <= block_rounding))
    throw InputError("a symmetry of order " + std::to_string(order) + " is not the identity after as many times");
  std::vector<double> probe(dimension);
  for (std::size_t k = 0; k < dimension; ++k) probe[k] = 1.0 + 1.0 / static_cast<double>(k + 1);
  const std::vector<double> image = map(probe);
  const Eigen::VectorXd linear = s.map * Eigen::Map<const Eigen::VectorXd>(probe.data(), n);
  if (!((linear - Eigen::Map<const Eigen::VectorXd>(image.data(), n)).cwiseAbs().maxCoeff() <=
        block_rounding * static_cast<double>(dimension)))
    throw InputError("a symmetry is not a linear map of the state");
  s.blocks = invariant_blocks(dimension, s);
  return s;
}

std::vector<InvariantBlock> invariant_blocks(std::size_t dimension, const CyclicSymmetry& symmetry) {
  if (symmetry.neutral.size() == 0) return all_blocks(dimension, symmetry);
  const int order = symmetry.map.size() == 0 ? 1 : symmetry.order;
  std::vector<InvariantBlock> blocks;
  for (InvariantBlock& block : all_blocks(dimension, symmetry))
    if (InvariantBlock left = without_neutral(std::move(block), symmetry, order); left.basis.cols() > 0)
      blocks.push_back(std::move(left));
  return blocks;
}

MatrixProduct real_block_of(const InvariantBlock& block, const MatrixProduct& monodromy) {
  const Eigen::MatrixXd v = block.basis.real();
  MatrixProduct b;
  for (const Eigen::MatrixXd& m : monodromy.factors) b.factors.push_back(product(transposed_product(v, m), v));
  return b;
}

ComplexMatrixProduct block_of(const InvariantBlock& block, const MatrixProduct& monodromy) {
  ComplexMatrixProduct b;
  for (const Eigen::MatrixXd& m : monodromy.factors)
    b.factors.push_back(product(block.basis.adjoint() * m, block.basis));
  return b;
}

std::vector<std::complex<double>> multipliers_of(const InvariantBlock& block, const MatrixProduct& monodromy) {
  return block.real ? eigenvalues(real_block_of(block, monodromy)) : eigenvalues(block_of(block, monodromy));
}

std::vector<double> multiplier_errors(const InvariantBlock& block, const MatrixProduct& monodromy) {
  return block.real ? eigenvalue_errors(real_block_of(block, monodromy))
                    : eigenvalue_errors(block_of(block, monodromy));
}

std::string block_name(const InvariantBlock& block, int order) {
  if (block.symmetry_index == 0) return "synchronous";
  return "symmetry index " + std::to_string(block.symmetry_index) + " of " + std::to_string(order);
}

}  // namespace epicyclic::analysis
