// What is told of meshes and bearings over whole periods, against signals that are known and against sums one by one.

#include "studies/response_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "core/quadrature.hpp"
#include "model/dynamic_model.hpp"
#include "problems/r1.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies::stage_watch_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-13;  // of sums of some hundred numbers of size 1

/// A state of two numbers that are the deflections of a sun mesh and a ring mesh.
model::DynamicModel two_signals(double half_gap) {
  model::DynamicModel m;
  m.planets = 1;
  m.dimension = 2;
  m.sun_planet_half_gap = m.ring_planet_half_gap = half_gap;
  m.deflections = [](double, const double* y, model::MeshDeflections& d) {
    d.sun_planet = {y[0]};
    d.ring_planet = {y[1]};
  };
  return m;
}

/// @param signal  of s, which goes on over the periods
StageRecord record_of(const std::function<double(double s)>& signal, int phases, int periods, double half_gap = 1.0) {
  const model::DynamicModel m = two_signals(half_gap);
  ResponseStatistics watch(m, phases);
  for (int period = 0; period < periods; ++period)
    for (const double phase : watch.phases()) {
      const double s = 2.0 * pi * period + phase;
      const std::array y = {signal(s), -signal(s)};
      watch.see(y);
    }
  return watch.finish();
}

TEST(ResponseStatistics, TellsWhatAHarmonicMotionIs) {
  // Phases that are whole groups of looks, and those that are not.
  for (const int phases : {64, 36, 20, 12}) {
    const StageRecord r = record_of(
        [](double s) { return 3.0 + 0.5 * std::cos(s) + 0.25 * std::sin(2.0 * s) + 0.125 * std::cos(3.0 * s + 1.0); },
        phases, 3);
    const Course& sp = r.sun_planet[0].delta;
    EXPECT_NEAR(sp.mean, 3.0, rounding) << phases;
    EXPECT_NEAR(sp.rms, std::sqrt((0.25 + 0.0625 + 0.015625) / 2.0), rounding) << phases;
    EXPECT_NEAR(r.ring_planet[0].delta.mean, -3.0, rounding);
    EXPECT_NEAR(r.ring_planet[0].delta.largest, -sp.least, 0.0);
    EXPECT_NEAR(r.sun_planet_harmonics[0], 0.5, rounding) << phases;
    EXPECT_NEAR(r.sun_planet_harmonics[1], 0.25, rounding) << phases;
    EXPECT_NEAR(r.sun_planet_harmonics[2], 0.125, rounding) << phases;
    EXPECT_NEAR(r.ring_planet_harmonics[0], 0.5, rounding);
  }
  const StageRecord r = record_of([](double s) { return std::cos(s); }, 64, 2);
  EXPECT_NEAR(r.sun_planet[0].delta.range(), 2.0, rounding);
}

TEST(ResponseStatistics, LivesAreThoseOfTheMeanPowerOfTheForce) {
  // The force F = a + b cos s of both bearings: mean F^3 = a^3 + 3/2 a b^2, mean F^(10/3) by quadrature.
  constexpr double a = 2.0;
  constexpr double b = 1.5;
  model::DynamicModel m = two_signals(1.0);
  m.scales = model::scales_of(problems::r1());
  m.bearings.planet = gear::RatedBearing{30e3, 10.0 / 3.0, 40.0};
  m.bearings.sun = gear::RatedBearing{20e3, 3.0, 100.0};
  m.outputs_at = [](std::span<const double> /*phases*/) -> model::StageOutputs {
    return [](std::size_t /*group*/, const double* states, double* rows) {
      constexpr model::OutputRows at{1};
      constexpr std::size_t together = model::phases_together;
      std::fill(rows, rows + at.count() * together, 0.0);
      for (std::size_t lane = 0; lane < together; ++lane)
        rows[at.planet_bearing(0) * together + lane] = rows[at.sun_bearing() * together + lane] = states[lane];
    };
  };
  ResponseStatistics watch(m, 64);
  for (int period = 0; period < 3; ++period)
    for (const double s : watch.phases()) watch.see(std::array{a + b * std::cos(s), 0.0});
  const StageRecord r = watch.finish();
  ASSERT_TRUE(r.sun_life);
  ASSERT_EQ(r.planet_lives.size(), 1U);
  const double newton = m.scales.force_newton(1.0);
  EXPECT_NEAR(r.sun_life->equivalent_load_N / (newton * std::cbrt(a * a * a + 1.5 * a * b * b)), 1.0, rounding);
  const double mean = gauss_legendre_16().integrate([](double s) { return std::pow(a + b * std::cos(s), 10.0 / 3.0); },
                                                    0.0, 2.0 * pi, 20) /
                      (2.0 * pi);
  constexpr double trapezoidal = 1e-9;  // 64 samples of a function that is smooth: F > 0
  EXPECT_NEAR(r.planet_lives[0].equivalent_load_N / (newton * std::pow(mean, 0.3)), 1.0, trapezoidal);
  EXPECT_NEAR(r.planet_lives[0].million_revolutions, std::pow(30e3 / r.planet_lives[0].equivalent_load_N, 10.0 / 3.0),
              rounding * r.planet_lives[0].million_revolutions * 100.0);
  EXPECT_EQ(r.shortest_life(), r.planet_lives[0].hours);
  m.bearings = {};
  ResponseStatistics without(m, 64);
  EXPECT_FALSE(without.finish().sun_life);
  EXPECT_TRUE(std::isnan(without.finish().shortest_life()));
}

TEST(ResponseStatistics, SubharmonicsAreNoMeshHarmonics) {
  const StageRecord r = record_of([](double s) { return std::cos(s / 2.0) + 0.3 * std::cos(s); }, 64, 8);
  EXPECT_NEAR(r.sun_planet_harmonics[0], 0.3, rounding);
  EXPECT_NEAR(r.sun_planet_harmonics[1], 0.0, rounding);
  EXPECT_NEAR(r.sun_planet[0].delta.rms, std::sqrt((1.0 + 0.09) / 2.0), rounding);
}

TEST(ResponseStatistics, HarmonicsThatCannotBeToldAreNone) {
  const StageRecord r = record_of([](double s) { return std::cos(s); }, 4, 2);
  EXPECT_NEAR(r.sun_planet_harmonics[0], 1.0, rounding);
  EXPECT_TRUE(std::isnan(r.sun_planet_harmonics[1])) << "two samples of a wave";
  EXPECT_TRUE(std::isnan(r.sun_planet_harmonics[2]));
}

TEST(ResponseStatistics, ASmallMotionIsNotLostInItsMean) {
  const double small = 1e-9;
  const StageRecord r = record_of([small](double s) { return 4.0 + small * std::cos(s); }, 64, 4);
  constexpr double of_the_mean = 4.0 * 2.3e-16;  // a sample's own rounding
  EXPECT_NEAR(r.sun_planet[0].delta.rms, small / std::sqrt(2.0), of_the_mean);
}

TEST(ResponseStatistics, TellsHowLongAMeshIsOnEachSide) {
  // cos s > 1/2 for a third of the time; at 12 phases for 3 of them, since the ends do not count.
  for (const int phases : {12, 20, 64}) {
    long drive = 0;
    long back = 0;
    for (int period = 0; period < 3; ++period)
      for (const double phase : analysis::uniform_phases(2.0 * pi, phases)) {
        const double s = 2.0 * pi * period + phase;  // as in record_of(): rounding decides on which side the ends are
        drive += std::cos(s) > 0.5 ? 1 : 0;
        back += std::cos(s) < -0.5 ? 1 : 0;
      }
    const StageRecord r = record_of([](double s) { return std::cos(s); }, phases, 3, 0.5);
    const MeshRecord& sp = r.sun_planet[0];
    EXPECT_NEAR(sp.drive, static_cast<double>(drive) / (3.0 * phases), rounding) << phases;
    EXPECT_NEAR(sp.back, static_cast<double>(back) / (3.0 * phases), rounding) << phases;
    EXPECT_NEAR(sp.drive + sp.loss() + sp.back, 1.0, rounding);
    EXPECT_EQ(sp.contact(), "drive+loss+back");
  }
  EXPECT_EQ(record_of([](double) { return 2.0; }, 12, 1).sun_planet[0].contact(), "drive");
}

TEST(ResponseStatistics, ARecordThatBrokeOffTellsWhatWasSeen) {
  const model::DynamicModel m = two_signals(1.0);
  ResponseStatistics watch(m, 64);
  double sum = 0.0;
  for (int k = 1; k <= 4 * (64 + 11); ++k) {
    const double x = 0.0025 * k;
    if (k % 4 == 0) sum += x;  // at a uniform phase
    watch.see(std::array{x, -x});
  }
  const StageRecord r = watch.finish();
  EXPECT_NEAR(r.sun_planet[0].delta.mean, sum / 75.0, rounding);
  EXPECT_EQ(r.sun_planet[0].delta.largest, 0.75);
  EXPECT_EQ(r.sun_planet[0].delta.least, 0.0025);
  EXPECT_NEAR(r.sun_planet[0].loss(), 1.0, rounding);
  EXPECT_TRUE(std::isnan(r.sun_planet_harmonics[0])) << "over whole periods only";
  ResponseStatistics none(m, 64);
  const StageRecord nothing = none.finish();
  EXPECT_TRUE(std::isnan(nothing.sun_planet[0].delta.mean));
  EXPECT_EQ(nothing.sun_planet[0].contact(), "");
}

TEST(ResponseStatistics, TellsTheForcesOfAStageOneByOne) {
  const gear::Stage stage = problems::r1_nonlinear();
  const model::Scales scales = model::scales_of(stage);
  const model::DynamicModel m = model::make_dynamic_model(stage, scales, 0.9, {});
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> component(-6.0, 6.0);  // on all three sides of the gaps
  constexpr int phases = 20;
  const std::vector<double> uniform = analysis::uniform_phases(m.period, phases);
  ResponseStatistics watch(m, phases);
  std::vector<double> sp_2;  // at uniform phases
  std::vector<double> bearing;
  std::vector<double> all_sp_2;
  std::vector<double> all_bearing;
  double greatest = 0.0;
  double spread = 0.0;
  for (std::size_t k = 0; k < 2 * watch.phases().size(); ++k) {
    std::vector<double> y(m.dimension);
    for (double& x : y) x = component(random);
    watch.see(y);
    const double s = watch.phases()[k % watch.phases().size()];
    model::StageForces f;
    model::MeshDeflections d;
    m.forces(s, y.data(), f);
    m.deflections(s, y.data(), d);
    all_sp_2.push_back(scales.force_newton(f.sun_planet[1]));
    all_bearing.push_back(scales.force_newton(f.planet_bearing[2]));
    if (std::ranges::binary_search(uniform, s)) {
      sp_2.push_back(all_sp_2.back());
      bearing.push_back(all_bearing.back());
    }
    for (const double force : f.sun_planet) greatest = std::max(greatest, scales.force_newton(force));
    for (const auto* list : {&d.sun_planet, &d.ring_planet}) {
      const auto [least, most] = std::minmax_element(list->begin(), list->end());
      spread = std::max(spread, *most - *least);
    }
  }
  const StageRecord r = watch.finish();
  ASSERT_EQ(sp_2.size(), 2U * phases);
  const auto expect = [](const Course& told, const std::vector<double>& x, const std::vector<double>& all) {
    const auto n = static_cast<double>(x.size());
    double mean = 0.0;
    for (const double v : x) mean += v / n;
    double square = 0.0;
    for (const double v : x) square += (v - mean) * (v - mean) / n;
    const double size = *std::max_element(all.begin(), all.end());
    EXPECT_NEAR(told.mean, mean, rounding * size);
    EXPECT_NEAR(told.rms, std::sqrt(square), rounding * size);
    EXPECT_NEAR(told.largest, size, rounding * size);
    EXPECT_NEAR(told.least, *std::min_element(all.begin(), all.end()), rounding * size);
  };
  expect(r.sun_planet[1].force, sp_2, all_sp_2);
  expect(r.planet_bearing[2], bearing, all_bearing);
  EXPECT_NEAR(r.planet_spread, spread, rounding * spread);
  // Omega = 0.9 with the ring fixed: omega_s = omega_m / z_s (1 + z_s / z_r).
  EXPECT_NEAR(r.mesh_frequency, 0.9 * scales.omega_sn, rounding * r.mesh_frequency);
  EXPECT_NEAR(r.speeds.sun, r.mesh_frequency / 27.0 * (1.0 + 27.0 / 81.0), rounding * r.speeds.sun);
  EXPECT_NEAR(r.speeds.carrier, r.mesh_frequency / 81.0, rounding * r.speeds.carrier);
  EXPECT_NEAR(r.static_force, scales.force_newton(m.static_mesh_force), rounding * r.static_force);
  EXPECT_NEAR(r.dynamic_factor(r.sun_planet), greatest / r.static_force, rounding * greatest / r.static_force);
  double shares = 0.0;
  double largest_shares = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    shares += StageRecord::share(r.sun_planet, &Course::mean, i);
    largest_shares += StageRecord::share(r.sun_planet, &Course::largest, i);
  }
  EXPECT_NEAR(shares, 3.0, rounding * 10.0);
  EXPECT_NEAR(largest_shares, 3.0, rounding * 10.0);
  double most = 0.0;
  double share = 0.0;
  double lost = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    most = std::max(most, r.planet_bearing[i].largest);
    lost = std::max(lost, r.ring_planet[i].loss());
    for (const auto* meshes : {&r.sun_planet, &r.ring_planet})
      share = std::max(share, StageRecord::share(*meshes, &Course::largest, i));
  }
  EXPECT_EQ(r.largest_bearing_force(), most);
  EXPECT_EQ(r.largest_share(&Course::largest), share);
  EXPECT_EQ(StageRecord::loss_time(r.ring_planet), lost);
  EXPECT_NEAR(StageRecord::share(r.sun_planet, &Course::mean, 1) / StageRecord::share(r.sun_planet, &Course::mean, 0),
              r.sun_planet[1].force.mean / r.sun_planet[0].force.mean, rounding * 1e3);
}

TEST(ResponseStatistics, ForcesAreSeenOnBothSidesOfEachBreakpoint) {
  // The stiffness jumps by 30 % at the phase of a breakpoint, which is its largest value.
  const gear::Stage stage = problems::with_stiffness_curve(problems::with_gap(problems::r1()));
  const model::DynamicModel m = model::make_dynamic_model(stage, model::scales_of(stage), 0.9, {});
  ASSERT_FALSE(m.breakpoints.empty());
  for (const int phases : {4, 64}) {
    ResponseStatistics watch(m, phases);
    const std::vector<double> y(m.default_start);
    for (const double b : m.breakpoints) {
      const auto after = std::ranges::find_if(watch.phases(), [b](double s) { return s >= b; });
      ASSERT_NE(after, watch.phases().end());
      EXPECT_LE(*after - b, 1e-300);
      if (b > 0.0) {
        EXPECT_EQ(*std::prev(after), std::nextafter(b, 0.0));
      }
    }
    for (std::size_t k = 0; k < watch.phases().size(); ++k) watch.see(y);
    const StageRecord r = watch.finish();
    // At a fixed state the force is smooth between breakpoints: that of the stiffness and of the sine of the error.
    const double missed_peak = 0.5 * std::pow(pi / (phases * extrema_refinement(m, phases)), 2);
    double largest = 0.0;
    model::StageForces f;
    for (int k = 1; k < 100000; ++k) {
      m.forces(m.period * k / 100000, y.data(), f);
      largest = std::max(largest, m.scales.force_newton(f.sun_planet[0]));
    }
    EXPECT_NEAR(r.sun_planet[0].force.largest / largest, 1.0, missed_peak) << phases;
  }
}

TEST(ResponseStatistics, SamplingErrorOfForcesIsThatOfHalfAsManySamples) {
  EXPECT_EQ(record_of([](double) { return 1.0; }, 64, 2).force_error, 0.0);
  const gear::Stage stage = problems::r1_nonlinear();
  const model::DynamicModel m = model::make_dynamic_model(stage, model::scales_of(stage), 0.9, {});
  constexpr int phases = 16;
  ResponseStatistics watch(m, phases);
  // One peak, at one of the samples that are odd multiples of the finest spacing.
  const double peak = m.period * 3.0 / (phases * extrema_refinement(m, phases));
  std::vector<double> peaked = m.default_start;
  for (double& x : peaked) x *= 3.0;
  std::size_t peaks = 0;
  double rest = 0.0;
  double most = 0.0;
  model::StageForces f;
  for (const double s : watch.phases()) {
    const bool here = std::abs(s - peak) < 1e-9;
    const std::vector<double>& y = here ? peaked : m.default_start;
    peaks += here ? 1 : 0;
    watch.see(y);
    m.forces(s, y.data(), f);
    for (const double force : f.planet_bearing) (here ? most : rest) = std::max(here ? most : rest, force);
  }
  ASSERT_EQ(peaks, 1U);
  EXPECT_GE(3.0 * watch.finish().force_error, 1.0 - rest / most - rounding);
  EXPECT_GT(1.0 - rest / most, 0.5);
}

TEST(ResponseStatistics, SlowMeshesHaveMoreSamples) {
  model::DynamicModel m;
  m.omega = 1.0;
  EXPECT_EQ(extrema_refinement(m, 64), 4);
  m.omega = 0.05;
  EXPECT_GE(64 * extrema_refinement(m, 64), 20.0 * 2.0 / 0.05);
  EXPECT_EQ(extrema_refinement(m, 64) % 2, 0);
  m.omega = 1e-9;
  EXPECT_LE(64 * extrema_refinement(m, 64), 8192 + 128);
}

/// A stage at a torque that does not depend on speed, and its record after its motion has settled.
gear::Stage loaded(gear::Stage stage, double torque_Nm) {
  stage.load = {};
  stage.load.torque_Nm = torque_Nm;
  return stage;
}
/// Supports and bearings so stiff that planets cannot give way to each other.
gear::Stage stiffly_held(gear::Stage stage) {
  for (double* support : {&stage.sun.support_N_per_m, &stage.ring.support_N_per_m, &stage.carrier.support_N_per_m})
    *support = 1e10;
  stage.planet.bearing_N_per_m = 1e10;
  return stage;
}

StageRecord record_at(const gear::Stage& stage, double ratio, int transient_periods) {
  const model::DynamicModel m = model::make_dynamic_model(stage, model::scales_of(stage), ratio, {});
  RecordingOptions recording;
  recording.classification_periods = 0;
  recording.transient_periods = transient_periods;
  recording.recorded_periods = 2;
  recording.period_max = 1;
  return compute_point({}, m, {}, recording, {}, [] { return true; }).meshes;
}

TEST(DynamicFactor, IsOneAtNoSpeedWhateverPlanetsCarry) {
  // Errors that differ share the load unevenly: that is K_gamma, and no dynamics.
  gear::Stage stage = stiffly_held(loaded(problems::with_moving_stiffness(problems::with_gap(problems::r1())), 900.0));
  stage.sun_planet_mesh.error_amplitude_um = {40.0, 10.0, 8.0};
  std::vector<double> beyond;
  for (const double ratio : {0.02, 0.01}) {
    const StageRecord r = record_at(stage, ratio, 3);
    const double kv = std::max(StageRecord::kv(r.sun_planet), StageRecord::kv(r.ring_planet));
    EXPECT_GT(r.dynamic_factor(r.sun_planet), 1.3) << "uneven sharing";
    EXPECT_NEAR(StageRecord::k_gamma(r.sun_planet) / r.dynamic_factor(r.sun_planet), 1.0, 0.02);
    for (const auto* meshes : {&r.sun_planet, &r.ring_planet})
      for (const MeshRecord& mesh : *meshes) beyond.push_back(std::abs(mesh.kv() - 1.0));
    EXPECT_NEAR(kv, 1.0, 0.02) << ratio;
  }
  const auto half = static_cast<std::ptrdiff_t>(beyond.size() / 2);
  EXPECT_LT(*std::max_element(beyond.begin() + half, beyond.end()),
            0.75 * *std::max_element(beyond.begin(), beyond.begin() + half))
      << "it falls with the speed";
}

TEST(DynamicFactor, IsTheLargestForceOverTheStaticOneOfEqualPlanetsInPhase) {
  // Without friction each planet carries F_0 at rest, at each phase.
  for (const gear::Stage& stage :
       {problems::with_gap(problems::r1()), problems::star(problems::with_gap(problems::r1())),
        problems::with_moving_stiffness(problems::with_gap(problems::r1()))}) {
    const StageRecord r = record_at(loaded(stage, 900.0), 0.7, 10);
    constexpr double digits = 1e-6;  // of R1's radii, whose ratio is that of the teeth to 2e-7
    EXPECT_GT(r.dynamic_factor(r.sun_planet), 1.05);
    EXPECT_NEAR(StageRecord::kv(r.sun_planet), r.dynamic_factor(r.sun_planet), digits);
    EXPECT_NEAR(StageRecord::kv(r.ring_planet), r.dynamic_factor(r.ring_planet), digits);
    EXPECT_NEAR(StageRecord::k_gamma(r.sun_planet), 1.0, digits);
    EXPECT_NEAR(StageRecord::k_gamma(r.ring_planet), 1.0, digits);
  }
}

TEST(DynamicFactor, TimesMeshLoadFactorBoundsTheLargestForce) {
  const StageRecord r = record_at(loaded(problems::r1_nonlinear(), 900.0), 0.9, 50);
  for (const auto* meshes : {&r.sun_planet, &r.ring_planet}) {
    double mean = 0.0;
    double largest = 0.0;
    for (const MeshRecord& mesh : *meshes) {
      mean += mesh.quasi_static.mean / 3.0;
      largest = std::max(largest, mesh.force.largest);
    }
    EXPECT_GT(StageRecord::k_gamma(*meshes), 1.01);
    EXPECT_GE(StageRecord::kv(*meshes) * StageRecord::k_gamma(*meshes) * mean, largest * (1.0 - rounding));
  }
}

TEST(DynamicFactor, IsNoneWithoutLoadOrQuasiStaticSolution) {
  const StageRecord r = record_of([](double s) { return std::cos(s); }, 64, 2);
  EXPECT_TRUE(std::isnan(StageRecord::kv(r.sun_planet)));
  EXPECT_TRUE(std::isnan(StageRecord::k_gamma(r.sun_planet)));
  MeshRecord idle;
  idle.force.largest = 5.0;
  idle.quasi_static = {0.0, 0.0, 0.0, 0.0};
  EXPECT_TRUE(std::isnan(idle.kv()));
}

}  // namespace
}  // namespace epicyclic::studies::stage_watch_test
