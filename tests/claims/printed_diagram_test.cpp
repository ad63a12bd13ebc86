#include "claims/printed_diagram.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "claims/judging.hpp"
#include "problems/numbered_points.hpp"

namespace epicyclic::claims::printed_diagram_test {
namespace {

using analysis::Regime;

/// Clusters of five points each, on an axis of length 1.
/// @param height  of each cluster
DotColumn column(std::vector<double> centres, double height) {
  std::vector<double> points;
  for (const double centre : centres)
    for (int k = -2; k <= 2; ++k) points.push_back(centre + 0.25 * k * height);
  std::ranges::sort(points);
  return {points, 1.0, PrintedDots{}};
}

/// The logistic map after a transient, on its axis.
DotColumn logistic(double r) {
  double x = 0.4;
  for (int k = 0; k < 4000; ++k) x = r * x * (1.0 - x);
  std::vector<double> points;
  for (int k = 0; k < 256; ++k) {
    points.push_back(x);
    x = r * x * (1.0 - x);
  }
  std::ranges::sort(points);
  return {points, 0.8, PrintedDots{}};
}

TEST(PrintedDots, ThatAreNearerThanADotAreOne) {
  EXPECT_EQ(column({0.5}, 0.0).period(), 1);
  EXPECT_EQ(column({0.5, 0.5059}, 0.0).period(), 1);
  EXPECT_EQ(column({0.5, 0.5061}, 0.0).period(), 2);
  EXPECT_EQ(column({0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8}, 0.0).period(), 8);
  EXPECT_EQ(column({0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}, 0.0).period(), 0);
}

TEST(PrintedDots, AreACloudWhereAClusterIsTallerThanADot) {
  EXPECT_EQ(column({0.3, 0.6}, 0.0149).period(), 2);
  EXPECT_EQ(column({0.3, 0.6}, 0.0151).period(), 0);
}

TEST(PrintedDots, OfTheLogisticMapShowItsCascade) {
  EXPECT_EQ(logistic(2.9).period(), 1);
  EXPECT_EQ(logistic(3.2).period(), 2);
  EXPECT_EQ(logistic(3.5).period(), 4);
  EXPECT_EQ(logistic(3.55).period(), 8);
  EXPECT_EQ(logistic(3.83).period(), 3);
  EXPECT_EQ(logistic(3.7).period(), 0);
  EXPECT_EQ(logistic(4.0).period(), 0);
}

TEST(PrintedDots, LackNothingExactlyOfTheRegimeThatTheyShow) {
  for (double r = 2.8; r <= 4.0; r += 0.0037) {
    const DotColumn dots = logistic(r);
    for (int n = 1; n <= 8; ++n)
      EXPECT_EQ(dots.lacks("period " + std::to_string(n)).value() == 0.0, dots.period() == n) << r << ' ' << n;
    EXPECT_EQ(dots.lacks("chaotic").value() == 0.0, dots.period() == 0) << r;
    EXPECT_EQ(dots.lacks("not period 1").value() == 0.0, dots.period() != 1) << r;
    EXPECT_EQ(dots.lacks("multi-period").value() == 0.0, dots.period() >= 2) << r;
    EXPECT_EQ(dots.lacks("not chaotic").value() == 0.0, dots.period() >= 1) << r;
    EXPECT_FALSE(dots.lacks("not period 2").has_value());
    EXPECT_FALSE(dots.lacks("period 9").has_value());
  }
}

TEST(PrintedDots, LackLessTheNearerTheyComeToARegime) {
  double before = 1.0;
  for (const double gap : {0.001, 0.002, 0.004, 0.0055}) {
    const double lack = column({0.5, 0.5 + gap}, 0.0).lacks("period 2").value();
    EXPECT_LT(lack, before) << gap;
    before = lack;
  }
  before = 1.0;
  for (const double height : {0.5, 0.2, 0.1, 0.03, 0.016}) {
    const double lack = column({0.5}, height).lacks("period 1").value();
    EXPECT_LT(lack, before) << height;
    before = lack;
  }
  before = 1.1;
  for (const double apart : {0.0, 0.05, 0.1, 0.3}) {
    const double lack = column({0.4, 0.4 + apart}, 0.001).lacks("chaotic").value();
    EXPECT_LT(lack, before) << apart;
    before = lack;
  }
}

/// Columns that were drawn at print size and labelled by eye before the rule was applied.
TEST(PrintedDots, AreReadAsByEye) {
  std::ifstream file("validation/tang2020/labels.csv");
  std::string line;
  std::getline(file, line);
  int columns = 0;
  int same = 0;
  int same_kind = 0;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string number, label, text;
    std::getline(cells, number, ',');
    std::getline(cells, label, ',');
    for (const int unused : {0, 1, 2}) {
      (void)unused;
      std::getline(cells, text, ',');
    }
    std::vector<double> points;
    for (double x = 0.0; cells >> x;) points.push_back(x);
    ASSERT_FALSE(points.empty()) << line;
    const int period = DotColumn(points, 1.0, PrintedDots{}).period();
    ++columns;
    same += (period == 0 ? "cloud" : std::to_string(period)) == label ? 1 : 0;
    same_kind += (period == 0) == (label == "cloud") ? 1 : 0;
  }
  EXPECT_EQ(columns, 60);
  EXPECT_GE(same, 57);
  EXPECT_EQ(same_kind, 60);
}

/// Three points whose sections have these values of delta_sp,1; of delta_rp,1 twice as much.
ClaimSeries series(const std::vector<std::vector<double>>& sections) {
  ClaimSeries series;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    ClaimPoint p;
    p.value = static_cast<double>(k);
    p.reached = true;
    p.response = {Regime::quasiperiodic, 0, true};
    p.sun_section = sections[k];
    for (const double x : sections[k]) p.ring_section.push_back(2.0 * x);
    series.points.push_back(p);
  }
  return series;
}

std::vector<double> cloud() {
  std::vector<double> points;
  for (int k = 0; k < 100; ++k) points.push_back(2.0 + 0.01 * k);
  return points;
}

TEST(PrintedDiagrams, GiveRegimesOnOneAxis) {
  const ClaimSeries drawn = as_printed(series({{0.0, 0.001}, cloud(), {1.0, 1.5, 4.0}}), PrintedDots{}, 1e-3);
  EXPECT_TRUE(drawn.points[0].response.is("period 1"));
  EXPECT_TRUE(drawn.points[1].response.is("chaotic"));
  EXPECT_TRUE(drawn.points[1].response.is("quasiperiodic"));
  EXPECT_TRUE(drawn.points[2].response.is("period 3"));
  EXPECT_TRUE(drawn.points[2].by_ring_mesh.is("period 3"));
  EXPECT_EQ(drawn.points[0].quantity("poincare_sp_range"), 0.0);
  EXPECT_NEAR(drawn.points[1].quantity("poincare_rp_range"), 1.98, 1e-12);
  // Alone, the two points of the first section are the ends of an axis of ten recurrence tolerances.
  EXPECT_TRUE(as_printed(series({{0.0, 0.001}}), PrintedDots{}, 1e-3).points[0].response.is("period 2"));
  EXPECT_TRUE(as_printed(series({{0.0, 0.00001}}), PrintedDots{}, 1e-3).points[0].response.is("period 1"));
}

TEST(PrintedDiagrams, VaryByWhatIsDrawn) {
  Condition c;
  c.kind = ConditionKind::variation;
  c.sweep = "s";
  c.at_most = 0.1;
  const ClaimRecord record = {{"s", as_printed(series({{0.0}, {0.5}, {4.0}}), PrintedDots{}, 1e-3)}};
  EXPECT_NEAR(judge(c, record).measured, 3.5 / 4.0, 1e-12);
}

TEST(PrintedDiagrams, MeetAClaimByWhatTheirReaderAccepts) {
  Claim claim;
  Condition period_two;
  period_two.kind = ConditionKind::share;
  period_two.sweep = "s";
  period_two.regime = "period 2";
  period_two.at_least = 1.0;
  Condition any_cloud = period_two;
  any_cloud.kind = ConditionKind::count;
  any_cloud.regime = "chaotic";
  claim.conditions = {period_two};
  claim.as_printed = {any_cloud};
  ClaimsOptions options;
  const ClaimRecord evidence = {{"s", series({{0.0}, cloud(), {4.0}})}};
  const ClaimRecord printed = {{"s", read_as(Reading::printed, evidence.at("s"), options)}};
  EXPECT_FALSE(judge(claim, evidence, Reading::evidence).holds);
  EXPECT_FALSE(judge(claim, printed, Reading::evidence).holds);
  EXPECT_TRUE(judge(claim, printed, Reading::printed).holds);
  EXPECT_TRUE(read_as(Reading::evidence, evidence.at("s"), options).points[0].response.is("quasiperiodic"));
  claim.as_printed.clear();
  EXPECT_FALSE(judge(claim, printed, Reading::printed).holds);
}

TEST(PrintedDiagrams, HaveTheSectionsOfThePoints) {
  studies::PointResult r = test::numbered_points(3)[0];
  r.outcome = integrate::Outcome::reached;
  r.poincare_columns = 2 + 6;
  r.poincare.clear();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 8; ++column) r.poincare.push_back(10.0 * column - row);
  const ClaimPoint point = claim_point(r, {}, Depth::in_full);
  EXPECT_EQ(point.sun_section, (std::vector<double>{17.0, 18.0, 19.0, 20.0}));
  EXPECT_EQ(point.ring_section, (std::vector<double>{47.0, 48.0, 49.0, 50.0}));
}

}  // namespace
}  // namespace epicyclic::claims::printed_diagram_test
