// A sweep held against branches: Duffing's cascade, whose flips are known, with sweeps that are right and that are not.

#include "studies/branch_proof.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/poincare.hpp"
#include "core/errors.hpp"
#include "problems/branches.hpp"
#include "studies/axis.hpp"

namespace epicyclic::studies::branch_proof_test {
namespace {

/// Branches from the motion that is settled at a value, of period 1 and what doubles from it up to `largest`; rows as
/// of a gear train's, whose section is the state alone.
TracedBranches branches_of(const FieldFamily& fields, double value, const analysis::ContinuationOptions& continuation,
                           int largest, int period = 1, const std::vector<double>& start = {1.0, 0.0}) {
  const auto flows = [&fields](double tolerance) { return problems::flows(fields, tolerance); };
  analysis::OrbitFamily family{flows(1e-9)};
  family.period = period;
  analysis::TreeOptions options{.continuation = continuation};
  options.special = problems::with_bounds(flows, 1e-9);
  options.largest_period = largest;
  analysis::BifurcationDiagram tree(family, options);
  const analysis::Correction first = first_orbit(family, value, problems::settled(family.flows, value, start, 100));
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

/// Duffing's, over its force.
TracedBranches duffing_branches(int largest) {
  return branches_of(problems::duffing(0.3, -1.0, 1.2), 0.22, {.from = 0.2, .to = 0.3}, largest);
}

/// The motion at a value that one from `y` settles to, which is carried on.
PointResult settled_point(const integrate::FlowFamily& flows, std::vector<double>& y, std::size_t index, double value,
                          Direction direction) {
  const auto flow = flows(value);
  const auto s = analysis::strobe(
      *flow, y, {600, 32, 1}, [](auto&&...) {}, [] { return true; });
  PointResult r;
  r.point.index = index;
  r.point.value = value;
  r.point.direction = direction;
  r.recurrence = analysis::recurrence(s.section, 8, 1e-6);
  r.period = r.recurrence.period;
  r.regime = r.period > 0 ? analysis::Regime::periodic : analysis::Regime::chaotic;
  r.poincare_columns = y.size();
  for (std::size_t k = 0; k < s.section.size(); ++k)
    r.poincare.insert(r.poincare.end(), s.section.point(k).begin(), s.section.point(k).end());
  return r;
}

/// Points carried from one to the next, each way from what the first value has; kicked a little at each, where what is
/// unstable would stay.
std::vector<PointResult> carried(const FieldFamily& fields, const SweepOptions& sweep, const std::vector<double>& start,
                                 double kick) {
  const integrate::FlowFamily flows = problems::flows(fields, 1e-9);
  std::vector<PointResult> points;
  for (const Direction direction : sweep.directions) {
    std::vector<double> values = axis_values(sweep.axis);
    if (direction == Direction::down) std::ranges::reverse(values);
    std::vector<double> y = problems::settled(flows, values.front(), start, 400);
    for (const double value : values) {
      y[0] += kick;
      points.push_back(settled_point(flows, y, points.size(), value, direction));
    }
  }
  return points;
}

/// The motion of Duffing's at a value, settled.
PointResult motion_at(std::size_t index, double value, Direction direction) {
  const integrate::FlowFamily flows = problems::flows(problems::duffing(0.3, -1.0, 1.2), 1e-9);
  std::vector<double> y = problems::settled(flows, 0.22, {1.0, 0.0}, 100);
  return settled_point(flows, y, index, value, direction);
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
  const auto dimension = static_cast<std::size_t>(traced.branches.front().orbits.front().at.states.rows());
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

/// The resonance of a hardening spring: one branch, turning back at two folds, between which a sweep up is on its upper
/// and one down on its lower stretch.
class OfAResonance : public testing::Test {
 protected:
  OfAResonance() : traced(branches_of(fields, 1.4, {.from = 1.3, .to = 3.3, .max_step = 0.05}, 1)) {
    for (const SpecialRow& r : traced.special)
      if (r.kind == analysis::SpecialKind::fold) folds.push_back(r.value);
    std::ranges::sort(folds);
  }

  FieldFamily fields = problems::duffing_in_frequency(0.1, 1.0, 1.0);
  TracedBranches traced;
  std::vector<double> folds;
};

TEST_F(OfAResonance, JumpsAreChangesExplainedWhereAStretchEnds) {
  ASSERT_EQ(traced.branches.size(), 1U);
  ASSERT_EQ(folds.size(), 2U);
  SweepOptions sweep = sweep_of(1.35, 3.25, 48);
  sweep.directions = {Direction::up, Direction::down};
  std::vector<PointResult> points = carried(fields, sweep, {1.0, 0.0}, 0.0);
  const BranchProof proof = proved(traced, sweep, points);
  EXPECT_TRUE(proof.off.empty());
  ASSERT_EQ(proof.changes.size(), 2U);
  EXPECT_EQ(proof.unexplained(), 0U);
  for (std::size_t k = 0; k < 2; ++k) {
    const SweepChange& c = proof.changes[k];
    EXPECT_EQ(c.direction, sweep.directions[k]);
    EXPECT_TRUE(c.counted);
    EXPECT_EQ(c.cause, Cause::jump) << c.words;
    EXPECT_NE(c.words.find("another stretch of branch 0"), std::string::npos) << c.words;
    ASSERT_TRUE(c.special.has_value());
    EXPECT_EQ(traced.special[*c.special].value, k == 0 ? folds.back() : folds.front());
  }

  // A jump where neither stretch ends is unexplained: up to their middle, and from there on as the sweep down has it.
  const double middle = 0.5 * (folds.front() + folds.back());
  for (std::size_t i = 0; i < 48; ++i) {
    if (points[i].point.value < middle) continue;
    points[i] = points[95 - i];
    points[i].point.index = i;
    points[i].point.direction = Direction::up;
  }
  const BranchProof early = proved(traced, sweep, points);
  ASSERT_EQ(early.changes.size(), 2U);
  EXPECT_EQ(early.changes[0].cause, Cause::unexplained) << early.changes[0].words;
  EXPECT_NE(early.changes[0].words.find("stable"), std::string::npos) << early.changes[0].words;
  EXPECT_EQ(early.changes[1].cause, Cause::jump) << early.changes[1].words;
}

TEST_F(OfAResonance, PointsUpToTheFoldAreOnTheBranch) {
  SweepOptions sweep = sweep_of(folds.back() - 1e-3, folds.back() - 1e-5, 12);
  const integrate::FlowFamily flows = problems::flows(fields, 1e-9);
  std::vector<double> y = problems::settled(flows, 1.4, {1.0, 0.0}, 100);
  for (double w = 1.4; w < sweep.axis.from; w += 0.02) y = problems::settled(flows, w, y, 100);
  std::vector<PointResult> points;
  for (const double value : axis_values(sweep.axis))
    points.push_back(settled_point(flows, y, points.size(), value, Direction::up));
  const BranchProof proof = proved(traced, sweep, points);
  EXPECT_EQ(proof.periodic, 12U);
  EXPECT_TRUE(proof.off.empty()) << proof.off.size() << " of 12";
  EXPECT_TRUE(proof.changes.empty());
}

TEST(BranchProof, WhereABranchIsBornOfOneThatIsNotFollowedItEnds) {
  const TracedBranches doubled = branches_of(problems::duffing(0.3, -1.0, 1.2), 0.28, {.from = 0.2, .to = 0.3}, 2, 2);
  ASSERT_EQ(doubled.branches.size(), 1U);
  const SweepOptions sweep = sweep_of(0.261, 0.289, 5);
  const BranchProof proof = proved(doubled, sweep, swept(sweep));
  ASSERT_EQ(proof.changes.size(), 2U);
  EXPECT_EQ(proof.unexplained(), 0U);
  EXPECT_EQ(proof.changes[0].cause, Cause::jump);
  EXPECT_FALSE(proof.changes[0].special.has_value());
  EXPECT_NE(proof.changes[0].words.find("branch 0 ends at 0.2655"), std::string::npos) << proof.changes[0].words;
  EXPECT_EQ(proof.changes[1].cause, Cause::bifurcation) << proof.changes[1].words;
  ASSERT_FALSE(proof.off.empty());
  EXPECT_EQ(proof.off.front().period, 1);
}

/// A parametric oscillator whose rest flips subcritically at 0.1485: the doubled orbits that are born there are
/// unstable, turn at the fold at 0.1079 and are stable from there on to the flip at 0.3415.
class OfASubcriticalFlip : public testing::Test {
 protected:
  FieldFamily fields = integrate::make_field_family(
      2, 2.0 * std::numbers::pi, [](const auto& p, std::size_t, double s, const auto* y, auto* d) {
        d[0] = y[1];
        d[1] = -0.05 * y[1] - 12.0 * y[0] * y[0] * y[1] - (p + 0.2 * std::cos(s)) * y[0] - 3.0 * y[0] * y[0] * y[0];
      });
  TracedBranches traced = branches_of(fields, 0.05, {.from = 0.02, .to = 0.5}, 2);
};

TEST_F(OfASubcriticalFlip, WhatIsBornElsewhereIsJumpedTo) {
  ASSERT_EQ(traced.branches.size(), 2U);
  const SweepOptions up = sweep_of(0.115, 0.205, 4);
  const BranchProof there = proved(traced, up, carried(fields, up, {0.3, 0.0}, 1e-3));
  ASSERT_EQ(there.changes.size(), 1U);
  EXPECT_EQ(there.changes[0].cause, Cause::jump) << there.changes[0].words;
  EXPECT_NE(there.changes[0].words.find("flip of branch 0 at 0.148"), std::string::npos) << there.changes[0].words;
  // On the way down the flip is behind the motion, within a step, and the fold between the values.
  SweepOptions down = sweep_of(0.078, 0.245, 5);
  down.directions = {Direction::down};
  const BranchProof back = proved(traced, down, carried(fields, down, {0.3, 0.0}, 1e-3));
  ASSERT_EQ(back.changes.size(), 1U);
  EXPECT_EQ(back.changes[0].cause, Cause::jump) << back.changes[0].words;
  EXPECT_NE(back.changes[0].words.find("fold of branch 1 at 0.107"), std::string::npos) << back.changes[0].words;
}

/// A Hopf bifurcation about a forced motion at 0, whose torus is born there, or subcritically, when it is stable from
/// -1/4 on.
FieldFamily hopf(bool subcritical) {
  if (!subcritical) return problems::forced_hopf(0.3);
  return integrate::make_field_family(2, 2.0 * std::numbers::pi,
                                      [](const auto& p, std::size_t, double s, const auto* y, auto* d) {
                                        using T = std::remove_cvref_t<decltype(d[0])>;
                                        const T a = y[0] - std::cos(s);
                                        const T b = y[1] - std::sin(s);
                                        const T r2 = a * a + b * b;
                                        const T gain = p + r2 - r2 * r2;
                                        d[0] = gain * a - 0.3 * b - std::sin(s);
                                        d[1] = 0.3 * a + gain * b + std::cos(s);
                                      });
}

TEST(BranchProof, ATorusThatTheOtherWayHasBesideTheOrbitIsNotBornThere) {
  for (const bool subcritical : {false, true}) {
    const FieldFamily fields = hopf(subcritical);
    const TracedBranches traced = branches_of(fields, -0.2, {.from = -0.35, .to = 0.1}, 1);
    SweepOptions sweep = sweep_of(-0.31, 0.09, 9);
    sweep.directions = {Direction::up, Direction::down};
    std::vector<PointResult> points = carried(fields, sweep, {1.0, 0.0}, 1e-3);
    for (PointResult& r : points)
      if (r.period == 0) r.regime = analysis::Regime::quasiperiodic;
    const BranchProof proof = proved(traced, sweep, points);
    ASSERT_EQ(proof.changes.size(), 2U) << subcritical;
    EXPECT_EQ(proof.changes[0].cause, subcritical ? Cause::jump : Cause::bifurcation) << proof.changes[0].words;
    EXPECT_EQ(proof.changes[1].cause, subcritical ? Cause::crisis : Cause::bifurcation) << proof.changes[1].words;
    ASSERT_TRUE(proof.changes[0].special.has_value());
    EXPECT_EQ(to_string(traced.special[*proof.changes[0].special].kind), "neimark_sacker");
  }
}

TEST(BranchProof, AFoldBesideTheStartOfAClosedBranchEndsTheStretchAcrossIt) {
  const FieldFamily fields = problems::closed_branch();
  for (const double start : {0.0, 0.99999}) {
    const double w = std::sqrt(1.0 - start * start);
    const TracedBranches traced = branches_of(fields, start, {.from = -1.5, .to = 1.5}, 1, 1, {1.0 + w});
    ASSERT_EQ(traced.branches.size(), 1U);
    ASSERT_EQ(traced.branches[0].last.end, analysis::BranchEnd::closed);
    const SweepOptions sweep = sweep_of(0.95, 1.03, 2);
    const integrate::FlowFamily flows = problems::flows(fields, 1e-9);
    std::vector<double> y = {1.3};
    std::vector<PointResult> points = {settled_point(flows, y, 0, 0.95, Direction::up)};
    // Beyond the fold there is no orbit.
    PointResult& beyond = points.emplace_back();
    beyond.point.index = 1;
    beyond.point.value = 1.03;
    beyond.regime = analysis::Regime::chaotic;
    const BranchProof proof = proved(traced, sweep, points);
    ASSERT_EQ(proof.changes.size(), 1U) << start;
    EXPECT_EQ(proof.changes[0].cause, Cause::jump) << start << ": " << proof.changes[0].words;
    EXPECT_NE(proof.changes[0].words.find("fold of branch 0"), std::string::npos) << proof.changes[0].words;
  }
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
