// Journal records of points: exact, and damaged ones refused.

#include "store/point_record.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "store/journal.hpp"

namespace epicyclic::store::point_record_test {
namespace {

studies::PointResult example() {
  studies::PointResult r;
  r.point = {7, studies::Direction::down, 0.1};
  r.outcome = integrate::Outcome::diverged;
  r.message = "left the bound";
  r.recurrence = {3, 1e-9, 3, 5e-10};
  studies::MeshRecord mesh;
  mesh.delta.least = -std::numeric_limits<double>::infinity();
  mesh.delta.largest = 5e-324;
  mesh.drive = 0.0;
  mesh.back = 0.25;
  mesh.tension = 1.25;
  mesh.tension_time = 0.0625;
  mesh.quasi_static = {0.5, 0.625, 0.5625, 0.03125};
  r.meshes.sun_planet = {mesh, mesh, {}};
  r.meshes.ring_planet = {mesh};
  r.meshes.planet_spread = 0.3;
  r.meshes.planet_bearing = {{1.0, 2.0, 3.0, 4.0}};
  r.meshes.transmission_error = {5.0, 6.0, 7.0, 8.0};
  r.meshes.transmission_error_harmonics = {9.0, 10.0, 11.0};
  r.meshes.static_force = 12.0;
  r.rhs_evaluations = 1234567890123L;
  r.end_state = {1.0, -0.0, 3.0};
  r.orbit = {0.5, 5e-324};
  r.poincare_columns = 2;
  r.poincare = {1, 2, 3, 4};
  r.point.second_value = -0.25;
  r.attractor.regime = analysis::Regime::chaotic;
  r.attractor.dimension = 2;
  r.attractor.orbit = {1, 2, 3, 4};
  r.attractor.orbit_error = 1e-9;
  r.attractor.frequencies = 4;
  r.attractor.means = {{1, 0.5}, {2, std::numeric_limits<double>::infinity()}};
  r.attractor.deviations = {{3, 0.25}, {4, 0.125}};
  r.attractor.exponent = {0.1, 0.01};
  return r;
}

studies::TolerancePoint measured_example() {
  studies::TolerancePoint p;
  p.point = {2, studies::Direction::up, 2.8};
  p.study = example();
  p.note = "still settling";
  p.period = 3;
  p.orbit = {1.0, 2.0};
  p.largest_multiplier = 0.99;
  p.reference_error = {1e-12, 2e-12, 3e-12, 4e-12};
  p.table_error = {5e-12, 6e-12, 7e-12, 8e-12};
  p.table_displacement = 9e-12;
  p.between_phases = {-1e-3, 2e-3, -3e-3, 4e-3};
  studies::LadderStep step;
  step.method = "cvode-bdf";
  step.tolerance = 1e-7;
  step.orbit_error = std::numeric_limits<double>::quiet_NaN();
  step.work = {123, 0, 4, 30};
  step.seconds = 0.125;
  p.ladder = {step, step};
  studies::SmoothingStep smooth;
  smooth.width = 0.1;
  smooth.found = true;
  p.smoothing = {smooth};
  studies::StatisticsStep statistics;
  statistics.method = "cvode-adams";
  statistics.outcome = integrate::Outcome::step_limit;
  statistics.exponent = {0.1, std::numeric_limits<double>::infinity()};
  p.statistics = {statistics};
  return p;
}

TEST(PointRecord, AMeasurementComesBackExactly) {
  const studies::TolerancePoint a = measured_example();
  const std::vector<std::byte> record = encode_tolerance_point(a);
  const studies::TolerancePoint b = decode_tolerance_point(record);
  EXPECT_EQ(encode_tolerance_point(b), record);
  EXPECT_EQ(b.study.message, a.study.message);
  EXPECT_EQ(b.note, a.note);
  EXPECT_EQ(b.orbit, a.orbit);
  EXPECT_EQ(b.reference_error, a.reference_error);
  EXPECT_EQ(b.table_error, a.table_error);
  EXPECT_EQ(b.table_displacement, a.table_displacement);
  EXPECT_EQ(b.between_phases, a.between_phases);
  EXPECT_TRUE(std::isnan(b.ladder[1].orbit_error));
  EXPECT_EQ(b.ladder[1].work.jacobians, 4);
  EXPECT_TRUE(b.smoothing[0].found);
  EXPECT_EQ(b.statistics[0].outcome, integrate::Outcome::step_limit);
  EXPECT_EQ(b.statistics[0].exponent.half_width, a.statistics[0].exponent.half_width);
}

TEST(PointRecord, AnyPartOfAMeasurementIsRefused) {
  const std::vector<std::byte> record = encode_tolerance_point(measured_example());
  for (std::size_t n = 0; n < record.size(); ++n)
    EXPECT_THROW((void)decode_tolerance_point(std::span(record).first(n)), DamagedData) << n;
}

TEST(PointRecord, ComesBackExactly) {
  const studies::PointResult a = example();
  const studies::PointResult b = decode_point(encode_point(a));
  EXPECT_EQ(encode_point(b), encode_point(a));
  EXPECT_EQ(b.point.index, a.point.index);
  EXPECT_EQ(b.message, a.message);
  EXPECT_EQ(b.rhs_evaluations, a.rhs_evaluations);
  EXPECT_EQ(b.meshes.sun_planet[0].contact(), "loss+back");
  EXPECT_EQ(studies::StageRecord::tension(b.meshes.ring_planet), 1.25);
  EXPECT_EQ(studies::StageRecord::tension_time(b.meshes.ring_planet), 0.0625);
  EXPECT_EQ(b.meshes.sun_planet[1].quasi_static.largest, 0.625);
  EXPECT_EQ(b.meshes.sun_planet[1].quasi_static.mean, 0.5625);
  EXPECT_TRUE(b.has_tension());
  EXPECT_EQ(b.meshes.sun_planet[1].delta.largest, 5e-324);
  EXPECT_EQ(b.meshes.planet_bearing[0].rms, 4.0);
  EXPECT_EQ(b.meshes.transmission_error.mean, 7.0);
  EXPECT_EQ(b.meshes.transmission_error_harmonics[2], 11.0);
  EXPECT_EQ(b.meshes.static_force, 12.0);
  EXPECT_EQ(b.poincare, a.poincare);
  EXPECT_EQ(b.point.second_value, -0.25);
  EXPECT_EQ(b.attractor.regime, analysis::Regime::chaotic);
  EXPECT_EQ(b.attractor.period(), 2U);
  EXPECT_EQ(b.attractor.orbit, a.attractor.orbit);
  EXPECT_EQ(b.attractor.frequencies, 4);
  EXPECT_EQ(b.attractor.deviations[1].half_width, 0.125);
  EXPECT_EQ(b.attractor.exponent.value, 0.1);
  EXPECT_FALSE(b.evidence.zero_one.has_value());
  for (const double k : {0.0, 0.75}) {
    studies::PointResult asked = a;
    asked.evidence.zero_one = k;
    EXPECT_EQ(decode_point(encode_point(asked)).evidence.zero_one, k);
  }
}

TEST(PointRecord, LivesOfBearingsComeBackExactly) {
  for (const bool of_planets : {false, true})
    for (const bool of_sun : {false, true})
      for (const std::size_t planets : {std::size_t{1}, std::size_t{3}}) {
        studies::PointResult a = example();
        a.meshes.sun_planet.resize(planets);
        a.meshes.planet_bearing.resize(planets);
        for (std::size_t i = 0; of_planets && i < planets; ++i)
          a.meshes.planet_lives.push_back({1.0 + static_cast<double>(i), 2.0, 3.0});
        if (of_sun) a.meshes.sun_life = gear::BearingLife{4.0, 5.0, 6.0};
        const studies::PointResult b = decode_point(encode_point(a));
        EXPECT_EQ(encode_point(b), encode_point(a));
        EXPECT_EQ(b.meshes.planet_bearing.size(), planets);
        ASSERT_EQ(b.meshes.planet_lives.size(), a.meshes.planet_lives.size());
        if (of_planets) {
          EXPECT_EQ(b.meshes.planet_lives.back().equivalent_load_N, static_cast<double>(planets));
          EXPECT_EQ(b.meshes.planet_lives.back().hours, 3.0);
        }
        ASSERT_EQ(b.meshes.sun_life.has_value(), of_sun);
        if (of_sun) {
          EXPECT_EQ(b.meshes.sun_life->million_revolutions, 5.0);
        }
      }
}

TEST(PointRecord, AnyPartOfItIsRefused) {
  const std::vector<std::byte> record = encode_point(example());
  for (std::size_t n = 0; n < record.size(); ++n)
    EXPECT_THROW((void)decode_point(std::span(record).first(n)), DamagedData) << n;
  std::vector<std::byte> longer = record;
  longer.push_back(std::byte{0});
  EXPECT_THROW((void)decode_point(longer), DamagedData);
}

TEST(PointRecord, LengthsBeyondTheRecordAreRefusedBeforeMemoryIsTaken) {
  std::vector<std::byte> record = encode_point(example());
  for (std::size_t k = 0; k < record.size(); ++k) {
    std::vector<std::byte> bad = record;
    bad[k] = std::byte{0xff};
    try {
      (void)decode_point(bad);
    } catch (const DamagedData&) {
    }
  }
}

}  // namespace
}  // namespace epicyclic::store::point_record_test
