// What a page takes of a sweep's records, and where its limits cut.

#include "report/sweep_records.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace epicyclic::app {
namespace sweep_records_test {
namespace {

constexpr std::size_t planets = 2;
constexpr std::size_t rows = 4;
constexpr std::size_t orders = 3;

/// x' = 0: the meshes of the sun deflect by x, those of the ring by 10 x, rates are 100 and 1000 x.
model::DynamicModel at_rest() {
  model::DynamicModel m;
  m.planets = static_cast<int>(planets);
  m.dimension = 2;
  m.scales = {1.0, 1.0};
  m.right_hand_side = [](std::size_t, double, const double*, double* dyds) { dyds[0] = dyds[1] = 0.0; };
  m.deflections = [](double, const double* y, model::MeshDeflections& d) {
    d.sun_planet.assign(planets, y[0]);
    d.ring_planet.assign(planets, 10.0 * y[0]);
    d.sun_planet_rate.assign(planets, 100.0 * y[0]);
    d.ring_planet_rate.assign(planets, 1000.0 * y[0]);
  };
  m.forces = [](double, const double* y, model::StageForces& f) {
    f.sun_planet.assign(planets, y[0]);
    f.ring_planet.assign(planets, y[0]);
  };
  return m;
}

/// Point k: rows x = k + row / 10, deflections as above, spectrum 10^k, 1, 0.
studies::PointResult point(std::size_t k) {
  studies::PointResult r;
  r.point.index = k;
  r.meshes.sun_planet.resize(planets);
  r.meshes.ring_planet.resize(planets);
  r.poincare_columns = 2 + 2 * planets;
  for (std::size_t row = 0; row < rows; ++row) {
    const double x = static_cast<double>(k) + 0.1 * static_cast<double>(row);
    r.poincare.insert(r.poincare.end(), {x, 0.0, x, x, 10.0 * x, 10.0 * x});
  }
  r.spectrum = {std::pow(10.0, static_cast<double>(k)), 1.0, 0.0};
  r.spectrum_resolution = 0.5;
  return r;
}

SweepRecords records_of(const std::vector<std::size_t>& points, const SweepRecordLimits& limits = {},
                        bool with_model = true) {
  std::function<model::DynamicModel(std::size_t)> model_at;
  if (with_model) model_at = [](std::size_t) { return at_rest(); };
  return sweep_records(
      points, point, model_at, {}, [] {}, limits);
}

TEST(SweepRecords, HoldWhatThePageDraws) {
  const SweepRecords r = records_of({1, 3});
  EXPECT_EQ(r.names, (std::vector<std::string>{"delta_sp_1", "delta_sp_2", "delta_rp_1", "delta_rp_2",
                                               "delta_sp_1_rate", "delta_rp_1_rate"}));
  EXPECT_EQ(r.starts, (std::vector<double>{0, rows, 2 * rows}));
  for (std::size_t k = 0; k < 2 * rows; ++k) {
    const double x = (k < rows ? 1.0 : 3.0) + 0.1 * static_cast<double>(k % rows);
    EXPECT_DOUBLE_EQ(r.section[0][k], x);
    EXPECT_DOUBLE_EQ(r.section[3][k], 10.0 * x);
    EXPECT_DOUBLE_EQ(r.section[4][k], 100.0 * x);
    EXPECT_DOUBLE_EQ(r.section[5][k], 1000.0 * x);
  }
  EXPECT_EQ(r.orders, orders);
  EXPECT_EQ(r.resolution, 0.5);
  ASSERT_EQ(r.spectra.size(), 2 * orders);
  EXPECT_NEAR(r.spectra[0], 1.0, 1e-15);
  EXPECT_NEAR(r.spectra[orders], 3.0, 1e-15);
  EXPECT_TRUE(std::isnan(r.spectra[2]));
  EXPECT_TRUE(r.any_history);
  EXPECT_EQ(r.points_of_histories, 2U);
  for (const auto& column : r.histories) ASSERT_EQ(column.size(), 2 * SweepRecords::history_rows);
  EXPECT_DOUBLE_EQ(r.histories[0].front(), 1.3);  // from the last state of the record
  EXPECT_DOUBLE_EQ(r.histories[1].back(), 33.0);
}

TEST(SweepRecords, NeedNoModelForWhatIsStored) {
  const SweepRecords r = records_of({0, 1}, {}, false);
  EXPECT_EQ(r.names.size(), 2 * planets);
  EXPECT_EQ(r.section.front().size(), 2 * rows);
  EXPECT_FALSE(r.any_history);
}

TEST(SweepRecords, EndAtTheirLimits) {
  const std::vector<std::size_t> points = {0, 1, 2, 3, 4};
  SweepRecordLimits limits;
  limits.section = 2 * 2 * 2 * points.size();  // two rows of two columns of each point
  limits.spectra = 2 * orders * 3;
  limits.histories = 2 * 6 * SweepRecords::history_rows * 2 + 1;
  const SweepRecords r = records_of(points, limits);
  EXPECT_EQ(r.rows_of_a_point, 2U);
  EXPECT_EQ(r.starts, (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_DOUBLE_EQ(r.section[0][9], 4.1);
  EXPECT_EQ(r.points_of_spectra, 3U);
  EXPECT_EQ(r.spectra.size(), 3 * orders);
  EXPECT_EQ(r.points_of_histories, 2U);
  EXPECT_EQ(r.histories[5].size(), 2 * SweepRecords::history_rows);
  EXPECT_EQ(records_of(points, {0, 0, 0}).starts.back(), 5.0);  // one row of each point stays
}

TEST(SweepRecords, KeepThePlaceOfPointsWithout) {
  const auto read = [](std::size_t k) {
    if (k != 0) return point(k);
    studies::PointResult failed;
    failed.outcome = integrate::Outcome::diverged;
    failed.meshes.sun_planet.resize(planets);
    return failed;
  };
  const SweepRecords r = sweep_records(
      std::vector<std::size_t>{0, 1, 0}, read, [](std::size_t) { return at_rest(); }, {}, [] {});
  EXPECT_EQ(r.starts, (std::vector<double>{0, 0, rows, rows}));
  ASSERT_EQ(r.spectra.size(), 3 * orders);
  EXPECT_TRUE(std::isnan(r.spectra[0]) && std::isnan(r.spectra.back()));
  EXPECT_NEAR(r.spectra[orders], 1.0, 1e-15);
  ASSERT_EQ(r.histories[0].size(), 3 * SweepRecords::history_rows);
  EXPECT_TRUE(std::isnan(r.histories[0].front()) && std::isnan(r.histories[0].back()));
  EXPECT_DOUBLE_EQ(r.histories[0][SweepRecords::history_rows], 1.3);
}

TEST(SweepRecords, KeepTheMeshesOfPlanetOneFirst) {
  const std::vector<std::string> names = {"delta_sp_1", "delta_sp_2", "delta_rp_1", "delta_sp_1_rate", "x_s"};
  EXPECT_EQ(kept_columns(names, 10, 1000), std::vector<bool>(5, true));
  EXPECT_EQ(kept_columns(names, 10, 40), (std::vector<bool>{true, false, true, false, false}));
  EXPECT_EQ(kept_columns(names, 10, 60), (std::vector<bool>{true, false, true, true, false}));
  EXPECT_EQ(kept_columns(names, 10, 0), std::vector<bool>(5, false));
  EXPECT_EQ(kept_columns(names, 0, 0), std::vector<bool>(5, true));
}

}  // namespace
}  // namespace sweep_records_test
}  // namespace epicyclic::app
