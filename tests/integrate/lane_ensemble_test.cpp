#include "integrate/lanes/lane_ensemble.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/fit.hpp"
#include "integrate/methods.hpp"
#include "integrate/sundials/arkode_flow.hpp"
#include "problems/known_systems.hpp"
#include "problems/lane_sets.hpp"

namespace epicyclic::integrate::lane_ensemble_test {
namespace {

/// A state carried over `periods` periods in one lane, period by period.
std::vector<double> carried(LaneEnsemble& lanes, std::size_t lane, const VectorField& system, std::vector<double> state,
                            int periods) {
  lanes.load(lane, system);
  for (int k = 0; k < periods; ++k) {
    lanes.begin(lane, state, 0.0, system.period);
    while (lanes.run() != lane) {
    }
    lanes.copy_state(lane, state);
  }
  return state;
}

class LaneEnsembles : public testing::TestWithParam<const char*> {
 protected:
  static IntegratorOptions tolerance(double t) {
    IntegratorOptions o;
    o.method = GetParam();
    o.relative_tolerance = t;
    o.absolute_tolerance = t;
    return o;
  }
  static IntegratorOptions by_arkode(IntegratorOptions o) {
    o.method = arkode_twin(o.method);
    return o;
  }
  static LaneEnsemble ensemble_of(const StepLoops& kernels, double t, std::size_t dimension = 2) {
    return {one_by_one(kernels.width, dimension), tolerance(t), kernels};
  }
};

TEST_P(LaneEnsembles, BitsOfALaneDependOnNoOtherLane) {
  const StepLoops& kernels = step_loops();
  std::vector<VectorField> systems;
  for (int k = 0; k < 7; ++k) systems.push_back(problems::duffing(0.15, -1.0, 0.2 + 0.05 * k, 1.0));
  std::vector<std::vector<double>> alone;
  for (const VectorField& system : systems) {
    LaneEnsemble lanes = ensemble_of(kernels, 1e-8);
    alone.push_back(carried(lanes, 0, system, {0.5, 0.1}, 20));
  }
  // All at once, more systems than lanes: each goes where a lane is free.
  LaneEnsemble lanes = ensemble_of(kernels, 1e-8);
  struct Own {
    std::size_t system;
    int left;
    std::vector<double> state;
  };
  std::vector<Own> own(lanes.width());
  std::size_t next = 0;
  std::size_t finished = 0;
  const auto start = [&](std::size_t lane) {
    if (next == systems.size()) return;
    own[lane] = {next++, 20, {0.5, 0.1}};
    lanes.load(lane, systems[own[lane].system]);
    lanes.begin(lane, own[lane].state, 0.0, systems[own[lane].system].period);
  };
  for (std::size_t lane = 0; lane < lanes.width(); ++lane) start(lane);
  for (std::size_t lane = lanes.run(); lane != lanes.width(); lane = lanes.run()) {
    Own& o = own[lane];
    lanes.copy_state(lane, o.state);
    if (--o.left > 0) {
      lanes.begin(lane, o.state, 0.0, systems[o.system].period);
      continue;
    }
    EXPECT_EQ(o.state, alone[o.system]) << "system " << o.system;
    ++finished;
    start(lane);
  }
  EXPECT_EQ(finished, systems.size());
  EXPECT_GT(lanes.evaluations_in_progress(), lanes.evaluations() * lanes.width() / 2);
}

TEST_P(LaneEnsembles, BitsAreTheSameOnEveryInstructionSetAndWidth) {
  const VectorField system = problems::duffing(0.15, -1.0, 0.3, 1.0);
  const std::vector<const StepLoops*> sets = problems::lane_sets();
  if (sets.size() == 1) GTEST_SKIP() << "this machine has the baseline only";
  LaneEnsemble first = ensemble_of(*sets.front(), 1e-9);
  const std::vector<double> expected = carried(first, 1, system, {0.5, 0.1}, 10);
  for (const StepLoops* kernels : sets) {
    LaneEnsemble lanes = ensemble_of(*kernels, 1e-9);
    EXPECT_EQ(carried(lanes, kernels->width - 1, system, {0.5, 0.1}, 10), expected) << kernels->name << kernels->copy;
  }
}

TEST_P(LaneEnsembles, ErrorFallsWithTheToleranceAsThatOfArkode) {
  // One period of a smooth system: errors at tolerances 1e-6 to 1e-10 lie on a line of slope near 1.
  const VectorField system = problems::smooth_follower();
  std::vector<double> logs;
  std::vector<double> errors;
  for (int digits = 6; digits <= 10; ++digits) {
    const double t = std::pow(10.0, -digits);
    LaneEnsemble lanes = ensemble_of(step_loops(), t, 1);
    lanes.load(0, system);
    lanes.begin(0, std::array{1.0}, 0.0, 20.0);
    lanes.run();
    std::array<double, 1> y{};
    lanes.copy_state(0, y);
    ASSERT_TRUE(lanes.evolution(0).reached());
    logs.push_back(-digits);
    errors.push_back(std::log10(std::abs(y[0] - std::cos(20.0))));
    const auto flow = make_arkode_flow(system, by_arkode(tolerance(t)));
    std::vector<double> peer = {1.0};
    ASSERT_TRUE(flow->evolve(peer, 0.0, 20.0).reached());
    // The same controller: steps differ by what the first one costs.
    constexpr double first_step = 0.15;
    const auto ours = static_cast<double>(lanes.work(0).steps);
    EXPECT_NEAR(ours / static_cast<double>(flow->work().steps), 1.0, first_step) << t;
  }
  constexpr double slope_tolerance = 0.2;  // measured: 0.13 off, over four decades
  EXPECT_NEAR(fitted_slope(logs, errors), 1.0, slope_tolerance);
}

TEST_P(LaneEnsembles, LandingOnGapsSavesAttemptsAndLosesNothing) {
  // A gear pair that loses contact: its gap's flanks are kinks of the field.
  const VectorField system = problems::clearance_oscillator(0.9);
  std::vector<double> reference = {1.1, 0.0};
  IntegratorOptions exact = by_arkode(tolerance(1e-13));
  exact.locate_contacts = true;
  const auto flow = make_arkode_flow(system, exact);
  int crossings = 0;
  for (int k = 0; k < 20; ++k) {
    const double before = reference[0];
    flow->evolve(reference, 0.0, system.period);
    crossings += (before > 1.0) != (reference[0] > 1.0) ? 1 : 0;
  }
  EXPECT_GT(crossings, 0);
  struct Cost {
    double error, attempts;
  };
  const auto cost = [&](std::size_t surfaces, double t) {
    LaneEnsemble lanes(one_by_one(step_loops().width, 2, surfaces), tolerance(t));
    const std::vector<double> end = carried(lanes, 0, system, {1.1, 0.0}, 20);
    return Cost{std::hypot(end[0] - reference[0], end[1] - reference[1]), static_cast<double>(lanes.work(0).steps)};
  };
  double attempts = 0.0;
  double attempts_landing = 0.0;
  for (const double t : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
    const Cost plain = cost(0, t);
    const Cost landing = cost(2, t);
    EXPECT_LT(landing.error, plain.error) << t;
    attempts += plain.attempts;
    attempts_landing += landing.attempts;
  }
  EXPECT_LT(attempts_landing, 0.85 * attempts);
}

TEST_P(LaneEnsembles, BreakpointsAreSteppedOnto) {
  // Two periods with three jumps each, against a flow that steps onto them too.
  const VectorField system = problems::jumping(true);
  LaneEnsemble lanes = ensemble_of(step_loops(), 1e-11, 1);
  const std::size_t last = lanes.width() - 1;
  lanes.load(last, system);
  lanes.begin(last, std::array{0.5}, 0.0, 2.0);
  EXPECT_EQ(lanes.run(), last);
  std::array<double, 1> y{};
  lanes.copy_state(last, y);
  const auto flow = make_arkode_flow(system, by_arkode(tolerance(1e-13)));
  std::vector<double> reference = {0.5};
  ASSERT_TRUE(flow->evolve(reference, 0.0, 2.0).reached());
  constexpr double steps_times_tolerance = 1e-9;
  EXPECT_NEAR(y[0], reference[0], steps_times_tolerance);
  EXPECT_EQ(lanes.evolution(last).s, 2.0);
}

TEST_P(LaneEnsembles, SamplesAreSeenInOrderAndChangeNothing) {
  const VectorField system = problems::smooth_follower();
  const auto end_with = [&](int count, double* worst) {
    LaneEnsemble lanes = ensemble_of(step_loops(), 1e-8, 1);
    std::vector<double> samples;
    for (int k = 1; k <= count; ++k) samples.push_back(5.0 * k / count);
    std::size_t seen = 0;
    const Observer observer = [&](std::size_t index, double s, std::span<const double> y) {
      EXPECT_EQ(index, seen++);
      EXPECT_EQ(s, samples[index]);
      *worst = std::max(*worst, std::abs(y[0] - std::cos(s)));
    };
    lanes.load(0, system);
    lanes.begin(0, std::array{1.0}, 0.0, 5.0, samples, observer);
    lanes.run();
    EXPECT_EQ(seen, samples.size());
    std::array<double, 1> y{};
    lanes.copy_state(0, y);
    return y[0];
  };
  double worst = 0.0;
  const double without = end_with(0, &worst);
  EXPECT_EQ(end_with(97, &worst), without);
  constexpr double of_fourth_order = 1e-5;  // the cubic's h^4 / 384 of the fourth derivative, h of about a tenth
  EXPECT_LT(worst, of_fourth_order);
  EXPECT_GT(worst, 0.0);
}

TEST_P(LaneEnsembles, WhatCannotGoOnEndsWithItsOutcome) {
  VectorField growing;
  growing.dimension = 1;
  growing.right_hand_side = [](std::size_t, double, const double* y, double* f) { f[0] = 5.0 * y[0]; };
  VectorField broken = growing;
  broken.right_hand_side = [](std::size_t, double s, const double*, double* f) {
    f[0] = s > 0.5 ? std::numeric_limits<double>::quiet_NaN() : 1.0;
  };
  IntegratorOptions o = tolerance(1e-8);
  o.escape_bound = 100.0;
  o.max_steps_per_period = 500;
  LaneEnsemble lanes(one_by_one(step_loops().width, 1), o);
  VectorField quick;
  quick.dimension = 1;
  quick.right_hand_side = [](std::size_t, double s, const double*, double* f) { f[0] = std::cos(1e5 * s); };
  const auto end_of = [&](const VectorField& system) {
    lanes.load(0, system);
    lanes.begin(0, std::array{1.0}, 0.0, 2.0);
    EXPECT_EQ(lanes.run(), 0U);
    return lanes.evolution(0);
  };
  EXPECT_EQ(end_of(quick).outcome, Outcome::step_limit);
  EXPECT_EQ(end_of(broken).outcome, Outcome::failed);
  constexpr double min_step = 1e-12;  // 1e-14, and roundings of the steps before
  EXPECT_NEAR(lanes.evolution(0).s, 0.5, min_step);
  EXPECT_EQ(end_of(growing).outcome, Outcome::diverged);
  // The state is the last accepted one.
  std::array<double, 1> y{};
  lanes.copy_state(0, y);
  EXPECT_LE(y[0], 100.0);
  constexpr double times_the_condition = 1e-5;  // tolerance 1e-8 of values of up to 100, some ten steps
  EXPECT_NEAR(y[0], std::exp(5.0 * lanes.evolution(0).s), times_the_condition);
}

TEST_P(LaneEnsembles, NothingUnderWayIsSaidSo) {
  LaneEnsemble lanes = ensemble_of(step_loops(), 1e-8);
  EXPECT_EQ(lanes.run(), lanes.width());
  EXPECT_THROW(lanes.load(0, problems::smooth_follower()), InputError);
  IntegratorOptions o = tolerance(1e-8);
  o.locate_contacts = true;
  EXPECT_THROW(LaneEnsemble(one_by_one(step_loops().width, 2), o), InputError);
  EXPECT_THROW(LaneEnsemble(one_by_one(step_loops().width, 2), by_arkode(tolerance(1e-8))), InputError);
}

INSTANTIATE_TEST_SUITE_P(Each, LaneEnsembles, testing::Values("lanes-dopri5", "lanes-cash-karp"),
                         [](const auto& of) { return std::string(of.param).substr(6, 4); });

}  // namespace
}  // namespace epicyclic::integrate::lane_ensemble_test
