#include "claims/kind.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "claims/inputs.hpp"
#include "input/study_model.hpp"

namespace epicyclic::claims::kind_test {
namespace {

const bool added = (input::add_kind(claims_kind()), true);

TEST(ClaimsKind, ReadsWhatItWrites) {
  ASSERT_TRUE(added);
  const input::LoadedInput input = input::load_input("validation/tang2020/claims.json");
  EXPECT_EQ(input.study.kind(), "claims");
  EXPECT_FALSE(input.study.has_points());
  EXPECT_EQ(claims_in(input.study).claims.size(), 18U);
  const nlohmann::json written = input::study_table().write(input.study)["study"];
  EXPECT_EQ(written["kind"], "claims");
  EXPECT_EQ(written["claims"].size(), 18U);
  input::ReadContext context;
  input::Study again;
  input::study_table().read(input.resolved, "", again, context);
  EXPECT_TRUE(context.findings.empty());
  EXPECT_EQ(input::study_table().write(again)["study"], written);
}

TEST(ClaimsKind, SetsTheLookAtPointsByTheKeysOfAllKinds) {
  const nlohmann::json whole = {{"study", {{"kind", "claims"}, {"transient_periods", 7}}}};
  input::ReadContext context;
  input::Study study;
  input::study_table().read(whole, "", study, context);
  EXPECT_EQ(claims_in(study).recording.transient_periods, 7);
  EXPECT_EQ(input::study_table().write(study)["study"]["transient"], "fixed");
}

TEST(ClaimsKind, ASweepByThePointerOfTheSpeedIsOneOfTheSpeed) {
  const input::LoadedInput input = input::load_input(
      "validation/tang2020/claims.json",
      input::parse_assignments(std::vector<std::string>{"/study/sweeps/0/parameter=/operation/mesh_frequency_ratio"}));
  EXPECT_EQ(claims_in(input.study).sweeps.front().axis.name, studies::speed_parameter);
}

/// A study of frequencies needs no load and no damping.
TEST(ClaimsKind, OfFrequenciesAloneTakesAStageForModes) {
  const input::LoadedInput input = input::load_input("validation/linparker1999_modes/claims.json");
  EXPECT_FALSE(input.study.integrates());
  const ClaimsOptions& options = claims_in(input.study);
  ASSERT_EQ(options.stages.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<ClaimMode> modes = modes_of(input, options.stages[k]);
    int count = 0;
    for (const ClaimMode& mode : modes) count += mode.multiplicity;
    EXPECT_EQ(count, 9 + 3 * (3 + static_cast<int>(k)));
    EXPECT_EQ(modes.front().frequency_Hz, 0.0);
  }
}

TEST(ClaimsKind, RefusesOfAPairWhatPairsDoNotHave) {
  const auto refused = [](const std::string& set) {
    try {
      (void)input::load_input("validation/kahramansingh1990_clearance/claims.json",
                              input::parse_assignments(std::vector<std::string>{set}));
    } catch (const input::InputProblems& wrong) {
      return wrong.problems().front().pointer;
    }
    return std::string("nowhere");
  };
  EXPECT_EQ(refused("/name=other"), "nowhere");
  EXPECT_EQ(refused("/study/claims/0/conditions/0/quantity=k_gamma_sp"), "/study/claims/0/conditions/0/quantity");
  EXPECT_EQ(refused("/study/claims/0/conditions/0/quantity=delta_rp_h1"), "/study/claims/0/conditions/0/quantity");
  EXPECT_EQ(refused("/study/figures/0/panels/0/quantity=load_sharing_max"), "/study/figures/0/panels/0/quantity");
}

}  // namespace
}  // namespace epicyclic::claims::kind_test
