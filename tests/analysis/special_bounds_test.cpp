// Do the bounds of special points hold? Each kind, on systems of six kinds, at random tolerances and subdivisions.

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "problems/branches.hpp"

namespace epicyclic::analysis::special_bounds_test {
namespace {

using problems::BranchProblem;

/// What came of one special point in all computations.
struct Tally {
  std::size_t truths = 0;
  std::size_t compared = 0;
  std::size_t outside = 0;     ///< further from the truth than the bound
  std::size_t unresolved = 0;  ///< told as such, in an interval that holds it
  std::size_t missing = 0;     ///< without a word
  std::vector<double> ratios;  ///< bound over error
  std::set<SpecialKind> kinds;
};

/// One special point among those found at another tolerance.
void compare(const SpecialPoint& truth, const std::vector<SpecialPoint>& found, Tally& tally) {
  const SpecialPoint* nearest = nullptr;
  const auto distance = [&](const SpecialPoint& p) { return std::abs(p.value - truth.value); };
  for (const SpecialPoint& p : found)
    if (p.kind == truth.kind && p.symmetry_index == truth.symmetry_index &&
        (nearest == nullptr || distance(p) < distance(*nearest)))
      nearest = &p;
  // Two of one kind are never so near in these systems.
  constexpr double another = 1e-3;
  if (nearest == nullptr || distance(*nearest) > another) {
    const bool told = std::any_of(found.begin(), found.end(), [&](const SpecialPoint& p) {
      return p.kind == SpecialKind::unresolved && distance(p) <= p.error_bound;
    });
    ++(told ? tally.unresolved : tally.missing);
    return;
  }
  // The truth has to be known to a tenth of the bound.
  if (truth.error_bound > 0.1 * nearest->error_bound) return;
  ++tally.compared;
  if (distance(*nearest) > nearest->error_bound) ++tally.outside;
  tally.ratios.push_back(nearest->error_bound / distance(*nearest));
}

TEST(SpecialPointsLong, BoundsHoldAndAreNotIdle) {
  std::mt19937_64 random(2026);
  std::uniform_real_distribution<double> exponent(-10.0, -6.0);
  std::uniform_int_distribution<int> shooting_intervals(1, 3);
  Tally tally;
  for (const BranchProblem& problem : problems::branch_problems()) {
    // By a tolerance far below all others.
    const std::vector<SpecialPoint> reference = problem.trace(1e-13, 3).special;
    tally.truths += reference.size();
    for (const SpecialPoint& p : reference) tally.kinds.insert(p.kind);
    constexpr int trials = 12;
    for (int trial = 0; trial < trials; ++trial) {
      const double tolerance = std::pow(10.0, exponent(random));
      const std::vector<SpecialPoint> found = problem.trace(tolerance, shooting_intervals(random)).special;
      for (const SpecialPoint& truth : reference) compare(truth, found, tally);
    }
  }
  std::sort(tally.ratios.begin(), tally.ratios.end());
  const double median = tally.ratios.at(tally.ratios.size() / 2);
  RecordProperty("truths", std::to_string(tally.truths));
  RecordProperty("compared", std::to_string(tally.compared));
  RecordProperty("outside", std::to_string(tally.outside));
  RecordProperty("unresolved", std::to_string(tally.unresolved));
  RecordProperty("missing", std::to_string(tally.missing));
  RecordProperty("median_ratio", std::to_string(median));
  EXPECT_GE(tally.truths, 40U);
  EXPECT_EQ(tally.kinds,
            (std::set<SpecialKind>{SpecialKind::fold, SpecialKind::branch_point, SpecialKind::period_doubling,
                                   SpecialKind::neimark_sacker, SpecialKind::grazing}));
  EXPECT_GE(tally.compared, 200U);
  EXPECT_LE(100 * tally.outside, tally.compared);  // 2 of 200
  EXPECT_LE(100 * (tally.unresolved + tally.missing), 3 * tally.compared);
  EXPECT_LE(median, 100.0);
}

}  // namespace
}  // namespace epicyclic::analysis::special_bounds_test
