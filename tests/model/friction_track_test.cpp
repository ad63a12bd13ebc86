#include "model/friction_track.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "gear/friction_path.hpp"
#include "problems/r1.hpp"

namespace epicyclic::model::friction_track_test {
namespace {

// Roundings of numbers of order 1 after a shift of the phase by whole turns.
constexpr double rounding = 1e-14;

using gear::FrictionTable;

FrictionTable jumping() {
  return {{0.0, 0.0, 0.25, 0.4, 0.4, 0.7},
          {2.0, -1.0, 0.5, 1.0, -2.0, 0.0},
          {20.0, 10.0, 5.0, -10.0, 40.0, 30.0},
          {-9.0, 3.0, 6.0, 9.0, 12.0, 3.0},
          {0.0, 0.4}};
}

FrictionTable smooth_table(std::size_t rows) {
  FrictionTable t;
  for (std::size_t k = 0; k < rows; ++k) {
    const double phase = static_cast<double>(k) / static_cast<double>(rows);
    t.phase.push_back(phase);
    t.force_ratio.push_back(std::sin(2.0 * std::numbers::pi * phase));
    t.moment_driving_mm.push_back(std::cos(2.0 * std::numbers::pi * phase));
    t.moment_driven_mm.push_back(3.0);
  }
  return t;
}

constexpr double driving_mm = 2.0;
constexpr double driven_mm = 3.0;

/// Values just left or right of a row, by the place of a phase within that piece.
void expect_row(const FrictionTrack& track, const FrictionTable& t, std::size_t row, double phase, double inside) {
  const FrictionRatios<double> r = track.at(track.place(inside), phase);
  EXPECT_NEAR(r.force, t.force_ratio[row], rounding) << "row " << row;
  EXPECT_NEAR(r.moment_driving, t.moment_driving_mm[row] / driving_mm, 10 * rounding) << "row " << row;
  EXPECT_NEAR(r.moment_driven, t.moment_driven_mm[row] / driven_mm, 10 * rounding) << "row " << row;
}

TEST(FrictionTrack, ReproducesRowsOnBothSidesOfJumpsAndAcrossTheTurn) {
  const FrictionTable t = jumping();
  const FrictionTrack track(t, 0.0, driving_mm, driven_mm);
  for (const double turn : {-2.0, 0.0, 1.0, 5.0}) {
    expect_row(track, t, 1, 0.0 + turn, 0.1 + turn);
    expect_row(track, t, 2, 0.25 + turn, 0.25 + turn);
    expect_row(track, t, 3, 0.4 + turn, 0.3 + turn);
    expect_row(track, t, 4, 0.4 + turn, 0.5 + turn);
    expect_row(track, t, 5, 0.7 + turn, 0.7 + turn);
    expect_row(track, t, 0, 1.0 + turn, 0.9 + turn);
  }
  EXPECT_EQ(track.breakpoints(), t.breakpoints);
}

TEST(FrictionTrack, IsStraightBetweenTwoRows) {
  const FrictionTable t = gear::friction_table(*problems::tang2020().sun_planet_mesh.friction.coefficient,
                                               gear::sun_planet_line(problems::tang2020()));
  const FrictionTrack track(t, 0.0, driving_mm, driven_mm);
  std::size_t checked = 0;
  for (std::size_t k = 1; k < t.phase.size(); k += 2) {
    const std::size_t right = k + 1 < t.phase.size() ? k + 1 : 0;
    const double end = right == 0 ? 1.0 : t.phase[right];
    for (const double share : {0.0, 0.3, 0.8, 1.0}) {
      const double phase = t.phase[k] + share * (end - t.phase[k]);
      const auto line = [&](const std::vector<double>& v) { return v[k] + share * (v[right] - v[k]); };
      const FrictionRatios<double> r = track.at(track.place(0.5 * (t.phase[k] + end)), phase);
      EXPECT_NEAR(r.force, line(t.force_ratio), rounding);
      EXPECT_NEAR(r.moment_driving, line(t.moment_driving_mm) / driving_mm, rounding);
      EXPECT_NEAR(r.moment_driven, line(t.moment_driven_mm) / driven_mm, rounding);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 4 * t.breakpoints.size());
}

TEST(FrictionTrack, LeadMovesTheTableAndItsBreakpoints) {
  const FrictionTable t = jumping();
  const FrictionTrack plain(t, 0.0, driving_mm, driven_mm);
  for (const double lead : {0.3023, -0.15, 0.75}) {
    const FrictionTrack moved(t, lead, driving_mm, driven_mm);
    for (double phase = 0.013; phase < 1.0; phase += 0.05) {
      const double there = phase + lead;
      const FrictionRatios<double> a = plain.at(plain.place(phase), phase);
      const FrictionRatios<double> b = moved.at(moved.place(there), there);
      EXPECT_NEAR(a.force, b.force, 100 * rounding) << phase;
      EXPECT_NEAR(a.moment_driving, b.moment_driving, 1000 * rounding) << phase;
    }
    ASSERT_EQ(moved.breakpoints().size(), 2U);
    EXPECT_TRUE(std::is_sorted(moved.breakpoints().begin(), moved.breakpoints().end()));
    for (const double b : t.breakpoints) {
      const double expected = b + lead - std::floor(b + lead);
      double nearest = 1.0;
      for (const double m : moved.breakpoints()) nearest = std::min(nearest, std::abs(m - expected));
      EXPECT_LE(nearest, rounding);
    }
  }
}

TEST(FrictionTrack, APieceIsContinuedBeyondItsEnds) {
  // A step that ends on a breakpoint, or overshoots it by rounding, sees the left side.
  const FrictionTrack track(jumping(), 0.0, driving_mm, driven_mm);
  const FrictionTrack::Place left = track.place(0.35);
  constexpr double beyond = 1e-9;
  // The slope of A there is some 10 at most.
  constexpr double reach = 20 * beyond;
  EXPECT_NEAR(track.at(left, 0.4 + beyond).force, 1.0, reach);
  EXPECT_NEAR(track.at(track.place(0.45), 0.4 - beyond).force, -2.0, reach);
}

TEST(FrictionTrack, WithoutBreakpointsItIsOneSmoothPeriodicCurve) {
  const FrictionTable t = smooth_table(64);
  const FrictionTrack track(t, 0.0, 1.0, 1.0);
  EXPECT_TRUE(track.breakpoints().empty());
  const auto value = [&](double phase) { return track.at(track.place(phase), phase); };
  for (std::size_t k = 0; k < t.phase.size(); ++k)
    for (const double turn : {-1.0, 0.0, 3.0}) {
      EXPECT_NEAR(value(t.phase[k] + turn).force, t.force_ratio[k], rounding * 10);
      EXPECT_NEAR(value(t.phase[k] + turn).moment_driving, t.moment_driving_mm[k], rounding * 10);
    }
  // Steffen's slope is exact to second order in the spacing away from extrema, where it is forced to 0.
  constexpr double second_order = 0.1;
  constexpr double h = 1e-6;
  constexpr double rounding_over_h = 1e-7;  // and h^2: the second derivatives on both sides of a sine's zero cancel
  for (const double seam : {0.0, 1.0}) {
    const double left = (value(seam).force - value(seam - h).force) / h;
    const double right = (value(seam + h).force - value(seam).force) / h;
    EXPECT_NEAR(left, right, rounding_over_h);
    EXPECT_NEAR(left, 2.0 * std::numbers::pi, second_order);
  }
}

TEST(FrictionTrack, NeverOvershootsItsRows) {
  const FrictionTrack track(jumping(), 0.0, driving_mm, driven_mm);
  for (double phase = 0.001; phase < 1.0; phase += 0.001) {
    const double a = track.at(track.place(phase), phase).force;
    const double low = phase < 0.25 ? -1.0 : phase < 0.4 ? 0.5 : phase < 0.7 ? -2.0 : 0.0;
    const double high = phase < 0.25 ? 0.5 : phase < 0.4 ? 1.0 : phase < 0.7 ? 0.0 : 2.0;
    EXPECT_GE(a, low - rounding) << phase;
    EXPECT_LE(a, high + rounding) << phase;
  }
}

TEST(FrictionTrack, APieceWithoutEndsIsAnInputError) {
  FrictionTable t = jumping();
  t.breakpoints = {0.0, 0.1};
  EXPECT_THROW(FrictionTrack(t, 0.0, driving_mm, driven_mm), InputError);
}

}  // namespace
}  // namespace epicyclic::model::friction_track_test
