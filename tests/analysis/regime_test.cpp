// Regimes of systems for which theory or exact computation says what they are.

#include "analysis/regime.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/regime_flows.hpp"
#include "core/errors.hpp"
#include "integrate/make_field.hpp"
#include "integrate/make_flow.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::analysis::regime_test {
namespace {

bool always() { return true; }

Classification regime_of(const VectorField& field, std::vector<double> y, const RegimeOptions& options = {},
                         double tolerance = 1e-10) {
  integrate::IntegratorOptions o;
  o.relative_tolerance = o.absolute_tolerance = tolerance;
  const auto flow = integrate::make_flow(field, o);
  return classify(*flow, y, options, always);
}

TEST(Regime, DuffingsCascade) {
  // The flips of docs/theory/published_results.md, section 4, are at 0.26558, 0.28541, 0.28967: between them periods 1,
  // 2, 4, and chaos at 0.5.
  for (const auto& [g, period] :
       {std::pair{0.20, 1}, {0.26, 1}, {0.27, 2}, {0.28, 2}, {0.29, 4}, {0.37, 5}, {0.65, 2}}) {
    const Classification c = regime_of(problems::duffing(0.3, -1.0, g, 1.2), {1.0, 0.0});
    EXPECT_EQ(c.regime, Regime::periodic) << g << ": " << c.evidence.note;
    EXPECT_EQ(c.period, period) << g << ": " << c.evidence.note;
    ASSERT_TRUE(c.orbit.has_value());
    EXPECT_LT(c.evidence.largest_multiplier, 1.0);
    constexpr double closed = 3e-9;  // RegimeOptions::residual, in parts of components of up to 3
    EXPECT_LT(c.evidence.residual, closed);
    EXPECT_LT(c.evidence.exponent.value, 0.0);
  }
  const Classification c = regime_of(problems::duffing(0.3, -1.0, 0.5, 1.2), {1.0, 0.0});
  EXPECT_EQ(c.regime, Regime::chaotic) << c.evidence.note;
  EXPECT_GT(c.evidence.exponent.low(), 0.0);
  EXPECT_GT(c.evidence.zero_one.value(), 0.5);
}

TEST(Regime, ASlowTransientIsProvenBeforeItIsOver) {
  // A linear oscillator of damping 1e-3: after 64 periods e^-0.4 of its start is left, and the orbit is known.
  const auto field =
      integrate::make_field(2, 2.0 * std::numbers::pi, [](std::size_t, double s, const auto* y, auto* d) {
        d[0] = y[1];
        d[1] = -2e-3 * y[1] - 2.0 * y[0] + std::cos(s);
      });
  const Classification c = regime_of(field, {5.0, 0.0});
  EXPECT_EQ(c.regime, Regime::periodic) << c.evidence.note;
  EXPECT_EQ(c.period, 1);
  EXPECT_LE(c.evidence.periods, 64);
  constexpr double times_the_steps = 2e-9;  // tolerance 1e-10, some twenty steps
  EXPECT_NEAR(c.evidence.largest_multiplier, std::exp(-1e-3 * field.period), times_the_steps);
  // x = cos s, but for the square of the damping, 4e-6.
  constexpr double of_second_order = 1e-5;
  EXPECT_NEAR(c.orbit->state[0], 1.0, of_second_order);
}

TEST(Regime, ASectionThatWasSeenIsNotLookedAtAgain) {
  // Period 2, proven from the section alone; chaos, from one look that is long enough for growth.
  for (const auto& [g, periodic] : {std::pair{0.28, true}, {0.5, false}}) {
    const auto flow = integrate::make_flow(problems::duffing(0.3, -1.0, g, 1.2), {});
    std::vector<double> y = {1.0, 0.0};
    const Strobe seen = strobe(
        *flow, y, {.transient_periods = 100, .recorded_periods = 128, .phases = 1}, [](auto&&...) {}, always);
    RegimeOptions options;
    options.lasting = 256;
    const Classification c = classify(*flow, y, options, always, &seen.section);
    EXPECT_EQ(c.regime, periodic ? Regime::periodic : Regime::chaotic) << c.evidence.note;
    EXPECT_EQ(c.evidence.periods, periodic ? 0 : 128);
    EXPECT_EQ(c.period, periodic ? 2 : 0);
  }
}

TEST(Regime, TheStatedErrorOfAMultiplierHoldsIt) {
  // At several tolerances, against one that is far tighter.
  const auto field = problems::duffing(0.3, -1.0, 0.27, 1.2);
  const auto at = [&](double tolerance) {
    integrate::IntegratorOptions o;
    o.relative_tolerance = o.absolute_tolerance = tolerance;
    const auto flow = integrate::make_flow(field, o);
    o.relative_tolerance = o.absolute_tolerance = 10.0 * tolerance;
    const auto coarser = integrate::make_flow(field, o);
    RegimeOptions options;
    options.coarser = coarser.get();
    options.residual = std::max(options.residual, 3.0 * tolerance);
    std::vector<double> y = {1.0, 0.0};
    return classify(*flow, y, options, always);
  };
  const Classification exact = at(1e-12);
  ASSERT_EQ(exact.regime, Regime::periodic);
  for (const double tolerance : {1e-6, 1e-7, 1e-8, 1e-9}) {
    const Classification c = at(tolerance);
    ASSERT_EQ(c.regime, Regime::periodic);
    const double off = std::abs(c.evidence.largest_multiplier - exact.evidence.largest_multiplier);
    EXPECT_LT(off, c.evidence.multiplier_error) << tolerance;
    EXPECT_LT(c.evidence.multiplier_error, 1e5 * tolerance);
    const double exponent = std::log(exact.evidence.largest_multiplier) / (2.0 * field.period);
    EXPECT_LT(std::abs(c.evidence.exponent.value - exponent), c.evidence.exponent.half_width);
  }
}

TEST(Regime, ForcedVanDerPolIsATorusOrLocked) {
  // Far from its own frequency a torus; forced hard, locked to the forcing.
  for (const double w : {1.7, 2.3, 0.62}) {
    const Classification c = regime_of(problems::van_der_pol(0.3, 0.4, w), {1.0, 0.0});
    EXPECT_EQ(c.regime, Regime::quasiperiodic) << w << ": " << c.evidence.note;
    EXPECT_LT(std::abs(c.evidence.exponent.value), 0.02);
  }
  for (const double w : {0.9, 1.0, 1.1}) {
    const Classification c = regime_of(problems::van_der_pol(0.3, 3.0, w), {1.0, 0.0});
    EXPECT_EQ(c.regime, Regime::periodic) << w << ": " << c.evidence.note;
    EXPECT_EQ(c.period, 1);
  }
}

TEST(Regime, WhatReturnsAfterMorePeriodsThanAreTriedIsNoTorus) {
  // On the limit cycle of a Hopf normal form that turns by a part of a turn per period: by 5/24 each motion returns
  // after 24 periods, by 0.2083... nearly so and never.
  for (const auto& [turn, returns] : {std::pair{5.0 / 24.0, true}, {5.0 / 24.0 + 0.0031, false}}) {
    RegimeOptions options;
    options.budget = 4096;
    const Classification c = regime_of(problems::forced_hopf(turn)(0.05), {1.2, 0.1}, options);
    EXPECT_EQ(c.regime, returns ? Regime::undecided : Regime::quasiperiodic) << turn << ": " << c.evidence.note;
  }
}

TEST(Regime, ThereIsNoTorusWhereTheMapShrinksAllAreas) {
  // A motion that comes to an orbit of period 16, more than are tried, within thousands of periods.
  VectorField field = problems::clearance_oscillator(1.046536849, 0.0, {0.06, 0.12, 0.25});
  RegimeOptions options;
  options.longest_period = 4;
  options.budget = 1024;
  const Classification c = regime_of(field, {0.830963, 0.059196}, options);
  EXPECT_EQ(c.regime, Regime::undecided) << c.evidence.note;
  EXPECT_NE(c.evidence.note.find("shrinks all areas"), std::string::npos) << c.evidence.note;
}

TEST(Regime, ChaosInBandsIsChaos) {
  // Duffing's attractor of several bands, through which the motion goes in turn: the 0-1 test of the plain section says
  // regular, and vectors grow by e^100 and more.
  const Classification c = regime_of(problems::duffing(0.3, -1.0, 0.34493670886075951, 1.2), {1.0, 0.0}, {}, 1e-9);
  EXPECT_EQ(c.regime, Regime::chaotic) << c.evidence.note;
  EXPECT_GT(c.evidence.exponent.low(), 0.0);
}

TEST(Regime, TheClearanceOscillatorIsPeriodic) {
  for (const double w : {0.5, 0.7, 0.85, 1.0, 1.3}) {
    const Classification c = regime_of(problems::clearance_oscillator(w), {1.1, 0.0});
    EXPECT_EQ(c.regime, Regime::periodic) << w << ": " << c.evidence.note;
  }
}

TEST(Regime, LorenzSeenOnceInAWhileIsChaotic) {
  VectorField field = problems::lorenz();
  field.period = 1.0;
  const Classification c = regime_of(field, {1.0, 1.0, 20.0});
  EXPECT_EQ(c.regime, Regime::chaotic) << c.evidence.note;
  EXPECT_NEAR(c.evidence.exponent.value, 0.9053, 2.0 * c.evidence.exponent.half_width);
}

TEST(Regime, WhatGrowsIntoAContactBeforeItShrinksIsNotDrawn) {
  // A forced oscillator, and beside it a shear: a difference v makes u seventeen times as large within a period, and
  // eighteen times soon after, where a contact at u = 0.01 drives the motion to another orbit, at u = 1.4. The first
  // return is what the orbit's monodromy has it be.
  const auto field =
      integrate::make_field(4, 2.0 * std::numbers::pi, [](std::size_t, double s, const auto* y, auto* d) {
        d[0] = y[1];
        d[1] = -0.2 * y[1] - 2.0 * y[0] + std::cos(s);
        d[2] = -0.1 * y[2] + 5.0 * y[3] - y[2] * y[2] * y[2];
        if (y[2] > 0.01) d[2] += 2.0 * (y[2] - 0.01);
        d[3] = -0.1 * y[3];
      });
  const double amplitude = 1.0 / 1.04;
  for (const auto& [v, contact] : {std::pair{1e-4, false}, {5.7e-4, true}}) {
    PoincareSection seen{.dimension = 4, .states = {}};
    std::vector<double> y = {amplitude, 0.2 * amplitude, 0.0, 0.0};
    for (int k = 0; k < 63; ++k) seen.states.insert(seen.states.end(), y.begin(), y.end());
    y[3] = v;
    seen.states.insert(seen.states.end(), y.begin(), y.end());
    integrate::IntegratorOptions o;
    o.relative_tolerance = o.absolute_tolerance = 1e-10;
    const auto flow = integrate::make_flow(field, o);
    const Classification c = classify(*flow, y, {}, always, &seen);
    ASSERT_EQ(c.regime, Regime::periodic) << c.evidence.note;
    EXPECT_EQ(c.evidence.periods > 0, contact) << v;  // where there is one the section seen does not tell
    if (contact)
      EXPECT_NEAR(c.orbit->state[2], 1.37, 0.01);  // 1.9 u = 0.02 + u^3
    else
      EXPECT_NEAR(c.orbit->state[2], 0.0, 1e-8);  // tolerance 1e-10, held up by the shear
  }
}

TEST(Regime, AMotionThatRepelsIsLeft) {
  // A forced oscillator, and beside it d, which rests at 0 for ever if it begins there and is drawn to +-0.1 if not:
  // vectors grow by e^0.06 a period, slowly enough for a look to see nothing but the orbit.
  constexpr double repelled = 0.01;
  const auto field =
      integrate::make_field(3, 2.0 * std::numbers::pi, [](std::size_t, double s, const auto* y, auto* d) {
        d[0] = y[1];
        d[1] = -0.2 * y[1] - 2.0 * y[0] + std::cos(s);
        d[2] = repelled * y[2] - y[2] * y[2] * y[2];
      });
  const Classification c = regime_of(field, {0.5, 0.0, 0.0});
  ASSERT_EQ(c.regime, Regime::periodic) << c.evidence.note;
  EXPECT_EQ(c.period, 1);
  constexpr double times_the_condition = 1e-9;  // tolerance 1e-10, held up by a multiplier of e^-0.13
  EXPECT_NEAR(std::abs(c.orbit->state[2]), std::sqrt(repelled), times_the_condition);
  EXPECT_LT(c.evidence.periods, 1024);
}

TEST(Regime, ASlowSpiralOffAnOrbitIsNotChaos) {
  // At rest in its middle, from where a torus of radius 10 is reached in 1000 periods: meanwhile vectors grow, and to
  // the 0-1 test the spiral is as good as chaos. So is one beside it that begins at the radius `settling`.
  for (const double turns : {0.1234, 0.3819, 0.51, 0.7071})
    for (const double settling : {0.0, 0.0003}) {
      const auto field =
          integrate::make_field(5, 2.0 * std::numbers::pi, [turns](std::size_t, double s, const auto* y, auto* d) {
            const auto pull = 0.0014 * (1.0 - 0.01 * (y[0] * y[0] + y[1] * y[1]));
            const auto beside = 0.0014 * (1.0 - 0.01 * (y[3] * y[3] + y[4] * y[4]));
            d[0] = pull * y[0] - turns * y[1];
            d[1] = pull * y[1] + turns * y[0];
            d[2] = -0.001 * y[2] + std::cos(s);
            d[3] = beside * y[3] - turns * y[4];
            d[4] = beside * y[4] + turns * y[3];
          });
      RegimeOptions o;
      o.budget = 3584;
      o.lasting = o.budget / 4;
      o.observable = settling > 0.0 ? 3 : 0;
      const Classification c = regime_of(field, {0.0, 0.0, 0.0, settling, 0.0}, o, 1e-8);
      EXPECT_TRUE(c.regime == Regime::quasiperiodic || c.regime == Regime::undecided)
          << turns << ", " << settling << ": " << to_string(c.regime) << ", " << c.evidence.note;
    }
}

TEST(Regime, GrowthWithARegularSectionHasToLastForTheWholeBudget) {
  // At rest y[2] repels; pushed off, it comes to a second orbit. From there y[3] grows for a thousand periods, by more
  // than e^16 in half of all, while the oscillator that the 0-1 test looks at knows of neither.
  const double rate = 0.0045;
  const auto field =
      integrate::make_field(4, 2.0 * std::numbers::pi, [rate](std::size_t, double s, const auto* y, auto* d) {
        d[0] = y[1];
        d[1] = -0.2 * y[1] - 2.0 * y[0] + std::cos(s);
        d[2] = rate * y[2] * (1.0 - y[2] * y[2]);
        d[3] = rate * y[3] * (2.0 * y[2] * y[2] - 1.0 - y[3] * y[3]);
      });
  RegimeOptions o;
  o.budget = 3584;
  o.lasting = o.budget / 4;
  const Classification c = regime_of(field, {0.5, 0.0, 0.0, 1e-6}, o);
  ASSERT_EQ(c.regime, Regime::periodic) << c.evidence.note;
  constexpr double times_the_condition = 2e-9;  // tolerance 1e-10, held up by a multiplier of e^-0.06
  EXPECT_NEAR(std::abs(c.orbit->state[3]), 1.0, times_the_condition);
}

TEST(Regime, ThreeFlowsOfOneSystemTellItsOrbitAtItsTolerance) {
  integrate::IntegratorOptions o;
  o.relative_tolerance = o.absolute_tolerance = 1e-9;
  const RegimeFlows flows = make_regime_flows(problems::duffing(0.3, -1.0, 0.2, 1.2), o);
  std::vector<double> y = {1.0, 0.0};
  const Classification c = classify(*flows.windows, y, flows.options(), always);
  ASSERT_EQ(c.regime, Regime::periodic) << c.evidence.note;
  // The looks are a hundred times looser, the orbit is not.
  o.relative_tolerance = o.absolute_tolerance = 1e-12;
  const auto tight = integrate::make_flow(problems::duffing(0.3, -1.0, 0.2, 1.2), o);
  const PeriodicOrbit orbit = find_periodic_orbit(*tight, c.orbit->state, c.period);
  constexpr double times_the_condition = 1e-7;  // tolerance 1e-9, some hundred steps
  EXPECT_NEAR(orbit.state[0], c.orbit->state[0], times_the_condition);
  EXPECT_GT(c.evidence.multiplier_error, 0.0);
  EXPECT_GT(flows.right_hand_side_calls(), flows.windows->right_hand_side_calls());
}

TEST(Regime, AnEscapeHasNone) {
  const auto field =
      integrate::make_field(1, 1.0, [](std::size_t, double, const auto* y, auto* d) { d[0] = y[0] * y[0]; });
  const Classification c = regime_of(field, {1.0});
  EXPECT_FALSE(c.evolution.reached());
  EXPECT_EQ(c.regime, Regime::undecided);
}

TEST(Regime, WithinASmallBudgetItSaysThatItDoesNotKnow) {
  RegimeOptions options;
  options.budget = 64;
  const Classification c = regime_of(problems::duffing(0.3, -1.0, 0.5, 1.2), {1.0, 0.0}, options);
  EXPECT_EQ(c.regime, Regime::undecided);
  EXPECT_EQ(c.evidence.periods, 64);
  EXPECT_FALSE(c.evidence.note.empty());
}

TEST(Regime, StopsWhenTold) {
  const auto flow = integrate::make_flow(problems::duffing(0.3, -1.0, 0.5, 1.2), {});
  std::vector<double> y = {1.0, 0.0};
  int left = 10;
  const Classification c = classify(*flow, y, {}, [&] { return left-- > 0; });
  EXPECT_EQ(c.regime, Regime::undecided);
  EXPECT_EQ(c.evidence.periods, 10);
}

TEST(Regime, RefusesAFieldWithoutAPeriod) {
  EXPECT_THROW((void)regime_of(problems::lorenz(), {1.0, 1.0, 20.0}), DomainError);
}

}  // namespace
}  // namespace epicyclic::analysis::regime_test
