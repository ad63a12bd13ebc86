#include "input/estimates.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace epicyclic::input::estimates_test {
namespace {

TEST(Estimates, AnOriginStatesItsRangeFirst) {
  const auto range = estimated_range("estimate: 1e7 to 4.5e+08, shaft and bearings");
  ASSERT_TRUE(range.has_value());
  EXPECT_EQ(range->from, 1e7);
  EXPECT_EQ(range->to, 4.5e8);
  for (const char* none : {"estimate: shaft, 1e7 to 4e8", "choice: 1e7 to 4e8", "estimate: 4e8 to 1e7", "estimate: 1e7",
                           "estimate: 1e7 or 2e7", "estimate", ""})
    EXPECT_FALSE(estimated_range(none).has_value()) << none;
}

TEST(Estimates, AreThoseOfTheLumpedStage) {
  const std::vector<std::string> sets = {
      R"(/stage/lumped/planet={"bearing_N_per_m": 3e8, "support_damping_ratio": 0.05,
          "origin": {"bearing_N_per_m": "estimate: 1e8 to 9e8, rollers", "support_damping_ratio": "estimate: usual"}})"};
  const auto values = estimated_values(load_input("inputs/tang2020_run.json", parse_assignments(sets)));
  ASSERT_EQ(values.size(), 1U);
  EXPECT_EQ(values[0].pointer, "/stage/lumped/planet/bearing_N_per_m");
  EXPECT_EQ(values[0].range.to, 9e8);
  EXPECT_TRUE(estimated_values(load_input("inputs/tang2020_run.json")).empty());
}

}  // namespace
}  // namespace epicyclic::input::estimates_test
