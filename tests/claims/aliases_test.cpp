// Old names in studies of claims [input/aliases.hpp].
#include "input/aliases.hpp"

#include <set>

#include <gtest/gtest.h>

#include "claims/kind.hpp"
#include "input/study_input.hpp"
#include "old_names.hpp"

namespace epicyclic::claims::aliases_test {
namespace {

const bool added = (input::add_kind(claims_kind()), true);

TEST(ClaimsAliases, EachOldNameWorks) {
  ASSERT_TRUE(added);
  // Statistics of a value and a spread of its own are in no condition of it.
  const input::LoadedInput input = input::load_input(
      "validation/tang2020/claims.json",
      input::parse_assignments(std::vector<std::string>{
          R"(/study/claims/0/conditions/0={"kind": "value", "sweep": "speed", "quantity": "delta_sp_rms",
             "statistic": "min", "at_least": 0.1})",
          R"(/study/claims/1/conditions/0={"kind": "value", "sweep": "speed", "quantity": "delta_sp_rms",
             "statistic": "max", "at_most": 10})"}));
  const std::set<const input::Alias*> used = test::expect_old_names_to_work({input.resolved});
  for (const input::Alias& alias : input::aliases())
    EXPECT_TRUE(alias.study != "claims" || used.contains(&alias)) << "the input has it not: " << alias.warning();
}

TEST(ClaimsAliases, WhatAnOptionSetsMayHaveOldNames) {
  const input::LoadedInput input =
      input::load_input("validation/tang2020/claims.json", input::parse_assignments(std::vector<std::string>{
                                                               R"(/study/choices=[{"name": "boundary", "options": [
               {"name": "a", "sets": [{"pointer": "/stage/boundary", "value": "literal"}]},
               {"name": "b", "sets": [{"pointer": "/stage/boundary", "value": "fixed_ring"}]}]}])",
                                                               R"(/study/parameters=[{"name": "T", "from": 10, "to": 20,
               "targets": [{"pointer": "/stage/catalogue/carrier/body/cheek_thickness_mm"}]}])"}));
  const nlohmann::json& study = input.resolved["study"];
  EXPECT_EQ(study["choices"][0]["options"][0]["sets"][0]["value"], "as_printed");
  EXPECT_EQ(study["parameters"][0]["targets"][0]["pointer"], "/stage/catalogue/carrier/body/plate_thickness_mm");
}

}  // namespace
}  // namespace epicyclic::claims::aliases_test
