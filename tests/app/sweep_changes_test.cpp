// Which orbits are followed beside the changes of the regime of a sweep.

#include "report/sweep_changes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "integrate/make_field.hpp"

namespace epicyclic::app {
namespace sweep_changes_test {
namespace {

using analysis::Regime;
using studies::Direction;

constexpr double two_pi = 2.0 * std::numbers::pi;

/// x'' + c x' + x / 10 = 0 with c = (value - 1.5) / 10: a torus bifurcation between the points 1 and 2.
model::DynamicModel oscillator(const studies::GridPoint& p) {
  const double c = 0.1 * (p.value - 1.5);
  model::DynamicModel m;
  static_cast<VectorField&>(m) = integrate::make_field(2, two_pi, [c](std::size_t, double, const auto* y, auto* d) {
    d[0] = y[1];
    d[1] = c * y[1] - 0.1 * y[0];
  });
  return m;
}

studies::PointSummary point(std::size_t index, Direction direction, Regime regime, int period) {
  studies::PointSummary p;
  p.point = {.index = index, .direction = direction, .value = static_cast<double>(index % 4)};
  p.regime = regime;
  p.period = period;
  p.evidence.largest_multiplier = 0.9;
  if (period > 0) p.orbit = {0.0, 0.0};
  return p;
}

ChangeMultipliers of(const std::vector<studies::PointSummary>& points) {
  return change_multipliers(
      points, oscillator, {}, [] {}, 2);
}

std::vector<double> column(const ChangeMultipliers& changes, std::string_view name) {
  const auto at = std::ranges::find(ChangeMultipliers::names, name) - ChangeMultipliers::names.begin();
  return changes.columns[static_cast<std::size_t>(at)];
}

using Numbers = std::vector<double>;

TEST(SweepChanges, OrbitBesideTheChangeIsFollowed) {
  const ChangeMultipliers changes =
      of({point(0, Direction::up, Regime::periodic, 1), point(1, Direction::up, Regime::periodic, 1),
          point(2, Direction::up, Regime::quasiperiodic, 0), point(3, Direction::up, Regime::chaotic, 0)});
  EXPECT_EQ(column(changes, "point"), Numbers{1});
  EXPECT_EQ(column(changes, "other"), Numbers{2});
  EXPECT_EQ(column(changes, "unstable"), Numbers{2});
  EXPECT_EQ(column(changes, "there_value"), Numbers{2});
  EXPECT_EQ(column(changes, "fold"), Numbers{0});
  const double real = column(changes, "there_real").front();
  const double imaginary = column(changes, "there_imaginary").front();
  EXPECT_NEAR(std::hypot(real, imaginary), std::exp(0.05 * std::numbers::pi), 1e-5);
  EXPECT_EQ(changes.left_out, 0U);
}

TEST(SweepChanges, OfTwoPeriodsTheDivisorIsFollowedElseTheEarlier) {
  const auto pair = [](Direction direction, int first, int second) {
    return of({point(1, direction, Regime::periodic, first), point(2, direction, Regime::periodic, second)});
  };
  EXPECT_EQ(column(pair(Direction::up, 1, 2), "point"), Numbers{1});
  EXPECT_EQ(column(pair(Direction::up, 4, 2), "point"), Numbers{2});
  EXPECT_EQ(column(pair(Direction::up, 2, 3), "point"), Numbers{1});
  EXPECT_EQ(column(pair(Direction::down, 2, 3), "point"), Numbers{2});
  EXPECT_TRUE(column(pair(Direction::down, 3, 3), "point").empty());
}

TEST(SweepChanges, BothDirectionsAndLongOrbits) {
  // A point that was not reached counts for none; the other direction has the same change.
  auto lost = point(2, Direction::up, Regime::undecided, 0);
  lost.outcome = integrate::Outcome::failed;
  const ChangeMultipliers both =
      of({point(1, Direction::up, Regime::periodic, 1), lost, point(3, Direction::up, Regime::quasiperiodic, 0),
          point(5, Direction::down, Regime::periodic, 1), point(7, Direction::down, Regime::quasiperiodic, 0)});
  EXPECT_EQ(column(both, "point"), (Numbers{1, 5}));
  EXPECT_EQ(column(both, "other"), (Numbers{3, 7}));
  EXPECT_EQ(column(both, "there_real")[0], column(both, "there_real")[1]);

  const ChangeMultipliers far =
      of({point(1, Direction::up, Regime::periodic, 17), point(2, Direction::up, Regime::chaotic, 0)});
  EXPECT_TRUE(far.columns.front().empty());
  EXPECT_EQ(far.left_out, 1U);
}

}  // namespace
}  // namespace sweep_changes_test
}  // namespace epicyclic::app
