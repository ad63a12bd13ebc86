// Cross-check and tolerance study, on the clearance oscillator in the place of a stage: its orbits are known.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/lyapunov.hpp"
#include "integrate/make_flow.hpp"
#include "problems/clearance_exact.hpp"
#include "problems/known_systems.hpp"
#include "studies/crosscheck.hpp"
#include "studies/parallel_for.hpp"
#include "studies/tolerance.hpp"

namespace epicyclic::studies::trust_test {
namespace {

/// One "planet" whose deflection is x; the parameter is W.
model::DynamicModel oscillator(double w, double smoothing) {
  const VectorField field = problems::clearance_oscillator(w, smoothing);
  model::DynamicModel m;
  m.planets = 1;
  m.dimension = field.dimension;
  m.state_names = {"x", "x_rate"};
  m.sun_planet_half_gap = m.ring_planet_half_gap = 1.0;
  m.omega = w;
  m.right_hand_side = field.right_hand_side;
  m.tangents = field.tangents;
  m.deflections = [](double, const double* y, model::MeshDeflections& out) {
    out.sun_planet = {y[0]};
    out.ring_planet = {y[0]};
    out.sun_planet_rate = {y[1]};
    out.ring_planet_rate = {y[1]};
  };
  m.default_start = {1.1, 0.0};
  return m;
}

/// A forced system of two states in the phase s = w t, in the place of a stage.
model::DynamicModel played_by(const VectorField& field, double w, std::vector<double> start) {
  model::DynamicModel m = oscillator(1.0, 0.0);
  m.omega = w;
  m.right_hand_side = [f = field.right_hand_side, w](std::size_t k, double s, const double* y, double* d) {
    f(k, s / w, y, d);
    for (std::size_t i = 0; i < 2; ++i) d[i] /= w;
  };
  m.tangents = [f = field.tangents, w](std::size_t k, double s, const double* y, const Columns<const double>& v,
                                       double* d, const Columns<double>& dv) {
    f(k, s / w, y, v, d, dv);
    for (std::size_t i = 0; i < 2; ++i) {
      d[i] /= w;
      for (std::size_t j = 0; j < dv.count; ++j) dv.column(j)[i] /= w;
    }
  };
  m.default_start = std::move(start);
  return m;
}

/// Forced away from its own frequency: two phases that never lock, a torus.
model::DynamicModel forced_van_der_pol(double strength, double) {
  model::DynamicModel m = oscillator(1.0, 0.0);
  const VectorField field = problems::van_der_pol(0.3, strength, 1.7);
  m.right_hand_side = field.right_hand_side;
  m.tangents = field.tangents;
  m.default_start = {1.0, 0.0};
  return m;
}

SweepOptions points(double from, double to, int count) {
  SweepOptions o;
  o.axis.from = from;
  o.axis.to = to;
  o.axis.points = count;
  o.recording.transient_periods = 150;
  o.recording.recorded_periods = 32;
  o.recording.recurrence_tolerance = 1e-5;
  return o;
}

integrate::IntegratorOptions integrator(double tolerance) {
  integrate::IntegratorOptions o;
  o.relative_tolerance = tolerance;
  o.absolute_tolerance = tolerance;
  return o;
}

// ---- units --------------------------------------------------------------------------------------------------------

TEST(Units, EachIsDoneOnceOnAnyNumberOfThreads) {
  for (const int threads : {1, 2, 8}) {
    std::vector<std::atomic<int>> seen(100);
    EXPECT_TRUE(parallel_for(seen.size(), threads, nullptr, [&](std::size_t k) { ++seen[k]; }));
    for (const auto& s : seen) EXPECT_EQ(s, 1);
  }
  EXPECT_TRUE(parallel_for(0, 4, nullptr, [](std::size_t) { FAIL(); }));
}

TEST(Units, AnExceptionArrivesAndAStopIsTold) {
  for (const int threads : {1, 3})
    EXPECT_THROW(parallel_for(50, threads, nullptr,
                              [](std::size_t k) {
                                if (k == 7) throw std::runtime_error("seven");
                              }),
                 std::runtime_error);
  std::atomic<bool> stop{false};
  int done = 0;
  EXPECT_FALSE(parallel_for(10, 1, &stop, [&](std::size_t k) {
    ++done;
    stop = k == 3;
  }));
  EXPECT_EQ(done, 4);
}

// ---- cross-check --------------------------------------------------------------------------------------------------

Crosscheck check(const SweepOptions& sweep, const CrosscheckOptions& options, double tolerance, int threads = 1) {
  CrosscheckRun run;
  run.threads = threads;
  return run_crosscheck(plan_sweep(sweep), sweep.recording, options, integrator(tolerance), 0.0, oscillator, run);
}

TEST(Crosscheck, FourMethodsAgreeOnPeriodicOrbits) {
  const SweepOptions sweep = points(0.7, 1.3, 4);
  CrosscheckOptions options;
  const Crosscheck all = check(sweep, options, 1e-10);
  ASSERT_TRUE(all.complete(plan_sweep(sweep).points.size()));
  ASSERT_EQ(all.comparisons.size(), 12U);
  for (const Comparison& c : all.comparisons) {
    EXPECT_EQ(c.verdict, Verdict::agree) << c.detail;
    EXPECT_LT(c.distance, options.orbit_tolerance);
    EXPECT_EQ(regime_name(all.reference[c.point]), "period 1");
    EXPECT_EQ(regime_name(c.result), "period 1");
  }
}

TEST(Crosscheck, TheSameBytesOnAnyNumberOfThreadsAndAfterAStop) {
  const SweepOptions sweep = points(0.7, 1.3, 4);
  CrosscheckOptions options;
  options.methods = {"arkode-dopri5", "cvode-adams"};
  const Crosscheck one = check(sweep, options, 1e-8);
  const Crosscheck three = check(sweep, options, 1e-8, 3);
  // Stopped after five results, then gone on with them.
  std::atomic<bool> stop{false};
  std::map<std::pair<std::size_t, std::size_t>, PointResult> done;
  CrosscheckRun first;
  first.stop = &stop;
  first.point_finished = [&](std::size_t variant, const PointResult& r) {
    done.emplace(std::pair{variant, r.point.index}, r);
    stop = done.size() == 5;
  };
  const SweepPlan plan = plan_sweep(sweep);
  EXPECT_FALSE(run_crosscheck(plan, sweep.recording, options, integrator(1e-8), 0.0, oscillator, first)
                   .complete(plan.points.size()));
  EXPECT_EQ(done.size(), 5U);
  CrosscheckRun second;
  second.done = done;
  int computed = 0;
  second.point_finished = [&](std::size_t, const PointResult&) { ++computed; };
  const Crosscheck resumed = run_crosscheck(plan, sweep.recording, options, integrator(1e-8), 0.0, oscillator, second);
  EXPECT_EQ(computed, 3);
  for (const Crosscheck* other : {&three, &resumed}) {
    ASSERT_EQ(other->comparisons.size(), one.comparisons.size());
    for (std::size_t k = 0; k < one.comparisons.size(); ++k) {
      EXPECT_EQ(other->comparisons[k].distance, one.comparisons[k].distance);
      EXPECT_EQ(other->comparisons[k].verdict, one.comparisons[k].verdict);
      EXPECT_EQ(other->comparisons[k].result.poincare, one.comparisons[k].result.poincare);
    }
  }
}

PointResult told(std::size_t index, analysis::Regime regime, int period) {
  PointResult r;
  r.point.index = index;
  r.regime = regime;
  r.period = period;
  return r;
}

TEST(SweepCheck, TakesPointsOfEachRegimeAndPeriodWhoseStartsAreKnown) {
  using analysis::Regime;
  SweepOptions sweep = points(0.0, 1.0, 40);
  sweep.segments = 1;
  std::vector<PointResult> finished;
  for (std::size_t k = 0; k < 40; ++k) {
    const bool chaotic = k >= 34 && k < 39;
    finished.push_back(told(k,
                            chaotic   ? Regime::chaotic
                            : k == 39 ? Regime::undecided
                                      : Regime::periodic,
                            chaotic || k == 39 ? 0 : (k < 30 ? 1 : 2)));
  }
  const auto chosen = [&](int most) {
    sweep.check.points = most;
    return points_of_each_regime(sweep, points_in_memory(finished));
  };
  EXPECT_TRUE(chosen(0).empty());
  // One of each regime; of the periodic ones first of the period that most have, from the middle of its points.
  EXPECT_EQ(chosen(2), (std::vector<std::size_t>{15, 36}));
  EXPECT_EQ(chosen(4), (std::vector<std::size_t>{15, 32, 35, 37}));
  // As many as there are: not the first, whose start is no neighbour's end, nor the one that nothing is known of.
  EXPECT_EQ(chosen(1000).size(), 38U);
  EXPECT_EQ(chosen(1000).front(), 1U);
  sweep.start = Start::cold;
  EXPECT_EQ(chosen(1000).size(), 39U);
  finished[3].outcome = integrate::Outcome::diverged;
  EXPECT_EQ(chosen(1000).size(), 38U);
}

TEST(SweepCheck, ComparesWhatAPointOfTheSweepStartedFrom) {
  SweepOptions sweep = points(0.7, 1.3, 5);
  sweep.check.points = 3;
  const auto model_at = [](double w) { return oscillator(w, 0.0); };
  const auto finished = run_sweep_in_memory(plan_sweep(sweep), sweep.recording, integrator(1e-10),
                                            [&](const GridPoint& p) { return model_at(p.value); }, {});
  const Crosscheck all =
      run_check_of_sweep(sweep, points_in_memory(finished), integrator(1e-10), 0.0, oscillator, CrosscheckRun{});
  ASSERT_TRUE(all.complete(3));
  ASSERT_EQ(all.variants.size(), 3U);
  for (const Comparison& c : all.comparisons) {
    EXPECT_EQ(c.verdict, Verdict::agree) << c.detail;
    EXPECT_GT(all.reference[c.point].point.index, 0U);
  }
  // A wrong answer is not agreed with.
  auto wrong = finished;
  for (PointResult& r : wrong)
    for (double& x : r.poincare) x += 1e-3;
  const Crosscheck against =
      run_check_of_sweep(sweep, points_in_memory(wrong), integrator(1e-10), 0.0, oscillator, CrosscheckRun{});
  for (const Comparison& c : against.comparisons) EXPECT_EQ(c.verdict, Verdict::unexplained) << c.detail;
}

TEST(Crosscheck, ADifferenceOfToleranceIsExplainedAsOne) {
  SweepOptions sweep = points(0.85, 0.85, 1);
  CrosscheckOptions options;
  options.methods = {"arkode-dopri5", "cvode-bdf"};
  options.orbit_tolerance = 1e-5;
  sweep.recording.recurrence_tolerance = 1e-2;  // above the noise of a coarse integrator
  const Crosscheck all = check(sweep, options, 1e-5);
  ASSERT_EQ(all.comparisons.size(), 1U);
  EXPECT_EQ(all.comparisons[0].verdict, Verdict::tolerance) << all.comparisons[0].detail;
  EXPECT_GT(all.comparisons[0].distance, options.orbit_tolerance);
}

TEST(Crosscheck, ADifferenceOfSmoothingIsExplainedAsOne) {
  SweepOptions sweep = points(0.85, 0.85, 1);
  CrosscheckOptions options;
  options.methods = {"arkode-dopri5"};
  options.clearance_smoothings = {0.05, 1e-5};
  const Crosscheck all = check(sweep, options, 1e-10);
  ASSERT_EQ(all.comparisons.size(), 2U);
  EXPECT_EQ(all.comparisons[0].verdict, Verdict::smoothing) << all.comparisons[0].detail;
  constexpr double of_the_wide_one = 1e-4;  // measured: a hundredth of what the smoothing of 0.05 moves the orbit by
  EXPECT_GT(all.comparisons[0].distance, of_the_wide_one);
  EXPECT_EQ(all.comparisons[1].verdict, Verdict::agree) << all.comparisons[1].detail;
}

TEST(Crosscheck, ChaosThatGrowsOtherwiseIsADifference) {
  // A width that stands for the same motion three times as fast: exponents of 0.157 and 0.47.
  const auto duffing = [](double, double smoothing) {
    return smoothing > 0.1 ? played_by(problems::duffing(0.75, -9.0, 10.8, 3.0), 3.0, {3.0, 0.0})
                           : played_by(problems::duffing(0.25, -1.0, 0.4, 1.0), 1.0, {1.0, 0.0});
  };
  SweepOptions sweep = points(1.0, 1.0, 1);
  sweep.recording.recorded_periods = 512;
  CrosscheckOptions options;
  options.methods = {"arkode-dopri5"};
  options.clearance_smoothings = {0.05, 0.2};
  const Crosscheck all =
      run_crosscheck(plan_sweep(sweep), sweep.recording, options, integrator(1e-8), 0.0, duffing, CrosscheckRun{});
  ASSERT_EQ(all.comparisons.size(), 2U);
  EXPECT_EQ(all.comparisons[0].verdict, Verdict::agree) << all.comparisons[0].detail;
  EXPECT_NE(all.comparisons[0].detail.find("both chaotic"), std::string::npos) << all.comparisons[0].detail;
  EXPECT_EQ(all.comparisons[1].verdict, Verdict::smoothing) << all.comparisons[1].detail;
}

TEST(Crosscheck, TwoThatWereNotReachedDoNotAgree) {
  const SweepOptions sweep = points(0.85, 0.85, 1);
  CrosscheckOptions options;
  options.methods = {"arkode-dopri5", "cvode-bdf"};
  integrate::IntegratorOptions few = integrator(1e-10);
  few.max_steps_per_period = 10;
  const Crosscheck all =
      run_crosscheck(plan_sweep(sweep), sweep.recording, options, few, 0.0, oscillator, CrosscheckRun{});
  ASSERT_EQ(all.comparisons.size(), 1U);
  EXPECT_EQ(all.comparisons[0].verdict, Verdict::not_reached) << all.comparisons[0].detail;
}

TEST(Crosscheck, ATorusIsExplainedAsOne) {
  const SweepOptions sweep = points(0.4, 0.4, 1);
  CrosscheckOptions options;
  options.methods = {"arkode-dopri5", "cvode-adams"};
  const Crosscheck all = run_crosscheck(plan_sweep(sweep), sweep.recording, options, integrator(1e-4), 0.0,
                                        forced_van_der_pol, CrosscheckRun{});
  ASSERT_EQ(all.comparisons.size(), 1U);
  EXPECT_EQ(all.comparisons[0].verdict, Verdict::torus) << all.comparisons[0].detail;
}

TEST(Crosscheck, CoexistingMotionsAreToldFromErrors) {
  // Duffing's two wells: the reference starts in one of them; a variant so coarse that it falls into the other gives an
  // answer that both methods hold. The coarse method is played by a model that pushes it at the start.
  const auto two_wells = [](double g, double pushed) {
    return played_by(problems::duffing(0.3, -1.0, g, 1.2), 1.2, {pushed > 0.0 ? -1.0 : 1.0, 0.0});
  };
  SweepOptions sweep = points(0.2, 0.2, 1);
  CrosscheckOptions options;
  options.methods = {"arkode-dopri5"};
  options.clearance_smoothings = {0.1};
  const Crosscheck all =
      run_crosscheck(plan_sweep(sweep), sweep.recording, options, integrator(1e-9), 0.0, two_wells, CrosscheckRun{});
  ASSERT_EQ(all.comparisons.size(), 1U);
  EXPECT_EQ(all.comparisons[0].verdict, Verdict::coexisting) << all.comparisons[0].detail;
}

TEST(OrbitDistance, IsThatOfTheBestShift) {
  PointResult a;
  a.recurrence.period = 2;
  a.poincare_columns = 2;
  a.poincare = {0.0, 1.0, 5.0, 6.0};
  PointResult b = a;
  b.poincare = {5.0, 6.5, 0.0, 1.0};
  EXPECT_DOUBLE_EQ(orbit_distance(a, b, 2), 0.5);
  EXPECT_DOUBLE_EQ(orbit_distance(a, b, 1), 0.0);
  b.recurrence.period = 1;
  EXPECT_TRUE(std::isnan(orbit_distance(a, b, 2)));
}

// ---- one classification ------------------------------------------------------------------------------------------

TEST(OneClassification, WhatEachStudySaysOfAMotionIsTheSame) {
  struct Case {
    const char* motion;
    SmoothedModelAt model;
    double value;
    int transient;
  };
  const SmoothedModelAt duffing = [](double g, double) {
    return played_by(problems::duffing(0.3, -1.0, g, 1.2), 1.2, {1.0, 0.0});
  };
  // Damped so little that it is far from its orbit, and does not recur, when the record ends.
  const SmoothedModelAt slow = [](double g, double) {
    return played_by(problems::duffing(0.02, -1.0, g, 1.2), 1.2, {1.3, 0.0});
  };
  for (const Case& c : {Case{"period 1", oscillator, 0.85, 150}, Case{"period 2", duffing, 0.28, 150},
                        Case{"chaotic", duffing, 0.5, 150}, Case{"quasiperiodic", forced_van_der_pol, 0.4, 150},
                        Case{"period 1", slow, 0.01, 5}}) {
    SweepOptions sweep = points(c.value, c.value, 1);
    sweep.recording.transient_periods = c.transient;
    const SweepPlan plan = plan_sweep(sweep);
    const integrate::IntegratorOptions how = integrator(1e-8);
    const auto swept =
        run_sweep_in_memory(plan, sweep.recording, how, [&](double value) { return c.model(value, 0.0); }, {});
    ASSERT_EQ(regime_name(swept[0]), c.motion);

    CrosscheckOptions methods;
    methods.methods = {how.method, "cvode-adams"};
    const Crosscheck checked = run_crosscheck(plan, sweep.recording, methods, how, 0.0, c.model, {});
    EXPECT_EQ(regime_text(checked.reference[0]), regime_text(swept[0]));
    EXPECT_EQ(checked.reference[0].lyapunov_max().value, swept[0].lyapunov_max().value);
    EXPECT_EQ(regime_name(checked.comparisons[0].result), c.motion);

    ToleranceOptions ladder;
    ladder.methods = {how.method};
    ladder.tolerances = {1e-6};
    ladder.clearance_smoothings = {0.01};
    const TolerancePoint climbed =
        compute_tolerance_point(swept[0], sweep.recording, ladder, how, 0.0, c.model, 1, nullptr);
    EXPECT_EQ(climbed.period, swept[0].period) << climbed.note;
    EXPECT_EQ(climbed.statistics.empty(), swept[0].period > 0);
    if (climbed.period == 0) {
      EXPECT_TRUE(climbed.note.starts_with(regime_text(swept[0]))) << climbed.note;
    } else {
      EXPECT_LT(climbed.largest_multiplier, 1.0);
      constexpr double times_the_condition = 1e-6;  // tolerance 1e-8, some hundred steps
      EXPECT_NEAR(climbed.largest_multiplier, swept[0].evidence.largest_multiplier, times_the_condition);
    }
  }
}

TEST(OneClassification, ATorusWhoseExponentSeemsPositiveIsNoChaos) {
  // Over 4000 periods from here on the exponent is 7.2e-8 +- 7.1e-8, which a cross-check once called chaos.
  const SmoothedModelAt slow_torus = [](double strength, double) {
    return played_by(problems::van_der_pol(0.1, strength, 1.7), 1.0, {1.0, 0.0});
  };
  SweepOptions sweep = points(0.3, 0.3, 1);
  sweep.recording.transient_periods = 4;
  sweep.recording.recorded_periods = 16;
  CrosscheckOptions options;
  options.methods = {"arkode-dopri5", "cvode-adams"};
  const Crosscheck all =
      run_crosscheck(plan_sweep(sweep), sweep.recording, options, integrator(1e-6), 0.0, slow_torus, CrosscheckRun{});
  EXPECT_EQ(regime_name(all.reference[0]), "quasiperiodic");
  EXPECT_EQ(regime_name(all.comparisons[0].result), "quasiperiodic");
  EXPECT_EQ(all.comparisons[0].verdict, Verdict::torus) << all.comparisons[0].detail;

  std::vector<double> y = all.reference[0].end_state;
  const auto flow = integrate::make_flow(slow_torus(0.3, 0.0), integrator(1e-6));
  const auto e = analysis::largest_exponent(*flow, y, {50, 4000}, {}, [] { return true; });
  EXPECT_GT(e.per_s.low(), 0.0) << "no example any more";
}

// ---- tolerance ----------------------------------------------------------------------------------------------------

TolerancePoint study(double w, const ToleranceOptions& options, double tolerance, int threads = 1) {
  const SweepOptions sweep = points(w, w, 1);
  const auto motion = run_sweep_in_memory(plan_sweep(sweep), sweep.recording, integrator(tolerance),
                                          [](double value) { return oscillator(value, 0.0); }, {});
  return compute_tolerance_point(motion.front(), sweep.recording, options, integrator(tolerance), 0.0, oscillator,
                                 threads, nullptr);
}

TEST(Tolerance, WhereForcesJumpThereAreNoStatistics) {
  const auto jumping = [](double value, double smoothing) {
    model::DynamicModel m = oscillator(value, smoothing);
    m.jumps_at_surfaces = true;
    return m;
  };
  SweepOptions sweep = points(0.85, 0.85, 1);
  auto motion = run_sweep_in_memory(plan_sweep(sweep), sweep.recording, integrator(1e-7),
                                    [&](double value) { return jumping(value, 0.0); }, {});
  for (const auto regime : {analysis::Regime::undecided, analysis::Regime::chaotic}) {
    motion.front().regime = regime;
    const TolerancePoint p =
        compute_tolerance_point(motion.front(), sweep.recording, {}, integrator(1e-7), 0.0, jumping, 1, nullptr);
    EXPECT_TRUE(p.statistics.empty());
    EXPECT_NE(p.note.find("no statistics either"), std::string::npos) << p.note;
  }
}

TEST(Tolerance, ErrorsAndErrorBarsAreTheTrueOnes) {
  ToleranceOptions options;
  options.methods = {"arkode-dopri5", "cvode-adams"};
  options.tolerances = {1e-5, 1e-7, 1e-9};
  options.clearance_smoothings = {0.04, 0.02, 0.01, 0.005};
  const TolerancePoint p = study(0.85, options, 1e-7);
  ASSERT_EQ(p.period, 1) << p.note;
  const auto exact = problems::ClearanceExact(0.85).periods({1.1, 0.0}, 300);
  constexpr double reference = 1e-10;
  EXPECT_NEAR(p.orbit[0], exact[0], reference);
  EXPECT_NEAR(p.orbit[1], exact[1], reference);
  ASSERT_EQ(p.ladder.size(), 6U);
  for (const LadderStep& s : p.ladder) {
    EXPECT_GT(s.error, 0.0);
    EXPECT_LT(s.error, 1000.0 * s.tolerance) << s.method << s.tolerance;
    EXPECT_LT(s.orbit_error, 1e4 * s.tolerance) << s.method << s.tolerance;
    EXPECT_GT(s.work.right_hand_sides, 0);
  }
  // The extrema of the study lie within their error bars of the exact ones.
  const problems::ClearanceExact solution(0.85);
  const auto extremes_at = [&](int count) {
    std::pair<double, double> extremes{10.0, -10.0};
    for (int j = 1; j <= count; ++j) {
      const double x = solution.evolve(exact, 0.0, 2.0 * 3.14159265358979323846 * j / count)[0];
      extremes = {std::min(extremes.first, x), std::max(extremes.second, x)};
    }
    return extremes;
  };
  const int phases = 64 * extrema_refinement(oscillator(0.85, 0.0), 64);  // at which the study records
  const auto [least, most] = extremes_at(phases);
  const double bar = std::abs(p.study.meshes.sun_planet[0].delta.largest - p.reference[1]) + p.reference_error[1];
  EXPECT_LE(std::abs(p.study.meshes.sun_planet[0].delta.largest - most), bar + reference);
  EXPECT_LE(std::abs(p.reference[1] - most), p.reference_error[1] + reference);
  constexpr double times_the_condition = 1e-4;  // tolerance 1e-7, and its dense output between steps
  EXPECT_LT(bar, times_the_condition);
  // The least one falls between two of 64 uniform phases: study and reference are sampled alike.
  EXPECT_NEAR(p.reference[0], least, p.reference_error[0] + reference);
  EXPECT_GT(extremes_at(64).first - least, 10.0 * (p.reference_error[0] + reference));
  // What the recorded phases miss.
  EXPECT_NEAR(p.between_phases[1], extremes_at(finer_phases * phases).second - most, p.reference_error[1] + reference);
  EXPECT_GT(p.between_phases[1], 10.0 * p.reference_error[1]);
  // Smoothing's bias falls, and what is extrapolated is nearer to the truth than the least width.
  for (std::size_t k = 1; k < p.smoothing.size(); ++k) EXPECT_LT(p.smoothing[k].distance, p.smoothing[k - 1].distance);
  EXPECT_LT(std::abs(p.extrapolated[1] - p.reference[1]),
            0.3 * std::abs(p.smoothing.back().quantities[1] - p.reference[1]));
  EXPECT_GT(p.exponent[1], 1.0);
  EXPECT_LT(p.exponent[1], 3.0);
}

TEST(Tolerance, TheSameOnAnyNumberOfThreads) {
  ToleranceOptions options;
  options.methods = {"arkode-dopri5", "cvode-bdf"};
  options.tolerances = {1e-5, 1e-7};
  options.clearance_smoothings = {0.04, 0.02};
  const TolerancePoint one = study(0.85, options, 1e-7, 1);
  const TolerancePoint four = study(0.85, options, 1e-7, 4);
  for (std::size_t k = 0; k < one.ladder.size(); ++k) {
    EXPECT_EQ(one.ladder[k].error, four.ladder[k].error);
    EXPECT_EQ(one.ladder[k].orbit_error, four.ladder[k].orbit_error);
    EXPECT_EQ(one.ladder[k].work.right_hand_sides, four.ladder[k].work.right_hand_sides);
  }
  for (std::size_t k = 0; k < one.smoothing.size(); ++k)
    EXPECT_EQ(one.smoothing[k].distance, four.smoothing[k].distance);
}

TolerancePoint ladder_of(double exponent, double level) {
  TolerancePoint p;
  p.period = 1;
  for (double tolerance = 1e-4; tolerance > 1e-11; tolerance *= 0.1)
    for (const auto& [name, order] : {std::pair{"low", 3.0}, std::pair{"high", 6.0}}) {
      LadderStep s;
      s.method = name;
      s.tolerance = tolerance;
      s.error = level * std::pow(tolerance, exponent);
      s.orbit_error = 2.0 * s.error;
      s.work.right_hand_sides = std::lround(1e4 * std::pow(s.error / level, -1.0 / order));
      p.ladder.push_back(s);
    }
  return p;
}

TEST(Slopes, AreThoseOfTheLadder) {
  const std::vector<Slopes> all = slopes({ladder_of(1.0, 1.0), ladder_of(1.0, 20.0)}, 34, 1e-12);
  ASSERT_EQ(all.size(), 2U);
  constexpr double rounding = 1e-14;      // of logarithms of up to 30
  constexpr double whole_numbers = 1e-5;  // of right-hand sides, of which there are 5e4 and more
  EXPECT_NEAR(all[0].over_tolerance, 1.0, rounding);
  EXPECT_NEAR(all[0].over_cost, -3.0, whole_numbers);
  EXPECT_NEAR(all[1].over_cost, -6.0, whole_numbers);
}

TEST(Recommendation, IsTheCheapestThatMeetsTheTargetEverywhere) {
  constexpr double target = 1e-6;
  const auto best = recommend({ladder_of(1.0, 1.0), ladder_of(1.0, 20.0)}, 34, target);
  ASSERT_TRUE(best.has_value());
  // 2 x 20 x tolerance <= 1e-6: 1e-8 is the loosest of the ladder.
  EXPECT_EQ(best->method, "high");
  constexpr double rounding = 1e-14;  // of four products by a tenth
  EXPECT_NEAR(best->tolerance, 1e-8, rounding * 1e-8);
  EXPECT_LE(best->largest_error, target);
  EXPECT_FALSE(recommend({ladder_of(1.0, 1.0)}, 34, 1e-16).has_value());
}

TEST(Statistics, AgreeWhereAllIntervalsOverlap) {
  StatisticsStep a;
  a.exponent = {0.1, 0.01};
  for (auto* e : {&a.mean[0], &a.mean[1], &a.deviation[0], &a.deviation[1]}) *e = {1.0, 0.1};
  StatisticsStep b = a;
  EXPECT_TRUE(statistics_agree(a, b));
  b.mean[1].value = 1.3;
  EXPECT_FALSE(statistics_agree(a, b));
  b = a;
  b.outcome = integrate::Outcome::failed;
  EXPECT_FALSE(statistics_agree(a, b));
}

}  // namespace
}  // namespace epicyclic::studies::trust_test
