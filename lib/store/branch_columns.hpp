// The columns of orbits on branches and of special points: one list each behind branch.csv and special.csv, the groups
// /branches and /special of results.h5, and docs/reference/columns.md. What a sweep has too has its name and unit.
#pragma once

#include <complex>
#include <cstddef>
#include <string>
#include <vector>

#include "store/column.hpp"
#include "store/stage_columns.hpp"
#include "studies/branches.hpp"
#include "studies/loci.hpp"

namespace epicyclic::store {

/// An orbit on a branch.
struct BranchPlace {
  std::size_t branch = 0, index = 0;
  const studies::BranchRow& row;
};

/// @param planets  number N
/// @param lives    bearings whose lives are known
[[nodiscard]] std::vector<Column<BranchPlace>> branch_columns(std::size_t planets, const KnownLives& lives = {});
[[nodiscard]] std::vector<Column<studies::SpecialRow>> special_columns();

/// A point of a locus.
struct LocusPlace {
  std::size_t locus = 0, index = 0;
  const studies::TracedLocus& of;
  const studies::LocusRow& row;
};
[[nodiscard]] std::vector<Column<LocusPlace>> locus_columns();

/// "0.5+0.866i": re+imi.
[[nodiscard]] std::string multiplier_text(const std::complex<double>& multiplier);

}  // namespace epicyclic::store
