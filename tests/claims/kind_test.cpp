#include "claims/kind.hpp"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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

}  // namespace
}  // namespace epicyclic::claims::kind_test
