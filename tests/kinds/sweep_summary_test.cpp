// What sweep.md says of points made by hand.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "kinds/sweep/summary.hpp"

namespace epicyclic::kinds::sweep_summary_test {
using namespace reports;

namespace {

using analysis::Regime;
using studies::PointResult;

/// A motion of period `period` (0: chaos) whose orbit has its states at x, x + 1, ...
PointResult point(std::size_t index, bool up, double value, int period, double x) {
  PointResult p;
  p.point = {index, up ? studies::Direction::up : studies::Direction::down, value};
  p.regime = period > 0 ? Regime::periodic : Regime::chaotic;
  p.period = period;
  p.classified = true;
  p.recurrence.period = period;
  p.meshes.sun_planet.resize(1);
  p.meshes.ring_planet.resize(1);
  p.meshes.planet_bearing.resize(1);
  p.meshes.static_force = 100.0;
  p.meshes.sun_planet[0].delta = {1.0, 2.0 + 0.1 * x, 1.5, 0.2};
  p.meshes.sun_planet[0].force = {0.0, 200.0 + 10.0 * value, 100.0, 10.0};
  p.meshes.ring_planet[0].force = {0.0, 150.0, 100.0, 10.0};
  p.poincare_columns = 3;
  for (int k = 0; k < period; ++k) {
    if (k == 0) p.orbit = {x};
    p.poincare.insert(p.poincare.end(), {x + k, 0.0, 0.0});
  }
  return p;
}

/// Up at 1, 2, ..., then down; each with its period and place.
std::vector<PointResult> sweep(const std::vector<std::pair<int, double>>& up,
                               const std::vector<std::pair<int, double>>& down) {
  std::vector<PointResult> all;
  for (std::size_t k = 0; k < up.size(); ++k)
    all.push_back(point(k, true, static_cast<double>(k + 1), up[k].first, up[k].second));
  for (std::size_t k = down.size(); k-- > 0;)
    all.push_back(point(all.size(), false, static_cast<double>(k + 1), down[k].first, down[k].second));
  return all;
}

SweepSummary told(const std::vector<PointResult>& points) {
  SweepOutput output;
  output.sweep.axis = {"damping_ratio", 1.0, static_cast<double>(points.size() / 2),
                       static_cast<int>(points.size() / 2)};
  output.sweep.directions = {studies::Direction::up, studies::Direction::down};
  output.title = "by hand";
  return sweep_summary(output, studies::points_in_memory(points));
}

TEST(SweepSummary, TellsWindows) {
  const std::string text =
      told(sweep({{1, 0}, {1, 0}, {1, 0}, {2, 0}, {0, 0}}, {{1, 0}, {1, 0}, {1, 0}, {1, 0}, {0, 0}})).text;
  EXPECT_NE(text.find("| up | period 1 | 1 | 3 | 3 |"), std::string::npos) << text;
  EXPECT_NE(text.find("| down | period 1 | 1 | 4 | 4 |"), std::string::npos) << text;
  EXPECT_NE(text.find("3 points lie between the windows, alone or in pairs: 4 (up, period 2), 5 (up, chaotic), 5 "
                      "(down, chaotic)."),
            std::string::npos)
      << text;
}

TEST(SweepSummary, HasTheRangesOfContactLoss) {
  std::vector<PointResult> points = sweep({{1, 0}, {1, 0}, {1, 0}}, {{1, 0}, {1, 0}, {1, 0}});
  for (PointResult& p : points)
    for (auto* meshes : {&p.meshes.sun_planet, &p.meshes.ring_planet})
      (*meshes)[0].drive = 1.0, (*meshes)[0].back = 0.0;
  EXPECT_NE(told(points).text.find("No mesh loses contact"), std::string::npos);
  points[1].meshes.ring_planet[0].drive = 0.9;
  points[2].meshes.ring_planet[0].drive = 0.8;
  points[3].meshes.sun_planet[0].back = 0.0;  // down at 3
  points[3].meshes.sun_planet[0].drive = 0.5;
  const std::string text = told(points).text;
  EXPECT_NE(text.find("| ring-planet | up | 2 | 3 | 2 |"), std::string::npos) << text;
  EXPECT_NE(text.find("| sun-planet | down | 3 | 3 | 1 |"), std::string::npos) << text;
}

TEST(SweepSummary, ChaosBesideAnOrbitMayBeATransient) {
  const SweepSummary s = told(sweep({{1, 0}, {1, 0}, {1, 0}}, {{1, 0}, {0, 0}, {2, 0}}));
  EXPECT_EQ(
      s.lines.front(),
      "two attractors coexist at 2 of 3 values: 2 to 3; at 1 of these one is chaotic and may be a long transient");
  EXPECT_EQ(s.numbers["unlike"]["one_chaotic"], 1);
  EXPECT_NE(s.text.find("/study/classification_periods"), std::string::npos) << s.text;
}

TEST(SweepSummary, TellsWhereTwoMotionsStandSideBySide) {
  // Another period at 2, another orbit at 4 and 5; nothing at 3, where both are chaos.
  const SweepSummary s =
      told(sweep({{1, 0}, {1, 0}, {0, 0}, {1, 0}, {1, 0}, {1, 0}}, {{1, 0}, {2, 0}, {0, 5}, {1, 3}, {1, 3}, {1, 0}}));
  EXPECT_EQ(s.numbers["unlike"]["values"], 3);
  EXPECT_EQ(s.lines.front(), "two attractors coexist at 3 of 6 values: 2, 4 to 5");
  EXPECT_NE(s.text.find("At 1 value the comparison is not possible"), std::string::npos) << s.text;
}

TEST(SweepSummary, TakesNoOrbitSeenAtAnotherInstantOrOnItsWayForASecondOne) {
  std::vector<PointResult> points = sweep({{2, 0}, {1, 0}}, {{2, 0}, {1, 0}});
  // Down the orbit of period 2 is known by its other state; of that of period 1 the record is a third of b_c off.
  points[3].orbit = {1.0};
  points[2].poincare[0] = 0.3;
  points[2].orbit = {2e-3};
  EXPECT_EQ(told(points).numbers["unlike"]["values"], 0);
  points[2].orbit = {0.3};
  EXPECT_EQ(told(points).numbers["unlike"]["values"], 1);
  // By recurrence alone nothing is known.
  for (PointResult& p : points) p.classified = false;
  const SweepSummary unknown = told(points);
  EXPECT_EQ(unknown.numbers["unlike"]["values"], 0);
  EXPECT_NE(unknown.text.find("At 2 values the comparison is not possible"), std::string::npos) << unknown.text;
}

TEST(SweepSummary, TellsWhereTheLargestForceIs) {
  std::vector<PointResult> points = sweep({{1, 0}, {1, 0}}, {{1, 0}, {1, 0}});
  points[0].meshes.ring_planet[0].force.largest = 400.0;
  SweepSummary s = told(points);
  EXPECT_EQ(s.numbers["largest_dynamic_factor"], 4.0);
  EXPECT_EQ(s.lines.back(), "largest force of a ring mesh over F_0 of a sun mesh: 4 at 1, up, period 1");
  EXPECT_FALSE(s.numbers.contains("largest_kv")) << "no quasi-static force is known";
  // Not what a record on its way to its orbit says, and not of one that failed.
  points[0].recurrence.period = 0;
  points[1].outcome = integrate::Outcome::diverged;
  s = told(points);
  EXPECT_NEAR(s.numbers["largest_dynamic_factor"].get<double>(), 2.2, 1e-12);
  EXPECT_EQ(s.lines.back(), "largest force of a sun mesh over its static force F_0: 2.2 at 2, down, period 1");
  EXPECT_NE(s.text.find("1 failed"), std::string::npos);
}

TEST(SweepSummary, SpeaksOfTheSpeedThatTheStudyGives) {
  const std::vector<PointResult> points = sweep({{1, 0}, {1, 0}, {1, 0}}, {{1, 0}, {1, 0}, {2, 0}});
  SweepOutput output;
  output.sweep.axis = {studies::speed_parameter, 1.0, 3.0, 3};
  output.sweep.directions = {studies::Direction::up, studies::Direction::down};
  output.speed = studies::SpeedUnit{"sun_speed_rpm", 1500.0};
  const SweepSummary s = sweep_summary(output, studies::points_in_memory(points));
  for (const char* words :
       {"along `sun_speed_rpm`, 1500 to 4500 (`mesh_frequency_ratio` 1 to 3), up and down",
        "| up | period 1 | 1500 | 4500 | 3 |", "| 4500 | period 1 | period 2 |",
        "| force of a sun mesh over its static force F_0 | 2.3 | 1 | 4500 (sun_speed_rpm), up, period 1 |"})
    EXPECT_NE(s.text.find(words), std::string::npos) << words << '\n' << s.text;
  EXPECT_EQ(s.lines.front(), "two attractors coexist at 1 of 3 values: 4500");
}

TEST(SweepSummary, TellsDynamicFactorAndLoadSharingApart) {
  std::vector<PointResult> points = sweep({{1, 0}, {1, 0}}, {{1, 0}, {1, 0}});
  for (PointResult& p : points) p.meshes.sun_planet[0].quasi_static = {150.0, 200.0, 160.0, 10.0};
  const SweepSummary s = told(points);
  EXPECT_NEAR(s.numbers["largest_kv"].get<double>(), 1.1, 1e-12);
  EXPECT_NE(s.text.find("| dynamic factor K_v of a sun mesh | 1.1 | 1 | 2, up, period 1 |"), std::string::npos)
      << s.text;
  EXPECT_NE(s.text.find("| mesh load factor K_gamma of the sun meshes | 1.25 | 1 | 1, up, period 1 |"),
            std::string::npos)
      << s.text;
}

}  // namespace
}  // namespace epicyclic::kinds::sweep_summary_test
