// Grid, chains and bookkeeping of sweeps.

#include "studies/sweep.hpp"

#include <functional>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "studies/coarse_pass.hpp"

namespace epicyclic::studies::sweep_test {
namespace {

TEST(SweepPlan, GridHasBothEndsAndReadableValues) {
  SweepOptions o;
  o.axis.from = 0.2;
  o.axis.to = 3.5;
  o.axis.points = 661;
  const SweepPlan plan = plan_sweep(o);
  EXPECT_EQ(plan.points.front().value, 0.2);
  EXPECT_EQ(plan.points.back().value, 3.5);
  EXPECT_EQ(plan.points[180].value, 1.1);
  for (std::size_t k = 1; k < plan.points.size(); ++k) EXPECT_LT(plan.points[k - 1].value, plan.points[k].value);
}

TEST(SweepPlan, DownIsUpReversedAndNumberedAfterIt) {
  SweepOptions o;
  o.axis.points = 11;
  o.directions = {Direction::up, Direction::down};
  const SweepPlan plan = plan_sweep(o);
  ASSERT_EQ(plan.points.size(), 22U);
  for (std::size_t k = 0; k < 11; ++k) {
    EXPECT_EQ(plan.points[k].value, plan.points[21 - k].value);
    EXPECT_EQ(plan.points[11 + k].direction, Direction::down);
    EXPECT_EQ(plan.points[11 + k].index, 11 + k);
  }
}

TEST(SweepPlan, ChainsHoldEachPointOnce) {
  for (const Start start : {Start::continued, Start::cold})
    for (const int segments : {1, 3, 7}) {
      SweepOptions o;
      o.axis.points = 20;
      o.directions = {Direction::down, Direction::up};
      o.start = start;
      o.segments = segments;
      const SweepPlan plan = plan_sweep(o);
      EXPECT_EQ(plan.chains.size(), start == Start::cold ? 40U : static_cast<std::size_t>(2 * segments));
      std::set<std::size_t> seen;
      for (const auto& chain : plan.chains)
        for (const std::size_t index : chain) EXPECT_TRUE(seen.insert(index).second);
      EXPECT_EQ(seen.size(), 40U);
    }
}

/// A damped linear oscillator that plays the role of a stage of two planets: delta_1 = x, delta_2 = -x.
model::DynamicModel oscillator(double value) {
  model::DynamicModel m;
  m.planets = 2;
  m.dimension = 2;
  m.state_names = {"x", "x_rate"};
  m.sun_planet_half_gap = 0.5;
  m.ring_planet_half_gap = 0.5;
  m.omega = 1.0;
  m.right_hand_side = [value](std::size_t, double s, const double* y, double* f) {
    f[0] = y[1];
    f[1] = -y[0] - 0.4 * y[1] + value * std::cos(s);
  };
  m.deflections = [](double, const double* y, model::MeshDeflections& d) {
    d.sun_planet = d.ring_planet = {y[0], -y[0]};
    d.sun_planet_rate = d.ring_planet_rate = {y[1], -y[1]};
  };
  m.default_start = {0.0, 0.0};
  return m;
}

SweepOptions few_points() {
  SweepOptions o;
  o.axis.from = 0.1;
  o.axis.to = 0.4;
  o.axis.points = 4;
  o.recording.transient_periods = 40;
  o.recording.recorded_periods = 8;
  o.recording.period_max = 4;
  return o;
}

TEST(Sweep, RecordsExtremaContactAndPeriodOfAKnownResponse) {
  // At resonance with damping 0.4 the amplitude is value / 0.4; the phases of the dense output hit the extrema of sin
  // s.
  constexpr double settled = 1e-6;  // exp(-0.2 * 2 pi * 40) of the transient and the tolerance of the integrator
  const SweepOptions o = few_points();
  const auto results = run_sweep_in_memory(plan_sweep(o), o.recording, {}, oscillator, {});
  ASSERT_EQ(results.size(), 4U);
  for (const PointResult& r : results) {
    const double amplitude = r.point.value / 0.4;
    EXPECT_EQ(r.recurrence.period, 1);
    EXPECT_NEAR(r.meshes.sun_planet[0].delta.largest, amplitude, settled);
    EXPECT_NEAR(r.meshes.sun_planet[1].delta.least, -amplitude, settled);
    EXPECT_NEAR(r.meshes.planet_spread, 2.0 * amplitude, 2.0 * settled);
    EXPECT_EQ(r.meshes.sun_planet[0].contact(), amplitude > 0.5 ? "drive+loss+back" : "loss") << amplitude;
    EXPECT_EQ(r.poincare_rows(), 8U);
    EXPECT_GT(r.rhs_evaluations, 1000);
  }
}

/// A double well with a static load: two equilibria coexist for |value| < 2 / (3 sqrt 3).
model::DynamicModel wells(double value) {
  model::DynamicModel m = oscillator(value);
  m.default_start = {-1.2, 0.0};
  m.right_hand_side = [value](std::size_t, double, const double* y, double* f) {
    f[0] = y[1];
    f[1] = y[0] - y[0] * y[0] * y[0] + value - 0.5 * y[1];
  };
  return m;
}

TEST(Sweep, SegmentsKeepHysteresis) {
  SweepOptions o = few_points();
  o.axis.from = -0.6;
  o.axis.to = 0.6;
  o.axis.points = 61;
  o.directions = {Direction::up, Direction::down};
  const auto position = [](const PointResult& r) { return r.end_state.at(0); };
  const auto whole = run_sweep_in_memory(plan_sweep(o), o.recording, {}, wells, {});
  o.segments = 6;
  const auto parts = run_sweep_in_memory(plan_sweep(o), o.recording, {}, wells, {});
  ASSERT_EQ(parts.size(), 122U);
  // Until both jumps both branches are there, and each direction keeps to its own. Measured: what the transient of 40
  // periods leaves near the jumps, where it is slow.
  constexpr double transient = 1e-7;
  int two_branches = 0;
  for (std::size_t k = 0; k < 122; ++k) EXPECT_NEAR(position(parts[k]), position(whole[k]), transient) << k;
  for (std::size_t k = 0; k < 61; ++k) two_branches += position(parts[121 - k]) - position(parts[k]) > 1.0 ? 1 : 0;
  EXPECT_GT(two_branches, 30);
  EXPECT_LT(two_branches, 61);
  // Cold segments would not: their first point is on the branch of the default start.
  o.start = Start::cold;
  const auto cold = run_sweep_in_memory(plan_sweep(o), o.recording, {}, wells, {});
  EXPECT_GT(position(parts[91]) - position(cold[91]), 1.0);
  // Threads, and points that are known, change nothing.
  o.start = Start::continued;
  SweepRun threads;
  threads.threads = 3;
  std::map<std::size_t, PointResult> done;
  for (const std::size_t k : {0U, 1U, 12U, 30U, 31U, 61U, 90U}) done.emplace(k, parts[k]);
  const auto again = run_sweep_in_memory(plan_sweep(o), o.recording, {}, wells, std::move(threads), std::move(done));
  for (std::size_t k = 0; k < 122; ++k) EXPECT_EQ(again[k].poincare, parts[k].poincare) << k;
}

TEST(CoarsePass, WhoAsksForWhatIsKnownLeavesItToTheOneWhoCarriesIt) {
  SweepOptions o = few_points();
  o.axis.points = 64;
  o.segments = 8;
  const SweepPlan plan = plan_sweep(o);
  const integrate::IntegratorOptions integrator;
  int carried = 0;
  const ModelAtPoint model_at = [&](const GridPoint& p) {
    ++carried;
    return oscillator(p.value);
  };
  const auto nobody_waits = [](const std::function<bool()>&) { ADD_FAILURE() << "nobody else carries the pass"; };
  const auto always = [] { return true; };
  CoarsePass alone(plan, integrator, model_at);
  const std::vector<double> start = alone.start_of(32, always, integrate::make_flow, nobody_waits);
  EXPECT_EQ(std::exchange(carried, 0), 32);

  // While one carries the pass from 8 to 32, another asks for 8 and a third for 24.
  CoarsePass pass(plan, integrator, model_at);
  (void)pass.start_of(8, always, integrate::make_flow, nobody_waits);
  bool asked = false;
  int waited = 0;
  const auto meanwhile = [&] {
    if (std::exchange(asked, true)) return true;
    EXPECT_FALSE(pass.start_of(8, always, integrate::make_flow, nobody_waits).empty());
    bool goes_on = true;
    const auto wait = [&](const std::function<bool()>& over) {
      ++waited;
      EXPECT_FALSE(over());
      goes_on = false;
    };
    EXPECT_TRUE(pass.start_of(
                        24, [&] { return goes_on; }, integrate::make_flow, wait)
                    .empty());
    return true;
  };
  EXPECT_EQ(pass.start_of(32, meanwhile, integrate::make_flow, nobody_waits), start);
  EXPECT_EQ(waited, 1);
  EXPECT_EQ(carried, 32);
}

TEST(Sweep, ThreadsAndResumptionLeaveEachNumberUnchanged) {
  SweepOptions o = few_points();
  o.directions = {Direction::up, Direction::down};
  const SweepPlan plan = plan_sweep(o);
  const auto one = run_sweep_in_memory(plan, o.recording, {}, oscillator, {});
  SweepRun resumed;
  resumed.threads = 8;
  std::set<std::size_t> computed;
  resumed.point_finished = [&](const PointResult& r) { computed.insert(r.point.index); };
  const auto two = run_sweep_in_memory(plan, o.recording, {}, oscillator, std::move(resumed),
                                       {{0, one[0]}, {1, one[1]}, {4, one[4]}});
  EXPECT_EQ(computed, (std::set<std::size_t>{2, 3, 5, 6, 7}));
  ASSERT_EQ(two.size(), one.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_EQ(one[k].poincare, two[k].poincare);
    EXPECT_EQ(one[k].end_state, two[k].end_state);
  }
}

TEST(Sweep, PointsOfAnotherSweepAreRefused) {
  const SweepOptions o = few_points();
  const auto one = run_sweep_in_memory(plan_sweep(o), o.recording, {}, oscillator, {});
  SweepOptions other = o;
  other.axis.to += 1.0;
  EXPECT_THROW((void)run_sweep_in_memory(plan_sweep(other), o.recording, {}, oscillator, {}, {{2, one[2]}}),
               InputError);
  EXPECT_THROW((void)run_sweep_in_memory(plan_sweep(o), o.recording, {}, oscillator, {}, {{1, one[2]}}), InputError);
  EXPECT_THROW((void)run_sweep_in_memory(plan_sweep(o), o.recording, {}, oscillator, {}, {{900, one[2]}}), InputError);
}

TEST(Sweep, CarriedStartIsTheEndOfThePointBefore) {
  SweepOptions o = few_points();
  o.recording.transient_periods = 0;
  o.recording.recorded_periods = 1;
  const auto carried = run_sweep_in_memory(plan_sweep(o), o.recording, {}, oscillator, {});
  o.start = Start::cold;
  const auto cold = run_sweep_in_memory(plan_sweep(o), o.recording, {}, oscillator, {});
  EXPECT_EQ(carried[0].end_state, cold[0].end_state);
  EXPECT_NE(carried[1].end_state, cold[1].end_state);
  const auto again = compute_point(plan_sweep(o).points[1], oscillator(carried[1].point.value), carried[0].end_state,
                                   o.recording, {}, [] { return true; });
  EXPECT_EQ(again.end_state, carried[1].end_state);
}

TEST(Sweep, GoesOnAfterAPointThatDiverges) {
  SweepOptions o = few_points();
  const auto unstable = [](double value) {
    model::DynamicModel m = oscillator(value);
    if (value > 0.15 && value < 0.25)
      m.right_hand_side = [](std::size_t, double, const double* y, double* f) {
        f[0] = y[1];
        f[1] = 1.0 + y[0];
      };
    return m;
  };
  const auto results = run_sweep_in_memory(plan_sweep(o), o.recording, {}, unstable, {});
  EXPECT_EQ(results[1].outcome, integrate::Outcome::diverged);
  EXPECT_FALSE(results[1].message.empty());
  EXPECT_TRUE(results[1].end_state.empty());
  EXPECT_EQ(results[2].outcome, integrate::Outcome::reached);
}

TEST(Sweep, StopsSoonAndKeepsWhatWasFinished) {
  SweepOptions o = few_points();
  std::atomic<bool> stop{false};
  SweepRun run;
  run.stop = &stop;
  run.point_finished = [&](const PointResult& r) { stop = r.point.index == 1; };
  EXPECT_EQ(run_sweep_in_memory(plan_sweep(o), o.recording, {}, oscillator, std::move(run)).size(), 2U);
}

TEST(Sweep, ExceptionOfAPointArrivesUnchanged) {
  const SweepOptions o = few_points();
  const auto throwing = [](double value) -> model::DynamicModel {
    if (value > 0.25) throw std::domain_error("no such point");
    return oscillator(value);
  };
  EXPECT_THROW((void)run_sweep_in_memory(plan_sweep(o), o.recording, {}, throwing, {}), std::domain_error);
}

}  // namespace
}  // namespace epicyclic::studies::sweep_test
