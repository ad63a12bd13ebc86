#include "studies/robustness.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace epicyclic::studies {
namespace {

/// Two parameters; a claim that the first alone decides, one that holds always, one that is never looked at.
ClaimsOptions options_of(int draws) {
  ClaimsOptions options;
  for (const char* name : {"a", "b"})
    options.space.parameters.push_back({name, "", "", 0.0, 1.0, Spread::linear, {{"/x", 1, 1, ""}}, "", ""});
  options.claims.resize(2);
  options.survey.draws = draws;
  options.survey.seed = 5;
  return options;
}

Evaluation decided_by_first(std::span<const double> u) {
  Evaluation e;
  e.cost = u[0];
  e.claim_costs = {u[0] < 0.25 ? 0.0 : u[0], 0.0};
  e.holds = {static_cast<char>(u[0] < 0.25 ? 1 : 0), 1};
  return e;
}

KnownEvaluations surveyed(const ClaimsOptions& options, int threads, KnownEvaluations known = {}) {
  CalibrationRun run;
  run.threads = threads;
  run.known = std::move(known);
  return survey(
      options, [](std::span<const double> u, double, std::size_t) { return decided_by_first(u); }, run);
}

TEST(Survey, DrawsTheSameWhoeverAsks) {
  const ClaimsOptions options = options_of(50);
  const KnownEvaluations one = surveyed(options, 1);
  const KnownEvaluations three = surveyed(options, 3);
  ASSERT_EQ(one.size(), 50U);
  for (const auto& [key, c] : one) {
    EXPECT_EQ(c.u, three.at(key).u);
    EXPECT_EQ(c.u, draw(options.space, 5, key.number));
    for (const double u : c.u) EXPECT_TRUE(u >= 0.0 && u < 1.0);
  }
  // More draws begin with these, which are not asked for again.
  KnownEvaluations kept = one;
  kept.at({0, 7}).evaluation.cost = -1.0;
  const KnownEvaluations more = surveyed(options_of(60), 2, kept);
  EXPECT_EQ(more.size(), 60U);
  EXPECT_EQ(more.at({0, 7}).evaluation.cost, -1.0);
  ClaimsOptions other = options;
  other.survey.seed = 6;
  EXPECT_THROW((void)surveyed(other, 1, one), InputError);
}

TEST(Robustness, TellsPartsAndWhatDecides) {
  const ClaimsOptions options = options_of(400);
  const auto claims = robustness(options, surveyed(options, 1));
  ASSERT_EQ(claims.size(), 2U);
  const analysis::Interval& part = claims[0].fraction;
  EXPECT_LT(part.low, 0.25);
  EXPECT_GT(part.high, 0.25);
  EXPECT_LT(part.high - part.low, 0.1);
  EXPECT_LT(claims[0].influences[0].high, -0.9);  // it scores less as the first parameter grows
  EXPECT_LT(claims[0].influences[1].low, 0.0);
  EXPECT_GT(claims[0].influences[1].high, 0.0);
  EXPECT_EQ(claims[1].fraction.value, 1.0);
  EXPECT_EQ(claims[1].fraction.high, 1.0);
  EXPECT_TRUE(std::isnan(claims[1].influences[0].value));  // always the same: nothing decides it
}

TEST(Robustness, LeavesOutWhatIsNoStage) {
  const ClaimsOptions options = options_of(10);
  KnownEvaluations all = surveyed(options, 1);
  all.at({0, 3}).evaluation.refused = "no stage";
  EXPECT_EQ(robustness(options, all)[1].draws, 9U);
}

}  // namespace
}  // namespace epicyclic::studies
