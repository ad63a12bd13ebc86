#include "claims/calibration.hpp"

#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace epicyclic::claims::calibration_test {
namespace {

using namespace studies;

/// A space of linear parameters in [0, 1], and claims in name alone.
ClaimsOptions options_of(std::size_t parameters) {
  ClaimsOptions options;
  for (std::size_t k = 0; k < parameters; ++k)
    options.space.parameters.push_back(
        {"x" + std::to_string(k), "", "", 0.0, 1.0, ParameterScale::linear, {{"/x", 1, 1, ""}}, "", ""});
  options.claims.resize(1);
  options.search.islands = 3;
  options.search.population = 10;
  options.search.candidates = 2400;
  options.search.refinement = 150;
  options.search.profile = 5;
  return options;
}

/// A valley with ripples; least, 0, where x_k = 0.2 + 0.1 k.
Evaluation rippled(std::span<const double> u, double give_up_at) {
  constexpr double tau = 6.283185307179586;
  Evaluation e;
  e.cost = 0.0;
  for (std::size_t k = 0; k < u.size(); ++k) {
    const double d = u[k] - (0.2 + 0.1 * static_cast<double>(k));
    e.cost += d * d + 0.02 * (1.0 - std::cos(5.0 * tau * d));
  }
  e.stopped_early = e.cost >= give_up_at;
  e.claim_costs = {e.cost};
  e.holds = {0};
  return e;
}

Calibration search(const ClaimsOptions& options, int threads, KnownEvaluations known = {},
                   const std::vector<std::vector<double>>& first = {}) {
  CalibrationRun run;
  run.threads = threads;
  run.known = std::move(known);
  Calibration found = calibrate(
      options, [](const Question& q) { return rippled(q.u, q.give_up_at); }, first, run);
  EXPECT_TRUE(found.complete);
  return found;
}

bool same(const KnownEvaluations& a, const KnownEvaluations& b) {
  if (a.size() != b.size()) return false;
  for (auto i = a.begin(), j = b.begin(); i != a.end(); ++i, ++j)
    if (i->first != j->first || i->second.u != j->second.u || i->second.evaluation.cost != j->second.evaluation.cost)
      return false;
  return true;
}

TEST(Calibration, FindsTheDeepestOfManyValleys) {
  for (const SearchMethod method : {SearchMethod::differential_evolution, SearchMethod::covariance_adaptation}) {
    ClaimsOptions options = options_of(5);
    options.search.method = method;
    options.search.spread = 0.3;
    const Calibration found = search(options, 1, {}, {std::vector<double>(5, 0.5)});
    EXPECT_LT(found.best->evaluation.cost, 1e-3);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(found.best->u[k], 0.2 + 0.1 * static_cast<double>(k), 0.01);
    EXPECT_LE(found.evaluations.size(), most_evaluations(options));
    ASSERT_EQ(found.profile.size(), 25U);
    EXPECT_EQ(found.profile[4].u, 1.0);
    EXPECT_GT(found.profile[4].evaluation.cost, 0.5);
  }
}

TEST(Calibration, DoesNotDependOnThreads) {
  const ClaimsOptions options = options_of(4);
  const Calibration one = search(options, 1);
  EXPECT_TRUE(same(one.evaluations, search(options, 3).evaluations));
  ClaimsOptions other = options;
  other.search.seed = 2;
  EXPECT_FALSE(same(one.evaluations, search(other, 1).evaluations));
}

TEST(Calibration, GoesOnFromWhatWasKept) {
  ClaimsOptions options = options_of(4);
  options.search.candidates = 300;
  const Calibration whole = search(options, 1);
  std::atomic<bool> stop = false;
  std::size_t evaluated = 0;
  KnownEvaluations kept;
  CalibrationRun run;
  run.stop = &stop;
  run.evaluated = [&](const EvaluatedCandidate& c) { kept.emplace(c.key, c); };
  const auto until_stopped = [&](const Question& q) {
    if (++evaluated == 100) {
      stop = true;
      throw EvaluationStopped();
    }
    return rippled(q.u, q.give_up_at);
  };
  const Calibration stopped = calibrate(options, until_stopped, {}, run);
  EXPECT_FALSE(stopped.complete);
  EXPECT_EQ(stopped.evaluations.size(), 99U);
  EXPECT_TRUE(stopped.best.has_value());
  EXPECT_EQ(kept.size(), 99U);
  const Calibration resumed = search(options, 2, kept);
  EXPECT_TRUE(same(whole.evaluations, resumed.evaluations));
  EXPECT_EQ(whole.best->u, resumed.best->u);
}

TEST(Calibration, GoesOnFromAnyNumberOfItsEvaluations) {
  for (const SearchMethod method : {SearchMethod::differential_evolution, SearchMethod::covariance_adaptation}) {
    ClaimsOptions options = options_of(3);
    options.search.method = method;
    options.search.candidates = 60;
    options.search.refinement = 30;
    options.search.profile = 2;
    options.search.confirmed = 2;
    std::vector<EvaluatedCandidate> in_order;
    CalibrationRun run;
    run.evaluated = [&](const EvaluatedCandidate& c) { in_order.push_back(c); };
    const auto evaluate = [](const Question& q) { return rippled(q.u, q.give_up_at); };
    const Calibration whole = calibrate(options, evaluate, {}, run);
    ASSERT_TRUE(whole.complete);
    ASSERT_EQ(in_order.size(), whole.evaluations.size());
    // Every phase asks for evaluations, and the refinement finds the best: what it begins with is then not the best.
    std::set<std::size_t> phases;
    for (const EvaluatedCandidate& c : in_order) phases.insert(c.key.phase);
    ASSERT_EQ(phases.size(), 6U);
    ASSERT_EQ(whole.best->key.phase, 3U);
    KnownEvaluations kept;
    for (std::size_t n = 0; n <= in_order.size(); ++n) {
      const Calibration resumed = search(options, 1 + static_cast<int>(n % 3), kept);
      EXPECT_TRUE(same(whole.evaluations, resumed.evaluations)) << n;
      EXPECT_EQ(whole.best->key, resumed.best->key) << n;
      if (n < in_order.size()) kept.emplace(in_order[n].key, in_order[n]);
    }
  }
}

TEST(Calibration, TakesOfItsBestTheOneThatMeetsMostByWholeSweeps) {
  ClaimsOptions options = options_of(3);
  options.search.candidates = 300;
  options.search.confirmed = 6;
  options.search.profile = 1;
  std::atomic<int> whole = 0;
  // By whole sweeps only what lies off the least cost holds.
  const auto evaluate = [&](const Question& q) {
    Evaluation e = rippled(q.u, q.give_up_at);
    if (q.whole) {
      ++whole;
      e.holds = {static_cast<char>(q.u[0] > 0.21 ? 1 : 0)};
    }
    return e;
  };
  CalibrationRun run;
  run.threads = 2;
  const Calibration found = calibrate(options, evaluate, {}, run);
  ASSERT_TRUE(found.complete);
  ASSERT_EQ(found.confirmed.size(), 6U);
  EXPECT_EQ(whole, 6);
  EXPECT_LE(found.evaluations.size(), most_evaluations(options));
  EXPECT_EQ(found.confirmed.front().whole.holds[0], 1);
  EXPECT_GT(found.best->u[0], 0.21);
  EXPECT_EQ(found.best->u, found.confirmed.front().candidate.u);
  for (std::size_t a = 0; a < 6; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      double distance = 0.0;
      for (std::size_t k = 0; k < 3; ++k)
        distance = std::max(distance, std::abs(found.confirmed[a].candidate.u[k] - found.confirmed[b].candidate.u[k]));
      EXPECT_GE(distance, least_distance);
    }
  // Of equals the one of less cost.
  for (std::size_t k = 1; k < 6; ++k)
    if (found.confirmed[k].whole.holds == found.confirmed[k - 1].whole.holds) {
      EXPECT_GE(found.confirmed[k].candidate.evaluation.cost, found.confirmed[k - 1].candidate.evaluation.cost);
    }
}

TEST(Calibration, TakesNoneThatIsNoStageAllAlong) {
  ClaimsOptions options = options_of(3);
  options.search.candidates = 300;
  options.search.confirmed = 3;
  options.search.profile = 0;
  // The least cost is no valid stage at some value of a whole sweep; or none of them is.
  for (const bool all : {false, true}) {
    const auto evaluate = [all](const Question& q) {
      Evaluation e = rippled(q.u, q.give_up_at);
      if (q.whole && (all || q.u[0] < 0.21)) e.refused = "pointed teeth";
      return e;
    };
    const Calibration found = calibrate(options, evaluate, {}, {});
    ASSERT_TRUE(found.complete);
    ASSERT_EQ(found.confirmed.size(), 3U);
    EXPECT_EQ(found.whole() == nullptr, all);
    EXPECT_FALSE(found.confirmed.back().whole.refused.empty());
    ASSERT_TRUE(found.best.has_value());
    EXPECT_TRUE(all || found.best->u[0] >= 0.21);
  }
}

TEST(Calibration, RefusesEvaluationsOfAnotherSearch) {
  ClaimsOptions options = options_of(3);
  options.search.candidates = 60;
  const Calibration found = search(options, 1);
  options.search.seed = 7;
  EXPECT_THROW((void)search(options, 1, found.evaluations), InputError);
}

TEST(Calibration, BeginsWithTheStageAsItIsGiven) {
  ClaimsOptions options = options_of(3);
  options.search.candidates = 60;
  const std::vector<double> given = {0.2, 0.3, 0.4};
  const Calibration found = search(options, 1, {}, {given});
  EXPECT_EQ(found.evaluations.at({0, 0}).u, given);
  EXPECT_EQ(found.best->u, given);
}

TEST(ParameterSpace, MapsTheUnitCube) {
  ParameterSpace space;
  space.parameters = {{"a", "", "", 1.0, 100.0, ParameterScale::logarithmic, {{"/a", 2.0, -1.0, ""}}, "", ""},
                      {"r", "", "", 0.8, 1.2, ParameterScale::linear, {}, "", ""},
                      {"b", "", "", 0.0, 4.0, ParameterScale::linear, {{"/b", 1.0, 1.0, "r"}}, "load", "torque"}};
  space.choices = {{"load", "", {{"power", 3.0, {}}, {"torque", 1.0, {}}}}};
  ASSERT_EQ(space.dimension(), 4U);
  std::vector<double> u = {0.5, 0.25, 0.5, 0.8};
  const auto values = space.values_at(u);
  EXPECT_NEAR(values[0], 10.0, 1e-12);
  EXPECT_NEAR(values[1], 0.9, 1e-12);
  EXPECT_EQ(space.options_at(u), std::vector<std::size_t>{1});
  auto targets = space.targets_at(u);
  ASSERT_EQ(targets.size(), 2U);
  EXPECT_NEAR(targets[0].value, 0.2, 1e-12);
  EXPECT_NEAR(targets[1].value, 1.8, 1e-12);
  u[3] = 0.7;  // below the odds of 3 : 1
  EXPECT_EQ(space.options_at(u), std::vector<std::size_t>{0});
  EXPECT_EQ(space.targets_at(u).size(), 1U);
  for (const double x : {1.0, 3.0, 100.0})
    EXPECT_NEAR(space.parameters[0].at(space.parameters[0].place_of(x)), x, 1e-9);
  EXPECT_EQ(space.choices[0].at(space.choices[0].place_of(0)), 0U);
  EXPECT_EQ(space.choices[0].at(space.choices[0].place_of(1)), 1U);
  EXPECT_EQ(space.choices[0].at(1.0), 1U);
}

}  // namespace
}  // namespace epicyclic::claims::calibration_test
