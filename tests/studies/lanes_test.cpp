// The stage in lanes: its own kernel against the right-hand sides one by one, and against ARKODE.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/largest_difference.hpp"
#include "integrate/lanes/lane_ensemble.hpp"
#include "integrate/lanes/lane_pool.hpp"
#include "integrate/sundials/arkode_flow.hpp"
#include "model/kernels/lane_kernel.hpp"
#include "model/lane_field.hpp"
#include "problems/gear_flow.hpp"
#include "problems/known_systems.hpp"
#include "problems/lane_sets.hpp"
#include "problems/r1.hpp"
#include "studies/crosscheck.hpp"
#include "studies/stage_lanes.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies::lanes_test {
namespace {

constexpr double period = 2.0 * std::numbers::pi;

/// Friction, gaps, unequal planets: breakpoints at places of their own for each speed.
model::DynamicModel model_at(double omega, model::CoordinateChoice choice = model::CoordinateChoice::relative) {
  const gear::Stage stage = problems::with_unequal_angles(problems::r1_nonlinear());
  return model::make_dynamic_model(stage, model::scales_of(stage), omega, {}, choice);
}

/// States after some periods at several speeds, all lanes at work.
std::vector<std::vector<double>> states(const std::vector<double>& omegas, const integrate::StepLoops& kernels,
                                        bool own_kernel, double tolerance, int periods,
                                        const char* method = "lanes-cash-karp") {
  const model::DynamicModel like = model_at(1.0);
  integrate::IntegratorOptions o = problems::tight(tolerance);
  o.method = method;
  integrate::LaneEnsemble lanes(own_kernel ? stage_lanes(like, kernels)
                                           : integrate::one_by_one(kernels.width, like.dimension, like.surfaces.count),
                                o, kernels);
  std::vector<VectorField> fields;
  std::vector<std::vector<double>> y;
  for (const double omega : omegas) {
    const model::DynamicModel m = model_at(omega);
    fields.push_back(m);
    y.push_back(m.default_start);
  }
  std::vector<std::size_t> system(lanes.width());
  std::vector<int> left(lanes.width());
  std::size_t next = 0;
  const auto start = [&](std::size_t lane) {
    if (next == fields.size()) return;
    system[lane] = next++;
    left[lane] = periods;
    lanes.load(lane, fields[system[lane]]);
    lanes.begin(lane, y[system[lane]], 0.0, period);
  };
  for (std::size_t lane = 0; lane < lanes.width(); ++lane) start(lane);
  for (std::size_t lane = lanes.run(); lane != lanes.width(); lane = lanes.run()) {
    EXPECT_TRUE(lanes.evolution(lane).reached());
    lanes.copy_state(lane, y[system[lane]]);
    if (--left[lane] > 0) {
      lanes.begin(lane, y[system[lane]], 0.0, period);
    } else {
      start(lane);
    }
  }
  return y;
}

const std::vector<double> speeds = {0.6, 0.8, 1.0, 1.2, 1.4, 1.7, 2.0, 2.5, 3.0, 3.3};

TEST(Lanes, OfTheStageGoWhereArkodeGoes) {
  // Without optimisation the stage has lanes for the baseline only, and others are one by one.
  const integrate::StepLoops& baseline = *integrate::step_loops("baseline");
  ASSERT_EQ(model::make_lane_field(model_at(1.0), baseline.name).width, baseline.width);
  constexpr double tolerance = 1e-11;
  const auto y = states(speeds, integrate::step_loops(), true, tolerance, 3);
  const auto dopri5 = states(speeds, integrate::step_loops(), true, tolerance, 3, "lanes-dopri5");
  const auto single = states(speeds, integrate::step_loops(), false, tolerance, 3);
  // Steps times the tolerance, stretched by a few periods of a motion that may be chaotic.
  constexpr double accuracy = 1e-7;
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    std::vector<double> reference = model_at(speeds[k]).default_start;
    const auto flow = integrate::make_arkode_flow(model_at(speeds[k]), problems::tight(tolerance));
    for (int n = 0; n < 3; ++n) ASSERT_TRUE(flow->evolve(reference, 0.0, period).reached());
    EXPECT_LT(largest_difference(y[k], reference), accuracy) << speeds[k];
    EXPECT_LT(largest_difference(dopri5[k], reference), accuracy) << speeds[k];
    EXPECT_LT(largest_difference(single[k], reference), accuracy) << speeds[k];
  }
}

TEST(Lanes, OfTheStageHaveTheSameBitsOnEveryInstructionSet) {
  std::vector<std::vector<double>> expected;
  int compared = -1;
  for (const integrate::StepLoops* kernels : problems::lane_sets()) {
    if (model::make_lane_field(model_at(1.0), kernels->name).width == 0) continue;
    const auto y = states(speeds, *kernels, true, 1e-8, 5);
    if (expected.empty()) expected = y;
    EXPECT_EQ(y, expected) << kernels->name << kernels->copy;
    ++compared;
  }
  if (compared == 0) GTEST_SKIP() << "this machine or build has the baseline only";
}

/// The state with some tangent vectors behind it after two periods, by lanes.
std::vector<double> pushed(const integrate::StepLoops& kernels, std::size_t vectors, double tolerance,
                           bool controlled) {
  const model::DynamicModel model = model_at(1.2);
  integrate::IntegratorOptions o = problems::tight(tolerance);
  o.method = "lanes-cash-karp";
  o.tangent_error_control = controlled;
  integrate::LanePool pool([&](std::size_t each) { return stage_lanes(model, kernels, each); }, o, kernels);
  const auto flow = pool.make_flow(model, o);
  std::vector<double> y = model.default_start;
  std::vector<double> v(vectors * y.size());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = std::sin(1.0 + static_cast<double>(i));
  for (int k = 0; k < 2; ++k) EXPECT_TRUE(flow->evolve_tangents(y, v, 0.0, period).reached());
  EXPECT_GT(flow->work().tangent_right_hand_sides, 0);
  y.insert(y.end(), v.begin(), v.end());
  return y;
}

TEST(Lanes, CarryTangentsOfTheStageWhereArkodeDoes) {
  constexpr double tolerance = 1e-11;
  const model::DynamicModel model = model_at(1.2);
  const std::size_t n = model.dimension;
  const auto by_arkode = [&](std::size_t vectors, bool controlled) {
    integrate::IntegratorOptions o = problems::tight(tolerance);
    o.tangent_error_control = controlled;
    const auto flow = integrate::make_arkode_flow(model, o);
    std::vector<double> y = model.default_start;
    std::vector<double> v(vectors * n);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = std::sin(1.0 + static_cast<double>(i));
    for (int k = 0; k < 2; ++k) EXPECT_TRUE(flow->evolve_tangents(y, v, 0.0, period).reached());
    y.insert(y.end(), v.begin(), v.end());
    return y;
  };
  for (const std::size_t vectors : {std::size_t{1}, std::size_t{3}, n}) {
    const std::vector<double> expected = by_arkode(vectors, true);
    const auto off = [&](const std::vector<double>& y) { return largest_difference(y, expected); };
    double size = 0.0;
    for (const double x : expected) size = std::max(size, std::abs(x));
    constexpr double accuracy = 1e-7;  // steps times the tolerance, stretched by a motion that may be chaotic
    EXPECT_LT(off(pushed(integrate::step_loops(), vectors, tolerance, true)), accuracy * size) << vectors;
    // Behind a kink vectors whose error does not count are off by far more, whoever carries them.
    constexpr double as_bad = 10.0;
    EXPECT_LT(off(pushed(integrate::step_loops(), vectors, tolerance, false)), as_bad * off(by_arkode(vectors, false)))
        << vectors;
  }
}

TEST(Lanes, CarryTangentsWithTheSameBitsOnEveryInstructionSet) {
  for (const bool controlled : {false, true})
    for (const std::size_t vectors : {1U, 7U, 34U}) {
      std::vector<double> expected;
      for (const integrate::StepLoops* kernels : problems::lane_sets()) {
        if (model::make_lane_field(model_at(1.0), kernels->name).width == 0) continue;
        const auto y = pushed(*kernels, vectors, 1e-8, controlled);
        if (expected.empty()) expected = y;
        EXPECT_EQ(y, expected) << kernels->name << kernels->copy << vectors;
      }
    }
}

TEST(Lanes, OfTheStageHaveCopiesOfTheirKernelsInMemoryOfTheirOwn) {
  const auto first = model::lane_kernel<4, 4>(model::Layout::relative_to_ring, "avx2", 0);
  const auto second = model::lane_kernel<4, 4>(model::Layout::relative_to_ring, "avx2", 1);
  if (first.evaluate == nullptr) GTEST_SKIP() << "this machine or build has the baseline only";
  EXPECT_NE(first.evaluate, second.evaluate);
  EXPECT_NE(first.prepare, second.prepare);
  EXPECT_NE(first.measure_contacts, second.measure_contacts);
}

/// Every second point has a bearing of another law, which cannot run beside the first.
model::DynamicModel mixed(double omega) {
  gear::Stage stage = problems::with_unequal_angles(problems::r1_nonlinear());
  if (omega > 1.5 && omega < 2.5) stage.sun_bearing.law = gear::BearingLaw::linear_radial;
  return model::make_dynamic_model(stage, model::scales_of(stage), omega, {});
}

std::vector<PointResult> swept(const SweepOptions& sweep, const char* method, int threads, const ModelAt& at,
                               std::map<std::size_t, PointResult> done = {}) {
  integrate::IntegratorOptions o = problems::tight(1e-11);
  o.method = method;
  SweepRun run;
  run.threads = threads;
  return run_sweep_in_memory(plan_sweep(sweep), sweep.recording, o, at, std::move(run), std::move(done));
}

TEST(Lanes, SweepsHaveTheSameBytesAtAnyNumberOfThreads) {
  const ModelAt at = [](double omega) { return mixed(omega); };
  for (const Start start : {Start::cold, Start::continued}) {
    SweepOptions sweep;
    sweep.axis.from = 0.6;
    sweep.axis.to = 3.4;
    sweep.axis.points = 9;
    sweep.directions = {Direction::up, Direction::down};
    sweep.start = start;
    sweep.recording.transient_periods = 6;
    sweep.recording.recorded_periods = 4;
    sweep.recording.classification_periods = 0;
    const auto expected = swept(sweep, "lanes-cash-karp", 1, at);
    ASSERT_EQ(expected.size(), 18U);
    for (const int threads : {2, 3, 8}) {
      const auto again = swept(sweep, "lanes-cash-karp", threads, at);
      ASSERT_EQ(again.size(), expected.size());
      for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_EQ(again[k].poincare, expected[k].poincare) << k;
        EXPECT_EQ(again[k].rhs_evaluations, expected[k].rhs_evaluations) << k;
        EXPECT_EQ(again[k].meshes.sun_planet[0].delta.largest, expected[k].meshes.sun_planet[0].delta.largest) << k;
      }
    }
    // What is known already is not computed again, and carries on.
    std::map<std::size_t, PointResult> done;
    for (const std::size_t k : {0U, 1U, 2U, 9U, 10U}) done.emplace(k, expected[k]);
    const auto resumed = swept(sweep, "lanes-cash-karp", 2, at, std::move(done));
    ASSERT_EQ(resumed.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_EQ(resumed[k].poincare, expected[k].poincare) << k;
    // ARKODE's motion, to the tolerance over ten periods, which a chaotic motion stretches.
    constexpr double times_the_stretching = 1e-5;
    const auto peer = swept(sweep, "arkode-dopri5", 2, at);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_EQ(expected[k].outcome, integrate::Outcome::reached);
      if (start == Start::cold) {
        EXPECT_LT(largest_difference(peer[k].poincare, expected[k].poincare), times_the_stretching) << k;
      }
    }
  }
}

TEST(Lanes, TakeStagesOfTheirStructureOnly) {
  // The set that every build has kernels of; without kernels any systems of one dimension go side by side.
  const integrate::StepLoops& kernels = *integrate::step_loops("baseline");
  const LaneField field = stage_lanes(model_at(1.0), kernels);
  EXPECT_NO_THROW(field.load(0, model_at(2.0)));
  EXPECT_THROW(field.load(0, problems::lorenz()), InputError);
  const gear::Stage other = problems::r1_nonlinear();
  const model::DynamicModel in_phase = model::make_dynamic_model(other, model::scales_of(other), 1.0, {});
  EXPECT_THROW(field.load(0, in_phase), InputError);
  // Full coordinates have no kernel: one by one.
  const model::DynamicModel full = model_at(1.0, model::CoordinateChoice::full);
  const LaneField each = stage_lanes(full, kernels);
  EXPECT_EQ(each.dimension, full.dimension);
  EXPECT_EQ(each.surfaces, full.surfaces.count);
  EXPECT_NO_THROW(each.load(0, full));
  VectorField without = full;
  without.surfaces = {};
  EXPECT_THROW(each.load(0, without), InputError);
}

TEST(SweepCheck, ByTheSweepsOwnMethodEachPointComesOutToTheLastBit) {
  // Which it does from the same start alone, and by lanes only if what is told of the motion is told in lanes too.
  const auto smoothed_model_at = [](double omega, double) { return model_at(omega); };
  for (const char* method : {"arkode-dopri5", "lanes-cash-karp"}) {
    integrate::IntegratorOptions how;
    how.method = method;
    SweepOptions sweep;
    sweep.axis = {speed_parameter, 0.9, 1.7, 5};
    sweep.recording.transient_periods = 20;
    sweep.recording.recorded_periods = 16;
    sweep.recording.classification_periods = 256;
    sweep.check.points = 3;
    sweep.check.methods = {method};
    const auto finished = run_sweep_in_memory(plan_sweep(sweep), sweep.recording, how,
                                              [](const GridPoint& p) { return model_at(p.value); }, {});
    const Crosscheck all =
        run_check_of_sweep(sweep, points_in_memory(finished), how, 0.0, smoothed_model_at, CrosscheckRun{});
    ASSERT_FALSE(all.comparisons.empty());
    for (const Comparison& c : all.comparisons) {
      const PointResult& swept = finished[c.result.point.index];
      EXPECT_EQ(c.verdict, Verdict::agree) << method << ": " << c.detail;
      EXPECT_EQ(c.result.poincare, swept.poincare) << method;
      EXPECT_EQ(c.result.orbit, swept.orbit) << method;
      EXPECT_EQ(motion_text(c.result), motion_text(swept)) << method;
      EXPECT_EQ(c.result.rhs_evaluations, swept.rhs_evaluations) << method;
    }
  }
}

}  // namespace
}  // namespace epicyclic::studies::lanes_test
