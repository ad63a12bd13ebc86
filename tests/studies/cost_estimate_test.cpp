// Miniatures of studies, by which `check` tells how long one takes.

#include "studies/cost_estimate.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace epicyclic::studies::probes_test {
namespace {

TEST(Miniature, HasFewerValuesInTheMiddleOfTheirParts) {
  SweepOptions sweep;
  sweep.axis = {speed_parameter, 0.2, 3.5, 661};
  sweep.directions = {Direction::up, Direction::down};
  const SweepPlan plan = plan_sweep(sweep);
  const SweepPlan small = in_miniature(plan, 22);
  ASSERT_EQ(small.points.size(), 22U);
  EXPECT_EQ(small.chains.size(), 22U);  // segments as far as there are points for them
  EXPECT_DOUBLE_EQ(small.points[0].value, 0.35);
  EXPECT_DOUBLE_EQ(small.points[10].value, 3.35);
  EXPECT_EQ(small.points[11].direction, Direction::down);
  EXPECT_EQ(in_miniature(plan, 1322).points.size(), 1322U);
  EXPECT_EQ(in_miniature(plan, 5000).points.size(), 1322U);
  // One chain stays one.
  sweep.segments = 1;
  EXPECT_EQ(in_miniature(plan_sweep(sweep), 22).chains.size(), 2U);
  // The least: one value in the middle, of each direction.
  const SweepPlan least = in_miniature(plan, 1);
  ASSERT_EQ(least.points.size(), 2U);
  EXPECT_DOUBLE_EQ(least.points[0].value, 1.85);
}

TEST(Miniature, OfAPlaneLeavesOutRowsAndColumns) {
  MapOptions map;
  map.plane.first = {"mesh_frequency_ratio", 2.0, 2.24, 25};
  map.plane.second = {"damping_ratio", 0.03, 0.07, 9};
  const SweepPlan plan = plan_map(map);
  const SweepPlan small = in_miniature(plan, 25);
  EXPECT_EQ(small.grid.rows(), 3U);
  EXPECT_EQ(small.grid.columns(), 8U);
  EXPECT_EQ(small.chains.size(), 3U);
  for (const GridPoint& p : small.points) {
    EXPECT_GT(p.value, 2.0);
    EXPECT_LT(p.value, 2.24);
    EXPECT_GT(p.second_value, 0.03);
    EXPECT_LT(p.second_value, 0.07);
  }
}

TEST(Miniature, GrowsWhileThereIsTime) {
  SweepOptions sweep;
  sweep.axis = {speed_parameter, 0.2, 3.5, 661};
  std::vector<std::size_t> sizes;
  const auto compute = [&](const SweepPlan& miniature, LaneUse&) {
    sizes.push_back(miniature.points.size());
    return sizes.back();
  };
  const Measured all = measure_miniatures(plan_sweep(sweep), 2, 1e3, 1, compute);
  EXPECT_EQ(sizes, (std::vector<std::size_t>{2, 8, 32, 128, 512, 661}));
  EXPECT_EQ(all.points, 661U);
  sizes.clear();
  EXPECT_EQ(measure_miniatures(plan_sweep(sweep), 2, 0.0, 1, compute).points, 2U);
}

TEST(Miniature, ThatIsStoppedLeavesTheOneBefore) {
  SweepOptions sweep;
  sweep.axis = {speed_parameter, 0.2, 3.5, 661};
  const auto finishing = [](std::size_t most) {
    return [most](const SweepPlan& miniature, LaneUse&) { return std::min(most, miniature.points.size()); };
  };
  const Measured second = measure_miniatures(plan_sweep(sweep), 2, 1e3, 1, finishing(20));
  EXPECT_EQ(second.points, 8U);
  EXPECT_EQ(second.finished, 8U);
  // Of the first one what there is.
  const Measured first = measure_miniatures(plan_sweep(sweep), 2, 1e3, 1, finishing(1));
  EXPECT_EQ(first.points, 2U);
  EXPECT_EQ(first.finished, 1U);
}

TEST(Miniature, TellsWhatAllPointsTake) {
  SweepOptions sweep;
  sweep.axis = {speed_parameter, 0.2, 3.5, 661};
  const SweepPlan plan = plan_sweep(sweep);
  EXPECT_DOUBLE_EQ(processor_seconds_of(plan, {.points = 66, .processor_seconds = 2.0}, 1), 2.0 * 661 / 66);
  // Lanes that are idle only because the miniature is small will be busy.
  const double idle = processor_seconds_of(plan, {66, 2.0, 0.35, 8}, 1);
  EXPECT_DOUBLE_EQ(idle, 0.5 * 2.0 * 661 / 66);
  // All chains there are: they stay idle.
  EXPECT_DOUBLE_EQ(processor_seconds_of(plan, {66, 2.0, 0.35, plan.chains.size()}, 1), 2.0 * 661 / 66);
}

}  // namespace
}  // namespace epicyclic::studies::probes_test
