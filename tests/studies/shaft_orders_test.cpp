// Lines beside the harmonics of the mesh, by the order of their shaft.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "studies/run.hpp"

namespace epicyclic::shaft_orders_test {
namespace {

TEST(ShaftOrders, AreNamedByTheNearestHarmonicAndTheShaft) {
  const std::vector<model::Shaft> shafts = {{"sun", 27}, {"planets", 25}};
  const auto words = [&](double frequency) { return studies::shaft_order_words(frequency, shafts, 1e-9); };
  EXPECT_EQ(words(1.0 / 27.0), "1/27 (sun)");
  EXPECT_EQ(words(28.0 / 27.0), "1 + 1/27 (sun)");
  EXPECT_EQ(words(52.0 / 27.0), "2 - 2/27 (sun)");
  EXPECT_EQ(words(26.0 / 25.0), "1 + 1/25 (planets)");
  EXPECT_EQ(words(3.0), "");
  EXPECT_EQ(words(1.5), "");
  EXPECT_EQ(words(1.0 + 1.0 / 27.0 + 1.0 / 25.0), "");
  EXPECT_EQ(studies::shaft_order_words(28.0 / 27.0, {}, 1e-9), "");
}

}  // namespace
}  // namespace epicyclic::shaft_orders_test
