// How many operations one right-hand side is, for the share of the machine's peak that tests/bench tells.

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "model/counted_lanes.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::operations_test {
namespace {

TEST(Operations, OfOneLaneOfThePapersStage) {
  const gear::Stage stage = problems::tang2020();
  const DynamicModel model = make_dynamic_model(stage, scales_of(stage), 2.8, {});
  ASSERT_EQ(model.dimension, 34U);
  std::vector<double> y(model.dimension);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = 3.0 * std::sin(static_cast<double>(i + 1));
  std::vector<double> f(y.size());
  const double s = model.breakpoints.empty() ? 0.3 : model.breakpoints[0] + 0.01;
  const Operations n = operations_of_lane(model, 0, s, y.data(), f.data());
  // What is counted is the right-hand side: equal to the stage's kernel but for rounding of sine, cosine and tables.
  std::vector<double> expected(y.size());
  model.right_hand_side(0, s, y.data(), expected.data());
  constexpr double rounding = 1e-13;  // of some 700 operations
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(f[i], expected[i], rounding * (1.0 + std::abs(expected[i])));
  // 5 % about the count on which the share in validation/integrators rests: equations that change move it.
  EXPECT_GE(n.arithmetic(), 660);
  EXPECT_LE(n.arithmetic(), 730);
  // No branch depends on the state: the same at another place.
  for (double& x : y) x = 0.1 - x;
  const Operations elsewhere = operations_of_lane(model, 0, s, y.data(), f.data());
  EXPECT_EQ(n.arithmetic(), elsewhere.arithmetic());
  EXPECT_EQ(n.selections, elsewhere.selections);
  RecordProperty("arithmetic", std::to_string(n.arithmetic()));
  RecordProperty("additions", std::to_string(n.additions));
  RecordProperty("multiplications", std::to_string(n.multiplications));
  RecordProperty("divisions", std::to_string(n.divisions));
  RecordProperty("comparisons", std::to_string(n.comparisons));
  RecordProperty("selections", std::to_string(n.selections));
}

}  // namespace
}  // namespace epicyclic::model::operations_test
