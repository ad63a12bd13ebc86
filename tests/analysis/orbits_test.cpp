// Periodic orbits by Newton's method and largest exponents, on systems whose answers are known.

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/lyapunov.hpp"
#include "analysis/periodic_orbit.hpp"
#include "core/dense.hpp"
#include "integrate/make_field.hpp"
#include "integrate/make_flow.hpp"
#include "problems/clearance_exact.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::analysis::orbits_test {
namespace {

integrate::IntegratorOptions tight(double tolerance = 1e-13) {
  integrate::IntegratorOptions o;
  o.relative_tolerance = tolerance;
  o.absolute_tolerance = tolerance;
  o.max_steps_per_period = 1000000;
  return o;
}

bool always() { return true; }

// Half a unit of the tenth digit of g that the source prints, times the multiplier's slope in g, 25.
constexpr double flip = 2e-9;
// A pair of multipliers beats: a logarithm of order 1 over 2000 periods of 2 pi, 8e-5, or more.
constexpr double beat = 1e-4;

TEST(PeriodicOrbit, DuffingsFlipOrbitIsThePublishedOne) {
  const auto flow = integrate::make_flow(problems::duffing(0.3, -1.0, 0.2655817861, 1.2), tight());
  const std::array<double, 2> near = {0.42, 0.31};
  const PeriodicOrbit orbit = find_periodic_orbit(*flow, near, 1);
  ASSERT_TRUE(orbit.found()) << orbit.message;
  constexpr double digits = 1e-9;  // of the published state, which moves fast with g at a flip
  EXPECT_NEAR(orbit.state[0], 0.4075754662, digits);
  EXPECT_NEAR(orbit.state[1], 0.3226140050, digits);
  const auto multipliers = epicyclic::eigenvalues(orbit.monodromy);
  const double least = std::min(multipliers[0].real(), multipliers[1].real());
  EXPECT_NEAR(least, -1.0, flip);
}

TEST(PeriodicOrbit, NewtonConvergesQuadraticallyAcrossKinks) {
  const auto flow = integrate::make_flow(problems::clearance_oscillator(0.85), tight());
  const std::array<double, 2> near = {0.9, -0.1};
  const PeriodicOrbit orbit = find_periodic_orbit(*flow, near, 1);
  ASSERT_TRUE(orbit.found()) << orbit.message;
  const auto exact = problems::ClearanceExact(0.85).periods({1.1, 0.0}, 300);
  constexpr double accuracy = 1e-11;
  EXPECT_NEAR(orbit.state[0], exact[0], accuracy);
  EXPECT_NEAR(orbit.state[1], exact[1], accuracy);
  EXPECT_LE(orbit.residuals.size(), 6U);
}

TEST(PeriodicOrbit, KeptTangentsLeadToTheSameOrbitForLess) {
  integrate::IntegratorOptions controlled = tight();
  controlled.tangent_error_control = true;
  const auto flow = integrate::make_flow(problems::clearance_oscillator(0.85), controlled);
  const std::array<double, 2> near = {0.876, -0.132};
  const PeriodicOrbit full = find_periodic_orbit(*flow, near, 1);
  const long with_all = flow->work().tangent_right_hand_sides;
  const PeriodicOrbit kept = find_periodic_orbit(*flow, near, 1, {.keep_tangents = true});
  const long with_few = flow->work().tangent_right_hand_sides - with_all;
  ASSERT_EQ(full.outcome, OrbitOutcome::converged) << full.message;
  ASSERT_EQ(kept.outcome, OrbitOutcome::converged) << kept.message;
  constexpr double accuracy = 1e-10;  // ten residuals
  EXPECT_NEAR(kept.state[0], full.state[0], accuracy);
  EXPECT_NEAR(kept.state[1], full.state[1], accuracy);
  // The monodromy is one of where the iteration began, 3e-4 away.
  constexpr double of_first_order = 1e-2;  // that distance times slopes of some 10
  EXPECT_LT((kept.monodromy - full.monodromy).cwiseAbs().maxCoeff(), of_first_order);
  EXPECT_LT(with_few, with_all);
}

TEST(PeriodicOrbit, AnUnstableOrbitIsFoundToo) {
  // Duffing at g = 0.28: period 2 attracts, the period-1 orbit has lost its stability at 0.26558.
  const auto flow = integrate::make_flow(problems::duffing(0.3, -1.0, 0.28, 1.2), tight());
  const std::array<double, 2> near = {0.4075, 0.3226};
  const PeriodicOrbit orbit = find_periodic_orbit(*flow, near, 1);
  ASSERT_TRUE(orbit.found()) << orbit.message;
  EXPECT_GT(epicyclic::eigenvalues(orbit.monodromy).cwiseAbs().maxCoeff(), 1.0);
}

TEST(PeriodicOrbit, WithoutAnOrbitItSaysSo) {
  // x'' = cos s + 1: drifts away for ever, whatever the start.
  const auto field = integrate::make_field(2, 6.283185307179586, [](std::size_t, double s, const auto* y, auto* d) {
    d[0] = y[1];
    d[1] = 0.0 * y[0] + std::cos(s) + 1.0;
  });
  const auto flow = integrate::make_flow(field, tight(1e-10));
  const std::array<double, 2> near = {0.0, 0.0};
  const PeriodicOrbit orbit = find_periodic_orbit(*flow, near, 1);
  EXPECT_FALSE(orbit.found());
  EXPECT_FALSE(orbit.message.empty());
}

TEST(PeriodicOrbit, ACoarseMethodsOrbitIsDisplacedByItsOwnError) {
  const auto fine = integrate::make_flow(problems::clearance_oscillator(0.85), tight());
  const std::array<double, 2> near = {0.9, -0.1};
  const PeriodicOrbit orbit = find_periodic_orbit(*fine, near, 1);
  const auto coarse = integrate::make_flow(problems::clearance_oscillator(0.85), tight(1e-6));
  const std::vector<double> displaced = displaced_orbit(*coarse, orbit, 1, 3);
  ASSERT_EQ(displaced.size(), 2U);
  // What the coarse method settles to on its own.
  std::vector<double> settled = {1.1, 0.0};
  for (int k = 0; k < 300; ++k) {
    coarse->forget();
    ASSERT_TRUE(coarse->evolve(settled, 0.0, coarse->field().period).reached());
  }
  const double moved = std::hypot(displaced[0] - orbit.state[0], displaced[1] - orbit.state[1]);
  const double left = std::hypot(displaced[0] - settled[0], displaced[1] - settled[1]);
  constexpr double above_the_fine_orbits_error = 1e-8;  // which is some tolerances of 1e-13
  EXPECT_GT(moved, above_the_fine_orbits_error);
  EXPECT_LT(left, 0.05 * moved);
}

TEST(MultipleShooting, FindsTheSameOrbitInAnyNumberOfPieces) {
  // Duffing's orbit of period 2, and the clearance oscillator's across its kinks.
  for (const auto& [field, near, n] : {std::tuple{problems::duffing(0.3, -1.0, 0.28, 1.2), std::array{0.5, 0.0}, 2},
                                       std::tuple{problems::clearance_oscillator(0.85), std::array{0.9, -0.1}, 1}}) {
    // Kinks leave errors of 1e-5 in tangents that are not controlled, at a tolerance of 1e-13.
    integrate::IntegratorOptions controlled = tight();
    controlled.tangent_error_control = true;
    const auto flow = integrate::make_flow(field, controlled);
    std::vector<double> y(near.begin(), near.end());
    for (int k = 0; k < 200; ++k) ASSERT_TRUE(flow->evolve(y, 0.0, field.period).reached());
    const PeriodicOrbit one = find_periodic_orbit(*flow, y, n);
    ASSERT_TRUE(one.found()) << one.message;
    constexpr double ten_residuals = 1e-10;
    constexpr double of_the_tangents = 1e-9;  // measured: kinks leave 5e-11 in tangents, and pieces begin steps anew
    // Settled, the motion is the orbit already: from beside it Newton's method has steps to make.
    std::vector<double> beside = y;
    beside[0] += 1e-3;
    for (const int shooting_intervals : {2, 3, 7}) {
      const PeriodicOrbit many = find_periodic_orbit(*flow, beside, n, {.shooting_intervals = shooting_intervals});
      ASSERT_TRUE(many.found()) << many.message;
      EXPECT_EQ(many.interval_maps.size(), static_cast<std::size_t>(shooting_intervals));
      EXPECT_NEAR(many.state[0], one.state[0], ten_residuals);
      EXPECT_NEAR(many.state[1], one.state[1], ten_residuals);
      EXPECT_LT((many.monodromy - one.monodromy).cwiseAbs().maxCoeff(), of_the_tangents);
    }
  }
}

TEST(MultipleShooting, HoldsAnUnstableOrbitTakenManyTimes) {
  // Duffing's orbit of period 1 beside chaos, as one of period 8: its largest multiplier is then the eighth power.
  const auto flow = integrate::make_flow(problems::duffing(0.3, -1.0, 0.5, 1.2), tight(1e-13));
  const std::array<double, 2> rough = {0.4, 0.3};
  const PeriodicOrbit once = find_periodic_orbit(*flow, rough, 1, {.iterations = 40});
  ASSERT_TRUE(once.found()) << once.message;
  const double multiplier = largest_multiplier(once);
  ASSERT_GT(multiplier, 1.5);
  std::vector<double> off = once.state;
  off[0] += 1e-7;
  const PeriodicOrbit shooting_intervals =
      find_periodic_orbit(*flow, off, 8, {.iterations = 30, .shooting_intervals = 32});
  ASSERT_TRUE(shooting_intervals.found()) << shooting_intervals.message;
  constexpr double of_the_state = 1e-12;         // ten tolerances of 1e-13
  constexpr double of_the_eighth_power = 1e-10;  // the tolerance times some hundred steps, in 8 factors
  EXPECT_NEAR(shooting_intervals.state[0], once.state[0], of_the_state);
  EXPECT_NEAR(shooting_intervals.state[1], once.state[1], of_the_state);
  EXPECT_NEAR(largest_multiplier(shooting_intervals) / std::pow(multiplier, 8), 1.0, of_the_eighth_power);
}

TEST(Multipliers, OfDuffingsFlipWithTheirErrors) {
  const VectorField field = problems::duffing(0.3, -1.0, 0.2655817861, 1.2);
  const std::array<double, 2> near = {0.42, 0.31};
  const auto fine = integrate::make_flow(field, tight(1e-13));
  const auto coarse = integrate::make_flow(field, tight(1e-11));
  const PeriodicOrbit orbit = find_periodic_orbit(*fine, near, 1);
  const FloquetMultipliers m = floquet_multipliers(orbit, find_periodic_orbit(*coarse, near, 1));
  EXPECT_EQ(m.critical, 0U);
  EXPECT_NEAR(m.values[0].real(), -1.0, flip);
  EXPECT_EQ(m.values[0].imag(), 0.0);
  // Their product is exp(-0.3 * 2 pi / 1.2).
  constexpr double of_the_product = 1e-11;  // the tolerance of 1e-13 over a hundred steps
  EXPECT_NEAR((m.values[0] * m.values[1]).real(), std::exp(-0.3 * field.period), of_the_product);
  constexpr double told = 1e-9;  // the coarse tolerance of 1e-11 over a hundred steps
  for (const double e : m.errors) EXPECT_LT(e, told);
  EXPECT_EQ(m.multiplicity, (std::vector<int>{1, 1}));
  EXPECT_LT(std::abs(m.margin()), flip);
}

TEST(Multipliers, EqualOnesAreCountedTogether) {
  // Three uncoupled, equal oscillators: each multiplier three times.
  const auto field = integrate::make_field(6, 6.283185307179586, [](std::size_t, double s, const auto* y, auto* d) {
    for (std::size_t i = 0; i < 3; ++i) {
      d[2 * i] = y[2 * i + 1];
      d[2 * i + 1] = -0.4 * y[2 * i + 1] - 1.7 * y[2 * i] + std::cos(s);
    }
  });
  const auto fine = integrate::make_flow(field, tight(1e-12));
  const auto coarse = integrate::make_flow(field, tight(1e-10));
  const std::vector<double> zero(6, 0.0);
  const FloquetMultipliers m =
      floquet_multipliers(find_periodic_orbit(*fine, zero, 1), find_periodic_orbit(*coarse, zero, 1));
  ASSERT_EQ(m.values.size(), 6U);
  EXPECT_EQ(m.multiplicity, (std::vector<int>{3, 3, 3, 3, 3, 3}));
  constexpr double times_the_steps = 1e-10;  // tolerance 1e-12, a hundred steps: equal multipliers are not defective
  for (const auto& v : m.values) EXPECT_NEAR(std::abs(v), std::exp(-0.2 * field.period), times_the_steps);
  EXPECT_TRUE(m.stable());
}

TEST(LargestExponent, OfChaoticDuffingIsThePublishedOne) {
  // docs/theory/published_results.md, section 3: 0.1569 per unit of t, within 0.002 or its own interval.
  const auto flow = integrate::make_flow(problems::duffing(0.25, -1.0, 0.4, 1.0), tight(1e-8));
  std::vector<double> y = {1.0, 0.0};
  const LargestExponent e = largest_exponent(*flow, y, {100, 6000}, {}, always);
  ASSERT_TRUE(e.evolution.reached());
  EXPECT_NEAR(e.per_s.value, 0.1569, std::max(0.002, e.per_s.half_width));
  EXPECT_LT(e.per_s.half_width, 0.01);
  EXPECT_GT(e.per_s.low(), 0.0);
}

TEST(LargestExponent, OfAPeriodicMotionWithComplexMultipliersIsHalfTheSum) {
  // x'' + 0.3 x' ... in a period-1 window: multipliers complex or real; where complex, exactly -0.15.
  const auto flow = integrate::make_flow(problems::clearance_oscillator(1.3), tight(1e-10));
  std::vector<double> y = {1.1, 0.0};
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(flow->evolve(y, 0.0, flow->field().period).reached());
  const LargestExponent e = largest_exponent(*flow, y, {50, 4000}, {}, always);
  // Damping 2 z = 0.1 per unit of t, W = 1.3 units of s in one of t.
  const double half_sum = -0.05 / 1.3;
  EXPECT_NEAR(e.per_s.value, half_sum, std::max(beat, e.per_s.half_width));
}

TEST(LargestExponent, OfAnInvariantSubspaceIsThatOfItsDirections) {
  // Two equal forced oscillators on a soft spring between them: in the mean the damping is 0.1, in the difference 0.5.
  const auto field = integrate::make_field(4, 6.283185307179586, [](std::size_t, double s, const auto* y, auto* d) {
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t other = 1 - i;
      d[2 * i] = y[2 * i + 1];
      d[2 * i + 1] = -0.1 * y[2 * i + 1] - 2.0 * y[2 * i] + std::cos(s) + 0.2 * (y[2 * other + 1] - y[2 * i + 1]) +
                     0.3 * (y[2 * other] - y[2 * i]);
    }
  });
  const auto flow = integrate::make_flow(field, tight(1e-10));
  std::vector<double> y = {0.3, 0.0, 0.3, 0.0};
  EXPECT_NEAR(largest_exponent(*flow, y, {50, 2000}, {}, always).per_s.value, -0.05, beat);
  LyapunovOptions transverse{50, 2000};
  transverse.project = [](std::span<double> v) {
    for (std::size_t k = 0; k < 2; ++k) {
      const double mean = 0.5 * (v[k] + v[k + 2]);
      v[k] -= mean;
      v[k + 2] -= mean;
    }
  };
  EXPECT_NEAR(largest_exponent(*flow, y, transverse, {}, always).per_s.value, -0.25, beat);
}

TEST(LargestExponent, StopsWhenTold) {
  const auto flow = integrate::make_flow(problems::duffing(0.25, -1.0, 0.4, 1.0), {});
  std::vector<double> y = {1.0, 0.0};
  int left = 20;
  const LargestExponent e = largest_exponent(*flow, y, {5, 1000}, {}, [&] { return left-- > 0; });
  EXPECT_EQ(e.growth.size(), 15U);
}

}  // namespace
}  // namespace epicyclic::analysis::orbits_test
