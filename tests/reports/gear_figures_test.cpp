#include "reports/gear_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gnuplot_guard.hpp"
#include "model/modes.hpp"
#include "problems/lin_parker.hpp"
#include "problems/table1.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::reports::gear_figures_test {
namespace {

using problems::lin_parker;
using problems::table1;
using test::contents;
using test::TemporaryFolder;

constexpr double touching_mm = 1e-9;  // rounding of coordinates of some 100 mm, with a wide margin
// A chord of a concave flank cuts s^2 / 8 rho off the space: chords up to 0.15 mm, curvature radii above 20 mm.
constexpr double chord_sag_mm = 2e-4;
constexpr double reach_mm = 15.0;

const gear::MeshLoad load{1750.0, 57.0};

/// A standard set of 20 degrees without shifts, whose meshes straddle their pitch points.
gear::Stage standard() {
  gear::Stage stage = table1();
  gear::Catalogue& c = *stage.catalogue;
  c.sun.data = c.planet.data = {30, 2.0, 20.0, 0.0, 1.0, 0.25, 60.0, {}, {}};
  c.ring.data = {90, 2.0, 20.0, 0.0, 0.8, 0.25, 60.0, {}, {}};  // full tips would reach below the planet's involute
  c.planet.bore_mm = 20.0;
  return stage;
}

std::vector<gear::Pair> pairs() {
  std::vector<gear::Pair> pairs;
  for (const gear::Stage& stage : {table1(), standard()}) {
    const gear::GearSet set = gear::make_gear_set(stage);
    pairs.push_back(set.sun_planet.pair);
    pairs.push_back(set.ring_planet.pair);
  }
  return pairs;
}

double distance(const DrawnPoint& a, const DrawnPoint& b) { return std::hypot(a.x - b.x, a.y - b.y); }

double distance_to_vertices(const DrawnPoint& p, const std::vector<DrawnPoint>& line) {
  double least = std::numeric_limits<double>::infinity();
  for (const DrawnPoint& q : line) least = std::min(least, distance(p, q));
  return least;
}

double distance_to_line(const DrawnPoint& p, const std::vector<DrawnPoint>& line) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < line.size(); ++k) {
    const double dx = line[k].x - line[k - 1].x;
    const double dy = line[k].y - line[k - 1].y;
    const double square = dx * dx + dy * dy;
    const double share = square > 0.0 ? ((p.x - line[k - 1].x) * dx + (p.y - line[k - 1].y) * dy) / square : 0.0;
    const double t = std::clamp(share, 0.0, 1.0);
    least = std::min(least, distance(p, {line[k - 1].x + t * dx, line[k - 1].y + t * dy}));
  }
  return least;
}

/// Is p within the sector that axis and outline enclose? Counts the edges that a ray to the right crosses.
bool within(const DrawnPoint& p, std::vector<DrawnPoint> sector, const DrawnPoint& axis) {
  sector.push_back(axis);
  bool inside = false;
  for (std::size_t i = 0, j = sector.size() - 1; i < sector.size(); j = i++) {
    const DrawnPoint& a = sector[i];
    const DrawnPoint& b = sector[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

/// How deep vertices of `points` lie in the material of another gear.
double depth_in(const std::vector<DrawnPoint>& points, const std::vector<DrawnPoint>& teeth, const DrawnPoint& axis,
                bool internal) {
  double deepest = 0.0;
  for (const DrawnPoint& p : points)
    if (std::abs(p.x) < reach_mm && within(p, teeth, axis) != internal)
      deepest = std::max(deepest, distance_to_line(p, teeth));
  return deepest;
}

double overlap_mm(const MeshDrawing& d, bool internal) {
  return std::max(depth_in(d.driven, d.driving, d.driving_axis, false),
                  depth_in(d.driving, d.driven, d.driven_axis, internal));
}

std::set<std::string> stems(const std::vector<GearFigure>& figures) {
  std::set<std::string> stems;
  for (const GearFigure& figure : figures) stems.insert(figure.stem);
  return stems;
}

void expect_drawn(const std::vector<GearFigure>& figures, const std::filesystem::path& folder) {
  for (const GearFigure& figure : figures) {
    EXPECT_TRUE(figure.outcome.drawn()) << figure.stem << ": " << figure.outcome.message;
    for (const char* suffix : {".dat", ".gp", ".png", ".svg"})
      EXPECT_TRUE(std::filesystem::exists(folder / (figure.stem + suffix))) << figure.stem << suffix;
  }
}

TEST(MeshDrawing, TeethTouchOnTheLineOfActionAtEveryPhase) {
  for (const gear::Pair& pair : pairs())
    for (const double phase : {0.0, 0.1, 0.45, 0.9}) {
      const MeshDrawing d = mesh_drawing(pair, phase, reach_mm);
      EXPECT_EQ(d.contacts.size(), static_cast<std::size_t>(std::ceil(pair.contact_ratio() - phase)));
      for (const DrawnPoint& contact : d.contacts) {
        EXPECT_LT(distance_to_vertices(contact, d.driving), touching_mm) << phase;
        EXPECT_LT(distance_to_vertices(contact, d.driven), touching_mm) << phase;
        const double along = distance(contact, d.start) + distance(contact, d.end);
        EXPECT_NEAR(along, distance(d.start, d.end), touching_mm) << "off the path of contact";
      }
    }
}

TEST(MeshDrawing, ThePathOfContactIsTangentToBothBaseCircles) {
  for (const gear::Pair& pair : pairs()) {
    const MeshDrawing d = mesh_drawing(pair, 0.1, reach_mm);
    const double length = distance(d.start, d.end);
    EXPECT_NEAR(length, pair.end_mm - pair.start_mm, touching_mm);
    const auto from_line = [&](const DrawnPoint& axis) {
      return std::abs((d.end.x - d.start.x) * (axis.y - d.start.y) - (d.end.y - d.start.y) * (axis.x - d.start.x)) /
             length;
    };
    EXPECT_NEAR(from_line(d.driving_axis), pair.driving.base_radius_mm, touching_mm);
    EXPECT_NEAR(from_line(d.driven_axis), pair.driven.base_radius_mm, touching_mm);
    EXPECT_NEAR(distance(d.driving_axis, d.driven_axis), pair.centre_distance_mm, touching_mm);
  }
}

TEST(MeshDrawing, TeethDoNotOverlap) {
  for (const gear::Pair& pair : pairs())
    for (const double phase : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9})
      EXPECT_LT(overlap_mm(mesh_drawing(pair, phase, reach_mm), pair.internal()), chord_sag_mm)
          << (pair.internal() ? "ring" : "sun") << " at " << phase;
}

TEST(MeshDrawing, AnOverlapWouldBeSeen) {
  constexpr double pushed_mm = 0.01;
  for (const gear::Pair& pair : pairs()) {
    MeshDrawing d = mesh_drawing(pair, 0.1, reach_mm);
    for (DrawnPoint& p : d.driving) {
      p.x += pushed_mm * std::cos(pair.pressure_angle);
      p.y += pushed_mm * std::sin(pair.pressure_angle);
    }
    EXPECT_NEAR(overlap_mm(d, pair.internal()), pushed_mm, 0.1 * pushed_mm);
  }
}

TEST(MeshDrawing, OutlinesReachFromRootToTipCircle) {
  for (const gear::Pair& pair : pairs()) {
    const MeshDrawing d = mesh_drawing(pair, 0.2, reach_mm);
    const auto expect_radii = [](const std::vector<DrawnPoint>& line, const DrawnPoint& axis, const gear::Tooth& t) {
      double least = std::numeric_limits<double>::infinity();
      double greatest = 0.0;
      for (const DrawnPoint& p : line) {
        least = std::min(least, distance(p, axis));
        greatest = std::max(greatest, distance(p, axis));
      }
      EXPECT_NEAR(least, std::min(t.root_radius_mm, t.tip_radius_mm), touching_mm);
      EXPECT_NEAR(greatest, std::max(t.root_radius_mm, t.tip_radius_mm), touching_mm);
    };
    expect_radii(d.driving, d.driving_axis, pair.driving);
    expect_radii(d.driven, d.driven_axis, pair.driven);
  }
}

TEST(MeshDrawing, OutlinesHaveNoGap) {
  // From flank to fillet to root: the longest edges are those of arcs, a tenth of a module or so.
  for (const gear::Pair& pair : pairs()) {
    const MeshDrawing d = mesh_drawing(pair, 0.2, reach_mm);
    for (const auto& line : {d.driving, d.driven})
      for (std::size_t k = 1; k < line.size(); ++k)
        EXPECT_LT(distance(line[k - 1], line[k]), 0.25 * pair.driving.module_mm) << k;
  }
}

TEST(MeshDrawing, ThePathOfTheRingMeshOfThePaperLiesBeyondThePitchPoint) {
  const MeshDrawing d = mesh_drawing(gear::make_gear_set(table1()).ring_planet.pair, 0.1, reach_mm);
  EXPECT_GT(d.start.x, 1.0);
  EXPECT_GT(d.end.x, d.start.x);
}

TEST(GearFigures, AllAppear) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  const gear::Stage stage = table1();
  const auto figures = draw_gear_set_figures(folder / "figures", gear::make_gear_set(stage), load, stage);
  EXPECT_EQ(stems(figures),
            (std::set<std::string>{"stiffness_sp", "stiffness_rp", "load_sharing", "friction", "friction_ratio",
                                   "bearing_stiffness", "bearing_force", "teeth_sp", "teeth_rp"}));
  expect_drawn(figures, folder / "figures");
}

TEST(GearFigures, WhatHasNothingToShowIsLeftOut) {
  const TemporaryFolder folder;
  gear::Stage stage = table1();
  stage.catalogue->lubrication.reset();
  stage.catalogue->sun_bearing.reset();
  stage.catalogue->carrier.bearing.reset();
  const auto figures = draw_gear_set_figures(folder.path(), gear::make_gear_set(stage), load, stage);
  EXPECT_EQ(stems(figures),
            (std::set<std::string>{"stiffness_sp", "stiffness_rp", "load_sharing", "teeth_sp", "teeth_rp"}));
  EXPECT_FALSE(std::filesystem::exists(folder / "friction.dat"));
}

TEST(GearFigures, SameDataGiveTheSameFiles) {
  const TemporaryFolder first;
  const TemporaryFolder second;
  const gear::Stage stage = table1();
  const gear::GearSet set = gear::make_gear_set(stage);
  const auto figures = draw_gear_set_figures(first.path(), set, load, stage);
  draw_gear_set_figures(second.path(), set, load, stage);
  for (const GearFigure& figure : figures)
    for (const char* suffix : {".dat", ".gp"})
      EXPECT_EQ(contents(first / (figure.stem + suffix)), contents(second / (figure.stem + suffix))) << figure.stem;
}

TEST(GearFigures, FrictionVanishesAtThePitchPointOfTheSunMeshOnly) {
  const TemporaryFolder folder;
  const gear::Stage stage = table1();
  draw_gear_set_figures(folder.path(), gear::make_gear_set(stage), load, stage);
  // Data sets: zero line, sun-planet, ring-planet, ends.
  const std::string data = contents(folder / "friction.dat");
  const std::size_t ring = data.find("\n\n\n", data.find("\n\n\n") + 3);
  ASSERT_NE(ring, std::string::npos);
  EXPECT_NE(data.substr(0, ring).find("\n0 0\n"), std::string::npos);
  EXPECT_EQ(data.substr(ring).find("\n0 0\n"), std::string::npos);
}

TEST(GearFigures, AnyNameIsShownAsItStands) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  gear::Stage stage = lin_parker(3);
  stage.name = "it's_{/Symbol W}^2\n`date` @x &y ~z \\";
  expect_drawn(draw_mode_figures(folder.path(), stage), folder.path());
  const std::string svg = contents(folder / "campbell.svg");
  EXPECT_NE(svg.find("it's"), std::string::npos);
  EXPECT_NE(svg.find("`date`"), std::string::npos);
}

TEST(ModeFigures, ShowAllShapes) {
  const TemporaryFolder folder;
  gear::Stage stage = lin_parker(4);
  stage.angles_deg = {0.0, 80.0, 190.0, 270.0};
  const std::size_t modes = model::modes(stage, model::scales_of(stage)).size();
  ASSERT_GT(modes, 12U);
  draw_mode_figures(folder.path(), stage);
  const std::string script = contents(folder / "mode_shapes.gp");
  std::size_t titles = 0;
  for (std::size_t at = script.find(" Hz'"); at != std::string::npos; at = script.find(" Hz'", at + 1)) ++titles;
  EXPECT_EQ(titles + 1, modes) << "all but the rigid motion have a frequency";
}

TEST(ModeFigures, AppearForLumpedStagesOfAllKinds) {
  EPICYCLIC_NEEDS_GNUPLOT();
  std::vector<gear::Stage> stages{lin_parker(2), lin_parker(6), lin_parker(3), lin_parker(3)};
  stages[2].angles_deg = {0.0, 110.0, 250.0};
  stages[3].ring.support_N_per_m = stages[3].ring.torsional_support_N_per_m = gear::rigid;
  for (const gear::Stage& stage : stages) {
    const TemporaryFolder folder;
    const auto figures = draw_mode_figures(folder.path(), stage);
    EXPECT_EQ(stems(figures), (std::set<std::string>{"campbell", "mode_shapes"}));
    expect_drawn(figures, folder.path());
  }
}

}  // namespace
}  // namespace epicyclic::reports::gear_figures_test
