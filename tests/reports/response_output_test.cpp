// Response curves, dynamic factor, load sharing and spectra of a sweep, as figures' data.

#include "reports/response_output.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "reports/sweep_output.hpp"
#include "store/hdf5_file.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::reports::response_output_test {
namespace {

using studies::PointResult;
using test::contents;
using test::TemporaryFolder;

/// Three values up and down; the second one failed on its way up.
std::vector<PointResult> points() {
  std::vector<PointResult> all(6);
  for (std::size_t i = 0; i < all.size(); ++i) {
    PointResult& p = all[i];
    const bool up = i < 3;
    p.point = {i, up ? studies::Direction::up : studies::Direction::down, static_cast<double>(up ? i + 1 : 6 - i)};
    p.regime = analysis::Regime::periodic;
    p.period = 1;
    p.meshes.sun_planet.resize(2);
    p.meshes.ring_planet.resize(2);
    p.meshes.planet_bearing.resize(2);
    p.meshes.static_force = 100.0;
    const double x = static_cast<double>(i);
    for (auto* meshes : {&p.meshes.sun_planet, &p.meshes.ring_planet})
      for (studies::MeshRecord& m : *meshes) {
        m.delta = {1.0, 3.0 + x, 2.0, 0.5 + x};
        m.force = {0.0, 250.0, 100.0, 10.0};
      }
    p.spectrum = {2.0, 0.1 * (x + 1.0), 1e-6};
    p.spectrum_resolution = 0.5;
  }
  all[1].outcome = integrate::Outcome::diverged;
  all[1].spectrum.clear();
  return all;
}

SweepOutput output() {
  SweepOutput o;
  o.sweep.axis.name = "mesh_frequency_ratio";
  o.sweep.directions = {studies::Direction::up, studies::Direction::down};
  o.poincare_columns = {"delta_sp_1"};
  o.title = "by hand";
  return o;
}

TEST(ResponseOutput, CurvesAreOfEachDirectionAndOfReachedPointsAlone) {
  const TemporaryFolder folder;
  const std::vector<PointResult> all = points();
  const studies::PointSource source = studies::points_in_memory(all);
  EXPECT_FALSE(write_sweep_figure(folder.path(), output(), source, SweepFigure::response_sp));
  EXPECT_EQ(contents(folder / "response_delta_sp.dat"),
            "# 'up': x, joined, values\n1 1 0.5 2\n2 1 NaN NaN\n3 1 2.5 4\n\n\n"
            "# 'down': x, joined, values\n3 1 3.5 5\n2 1 4.5 6\n1 1 5.5 7\n\n\n");
  const std::string script = contents(folder / "response_delta_sp.gp");
  EXPECT_NE(script.find("RMS of δ_{sp,1} / b_c"), std::string::npos);
  EXPECT_NE(script.find("Mesh frequency ratio"), std::string::npos) << script.substr(0, 2000);
  EXPECT_FALSE(write_sweep_figure(folder.path(), output(), source, SweepFigure::dynamic_factor));
  EXPECT_NE(contents(folder / "dynamic_factor.dat").find("1 1 2.5 2.5\n"), std::string::npos);
  EXPECT_FALSE(write_sweep_figure(folder.path(), output(), source, SweepFigure::kv));
  EXPECT_FALSE(std::filesystem::exists(folder / "kv.dat")) << "no quasi-static force is known";
}

TEST(ResponseOutput, DynamicFactorIsOverTheQuasiStaticForce) {
  const TemporaryFolder folder;
  std::vector<PointResult> all = points();
  for (PointResult& p : all)
    for (auto* meshes : {&p.meshes.sun_planet, &p.meshes.ring_planet})
      for (studies::MeshRecord& m : *meshes) m.quasi_static = {100.0, 200.0, 150.0, 20.0};
  EXPECT_FALSE(write_sweep_figure(folder.path(), output(), studies::points_in_memory(all), SweepFigure::kv));
  EXPECT_NE(contents(folder / "kv.dat").find("1 1 1.25 1.25\n"), std::string::npos);
  EXPECT_NE(contents(folder / "kv.gp").find("Dynamic factor  K_{v,sp}"), std::string::npos);
}

TEST(ResponseOutput, SpeedsInRpmStandAboveTheFrame) {
  const TemporaryFolder folder;
  std::vector<PointResult> all = points();
  EXPECT_FALSE(speed_above("mesh_frequency_ratio", {}, studies::points_in_memory(all))) << "no speed is known";
  for (PointResult& p : all) {
    p.omega = p.point.value;
    p.meshes.speeds.sun = 2.0 * std::numbers::pi * 10.0 * p.omega;  // 600 rpm at Omega = 1
  }
  const auto above = speed_above("mesh_frequency_ratio", {}, studies::points_in_memory(all));
  ASSERT_TRUE(above);
  EXPECT_NEAR(above->factor, 600.0, 1e-10);
  EXPECT_FALSE(speed_above("damping_ratio", {}, studies::points_in_memory(all)));
  EXPECT_FALSE(write_sweep_figure(folder.path(), output(), studies::points_in_memory(all), SweepFigure::response_sp));
  const std::string script = contents(folder / "response_delta_sp.gp");
  EXPECT_NE(script.find("set x2range [600:1800]"), std::string::npos) << script;
  EXPECT_NE(script.find("set x2label 'Sun speed  n_s  [rpm]'"), std::string::npos);
  EXPECT_NE(script.find("unset x2tics"), std::string::npos) << "the lower frame has none";
}

TEST(ResponseOutput, TheSpeedThatTheStudyGivesStandsAboveTheFrame) {
  const TemporaryFolder folder;
  const std::vector<PointResult> all = points();
  SweepOutput of_carrier = output();
  of_carrier.speed = studies::SpeedUnit{"carrier_speed_rpm", 150.0};
  EXPECT_FALSE(write_sweep_figure(folder.path(), of_carrier, studies::points_in_memory(all), SweepFigure::response_sp));
  const std::string script = contents(folder / "response_delta_sp.gp");
  EXPECT_NE(script.find("set x2range [150:450]"), std::string::npos) << script;
  EXPECT_NE(script.find("set x2label 'Carrier speed  n_c  [rpm]'"), std::string::npos);
}

/// The second point up: periodic by its orbit, and its record is not on it yet.
std::vector<PointResult> with_one_on_its_way() {
  std::vector<PointResult> all = points();
  all[1].outcome = integrate::Outcome::reached;
  all[1].classified = true;
  for (PointResult& p : all) {
    p.recurrence.period = 1;
    p.poincare_columns = 1;
    p.poincare = {p.point.value};
  }
  all[1].recurrence.period = 0;
  return all;
}

TEST(ResponseOutput, RecordsOnTheirWayAreDrawnApart) {
  const TemporaryFolder folder;
  const std::vector<PointResult> all = with_one_on_its_way();
  EXPECT_FALSE(write_sweep_figure(folder.path(), output(), studies::points_in_memory(all), SweepFigure::response_sp));
  EXPECT_EQ(contents(folder / "response_delta_sp.dat"),
            "# 'up': x, joined, values\n1 1 0.5 2\n2 NaN NaN NaN\n3 1 2.5 4\n\n\n"
            "# 'down': x, joined, values\n3 1 3.5 5\n2 1 4.5 6\n1 1 5.5 7\n\n\n"
            "# drawn apart: x, joined, values\n2 NaN 1.5 3\n");
  EXPECT_NE(contents(folder / "response_delta_sp.gp").find(not_converged_words), std::string::npos);
  EXPECT_FALSE(write_sweep_figure(folder.path(), output(), studies::points_in_memory(all), SweepFigure::delta_sp));
  EXPECT_EQ(contents(folder / "bifurcation_delta_sp.dat"),
            "# 'up'\n1 1\n3 3\n\n\n# 'down'\n3 3\n2 2\n1 1\n\n\n"
            "# drawn apart\n2 2\n\n\n");
  EXPECT_NE(contents(folder / "bifurcation_delta_sp.gp").find(std::string(not_converged_words) + " (1)"),
            std::string::npos);
  EXPECT_FALSE(write_sweep_figure(folder.path(), output(), studies::points_in_memory(all), SweepFigure::regimes_first));
  EXPECT_NE(contents(folder / "regimes_delta_sp_up.gp").find(std::string(not_converged_words) + " (1)"),
            std::string::npos);
}

TEST(ResponseOutput, NoLineGoesThroughChaos) {
  const TemporaryFolder folder;
  std::vector<PointResult> all = points();
  all.erase(all.begin() + 3, all.end());
  all[1].outcome = integrate::Outcome::reached;
  all[1].regime = analysis::Regime::chaotic;
  SweepOutput up = output();
  up.sweep.directions = {studies::Direction::up};
  EXPECT_FALSE(write_sweep_figure(folder.path(), up, studies::points_in_memory(all), SweepFigure::response_rp));
  EXPECT_EQ(contents(folder / "response_delta_rp.dat"),
            "# 'up': x, joined, values\n1 1 0.5 2\n2 NaN 1.5 3\n3 1 2.5 4\n\n\n");
  EXPECT_NE(contents(folder / "response_delta_rp.gp").find("using 1:($3 * $2) with lines"), std::string::npos);
}

TEST(ResponseOutput, SharesAreDrawnWherePlanetsDiffer) {
  const TemporaryFolder folder;
  std::vector<PointResult> all = points();
  EXPECT_FALSE(loads_differ(studies::points_in_memory(all)));
  EXPECT_FALSE(write_sweep_figure(folder.path(), output(), studies::points_in_memory(all), SweepFigure::load_sharing));
  EXPECT_FALSE(std::filesystem::exists(folder / "load_sharing.gp"));
  all[2].meshes.ring_planet[1].force.mean = 300.0;
  EXPECT_TRUE(loads_differ(studies::points_in_memory(all)));
  EXPECT_FALSE(write_sweep_figure(folder.path(), output(), studies::points_in_memory(all), SweepFigure::load_sharing));
  const std::string data = contents(folder / "load_sharing.dat");
  EXPECT_NE(data.find("3 1 1 1 0.5 1.5\n"), std::string::npos) << data;
  // Of the largest forces, which are told apart from the means.
  all[2].meshes.ring_planet[0].force.largest = 900.0;
  all[2].meshes.ring_planet[1].force.largest = 300.0;
  EXPECT_FALSE(
      write_sweep_figure(folder.path(), output(), studies::points_in_memory(all), SweepFigure::load_sharing_max));
  const std::string largest = contents(folder / "load_sharing_max.dat");
  EXPECT_NE(largest.find(" 1.5 0.5\n"), std::string::npos) << largest;
}

TEST(ResponseOutput, SpectraAreAMapOfEachDirectionAndADataset) {
  const TemporaryFolder folder;
  const std::vector<PointResult> all = points();
  const studies::PointSource source = studies::points_in_memory(all);
  for (const SweepFigure figure : {SweepFigure::waterfall_first, SweepFigure::waterfall_second})
    EXPECT_FALSE(write_sweep_figure(folder.path(), output(), source, figure));
  // The mean is left out, and what is below the floor; up, the second point has none.
  EXPECT_EQ(contents(folder / "waterfall_delta_sp_up.dat"),
            "# x from, x to, y from, y to, decades\n"
            "0.5 1.5 0.25 0.75 -0.875\n"
            "2.5 3.5 0.25 0.75 -0.625\n");
  EXPECT_EQ(contents(folder / "waterfall_delta_sp_down.dat"),
            "# x from, x to, y from, y to, decades\n"
            "0.5 1.5 0.25 0.75 -0.125\n"
            "1.5 3.5 0.25 0.75 -0.375\n");
  write_results_h5(folder / "results.h5", output(), source);
  const store::Hdf5Dataset values = store::read_hdf5(folder / "results.h5", "/spectra/delta_sp_1");
  ASSERT_EQ(values.values.size(), 18U);
  EXPECT_TRUE(std::isnan(values.values[3]));
  EXPECT_EQ(values.values[7], all[2].spectrum[1]);
  EXPECT_EQ(store::read_hdf5(folder / "results.h5", "/spectra/order").values, (std::vector<double>{0.0, 0.5, 1.0}));
}

}  // namespace
}  // namespace epicyclic::reports::response_output_test
