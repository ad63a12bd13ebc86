#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "gear/gear_set.hpp"
#include "model/friction_track.hpp"
#include "problems/table1.hpp"

namespace epicyclic::model::stiffness_curve_test {
namespace {

constexpr double rounding = 1e-13;

const std::vector<gear::MeshedPair>& meshes() {
  static const std::vector<gear::MeshedPair> all = [] {
    gear::Stage s = problems::table1();
    s.catalogue->stiffness.harmonics = 0;
    const gear::GearSet g = gear::make_gear_set(s);
    return std::vector{g.sun_planet, g.ring_planet, problems::tall_pair()};
  }();
  return all;
}

/// Rows like those of gear::stiffness_curve, with a number of intervals of one's own.
gear::StiffnessCurve curve_of(const gear::MeshedPair& mesh, int intervals) {
  gear::StiffnessCurve c;
  c.breakpoints = mesh.breakpoints();
  const double rest = c.breakpoints[1];
  const auto append = [&](double phase, double inside) {
    c.phase.push_back(phase);
    c.stiffness_N_per_m.push_back(mesh.stiffness(phase, inside));
  };
  append(0.0, 0.5 * rest);
  c.phase.insert(c.phase.begin(), 0.0);
  c.stiffness_N_per_m.insert(c.stiffness_N_per_m.begin(), mesh.stiffness(1.0, 0.5 * (1.0 + rest)));
  for (int k = 1; k <= intervals; ++k) append(rest * k / intervals, 0.5 * rest);
  c.phase.back() = rest;
  for (int k = 0; k < intervals; ++k) append(rest + (1.0 - rest) * k / intervals, 0.5 * (1.0 + rest));
  return c;
}

/// Greatest relative difference of track and mesh, a piece at a time, at points off the rows.
double error_of(const gear::MeshedPair& mesh, const gear::StiffnessCurve& curve) {
  const PeriodicTrack<1> track = stiffness_track(curve, 1.0);
  const double rest = mesh.breakpoints()[1];
  double worst = 0.0;
  for (const auto& [from, to] : {std::pair{0.0, rest}, std::pair{rest, 1.0}}) {
    const TrackPlace place = track.place(0.5 * (from + to));
    constexpr int points = 307;
    for (int k = 0; k < points; ++k) {
      const double phase = from + (to - from) * (k + 0.5) / points;
      const double exact = mesh.stiffness(phase, 0.5 * (from + to));
      worst = std::max(worst, std::abs(track.at(place, phase)[0] / exact - 1.0));
    }
  }
  return worst;
}

/// From about 32 to about 256 intervals: the worst of some numbers, because extrema move among the rows.
double order_of(const gear::MeshedPair& mesh, Interpolation how) {
  const auto worst = [&](int fewest) {
    double most = 0.0;
    for (const int more : {0, 1, 2, 3, 4}) {
      gear::StiffnessCurve c = curve_of(mesh, fewest + fewest * more / 8);
      c.interpolation = how;
      most = std::max(most, error_of(mesh, c));
    }
    return most;
  };
  return std::log2(worst(32) / worst(256)) / 3.0;
}

TEST(StiffnessCurve, TrackReproducesTheRowsOnBothSidesOfJumpsAndAcrossTheTurn) {
  for (const gear::MeshedPair& mesh : meshes()) {
    const gear::StiffnessCurve c = gear::stiffness_curve(mesh);
    constexpr double unit = 1e9;
    const PeriodicTrack<1> track = stiffness_track(c, unit);
    EXPECT_EQ(track.breakpoints(), c.breakpoints);
    for (const double turn : {-3.0, 0.0, 2.0})
      for (std::size_t k = 0; k < c.phase.size(); ++k) {
        const bool left = k == 0 || (k + 1 < c.phase.size() && c.phase[k + 1] == c.phase[k]);
        const double phase = (k == 0 ? 1.0 : c.phase[k]) + turn;
        const TrackPlace place = track.place(phase + (left ? -1e-3 : 1e-3));
        EXPECT_NEAR(track.at(place, phase)[0] * unit, c.stiffness_N_per_m[k], rounding * unit * 10.0)
            << "row " << k << " turn " << turn;
      }
  }
}

TEST(StiffnessCurve, TrackIsTheMeshBetweenTheRows) {
  for (const gear::MeshedPair& mesh : meshes())
    for (const double tolerance : {1e-5, 1e-9, 1e-12}) {
      const gear::StiffnessCurve c = gear::stiffness_curve(mesh, tolerance);
      ASSERT_TRUE(c.error.has_value());
      EXPECT_LE(*c.error, tolerance);
      // Told relative to the mean, measured to the value: half the mean at least.
      EXPECT_LE(error_of(mesh, c), 2.0 * *c.error + rounding);
    }
}

TEST(StiffnessCurve, ErrorOfTheTrackFallsWithItsOrder) {
  // Steffen's slopes at rows are of second order, and zero next to an extremum: h^2 over all, h^3 away from them.
  for (const gear::MeshedPair& mesh : meshes()) {
    const double order = order_of(mesh, Interpolation::monotone);
    // The factor of h^2 depends on where the extremum is between two rows, which scatters the order by 0.3.
    constexpr double least_order = 1.7;
    constexpr double greatest_order = 3.3;
    EXPECT_GT(order, least_order);
    EXPECT_LT(order, greatest_order);
  }
}

TEST(StiffnessCurve, ErrorOfASmoothTrackIsOfFourthOrder) {
  for (const gear::MeshedPair& mesh : meshes()) {
    // More while the pieces' ends, whose slopes are one-sided, are what is seen.
    const double order = order_of(mesh, Interpolation::smooth);
    constexpr double least_order = 3.7;
    constexpr double greatest_order = 5.0;
    EXPECT_GT(order, least_order);
    EXPECT_LT(order, greatest_order);
  }
}

TEST(StiffnessCurve, TrackSeesOnlyItsOwnSideOfAJump) {
  for (const gear::MeshedPair& mesh : meshes()) {
    const PeriodicTrack<1> track = stiffness_track(gear::stiffness_curve(mesh), 1.0);
    const double rest = mesh.breakpoints()[1];
    const double double_side = track.at(track.place(rest - 0.01), rest)[0];
    const double single_side = track.at(track.place(rest + 0.01), rest)[0];
    EXPECT_NEAR(double_side - single_side, mesh.pair_stiffness(mesh.contact_ratio()), rounding * double_side * 10.0);
    const double end = track.at(track.place(0.99), 1.0)[0];
    const double start = track.at(track.place(1.01), 1.0)[0];
    EXPECT_NEAR(start - end, mesh.pair_stiffness(0.0), rounding * start * 10.0);
    // A phase on the breakpoint is on its right.
    EXPECT_EQ(track.at(track.place(rest), rest)[0], single_side);
  }
}

TEST(StiffnessCurve, MeanOfTheTrackIsThatOfTheFourierSeries) {
  // The track's error averaged: below that at the worst place.
  constexpr double measured = 1e-5;
  for (const gear::MeshedPair& mesh : meshes()) {
    const PeriodicTrack<1> track = stiffness_track(gear::stiffness_curve(mesh), 1.0);
    const double rest = mesh.breakpoints()[1];
    double sum = 0.0;
    constexpr int points = 400;
    for (const auto& [from, to] : {std::pair{0.0, rest}, std::pair{rest, 1.0}})
      for (int k = 0; k < points; ++k) {
        const double phase = from + (to - from) * (k + 0.5) / points;
        sum += (to - from) / points * track.at(track.place(phase), phase)[0];
      }
    EXPECT_NEAR(sum / gear::fourier_series(mesh, 0).mean, 1.0, measured);
  }
}

TEST(StiffnessCurve, ContactRatioOfAWholeNumberMakesATrackOfOnePiece) {
  gear::MeshedPair mesh = problems::yi_pair();
  mesh.pair.end_mm = mesh.pair.start_mm + mesh.pair.base_pitch_mm;
  const gear::StiffnessCurve c = gear::stiffness_curve(mesh);
  ASSERT_EQ(c.breakpoints, std::vector<double>{0.0});
  const PeriodicTrack<1> track = stiffness_track(c, 1.0);
  constexpr double told = 1e-9;  // StiffnessOptions::table_tolerance, of the mean
  for (const double phase : {0.1, 0.5, 0.9})
    EXPECT_NEAR(track.at(track.place(phase), phase)[0] / mesh.pair_stiffness(phase), 1.0, told);
}

}  // namespace
}  // namespace epicyclic::model::stiffness_curve_test
