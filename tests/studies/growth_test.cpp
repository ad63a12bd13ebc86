#include "studies/growth.hpp"

#include <map>

#include <gtest/gtest.h>

namespace epicyclic::studies::growth_test {
namespace {

SweepOptions sweep(double from, double to, int points, int segments,
                   std::vector<Direction> directions = {Direction::up}, Start start = Start::continued) {
  SweepOptions o;
  o.axis = {"mesh_frequency_ratio", from, to, points};
  o.directions = std::move(directions);
  o.segments = segments;
  o.start = start;
  return o;
}

std::map<std::size_t, std::size_t> common(const SweepPlan& there, const SweepPlan& here) {
  std::map<std::size_t, std::size_t> of;
  const std::size_t count = points_in_common(there, here, [&](std::size_t a, std::size_t b) {
    const GridPoint p = there.points[a];
    const GridPoint q = here.points[b];
    EXPECT_EQ(p.value, q.value);
    EXPECT_EQ(p.second_value, q.second_value);
    EXPECT_EQ(p.direction, q.direction);
    EXPECT_TRUE(of.emplace(b, a).second);
  });
  EXPECT_EQ(of.size(), count);
  return of;
}

TEST(Growth, ColdPointsAreThoseOfTheSameValues) {
  const auto cold = [](double from, double to, int points) {
    return plan_sweep(sweep(from, to, points, 0, {Direction::up}, Start::cold));
  };
  // Twice as dense, and wider on both sides.
  const auto same = common(cold(1, 2, 11), cold(0.5, 2.5, 41));
  EXPECT_EQ(same.size(), 11U);
  EXPECT_EQ(same.at(10), 0U);  // 1
  EXPECT_EQ(same.at(12), 1U);  // 1.1
  EXPECT_EQ(common(cold(1, 2, 11), cold(1.05, 1.95, 10)).size(), 0U);
}

TEST(Growth, ACarriedChainIsLengthenedAtItsEnd) {
  using enum Direction;
  const auto chain = [](double from, double to, int points, std::vector<Direction> directions) {
    return plan_sweep(sweep(from, to, points, 1, std::move(directions)));
  };
  EXPECT_EQ(common(chain(1, 2, 11, {up}), chain(1, 3, 21, {up})).size(), 11U);
  EXPECT_EQ(common(chain(1, 2, 11, {up}), chain(0.5, 2, 16, {up})).size(), 0U);
  EXPECT_EQ(common(chain(1, 2, 11, {down}), chain(0.5, 2, 16, {down})).size(), 11U);
  EXPECT_EQ(common(chain(1, 2, 11, {down}), chain(1, 3, 21, {down})).size(), 0U);
  // Between the old points it has come another way: the first point alone is the same.
  EXPECT_EQ(common(chain(1, 2, 11, {up}), chain(1, 2, 21, {up})).size(), 1U);
  // Another direction beside it, before or behind.
  const auto both = common(chain(1, 2, 11, {up}), chain(1, 2, 11, {down, up}));
  EXPECT_EQ(both.size(), 11U);
  EXPECT_EQ(both.at(11), 0U);
  // Shorter: what is left.
  EXPECT_EQ(common(chain(1, 3, 21, {up}), chain(1, 2, 11, {up})).size(), 11U);
}

TEST(Growth, SegmentsHaveToBeginAtTheSamePlaces) {
  const auto cut = [](double from, double to, int points, int segments) {
    return plan_sweep(sweep(from, to, points, segments));
  };
  // Of 4 points each.
  EXPECT_EQ(common(cut(0, 11, 12, 3), cut(0, 15, 16, 4)).size(), 12U);
  // Of 4 and of 6: the first of them are alike as far as the shorter goes.
  EXPECT_EQ(common(cut(0, 11, 12, 3), cut(0, 11, 12, 2)).size(), 4U);
  // One chain goes through where segments begin.
  EXPECT_EQ(common(cut(0, 11, 12, 1), cut(0, 11, 12, 3)).size(), 4U);
  // The coarse pass has come another way.
  EXPECT_EQ(common(cut(0, 11, 12, 3), cut(-4, 11, 16, 4)).size(), 0U);
  SweepOptions longer = sweep(0, 15, 16, 4);
  longer.coarse_periods += 1;
  EXPECT_EQ(common(cut(0, 11, 12, 3), plan_sweep(longer)).size(), 4U);
}

TEST(Growth, LinesOfAMapAreGrownEachByItself) {
  MapOptions small;
  small.plane.first = {"mesh_frequency_ratio", 1, 2, 3};
  small.plane.second = {"damping_ratio", 0.1, 0.2, 2};
  MapOptions large = small;
  large.plane.first = {"mesh_frequency_ratio", 1, 3, 5};
  large.plane.second = {"damping_ratio", 0.05, 0.2, 4};
  const auto same = common(plan_map(small), plan_map(large));
  EXPECT_EQ(same.size(), 6U);
  EXPECT_EQ(same.at(5), 0U);  // second line: 0.1
  BasinsOptions cells;
  cells.plane.first = {"x_s", -1, 1, 3};
  cells.plane.second = {"y_s", -1, 1, 3};
  BasinsOptions denser = cells;
  denser.plane.first.points = denser.plane.second.points = 5;
  EXPECT_EQ(common(plan_basins(cells), plan_basins(denser)).size(), 9U);
}

}  // namespace
}  // namespace epicyclic::studies::growth_test
