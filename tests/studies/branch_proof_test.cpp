// A sweep held against branches: Duffing's cascade, whose flips are known, with sweeps that are right and that are not.

#include "studies/branch_proof.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/poincare.hpp"
#include "core/errors.hpp"
#include "problems/branches.hpp"
#include "studies/axis.hpp"

namespace epicyclic::studies::branch_proof_test {
namespace {

constexpr std::size_t dimension = 2;

/// Duffing's branches over its force, of period 1 and what doubles from it up to `largest`; rows as of a gear train's,
/// whose section is the state alone.
TracedBranches duffing_branches(int largest) {
  const auto flows = [](double tolerance) { return problems::flows(problems::duffing(0.3, -1.0, 1.2), tolerance); };
  const analysis::OrbitFamily family{flows(1e-9)};
  analysis::TreeOptions options{.continuation = {.from = 0.2, .to = 0.3}};
  options.special = problems::with_bounds(flows, 1e-9);
  options.largest_period = largest;
  analysis::BranchTree tree(family, options);
  const analysis::Correction first = first_orbit(family, 0.22, problems::settled(family.flows, 0.22, {1.0, 0.0}, 100));
  EXPECT_TRUE(first.found);
  tree.start(first.orbit);
  while (tree.advance()) {
  }
  TracedBranches traced;
  traced.branches = tree.branches();
  for (const analysis::Branch& branch : traced.branches) {
    std::vector<BranchRow>& rows = traced.rows.emplace_back();
    for (const analysis::BranchOrbit& orbit : branch.orbits) {
      BranchRow row;
      row.value = orbit.at.value;
      row.period = branch.family.period;
      row.multipliers = multipliers_of(branch.family, orbit.monodromy);
      row.stable = row.multiplier_max() < 1.0;
      const Eigen::MatrixXd states = period_states(branch.family, orbit.at);
      row.section.assign(states.data(), states.data() + states.size());
      rows.push_back(row);
    }
  }
  traced.special = special_rows(traced.branches, {});
  return traced;
}

/// The motion at a value, settled.
PointResult motion_at(std::size_t index, double value, Direction direction) {
  const integrate::FlowFamily flows = problems::flows(problems::duffing(0.3, -1.0, 1.2), 1e-9);
  const auto flow = flows(value);
  std::vector<double> y = problems::settled(flows, 0.22, {1.0, 0.0}, 100);
  const auto s = analysis::strobe(
      *flow, y, {600, 32, 1}, [](auto&&...) {}, [] { return true; });
  PointResult r;
  r.point.index = index;
  r.point.value = value;
  r.point.direction = direction;
  r.recurrence = analysis::recurrence(s.section, 8, 1e-6);
  r.period = r.recurrence.period;
  r.regime = r.period > 0 ? analysis::Regime::periodic : analysis::Regime::chaotic;
  r.poincare_columns = dimension;
  for (std::size_t k = 0; k < s.section.size(); ++k)
    r.poincare.insert(r.poincare.end(), s.section.point(k).begin(), s.section.point(k).end());
  return r;
}

SweepOptions sweep_of(double from, double to, int points) {
  SweepOptions sweep;
  sweep.axis = {"g", from, to, points};
  return sweep;
}

std::vector<PointResult> swept(const SweepOptions& sweep) {
  std::vector<PointResult> points;
  for (const double value : axis_values(sweep.axis)) points.push_back(motion_at(points.size(), value, Direction::up));
  return points;
}

BranchProof proved(const TracedBranches& traced, const SweepOptions& sweep, const std::vector<PointResult>& points) {
  return prove(traced, sweep, points_in_memory(points), dimension, {}, [](std::size_t) {});
}

TEST(BranchProof, ChangesOfACascadeAreItsFlips) {
  const SweepOptions sweep = sweep_of(0.261, 0.289, 5);
  const std::vector<PointResult> points = swept(sweep);
  const TracedBranches traced = duffing_branches(2);
  const BranchProof proof = proved(traced, sweep, points);
  // Flips at 0.26558 and 0.28669 [validation of the flips], on a grid of 0.007.
  ASSERT_EQ(proof.changes.size(), 2U);
  EXPECT_EQ(proof.unexplained(), 0U);
  for (const SweepChange& c : proof.changes) {
    EXPECT_EQ(c.cause, Cause::bifurcation) << c.words;
    ASSERT_TRUE(c.special.has_value());
    const SpecialRow& r = traced.special[*c.special];
    EXPECT_EQ(to_string(r.kind), "flip");
    EXPECT_GE(r.value, c.before.value);
    EXPECT_LE(r.value, c.behind.value);
    EXPECT_EQ(c.beside, 0.0);
  }
  // Of period 4 no branch was followed.
  ASSERT_EQ(proof.off.size(), 1U);
  EXPECT_EQ(proof.off[0].period, 4);
  EXPECT_LT(proof.largest_distance, ProofOptions{}.same);
}

TEST(BranchProof, ACascadeBeyondTheLastLocatedFlipIsOne) {
  // From period 4 on to 8, of which no branch is known; both before the cascade's end at 0.2924.
  const SweepOptions sweep = sweep_of(0.2845, 0.2917, 5);
  const BranchProof proof = proved(duffing_branches(2), sweep, swept(sweep));
  ASSERT_EQ(proof.changes.size(), 2U) << proof.changes.size();
  EXPECT_EQ(proof.changes[0].cause, Cause::bifurcation);
  EXPECT_EQ(proof.changes[1].cause, Cause::cascade) << proof.changes[1].words;
}

TEST(BranchProof, WhatIsWrongIsNotExplained) {
  const SweepOptions sweep = sweep_of(0.21, 0.25, 5);
  std::vector<PointResult> points = swept(sweep);
  const TracedBranches traced = duffing_branches(2);
  ASSERT_TRUE(proved(traced, sweep, points).changes.empty());
  // One point told as chaos where the orbit is stable: the motion would leave it for nothing.
  points[2].regime = analysis::Regime::chaotic;
  points[2].period = 0;
  const BranchProof chaos = proved(traced, sweep, points);
  ASSERT_EQ(chaos.changes.size(), 2U);
  EXPECT_EQ(chaos.changes[0].cause, Cause::unexplained);
  EXPECT_NE(chaos.changes[0].words.find("stable"), std::string::npos) << chaos.changes[0].words;
  EXPECT_EQ(chaos.changes[1].cause, Cause::crisis) << "what ends there may have been an attractor";
  EXPECT_EQ(chaos.unexplained(), 1U);
  // One told as undecided, which is on the orbit.
  points[2].regime = analysis::Regime::undecided;
  EXPECT_EQ(proved(traced, sweep, points).unexplained(), 0U);
  // One off the orbit by more than a sweep's errors.
  points[2] = motion_at(2, points[2].point.value, Direction::up);
  for (double& x : points[2].poincare) x += 0.02;
  const BranchProof off = proved(traced, sweep, points);
  ASSERT_EQ(off.off.size(), 1U);
  EXPECT_NEAR(off.off[0].distance, 0.02, 1e-4);
}

TEST(BranchProof, AFlipFarFromTheChangeExplainsNothing) {
  // The sweep doubles at 0.2656; told at 0.25 it would be three steps of the grid away.
  const SweepOptions sweep = sweep_of(0.24, 0.26, 5);
  std::vector<PointResult> points = swept(sweep);
  for (std::size_t k = 2; k < points.size(); ++k) points[k].period = 2;
  const BranchProof proof = proved(duffing_branches(2), sweep, points);
  ASSERT_EQ(proof.changes.size(), 1U);
  EXPECT_EQ(proof.changes[0].cause, Cause::unexplained) << proof.changes[0].words;
}

}  // namespace
}  // namespace epicyclic::studies::branch_proof_test
