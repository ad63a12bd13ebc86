#include "claims/judging.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "input/study_model.hpp"
#include "problems/numbered_points.hpp"
#include "store/point_columns.hpp"

namespace epicyclic::claims::judging_test {
namespace {

using namespace studies;

using analysis::Regime;

constexpr std::size_t delta_sp_range = 0;
constexpr std::size_t poincare_sp_range = 4;
constexpr std::size_t poincare_rp_range = 5;
constexpr std::size_t force_sp_max = 12;

/// "1", "2": a period; "c" chaos; "q" a torus; "u" told by nothing; "x" a point that failed.
ClaimPoint point(double value, char motion, double range = 1.0) {
  ClaimPoint p;
  p.value = value;
  p.reached = motion != 'x';
  p.response.classified = motion != 'u';
  if (motion >= '1' && motion <= '9') p.response = {Regime::periodic, motion - '0', true};
  if (motion == 'c') p.response.regime = Regime::chaotic;
  if (motion == 'q') p.response.regime = Regime::quasiperiodic;
  p.by_sun_mesh = p.by_ring_mesh = p.response;
  p.quantities[delta_sp_range] = range;
  p.quantities[poincare_sp_range] = range;
  p.quantities[poincare_rp_range] = 2.0 * range;
  return p;
}

/// Points at 0, 1, 2, ...
ClaimRecord record(const std::string& motions, const std::vector<double>& ranges = {}) {
  ClaimSeries series;
  for (std::size_t k = 0; k < motions.size(); ++k)
    series.points.push_back(point(static_cast<double>(k), motions[k], ranges.empty() ? 1.0 : ranges[k]));
  return {{"s", series}};
}

Condition condition(ConditionKind kind) {
  Condition c;
  c.kind = kind;
  c.sweep = "s";
  return c;
}

/// The largest range falls from "s" to "t".
Condition falling_range() {
  Condition c = condition(ConditionKind::decreasing);
  c.sweep = "";
  c.sweeps = {"s", "t"};
  c.quantity = "delta_sp_range";
  return c;
}

TEST(ClaimMotions, AreCalledByWords) {
  for (const char* word : {"period 1", "period 12", "periodic", "multi-period", "chaotic", "not period 1", "aperiodic"})
    EXPECT_TRUE(is_regime_word(word)) << word;
  for (const char* word : {"", "period", "period 0", "period 01", "period x", "not", "not not chaotic", "Chaotic"})
    EXPECT_FALSE(is_regime_word(word)) << word;
  EXPECT_TRUE(point(0, '2').response.is("multi-period"));
  EXPECT_FALSE(point(0, '1').response.is("multi-period"));
  EXPECT_TRUE(point(0, 'q').response.is("aperiodic"));
  EXPECT_FALSE(point(0, 'q').response.is("chaotic"));
  EXPECT_TRUE(point(0, 'q').response.is("not period 1"));
  // What nothing but recurrence was asked of counts as chaos; what evidence could not decide does not.
  EXPECT_TRUE(point(0, 'u').response.is("chaotic"));
  ClaimRegime undecided{Regime::undecided, 0, true};
  EXPECT_FALSE(undecided.is("chaotic"));
  EXPECT_FALSE(undecided.is("aperiodic"));
}

TEST(Claims, OnAShareOfThePoints) {
  Condition c = condition(ConditionKind::share);
  c.regime = "period 1";
  c.from = 2.0;
  c.at_least = 0.75;
  const ConditionOutcome all = judge(c, record("cc1111"));
  EXPECT_TRUE(all.holds);
  EXPECT_EQ(all.cost, 0.0);
  const ConditionOutcome three = judge(c, record("cc111x"));
  EXPECT_TRUE(three.holds);
  EXPECT_EQ(three.measured, 0.75);
  const ConditionOutcome two = judge(c, record("cc11cc"));
  const ConditionOutcome one = judge(c, record("cc1ccc"));
  EXPECT_FALSE(two.holds);
  EXPECT_GT(two.cost, 0.0);
  EXPECT_GT(one.cost, two.cost);
}

TEST(Claims, OnANumberOfPoints) {
  Condition c = condition(ConditionKind::count);
  c.regime = "chaotic";
  c.at_least = 1.0;
  EXPECT_TRUE(judge(c, record("11c1")).holds);
  // What is nearer to chaos costs less.
  const double torus = judge(c, record("11q1")).cost;
  const double doubled = judge(c, record("1121")).cost;
  const double nothing = judge(c, record("1111")).cost;
  EXPECT_LT(torus, doubled);
  EXPECT_LT(doubled, nothing);
  c.at_least.reset();
  c.at_most = 0.0;
  EXPECT_TRUE(judge(c, record("1111")).holds);
  EXPECT_FALSE(judge(c, record("11c1")).holds);
}

TEST(Claims, OnAChangeBetweenMotions) {
  Condition c = condition(ConditionKind::change);
  c.regime = "period 1";
  c.regime_after = "not period 1";
  c.within = {2.0, 3.0};
  const ConditionOutcome found = judge(c, record("111c1c"));
  EXPECT_TRUE(found.holds);
  EXPECT_EQ(found.measured, 2.5);
  EXPECT_EQ(found.error, 0.5);
  c.which = Which::last;
  const ConditionOutcome last = judge(c, record("111c1c"));
  EXPECT_FALSE(last.holds);
  EXPECT_EQ(last.measured, 4.5);
  EXPECT_GT(judge(c, record("11111111c")).cost, last.cost);
  c.which = Which::first;
  // The first loss of period 1 is not the first that leads to chaos.
  c.leads_to = "chaotic";
  EXPECT_EQ(judge(c, record("12122c1")).measured, 2.5);
  EXPECT_TRUE(std::isnan(judge(c, record("121221")).measured));
  EXPECT_EQ(judge(c, record("121221")).cost, 1.0);
}

TEST(Claims, OnASequence) {
  Condition c = condition(ConditionKind::sequence);
  c.regimes = {"period 1", "period 3", "chaotic"};
  EXPECT_TRUE(judge(c, record("112q3c")).holds);
  const ConditionOutcome two = judge(c, record("1c3333"));
  EXPECT_FALSE(two.holds);
  EXPECT_EQ(two.measured, 2.0);
  EXPECT_LT(two.cost, judge(c, record("111ccc")).cost);
}

TEST(Claims, OnAFall) {
  Condition c = condition(ConditionKind::reduction);
  c.quantity = "poincare_sp_range";
  c.at_least = 5.0;
  EXPECT_TRUE(judge(c, record("ccc1", {10.0, 8.0, 9.0, 1e-9})).holds);
  EXPECT_FALSE(judge(c, record("ccc1", {10.0, 11.0, 9.0, 1e-9})).holds);
  EXPECT_FALSE(judge(c, record("cccc", {10.0, 8.0, 9.0, 3.0})).holds);
  EXPECT_FALSE(judge(c, record("cxc1", {10.0, 8.0, 9.0, 1e-9})).holds);
}

TEST(Claims, OnPeaks) {
  Condition c = condition(ConditionKind::peaks);
  c.quantity = "delta_sp_range";
  c.peak_locations = {2.0, 5.0};
  c.location_tolerance = 0.1;
  c.prominence = 0.2;
  EXPECT_TRUE(judge(c, record("11111111", {1, 2, 5, 2, 3, 10, 1, 1})).holds);
  // At 5 there is a shoulder alone; the maximum at 2 stands out too little.
  EXPECT_EQ(judge(c, record("11111111", {1, 2, 5, 2, 3, 8, 10, 1})).measured, 1.0);
  EXPECT_EQ(judge(c, record("11111111", {1, 4, 4.5, 4, 3, 10, 1, 1})).measured, 1.0);
}

TEST(Claims, OnAJumpAreNotMetByAFlank) {
  Condition c = condition(ConditionKind::jump);
  c.quantity = "delta_sp_range";
  c.regime = "period 1";
  c.at_least = 0.1;
  EXPECT_TRUE(judge(c, record("1111", {1.0, 1.02, 1.5, 1.52})).holds);
  EXPECT_FALSE(judge(c, record("1111", {1.0, 1.2, 1.4, 1.6})).holds);
  EXPECT_FALSE(judge(c, record("11c1", {1.0, 1.02, 1.5, 1.52})).holds);
  // Two motions side by side: the fold between them need not be on the grid.
  ClaimRecord both = record("1111", {1.0, 1.1, 1.2, 1.3});
  both["s"].other = record("1111", {1.0, 1.1, 1.5, 1.3})["s"].points;
  const ConditionOutcome beside = judge(c, both);
  EXPECT_TRUE(beside.holds);
  EXPECT_NEAR(beside.measured, 0.2, 1e-12);
}

TEST(Claims, OnAJumpAreToldTheStepAndNotHowNearItIsToAJump) {
  Condition c = condition(ConditionKind::jump);
  c.quantity = "delta_sp_range";
  c.at_least = 0.05;
  // 2.5 times the step beside it: a search is led by it, no verdict.
  const ConditionOutcome flank = judge(c, record("1111", {1.0, 1.2, 1.7, 1.9}));
  EXPECT_FALSE(flank.holds);
  EXPECT_EQ(flank.measured, 0.0);
  EXPECT_GE(flank.cost, 0.1);
  EXPECT_LT(flank.cost, judge(c, record("1111", {1.0, 1.2, 1.4, 1.6})).cost);
  EXPECT_NE(flank.text.find("2.5 times"), std::string::npos) << flank.text;
  const ConditionOutcome found = judge(c, record("1111", {1.0, 1.1, 1.6, 1.7}));
  EXPECT_TRUE(found.holds);
  EXPECT_NEAR(found.measured, 0.5 / 1.6, 1e-12);
  // Nothing beside it that counts: neither its edge nor a point that failed tells how abrupt it is.
  EXPECT_FALSE(judge(c, record("11", {1.0, 2.0})).holds);
  EXPECT_FALSE(judge(c, record("x11x", {0.0, 1.0, 2.0, 0.0})).holds);
  // Records of chaos differ in their extrema.
  ClaimRecord both = record("ccc", {1.0, 1.0, 1.0});
  both["s"].other = record("ccc", {1.0, 1.2, 1.0})["s"].points;
  EXPECT_FALSE(judge(c, both).holds);
}

TEST(Claims, OnWhatDoesNotVary) {
  Condition c = condition(ConditionKind::variation);
  c.at_most = 0.01;
  EXPECT_TRUE(judge(c, record("1111", {1.0, 1.001, 1.0, 1.0})).holds);
  EXPECT_FALSE(judge(c, record("1111", {1.0, 1.1, 1.0, 1.0})).holds);
  EXPECT_FALSE(judge(c, record("1121")).holds);
}

TEST(Claims, AreInertWhereNothingThatTheyReadChanges) {
  Condition c = condition(ConditionKind::variation);
  c.at_most = 0.01;
  const auto is_inert = [&](const ClaimRecord& r) { return judge(Claim{"C", "", "", "", 1.0, {c}}, r).inert; };
  EXPECT_TRUE(is_inert(record("1111")));
  EXPECT_FALSE(is_inert(record("1111", {1.0, 1.001, 1.0, 1.0})));
  EXPECT_FALSE(is_inert(record("xxxx")));
  // A load that grows, borne by a linear stage, leaves the range as it is and not the force.
  ClaimRecord r = record("111");
  for (std::size_t k = 0; k < 3; ++k) r["s"].points[k].quantities[force_sp_max] = 1000.0 * static_cast<double>(k + 1);
  EXPECT_TRUE(is_inert(r));
  c = condition(ConditionKind::value);
  c.quantity = "force_sp_max";
  c.at_most = 1e4;
  EXPECT_FALSE(is_inert(r));
}

TEST(Claims, SayWhichPointsTheyCouldNotTell) {
  Condition c = condition(ConditionKind::value);
  c.quantity = "delta_sp_range";
  c.at_most = 5.0;
  ClaimRecord r = record("112");
  r["s"].points[1].converged = false;
  EXPECT_NE(judge(c, r).text.find("1 point not converged"), std::string::npos) << judge(c, r).text;
  // Two records that are on their way to one orbit are no two motions side by side.
  c = condition(ConditionKind::jump);
  c.quantity = "delta_sp_range";
  c.at_least = 0.1;
  ClaimRecord both = record("111", {1.0, 1.1, 1.2});
  both["s"].other = record("111", {1.0, 1.5, 1.2})["s"].points;
  EXPECT_TRUE(judge(c, both).holds);
  both["s"].other[1].converged = false;
  EXPECT_FALSE(judge(c, both).holds);
  c = condition(ConditionKind::share);
  c.regime = "not period 1";
  c.at_least = 0.3;
  r = record("11c");
  r["s"].points[2].response.regime = Regime::undecided;
  const ConditionOutcome undecided = judge(c, r);
  EXPECT_TRUE(undecided.holds);
  EXPECT_NE(undecided.text.find("1 point undecided"), std::string::npos) << undecided.text;
  EXPECT_NE(undecided.text.find("at least 30 %"), std::string::npos) << undecided.text;
  c = condition(ConditionKind::value);
  c.quantity = "delta_sp_range";
  c.regime = "chaotic";
  c.at_most = 5.0;
  EXPECT_NE(judge(c, record("111")).text.find("no delta_sp_range of any point chaotic"), std::string::npos);
}

TEST(Claims, OfAMotionThatFallsSayWhatIsUndecided) {
  Condition c = falling_range();
  c.regime = "not period 1";
  ClaimRecord r = record("c1c", {2.0, 1.0, 2.0});
  r["t"] = record("c1c", {1.0, 1.0, 1.0})["s"];
  EXPECT_EQ(judge(c, r).text.find("undecided"), std::string::npos);
  r["s"].points[2].response = {Regime::undecided, 0, true};
  EXPECT_NE(judge(c, r).text.find("1 point undecided"), std::string::npos) << judge(c, r).text;
  EXPECT_FALSE(judge(Claim{"C", "", "", "", 1.0, {c}}, r).inert);
}

TEST(Claims, AreNotInertWhereSweepsThatAreComparedDiffer) {
  Condition c = falling_range();
  ClaimRecord r = record("111", {2.0, 2.0, 2.0});
  r["t"] = record("111", {2.0, 2.0, 2.0})["s"];
  EXPECT_TRUE(judge(Claim{"C", "", "", "", 1.0, {c}}, r).inert);
  r["t"] = record("111", {1.0, 1.0, 1.0})["s"];
  EXPECT_FALSE(judge(Claim{"C", "", "", "", 1.0, {c}}, r).inert);
  // And where the other direction moves otherwise.
  c = condition(ConditionKind::jump);
  c.quantity = "delta_sp_range";
  c.at_least = 0.1;
  EXPECT_TRUE(judge(Claim{"C", "", "", "", 1.0, {c}}, r).inert);
  r["s"].other = record("111", {3.0, 3.0, 3.0})["s"].points;
  EXPECT_FALSE(judge(Claim{"C", "", "", "", 1.0, {c}}, r).inert);
  r["s"].points.clear();  // stopped before the first
  EXPECT_FALSE(judge(Claim{"C", "", "", "", 1.0, {c}}, r).inert);
}

TEST(Claims, OfMeshesThatAreAlikeTakeNothingUndecidedForTheSame) {
  Condition c = condition(ConditionKind::agreement);
  c.at_least = 0.9;
  ClaimRecord r = record("1c1");
  EXPECT_TRUE(judge(c, r).holds);
  r["s"].points[1].by_sun_mesh = r["s"].points[1].by_ring_mesh = {Regime::undecided, 0, true};
  const ConditionOutcome two = judge(c, r);
  EXPECT_FALSE(two.holds);
  EXPECT_NEAR(two.measured, 2.0 / 3.0, 1e-15);
  EXPECT_TRUE(two.part_of_one);
  // By a glance what does not recur is chaos.
  r["s"].points[1].by_sun_mesh.classified = r["s"].points[1].by_ring_mesh.classified = false;
  EXPECT_TRUE(judge(c, r).holds);
}

TEST(Claims, InFullTakeNothingUndecidedForChaos) {
  PointResult r;
  r.outcome = integrate::Outcome::reached;
  r.regime = Regime::undecided;
  r.meshes.sun_planet.resize(1);
  r.meshes.ring_planet.resize(1);
  r.poincare_columns = 3;
  for (int k = 0; k < 12; ++k) r.poincare.push_back(std::sin(static_cast<double>(7 * k * k)));
  EXPECT_TRUE(claim_point(r, {}, Depth::screening).response.is("chaotic"));
  const ClaimPoint in_full = claim_point(r, {}, Depth::in_full);
  EXPECT_FALSE(in_full.response.is("chaotic"));
  EXPECT_FALSE(in_full.by_sun_mesh.is("chaotic"));
  // Told periodic by its orbit, on its way to it.
  r.regime = Regime::periodic;
  r.period = 1;
  r.classified = true;
  EXPECT_FALSE(claim_point(r, {}, Depth::in_full).converged);
  r.recurrence.period = 1;
  EXPECT_TRUE(claim_point(r, {}, Depth::in_full).converged);
}

TEST(Claims, TakeBoundsThatGridsMeetButForRounding) {
  Condition c = condition(ConditionKind::change);
  c.regime = "period 1";
  c.regime_after = "not period 1";
  c.within = {2.0, 2.53};
  ClaimRecord r = record("12");
  r["s"].points[0].value = 2.5;
  r["s"].points[1].value = 2.56;  // 0.5 (2.5 + 2.56) = 2.5300000000000002
  EXPECT_TRUE(judge(c, r).holds);
  c = condition(ConditionKind::count);
  c.regime = "period 1";
  c.at_least = 2.0;
  r = record("112");
  r["s"].points[1].value = 0.1 + 0.2;
  c.to = 0.3;
  EXPECT_TRUE(judge(c, r).holds);
  // A step counts where both of its points do.
  c = condition(ConditionKind::jump);
  c.quantity = "delta_sp_range";
  c.at_least = 0.1;
  c.from = 1.4;
  EXPECT_FALSE(judge(c, record("11111", {1.0, 1.02, 1.5, 1.52, 1.54})).holds);
  c.from = 1.0;
  EXPECT_TRUE(judge(c, record("11111", {1.0, 1.02, 1.5, 1.52, 1.54})).holds);
}

TEST(Claims, OnMeshesThatAreAlike) {
  Condition c = condition(ConditionKind::agreement);
  c.at_least = 0.75;
  c.correlation = 0.9;
  ClaimRecord r = record("112c", {1.0, 2.0, 3.0, 4.0});
  EXPECT_TRUE(judge(c, r).holds);
  r["s"].points[2].by_ring_mesh.period = 1;
  EXPECT_TRUE(judge(c, r).holds);
  r["s"].points[3].by_ring_mesh.regime = Regime::quasiperiodic;
  EXPECT_FALSE(judge(c, r).holds);
  r = record("112c", {1.0, 2.0, 3.0, 4.0});
  r["s"].points[3].quantities[poincare_rp_range] = 0.0;
  EXPECT_FALSE(judge(c, r).holds);
}

TEST(Claims, OnSweepsThatFallCompareCommonValues) {
  Condition c = falling_range();
  c.regime = "chaotic";
  ClaimRecord r = record("1c1c", {9.0, 5.0, 9.0, 7.0});
  r["t"].points = {point(1.0, '1', 4.0), point(2.0, '1', 9.0), point(3.0, 'c', 6.0)};
  EXPECT_TRUE(judge(c, r).holds);
  r["t"].points[2].quantities[delta_sp_range] = 8.0;
  EXPECT_FALSE(judge(c, r).holds);
  // Only values that both have: of 7 and 8 nothing is left.
  r["t"].points.pop_back();
  EXPECT_TRUE(judge(c, r).holds);
  r["t"].points = {point(0.5, 'c', 1.0)};
  EXPECT_FALSE(judge(c, r).holds);
}

TEST(Claims, HoldWhereAllConditionsDo) {
  Condition first = condition(ConditionKind::count);
  first.regime = "chaotic";
  first.at_least = 1.0;
  Condition second = first;
  second.regime = "period 2";
  const Claim claim{"C", "", "", "", 1.0, {first, second}};
  EXPECT_TRUE(judge(claim, record("12c")).holds);
  const ClaimOutcome half = judge(claim, record("11c"));
  EXPECT_FALSE(half.holds);
  EXPECT_EQ(half.cost, 0.5 * half.conditions[1].cost);
}

TEST(Claims, AreNotMetByPointsThatFailed) {
  Condition c = condition(ConditionKind::count);
  c.regime = "chaotic";
  c.at_most = 1.0;
  EXPECT_TRUE(judge(c, record("11c1")).holds);
  EXPECT_FALSE(judge(c, record("1xc1")).holds);  // it may have been a second one
  EXPECT_TRUE(judge(c, record("1x11")).holds);
  c = condition(ConditionKind::variation);
  c.at_most = 0.5;
  EXPECT_FALSE(judge(c, record("xxxx")).holds);
  EXPECT_FALSE(judge(c, record("1")).holds);
  c = condition(ConditionKind::value);
  c.quantity = "delta_sp_range";
  c.at_most = 5.0;
  EXPECT_TRUE(judge(c, record("11")).holds);
  EXPECT_FALSE(judge(c, record("1x")).holds);
  c.at_most.reset();
  c.at_least = 0.5;
  EXPECT_TRUE(judge(c, record("1x")).holds);  // the largest can only be larger
  for (const Statistic statistic : {Statistic::min, Statistic::mean}) {
    c.statistic = statistic;
    EXPECT_TRUE(judge(c, record("11")).holds);
    EXPECT_FALSE(judge(c, record("1x")).holds);
  }
}

TEST(Claims, OnChangesTakeNoPointThatFailedForOne) {
  Condition c = condition(ConditionKind::variation);
  c.at_least = 0.5;
  EXPECT_TRUE(judge(c, record("112")).holds);
  EXPECT_FALSE(judge(c, record("1x1")).holds);
  EXPECT_FALSE(judge(c, record("xxx")).holds);
  c.at_least.reset();
  c.at_most = 0.5;
  EXPECT_FALSE(judge(c, record("111x")).holds);
}

TEST(Claims, OnTheFirstChangeAreNotMetWhereAnEarlierOneMayHaveFailed) {
  Condition c = condition(ConditionKind::change);
  c.regime = "period 1";
  c.regime_after = "not period 1";
  c.within = {4.0, 5.0};
  EXPECT_TRUE(judge(c, record("11111cc")).holds);
  EXPECT_FALSE(judge(c, record("11x11cc")).holds);
  EXPECT_TRUE(judge(c, record("11111cx")).holds);  // behind it
  // A change that may have been next to it, and within the bounds as well.
  c.within = {3.0, 5.5};
  EXPECT_EQ(judge(c, record("1111x1c")).measured, 5.5);
  EXPECT_TRUE(judge(c, record("1111x1c")).holds);
  c.which = Which::last;
  c.within = {1.0, 2.0};
  EXPECT_TRUE(judge(c, record("x1ccccc")).holds);
  EXPECT_FALSE(judge(c, record("x1cc1xc")).holds);
  // What it leads to may have been met after the motion came back.
  c.which = Which::first;
  c.leads_to = "chaotic";
  EXPECT_TRUE(judge(c, record("112c1")).holds);
  EXPECT_TRUE(judge(c, record("1122c")).holds);
  EXPECT_FALSE(judge(c, record("112xc")).holds);
}

TEST(Claims, OnPeaksTakeNoPointThatFailedForAValley) {
  Condition c = condition(ConditionKind::peaks);
  c.quantity = "delta_sp_range";
  c.peak_locations = {1.0};
  EXPECT_TRUE(judge(c, record("111", {1.0, 4.0, 3.0})).holds);
  const ConditionOutcome falling = judge(c, record("x111", {0.0, 4.0, 3.0, 2.0}));
  EXPECT_FALSE(falling.holds);
  EXPECT_NE(falling.text.find("1 point failed"), std::string::npos) << falling.text;
  // The largest value, of which it is a part, may have been there.
  EXPECT_FALSE(judge(c, record("111x", {1.0, 4.0, 3.0, 0.0})).holds);
}

TEST(Claims, OnSweepsThatFallAreNotMetWherePointsFailed) {
  Condition c = falling_range();
  ClaimRecord r = record("11", {2.0, 3.0});
  r["t"] = record("11", {1.0, 1.0})["s"];
  EXPECT_TRUE(judge(c, r).holds);
  r["t"].points[1].reached = false;
  const ConditionOutcome lost = judge(c, r);
  EXPECT_FALSE(lost.holds);
  EXPECT_NE(lost.text.find("of 1 value"), std::string::npos) << lost.text;
  EXPECT_NE(lost.text.find("1 point failed"), std::string::npos) << lost.text;
}

TEST(Claims, AreNotMetByRounding) {
  Condition c = condition(ConditionKind::jump);
  c.quantity = "delta_sp_range";
  c.at_least = 0.1;
  EXPECT_FALSE(judge(c, record("1111", {1e-14, 1e-14, 9e-14, 9e-14})).holds);
  c = condition(ConditionKind::reduction);
  c.quantity = "delta_sp_range";
  c.at_least = 5.0;
  EXPECT_FALSE(judge(c, record("11", {1e-13, 1e-14})).holds);
  EXPECT_TRUE(judge(c, record("111", {10.0, 10.0 + 1e-9, 1.0})).holds);
  c = falling_range();
  for (const double rounding : {-1e-9, 0.0, 1e-9}) {
    ClaimRecord r = record("11", {1.0, 2.0});
    r["t"] = record("11", {1.0, 2.0 + rounding})["s"];
    EXPECT_FALSE(judge(c, r).holds);
  }
}

TEST(Claims, OnQuantitiesBelowZero) {
  Condition c = falling_range();
  ClaimRecord r = record("11", {-1.0, -2.0});
  r["t"] = record("11", {-3.0, -4.0})["s"];
  EXPECT_TRUE(judge(c, r).holds);
  std::swap(r["s"], r["t"]);
  EXPECT_FALSE(judge(c, r).holds);
}

Condition published_curve(std::vector<double> at, std::vector<double> values, double tolerance) {
  Condition c = condition(ConditionKind::curve);
  c.quantity = "delta_sp_range";
  c.data_at = std::move(at);
  c.data = std::move(values);
  c.tolerance = tolerance;
  return c;
}

/// Where the options are refused, if once.
std::string refused_at(const ClaimsOptions& options) {
  const auto problems = options.problems();
  if (problems.empty()) return "nowhere";
  return problems.size() == 1 ? problems.front().first : "in " + std::to_string(problems.size()) + " places";
}

TEST(ClaimsOptions, RefuseWhatNobodyWouldJudge) {
  ClaimsOptions options;
  ClaimSweep sweep;
  sweep.name = "s";
  options.sweeps = {sweep};
  Condition c = condition(ConditionKind::share);
  c.regime = "period 1";
  c.at_least = 0.5;
  options.claims = {{"C", "", "", "", 1.0, {c}}};
  EXPECT_TRUE(options.problems().empty());
  const auto place_of = [&](auto change) {
    ClaimsOptions wrong = options;
    change(wrong);
    return refused_at(wrong);
  };
  const std::string place = "/claims/0/conditions/0";
  EXPECT_EQ(place_of([](auto& o) { o.claims[0].conditions[0].sweep = "t"; }), place + "/sweep");
  EXPECT_EQ(place_of([](auto& o) { o.claims[0].conditions[0].regime = "chaos"; }), place + "/regime");
  EXPECT_EQ(place_of([](auto& o) { o.claims[0].conditions[0].at_least.reset(); }), place);
  EXPECT_EQ(place_of([](auto& o) { o.claims[0].conditions[0].regime_after = "chaotic"; }), place + "/regime_after");
  EXPECT_EQ(place_of([](auto& o) { o.claims[0].conditions.clear(); }), "/claims/0/conditions");
  EXPECT_EQ(place_of([](auto& o) {
              o.sweeps[0].name = "../s";
              o.claims[0].conditions[0].sweep = "../s";
            }),
            "/sweeps/0/name");
  EXPECT_EQ(place_of([](auto& o) {
              o.space.parameters = {{"x", "", "", 0.0, 1.0, ParameterScale::linear, {}, "", ""}};
            }),
            "/parameters/0/targets");
  EXPECT_EQ(
      place_of([](auto& o) {
        o.space.parameters = {{"x", "", "", 0.0, 1.0, ParameterScale::logarithmic, {{"/stage/a", 1, 1, ""}}, "", ""}};
      }),
      "/parameters/0/from");
  EXPECT_EQ(place_of([](auto& o) { o.claims[0].conditions[0].at_least = 95.0; }), place + "/at_least");
  EXPECT_EQ(place_of([](auto& o) { o.claims[0].conditions[0].at_least = 0.0; }), place + "/at_least");
  EXPECT_EQ(place_of([](auto& o) { o.claims[0].conditions[0].which = Which::last; }), place + "/which");
  EXPECT_EQ(place_of([](auto& o) { o.claims[0].conditions[0].regime = "period 40"; }), place + "/regime");
  EXPECT_EQ(place_of([](auto& o) {
              o.sweeps[0].name = "s.json";
              o.claims[0].conditions[0].sweep = "s.json";
            }),
            "/sweeps/0/name");
  EXPECT_EQ(place_of([](auto& o) {
              o.space.parameters = {{"x", "", "", 0.0, 1.0, ParameterScale::linear, {{"/stage/a", 1, 1, ""}}, "", ""},
                                    {"y", "", "", 0.0, 1.0, ParameterScale::linear, {{"/stage/a", 1, 1, ""}}, "", ""}};
            }),
            "/parameters/1/targets/0/pointer");
}

FreeParameter one_parameter() {
  return {"x", "", "", 0.0, 1.0, ParameterScale::linear, {{"/stage/a", 1, 1, ""}}, "", ""};
}

TEST(ClaimsOptions, RefusePublishedNumbersThatDoNotFit) {
  const std::string place = "/claims/0/conditions/0";
  ClaimsOptions options;
  ClaimSweep sweep;
  sweep.name = "s";
  options.sweeps = {sweep};
  options.stages = {{"a", {}, {}}};
  options.starts = {Start::continued};
  options.claims = {{"C", "", "", "", 1.0, {published_curve({1.0, 2.0}, {1.0, 2.0}, 0.1)}}};
  EXPECT_EQ(refused_at(options), "nowhere");
  const auto place_of = [&](auto change) {
    ClaimsOptions wrong = options;
    change(wrong, wrong.claims[0].conditions[0]);
    return refused_at(wrong);
  };
  EXPECT_EQ(place_of([](auto&, auto& c) { c.data.pop_back(); }), place + "/data");
  EXPECT_EQ(place_of([](auto&, auto& c) { c.data = {0.0, 0.0}; }), place + "/data");
  EXPECT_EQ(place_of([](auto&, auto& c) { c.data_at[1] = 4.0; }), place + "/data_at/1");
  EXPECT_EQ(place_of([](auto&, auto& c) { c.tolerance.reset(); }), place + "/tolerance");
  EXPECT_EQ(place_of([](auto&, auto& c) { c.at_least = 1.5; }), place + "/at_least");
  EXPECT_EQ(place_of([](auto&, auto& c) { c.direction = Direction::down; }), place + "/direction");
  EXPECT_EQ(place_of([](auto&, auto& c) { c.from = 1.0; }), place + "/from");
  EXPECT_EQ(place_of([](auto&, auto& c) { c.frequencies_Hz = {1.0}; }), place + "/frequencies_Hz");
  EXPECT_EQ(place_of([](auto& o, auto&) { o.stages[0].name = "s"; }), "/stages/0/name");
  Condition modes;
  modes.kind = ConditionKind::frequencies;
  modes.stage = "a";
  modes.frequencies_Hz = {1.0, 2.0, 3.0};
  modes.tolerance_Hz = {0.1};
  options.claims[0].conditions[0] = modes;
  EXPECT_EQ(refused_at(options), "nowhere");
  EXPECT_EQ(place_of([](auto&, auto& c) { c.stage = "b"; }), place + "/stage");
  EXPECT_EQ(place_of([](auto&, auto& c) { c.sweep = "s"; }), place + "/sweep");
  EXPECT_EQ(place_of([](auto&, auto& c) { c.tolerance_Hz = {0.1, 0.2}; }), place + "/tolerance_Hz");
  EXPECT_EQ(place_of([](auto&, auto& c) { c.quantity = "delta_sp_range"; }), place + "/quantity");
  EXPECT_EQ(place_of([](auto& o, auto&) { o.space.parameters = {one_parameter()}; }), place + "/kind");
  // Without sweeps there are frequencies alone.
  EXPECT_EQ(place_of([](auto& o, auto&) { o.sweeps.clear(); }), "nowhere");
  EXPECT_EQ(place_of([](auto& o, auto&) {
              o.figures = {{"f", "", {{"", MeshSide::sun_planet, "", "a", ""}}}};
            }),
            "nowhere");
  EXPECT_EQ(place_of([](auto& o, auto&) {
              o.figures = {{"f", "", {{"", MeshSide::sun_planet, "", "b", ""}}}};
            }),
            "/figures/0/panels/0/stage");
  EXPECT_EQ(
      place_of([](auto& o, auto&) {
        o.figures = {{"f", "", {{"s", MeshSide::sun_planet, "", "", ""}, {"", MeshSide::sun_planet, "", "a", ""}}}};
      }),
      "/figures/0/panels/1");
}

/// A sweep of 29 points, from 0.2 to 3.
ClaimsOptions options_with(const Condition& c) {
  ClaimsOptions options;
  ClaimSweep sweep;
  sweep.name = "s";
  sweep.axis = {speed_parameter, 0.2, 3.0, 29};
  options.sweeps = {sweep};
  options.claims = {{"C", "", "", "", 1.0, {c}}};
  return options;
}

TEST(ClaimsOptions, RefuseConditionsThatAlwaysHold) {
  const std::string place = "/claims/0/conditions/0";
  Condition c = condition(ConditionKind::count);
  c.regime = "period 1";
  c.at_most = 28.0;
  EXPECT_EQ(refused_at(options_with(c)), "nowhere");
  c.at_most = 29.0;
  EXPECT_EQ(refused_at(options_with(c)), place + "/at_most");
  // A number of points is another claim on another grid, but for none and any.
  ClaimsOptions coarse = options_with(c);
  coarse.sweeps[0].screening_points = coarse.sweeps[0].survey_points = 10;
  coarse.claims[0].conditions[0].at_most = 5.0;
  EXPECT_EQ(refused_at(coarse), "nowhere");  // there is nothing to search for
  coarse.space.parameters = {one_parameter()};
  EXPECT_EQ(refused_at(coarse), place + "/at_most");
  coarse.claims[0].conditions[0].at_most = 0.0;
  EXPECT_EQ(refused_at(coarse), "nowhere");
  c = condition(ConditionKind::agreement);
  c.at_least = 0.9;
  c.correlation = 0.0;
  EXPECT_EQ(refused_at(options_with(c)), place + "/correlation");
  c = condition(ConditionKind::value);
  c.quantity = "delta_sp_range";
  c.at_least = -1.0;
  EXPECT_EQ(refused_at(options_with(c)), place + "/at_least");
  c = condition(ConditionKind::change);
  c.within = {0.5, 1.0};
  for (const auto& [motion, after] : {std::pair("period 1", "period 1"), std::pair("periodic", "not chaotic")}) {
    c.regime = motion;
    c.regime_after = after;
    EXPECT_EQ(refused_at(options_with(c)), place + "/regime_after") << motion;
  }
  c.regime_after = "not periodic";
  EXPECT_EQ(refused_at(options_with(c)), "nowhere");
  c = condition(ConditionKind::peaks);
  c.quantity = "delta_sp_range";
  c.peak_locations = {1.0, 1.1};
  EXPECT_EQ(refused_at(options_with(c)), place + "/peak_locations/1");
}

TEST(ClaimsOptions, RefuseConditionsThatNeverHold) {
  const std::string place = "/claims/0/conditions/0";
  Condition c = condition(ConditionKind::change);
  c.regime = "period 1";
  c.regime_after = "not period 1";
  c.within = {1.01, 1.04};
  EXPECT_EQ(refused_at(options_with(c)), place + "/within");
  c.within = {1.01, 1.06};
  EXPECT_EQ(refused_at(options_with(c)), "nowhere");
  ClaimsOptions coarse = options_with(c);
  coarse.sweeps[0].screening_points = 8;     // at 0.2, 0.6, 1, 1.4, ...
  EXPECT_EQ(refused_at(coarse), "nowhere");  // there is nothing to search for
  coarse.space.parameters = {one_parameter()};
  EXPECT_EQ(refused_at(coarse), place + "/within");
  c.leads_to = "period 1";
  EXPECT_EQ(refused_at(options_with(c)), place + "/leads_to");
  c.regime = "periodic";
  c.regime_after = "not periodic";
  c.leads_to = "period 2";
  EXPECT_EQ(refused_at(options_with(c)), place + "/leads_to");
  c.leads_to = "chaotic";
  EXPECT_EQ(refused_at(options_with(c)), "nowhere");
  c = condition(ConditionKind::reduction);
  c.quantity = "delta_sp_range";
  c.at_least = 2.0;
  c.from = c.to = 1.0;
  EXPECT_EQ(refused_at(options_with(c)), place);
  c = condition(ConditionKind::agreement);
  c.at_least = 0.9;
  c.from = c.to = 1.0;
  EXPECT_EQ(refused_at(options_with(c)), "nowhere");
  c.correlation = 0.5;
  EXPECT_EQ(refused_at(options_with(c)), place);
  c = condition(ConditionKind::count);
  c.regime = "chaotic";
  c.at_least = 1.2;
  c.at_most = 1.8;
  EXPECT_EQ(refused_at(options_with(c)), place + "/at_most");
  c = condition(ConditionKind::peaks);
  c.quantity = "delta_sp_range";
  c.peak_locations = {0.95};
  c.location_tolerance = 0.01;
  EXPECT_EQ(refused_at(options_with(c)), place + "/peak_locations/0");
  c = condition(ConditionKind::count);
  c.regime = "period 3";
  c.at_least = 1.0;
  ClaimsOptions brief = options_with(c);
  brief.recording.recorded_periods = 4;
  EXPECT_EQ(refused_at(brief), "nowhere");  // evidence is sought for as long as it takes
  brief.recording.classification_periods = 0;
  EXPECT_EQ(refused_at(brief), place + "/regime");
  // What does not recur is undecided then.
  brief.claims[0].conditions[0].regime = "chaotic";
  EXPECT_EQ(refused_at(brief), place + "/regime");
  brief.claims[0].conditions[0].regime = "not periodic";
  EXPECT_EQ(refused_at(brief), "nowhere");
  brief.recording.recorded_periods = 1;
  EXPECT_EQ(refused_at(brief), "/recorded_periods");
}

TEST(ClaimsOptions, RefuseExponentsThatSearchesDoNotCompute) {
  Condition c = condition(ConditionKind::value);
  c.quantity = "lyapunov_max";
  c.at_most = 0.0;
  ClaimsOptions options = options_with(c);
  EXPECT_EQ(refused_at(options), "nowhere");
  options.space.parameters = {one_parameter()};
  EXPECT_EQ(refused_at(options), "/claims/0/conditions/0/quantity");
  options.screening.classification_periods = options.survey.recording.classification_periods = 512;
  EXPECT_EQ(refused_at(options), "nowhere");
}

TEST(ClaimsOptions, RefuseSweepsThatShareNoValues) {
  Condition c = falling_range();
  ClaimsOptions options = options_with(c);
  options.space.parameters = {one_parameter()};
  options.sweeps.push_back(options.sweeps.front());
  options.sweeps[1].name = "t";
  EXPECT_EQ(refused_at(options), "nowhere");
  options.sweeps[1].axis.points = options.sweeps[1].screening_points = options.sweeps[1].survey_points = 15;
  EXPECT_EQ(refused_at(options), "nowhere");
  options.sweeps[1].axis.points = options.sweeps[1].screening_points = options.sweeps[1].survey_points = 14;
  EXPECT_EQ(refused_at(options), "in 3 places");  // both ends alone
  options = options_with(c);
  options.sweeps.push_back(options.sweeps.front());
  options.sweeps[1].name = "t";
  options.claims[0].conditions[0].from = 5.0;
  EXPECT_EQ(refused_at(options), "/claims/0/conditions/0");
  options.claims[0].conditions[0].from.reset();
  options.claims[0].conditions[0].regime = "period 100";
  EXPECT_EQ(refused_at(options), "/claims/0/conditions/0/regime");
}

TEST(ClaimsOptions, RefuseChoicesThatDecideNothing) {
  Condition c = condition(ConditionKind::share);
  c.regime = "period 1";
  c.at_least = 0.5;
  const Choice choice{"A", "", {{"a", 1, {{"/stage/x", "1"}}}, {"b", 1, {{"/stage/x", "2"}}}}};
  ClaimsOptions options = options_with(c);
  options.space.choices = {choice};
  EXPECT_EQ(refused_at(options), "nowhere");
  options.space.choices[0].options[1].sets[0].value = "1";
  EXPECT_EQ(refused_at(options), "/choices/0/options/1/sets");
  options.space.choices = {choice, {"B", "", {{"c", 1, {{"/stage/x/y", "3"}}}, {"d", 1, {}}}}};
  EXPECT_EQ(refused_at(options), "in 2 places");  // by both options of A
  options.space.choices = {choice};
  options.space.parameters = {{"p", "", "", 0.0, 1.0, ParameterScale::linear, {{"/stage/x", 1, 1, ""}}, "", ""}};
  EXPECT_EQ(refused_at(options), "in 2 places");                  // both options of A
  options.space.parameters[0].targets[0].pointer = "/stage/x/y";  // a part of it
  EXPECT_EQ(refused_at(options), "in 2 places");
  options.space.parameters[0].targets[0].pointer = "/stage/x";
  options.space.parameters[0].choice = "A";
  options.space.parameters[0].option = "a";
  EXPECT_EQ(refused_at(options), "nowhere");
  options.space.parameters[0].targets[0].times = "p";
  EXPECT_EQ(refused_at(options), "/parameters/0/targets/0/times");
  // What multiplies counts wherever what it multiplies does.
  FreeParameter multiplied{"q", "", "", 0.0, 1.0, ParameterScale::linear, {{"/stage/y", 1, 1, "p"}}, "", ""};
  options.space.parameters[0].targets[0].times = "";
  options.space.parameters.push_back(multiplied);
  EXPECT_EQ(refused_at(options), "/parameters/1/targets/0/times");
  options.space.parameters[1].choice = "A";
  options.space.parameters[1].option = "a";
  EXPECT_EQ(refused_at(options), "nowhere");
}

/// A claim asks for what points.csv has under the same name.
TEST(Claims, QuantitiesAreColumnsOfTheirNames) {
  constexpr std::size_t planets = 3;
  PointResult r = test::numbered_points(planets)[0];
  r.poincare_columns = 2 + 2 * planets;
  r.poincare.assign(r.poincare_columns, 1.0);
  const ClaimPoint point = claim_point(r, {}, Depth::in_full);
  std::map<std::string, double> columns;
  for (const store::PointColumn& c : store::point_columns(planets))
    if (const auto* number = std::get_if<store::PointColumn::Getter<double>>(&c.value)) columns[c.name] = (*number)(r);
  std::size_t compared = 0;
  for (const std::string_view name : claim_quantities) {
    const auto column = columns.find(std::string(name));
    if (column == columns.end()) {
      EXPECT_TRUE(name.starts_with("poincare_") || name == "load_sharing_max") << name;
      continue;
    }
    EXPECT_EQ(point.quantity(name), column->second) << name;
    ++compared;
  }
  EXPECT_EQ(compared, claim_quantities.size() - 3);
  double most = 0.0;
  for (std::size_t i = 1; i <= planets; ++i)
    for (const char* mesh : {"sp_", "rp_"})
      most = std::max(most, columns.at("load_sharing_" + (mesh + std::to_string(i))));
  EXPECT_EQ(point.quantity("load_sharing_max"), most);
}

TEST(Claims, AnyColumnOfNumbersIsAQuantity) {
  constexpr std::size_t planets = 3;
  PointResult r = test::numbered_points(planets)[0];
  r.poincare_columns = 2 + 2 * planets;
  r.poincare.assign(r.poincare_columns, 1.0);
  const ClaimPoint point = claim_point(r, {}, Depth::in_full);
  std::size_t compared = 0;
  for (const store::PointColumn& c : store::point_columns(planets)) {
    const auto* number = std::get_if<store::PointColumn::Getter<double>>(&c.value);
    if (number == nullptr || std::ranges::find(column_quantities(), c.name) == column_quantities().end()) continue;
    const double there = (*number)(r);
    EXPECT_TRUE(point.quantity(c.name) == there || (std::isnan(there) && std::isnan(point.quantity(c.name)))) << c.name;
    ++compared;
  }
  EXPECT_EQ(compared, column_quantities().size());
  EXPECT_GT(compared, 30U);
  for (const char* name : {"delta_sp_mean", "delta_sp_h1", "k_gamma_sp", "force_sun_bearing_rms"})
    EXPECT_NE(std::ranges::find(column_quantities(), name), column_quantities().end()) << name;
}

/// Ranges 0, 2, 8 at 0, 1, 2; from above 0, 5, 8.
ClaimRecord curves() {
  ClaimRecord r = record("111", {0.0, 2.0, 8.0});
  r["s"].other = record("111", {0.0, 5.0, 8.0})["s"].points;
  return r;
}

TEST(Claims, OnACurveAreJudgedAtItsData) {
  // Between points it is linear: 5 at 1.5. The tolerance is a part of the largest value.
  Condition c = published_curve({0.0, 1.0, 1.5, 2.0}, {0.0, 2.0, 5.0, 8.0}, 1e-12);
  EXPECT_TRUE(judge(c, curves()).holds);
  c.data[1] = 2.4;
  const ConditionOutcome off = judge(c, curves());
  EXPECT_FALSE(off.holds);
  EXPECT_EQ(off.measured, 0.75);
  EXPECT_NE(off.text.find("most off by 5 %: 2 for 2.4 at 1"), std::string::npos) << off.text;
  c.tolerance = 0.0501;
  EXPECT_TRUE(judge(c, curves()).holds);
  c.tolerance = 0.0499;
  EXPECT_FALSE(judge(c, curves()).holds);
  c.at_least = 0.75;
  EXPECT_TRUE(judge(c, curves()).holds);
  // What is nearer costs less.
  c.at_least = 1.0;
  const double near = judge(c, curves()).cost;
  c.data[1] = 7.0;
  EXPECT_GT(judge(c, curves()).cost, near);
}

TEST(Claims, OnACurveMayBeOfTheOtherDirection) {
  Condition c = published_curve({1.0}, {5.0}, 1e-12);
  EXPECT_FALSE(judge(c, curves()).holds);
  c.direction = Direction::down;
  EXPECT_TRUE(judge(c, curves()).holds);
  c.direction = Direction::up;
  EXPECT_FALSE(judge(c, curves()).holds);
}

TEST(Claims, OnACurveDoNotHoldWhereAPointFailed) {
  const Condition c = published_curve({0.5, 2.0}, {1.0, 8.0}, 1e-6);
  ClaimRecord r = record("1x1", {0.0, 2.0, 8.0});
  EXPECT_FALSE(judge(c, r).holds);
  EXPECT_NE(judge(c, r).text.find("not computed"), std::string::npos);
}

/// Three frequencies, one of them double.
ClaimRecord stage_of_modes() {
  ClaimRecord r;
  r["a"].modes = {{0.0, "rotational", 1}, {100.04, "translational", 2}, {200.0, "rotational", 1}};
  return r;
}

TEST(Claims, OnFrequenciesAreOfAllModesOfAType) {
  Condition c;
  c.kind = ConditionKind::frequencies;
  c.stage = "a";
  c.mode_type = "rotational";
  c.frequencies_Hz = {200.05, 0.0};
  c.tolerance_Hz = {0.1};
  const ConditionOutcome two = judge(c, stage_of_modes());
  EXPECT_TRUE(two.holds) << two.text;
  EXPECT_NEAR(two.measured, 0.05, 1e-12);
  // A tolerance of its own for each, in their order as given.
  c.tolerance_Hz = {0.01, 0.1};
  EXPECT_FALSE(judge(c, stage_of_modes()).holds);
  c.tolerance_Hz = {0.1, 0.01};
  EXPECT_TRUE(judge(c, stage_of_modes()).holds);
  // One that is missing, and one too many.
  c.tolerance_Hz = {0.1};
  c.frequencies_Hz = {0.0};
  EXPECT_FALSE(judge(c, stage_of_modes()).holds);
  c.frequencies_Hz = {0.0, 100.0, 200.0};
  EXPECT_FALSE(judge(c, stage_of_modes()).holds);
  c.mode_type = "";
  EXPECT_TRUE(judge(c, stage_of_modes()).holds);
  c.multiplicity = 1;
  EXPECT_FALSE(judge(c, stage_of_modes()).holds);
  c.mode_type = "translational";
  c.frequencies_Hz = {100.0};
  c.multiplicity = 2;
  EXPECT_TRUE(judge(c, stage_of_modes()).holds);
  EXPECT_FALSE(judge(Claim{"C", "", "", "", 1.0, {c}}, stage_of_modes()).inert);
}

TEST(Claims, AGlanceTellsGrowthFromNone) {
  const input::LoadedInput input = input::load_input("inputs/tang2020_speed.json");
  const ModelAt at = input::model_at(input);
  RecordingOptions recording = by_recurrence_alone(input.study.recording());
  recording.transient_periods = 300;
  recording.recorded_periods = 32;
  recording.period_max = 16;
  integrate::IntegratorOptions integrator = input.study.integrator;
  integrator.relative_tolerance = 1e-5;
  integrator.absolute_tolerance = 1e-5;
  const auto motion_at = [&](double speed) {
    const GridPoint point{0, Direction::up, speed};
    return claim_point(compute_point_as_swept(point, at(speed), {}, recording, integrator, [] { return true; }),
                       recording, Depth::screening)
        .response.text();
  };
  EXPECT_EQ(motion_at(1.3), "undecided");
  recording.growth_periods = 64;
  EXPECT_EQ(motion_at(1.3), "chaotic");
  EXPECT_EQ(motion_at(2.05), "quasiperiodic");
  // It loses 0.4 % a period of what it is away from its orbit, and is told by where it goes.
  EXPECT_EQ(motion_at(3.0), "period 1");
}

}  // namespace
}  // namespace epicyclic::claims::judging_test
