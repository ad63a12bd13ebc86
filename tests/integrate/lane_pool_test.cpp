#include "integrate/lanes/lane_pool.hpp"

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "integrate/lanes/lane_ensemble.hpp"
#include "integrate/make_flow.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::integrate::lane_pool_test {
namespace {

constexpr int periods = 5;

IntegratorOptions options() {
  IntegratorOptions o;
  o.method = "lanes-cash-karp";
  return o;
}

LaneField two_numbers(std::size_t vectors) {
  if (vectors > 0) return {};
  return one_by_one(step_loops().width, 2);
}

std::vector<VectorField> systems(std::size_t count) {
  std::vector<VectorField> all;
  for (std::size_t k = 0; k < count; ++k)
    all.push_back(problems::duffing(0.15, -1.0, 0.2 + 0.01 * static_cast<double>(k), 1.0));
  return all;
}

std::vector<double> carried(Flow& flow, int count = periods) {
  std::vector<double> state{0.3, 0.1};
  for (int k = 0; k < count; ++k) EXPECT_TRUE(flow.evolve(state, 0.0, flow.field().period).reached());
  return state;
}

std::vector<double> carried_alone(const VectorField& system, double tolerance) {
  IntegratorOptions o = options();
  o.relative_tolerance = tolerance;
  LaneEnsemble lanes(two_numbers(0), o);
  std::vector<double> state{0.3, 0.1};
  lanes.load(0, system);
  for (int k = 0; k < periods; ++k) {
    lanes.begin(0, state, 0.0, system.period);
    lanes.run();
    lanes.copy_state(0, state);
  }
  return state;
}

TEST(LanePools, CarryEachMotionAsALaneAloneDoes) {
  LanePool pool(two_numbers, options());
  const std::vector<VectorField> all = systems(5 * pool.width());
  std::vector<std::vector<double>> ends(all.size());
  // Tolerances of their own, and more motions than lanes.
  const auto tolerance = [](std::size_t k) { return k % 3 == 0 ? 1e-5 : 1e-9; };
  std::size_t next = 0;
  pool.run(2 * pool.width(), [&] {
    while (next < all.size()) {
      const std::size_t k = next++;
      IntegratorOptions o = options();
      o.relative_tolerance = tolerance(k);
      const auto flow = pool.make_flow(all[k], o);
      ends[k] = carried(*flow);
      EXPECT_GT(flow->right_hand_side_calls(), 0);
    }
  });
  for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(ends[k], carried_alone(all[k], tolerance(k))) << k;
  EXPECT_GT(static_cast<double>(pool.taken()), 0.8 * static_cast<double>(pool.room()));
  // Without fibers too.
  IntegratorOptions o = options();
  o.relative_tolerance = tolerance(1);
  EXPECT_EQ(carried(*pool.make_flow(all[1], o)), ends[1]);
}

TEST(LanePools, AreLeftByAllWhenOneFails) {
  LanePool pool(two_numbers, options());
  const VectorField system = systems(1).front();
  std::size_t begun = 0;
  std::size_t ended = 0;
  EXPECT_THROW(pool.run(pool.width() + 2,
                        [&] {
                          const std::size_t k = begun++;
                          const auto flow = pool.make_flow(system, options());
                          carried(*flow, k == 1 ? 2 : 1000);
                          if (k == 1) throw DomainError("no more");
                          ++ended;
                        }),
               DomainError);
  EXPECT_EQ(begun, pool.width() + 2);
  EXPECT_EQ(ended, 0U);
  EXPECT_EQ(carried(*pool.make_flow(system, options())), carried_alone(system, options().relative_tolerance));
}

TEST(LanePools, LeaveWhatDoesNotFitToItself) {
  LanePool pool(two_numbers, options());
  const VectorField other = problems::lorenz();
  const auto flow = pool.make_flow(other, options());
  std::vector<double> state{1.0, 1.0, 1.0};
  ASSERT_TRUE(flow->evolve(state, 0.0, 0.5).reached());
  IntegratorOptions twin = options();
  twin.method = "arkode-cash-karp";
  const auto alone = make_flow(other, twin);
  std::vector<double> expected{1.0, 1.0, 1.0};
  ASSERT_TRUE(alone->evolve(expected, 0.0, 0.5).reached());
  EXPECT_EQ(state, expected);
  EXPECT_EQ(flow->work().steps, alone->work().steps);
}

TEST(LanePools, GoOnWhileOneWaitsForAnotherThread) {
  LanePool pool(two_numbers, options());
  const VectorField system = systems(1).front();
  std::atomic<bool> there{false};
  std::size_t begun = 0;
  std::vector<std::size_t> order;
  std::thread other;
  pool.run(2, [&] {
    const std::size_t k = begun++;
    if (k == 0) {
      pool.wait([&] { return there.load(); });
    } else {
      carried(*pool.make_flow(system, options()));
      other = std::thread([&] { there = true; });
    }
    order.push_back(k);
  });
  other.join();
  EXPECT_EQ(order, (std::vector<std::size_t>{1, 0}));
}

}  // namespace
}  // namespace epicyclic::integrate::lane_pool_test
