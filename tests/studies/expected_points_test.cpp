#include "studies/expected_points.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace epicyclic::studies::expected_points_test {
namespace {

constexpr double reach = 1e-3;
constexpr double bound = 1e-8;

LocatedPoint flip(double value, double error = bound) { return {"flip", 1, value, error, {}, {}}; }

std::vector<PointVerdict> verdicts(const std::vector<LocatedPoint>& expected, const std::vector<LocatedPoint>& found) {
  std::vector<PointVerdict> all;
  for (const PointComparison& c : compare_points(expected, found, reach)) all.push_back(c.verdict);
  return all;
}

using enum PointVerdict;

TEST(ExpectedPoints, AgreeWithinTheirOwnBounds) {
  EXPECT_EQ(verdicts({flip(2.0)}, {flip(2.0 + 0.9 * bound)}), std::vector{agrees});
  EXPECT_EQ(verdicts({flip(2.0)}, {flip(2.0 + 1.1 * bound)}), std::vector{differs});
  EXPECT_EQ(verdicts({flip(2.0)}, {flip(2.0 - 1.1 * bound, 0.0)}), std::vector{differs});
}

TEST(ExpectedPoints, MayBeAsFarOffAsTheirBoundsSay) {
  EXPECT_EQ(verdicts({flip(2.0, 5.0 * reach)}, {flip(2.0 + 4.0 * reach)}), std::vector{agrees});
}

TEST(ExpectedPoints, ThatAreFarLessCertainSayNothing) {
  EXPECT_EQ(verdicts({flip(2.0)}, {flip(2.0, 9.0 * bound)}), std::vector{agrees});
  EXPECT_EQ(verdicts({flip(2.0)}, {flip(2.0, 11.0 * bound)}), std::vector{too_uncertain});
  EXPECT_EQ(verdicts({flip(2.0)}, {flip(2.0, std::numeric_limits<double>::quiet_NaN())}), std::vector{too_uncertain});
}

TEST(ExpectedPoints, AreMissingOrAdditional) {
  EXPECT_EQ(verdicts({flip(1.0), flip(2.0)}, {flip(2.0), flip(3.0)}), (std::vector{missing, agrees, additional}));
  EXPECT_EQ(verdicts({flip(2.0)}, {flip(2.0 + 1.1 * reach)}), (std::vector{missing, additional}));
  EXPECT_TRUE(verdicts({}, {}).empty());
}

TEST(ExpectedPoints, AreOneIfAllThatTellsThemApartIsTheSame) {
  const LocatedPoint expected = {"grazing", 2, 1.5, bound, "sp_1:loss", "symmetry index 1 of 3"};
  std::vector<LocatedPoint> others(4, expected);
  others[0].kind = "fold";
  others[1].period = 4;
  others[2].contact = "sp_1:back";
  others[3].broken_symmetry = "";
  for (const LocatedPoint& other : others) EXPECT_EQ(verdicts({expected}, {other}), (std::vector{missing, additional}));
}

TEST(ExpectedPoints, ArePairedWithTheNearestOnes) {
  // Two flips that are nearer to one another than `reach`: each has its own.
  const std::vector<LocatedPoint> expected = {flip(2.0), flip(2.0003)};
  EXPECT_EQ(verdicts(expected, {flip(2.0003), flip(2.0)}), (std::vector{agrees, agrees}));
  EXPECT_EQ(verdicts(expected, {flip(2.0003)}), (std::vector{missing, agrees}));
  EXPECT_EQ(verdicts(expected, {flip(2.0), flip(2.0001), flip(2.0003)}), (std::vector{agrees, additional, agrees}));
}

}  // namespace
}  // namespace epicyclic::studies::expected_points_test
