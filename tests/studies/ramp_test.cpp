// A speed that changes at a constant rate: against Duhamel's integral of a linear oscillator that passes its resonance,
// against the jumps of a clearance oscillator in the limit of a slow rate, and against a constant speed.

#include "studies/ramp.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/quadrature.hpp"
#include "gear/kinematics.hpp"
#include "integrate/make_flow.hpp"
#include "model/dynamic_model.hpp"
#include "problems/pair.hpp"
#include "problems/r1.hpp"

namespace epicyclic::studies::ramp_test {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// delta'' + 2 z delta' + delta = F + e (Omega^2 sin s - Omega' cos s), without a gap.
gear::Stage linear_pair(double z, double mean, double e) {
  gear::Stage stage = problems::torsional_pair(z, mean, e);
  stage.sun_planet_mesh.backlash_half_um = 0.0;
  return stage;
}

integrate::IntegratorOptions tight() {
  integrate::IntegratorOptions o;
  o.relative_tolerance = o.absolute_tolerance = 1e-12;
  return o;
}

/// x of the oscillator x'' + 2 z x' + x = F + e sin s + 2 z e Omega cos s, at rest at x = F at tau = 0, by Duhamel's
/// integral: delta = x - e sin s.
double duhamel(double tau, double z, double mean, double e, double omega_0, double rate) {
  const double damped = std::sqrt(1.0 - z * z);
  const auto integrand = [&](double t) {
    const double s = omega_0 * t + 0.5 * rate * t * t;
    const double omega = omega_0 + rate * t;
    const double force = e * std::sin(s) + 2.0 * z * e * omega * std::cos(s);
    return force * std::exp(-z * (tau - t)) * std::sin(damped * (tau - t)) / damped;
  };
  // Panels of a quarter of the fastest oscillation.
  const double fastest = 1.0 + omega_0 + std::abs(rate) * tau;
  return mean + gauss_legendre_16().integrate(integrand, 0.0, tau, static_cast<int>(tau * fastest) + 8);
}

TEST(Ramp, LinearOscillatorPassesItsResonanceAsInDuhamelsIntegral) {
  constexpr double z = 0.02;
  constexpr double mean = 0.4;
  constexpr double e = 0.05;
  const gear::Stage stage = linear_pair(z, mean, e);
  const model::Scales scales = model::scales_of(stage);
  struct Case {
    double omega, rate;
    int periods;
  };
  // Up and down through Omega = 1, slowly and within some oscillations.
  for (const Case& c : {Case{0.6, 2e-3, 60}, Case{1.5, -2e-3, 60}, Case{0.5, 2e-2, 12}}) {
    const auto ramp = std::make_shared<model::SpeedRamp>(model::SpeedRamp{c.omega, c.rate, 0.0});
    const model::DynamicModel m = model::make_ramped_model(stage, scales, {}, ramp, c.omega);
    const auto flow = integrate::make_flow(m, tight());
    std::vector<double> y = {mean, 0.0};  // of x, at rest
    double worst = 0.0;
    for (int k = 0; k < c.periods; ++k) {
      ASSERT_TRUE(flow->evolve(y, 0.0, two_pi).reached());
      *ramp = {ramp->omega_at(two_pi), c.rate, ramp->tau_at(two_pi)};
      worst = std::max(worst, std::abs(y[0] - duhamel(ramp->tau, z, mean, e, c.omega, c.rate)));
    }
    EXPECT_NEAR(ramp->omega, c.omega + c.rate * ramp->tau, 1e-12);
    constexpr double accumulated = 1e-9;  // of tolerance 1e-12 over some hundred oscillations
    EXPECT_LT(worst, accumulated) << c.omega;
  }
}

TEST(Ramp, ResonanceIsPassedLateAndLower) {
  // Lewis 1932: a fast passage has its largest amplitude beyond the resonance, and a smaller one than at rest speed.
  const gear::Stage stage = linear_pair(0.02, 0.4, 0.05);
  const model::Scales scales = model::scales_of(stage);
  double before = 0.05 / (2.0 * 0.02) * 1.01;  // of the steady response, about
  double late = 0.0;
  for (const double rate : {2e-4, 2e-3, 8e-3}) {
    RampOptions options;
    options.from = 0.7;
    options.to = 1.6;
    options.rate_per_tau = rate;
    options.hold_periods = 100;
    options.window_periods = 2;
    const auto result = run_ramp(stage, scales, {}, options, {}, {});
    ASSERT_TRUE(result);
    const auto largest = [&](Direction direction) {
      RampWindow most;
      for (const RampWindow& w : result->windows)
        if (w.direction == direction && w.delta_max > most.delta_max) most = w;
      return most;
    };
    const RampWindow up = largest(Direction::up);
    const RampWindow down = largest(Direction::down);
    EXPECT_LT(up.delta_max - 0.4, before) << rate;
    EXPECT_GT(up.omega, 1.0) << rate;
    EXPECT_GT(up.omega - 1.0, late) << rate;
    EXPECT_LT(down.omega, 1.0) << rate;
    before = up.delta_max - 0.4;
    late = up.omega - 1.0;
  }
}

TEST(Ramp, SlowRampsJumpWhereTheSteadyResponseDoes) {
  // The pair of docs/howto/describe_a_stage.md: `continue` has its folds at 0.855488994 (up) and 0.619156870 (down).
  gear::Stage stage = problems::torsional_pair();
  stage.sun.inertia_over_r2_kg = stage.planet.inertia_over_r2_kg = 1.6;
  stage.sun.mass_kg = stage.planet.mass_kg = 2.8;
  stage.sun.teeth = stage.planet.teeth = 50;
  stage.sun.base_radius_mm = stage.planet.base_radius_mm = 70.477;
  auto& mesh = stage.sun_planet_mesh;
  mesh.stiffness_N_per_m = 4e8;
  mesh.stiffness_cos_N_per_m = {8e7};
  mesh.damping_ratio = 0.03;
  mesh.backlash_half_um = 50.0;
  mesh.error_amplitude_um = {1.0};
  stage.load.torque_Nm = 100.0;
  const model::Scales scales = model::scales_of(stage);
  struct Jump {
    double up = 0, down = 0;
  };
  const auto jumps_at = [&](double rate) {
    RampOptions options;
    options.from = 0.5;
    options.to = 1.05;
    options.rate_per_tau = rate;
    options.hold_periods = 300;
    options.window_periods = 4;
    integrate::IntegratorOptions integrator;
    integrator.relative_tolerance = integrator.absolute_tolerance = 1e-8;
    const auto result = run_ramp(stage, scales, {}, options, {}, integrator);
    Jump jump;
    const auto jump_of = [&](Direction direction) {
      // Contact is lost beyond the jump up and kept beyond the jump down.
      double at = 0.0;
      for (const RampWindow& w : result->windows) {
        if (w.direction != direction) continue;
        if (direction == Direction::up && at == 0.0 && w.loss_time > 0.2) at = w.omega;
        if (direction == Direction::down && w.loss_time > 0.05) at = w.omega;
      }
      return at;
    };
    jump.up = jump_of(Direction::up);
    jump.down = jump_of(Direction::down);
    return jump;
  };
  constexpr double fold_up = 0.855488994;
  constexpr double fold_down = 0.619156870;
  const Jump fast = jumps_at(1.6e-4);
  const Jump slow = jumps_at(2e-5);
  // A jump comes late, by an amount that falls as rate^(2/3): to a quarter at an eighth of the rate.
  EXPECT_GT(fast.up, fold_up);
  EXPECT_LT(fast.down, fold_down);
  EXPECT_GT(slow.up, fold_up - 1e-4);
  EXPECT_LT(slow.down, fold_down + 1e-4);
  EXPECT_LT(slow.up - fold_up, 0.4 * (fast.up - fold_up));
  EXPECT_LT(fold_down - slow.down, 0.4 * (fold_down - fast.down));
  EXPECT_LT(slow.up - fold_up, 0.01);
  EXPECT_LT(fold_down - slow.down, 0.01);
}

TEST(Ramp, AtARestingSpeedTheModelIsTheOneOfThatSpeed) {
  gear::Stage stage = problems::with_gap(problems::with_moving_stiffness(problems::r1()));
  stage.load = {.power_kW = 30.0, .torque_Nm = std::nullopt};
  model::ModelOptions options;
  options.centrifugal = model::Centrifugal::included;
  const model::Scales scales = model::scales_of(stage);
  for (const double omega : {0.7, 1.3}) {
    const model::DynamicModel expected = model::make_dynamic_model(stage, scales, omega, options);
    const auto ramp = std::make_shared<model::SpeedRamp>(model::SpeedRamp{omega, 0.0, 0.0});
    const model::DynamicModel m = model::make_ramped_model(stage, scales, options, ramp, 0.9);
    std::vector<double> y(m.dimension);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] = std::sin(1.0 + 3.0 * static_cast<double>(k));
    std::vector<double> a(m.dimension);
    std::vector<double> b(m.dimension);
    for (const double s : {0.1, 2.0, 5.5}) {
      m.right_hand_side(0, s, y.data(), a.data());
      expected.right_hand_side(0, s, y.data(), b.data());
      constexpr double rounding = 1e-12;  // of constants that are made by factors
      for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], rounding * (1.0 + std::abs(b[k]))) << k;
    }
  }
}

TEST(Ramp, OrdersAreAmplitudesOfASteadyResponse) {
  // A rate of nothing: the linear response e Omega^2 / sqrt((1 - Omega^2)^2 + (2 z Omega)^2) at order 1, nothing else.
  constexpr double z = 0.05;
  constexpr double e = 0.05;
  const gear::Stage stage = linear_pair(z, 0.4, e);
  RampOptions options;
  options.from = 0.8;
  options.to = 0.8003;
  options.rate_per_tau = 1e-6;
  options.hold_periods = 60;
  options.directions = {Direction::up};
  options.window_periods = 6;
  const auto result = run_ramp(stage, model::scales_of(stage), {}, options, {}, tight());
  ASSERT_TRUE(result);
  ASSERT_GE(result->windows.size(), 6U);
  const RampWindow& w = result->windows[3];
  const double steady = e * w.omega * w.omega / std::hypot(1.0 - w.omega * w.omega, 2.0 * z * w.omega);
  constexpr double moving = 1e-4;  // a speed that changes by 5e-5 in a window
  EXPECT_NEAR(w.orders[6], steady, moving * steady);
  EXPECT_NEAR(w.delta_rms, steady / std::numbers::sqrt2, moving * steady);
  EXPECT_NEAR(w.delta_mean, 0.4, moving * steady);
  for (const std::size_t k : {3U, 9U, 12U, 18U, 24U}) EXPECT_LT(w.orders[k], moving * steady) << k;
}

TEST(Ramp, TorqueFollowsTheGivenCourse) {
  const gear::Stage stage = linear_pair(0.1, 0.4, 0.0);
  const model::Scales scales = model::scales_of(stage);
  RampOptions options;
  options.from_sun_speed_rpm = 3000.0;
  options.to_sun_speed_rpm = 6000.0;
  options.rate_rpm_per_s = 6000.0;
  options.directions = {Direction::up};
  const double nominal = *stage.load.torque_Nm;
  options.torque_time_s = {0.0, 0.5};
  options.torque_Nm = {nominal, 3.0 * nominal};
  const auto result = run_ramp(stage, scales, {}, options, {}, {});
  ASSERT_TRUE(result);
  ASSERT_GT(result->windows.size(), 10U);
  for (const RampWindow& w : result->windows) {
    const double time = w.tau / scales.omega_sn;
    EXPECT_NEAR(w.torque_Nm, nominal * (1.0 + 4.0 * std::min(time, 0.5)), 1e-9 * nominal);
    // The speed is that of the clock, and the slow torque bends the mesh by F / k.
    EXPECT_NEAR(w.omega * gear::rpm * gear::speeds(stage, scales.omega_sn).sun, 3000.0 + 6000.0 * time, 1e-6);
    EXPECT_NEAR(w.delta_mean, 0.4 * w.torque_Nm / nominal, 0.01);
  }
}

TEST(Ramp, IsResumedWithTheSameBits) {
  gear::Stage stage = problems::torsional_pair();
  const model::Scales scales = model::scales_of(stage);
  RampOptions options;
  options.from = 0.5;
  options.to = 0.8;
  options.rate_per_tau = 2.5e-4;
  options.hold_periods = 20;
  std::vector<std::vector<double>> kept;
  RampControl control;
  control.keep = [&](std::span<const double> numbers) { kept.emplace_back(numbers.begin(), numbers.end()); };
  const auto whole = run_ramp(stage, scales, {}, options, {}, {}, control);
  ASSERT_TRUE(whole);
  const auto all = kept;
  ASSERT_GT(all.size(), 5U);
  for (const std::size_t known : {std::size_t{0}, std::size_t{1}, std::size_t{3}, all.size() - 1, all.size()}) {
    kept.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(known));
    std::size_t next = 0;
    control.recall = [&](std::size_t numbers) -> std::optional<std::vector<double>> {
      if (next == known) return std::nullopt;
      EXPECT_EQ(all[next].size(), numbers);
      return all[next++];
    };
    const auto resumed = run_ramp(stage, scales, {}, options, {}, {}, control);
    ASSERT_TRUE(resumed);
    EXPECT_EQ(kept, all) << known;
    ASSERT_EQ(resumed->windows.size(), whole->windows.size());
    for (std::size_t k = 0; k < whole->windows.size(); ++k) {
      EXPECT_EQ(resumed->windows[k].tau, whole->windows[k].tau);
      EXPECT_EQ(resumed->windows[k].omega, whole->windows[k].omega);
      EXPECT_EQ(resumed->windows[k].orders, whole->windows[k].orders);
      EXPECT_EQ(resumed->windows[k].force_max, whole->windows[k].force_max);
    }
  }
}

TEST(Ramp, SpeedsThatDoNotRiseAreRefused) {
  const gear::Stage stage = problems::torsional_pair();
  RampOptions options;
  options.from = 0.8;
  options.to = 0.8;
  options.rate_per_tau = 1e-3;
  EXPECT_THROW((void)ramp_course(options, stage, model::scales_of(stage)), DomainError);
  options.to = 1.0;
  options.rate_per_tau = 1e-12;
  EXPECT_THROW((void)ramp_course(options, stage, model::scales_of(stage)), DomainError);
}

TEST(Ramp, InertiaTorqueIsThatOfTheTrainsKineticEnergy) {
  // A pair by hand: (I_1 + I_2 (z_1 / z_2)^2) alpha_1.
  const gear::Stage pair = problems::torsional_pair();
  const double i_1 = 1.0 * 0.042 * 0.042;
  const double i_2 = 3.0 * 0.084 * 0.084;
  const double rate = 900.0;  // of the mesh frequency: alpha_1 = 30 rad/s^2
  EXPECT_NEAR(inertia_torque_Nm(pair, rate), (i_1 + i_2 / 4.0) * 30.0, 1e-12);
}

TEST(Ramp, InertiaTorqueIsThatOfAllMembersThatRotate) {
  // Speeds by Willis' equation, z_s (w_s - w_c) = -z_r (w_r - w_c) = -z_p (w_p - w_c) = w_m, from what is held.
  constexpr double rate = 50.0;
  const gear::Stage r1 = problems::r1();
  for (const gear::Stage& s : {r1, problems::star(r1), problems::fixed_sun(r1), problems::differential(r1)}) {
    const double z_s = *s.sun.teeth;
    const double z_r = *s.ring.teeth;
    const double z_p = *s.planet.teeth;
    const double held_carrier = s.boundary == gear::Boundary::fixed_ring  ? 1.0 / z_r
                                : s.boundary == gear::Boundary::fixed_sun ? -1.0 / z_s
                                                                          : 0.0;
    const double ratio = s.carrier_to_sun_speed.value_or(0.0);
    const double carrier = s.boundary == gear::Boundary::free ? ratio / (z_s * (1.0 - ratio)) : held_carrier;
    const double sun = carrier + 1.0 / z_s;
    const double ring = carrier - 1.0 / z_r;
    const double planet = carrier - 1.0 / z_p;
    const auto inertia = [](double over_r2, double radius_mm) { return over_r2 * radius_mm * radius_mm * 1e-6; };
    const double r_c = *s.centre_distance_mm;
    const double m = s.planet.mass_kg;
    const double energy = inertia(s.sun.inertia_over_r2_kg, *s.sun.base_radius_mm) * sun * sun +
                          inertia(s.ring.inertia_over_r2_kg, *s.ring.base_radius_mm) * ring * ring +
                          inertia(s.carrier.inertia_over_r2_kg + 3.0 * m, r_c) * carrier * carrier +
                          3.0 * inertia(s.planet.inertia_over_r2_kg, *s.planet.base_radius_mm) * planet * planet;
    const double about = s.boundary == gear::Boundary::fixed_sun ? -carrier : sun;
    EXPECT_NEAR(inertia_torque_Nm(s, rate) / (energy * rate / about), 1.0, 1e-12) << static_cast<int>(s.boundary);
  }
}

TEST(Ramp, OfAHeldSunIsNotGivenByItsSpeed) {
  const gear::Stage stage = problems::fixed_sun(problems::r1());
  const model::Scales scales = model::scales_of(stage);
  RampOptions options;
  options.from = 0.5;
  options.to = 0.8;
  options.rate_rpm_per_s = 100.0;
  EXPECT_THROW((void)ramp_course(options, stage, scales), DomainError);
  options.rate_rpm_per_s.reset();
  options.rate_per_tau = 1e-4;
  EXPECT_GT(ramp_course(options, stage, scales).windows, 0);
}

}  // namespace
}  // namespace epicyclic::studies::ramp_test
