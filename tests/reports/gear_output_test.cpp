// What `epicyclic gear` writes: files, columns, and numbers that must agree with one another.
#include "reports/gear_output.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gnuplot_guard.hpp"
#include "input/study_input.hpp"
#include "model/modes.hpp"
#include "reports/gear_report.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::reports::gear_output_test {
namespace {

using test::TemporaryFolder;

/// Columns of a CSV file without quotes, as texts.
std::map<std::string, std::vector<std::string>> table(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  const auto cells = [](const std::string& text) {
    std::vector<std::string> all;
    std::stringstream row(text);
    for (std::string cell; std::getline(row, cell, ',');) all.push_back(cell);
    if (!text.empty() && text.back() == ',') all.emplace_back();
    return all;
  };
  std::getline(in, line);
  const auto names = cells(line);
  std::map<std::string, std::vector<std::string>> columns;
  while (std::getline(in, line)) {
    const auto row = cells(line);
    for (std::size_t k = 0; k < names.size(); ++k) columns[names[k]].push_back(k < row.size() ? row[k] : "");
  }
  return columns;
}

class GearOutputOfTheStage : public ::testing::Test {
 protected:
  // Drawn once for all tests of the suite: figures take their time.
  static void SetUpTestSuite() {
    folder = new TemporaryFolder;
    const std::vector<std::string> sets = {"/boundary=fixed_ring", "/lumped/ring/torsional_support_N_per_m=1e9"};
    output = new GearOutput(
        write_gear_output(folder->path(), input::load_input("inputs/tang2020.json", input::parse_assignments(sets))));
  }
  static void TearDownTestSuite() {
    delete output;
    delete folder;
  }
  static double quantity(const std::string& name) {
    const auto all = table(*folder / "geometry.csv");
    for (std::size_t k = 0; k < all.at("name").size(); ++k)
      if (all.at("name")[k] == name) return std::stod(all.at("value")[k]);
    ADD_FAILURE() << "no " << name;
    return std::numeric_limits<double>::quiet_NaN();
  }
  static TemporaryFolder* folder;
  static GearOutput* output;
};

TemporaryFolder* GearOutputOfTheStage::folder = nullptr;
GearOutput* GearOutputOfTheStage::output = nullptr;

TEST_F(GearOutputOfTheStage, HasEachFileAndFigure) {
  for (const char* file :
       {"modes.csv", "mode_shapes.csv", "campbell.csv", "geometry.csv", "stiffness.csv", "load_sharing.csv",
        "friction.csv", "friction_ratios.csv", "static_transmission_error.csv", "bearings.csv", "gear.md"})
    EXPECT_TRUE(std::filesystem::exists(*folder / file)) << file;
  EXPECT_TRUE(output->undrawn.empty());
  for (const std::string& stem : output->figures)
    EXPECT_TRUE(std::filesystem::exists(folder->path() / "figures" / (stem + ".png"))) << stem;
  EXPECT_GE(output->figures.size(), 8U);
}

TEST_F(GearOutputOfTheStage, GeometryIsThatOfTable1) {
  // Half a unit of the last of the digits of docs/theory/gears.md, section 8.
  const auto digits = [](int decimals) { return 0.5 * std::pow(10.0, -decimals); };
  EXPECT_NEAR(quantity("centre_distance"), 71.720839, digits(6));
  EXPECT_NEAR(quantity("ring_module"), 2.57627, digits(5));
  EXPECT_NEAR(quantity("ring_planet_start_beyond_pitch_point"), 1.609, digits(3));
  EXPECT_NEAR(quantity("ring_addendum_bound"), 1.233, digits(3));
  EXPECT_NEAR(quantity("ring_mesh_lead"), 0.3023, digits(4));
}

TEST_F(GearOutputOfTheStage, SaysThatTheRingMeshLiesBeyondItsPitchPoint) {
  ASSERT_EQ(output->verdicts.size(), 7U);  // with the error and what two harmonics lose of each mesh
  EXPECT_EQ(output->verdicts[0].rfind("27/25/81 teeth, 3 planets: ω_m = 20.25 ω_s; at Ω = 1", 0), 0U);
  EXPECT_NE(output->verdicts[1].find("sun-planet mesh lies across"), std::string::npos);
  EXPECT_NE(output->verdicts[2].find("ring-planet mesh lies wholly beyond"), std::string::npos);
  EXPECT_NE(output->verdicts[4].find("2 harmonics of the stiffness of the sun-planet mesh vary by"), std::string::npos);
  EXPECT_EQ(output->verdicts[6].rfind("The amplitude of the transmission error: sun-planet 8.5 um on a static", 0), 0U);
}

TEST_F(GearOutputOfTheStage, StiffnessHasBothSidesOfEachJumpAndTheMeanOfItsSeries) {
  const auto all = table(*folder / "stiffness.csv");
  const auto& phase = all.at("phase");
  const auto& k_sp = all.at("k_sp_N_per_m");
  double jump = 0.0;
  double area = 0.0;
  double fourier = 0.0;
  for (std::size_t i = 0; i + 1 < phase.size(); ++i) {
    const double step = std::stod(phase[i + 1]) - std::stod(phase[i]);
    ASSERT_GE(step, 0.0);
    if (step == 0.0) jump = std::max(jump, std::abs(std::stod(k_sp[i + 1]) - std::stod(k_sp[i])));
    area += 0.5 * step * (std::stod(k_sp[i]) + std::stod(k_sp[i + 1]));
    fourier += step * std::stod(all.at("k_sp_fourier_N_per_m")[i]);
  }
  EXPECT_GT(jump, 5e8);
  // The rectangle and trapezoid rules over 500 rows.
  constexpr double of_first_order = 1e-5 + 2.0 / 500.0;
  EXPECT_NEAR(area / quantity("sun_planet_stiffness_mean"), 1.0, of_first_order);
  EXPECT_NEAR(fourier / quantity("sun_planet_stiffness_mean"), 1.0, of_first_order);
}

TEST_F(GearOutputOfTheStage, InPhaseModesStandWhereTheDesignPageHasThem) {
  // The two rotational modes in which the meshes hold most of the elastic energy: near 1.19 and 1.57.
  const auto all = table(*folder / "modes.csv");
  std::multimap<double, double> by_energy;
  for (std::size_t k = 0; k < all.at("type").size(); ++k)
    if (all.at("type")[k] == "rotational" && std::stod(all.at("frequency_ratio")[k]) > 0.0)
      by_energy.emplace(
          -std::stod(all.at("elastic_sun_planet_mesh")[k]) - std::stod(all.at("elastic_ring_planet_mesh")[k]),
          std::stod(all.at("frequency_ratio")[k]));
  std::set<double> two;
  for (auto it = by_energy.begin(); two.size() < 2; ++it) two.insert(it->second);
  constexpr double digits = 0.5e-2;  // half a unit of the page's last one
  EXPECT_NEAR(*two.begin(), 1.19, digits);
  EXPECT_NEAR(*two.rbegin(), 1.57, digits);
}

TEST_F(GearOutputOfTheStage, EnergySharesAddUpToOne) {
  const auto all = table(*folder / "modes.csv");
  constexpr double rounding = 1e-14;  // of shares that are printed with all their digits
  for (std::size_t k = 0; k < all.at("mode").size(); ++k) {
    double elastic = 0.0;
    double kinetic = 0.0;
    for (const auto& [name, values] : all) {
      if (name.rfind("elastic_", 0) == 0) elastic += std::stod(values[k]);
      if (name.rfind("kinetic_", 0) == 0) kinetic += std::stod(values[k]);
    }
    EXPECT_NEAR(kinetic, 1.0, rounding);
    EXPECT_NEAR(elastic, std::stod(all.at("frequency_ratio")[k]) > 0.0 ? 1.0 : 0.0, rounding);
  }
}

TEST_F(GearOutputOfTheStage, FrictionOpposesSlidingAllAlongBothPaths) {
  const auto all = table(*folder / "friction.csv");
  for (std::size_t k = 0; k < all.at("mesh").size(); ++k) {
    EXPECT_LE(std::stod(all.at("signed_ratio")[k]) * std::stod(all.at("sliding_m_per_s")[k]), 0.0);
    if (all.at("mesh")[k] == "rp") {
      EXPECT_GT(std::stod(all.at("sliding_m_per_s")[k]), 0.0);
    }
  }
}

TEST_F(GearOutputOfTheStage, ThePageHasEachQuantityAndOrigin) {
  std::ifstream in(*folder / "gear.md");
  const std::string page((std::istreambuf_iterator<char>(in)), {});
  for (const char* part : {"| centre_distance | a | 71.72084 | mm | [G-a0] |",
                           "| `/catalogue/sun/module_mm` | 2.63 | mm | source: Table 1 |",
                           "| `/lumped/sun/mass_kg` | 1.654275 | kg | computed: [G-M]", "figures/stiffness_sp.png"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
}

TEST(GearOutput, OfALumpedStageIsItsModes) {
  const TemporaryFolder folder;
  const GearOutput output = write_gear_output(folder.path(), input::load_input("inputs/lin_parker_1999_n4.json"));
  EXPECT_TRUE(std::filesystem::exists(folder / "campbell.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder / "stiffness.csv"));
  EXPECT_NE(output.modes.find("mode,frequency_Hz,frequency_ratio,type,multiplicity"), std::string::npos);
}

/// gear.md without figures.
std::string page_of(const std::string& file, const std::vector<std::string>& sets) {
  const test::WithoutGnuplot guard;
  const TemporaryFolder folder;
  (void)write_gear_output(folder.path(), input::load_input(file, input::parse_assignments(sets)));
  std::ifstream in(folder / "gear.md");
  return {std::istreambuf_iterator<char>(in), {}};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(GearOutput, SaysWhichHarmonicsExciteRotationalModes) {
  const std::string file = "inputs/lin_parker_1999_n3.json";
  const std::string stand =
      "Rotational modes, in which all planets have the same deflections in their own directions, are at";
  const std::string in_phase = page_of(file, {"/lumped/sun/teeth=27"});
  EXPECT_TRUE(contains(in_phase, stand));
  EXPECT_TRUE(contains(in_phase, "mesh in phase (z_s/N = 9 is an integer)"));
  const std::string out_of_phase = page_of(file, {"/lumped/sun/teeth=28"});
  EXPECT_TRUE(contains(out_of_phase, stand));
  EXPECT_TRUE(contains(out_of_phase, "(z_s/N = 28/3). With equal planets the harmonics 3, 6, ..."));
  const std::string four = page_of("inputs/lin_parker_1999_n4.json", {"/lumped/sun/teeth=26"});
  EXPECT_TRUE(contains(four, "(z_s/N = 26/4). With equal planets the harmonics 2, 4, ..."));
  // Without equal spacing no mode is rotational, and the sentence does not end in nothing.
  const std::string uneven = page_of(file, {"/lumped/sun/teeth=27", "/planets/angles_deg=[0,117,243]"});
  EXPECT_FALSE(contains(uneven, "own directions, are at"));
  EXPECT_TRUE(contains(uneven, "None of these modes is rotational"));
  // Unevenly spaced, but with sums of cosines and sines of 0: rotational modes, and nothing is said of harmonics.
  const std::string opposite =
      page_of("inputs/lin_parker_1999_n4.json", {"/lumped/sun/teeth=26", "/planets/angles_deg=[0,80,180,260]"});
  EXPECT_TRUE(contains(opposite, stand));
  EXPECT_FALSE(contains(opposite, "harmonics"));
}

TEST(GearOutput, TellsFromWhatAddendumOnTheRingMeshCrossesItsPitchPoint) {
  const std::string bound = "if the addendum coefficient of the ring is below 1.2328 (";
  EXPECT_TRUE(contains(page_of("inputs/tang2020.json", {}), bound + "it is 1)"));
  EXPECT_TRUE(contains(page_of("inputs/tang2020.json", {"/catalogue/ring/tip_diameter_mm=207"}),
                       bound + "the tip diameter given stands for 1.3256)"));
}

TEST(GearOutput, TheActiveFlankOfTheRingReachesWhereThePlanetsTipsDo) {
  // hypot(r_br, N_1 N_2 + end) = hypot(96.5354, 26.2599 + 22.2857), and the ring's tips are at 104.339.
  EXPECT_TRUE(contains(page_of("inputs/tang2020.json", {}), "| ring_planet_active_radius_driven | r_A2 | 108.05"));
}

TEST(GearOutput, TellsTheBodyUnderTheTeethAndWhatIsoSays) {
  const std::string page = page_of("inputs/tang2020.json", {"/catalogue/sun/body_radius_ratio=null"});
  for (const char* row : {"| sun_planet_driving_body_radius_ratio | h_f | 1.4 |",
                          "| sun_planet_driven_body_radius_ratio | h_f | 1.437534 |", "_root_half_angle | θ_f | 0.0",
                          "| sun_planet_iso_ratio | k_0/(c_γ b) | 1.", "| `/catalogue/sun/body_radius_ratio` | 1.4 |"})
    EXPECT_TRUE(contains(page, row)) << row;
}

TEST(GearOutput, AMeshWithoutBacklashHasNone) {
  // At the centre distance without backlash rounding left 4e-12 um.
  for (const char* shift : {"0.623", "0.61", "0.6", "0.59"}) {
    const input::LoadedInput input = input::load_input(
        "inputs/tang2020.json",
        input::parse_assignments(std::vector<std::string>{"/lumped/sun_planet_mesh/backlash_half_um=null",
                                                          std::string("/catalogue/sun/profile_shift=") + shift}));
    EXPECT_EQ(input.study.stage.sun_planet_mesh.backlash_half_um, 0.0) << shift;
  }
}

TEST(ModeRanges, HoldTheFrequenciesOfEachStageWithinTheRanges) {
  std::ifstream file("inputs/lin_parker_1999_n4.json");
  nlohmann::json stated = nlohmann::json::parse(file);
  stated["lumped"]["planet"]["origin"] = {{"bearing_N_per_m", "estimate: 2e7 to 9e8, rollers"},
                                          {"mass_kg", "estimate: 0.5 to 0.9, by the rim"}};
  stated["lumped"]["ring"]["origin"] = {{"torsional_support_N_per_m", "estimate: 1e8 to 4e9, housing"}};
  const TemporaryFolder folder;
  std::ofstream(folder / "stage.json") << stated.dump();
  const input::LoadedInput input = input::load_input(folder / "stage.json");
  const auto modes_of = [](const gear::Stage& stage) { return model::modes(stage, model::scales_of(stage)); };
  const std::vector<model::Mode> modes = modes_of(input.study.stage);
  const std::vector<ModeRange> ranges = mode_ranges(input, modes);
  ASSERT_EQ(ranges.size(), modes.size());
  // Frequencies by type, rising: each is followed by its place.
  const auto by_type = [&](const gear::Stage& stage, const std::vector<model::Mode>& of) {
    std::map<model::ModeType, std::vector<double>> all;
    for (const model::Mode& m : of)
      all[m.type].insert(all[m.type].end(), static_cast<std::size_t>(m.multiplicity),
                         m.frequency_ratio * model::scales_of(stage).omega_sn / (2.0 * std::numbers::pi));
    return all;
  };
  constexpr double rounding = 1e-6;
  double widest = 1.0;
  std::mt19937 random(62);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const auto between = [&](double from, double to) { return from * std::pow(to / from, u(random)); };
  for (int draw = 0; draw < 200; ++draw) {
    const gear::Stage stage = input
                                  .with_values(std::vector<input::PointerValue>{
                                      {"/lumped/planet/bearing_N_per_m", between(2e7, 9e8)},
                                      {"/lumped/planet/mass_kg", between(0.5, 0.9)},
                                      {"/lumped/ring/torsional_support_N_per_m", between(1e8, 4e9)}})
                                  .stage;
    const auto drawn = by_type(stage, modes_of(stage));
    std::map<model::ModeType, std::size_t> place;
    for (std::size_t k = 0; k < modes.size(); ++k) {
      for (int copy = 0; copy < modes[k].multiplicity; ++copy) {
        const double f = drawn.at(modes[k].type).at(place[modes[k].type]++);
        EXPECT_GE(f, ranges[k].from * (1.0 - rounding)) << "mode " << k + 1 << " of draw " << draw;
        EXPECT_LE(f, ranges[k].to * (1.0 + rounding)) << "mode " << k + 1 << " of draw " << draw;
      }
      if (ranges[k].from > 0.0) widest = std::max(widest, ranges[k].to / ranges[k].from);
    }
  }
  EXPECT_GT(widest, 2.0);  // or nothing was tried
  // Without ranges there are none.
  const input::LoadedInput bare = input::load_input("inputs/lin_parker_1999_n4.json");
  EXPECT_TRUE(mode_ranges(bare, modes_of(bare.study.stage)).empty());
}

}  // namespace
}  // namespace epicyclic::reports::gear_output_test
