// Branches of periodic orbits and their special points, on systems with known answers.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/bifurcation_diagram.hpp"
#include "analysis/branch_switching.hpp"
#include "analysis/smoothing_bias.hpp"
#include "core/dense.hpp"
#include "core/errors.hpp"
#include "problems/branches.hpp"
#include "problems/clearance_exact.hpp"
#include "problems/harmonic_balance.hpp"
#include "problems/known_systems.hpp"
#include "problems/planes.hpp"

namespace epicyclic::analysis::continuation_test {
namespace {

using problems::BranchProblem;
using problems::flows;
using problems::settled;
using problems::trace;
using problems::Traced;

constexpr double tolerance = 1e-11;

SpecialOptions with_bounds(const FieldFamily& fields) {
  return problems::with_bounds([&](double to_tolerance) { return flows(fields, to_tolerance); }, tolerance);
}

/// The branch from the orbit that a motion settles to, the way of a rising parameter.
Traced trace(const OrbitFamily& family, const FieldFamily& fields, const ContinuationOptions& options, double value,
             const std::vector<double>& start, int periods) {
  const Correction first = first_orbit(family, value, settled(family.flows, value, start, periods));
  EXPECT_TRUE(first.found) << first.message;
  return first.found ? trace(family, options, with_bounds(fields), first.orbit) : Traced{};
}

// What is located holds to what is asked of it, eight digits, and to its own bound.
constexpr double eight_digits = 1e-8;

void expect_at(const SpecialPoint& p, SpecialKind kind, double value, double known_to) {
  EXPECT_EQ(to_string(p.kind), to_string(kind));
  EXPECT_LT(p.error_bound, eight_digits);
  EXPECT_NEAR(p.value, value, p.error_bound + known_to);
  EXPECT_TRUE(p.note.empty()) << p.note;
}

/// One unit of the tenth decimal.
constexpr double tenth_decimal = 1e-10;

TEST(Continuation, FindsDuffingsPublishedFlip) {
  const FieldFamily fields = problems::duffing(0.3, -1.0, 1.2);
  const Traced t = trace({flows(fields, tolerance)}, fields, {.from = 0.2, .to = 0.3}, 0.2, {1.0, 0.0}, 100);
  ASSERT_EQ(t.special.size(), 1U);
  expect_at(t.special[0], SpecialKind::period_doubling, 0.2655817861, 0.5 * tenth_decimal);
  EXPECT_TRUE(t.special[0].outwards);
  EXPECT_EQ(t.end, BranchEnd::range);
  EXPECT_EQ(t.orbits.back().at.value, 0.3);
}

TEST(Continuation, FindsDuffingsFoldsWhereHarmonicBalanceHasThem) {
  const FieldFamily fields = problems::duffing_in_frequency(0.1, 1.0, 0.3);
  const OrbitFamily family{flows(fields, tolerance)};
  const Traced t = trace(family, fields, {.from = 0.5, .to = 2.5}, 0.6, {1.0, 0.0}, 100);
  ASSERT_EQ(t.special.size(), 2U);
  constexpr double printed[] = {1.77972, 1.32424};  // docs/theory/published_results.md, section 4
  constexpr double fifth_decimal = 0.5e-5;
  const problems::HarmonicBalance balance(0.1, 0.3);
  for (std::size_t k = 0; k < 2; ++k) {
    const SpecialPoint& p = t.special[k];
    EXPECT_NEAR(p.value, printed[k], fifth_decimal);
    const auto flow = family.flows(p.value);
    const Eigen::VectorXd y = p.orbit.at.states.col(0);
    const std::vector<double> x = problems::over_a_period(*flow, y);
    constexpr double aside = 1e-4;
    std::vector<double> along = problems::over_a_period(*flow, y + aside * p.orbit.direction.states.col(0));
    for (std::size_t i = 0; i < along.size(); ++i) along[i] -= x[i];
    const double fold = balance.fold(problems::HarmonicBalance::start(x, p.value, along));
    constexpr double balanced = 1e-12;  // differences between 16 and 20 harmonics
    expect_at(p, SpecialKind::fold, fold, balanced);
  }
  EXPECT_EQ(t.end, BranchEnd::range);
}

TEST(Continuation, FindsTheNeimarkSackerPointOfTheNormalForm) {
  const FieldFamily fields = problems::forced_hopf(0.3);
  const Traced t = trace({flows(fields, tolerance)}, fields, {.from = -0.1, .to = 0.1}, -0.1, {1.0, 0.0}, 1);
  ASSERT_EQ(t.special.size(), 1U);
  expect_at(t.special[0], SpecialKind::neimark_sacker, 0.0, 0.0);
  EXPECT_NEAR(std::abs(std::arg(t.special[0].multiplier)), 2.0 * std::numbers::pi * 0.3, eight_digits);
}

TEST(Continuation, FindsAFlipAndATorusThatCrossOppositeWaysBetweenNeighbours) {
  // One multiplier comes in at 0 and a pair leaves behind it: by their number one has left.
  constexpr double torus = 0.001;
  const FieldFamily fields = [](double p) { return problems::flips_and_tori()(p, 0.1 - torus); };
  const OrbitFamily family{flows(fields, tolerance)};
  const std::vector<double> state = {1.0, 0.0, 0.0, 0.0};
  const Correction before = first_orbit(family, -0.05, state);
  const Correction behind = first_orbit(family, 0.05, state);
  ASSERT_TRUE(before.found && behind.found);
  for (const bool upwards : {true, false}) {
    BranchOrbit a = upwards ? before.orbit : behind.orbit;
    BranchOrbit b = upwards ? behind.orbit : before.orbit;
    if (!upwards) {
      a.direction = -1.0 * a.direction;
      b.direction = -1.0 * b.direction;
    }
    const std::vector<SpecialPoint> points = special_points_between(family, a, b, with_bounds(fields));
    ASSERT_EQ(points.size(), 2U) << upwards;
    expect_at(points[upwards ? 0 : 1], SpecialKind::period_doubling, 0.0, 0.0);
    expect_at(points[upwards ? 1 : 0], SpecialKind::neimark_sacker, torus, 0.0);
    EXPECT_EQ(points[upwards ? 0 : 1].outwards, !upwards);
    EXPECT_EQ(points[upwards ? 1 : 0].outwards, upwards);
  }
}

TEST(Continuation, FindsToriThatComeAndGoBetweenNeighbours) {
  // One pair leaves at -0.002 and another comes in at 0.003: by their number nothing happens. Neighbours are as far
  // apart as the continuation lets them be, 0.2 of a multiplier's way.
  const FieldFamily fields = [](double p) {
    return problems::about_a_forced_motion<4>([](const auto& x, double, double, const auto* w, auto* d) {
      d[0] = (x + 0.002) * w[0] - 0.3 * w[1];
      d[1] = 0.3 * w[0] + (x + 0.002) * w[1];
      d[2] = (0.003 - x) * w[2] - 0.2 * w[3];
      d[3] = 0.2 * w[2] + (0.003 - x) * w[3];
    })(p, 0.0);
  };
  const OrbitFamily family{flows(fields, tolerance)};
  const std::vector<double> state = {1.0, 0.0, 0.0, 0.0};
  const Correction before = first_orbit(family, -0.015, state);
  const Correction behind = first_orbit(family, 0.015, state);
  ASSERT_TRUE(before.found && behind.found);
  const std::vector<SpecialPoint> points =
      special_points_between(family, before.orbit, behind.orbit, with_bounds(fields));
  ASSERT_EQ(points.size(), 2U);
  expect_at(points[0], SpecialKind::neimark_sacker, -0.002, 0.0);
  expect_at(points[1], SpecialKind::neimark_sacker, 0.003, 0.0);
  EXPECT_TRUE(points[0].outwards);
  EXPECT_FALSE(points[1].outwards);
}

TEST(Continuation, TellsStrongResonancesOfNeimarkSackerPoints) {
  for (const auto& [turns, resonance] :
       {std::pair{1.0 / 3.0, 3}, {2.0 / 3.0, 3}, {0.25, 4}, {0.2, 0}, {0.3, 0}, {0.25 + 1e-6, 0}}) {
    const FieldFamily fields = problems::forced_hopf(turns);
    const Traced t = trace({flows(fields, tolerance)}, fields, {.from = -0.1, .to = 0.1}, -0.1, {1.0, 0.0}, 1);
    ASSERT_EQ(t.special.size(), 1U) << turns;
    expect_at(t.special[0], SpecialKind::neimark_sacker, 0.0, 0.0);
    EXPECT_EQ(t.special[0].resonance, resonance) << turns;
  }
  // Half a turn is -1 twice with two eigenvectors, and each orbit that leaves has the period 2: no torus.
  const FieldFamily half = problems::forced_hopf(0.5);
  const Traced flip = trace({flows(half, tolerance)}, half, {.from = -0.1, .to = 0.1}, -0.1, {1.0, 0.0}, 1);
  ASSERT_EQ(flip.special.size(), 1U);
  EXPECT_EQ(to_string(flip.special[0].kind), "flip");
  EXPECT_LE(std::abs(flip.special[0].value), flip.special[0].error_bound);
  EXPECT_EQ(flip.special[0].nullity, 2);
  // Without anything to compare with the angle is not known to be one.
  const Traced alone =
      problems::trace({flows(problems::forced_hopf(0.25), tolerance)}, {.from = -0.1, .to = 0.1}, {},
                      first_orbit({flows(problems::forced_hopf(0.25), tolerance)}, -0.1, std::vector{1.0, 0.0}).orbit);
  ASSERT_EQ(alone.special.size(), 1U);
  EXPECT_EQ(alone.special[0].resonance, 0);
}

TEST(Continuation, KnowsAClosedBranchWhenItIsBack) {
  const FieldFamily fields = problems::closed_branch();
  const Traced t = trace({flows(fields, tolerance)}, fields, {.from = -2.0, .to = 2.0}, 0.3, {2.0}, 10);
  EXPECT_EQ(t.end, BranchEnd::closed);
  ASSERT_EQ(t.special.size(), 2U);
  expect_at(t.special[0], SpecialKind::fold, 1.0, 0.0);
  expect_at(t.special[1], SpecialKind::fold, -1.0, 0.0);
  double once_around = 0.0;
  for (std::size_t i = 1; i < t.orbits.size(); ++i) {
    const auto angle = [](const BranchOrbit& o) { return std::atan2(o.at.states(0, 0) - 1.0, o.at.value); };
    once_around += std::remainder(angle(t.orbits[i]) - angle(t.orbits[i - 1]), 2.0 * std::numbers::pi);
  }
  EXPECT_NEAR(std::abs(once_around), 2.0 * std::numbers::pi, eight_digits);
}

TEST(Continuation, StopsAtValuesThatAreAskedForOnBothSidesOfAFold) {
  const FieldFamily fields = problems::closed_branch();
  const ContinuationOptions options{.from = -0.5, .to = 2.0, .values = {0.4, 0.95}};
  const Traced t = trace({flows(fields, tolerance)}, fields, options, 0.3, {2.0}, 10);
  EXPECT_EQ(t.end, BranchEnd::range);
  EXPECT_EQ(t.orbits.back().at.value, -0.5);
  std::vector<double> at;
  for (const BranchOrbit& o : t.orbits)
    if (o.at.value == 0.4 || o.at.value == 0.95) {
      at.push_back(o.at.value);
      EXPECT_NEAR(std::abs(o.at.states(0, 0) - 1.0), std::sqrt(1.0 - o.at.value * o.at.value), eight_digits);
    }
  EXPECT_EQ(at, (std::vector<double>{0.4, 0.95, 0.95, 0.4}));
}

TEST(Continuation, FromAnEndOfTheRangeOutwardsThereIsNothing) {
  const FieldFamily fields = problems::closed_branch();
  const OrbitFamily family{flows(fields, tolerance)};
  const Correction first = first_orbit(family, 0.5, std::array{1.866});
  ASSERT_TRUE(first.found);
  Continuation branch(family, {.from = 0.0, .to = 0.5}, first.orbit);
  EXPECT_FALSE(branch.advance());
  EXPECT_EQ(branch.end(), BranchEnd::range);
}

TEST(Continuation, NamesTheSymmetryThatAPitchforkBreaks) {
  const FieldFamily fields = problems::alike_parts<3>();
  OrbitFamily family{flows(fields, tolerance)};
  family.symmetry = problems::moved_on(3);
  const Traced t = trace(family, fields, {.from = -0.1, .to = 0.1}, -0.1, {1.0, 1.0, 1.0}, 1);
  ASSERT_EQ(t.special.size(), 1U);
  expect_at(t.special[0], SpecialKind::branch_point, 0.0, 0.0);
  EXPECT_EQ(t.special[0].symmetry_index, 1);
  const auto blocks = invariant_blocks(3, family.symmetry);
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(block_name(blocks[1], 3), "symmetry index 1 of 3");
}

TEST(Continuation, TwoPairsOfFourPartsCrossAtOnce) {
  // Waves 1 and 2 of 4: two multipliers and one, at one place.
  const FieldFamily fields = problems::alike_parts<4>();
  OrbitFamily family{flows(fields, tolerance)};
  family.symmetry = problems::moved_on(4);
  const Traced t = trace(family, fields, {.from = -0.1, .to = 0.1}, -0.1, {1.0, 1.0, 1.0, 1.0}, 1);
  ASSERT_EQ(t.special.size(), 2U);
  for (const SpecialPoint& p : t.special) expect_at(p, SpecialKind::branch_point, 0.0, 0.0);
  EXPECT_NE(t.special[0].symmetry_index, t.special[1].symmetry_index);
}

// ---- the clearance oscillator, exact -----------------------------------------------------------------------------

/// The period-1 branch over its resonance.
Traced clearance_branch(double e, double width = 0.0, double to_tolerance = tolerance) {
  BranchProblem problem;
  problem.flows = [=](double finer) { return problems::clearance_flows(e, finer, width); };
  problem.start = 0.3;
  problem.state = {1.1, 0.0};
  problem.settle = 100;
  problem.options = {.from = 0.2, .to = 2.2};
  return problem.trace(to_tolerance, 1);
}

/// Where the closed form has a fold or flip: P(y, W) = y and det(M -+ I) = 0, by Newton's method from a place nearby.
double closed_form(const SpecialPoint& near, double e) {
  const double sign = near.kind == SpecialKind::period_doubling ? 1.0 : -1.0;
  const auto equations = [&](const Eigen::Vector3d& z) {
    const problems::BasicClearanceExact<long double> exact(z(2), 0.05, 0.1, e);
    std::array<double, 4> m = {1.0, 0.0, 0.0, 1.0};
    const auto end = exact.evolve({z(0), z(1)}, 0.0, 2.0 * std::numbers::pi, &m);
    return Eigen::Vector3d(end[0] - z(0), end[1] - z(1), (m[0] + sign) * (m[3] + sign) - m[1] * m[2]);
  };
  Eigen::Vector3d z(near.orbit.at.states(0, 0), near.orbit.at.states(1, 0), near.value);
  for (int k = 0; k < 10; ++k) {
    Eigen::MatrixXd j(3, 3);
    for (Eigen::Index i = 0; i < 3; ++i) {
      constexpr double h = 1e-6;
      j.col(i) =
          (equations(z + h * Eigen::Vector3d::Unit(i)) - equations(z - h * Eigen::Vector3d::Unit(i))) / (2.0 * h);
    }
    z += epicyclic::solution(j, -equations(z));
  }
  return z(2);
}

/// Where the motion on one side of the gap comes to its edge: E W^2 = F_m |1 - W^2 + 2 i z W|.
double closed_form_grazing(double e, double sign) {
  const auto [z, mean, unused] = problems::ClearanceConstants{};
  const double a = 1.0 - (e / mean) * (e / mean);
  const double b = 2.0 - 4.0 * z * z;
  // a u^2 - b u + 1 = 0, u = W^2.
  return std::sqrt((b + sign * std::sqrt(b * b - 4.0 * a)) / (2.0 * a));
}

// Rounding of Newton's method on differences of the closed form.
constexpr double closed_form_known = 1e-12;

TEST(ClearanceBranch, GrazesAndFoldsWhereTheClosedFormDoes) {
  constexpr double e = 0.05;
  const Traced t = clearance_branch(e, 0.0, 1e-13);
  ASSERT_EQ(t.special.size(), 4U);
  expect_at(t.special[0], SpecialKind::grazing, closed_form_grazing(e, -1.0), closed_form_known);
  EXPECT_TRUE(t.special[0].least && !t.special[0].rising);  // contact is lost first
  expect_at(t.special[1], SpecialKind::fold, closed_form(t.special[1], e), closed_form_known);
  expect_at(t.special[2], SpecialKind::fold, closed_form(t.special[2], e), closed_form_known);
  expect_at(t.special[3], SpecialKind::grazing, closed_form_grazing(e, 1.0), closed_form_known);
  EXPECT_TRUE(t.special[3].least && t.special[3].rising);
  EXPECT_EQ(t.end, BranchEnd::range);
  // Each orbit closes by the closed form.
  constexpr double closes = 1e-10;
  for (const BranchOrbit& o : t.orbits) {
    const problems::BasicClearanceExact<long double> exact(o.at.value, 0.05, 0.1, e);
    const auto end = exact.periods({o.at.states(0, 0), o.at.states(1, 0)}, 1);
    EXPECT_NEAR(end[0], o.at.states(0, 0), closes) << o.at.value;
    EXPECT_NEAR(end[1], o.at.states(1, 0), closes) << o.at.value;
  }
}

TEST(ClearanceBranch, OfTwoFoldsAndFourFlipsHasEachWhereTheClosedFormDoes) {
  constexpr double e = 0.2;
  const Traced t = clearance_branch(e);
  std::vector<std::string> kinds;
  for (const SpecialPoint& p : t.special) {
    kinds.push_back(to_string(p.kind));
    expect_at(p, p.kind, p.kind == SpecialKind::grazing ? closed_form_grazing(e, -1.0) : closed_form(p, e),
              closed_form_known);
  }
  EXPECT_EQ(kinds, (std::vector<std::string>{"grazing", "flip", "flip", "fold", "fold", "flip", "flip"}));
}

TEST(ClearanceBranch, PlacesOfFourWidthsLeadToTheExactOneWithinTheirBound) {
  std::vector<double> ratios;
  for (const double e : {0.1, 0.2}) {
    const Traced exact = clearance_branch(e);
    std::vector<Traced> smooth;
    constexpr std::array<double, 4> widths = {0.02, 0.01, 0.005, 0.0025};
    for (const double w : widths) smooth.push_back(clearance_branch(e, w));
    for (const SpecialPoint& p : exact.special) {
      if (p.kind == SpecialKind::grazing) continue;  // there the law is another
      std::vector<SmoothedValue> values;
      for (std::size_t k = 0; k < widths.size(); ++k) {
        const SpecialPoint* nearest = nullptr;
        for (const SpecialPoint& q : smooth[k].special)
          if (q.kind == p.kind &&
              (nearest == nullptr || std::abs(q.value - p.value) < std::abs(nearest->value - p.value)))
            nearest = &q;
        ASSERT_NE(nearest, nullptr);
        values.push_back({widths[k], nearest->value});
      }
      const ExactValue found = extrapolated_to_exact(values);
      const double error = std::abs(found.value - p.value);
      EXPECT_LE(error, found.bound + p.error_bound) << to_string(p.kind) << " at " << p.value;
      ratios.push_back(found.bound / error);
    }
  }
  ASSERT_EQ(ratios.size(), 10U);
  std::sort(ratios.begin(), ratios.end());
  constexpr double idle = 100.0;
  EXPECT_LT(ratios[5], idle);
}

TEST(SmoothingBias, FindsTheExactValueOfItsOwnLaw) {
  std::vector<SmoothedValue> values;
  for (const double w : {0.08, 0.04, 0.02, 0.01}) values.push_back({w, 0.7 + 3.0 * w * w * std::log(w) - 5.0 * w * w});
  const ExactValue found = extrapolated_to_exact(values);
  constexpr double rounding = 1e-14;  // of a few operations on numbers of order 1
  EXPECT_NEAR(found.value, 0.7, rounding);
  EXPECT_LT(found.bound, 10.0 * rounding);
}

TEST(SmoothingBias, RefusesWhatItCannotExtrapolate) {
  const std::vector<SmoothedValue> three = {{0.04, 1.0}, {0.02, 1.1}, {0.01, 1.2}};
  EXPECT_THROW((void)extrapolated_to_exact(three), DomainError);
  const std::vector<SmoothedValue> rising = {{0.01, 1.0}, {0.02, 1.1}, {0.03, 1.2}, {0.04, 1.3}};
  EXPECT_THROW((void)extrapolated_to_exact(rising), DomainError);
}

// ---- onto other branches ------------------------------------------------------------------------------------------

TEST(Switching, FollowsDuffingsCascadeToPeriod16) {
  const FieldFamily fields = problems::duffing(0.3, -1.0, 1.2);
  OrbitFamily family{flows(fields, tolerance)};
  const Correction start = first_orbit(family, 0.2, settled(family.flows, 0.2, {1.0, 0.0}, 100));
  ASSERT_TRUE(start.found) << start.message;
  BranchOrbit from = start.orbit;
  std::vector<double> flips;
  for (int n = 1; n <= 16; n *= 2) {
    ASSERT_EQ(family.period, n);
    const Traced t = trace(family, {.from = 0.2, .to = 0.3}, with_bounds(fields), from);
    ASSERT_EQ(t.special.size(), 1U);
    EXPECT_EQ(to_string(t.special[0].kind), "flip");
    EXPECT_LT(t.special[0].error_bound, eight_digits);
    flips.push_back(t.special[0].value);
    const auto ways = branch_switches(family, t.special[0], {.distance = 1e-2 / n});
    ASSERT_EQ(ways.size(), 1U);  // one orbit begun at either of its halves
    family = ways[0].family;
    from = ways[0].orbit;
  }
  EXPECT_NEAR(flips[0], 0.2655817861, tenth_decimal);
  EXPECT_NEAR(flips[1], 0.2866931578, tenth_decimal);
  // Feigenbaum's constant is where the ratios go to.
  constexpr double feigenbaum = 4.669201609;
  constexpr double still_to_go = 0.02;
  EXPECT_NEAR((flips[3] - flips[2]) / (flips[4] - flips[3]), feigenbaum, still_to_go);
}

TEST(Switching, FindsEachKindOfOrbitThatLeavesAPitchforkOfAlikeParts) {
  const FieldFamily fields = problems::alike_parts<3>();
  OrbitFamily family{flows(fields, tolerance)};
  family.symmetry = problems::moved_on(3);
  const Traced t = trace(family, fields, {.from = -0.1, .to = 0.1}, -0.1, {1.0, 1.0, 1.0}, 1);
  ASSERT_EQ(t.special.size(), 1U);
  // Parts at (a, -a, 0), a^2 = p exactly, and as (2, -1, -1) to first order, each with its sign, of all turns one.
  int opposite = 0, two_to_one = 0;
  for (const BranchSwitch& d : branch_switches(family, t.special[0])) {
    std::vector<double> w(d.orbit.at.states.data(), d.orbit.at.states.data() + 3);
    for (double& x : w) x -= 1.0;
    std::sort(w.begin(), w.end());
    const double a = std::sqrt(d.orbit.at.value);
    constexpr double solved = 1e-7;  // the residual over the distance from the pitchfork
    constexpr double first_order = 1e-3;
    if (std::abs(w[1]) < solved) {
      ++opposite;
      EXPECT_NEAR(w[2], a, solved);
      EXPECT_NEAR(w[0], -a, solved);
    } else if (std::abs(w[0] - w[1]) < solved || std::abs(w[1] - w[2]) < solved) {
      ++two_to_one;
      EXPECT_NEAR(w[0] + w[1] + w[2], 0.0, first_order * a);
    }
  }
  EXPECT_EQ(opposite, 2);
  EXPECT_EQ(two_to_one, 2);
}

// ---- the tree ------------------------------------------------------------------------------------------------------

/// All branches from one orbit.
std::vector<Branch> tree_from(const OrbitFamily& family, double value, const std::vector<double>& near,
                              const TreeOptions& options) {
  const Correction first = first_orbit(family, value, near);
  EXPECT_TRUE(first.found) << first.message;
  BifurcationDiagram tree(family, options);
  if (first.found) tree.start(first.orbit);
  while (tree.advance()) {
  }
  EXPECT_FALSE(tree.full());
  return tree.branches();
}

std::vector<std::pair<std::string, double>> points_of(const Branch& branch) {
  std::vector<std::pair<std::string, double>> points;
  for (const SpecialPoint& p : branch.special) points.emplace_back(to_string(p.kind), p.value);
  return points;
}

/// Each special point lies between the orbits that it is said to.
void expect_in_order(const Branch& branch) {
  ASSERT_EQ(branch.after.size(), branch.special.size());
  for (std::size_t k = 0; k < branch.special.size(); ++k) {
    ASSERT_LT(branch.after[k] + 1, branch.orbits.size());
    const BranchOrbit& a = branch.orbits[branch.after[k]];
    const BranchOrbit& b = branch.orbits[branch.after[k] + 1];
    const double along = inner_product(branch.family, branch.special[k].orbit.at - a.at, a.direction);
    EXPECT_GE(along, -eight_digits);
    EXPECT_LE(along, inner_product(branch.family, b.at - a.at, a.direction) + eight_digits);
  }
  for (std::size_t k = 0; k + 1 < branch.orbits.size(); ++k)
    EXPECT_GT(inner_product(branch.family, branch.orbits[k + 1].at - branch.orbits[k].at, branch.orbits[k].direction),
              0.0);
}

TEST(Tree, DuffingsBranchOfPeriod4JoinsTwoFlipsOfPeriod2) {
  const FieldFamily fields = problems::duffing(0.3, -1.0, 1.2);
  const OrbitFamily family{flows(fields, tolerance)};
  // From the middle of the range: the start is followed both ways.
  const std::vector<Branch> all =
      tree_from(family, 0.2, settled(family.flows, 0.2, {1.0, 0.0}, 100),
                {.continuation = {.from = 0.1, .to = 0.6}, .special = with_bounds(fields), .largest_period = 4});
  ASSERT_EQ(all.size(), 4U);
  std::vector<int> periods;
  for (const Branch& b : all) {
    periods.push_back(b.family.period);
    expect_in_order(b);
    for (const SpecialPoint& p : b.special) EXPECT_LT(p.error_bound, eight_digits);
  }
  EXPECT_EQ(periods, (std::vector<int>{1, 2, 4, 4}));
  EXPECT_EQ(all[0].orbits.front().at.value, 0.1);
  EXPECT_EQ(all[0].orbits.back().at.value, 0.6);
  // Born at the first flip, not followed back from it.
  EXPECT_TRUE(all[1].first.born);
  ASSERT_TRUE(all[1].first.place.has_value());
  EXPECT_EQ(all[1].first.place->branch, 0U);
  EXPECT_EQ(all[1].last.end, BranchEnd::range);
  // From one flip of period 2 to the other, and not a second time from there.
  const Branch& loop = all[2];
  EXPECT_TRUE(loop.first.born && loop.last.born);
  ASSERT_TRUE(loop.first.place && loop.last.place);
  EXPECT_NEAR(all[1].special[loop.first.place->point].value, 0.2866931578, tenth_decimal);
  EXPECT_EQ(to_string(all[1].special[loop.last.place->point].kind), "flip");
  EXPECT_NEAR(loop.orbits.back().at.value, all[1].special[loop.last.place->point].value, eight_digits);
}

TEST(Tree, BackwardPartsAreAsIfFoundForward) {
  const FieldFamily fields = problems::duffing_in_frequency(0.1, 1.0, 0.3);
  const OrbitFamily family{flows(fields, tolerance)};
  // Between the folds, on the unstable part: one is found each way.
  const Traced whole = trace(family, fields, {.from = 0.5, .to = 2.5}, 0.6, {1.0, 0.0}, 100);
  ASSERT_EQ(whole.special.size(), 2U);
  const auto inside = std::find_if(whole.orbits.begin(), whole.orbits.end(),
                                   [](const BranchOrbit& o) { return o.direction.value < 0.0 && o.at.value < 1.6; });
  ASSERT_NE(inside, whole.orbits.end());
  BifurcationDiagram tree(family, {.continuation = {.from = 0.5, .to = 2.5}});
  tree.start(*inside);
  while (tree.advance()) {
  }
  ASSERT_EQ(tree.branches().size(), 1U);
  const Branch& branch = tree.branches()[0];
  expect_in_order(branch);
  ASSERT_EQ(branch.special.size(), 2U);
  for (const SpecialPoint& p : whole.special) {
    const auto same = std::find_if(branch.special.begin(), branch.special.end(),
                                   [&](const SpecialPoint& q) { return std::abs(q.value - p.value) < eight_digits; });
    ASSERT_NE(same, branch.special.end());
    EXPECT_EQ(same->outwards, p.outwards);
  }
}

TEST(Tree, ClearancesBranchesOfPeriod2JoinPairsOfFlips) {
  const OrbitFamily family{problems::clearance_flows(0.2, tolerance)};
  const std::vector<Branch> all =
      tree_from(family, 0.3, settled(family.flows, 0.3, {1.1, 0.0}, 100), {.continuation = {.from = 0.2, .to = 2.2}});
  ASSERT_EQ(all.size(), 3U);
  for (const Branch& b : all) expect_in_order(b);
  for (std::size_t k = 1; k < 3; ++k) {
    EXPECT_EQ(all[k].family.period, 2);
    ASSERT_TRUE(all[k].first.place && all[k].last.place);
    EXPECT_EQ(all[k].first.place->point + 1, all[k].last.place->point);
  }
}

TEST(Tree, OrbitsThatBreakTheSymmetryAreBranchesOfTheirOwn) {
  const FieldFamily fields = problems::alike_parts<3>();
  OrbitFamily family{flows(fields, tolerance)};
  family.symmetry = problems::moved_on(3);
  const std::vector<Branch> all = tree_from(family, -0.1, {1.0, 1.0, 1.0}, {.continuation = {.from = -0.1, .to = 0.1}});
  ASSERT_EQ(all.size(), 5U);  // two kinds, two signs each
  EXPECT_EQ(points_of(all[0]).size(), 1U);
  for (std::size_t k = 1; k < all.size(); ++k) {
    EXPECT_FALSE(all[k].family.keeps_symmetry);
    EXPECT_TRUE(all[k].first.born);
    EXPECT_EQ(all[k].orbits.back().at.value, 0.1);
  }
}

TEST(Tree, AStartOnAKnownBranchIsNotFollowedAgain) {
  const FieldFamily fields = problems::duffing(0.3, -1.0, 1.2);
  const OrbitFamily family{flows(fields, tolerance)};
  BifurcationDiagram tree(family, {.continuation = {.from = 0.1, .to = 0.25}});
  for (const double g : {0.2, 0.15}) {
    const Correction first = first_orbit(family, g, settled(family.flows, g, {1.0, 0.0}, 100));
    ASSERT_TRUE(first.found);
    tree.start(first.orbit);
  }
  while (tree.advance()) {
  }
  EXPECT_EQ(tree.branches().size(), 1U);
}

TEST(Tree, OrbitsThatLeaveStayWholeWhileOtherStartsWait) {
  const FieldFamily fields = problems::duffing(0.3, -1.0, 1.2);
  const OrbitFamily family{flows(fields, 1e-8)};
  BifurcationDiagram tree(family, {.continuation = {.from = 0.1, .to = 0.3}, .special = with_bounds(fields)});
  for (const double g : {0.2, 0.15, 0.14, 0.13, 0.12}) {
    const Correction first = first_orbit(family, g, settled(family.flows, g, {1.0, 0.0}, 100));
    ASSERT_TRUE(first.found);
    tree.start(first.orbit);
  }
  while (tree.advance()) {
  }
  ASSERT_EQ(tree.branches().size(), 2U);
  for (const Branch& branch : tree.branches())
    for (const BranchOrbit& orbit : branch.orbits)
      EXPECT_EQ(orbit.monodromy.factors.size(), static_cast<std::size_t>(branch.family.shooting_intervals))
          << orbit.at.value;
}

TEST(Tree, GoesOnFromItsStepsWithTheSameBits) {
  const FieldFamily fields = problems::duffing(0.3, -1.0, 1.2);
  const OrbitFamily family{flows(fields, 1e-8)};
  const TreeOptions options{.continuation = {.from = 0.1, .to = 0.6}};
  const Correction first = first_orbit(family, 0.2, settled(family.flows, 0.2, {1.0, 0.0}, 100));
  ASSERT_TRUE(first.found);
  BifurcationDiagram whole(family, options);
  whole.start(first.orbit);
  std::vector<TreeStep> steps;
  while (auto step = whole.advance()) steps.push_back(*std::move(step));
  ASSERT_EQ(whole.branches().size(), 2U);
  for (std::size_t cut = 0; cut <= steps.size(); cut += 7) {
    BifurcationDiagram again(family, options);
    again.start(first.orbit);
    for (std::size_t k = 0; k < cut; ++k) again.apply(steps[k]);
    std::size_t more = cut;
    while (again.advance()) ++more;
    EXPECT_EQ(more, steps.size());
    ASSERT_EQ(again.branches().size(), whole.branches().size());
    for (std::size_t b = 0; b < whole.branches().size(); ++b) {
      const Branch& expected = whole.branches()[b];
      const Branch& branch = again.branches()[b];
      ASSERT_EQ(branch.orbits.size(), expected.orbits.size());
      for (std::size_t k = 0; k < branch.orbits.size(); ++k) {
        EXPECT_EQ(branch.orbits[k].at.value, expected.orbits[k].at.value);
        EXPECT_EQ(branch.orbits[k].at.states, expected.orbits[k].at.states);
      }
      EXPECT_EQ(points_of(branch), points_of(expected));
      EXPECT_EQ(branch.after, expected.after);
    }
  }
}

}  // namespace
}  // namespace epicyclic::analysis::continuation_test
