// Regimes of the paper's own stage, from the input that the speed diagram is computed from.

#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/lyapunov.hpp"
#include "input/study_model.hpp"
#include "integrate/lanes/lane_pool.hpp"
#include "integrate/make_flow.hpp"
#include "kinds/run/plan.hpp"
#include "studies/run.hpp"
#include "studies/stage_lanes.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::kinds::paper_regimes_test {
namespace {

bool always() { return true; }

studies::PointResult point_at(const model::DynamicModel& m, const studies::RecordingOptions& recording,
                              const integrate::IntegratorOptions& integrator) {
  return studies::compute_point({0, studies::Direction::up, m.omega}, m, {}, recording, integrator, always);
}

/// The run of inputs/tang2020_run.json at another speed, with few periods of history and exponents.
std::optional<studies::RunResult> run_at(const input::LoadedInput& input, const model::DynamicModel& m,
                                         int exponent_periods, int dense_phases = 0) {
  studies::RunOptions options = input.study.plan.as<kinds::RunPlan>().run;
  if (dense_phases > 0) options.dense_phases = dense_phases;
  options.exponent_periods = exponent_periods;
  options.history_periods = 4;
  return studies::run_operating_point(m, input.study.recording(), options, input.study.integrator);
}

TEST(PaperRegimes, NextToAFlipNoTorusIsTold) {
  // Of period 2 up to the flip at 2.148946416 (validation/bifurcation_points): so near to it the orbit that it left is
  // not told from it at the tolerance of a sweep, and to be undecided is right.
  const input::LoadedInput input = input::load_input("inputs/tang2020_speed.json");
  const studies::ModelAt at = input::model_at(input);
  for (const char* method : {"lanes-cash-karp", "arkode-dopri5"})
    for (const double speed : {2.1486, 2.1488, 2.1489, 2.14892}) {
      integrate::IntegratorOptions integrator = input.study.integrator;
      integrator.method = method;
      const studies::PointResult r = studies::compute_point_as_swept({0, studies::Direction::up, speed}, at(speed), {},
                                                                     input.study.recording(), integrator, always);
      constexpr double told_by_all = 2.1486;
      if (speed <= told_by_all || r.regime != analysis::Regime::undecided) {
        EXPECT_EQ(r.regime, analysis::Regime::periodic) << method << " at " << speed << ": " << r.evidence.note;
        EXPECT_EQ(r.period, 2) << method << " at " << speed;
      }
    }
}

TEST(PaperRegimes, RestingVectorsOfWeakChaosAreNoTorus) {
  // Chaotic over 15 000 periods, with exponents of 0.003 per tau. For 500 periods and more vectors do not grow.
  const input::LoadedInput input = input::load_input("inputs/tang2020_calibrated_speed.json");
  const studies::ModelAt at = input::model_at(input);
  for (const double speed : {2.26879194631, 2.26919463087, 2.26979865772}) {
    const studies::PointResult r = studies::compute_point_as_swept(
        {0, studies::Direction::up, speed}, at(speed), {}, input.study.recording(), input.study.integrator, always);
    EXPECT_NE(r.regime, analysis::Regime::quasiperiodic) << speed << ": " << r.evidence.note;
  }
}

TEST(PaperRegimes, AreToldWithTheirEvidence) {
  const input::LoadedInput input = input::load_input("inputs/tang2020_speed.json");
  const studies::ModelAt at = input::model_at(input);
  studies::RecordingOptions recording = input.study.recording();
  recording.transient = studies::Transient::adaptive;
  recording.recorded_periods = 32;

  const studies::PointResult periodic = point_at(at(3.0), recording, input.study.integrator);
  EXPECT_EQ(periodic.regime, analysis::Regime::periodic);
  EXPECT_EQ(periodic.period, 1);
  // Three tolerances in parts of the largest component, which is below 10 b_c.
  EXPECT_LT(periodic.evidence.residual, 3.0 * input.study.integrator.relative_tolerance * 10.0);
  EXPECT_LT(periodic.evidence.largest_multiplier + periodic.evidence.multiplier_error, 1.0);
  EXPECT_LT(periodic.lyapunov_max().high(), 0.0);
  // Put onto its orbit: what is left are the integrator's errors, held up by a multiplier of 0.996.
  constexpr double times_the_condition = 1e-5;
  EXPECT_LT(periodic.recurrence.error, times_the_condition);

  const studies::PointResult doubled = point_at(at(2.1), recording, input.study.integrator);
  EXPECT_EQ(doubled.regime, analysis::Regime::periodic);
  EXPECT_EQ(doubled.period, 2);

  const studies::PointResult chaotic = point_at(at(1.3), recording, input.study.integrator);
  EXPECT_EQ(chaotic.regime, analysis::Regime::chaotic);
  EXPECT_EQ(chaotic.period, 0);
  EXPECT_GT(chaotic.lyapunov_max().low(), 0.0);
  EXPECT_GT(chaotic.evidence.zero_one.value(), 0.5);
}

TEST(PaperRegimes, AVectorOnATorusNeitherGrowsNorShrinksInLanes) {
  // Contacts open and close there: errors at kinks, of one sign, made 5e-4 to 2e-3 of it, at any tolerance.
  const input::LoadedInput input = input::load_input("inputs/tang2020_speed.json");
  const model::DynamicModel model = input::model_at(input)(2.05);
  const double period = model.period;
  const auto grown = [](integrate::Flow& flow, std::vector<double>& y, std::vector<double>& v, int periods) {
    double growth = 0.0;
    for (int k = 0; k < periods; ++k) {
      EXPECT_TRUE(flow.evolve_tangents(y, v, 0.0, flow.field().period).reached());
      const double size = std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
      growth += std::log(size);
      for (double& x : v) x /= size;
    }
    return growth;
  };
  integrate::IntegratorOptions o = input.study.integrator;
  std::vector<double> settled = model.default_start;
  o.method = "arkode-dopri5";
  o.relative_tolerance = 1e-6;
  o.absolute_tolerance = 1e-8;
  const auto flow = integrate::make_flow(model, o);
  for (int k = 0; k < 1000; ++k) ASSERT_TRUE(flow->evolve(settled, 0.0, period).reached());
  constexpr int aligning = 1500;  // until a mode has died away that shrinks by 0.0018 per tau
  constexpr int counted = 1500;
  constexpr double none = 1.5e-4;  // per tau: what so many periods of a torus leave; 5e-5 measured
  for (const char* method : {"lanes-dopri5", "lanes-cash-karp"}) {
    o.method = method;
    integrate::LanePool pool = studies::stage_pool(model, o, integrate::step_loops());
    pool.run(1, [&] {
      const auto lane = pool.make_flow(model, o);
      std::vector<double> y = settled;
      std::vector<double> v(y.size(), 1.0);
      (void)grown(*lane, y, v, aligning);
      EXPECT_NEAR(grown(*lane, y, v, counted) / (counted * period) * model.omega, 0.0, none) << method;
    });
  }
}

TEST(PaperRegimes, DampingInContactOnlyPullsForAShortTime) {
  const auto tension_time = [](const std::vector<std::string>& sets) {
    const input::LoadedInput input = input::load_input("inputs/tang2020_speed.json", input::parse_assignments(sets));
    studies::RecordingOptions recording = studies::by_recurrence_alone(input.study.recording());
    recording.transient_periods = 100;
    recording.recorded_periods = 8;
    const studies::PointResult r = point_at(input::model_at(input)(2.8), recording, input.study.integrator);
    EXPECT_EQ(r.outcome, integrate::Outcome::reached);
    EXPECT_TRUE(r.has_tension());
    return studies::StageRecord::tension_time(r.meshes.ring_planet);
  };
  const double always = tension_time({});
  const double in_contact = tension_time({"/model/gap_damping=contact_slope", "/integrator/clearance_smoothing=0.01"});
  EXPECT_GT(always, 0.3);
  EXPECT_LT(in_contact, 0.15);
}

TEST(PaperRegimes, ARunChecksItsExponents) {
  const input::LoadedInput input = input::load_input("inputs/tang2020_run.json");
  const model::DynamicModel m = input::model_at(input)(2.4);
  const auto r = run_at(input, m, 40);
  ASSERT_TRUE(r.has_value());
  ASSERT_TRUE(r->checks.has_value());
  constexpr double of_the_sum = 1e-8;  // the check's tolerance, times the steps between contacts
  EXPECT_NEAR(r->checks->sum, r->checks->divergence, of_the_sum);
  ASSERT_TRUE(r->multipliers.has_value());
  EXPECT_TRUE(r->multipliers->stable());
  // The product of all multipliers is exp of the divergence over the period.
  double product = 0.0;
  for (const auto& value : r->multipliers->values) product += std::log(std::abs(value));
  constexpr double of_the_multipliers = 1e-8;  // likewise, of all multipliers
  EXPECT_NEAR(product / (2.0 * std::numbers::pi) * m.omega, r->checks->divergence, of_the_multipliers);
  ASSERT_TRUE(r->transverse.has_value());
  EXPECT_LT(r->transverse->low(), 0.0);
  // Mean forces of sun meshes are equal for equal planets, and each drives for part of the time.
  ASSERT_EQ(r->meshes.size(), 6U);
  for (const studies::MeshSummary& mesh : r->meshes) {
    constexpr double rounding = 1e-12;  // of means over the samples; unequal motions of planets die out
    EXPECT_NEAR(mesh.load_sharing, 1.0, rounding) << mesh.name;
    EXPECT_NEAR(mesh.drive + mesh.loss + mesh.back, 1.0, rounding) << mesh.name;
    // Damping through the open gap: tension while there is no contact on the back.
    EXPECT_EQ(mesh.back, 0.0) << mesh.name;
    EXPECT_GT(mesh.tensile_force_max, r->static_force) << mesh.name;
    EXPECT_NEAR(mesh.tensile_force_max, -mesh.force_min, rounding * mesh.tensile_force_max) << mesh.name;
  }
  // The record of the point, with half as many samples a period, tells the same.
  constexpr double sampling = 0.02;
  EXPECT_NEAR(
      studies::StageRecord::tension(r->point.meshes.ring_planet) * r->static_force / r->meshes[3].tensile_force_max,
      1.0, sampling);
  EXPECT_NEAR(studies::StageRecord::tension_time(r->point.meshes.ring_planet), r->meshes[3].tension_time, sampling);
  // Contact is made on the flank, with a rate.
  ASSERT_GT(r->crossing.size(), 0U);
  ASSERT_EQ(r->crossing_rate.size(), r->crossing.size());
  model::MeshDeflections d;
  constexpr double located = 1e-12;  // rounding of a root of the dense output, of order 1
  for (std::size_t k = 0; k < r->crossing.size(); ++k) {
    m.deflections(r->crossing_phase[k], r->crossing.point(k).data(), d);
    EXPECT_NEAR(d.sun_planet[0], m.sun_planet_half_gap, located);
    EXPECT_EQ(d.sun_planet_rate[0], r->crossing_rate[k]);
    EXPECT_GT(r->crossing_rate[k], 0.0);
  }
  // A run of one period of record has its lines on whole multiples of the mesh frequency.
  ASSERT_FALSE(r->spectra.empty());
  EXPECT_TRUE(r->spectra[0].exact);
}

TEST(PaperRegimes, ExactLinesAreThoseOfAnySampling) {
  // Contact is lost once a period: of 64 samples, 1.2 % and more of a line would be folded back from others.
  const input::LoadedInput input = input::load_input("inputs/tang2020_run.json");
  const model::DynamicModel m = input::model_at(input)(2.4);
  const auto coarse = run_at(input, m, 0, 64);
  const auto dense = run_at(input, m, 0, 8192);
  ASSERT_TRUE(coarse.has_value() && dense.has_value());
  ASSERT_EQ(coarse->spectra.size(), 4U);
  for (std::size_t k = 0; k < coarse->spectra.size(); ++k) {
    const auto& lines = coarse->spectra[k].lines;
    ASSERT_TRUE(coarse->spectra[k].exact);
    ASSERT_EQ(lines.size(), 33U);  // up to half of the samples that were asked for
    ASSERT_EQ(coarse->spectra[k].spectrum.amplitude.size(), lines.size());
    ASSERT_EQ(dense->spectra[k].lines.size(), 4097U);
    constexpr double folded = 2e-3;  // of the line, which may be one of the weakest
    for (std::size_t p = 0; p < lines.size(); ++p)
      EXPECT_NEAR(lines[p].amplitude / dense->spectra[k].lines[p].amplitude, 1.0, folded) << k << ' ' << p;
  }
}

TEST(PaperRegimes, ExponentsOfChaosInLanesAddUpToTheDivergence) {
  const input::LoadedInput input = input::load_input("inputs/tang2020_run.json");
  const model::DynamicModel m = input::model_at(input)(1.3);
  constexpr int periods = 60;
  const auto r = run_at(input, m, periods);
  ASSERT_TRUE(r.has_value());
  ASSERT_EQ(r->point.regime, analysis::Regime::chaotic);
  ASSERT_EQ(r->exponents.per_s.size(), m.dimension);
  // At the tolerance of a look, 1e-6, over the same motion: measured 1.1e-6 of 1.29.
  constexpr double of_the_sum = 1e-5;
  ASSERT_TRUE(r->checks.has_value());
  EXPECT_NEAR(r->checks->sum, r->checks->divergence, of_the_sum);
  // Without control of the vectors they are off, by more than with it.
  ASSERT_TRUE(r->checks->step_control.has_value());
  EXPECT_GT(*r->checks->step_control, of_the_sum);
  // And by ARKODE, as exactly as multipliers are wanted, the same within the intervals.
  integrate::IntegratorOptions exact;
  exact.relative_tolerance = exact.absolute_tolerance = 1e-10;
  exact.tangent_error_control = true;
  exact.max_steps_per_period *= 20;
  const auto flow = integrate::make_flow(m, exact);
  std::vector<double> y = r->point.end_state;
  analysis::SpectrumOptions spectrum;
  spectrum.intervals = periods;
  const analysis::LyapunovSpectrum of_arkode = analysis::lyapunov_spectrum(*flow, y, spectrum, always);
  int outside = 0;
  for (std::size_t i = 0; i < m.dimension; ++i) {
    const analysis::Estimate a = r->exponents.per_s[i];
    const analysis::Estimate b = of_arkode.per_s[i];
    outside += std::abs(a.value - b.value) > a.half_width + b.half_width ? 1 : 0;
  }
  EXPECT_LE(outside, 3) << "of 34 with intervals of 95 %";
}

TEST(PaperRegimesLong, IntervalsOfAChaoticExponentHoldTheTruth) {
  // 1000 looks one after another at the tolerance of looks; the truth is the mean of all.
  const input::LoadedInput input = input::load_input("inputs/tang2020_speed.json");
  const model::DynamicModel m = input::model_at(input)(1.2725);
  integrate::IntegratorOptions o = input.study.integrator;
  o.method = "arkode-dopri5";
  o.relative_tolerance = 1e-6;
  o.absolute_tolerance = 1e-8;
  const auto flow = integrate::make_flow(m, o);
  std::vector<double> y = m.default_start;
  constexpr int settling = 500;
  for (int k = 0; k < settling; ++k) ASSERT_TRUE(flow->evolve(y, 0.0, m.period).reached());
  constexpr std::size_t looks = 1000;
  constexpr std::size_t periods = 250;
  const analysis::LargestExponent e =
      analysis::largest_exponent(*flow, y, {.aligning_periods = 200, .periods = looks * periods}, {}, always);
  ASSERT_EQ(e.growth.size(), looks * periods);
  const double truth = std::accumulate(e.growth.begin(), e.growth.end(), 0.0) / static_cast<double>(looks * periods);
  int held = 0;
  for (std::size_t k = 0; k < looks; ++k) {
    const analysis::Estimate recording = analysis::series_mean(std::span(e.growth).subspan(k * periods, periods));
    held += recording.low() <= truth && truth <= recording.high() ? 1 : 0;
  }
  EXPECT_GE(held, 930);
  EXPECT_LE(held, 970);
  RecordProperty("held_of_1000", held);
}

TEST(PaperRegimesLong, ExponentsOfPeriodicPointsAreThoseOfTheirMultipliers) {
  const input::LoadedInput input = input::load_input("inputs/tang2020_speed.json");
  const studies::ModelAt at = input::model_at(input);
  studies::RecordingOptions recording = input.study.recording();
  recording.transient = studies::Transient::adaptive;
  recording.recorded_periods = 16;
  int points = 0;
  for (int k = 0; k < 30; ++k) {
    const double omega = k < 12 ? 0.205 + 0.024 * k : 2.2 + 0.07 * (k - 12);
    const model::DynamicModel m = at(omega);
    const studies::PointResult r = point_at(m, recording, input.study.integrator);
    ASSERT_EQ(r.regime, analysis::Regime::periodic) << omega << ": " << r.evidence.note;
    const analysis::Estimate of_multiplier = r.lyapunov_max();
    const auto flow = integrate::make_flow(m, input.study.integrator);
    std::vector<double> y = r.end_state;
    // Several multipliers are nearly as large: the vector takes long to turn to the largest, and pairs of one modulus
    // beat with periods of up to 6000 (at 3.18), which an interval has to have seen.
    const analysis::LargestExponent e = analysis::largest_exponent(*flow, y, {500, 12000}, {}, always);
    ASSERT_TRUE(e.evolution.reached());
    const double off = std::abs(e.per_s.value * omega - of_multiplier.value);
    EXPECT_LE(off, e.per_s.half_width * omega + of_multiplier.half_width)
        << "omega " << omega << ": " << e.per_s.value * omega << " +- " << e.per_s.half_width * omega << " and "
        << of_multiplier.value << " +- " << of_multiplier.half_width;
    ++points;
  }
  EXPECT_EQ(points, 30);
}

}  // namespace
}  // namespace epicyclic::kinds::paper_regimes_test
