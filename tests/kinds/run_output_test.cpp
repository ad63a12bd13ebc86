#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "gnuplot_guard.hpp"
#include "kinds/run/output.hpp"
#include "store/hdf5_file.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::kinds::run_output_test {
using namespace reports;

namespace {

using test::contents;
using test::TemporaryFolder;

constexpr double pi = std::numbers::pi;
constexpr int planets = 3;
constexpr int phases = 32;
constexpr int periods = 12;
constexpr double omega = 1.25;
constexpr double rounding = 1e-14;  // a few operations on numbers of order 1

constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

constexpr double start = 0.4;  // of the motion [rad], so that nothing falls onto a sample by chance

/// delta = 2 + sin u + 0.25 sin u/2: period 2, rising through the flank at b = 2 where u is a multiple of 2 pi.
double deflection(double s) { return 2.0 + std::sin(s - start) + 0.25 * std::sin(0.5 * (s - start)); }
double rate(double s) { return omega * (std::cos(s - start) + 0.125 * std::cos(0.5 * (s - start))); }

/// What a run of three equal planets with a motion of period 2 would come to, by hand.
/// @param lag  of planet 2 behind planet 1 [rad]
studies::RunResult result_of(double lag = 0.0) {
  studies::RunResult r;
  r.omega = omega;
  r.static_force = 800.0;
  studies::History& h = r.history;
  h.phases = phases;
  const auto add = [&](const std::string& name, const std::string& unit) {
    h.columns.push_back(name);
    h.units.push_back(unit);
  };
  add("periods", "1");
  add("tau", "1");
  add("x_s", "b_c");
  add("x_s_rate", "b_c per tau");
  for (const char* end : {"", "_rate"})
    for (const char* mesh : {"sp_", "rp_"})
      for (int i = 1; i <= planets; ++i)
        add(std::string("delta_") + mesh + std::to_string(i) + end, *end == 0 ? "b_c" : "b_c per tau");
  for (const char* mesh : {"sp_", "rp_"})
    for (int i = 1; i <= planets; ++i) add(std::string("force_") + mesh + std::to_string(i), "N");
  std::vector<double> signal;
  for (int k = 1; k <= periods * phases; ++k) {
    const double s = 2.0 * pi * k / phases;
    std::vector<double> row{static_cast<double>(k) / phases, s / omega, std::sin(s), omega * std::cos(s)};
    for (int mesh = 0; mesh < 2 * planets; ++mesh) row.push_back(deflection(s - (mesh % planets == 1 ? lag : 0.0)));
    for (int mesh = 0; mesh < 2 * planets; ++mesh) row.push_back(rate(s));
    for (int mesh = 0; mesh < 2 * planets; ++mesh)
      row.push_back(1000.0 * std::max(0.0, row[4 + at(mesh)] - 2.0) + (mesh < planets ? 0.0 : 5.0));
    h.values.insert(h.values.end(), row.begin(), row.end());
    if (k > (periods - 2) * phases) signal.push_back(10.0 * row[4]);
    if (k % phases == 0)
      r.point.poincare.insert(r.point.poincare.end(), {row[2], row[3], row[4], row[4 + at(planets)]});
  }
  r.point.poincare_columns = 4;
  for (const char* kind : {"sp_", "rp_"})
    for (int i = 1; i <= planets; ++i) {
      studies::MeshSummary m;
      m.name = kind + std::to_string(i);
      m.force_mean = 401.5;
      m.force_max = 1187.25;
      m.force_ratio_max = 1.484;
      m.kv = 1.25;
      m.load_sharing = 1.0;
      m.drive = 0.5;
      m.loss = 0.5;
      m.contact_losses = 6;
      r.meshes.push_back(m);
    }
  studies::SignalSpectrum sp;
  sp.signal = "delta_sp_1";
  sp.unit = "um";
  sp.exact = true;
  sp.spectrum = analysis::amplitude_spectrum(signal, 1.0 / phases, analysis::Window::rectangular);
  sp.lines = analysis::harmonics(signal, 2);
  r.spectra.push_back(sp);

  r.crossing.dimension = 2;
  r.crossing.states = {0.5, 1.5, 0.25, 1.75};
  r.crossing_phase = {0.125, 6.0};
  r.crossing_rate = {0.75, 1.25};

  analysis::LyapunovSpectrum& e = r.exponents;
  e.exponents = 2;
  e.interval = 2.0 * pi;
  e.growth = {-0.1, -1.0, -0.3, -1.2, -0.2, -0.8, -0.2, -1.0};
  e.per_s = {{-0.2 / (2.0 * pi), 0.01}, {-1.0 / (2.0 * pi), 0.02}};
  r.checks.emplace();
  r.checks->sum = -0.25;
  r.checks->divergence = -0.25 + 3e-9;
  r.checks->multipliers = 4e-7;
  r.checks->inside = 2;
  r.checks->compared = 2;
  r.checks->step_control = 5e-8;
  r.transverse = analysis::Estimate{0.031, 0.004};

  analysis::PeriodicOrbit orbit;
  orbit.outcome = analysis::OrbitOutcome::converged;
  orbit.state = {0.0, 1.25};
  orbit.monodromy = Eigen::MatrixXd(2, 2);
  orbit.monodromy << 0.6, -0.1, 0.2, 0.5;
  orbit.residuals = {1e-4, 3e-13};
  r.orbit = orbit;
  analysis::FloquetMultipliers m;
  m.values = {{0.3, 0.4}, {0.3, -0.4}};
  m.errors = {1e-8, 1e-8};
  m.multiplicity = {2, 2};
  r.multipliers = m;

  studies::PointResult& p = r.point;
  p.point.value = omega;
  p.regime = analysis::Regime::periodic;
  p.period = 2;
  p.classified = true;
  p.recurrence.period = 2;
  p.recurrence.error = 2e-10;
  p.evidence.periods = 192;
  p.evidence.residual = 6e-12;
  p.evidence.largest_multiplier = 0.5;
  p.evidence.multiplier_error = 1e-8;
  p.evidence.exponent = {std::log(0.5) / (4.0 * pi), 0.0};
  p.evidence.note = "attracted to the orbit of period 2 from 0.01 away";
  p.rhs_evaluations = 424242;
  p.meshes.sun_planet.resize(at(planets));
  p.meshes.ring_planet.resize(at(planets));
  p.meshes.planet_bearing.resize(at(planets));
  p.omega = omega;
  return r;
}

RunOutput output() {
  RunOutput o;
  o.options.shown_periods = 3;
  o.points.sweep.recording.recorded_periods = periods;
  o.points.poincare_columns = {"x_s", "x_s_rate", "delta_sp_1", "delta_rp_1"};
  o.points.resolved_input = "{\"stage\": {}}";
  o.points.title = "by_hand, Ω = 1.25";
  o.half_gap_sp = 2.0;
  o.half_gap_rp = 2.0;
  return o;
}

studies::RunResult failed() {
  studies::RunResult r;
  r.omega = omega;
  r.point.outcome = integrate::Outcome::diverged;
  r.point.message = "component 3 left the escape bound at s = 17.5";
  r.point.meshes.sun_planet.resize(at(planets));
  r.point.meshes.ring_planet.resize(at(planets));
  r.point.meshes.planet_bearing.resize(at(planets));
  return r;
}

/// Cells of a table without quoted texts.
std::vector<std::vector<std::string>> cells(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

void expect_row(const std::vector<std::string>& row, const std::vector<double>& expected) {
  ASSERT_EQ(row.size(), expected.size());
  for (std::size_t k = 0; k < row.size(); ++k) EXPECT_NEAR(std::stod(row[k]), expected[k], rounding) << k;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Text in which lines do not matter.
std::string on_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\n';
    if (!blank || (!line.empty() && line.back() != ' ')) line += blank ? ' ' : c;
  }
  return line;
}

TEST(RunTables, HistoryIsTheLastPeriodsOfTheRecord) {
  const TemporaryFolder folder;
  const studies::RunResult r = result_of();
  write_run_tables(folder.path(), output(), r);
  const auto rows = cells(contents(folder / "history.csv"));
  ASSERT_EQ(rows.size(), 1 + at(3 * phases));
  const std::size_t width = r.history.columns.size();
  ASSERT_GT(rows[0].size(), width);
  EXPECT_EQ(std::vector(rows[0].begin(), rows[0].begin() + static_cast<std::ptrdiff_t>(width)), r.history.columns);
  EXPECT_EQ(std::stod(rows[1][0]), 9.0 + 1.0 / phases);
  EXPECT_EQ(std::stod(rows.back()[0]), 12.0);
  EXPECT_EQ(std::stod(rows[1][4]), deflection(2.0 * pi * (9 * phases + 1) / phases));
}

TEST(RunTables, HistoryIsInSecondsMicrometresAndMetresPerSecondToo) {
  const TemporaryFolder folder;
  studies::RunResult r = result_of();
  r.omega_sn = 2000.0;
  write_run_tables(folder.path(), output(), r);
  const auto rows = cells(contents(folder / "history.csv"));
  const auto number = [&](const std::string& column) {
    const auto found = std::find(rows[0].begin(), rows[0].end(), column);
    EXPECT_NE(found, rows[0].end()) << column;
    return found == rows[0].end() ? 0.0 : std::stod(rows[5][static_cast<std::size_t>(found - rows[0].begin())]);
  };
  constexpr double of_one_product = 1e-14;
  EXPECT_NEAR(number("time_s") * 2000.0 / number("tau"), 1.0, of_one_product);
  for (const char* of_length : {"x_s", "delta_sp_1", "delta_rp_1"})
    EXPECT_NEAR(number(of_length + std::string("_um")) / (10.0 * number(of_length)), 1.0, of_one_product) << of_length;
  // b_c omega_sn = 1e-5 m * 2000 / s.
  for (const char* of_rate : {"x_s_rate", "delta_sp_1_rate"})
    EXPECT_NEAR(number(of_rate + std::string("_m_per_s")) / (0.02 * number(of_rate)), 1.0, of_one_product) << of_rate;
}

TEST(RunTables, FirstRowIsZeroForAShortRecord) {
  const studies::RunResult r = result_of();
  EXPECT_EQ(first_row(r.history, 3), at((periods - 3) * phases));
  EXPECT_EQ(first_row(r.history, periods), 0U);
  EXPECT_EQ(first_row(r.history, periods + 1), 0U);
  EXPECT_EQ(first_row(r.history, 0), r.history.rows());
  EXPECT_EQ(first_row({}, 3), 0U);
}

TEST(RunTables, SpectrumNamesLinesOfAPeriodicMotion) {
  const TemporaryFolder folder;
  write_run_tables(folder.path(), output(), result_of());
  const auto rows = cells(contents(folder / "spectrum.csv"));
  ASSERT_EQ(rows.size(), 2 + at(phases));
  EXPECT_EQ(rows[0], (std::vector<std::string>{"signal", "unit", "exact", "frequency", "line", "amplitude", "phase"}));
  EXPECT_EQ((std::vector<std::string>(rows[2].begin(), rows[2].begin() + 5)),
            (std::vector<std::string>{"delta_sp_1", "um", "1", "0.5", "1/2"}));
  EXPECT_EQ(rows[3][4], "1");
  constexpr double transform = 1e-12;  // rounding of a sum over the samples
  EXPECT_NEAR(std::stod(rows[1][5]), 20.0, transform);
  EXPECT_NEAR(std::stod(rows[2][5]), 2.5, transform);
  EXPECT_NEAR(std::stod(rows[3][5]), 10.0, transform);
}

TEST(RunTables, SpectrumThroughAWindowEndsAtTheTabulatedFrequency) {
  const TemporaryFolder folder;
  studies::RunResult r = result_of();
  r.spectra[0].exact = false;
  r.spectra[0].lines.clear();
  r.spectra[0].spectrum = {0.25, std::vector<double>(400, 0.5), std::vector<double>(400, 0.0)};
  write_run_tables(folder.path(), output(), r);
  const auto rows = cells(contents(folder / "spectrum.csv"));
  EXPECT_EQ(rows.size(), 2 + static_cast<std::size_t>(tabulated_frequency / 0.25));
  EXPECT_EQ(rows.back()[3], "20");
  EXPECT_EQ(rows.back()[4], "");
}

TEST(RunTables, ExponentsAreRunningMeansPerTau) {
  const TemporaryFolder folder;
  write_run_tables(folder.path(), output(), result_of());
  const auto rows = cells(contents(folder / "exponents.csv"));
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"periods", "lambda_1", "lambda_2"}));
  constexpr double per_tau = omega / (2.0 * pi);
  expect_row(rows[1], {1.0, -0.1 * per_tau, -1.0 * per_tau});
  expect_row(rows[2], {2.0, -0.2 * per_tau, -1.1 * per_tau});
  expect_row(rows[4], {4.0, -0.2 * per_tau, -1.0 * per_tau});
}

TEST(RunTables, MultipliersHaveTheirExponents) {
  const TemporaryFolder folder;
  write_run_tables(folder.path(), output(), result_of());
  const auto rows = cells(contents(folder / "multipliers.csv"));
  ASSERT_EQ(rows.size(), 3U);
  // A period of 2 mesh periods takes 4 pi / Omega.
  const double exponent = std::log(0.5) * omega / (4.0 * pi);
  expect_row(rows[1], {0, 0.3, 0.4, 0.5, std::atan2(0.4, 0.3), 1e-8, 2, 1, exponent});
  expect_row(rows[2], {1, 0.3, -0.4, 0.5, -std::atan2(0.4, 0.3), 1e-8, 2, 0, exponent});
}

TEST(RunTables, CrossingHasPhaseAndState) {
  const TemporaryFolder folder;
  write_run_tables(folder.path(), output(), result_of());
  EXPECT_EQ(contents(folder / "crossing.csv"),
            "index,phase,delta_sp_1_rate,x_s,x_s_rate\n0,0.125,0.75,0.5,1.5\n1,6,1.25,0.25,1.75\n");
}

TEST(RunTables, NothingToSayHasNoTable) {
  const TemporaryFolder folder;
  write_run_tables(folder.path(), output(), failed());
  EXPECT_EQ(test::entries(folder.path()), 0U);
}

TEST(RunTables, ExponentsThatWereNotReachedHaveNoTable) {
  const TemporaryFolder folder;
  studies::RunResult r = result_of();
  r.exponents.per_s.clear();
  r.exponents.evolution = {integrate::Outcome::step_limit, 3.0, "too many steps"};
  write_run_tables(folder.path(), output(), r);
  EXPECT_FALSE(std::filesystem::exists(folder / "exponents.csv"));
  EXPECT_TRUE(contains(on_one_line(run_summary(output(), r)), "ended early, step_limit: too many steps"));
}

TEST(RunTables, FullDiskIsAnError) {
  const TemporaryFolder folder;
  const test::FileSizeLimit limit(64);
  EXPECT_THROW(write_run_tables(folder.path(), output(), result_of()), OutputError);
}

TEST(RunH5, HoldsTheWholeRecordAndTheOrbit) {
  const TemporaryFolder folder;
  const auto file = folder / "results.h5";
  const studies::RunResult r = result_of();
  write_run_h5(file, output(), r);
  EXPECT_EQ(store::read_hdf5_attribute(file, "/", "input_resolved"), "{\"stage\": {}}");
  const std::size_t width = r.history.columns.size();
  for (std::size_t j = 0; j < width; ++j) {
    const std::string path = "/history/" + r.history.columns[j];
    const store::Hdf5Dataset column = store::read_hdf5(file, path);
    ASSERT_EQ(column.shape, std::vector<std::size_t>{at(periods * phases)});
    for (std::size_t row = 0; row < column.shape[0]; ++row)
      ASSERT_EQ(column.values[row], r.history.values[row * width + j]) << row << ' ' << j;
    EXPECT_EQ(store::read_hdf5_attribute(file, path, "units"), r.history.units[j]);
  }
  // Row by row.
  EXPECT_EQ(store::read_hdf5(file, "/orbit/monodromy").values, (std::vector<double>{0.6, -0.1, 0.2, 0.5}));
  EXPECT_EQ(store::read_hdf5(file, "/orbit/state").values, (std::vector<double>{0.0, 1.25}));
  EXPECT_EQ(store::read_hdf5_texts(file, "/orbit/state_names"), (std::vector<std::string>{"x_s", "x_s_rate"}));
  EXPECT_EQ(store::read_hdf5(file, "/multipliers/im").values, (std::vector<double>{0.4, -0.4}));
  for (const std::string& name : output().points.poincare_columns)
    EXPECT_EQ(store::read_hdf5(file, "/poincare/" + name).shape, std::vector<std::size_t>{at(periods)});
  EXPECT_EQ(store::read_hdf5(file, "/crossing/phase").values, (std::vector<double>{0.125, 6.0}));
}

TEST(RunH5, HoldsRegimeMeshesSpectraAndExponentsWithUnits) {
  const TemporaryFolder folder;
  const auto file = folder / "results.h5";
  const studies::RunResult r = result_of();
  write_run_h5(file, output(), r);
  EXPECT_EQ(store::read_hdf5_texts(file, "/point/regime"), (std::vector<std::string>{"periodic"}));
  EXPECT_EQ(store::read_hdf5(file, "/point/period").values, (std::vector<double>{2}));
  EXPECT_EQ(store::read_hdf5(file, "/evidence/residual").values, (std::vector<double>{6e-12}));
  EXPECT_NEAR(store::read_hdf5(file, "/evidence/exponent").values.at(0), std::log(0.5) * omega / (4.0 * pi), rounding);
  EXPECT_EQ(store::read_hdf5_attribute(file, "/evidence/exponent", "units"), "per tau");
  EXPECT_EQ(store::read_hdf5_texts(file, "/meshes/name").at(3), "rp_1");
  EXPECT_EQ(store::read_hdf5(file, "/meshes/force_max").values, std::vector<double>(6, 1187.25));
  EXPECT_EQ(store::read_hdf5_attribute(file, "/meshes/force_max", "units"), "N");
  EXPECT_EQ(store::read_hdf5(file, "/spectra/delta_sp_1/amplitude").values, r.spectra[0].spectrum.amplitude);
  EXPECT_EQ(store::read_hdf5_attribute(file, "/spectra/delta_sp_1/amplitude", "units"), "um");
  EXPECT_EQ(store::read_hdf5_texts(file, "/spectra/delta_sp_1/lines/label").at(1), "1/2");
  EXPECT_EQ(store::read_hdf5(file, "/exponents/growth").shape, (std::vector<std::size_t>{4, 2}));
  EXPECT_NEAR(store::read_hdf5(file, "/exponents/value").values.at(1), -omega / (2.0 * pi), rounding);
  EXPECT_EQ(store::read_hdf5(file, "/exponents/checks/sum").values, (std::vector<double>{-0.25}));
  EXPECT_EQ(store::read_hdf5(file, "/transverse/exponent").values, (std::vector<double>{0.031}));
}

TEST(RunH5, IsTheSameTwiceAndHoldsAFailure) {
  const TemporaryFolder folder;
  write_run_h5(folder / "a.h5", output(), result_of());
  write_run_h5(folder / "b.h5", output(), result_of());
  EXPECT_EQ(contents(folder / "a.h5"), contents(folder / "b.h5"));
  write_run_h5(folder / "c.h5", output(), failed());
  EXPECT_EQ(store::read_hdf5_texts(folder / "c.h5", "/point/status"), (std::vector<std::string>{"diverged"}));
}

TEST(StrongestLines, AreLabelledInLowestTermsWithoutMeanAndRounding) {
  const std::vector<SpectralLine> lines = strongest_lines(result_of().spectra[0], 5);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].label, "1");
  EXPECT_TRUE(lines[0].of_mesh);
  EXPECT_EQ(lines[1].label, "1/2");
  EXPECT_EQ(lines[1].frequency, 0.5);
  EXPECT_FALSE(lines[1].of_mesh);
  EXPECT_EQ(strongest_lines(result_of().spectra[0], 1).size(), 1U);
}

TEST(StrongestLines, OfPeaksLeaveOutTheMainLobeOfTheMean) {
  studies::SignalSpectrum s;
  s.spectrum.resolution = 0.01;
  s.peaks = {{0.01, 50.0, 0, 0.01}, {0.3819, 2.0, 0, 0.3819}, {1.002, 9.0, 1, 0.002}};
  const std::vector<SpectralLine> lines = strongest_lines(s, 5);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].label, "1");
  EXPECT_EQ(lines[1].label, "0.3819");
}

TEST(RunSummary, TellsAPeriodicMotionWithItsEvidence) {
  const std::string text = run_summary(output(), result_of());
  const std::string line = on_one_line(text);
  EXPECT_TRUE(text.starts_with("# by_hand, Ω = 1.25\n")) << text;
  for (const char* part :
       {"Periodic: the states repeat after 2 mesh periods", "F_0 = 800.0 N", "closes to 6e-12",
        "0.3 + 0.4i, modulus 0.500000000 ± 1.0e-08, one of 2", "The orbit is stable",
        "-0.0689486250 ± 2.0e-09 per tau (-0.346573590 ± 1.0e-08 per mesh period)",
        "Integrated for the classification: 192 mesh periods",
        "| sp_1 | 401.5 | 0 | 1187.2 | 1.484 | 1.250 | 1.0000 | 50.0 % | 50.0 % | 0.0 % | 0.5 |",
        "| delta_sp_1 | um | 1: 10 | 1/2: 2.5 |", "difference 3e-09", "2 of 2 within their intervals",
        "largest difference 5e-08 per tau", "0.0310 ± 0.0040 per tau", "do not stay synchronous",
        "Work: 424242 right-hand sides", "`history.csv`", "last 3 mesh periods", "`multipliers.csv`"})
    EXPECT_TRUE(contains(line, part)) << part << "\n" << text;
}

TEST(RunSummary, SaysWhatTheZeroOneTestSays) {
  auto r = result_of();
  r.point.regime = analysis::Regime::chaotic;
  for (const auto& [k, words] : {std::pair(0.9, "and the 0-1 test agrees"), std::pair(0.4, "the 0-1 test abstains"),
                                 std::pair(0.1, "though the 0-1 test says regular")}) {
    r.point.evidence.zero_one = k;
    EXPECT_TRUE(contains(on_one_line(run_summary(output(), r)), words)) << k;
  }
}

TEST(RunSummary, TellsBetweenWhichDimensionsATorusMayHave) {
  auto r = result_of();
  r.dimension = 0.0;
  r.dimension_low = 0.0;
  r.dimension_high = 1.02;
  EXPECT_TRUE(contains(on_one_line(run_summary(output(), r)),
                       "Dimension of Kaplan and Yorke: 0; by the exponents' intervals 0 to 1.02"));
}

TEST(RunSummary, TellsWhichTeethPullHowHardHowOftenAndWhy) {
  studies::RunResult r = result_of();
  EXPECT_TRUE(contains(on_one_line(run_summary(output(), r)), "No mesh force is tensile"));
  r.meshes[1].tensile_force_max = 3302.0;
  r.meshes[1].tension_time = 0.125;
  r.static_force = 1000.0;
  const std::string summary = on_one_line(run_summary(output(), r));
  EXPECT_TRUE(contains(summary, "| " + r.meshes[1].name));
  EXPECT_TRUE(contains(summary, " 3302 | 3.3 | 12.5 % |"));
  EXPECT_TRUE(contains(summary, "through the open gap"));
  EXPECT_FALSE(contains(summary, "No mesh force is tensile"));
  RunOutput in_contact = output();
  in_contact.gap_damping = model::GapDamping::contact_slope;
  const std::string other = on_one_line(run_summary(in_contact, r));
  EXPECT_TRUE(contains(other, "before contact is lost"));
  EXPECT_FALSE(contains(other, "through the open gap"));
}

TEST(RunSummary, TellsWhatTablesHalfAsFineMoveTheOrbitBy) {
  studies::RunResult r = result_of();
  EXPECT_FALSE(contains(run_summary(output(), r), "half as fine"));
  r.table_displacement = 3.2e-9;
  EXPECT_TRUE(contains(on_one_line(run_summary(output(), r)), "half as fine the orbit is 3.2e-09 away"));
}

TEST(RunSummary, SaysThatTheChaosOfAStartWasATransient) {
  const std::string words = "The start is chaotic, with the same equations of motion: that chaos was a transient.";
  studies::RunResult r = result_of();
  EXPECT_FALSE(contains(on_one_line(run_summary(output(), r)), words));
  RunOutput from_chaos = output();
  from_chaos.start_is_chaotic = true;
  EXPECT_TRUE(contains(on_one_line(run_summary(from_chaos, r)), words));
  for (const auto regime : {analysis::Regime::chaotic, analysis::Regime::undecided}) {
    r.point.regime = regime;
    EXPECT_FALSE(contains(on_one_line(run_summary(from_chaos, r)), words)) << to_string(regime);
  }
}

TEST(RunSummary, SaysThatARecordHasNotReachedTheOrbit) {
  const std::string words = "The record has not reached this orbit, or is too short to show it";
  studies::RunResult r = result_of();
  EXPECT_FALSE(contains(on_one_line(run_summary(output(), r)), words));
  r.point.recurrence = {0, 0.25, 7, 0.25};
  EXPECT_TRUE(contains(on_one_line(run_summary(output(), r)), words));
}

TEST(RunSummary, FitsIntoAHundredColumns) {
  std::istringstream lines(run_summary(output(), result_of()));
  for (std::string line; std::getline(lines, line);) {
    const auto columns = std::count_if(line.begin(), line.end(),
                                       [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; });
    EXPECT_LE(columns, 100) << line;
  }
}

TEST(RunSummary, TellsWhetherSynchronousPlanetsStaySo) {
  studies::RunResult r = result_of();
  r.transverse = analysis::Estimate{-0.03, 0.01};
  EXPECT_TRUE(contains(on_one_line(run_summary(output(), r)), "synchronous planets stay synchronous"));
  r.transverse = analysis::Estimate{-0.03, 0.05};
  EXPECT_TRUE(contains(on_one_line(run_summary(output(), r)), "is not decided"));
}

TEST(RunSummary, TellsChaosAndWhatIsNotDecided) {
  studies::RunResult r = result_of();
  r.multipliers.reset();
  r.orbit.reset();
  r.point.period = 0;
  r.point.regime = analysis::Regime::chaotic;
  r.point.recurrence = {0, 0.25, 7, 0.25};
  r.point.evidence.zero_one = 0.987;
  const std::string chaos = on_one_line(run_summary(output(), r));
  for (const char* part : {"Chaotic: ", "K = 0.987", "does not repeat: nearest after 7 mesh periods, to 0.25"})
    EXPECT_TRUE(contains(chaos, part)) << part << "\n" << chaos;
  EXPECT_FALSE(contains(chaos, "multipliers.csv"));
  r.point.regime = analysis::Regime::undecided;
  EXPECT_TRUE(contains(run_summary(output(), r), "Undecided: "));
  r.point.evidence.zero_one.reset();
  const std::string unasked = on_one_line(run_summary(output(), r));
  EXPECT_TRUE(contains(unasked, "0-1 test: not made, too few periods were integrated")) << unasked;
  EXPECT_FALSE(contains(unasked, "K = ")) << unasked;
}

TEST(RunSummary, SaysWhyAPointFailed) {
  const std::string text = run_summary(output(), failed());
  EXPECT_TRUE(contains(text, "status diverged")) << text;
  EXPECT_TRUE(contains(text, "component 3 left the escape bound at s = 17.5")) << text;
  EXPECT_FALSE(contains(text, "## Regime")) << text;
  EXPECT_FALSE(contains(text, "history.csv")) << text;
}

std::vector<std::string> stems(const std::vector<DrawnFigure>& figures) {
  std::vector<std::string> names;
  for (const DrawnFigure& f : figures) names.push_back(f.file.stem().string());
  return names;
}

TEST(RunFigures, AreDrawnEachWithDataAndScript) {
  EPICYCLIC_NEEDS_GNUPLOT();
  const TemporaryFolder folder;
  const auto figures = draw_run_figures(folder / "figures", output(), result_of());
  EXPECT_EQ(stems(figures),
            (std::vector<std::string>{"history", "phase_portrait", "poincare_section", "poincare_crossing", "spectrum",
                                      "exponents", "multipliers", "contact", "mesh_force"}));
  for (const DrawnFigure& f : figures) {
    EXPECT_TRUE(f.outcome.drawn()) << f.outcome.message;
    for (const char* end : {".png", ".svg", ".dat", ".gp"})
      EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(f.file).replace_extension(end))) << f.file << end;
  }
}

TEST(RunFigures, WhatThereIsNotIsLeftOut) {
  const TemporaryFolder folder;
  EXPECT_TRUE(draw_run_figures(folder / "figures", output(), failed()).empty());
  studies::RunResult r = result_of();
  r.multipliers.reset();
  r.exponents = {};
  r.crossing = {};
  r.spectra.clear();
  EXPECT_EQ(stems(draw_run_figures(folder / "figures", output(), r)),
            (std::vector<std::string>{"history", "phase_portrait", "poincare_section", "contact", "mesh_force"}));
}

TEST(RunFigures, ShowTheFirstInstantOfThePeriodsShown) {
  const TemporaryFolder folder;
  (void)draw_run_figures(folder.path(), output(), result_of());
  const std::string data = contents(folder / "history.dat");
  // The flank, then delta_sp_1 from the start of the last three periods.
  EXPECT_TRUE(data.starts_with("0 2\n3 2\n\n\n0 ")) << data.substr(0, 60);
  EXPECT_TRUE(contains(contents(folder / "history.gp"), "set xrange [0:3]"));
}

TEST(RunFigures, ContactIsMadeWhereTheRunSaysSo) {
  const TemporaryFolder folder;
  (void)draw_run_figures(folder.path(), output(), result_of());
  std::istringstream data(contents(folder / "poincare_crossing.dat"));
  std::vector<double> seen;
  for (double x = 0.0; data >> x;) seen.push_back(x);
  const std::vector<double> expected = {0.125 / (2.0 * pi), 0.75, 6.0 / (2.0 * pi), 1.25};
  ASSERT_EQ(seen.size(), expected.size());
  for (std::size_t k = 0; k < seen.size(); ++k) EXPECT_NEAR(seen[k], expected[k], rounding) << k;
}

TEST(RunFigures, PlanetsThatCoincideAreDrawnOnce) {
  const TemporaryFolder folder;
  (void)draw_run_figures(folder / "same", output(), result_of());
  EXPECT_TRUE(contains(contents(folder / "same/mesh_force.gp"), "all planets"));
  (void)draw_run_figures(folder / "apart", output(), result_of(0.01));
  EXPECT_FALSE(contains(contents(folder / "apart/mesh_force.gp"), "all planets"));
  // A frame for each kind of mesh, in which each planet has a colour of its own.
  const std::string apart = contents(folder / "apart/mesh_force.gp");
  for (const char* part : {"F_{sp} / F_0", "F_{rp} / F_0", "planet 3", "set multiplot"})
    EXPECT_TRUE(contains(apart, part)) << part;
}

TEST(RunFigures, MultipliersStandOnASquareCanvas) {
  const TemporaryFolder folder;
  (void)draw_run_figures(folder.path(), output(), result_of());
  const std::string script = contents(folder / "multipliers.gp");
  EXPECT_TRUE(contains(script, "size 1200,1240")) << script;
  EXPECT_TRUE(contains(script, "set size ratio -1")) << script;
  // Both of the conjugate pair are marked.
  EXPECT_TRUE(contains(contents(folder / "multipliers.dat"), "0.3 0.4\n0.3 -0.4\n\n\n0.3 0.4\n0.3 -0.4\n"));
}

TEST(RunFigures, AreTheSameTwice) {
  const TemporaryFolder folder;
  const auto figures = draw_run_figures(folder / "a", output(), result_of());
  (void)draw_run_figures(folder / "b", output(), result_of());
  for (const DrawnFigure& f : figures)
    for (const char* end : {".dat", ".gp"}) {
      const std::string name = f.file.stem().string() + end;
      EXPECT_EQ(contents(folder.path() / "a" / name), contents(folder.path() / "b" / name)) << name;
    }
}

}  // namespace
}  // namespace epicyclic::kinds::run_output_test
