// Invariant subspaces of a period map that commutes with a symmetry: its multipliers, sorted by how they break it.
//
// A linear map S of the state with S^N = 1 (planets moved on by one, say) that commutes with the flow at each phase
// commutes with the monodromy M of an orbit that it leaves as it is. The states split into components of symmetry index
// j,
//
//   P_j = 1/N sum_k e^(-2 pi i j k / N) S^k ,    B_j = V_j^H M V_j ,    V_j an orthonormal basis of the range of P_j ,
//                                                                                                        [A-blocks]
// and the multipliers are the eigenvalues of the B_j. B_0 has the multipliers of the disturbances that are equal in all
// parts. B_j and B_(N-j) have conjugate ones: real multipliers form pairs that cross the unit circle together, without
// a change of sign of a determinant of M. In its own block each one is simple.
//
// Neutral directions c (a free rigid rotation: the flow does not change when all states are shifted along c) have M c =
// c whatever the orbit. With C the space of all of them, the blocks act on the states modulo C,
//
//   V_j an orthonormal basis of what of the range of P_j is orthogonal to P_j C ,    B_j = V_j^H M V_j    [A-neutral]
//
// which is the map that M makes of the quotient, since M maps C into itself: the multipliers 1 of C are left out, and
// no others are changed. Sources: M. Golubitsky, I. Stewart, D. Schaeffer,
// Singularities and Groups in Bifurcation Theory II, ch. XII; for the quotient by a group of shifts P. Chossat,
// R. Lauterbach, Methods in Equivariant Bifurcations and Dynamical Systems (2000), ch. 5.
#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/matrix_product.hpp"

namespace epicyclic::analysis {

struct InvariantBlock {
  int symmetry_index = 0;  ///< j of 0 ... N/2
  bool real = true;        ///< j = 0 or N/2: multipliers are real or pairs; else each stands for a pair of two blocks
  Eigen::MatrixXcd basis;  ///< V_j, dimension x size
};

/// S and its order.
struct CyclicSymmetry {
  Eigen::MatrixXd map;                   ///< empty: none
  int order = 1;                         ///< N
  std::vector<InvariantBlock> blocks{};  ///< of invariant_blocks() without neutral directions, made once
  Eigen::MatrixXd neutral{};             ///< directions C as columns; empty: none
};

/// S from a linear map of states.
/// @throws InputError unless the map is linear to rounding, and its power `order` the identity
[[nodiscard]] CyclicSymmetry cyclic_symmetry(std::size_t dimension, int order,
                                             const std::function<std::vector<double>(std::span<const double>)>& map);

/// Those of j = 0 ... N/2 that are not empty; without a symmetry the whole space is one. Neutral directions are in
/// none.
[[nodiscard]] std::vector<InvariantBlock> invariant_blocks(std::size_t dimension, const CyclicSymmetry& symmetry);

/// B_j, with factors as M has them: a symmetry that commutes with the flow at each phase keeps the block in each
/// shooting interval.
[[nodiscard]] MatrixProduct real_block_of(const InvariantBlock& block, const MatrixProduct& monodromy);
[[nodiscard]] ComplexMatrixProduct block_of(const InvariantBlock& block, const MatrixProduct& monodromy);

/// Eigenvalues of B_j, by falling modulus.
[[nodiscard]] std::vector<std::complex<double>> multipliers_of(const InvariantBlock& block,
                                                               const MatrixProduct& monodromy);

/// How far rounding may have moved each of them [A-schur].
[[nodiscard]] std::vector<double> multiplier_errors(const InvariantBlock& block, const MatrixProduct& monodromy);

/// "synchronous", "symmetry index 1 of 3".
[[nodiscard]] std::string block_name(const InvariantBlock& block, int order);

}  // namespace epicyclic::analysis
