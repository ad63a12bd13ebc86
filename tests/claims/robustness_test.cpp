#include "claims/robustness.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"

namespace epicyclic::claims::robustness_test {
namespace {

using namespace studies;

/// Two parameters; a claim that the first alone decides, one that holds always, one that is never looked at.
ClaimsOptions options_of(int draws) {
  ClaimsOptions options;
  for (const char* name : {"a", "b"})
    options.space.parameters.push_back({name, "", "", 0.0, 1.0, ParameterScale::linear, {{"/x", 1, 1, ""}}, "", ""});
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
      options, [](const Question& q) { return decided_by_first(q.u); }, run);
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

TEST(Survey, HoldsItsFirstValidDrawsAgainstWholeSweeps) {
  ClaimsOptions options = options_of(20);
  options.survey.confirmed = 12;
  CalibrationRun run;
  run.threads = 2;
  // Draw 3 is no stage. Whole sweeps say of the first claim what the second parameter does, and the opposite of the
  // second claim.
  const std::vector<double> no_stage = draw(options.space, 5, 3);
  const KnownEvaluations all = survey(
      options,
      [&](const Question& q) {
        Evaluation e = decided_by_first(q.u);
        if (q.u[0] == no_stage[0]) e.refused = "no stage";
        if (q.whole) e.holds = {static_cast<char>(q.u[1] < 0.5 ? 1 : 0), 0};
        return e;
      },
      run);
  EXPECT_TRUE(survey_is_complete(options, all));
  EXPECT_EQ(surveyed_draws(all).size(), 20U);
  EXPECT_EQ(all.size(), 32U);
  EXPECT_FALSE(all.contains({1, 3}));
  EXPECT_TRUE(all.contains({1, 12}));
  const auto agreed = agreement(options, all);
  ClaimAgreement expected;
  for (std::size_t d = 0; d <= 12; ++d) {
    if (d == 3) continue;
    const std::vector<double> u = draw(options.space, 5, d);
    ++(u[0] < 0.25 ? (u[1] < 0.5 ? expected.both : expected.glance_only)
                   : (u[1] < 0.5 ? expected.whole_only : expected.neither));
  }
  EXPECT_EQ(agreed[0].both, expected.both);
  EXPECT_EQ(agreed[0].neither, expected.neither);
  EXPECT_EQ(agreed[0].glance_only, expected.glance_only);
  EXPECT_EQ(agreed[0].whole_only, expected.whole_only);
  EXPECT_EQ(agreed[1].glance_only, 12U);
  // What whole sweeps say is no draw.
  EXPECT_EQ(robustness(options, all)[1].draws, 19U);
  KnownEvaluations without = all;
  without.erase({1, 12});
  EXPECT_FALSE(survey_is_complete(options, without));
}

TEST(Survey, PartsComputeEachEvaluationOnce) {
  ClaimsOptions options = options_of(11);
  options.survey.confirmed = 5;
  const double no_stage = draw(options.space, 5, 1)[0];
  std::size_t evaluated = 0;
  const auto of_part = [&](const KnownEvaluations& known, const store::Part& part) {
    CalibrationRun run;
    run.known = known;
    run.evaluated = [&](const EvaluatedCandidate&) { ++evaluated; };
    return survey(
        options,
        [&](const Question& q) {
          Evaluation e = decided_by_first(q.u);
          if (q.u[0] == no_stage) e.refused = "no stage";
          return e;
        },
        run, part);
  };
  const KnownEvaluations whole = of_part({}, {});
  ASSERT_EQ(whole.size(), 16U);
  // The third part alone does not know which draws are valid before its own.
  const KnownEvaluations alone = of_part({}, {3, 3});
  EXPECT_EQ(alone.size(), 3U);
  EXPECT_TRUE(share_of(options, alone, {3, 3}).complete());
  evaluated = 0;
  KnownEvaluations all;
  for (int pass = 0; pass < 2; ++pass)
    for (const std::size_t number : {2U, 3U, 1U}) all = of_part(all, {number, 3});
  EXPECT_EQ(evaluated, whole.size());
  ASSERT_EQ(all.size(), whole.size());
  for (const auto& [key, c] : whole) EXPECT_EQ(all.at(key).u, c.u);
  EXPECT_TRUE(survey_is_complete(options, all));
  const SurveyShare share = share_of(options, all, {1, 3});
  EXPECT_EQ(share.draws, 4U);
  EXPECT_EQ(share.confirmed, 2U);
  EXPECT_EQ(share.confirmed_most, 2U);
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

TEST(Robustness, TellsWhichOfSeveralReadingsDecides) {
  ClaimsOptions options = options_of(300);
  const auto choice = [](const std::vector<std::string>& names) {
    Choice c{"reading", "unsaid", {}};
    for (const std::string& name : names) c.options.push_back({name, 1.0, {}});
    return c;
  };
  options.space.choices = {choice({"low", "mid", "high"})};
  KnownEvaluations all;
  for (std::size_t d = 0; d < 300; ++d) {
    EvaluatedCandidate c{{0, d}, draw(options.space, 5, d), {}};
    // The one in the middle fails; the order of the three tells nothing of that.
    const bool holds = options.space.options_at(c.u)[0] != 1;
    c.evaluation.holds = {static_cast<char>(holds), 1};
    c.evaluation.claim_costs = {holds ? 0.0 : 1.0, 0.0};
    all.emplace(c.key, c);
  }
  const std::vector<Factor> of = factors(options.space);
  ASSERT_EQ(of.size(), options.space.parameters.size() + 3);
  const auto influences = robustness(options, all)[0].influences;
  const std::size_t first = options.space.parameters.size();
  EXPECT_GT(influences[first].low, 0.2);
  EXPECT_LT(influences[first + 1].high, -0.9);
  EXPECT_GT(influences[first + 2].low, 0.2);
  options.space.choices = {choice({"one", "other"})};
  ASSERT_EQ(factors(options.space).size(), first + 1);
  EXPECT_EQ(factors(options.space).back().option, 1U);
}

TEST(Robustness, TellsWhichReadingMeetsWhat) {
  ClaimsOptions options = options_of(400);
  options.space.choices = {{"reading", "unsaid", {{"one", 1.0, {}}, {"other", 3.0, {}}}}};
  KnownEvaluations all;
  for (std::size_t d = 0; d < 400; ++d) {
    EvaluatedCandidate c{{0, d}, draw(options.space, 5, d), {}};
    c.evaluation.claim_costs = {0.0, 0.0};
    // The first claim holds with the other reading alone, the second always; draw 7 is no stage.
    c.evaluation.holds = {static_cast<char>(options.space.options_at(c.u)[0]), 1};
    if (d == 7) c.evaluation.refused = "no stage";
    all.emplace(c.key, c);
  }
  const auto by_option = robustness_by_option(options, all);
  ASSERT_EQ(by_option.size(), 2U);
  EXPECT_EQ(by_option[0].draws + by_option[1].draws, 399U);
  EXPECT_NEAR(static_cast<double>(by_option[0].draws), 100.0, 30.0);
  EXPECT_EQ(by_option[0].holds, (std::vector<std::size_t>{0, by_option[0].draws}));
  EXPECT_EQ(by_option[1].holds, (std::vector<std::size_t>{by_option[1].draws, by_option[1].draws}));
  EXPECT_LT(by_option[0].fraction[0].high, 0.06);
  EXPECT_EQ(by_option[1].fraction[1].value, 1.0);
}

TEST(Robustness, LeavesOutWhatIsNoStage) {
  const ClaimsOptions options = options_of(10);
  KnownEvaluations all = surveyed(options, 1);
  all.at({0, 3}).evaluation.refused = "no stage";
  EXPECT_EQ(robustness(options, all)[1].draws, 9U);
}

}  // namespace
}  // namespace epicyclic::claims::robustness_test
