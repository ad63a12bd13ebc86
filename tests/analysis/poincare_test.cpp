// Stroboscopic section and period by recurrence on systems with known periods.

#include "analysis/poincare.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "integrate/make_field.hpp"
#include "integrate/sundials/arkode_flow.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::analysis::poincare_test {
namespace {

/// Duffing x'' + 0.3 x' - x + x^3 = g cos 1.2 t (docs/theory/published_results.md, section 4).
VectorField duffing(double g) { return problems::duffing(0.3, -1.0, g, 1.2); }

bool always() { return true; }

Strobe run(double g, const StrobeOptions& options) {
  const auto flow = integrate::make_arkode_flow(duffing(g), {.relative_tolerance = 1e-9, .absolute_tolerance = 1e-11});
  std::vector<double> state = {1.0, 0.0};
  return strobe(
      *flow, state, options, [](std::size_t, double, std::span<const double>) {}, always);
}

// The slowest multiplier among these orbits decays below this within the transient; the chaotic orbit's points are
// farther apart than this by orders of magnitude.
constexpr double same_point = 1e-6;

TEST(Recurrence, FindsThePublishedPeriodsOfDuffing) {
  const struct {
    double g;
    int period;
  } published[] = {{0.20, 1}, {0.28, 2}, {0.29, 4}, {0.37, 5}, {0.65, 2}};
  for (const auto& [g, period] : published) {
    const Strobe s = run(g, {.transient_periods = 600, .recorded_periods = 64});
    ASSERT_TRUE(s.evolution.reached());
    EXPECT_EQ(recurrence(s.section, 16, same_point).period, period) << "g = " << g;
  }
}

TEST(Recurrence, DoesNotFindAPeriodInChaos) {
  const Strobe s = run(0.50, {.transient_periods = 600, .recorded_periods = 128});
  const Recurrence r = recurrence(s.section, 32, same_point);
  EXPECT_EQ(r.period, 0);
  EXPECT_GT(r.error, 1e3 * same_point);
  EXPECT_GT(r.best_period, 0);
}

TEST(Recurrence, ComparesTheWholeStateOverTheWholeRecord) {
  // Period 2 in the second component only, and a slip of the first at the last point.
  PoincareSection section{2, {}};
  for (int k = 0; k < 10; ++k) {
    section.states.push_back(1.0);
    section.states.push_back(k % 2);
  }
  EXPECT_EQ(recurrence(section, 5, 1e-12).period, 2);
  section.states[18] = 1.05;
  EXPECT_EQ(recurrence(section, 5, 1e-12).period, 0);
  EXPECT_EQ(recurrence(section, 5, 0.06).period, 2);
  // A slip of half of what tells period 2 from period 1 leaves no period.
  section.states[18] = 1.5;
  EXPECT_EQ(recurrence(section, 5, 0.6).period, 0);
}

TEST(Recurrence, WhatIsNoNumberDoesNotRecur) {
  PoincareSection section{1, std::vector<double>(10, 1.0)};
  ASSERT_EQ(recurrence(section, 5, 1e-6).period, 1);
  section.states[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(recurrence(section, 5, 1e-6).period, 0);
  EXPECT_FALSE(still_converging(recurrence(section, 5, 1e-6), 1e-6));
}

TEST(Recurrence, CreepTowardsAShortPeriodIsNotALongPeriod) {
  // A slowly decaying beat of 7 periods around a fixed point: y_{k+7} is near y_k, nearer than y_{k+1}, but not by far.
  PoincareSection creeping{1, {}};
  PoincareSection settled{1, {}};
  for (int k = 0; k < 128; ++k) {
    const double beat = std::cos(2.0 * std::numbers::pi * k / 7.0);
    creeping.states.push_back(2e-3 * std::exp(-0.01 * k) * (1.0 + 0.2 * beat));
    settled.states.push_back(1.0 + 0.2 * beat);
  }
  const Recurrence r = recurrence(creeping, 32, 1e-3);
  EXPECT_EQ(r.period, 1);  // within the tolerance from one point to the next
  const Recurrence finer = recurrence(creeping, 32, 2e-4);
  EXPECT_EQ(finer.period, 0);
  EXPECT_TRUE(still_converging(finer, 2e-4));
  EXPECT_EQ(recurrence(settled, 32, 1e-3).period, 7);
}

TEST(Recurrence, ChaosIsNotTakenForSettling) {
  const Strobe s = run(0.50, {.transient_periods = 600, .recorded_periods = 128});
  EXPECT_FALSE(still_converging(recurrence(s.section, 32, 1e-3), 1e-3));
}

TEST(PoincareSet, DistancesAndExtent) {
  PoincareSection a;
  a.dimension = 2;
  a.states = {0.0, 0.0, 1.0, 0.0, 2.0, 5.0};
  PoincareSection b;
  b.dimension = 2;
  b.states = {0.0, 0.25, 4.0, 5.0};
  EXPECT_EQ(farthest_from(a, b), 2.0);  // (4, 5) from (2, 5)
  EXPECT_EQ(farthest_from(b, a), 2.0);
  b.states.resize(2);
  EXPECT_EQ(farthest_from(a, b), 0.25);
  EXPECT_EQ(farthest_from(b, a), 4.75);
  EXPECT_EQ(extent(a), 5.0);
  EXPECT_EQ(extent(b), 0.0);
}

TEST(Strobe, NumberOfPhasesLeavesTheSectionUnchanged) {
  const Strobe coarse = run(0.28, {.transient_periods = 10, .recorded_periods = 8, .phases = 1});
  const Strobe fine = run(0.28, {.transient_periods = 10, .recorded_periods = 8, .phases = 257});
  EXPECT_EQ(coarse.section.states, fine.section.states);
}

TEST(Strobe, ObserverSeesEachPhaseInOrderAndTheLastIsTheSection) {
  const auto flow = integrate::make_arkode_flow(duffing(0.2), {});
  std::vector<double> state = {1.0, 0.0};
  std::size_t expected = 0;
  std::vector<double> last;
  const Strobe s = strobe(
      *flow, state, {.transient_periods = 1, .recorded_periods = 3, .phases = 4},
      [&](std::size_t index, double, std::span<const double> y) {
        EXPECT_EQ(index, expected++);
        last.assign(y.begin(), y.end());
      },
      always);
  EXPECT_EQ(expected, 12U);
  EXPECT_EQ(last, std::vector<double>(s.section.point(2).begin(), s.section.point(2).end()));
  EXPECT_EQ(last, state);
}

TEST(Strobe, StopsWhenAskedTo) {
  const auto flow = integrate::make_arkode_flow(duffing(0.2), {});
  std::vector<double> state = {1.0, 0.0};
  int asked = 0;
  const Strobe s = strobe(
      *flow, state, {.transient_periods = 5, .recorded_periods = 5}, [](auto&&...) {}, [&] { return ++asked <= 7; });
  EXPECT_EQ(s.section.size(), 2U);
}

TEST(SurfaceSection, OfAFreeOscillationIsWhereItsSolutionCrosses) {
  // x = cos t, seen in periods of 1: through 0.3 with falling x at t = arccos 0.3 + 2 pi k, rising at - arccos 0.3.
  const auto field = integrate::make_field(2, 1.0, [](std::size_t, double, const auto* y, auto* d) {
    d[0] = y[1];
    d[1] = -1.0 * y[0];
  });
  const auto flow = integrate::make_arkode_flow(field, {.relative_tolerance = 1e-12, .absolute_tolerance = 1e-12});
  for (const SectionCrossing direction : {SectionCrossing::falling, SectionCrossing::rising}) {
    std::vector<double> y = {1.0, 0.0};
    const SurfaceSection s = surface_section(
        *flow, y, [](double, std::span<const double> now) { return now[0] - 0.3; }, direction, 20, 16, always);
    ASSERT_TRUE(s.evolution.reached());
    ASSERT_EQ(s.section.size(), 3U);  // of 20 units of time, 3.18 turns
    ASSERT_EQ(s.phase.size(), 3U);
    const double speed = (direction == SectionCrossing::falling ? -1.0 : 1.0) * std::sqrt(1.0 - 0.09);
    for (std::size_t k = 0; k < 3; ++k) {
      const double turn =
          2.0 * std::numbers::pi * static_cast<double>(direction == SectionCrossing::falling ? k : k + 1);
      const double t = turn + (direction == SectionCrossing::falling ? 1.0 : -1.0) * std::acos(0.3);
      constexpr double tolerances = 1e-9;  // of the dense output that a crossing is sought from
      EXPECT_NEAR(s.phase[k], t - std::floor(t), tolerances);
      EXPECT_NEAR(s.section.point(k)[0], 0.3, tolerances);
      EXPECT_NEAR(s.section.point(k)[1], speed, tolerances);
    }
  }
}

TEST(SurfaceSection, LeavesThePathAsItIs) {
  const auto a = integrate::make_arkode_flow(duffing(0.5), {});
  const auto b = integrate::make_arkode_flow(duffing(0.5), {});
  std::vector<double> y = {1.0, 0.0};
  std::vector<double> z = y;
  const SurfaceSection s = surface_section(
      *a, y, [](double, std::span<const double> now) { return now[0]; }, SectionCrossing::rising, 30, 32, always);
  for (int k = 0; k < 30; ++k) (void)b->evolve(z, 0.0, b->field().period);
  EXPECT_GT(s.section.size(), 5U);
  EXPECT_EQ(y, z);  // chaos would show any difference
}

}  // namespace
}  // namespace epicyclic::analysis::poincare_test
