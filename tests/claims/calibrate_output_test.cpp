#include "claims/calibrate_output.hpp"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace epicyclic::claims::calibrate_output_test {
namespace {

using namespace studies;

Evaluation evaluation(double cost, std::vector<char> holds) {
  Evaluation e;
  e.cost = cost;
  e.claim_costs = std::vector<double>(holds.size(), 0.0);
  e.holds = std::move(holds);
  return e;
}

/// Two claims and one parameter from 0 to 4, the result at 2; costs at 0, 1, 2, 3, 4 and which claims are met there.
struct Search {
  CalibrateOutput output;
  Calibration found;

  explicit Search(const std::vector<Evaluation>& along) {
    output.name = "search";
    output.options.claims = {{"A", "a", "", "", 1.0, {}}, {"B", "b", "", "", 1.0, {}}};
    output.options.space.parameters = {{"x", "", "", 0.0, 4.0, ParameterScale::linear, {}, "", ""}};
    for (std::size_t k = 0; k < along.size(); ++k)
      found.profile.push_back({0, 0.25 * static_cast<double>(k), along[k]});
    found.best = EvaluatedCandidate{{0, 1}, {0.5}, along[2]};
    found.complete = true;
  }

  [[nodiscard]] std::string summary() const { return calibrate_summary(output, found); }
};

TEST(CalibrateSummary, TellsWhereTheCostRisesLittleAndWhereNoClaimIsLost) {
  // At 1 the claim A just fails, and costs a tenth; at 4 it costs all, though B, which the result fails, is met.
  const Search search({evaluation(2.0, {0, 0}), evaluation(1.1, {0, 0}), evaluation(1.0, {1, 0}),
                       evaluation(1.0, {1, 0}), evaluation(1.0, {0, 1})});
  const std::string text = search.summary();
  EXPECT_NE(text.find("| x | 0 to 4 | 2 | 1 to 4 | 2 to 3 |"), std::string::npos) << text;
  EXPECT_EQ(text.find("Not the least cost"), std::string::npos) << text;
}

TEST(CalibrateSummary, TellsOfABetterCandidateOfTheProfile) {
  Search search({evaluation(2.0, {0, 0}), evaluation(1.1, {1, 0}), evaluation(1.0, {1, 0}), evaluation(0.0, {1, 1}),
                 evaluation(1.5, {0, 0})});
  EXPECT_NE(search.summary().find("with x = 3 and all other values unchanged the profile has cost 0, and 2 claims"),
            std::string::npos)
      << search.summary();
  // Whole sweeps chose the result, not its cost.
  search.found.confirmed = {{*search.found.best, evaluation(0.0, {1, 1})}};
  EXPECT_EQ(search.summary().find("Not the least cost"), std::string::npos) << search.summary();
  // One that is no stage all along chose nothing, and has no verdicts.
  search.found.confirmed.front().whole.refused = "pointed teeth";
  const std::string none = search.summary();
  EXPECT_NE(none.find("no valid stage all along: pointed teeth"), std::string::npos) << none;
  EXPECT_EQ(none.find("by whole sweeps, "), std::string::npos) << none;
}

}  // namespace
}  // namespace epicyclic::claims::calibrate_output_test
