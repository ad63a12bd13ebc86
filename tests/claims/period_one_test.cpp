// Orbits of period 1 along a sweep: multipliers that are known, and what a point lacks of a motion.

#include "claims/period_one.hpp"

#include <atomic>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "claims/judging.hpp"
#include "core/errors.hpp"
#include "problems/branches.hpp"

namespace epicyclic::claims::period_one_test {
namespace {

using namespace studies;

/// A system with known answers in a stage's place.
ModelAt models_of(const FieldFamily& fields, const std::vector<double>& start) {
  return [fields, start](double value) {
    model::DynamicModel model;
    static_cast<VectorField&>(model) = fields(value);
    model.default_start = start;
    return model;
  };
}

integrate::IntegratorOptions tight() {
  integrate::IntegratorOptions o;
  o.method = "arkode-dopri5";
  o.relative_tolerance = o.absolute_tolerance = 1e-9;
  return o;
}

TEST(PeriodOneOfASweep, HasTheMultipliersOfTheNormalForm) {
  constexpr double w = 0.3;
  std::vector<double> values;
  for (int k = -4; k <= 4; ++k) values.push_back(0.025 * k + 0.01);
  const auto orbits = follow_period_one(values, models_of(problems::forced_hopf(w), {1.1, 0.0}), tight());
  ASSERT_EQ(orbits.size(), values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    SCOPED_TRACE(values[k]);
    ASSERT_TRUE(orbits[k].found);
    constexpr double tau = 2.0 * std::numbers::pi;
    EXPECT_NEAR(orbits[k].growth, tau * values[k], 1e-4);
    EXPECT_NEAR(orbits[k].rest, tau * values[k], 1e-4);
    EXPECT_NEAR(orbits[k].to_flip, std::abs(std::polar(std::exp(tau * values[k]), tau * w) + 1.0), 1e-4);
    EXPECT_LT(orbits[k].flip, -10.0);
    EXPECT_EQ(orbits[k].fold, 0.0);
  }
}

TEST(PeriodOneOfASweep, GoesOnBeyondItsFlip) {
  const FieldFamily duffing = problems::duffing(0.3, -1.0, 1.2);
  std::vector<double> values;
  for (int k = 0; k <= 12; ++k) values.push_back(0.2 + 0.01 * k);
  const auto orbits = follow_period_one(values, models_of(duffing, {1.0, 0.0}), tight());
  const auto flows = problems::flows(duffing, 1e-10);
  const analysis::OrbitFamily family{flows};
  const analysis::Correction first = first_orbit(family, 0.2, problems::settled(flows, 0.2, {1.0, 0.0}, 100));
  ASSERT_TRUE(first.found);
  const problems::Traced traced =
      problems::trace(family, {.from = 0.2, .to = 0.32}, {{{flows, 1}, {flows, 2}}}, first.orbit);
  ASSERT_EQ(traced.special.size(), 1U);
  const double flip = traced.special.front().value;
  for (std::size_t k = 0; k < values.size(); ++k) {
    SCOPED_TRACE(values[k]);
    ASSERT_TRUE(orbits[k].found);
    EXPECT_EQ(orbits[k].growth > 0.0, values[k] > flip);
    if (values[k] > flip) {
      EXPECT_EQ(orbits[k].growth, orbits[k].flip);
      // Two multipliers, and their product is what damping leaves of a volume over a period.
      EXPECT_NEAR(orbits[k].growth + orbits[k].rest, -0.3 * 2.0 * std::numbers::pi / 1.2, 1e-4);
    }
  }
}

TEST(PeriodOneOfASweep, StopsAndRefuses) {
  const ModelAt models = models_of(problems::forced_hopf(0.3), {1.1, 0.0});
  const std::vector<double> values = {-0.1, -0.05};
  const std::atomic<bool> stop = true;
  EXPECT_FALSE(follow_period_one(values, models, tight(), &stop).front().found);
  const ModelAt jumping = [&](double value) {
    model::DynamicModel model = models(value);
    model.jumps_at_surfaces = true;
    return model;
  };
  EXPECT_THROW((void)follow_period_one(values, jumping, tight()), InputError);
}

/// With one real multiplier that the growth is of, or a pair in another direction.
PeriodOne orbit_of(double growth, double to_flip, bool flips) {
  PeriodOne p;
  p.found = true;
  p.growth = growth;
  p.flip = flips ? growth : -20.0;
  p.rest = flips ? -0.1 : growth;
  p.to_flip = to_flip;
  return p;
}

TEST(WhatAPointLacks, FallsOnTheWayToTheMotion) {
  for (const char* word : {"not period 1", "period 2", "chaotic", "aperiodic", "quasiperiodic", "multi-period"}) {
    SCOPED_TRACE(word);
    double before = 1.0;
    for (const PeriodOne& p : {orbit_of(-0.1, 1.9, false), orbit_of(-0.1, 0.5, true), orbit_of(-0.01, 0.01, true),
                               orbit_of(0.01, 0.01, true), orbit_of(0.1, 0.1, true), orbit_of(0.4, 0.5, true)}) {
      const auto lack = p.lacks(word);
      ASSERT_TRUE(lack.has_value());
      EXPECT_LE(*lack, before);
      before = *lack;
    }
    EXPECT_EQ(before, 0.0);
  }
  EXPECT_EQ(orbit_of(-0.1, 1.0, false).lacks("period 1"), 0.0);
  EXPECT_LT(orbit_of(0.1, 1.0, true).lacks("period 1"), orbit_of(0.2, 1.0, true).lacks("period 1"));
  // A torus is none of period 2, and what has just lost its stability no chaos yet.
  EXPECT_GT(orbit_of(0.2, 0.5, false).lacks("period 2"), 0.5);
  EXPECT_GT(orbit_of(0.06, 0.06, true).lacks("chaotic"), 0.0);
  EXPECT_EQ(orbit_of(0.06, 0.06, true).lacks("aperiodic"), 0.0);
  for (const char* word : {"period 3", "not chaotic", "periodic", "not period 2"})
    EXPECT_FALSE(orbit_of(0.1, 0.1, true).lacks(word).has_value()) << word;
  EXPECT_EQ(PeriodOne{}.lacks("chaotic"), 0.5);
}

/// Points at 0, 1, 2, ...: 1 for period 1, c for chaos, each with an orbit that says how far it is from a flip.
ClaimRecord record(const std::string& motions, const std::vector<double>& growths) {
  ClaimSeries series;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    ClaimPoint& p = series.points.emplace_back();
    p.value = static_cast<double>(k);
    p.reached = true;
    p.motion = {motions[k] == '1' ? analysis::Regime::periodic : analysis::Regime::chaotic, motions[k] == '1', true};
    if (k < growths.size()) p.period_one = orbit_of(growths[k], std::abs(std::exp(growths[k]) - 1.0), true);
  }
  return {{"s", series}};
}

TEST(CostsLedByMultipliers, SeeWhatWordsDoNot) {
  Condition change;
  change.kind = ConditionKind::change;
  change.sweep = "s";
  change.regime = "period 1";
  change.regime_after = "chaotic";
  change.within = {2.0, 3.0};
  Condition sequence;
  sequence.kind = ConditionKind::sequence;
  sequence.sweep = "s";
  sequence.regimes = {"period 1", "chaotic"};
  Condition count;
  count.kind = ConditionKind::count;
  count.sweep = "s";
  count.regime = "chaotic";
  count.at_least = 1.0;
  const std::vector<double> far = {-0.5, -0.5, -0.5, -0.5, -0.5, -0.5};
  const std::vector<double> near = {-0.5, -0.5, -0.5, -0.1, -0.1, -0.1};
  for (const Condition& c : {change, sequence, count}) {
    const double words = judge(c, record("111111", {})).cost;
    const ConditionOutcome of_far = judge(c, record("111111", far));
    const ConditionOutcome of_near = judge(c, record("111111", near));
    EXPECT_FALSE(of_far.holds);
    EXPECT_LT(of_near.cost, of_far.cost);
    EXPECT_GT(of_near.cost, 0.1);
    EXPECT_EQ(words, judge(c, record("111111", {})).cost);
    // The verdict is the words' alone, and what holds costs nothing.
    EXPECT_TRUE(judge(c, record("111ccc", far)).holds);
    EXPECT_EQ(judge(c, record("111ccc", far)).cost, 0.0);
  }
  // Of a number of points all that there have to be count: one alone is not all but met.
  count.at_least = 3.0;
  EXPECT_LT(judge(count, record("11111c", {-0.5, -0.5, -0.5, -0.01, -0.01, 0.4})).cost,
            judge(count, record("11111c", {-0.5, -0.5, -0.5, -0.5, -0.5, 0.4})).cost);
  // Where multipliers are as wanted, words lead.
  const std::vector<double> well(6, 0.4);
  EXPECT_LT(judge(count, record("1111cc", well)).cost, judge(count, record("11111c", well)).cost);
  Condition share;
  share.kind = ConditionKind::share;
  share.sweep = "s";
  share.regime = "period 1";
  share.at_least = 0.95;
  EXPECT_LT(judge(share, record("cccccc", {0.01, 0.01, 0.01, 0.01, 0.01, 0.01})).cost,
            judge(share, record("cccccc", {0.5, 0.5, 0.5, 0.5, 0.5, 0.5})).cost);
}

}  // namespace
}  // namespace epicyclic::claims::period_one_test
