// Maps and basins: numbering, chains, starts, the turns of the planets.

#include "studies/plane.hpp"

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/largest_difference.hpp"
#include "model/scales.hpp"
#include "problems/known_systems.hpp"
#include "problems/r1.hpp"
#include "studies/point_source.hpp"

namespace epicyclic::studies::plane_test {
namespace {

MapOptions map() {
  MapOptions m;
  Plane& p = m.plane;
  p.first = {"mesh_frequency_ratio", 0.5, 0.9, 5};
  p.second = {"damping_ratio", 0.02, 0.06, 3};
  return m;
}

TEST(Plane, AMapIsNumberedAlongTheFirstAxisAndEachRowIsAChain) {
  MapOptions options = map();
  options.directions = {Direction::up, Direction::down};
  const SweepPlan plan = plan_map(options);
  ASSERT_EQ(plan.points.size(), 30U);
  ASSERT_EQ(plan.chains.size(), 6U);
  EXPECT_EQ(plan.points[1].value, 0.6);
  EXPECT_EQ(plan.points[1].second_value, 0.02);
  EXPECT_EQ(plan.points[5].value, 0.5);
  EXPECT_EQ(plan.points[5].second_value, 0.04);
  EXPECT_EQ(plan.points[15].value, 0.9);
  EXPECT_EQ(plan.points[15].direction, Direction::down);
  std::set<std::size_t> seen;
  for (const auto& chain : plan.chains)
    for (const std::size_t k : chain) {
      EXPECT_EQ(plan.points[k].index, k);
      EXPECT_EQ(plan.points[k].second_value, plan.points[chain[0]].second_value);
      seen.insert(k);
    }
  EXPECT_EQ(seen.size(), 30U);
  options.start = Start::cold;
  EXPECT_EQ(plan_map(options).chains.size(), 30U);
}

TEST(Plane, APlanOfAnySizeIsTheSameRule) {
  MapOptions large = map();
  large.directions = {Direction::up, Direction::down};
  large.start = Start::cold;
  large.plane.first.points = 10000;
  large.plane.second.points = 10000;
  const SweepPlan plan = plan_map(large);  // its points would take 6 GB
  ASSERT_EQ(plan.points.size(), 200000000U);
  ASSERT_EQ(plan.chains.size(), 200000000U);
  EXPECT_EQ(plan.points.front().value, 0.5);
  EXPECT_EQ(plan.points.back().index, 199999999U);
  EXPECT_EQ(plan.points.back().value, 0.5) << "downwards a line ends at the first value";
  EXPECT_EQ(plan.points.back().second_value, 0.06);
  EXPECT_EQ(plan.points[100000000].value, 0.9);
  EXPECT_EQ(plan.points[100000000].second_value, 0.02);
  EXPECT_EQ(plan.chains[123456789].front(), 167896172U) << "point 6172 of line 16789, of 20000 side by side";
  EXPECT_EQ(plan.chains[123456789].size(), 1U);
  large.start = Start::continued;
  const SweepPlan carried = plan_map(large);
  ASSERT_EQ(carried.chains.size(), 20000U);
  EXPECT_EQ(carried.chains[15000].front(), 150000000U);
  EXPECT_EQ(carried.chains[15000].back(), 150009999U);
}

TEST(Plane, BasinsStartWhereBaseAndAxesSay) {
  model::DynamicModel m;
  m.state_names = {"x_s", "y_s", "x_s_rate", "y_s_rate"};
  m.default_start = {1, 2, 3, 4};
  BasinsOptions p;
  p.plane.first = {"y_s", -1, 1, 3};
  p.plane.second = {"x_s_rate", 10, 20, 2};
  p.other_components = {{"x_s", 7}};
  const SweepPlan plan = plan_basins(p);
  ASSERT_EQ(plan.points.size(), 6U);
  EXPECT_EQ(plan.chains.size(), 6U);
  EXPECT_EQ(start_in_plane(m, p, plan.points[0]), (std::vector<double>{7, -1, 10, 4}));
  EXPECT_EQ(start_in_plane(m, p, plan.points[5]), (std::vector<double>{7, 1, 20, 4}));
  p.other_components["z"] = 1;
  EXPECT_THROW((void)start_in_plane(m, p, plan.points[0]), InputError);
}

TEST(Plane, EqualPlanetsTurnMotionsIntoMotions) {
  gear::Stage s = problems::with_friction(problems::with_moving_stiffness(problems::with_gap(problems::r1())));
  s.sun_bearing.law = gear::BearingLaw::linear_radial;
  const model::DynamicModel m = model::make_dynamic_model(s, model::scales_of(s), 1.0, {});
  ASSERT_TRUE(m.remove_synchronous) << "the planets of R1 are alike";
  const auto turns = planet_turns(m);
  ASSERT_EQ(turns.size(), static_cast<std::size_t>(m.planets - 1));
  std::vector<double> y = m.default_start;
  for (std::size_t j = 0; j < y.size(); ++j) y[j] += 3.0 * std::sin(1.0 + static_cast<double>(j));
  constexpr double rounding = 1e-10;  // of sums of some 1e3 in size
  std::vector<double> f(m.dimension);
  std::vector<double> f_of_turned(m.dimension);
  for (const PlanetTurn& turn : turns)
    for (const double phase : {0.1, 2.0, 5.0}) {
      const std::size_t segment = model::segment_at(m.breakpoints, phase);
      m.right_hand_side(segment, phase, y.data(), f.data());
      m.right_hand_side(segment, phase, turn.map(y).data(), f_of_turned.data());
      EXPECT_LT(largest_difference(turn.map(f), f_of_turned), rounding) << turn.planets;
      EXPECT_GT(largest_difference(f, f_of_turned), 0.1);
    }
  // A turn by one planet, N times over, is none.
  std::vector<double> turned = y;
  for (int k = 0; k < m.planets; ++k) turned = turns[0].map(turned);
  EXPECT_LT(largest_difference(turned, y), rounding);
}

TEST(Plane, EqualPlanetsOutOfPhaseTurnMotionsIntoMotionsAtAnotherInstant) {
  gear::Stage s = problems::with_friction(problems::with_moving_stiffness(problems::with_gap(problems::r1())));
  s.sun_bearing.law = gear::BearingLaw::linear_radial;
  // One tooth more and one less: mesh phases a part of a turn apart.
  s.sun.teeth = s.sun.teeth.value() + 1;
  s.ring.teeth = s.ring.teeth.value() - 1;
  const model::DynamicModel m = model::make_dynamic_model(s, model::scales_of(s), 1.0, {});
  ASSERT_FALSE(m.remove_synchronous);
  integrate::IntegratorOptions tight;
  tight.relative_tolerance = tight.absolute_tolerance = 1e-11;
  const auto turns = planet_turns(m, tight);
  std::vector<double> y = m.default_start;
  for (std::size_t j = 0; j < y.size(); ++j) y[j] += 0.5 * std::sin(1.0 + static_cast<double>(j));
  // The image of where a motion comes to in two mesh periods is where the image comes to.
  const auto flow = make_flow_of_one_trajectory(m, tight);
  const auto two_periods_on = [&](std::vector<double> state) {
    for (int k = 0; k < 2; ++k) EXPECT_TRUE(flow->evolve(state, 0.0, m.period).reached());
    return state;
  };
  const std::vector<double> last = two_periods_on(y);
  constexpr double tolerance = 1e-6;
  for (const PlanetTurn& turn : turns) {
    EXPECT_LT(largest_difference(turn.map(last), two_periods_on(turn.map(y))), tolerance) << turn.planets;
    EXPECT_GT(largest_difference(turn.map(y), y), 0.1);
  }
  // A turn by one planet, N times over, is a motion of its own some whole mesh periods later.
  std::vector<double> turned = y;
  double ahead = 0.0;
  for (int k = 0; k < m.planets; ++k) {
    turned = turns[0].map(turned);
    ahead += m.planet_phases[1] - std::floor(m.planet_phases[1]);
  }
  std::vector<double> later = y;
  for (int k = 0; k < static_cast<int>(std::lround(ahead)); ++k)
    ASSERT_TRUE(flow->evolve(later, 0.0, m.period).reached());
  EXPECT_LT(largest_difference(turned, later), tolerance);
}

/// A damped oscillator between two wells, x'' + 0.3 x' - x + x^3 = second cos s, that plays the role of a stage.
model::DynamicModel wells(double drive) {
  model::DynamicModel m;
  m.planets = 1;
  m.dimension = 2;
  m.state_names = {"x", "x_rate"};
  m.omega = 1.0;
  m.right_hand_side = [drive](std::size_t, double s, const double* y, double* f) {
    f[0] = y[1];
    f[1] = drive * std::cos(s) - 0.3 * y[1] + y[0] - y[0] * y[0] * y[0];
  };
  m.deflections = [](double, const double* y, model::MeshDeflections& d) {
    d.sun_planet = d.ring_planet = {y[0]};
    d.sun_planet_rate = d.ring_planet_rate = {y[1]};
  };
  m.default_start = {1.0, 0.0};
  return m;
}

TEST(Plane, BasinsTellTheWellsApartAtAnyNumberOfThreads) {
  BasinsOptions p;
  p.plane.first = {"x", -1.6, 1.6, 6};
  p.plane.second = {"x_rate", -0.8, 0.8, 5};
  p.recording.transient = Transient::fixed;
  p.recording.transient_periods = 60;
  p.recording.recorded_periods = 16;
  p.recording.output_phases = 16;
  const ModelAtPoint at = [&](const GridPoint& point) {
    model::DynamicModel m = wells(0.1);
    m.default_start = start_in_plane(m, p, point);
    return m;
  };
  std::vector<std::size_t> expected;
  for (const int threads : {1, 2, 5}) {
    SweepRun run;
    run.threads = threads;
    auto results = run_sweep_in_memory(plan_basins(p), p.recording, {}, at, std::move(run));
    ASSERT_EQ(results.size(), 30U);
    std::vector<double> x_ends;
    for (const PointResult& r : results) {
      EXPECT_TRUE(r.poincare.empty());
      ASSERT_EQ(r.attractor.period(), 1U);
      x_ends.push_back(r.end_state[0]);
    }
    auto summaries = all_summaries(points_in_memory(results));
    const analysis::Attractors told = attractors_of(summaries, {});
    EXPECT_EQ(told.all.size(), 2U);
    for (std::size_t k = 0; k < x_ends.size(); ++k)
      EXPECT_EQ(told.number[k] == told.number[0], x_ends[k] * x_ends[0] > 0.0) << k;
    if (expected.empty()) expected = told.number;
    EXPECT_EQ(told.number, expected) << threads;
  }
}

/// Beside a motion in (x, x'), a mode z that it drives and that decays by one in `memory` periods.
model::DynamicModel with_slow_mode(const VectorField& motion, double memory) {
  model::DynamicModel m = wells(0.0);
  m.dimension = 3;
  m.state_names = {"x", "x_rate", "z"};
  const double rate = 1.0 / (2.0 * std::numbers::pi * memory);
  m.right_hand_side = [f = motion.right_hand_side, rate](std::size_t k, double s, const double* y, double* d) {
    f(k, s, y, d);
    d[2] = rate * (y[0] - y[2]);
  };
  m.tangents = [f = motion.tangents, rate](std::size_t k, double s, const double* y, const Columns<const double>& v,
                                           double* d, const Columns<double>& dv) {
    f(k, s, y, v, d, dv);
    d[2] = rate * (y[0] - y[2]);
    for (std::size_t j = 0; j < dv.count; ++j) dv.column(j)[2] = rate * (v.column(j)[0] - v.column(j)[2]);
  };
  m.default_start = {1.0, 0.0, 0.0};
  return m;
}

TEST(Plane, BasinsLetCellsSettleByThemselves) {
  // Duffing's oscillator over both wells has one chaotic attractor, whatever z starts from.
  BasinsOptions p;
  p.plane.first = {"x", -1.0, 1.0, 2};
  p.plane.second = {"z", -40.0, 40.0, 5};
  const ModelAtPoint at = [&](const GridPoint& point) {
    model::DynamicModel m = with_slow_mode(problems::duffing(0.3, -1.0, 0.5, 1.0), 30.0);
    m.default_start = start_in_plane(m, p, point);
    return m;
  };
  const auto attractors = [&](const RecordingOptions& cells) {
    auto results = run_sweep_in_memory(plan_basins(p), cells, {}, at, {});
    for (const PointResult& r : results) EXPECT_EQ(regime_name(r), "chaotic");
    auto summaries = all_summaries(points_in_memory(results));
    return attractors_of(summaries, {}).all.size();
  };
  RecordingOptions cells = p.recording;
  cells.output_phases = 16;
  cells.transient_periods = 60;
  EXPECT_EQ(attractors(cells), 1U);
  // Over a short record z hardly moves, and the interval of its mean does not hold that it does.
  cells.transient = Transient::fixed;
  cells.recorded_periods = 16;
  EXPECT_GT(attractors(cells), 1U) << "no example any more";
}

TEST(Plane, AMapsCellIsThePointOfASweepAtItsSecondValue) {
  SweepOptions sweep;
  sweep.recording.transient_periods = 5;
  sweep.recording.recorded_periods = 8;
  sweep.axis = {"drive", 0.05, 0.15, 4};
  MapOptions map;
  map.plane = {{"drive", 0.05, 0.15, 4}, {"offset", 0.0, 0.02, 2}};
  map.recording = sweep.recording;
  map.recording.keep = Keep::row;
  const auto cells = run_sweep_in_memory(
      plan_map(map), map.recording, {},
      ModelAtPoint([](const GridPoint& point) { return wells(point.value + point.second_value); }), {});
  const auto row =
      run_sweep_in_memory(plan_sweep(sweep), sweep.recording, {}, [](double value) { return wells(value + 0.02); }, {});
  ASSERT_EQ(cells.size(), 8U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(cells[4 + k].end_state, row[k].end_state) << k;
    EXPECT_TRUE(cells[4 + k].poincare.empty());
  }
  EXPECT_NE(cells[0].end_state, cells[4].end_state);
}

}  // namespace
}  // namespace epicyclic::studies::plane_test
