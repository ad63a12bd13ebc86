// Warnings of studies: nothing on the project's own inputs, and where they belong.
#include "input/study_model.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lines.hpp"

namespace epicyclic::input::study_model_test {
namespace {

using test::joined;

std::vector<std::string> told(const std::string& file, const std::vector<std::string>& sets = {}) {
  return warnings(load_input(file, parse_assignments(sets)));
}

/// The right-hand side at the default start.
std::vector<double> rates_of(const model::DynamicModel& model) {
  std::vector<double> rates(model.dimension);
  model.right_hand_side(model::segment_at(model.breakpoints, 0.0), 0.0, model.default_start.data(), rates.data());
  return rates;
}

bool has(const std::vector<std::string>& lines, const std::string& part) {
  return joined(lines).find(part) != std::string::npos;
}

TEST(StudyWarnings, TheProjectsOwnInputsHaveNone) {
  int looked_at = 0;
  for (const auto& entry : std::filesystem::directory_iterator("inputs")) {
    const std::vector<std::string> lines = told(entry.path().string());
    ++looked_at;
    const std::string name = entry.path().filename();
    if (name == "tang2020.json" || name == "tang2020_calibrated.json" ||
        name == "tang2020_calibrated_fixed_ring.json") {  // a stage alone: notes too
      ASSERT_EQ(lines.size(), 1U) << joined(lines);
      EXPECT_TRUE(lines[0].starts_with("warning: /catalogue/ring/module_mm: replaced")) << lines[0];
      continue;
    }
    // Stages fitted to the printed diagrams: mesh stiffness 37 to 39 % above ISO 6336, a thin rim of the ring, and
    // the ring's module replaced, as in the stage of the paper.
    const std::map<std::string, std::vector<std::string>> known{
        {"tang2020_printed_speed.json", {"stiffness_N_per_m: is 1.56328e+09 N/m"}},
        {"tang2020_printed.json",
         {"stiffness_N_per_m: is 1.56328e+09 N/m", "leaves a rim of 8.986 mm", "2.57 mm would give"}},
        {"tang2020_printed_fixed_ring.json", {"stiffness_N_per_m: is 1.57802e+09 N/m", "2.57 mm would give"}}};
    if (const auto expected = known.find(name); expected != known.end()) {
      ASSERT_EQ(lines.size(), expected->second.size()) << joined(lines);
      for (std::size_t k = 0; k < lines.size(); ++k)
        EXPECT_NE(lines[k].find(expected->second[k]), std::string::npos) << lines[k];
      continue;
    }
    EXPECT_EQ(joined(lines), "") << entry.path();
  }
  EXPECT_GT(looked_at, 15);
}

TEST(ModelAt, IsOfTheParameterThatIsAskedFor) {
  const LoadedInput input = load_input("inputs/tang2020_speed.json");
  const double speed = input.study.mesh_frequency_ratio;
  const studies::ModelAt by_damping = model_at(input, "damping_ratio");
  EXPECT_EQ(by_damping(0.07).omega, speed);
  EXPECT_NE(rates_of(by_damping(0.07)), rates_of(by_damping(0.05)));
  const std::string pointer = "/stage/lumped/sun_planet_mesh/damping_ratio";
  EXPECT_NE(rates_of(model_at(input, pointer)(0.07)), rates_of(by_damping(0.05)));
  EXPECT_EQ(model_at(input)(2.1).omega, model_at(input, "mesh_frequency_ratio")(2.1).omega);
  EXPECT_THROW((void)model_at(input, "damping"), InputError);
  EXPECT_THROW((void)model_at(input, "/stage/lumped/sun"), InputError);
}

TEST(StudyWarnings, AParameterWithoutEffectIsTold) {
  const std::string study = "inputs/tang2020_damping_1.21.json";
  const auto swept = [&](const std::string& parameter, const std::string& from, const std::string& to,
                         std::vector<std::string> more = {}) {
    more.insert(more.end(),
                {"/study/parameter=" + parameter, "/study/from=" + from, "/study/to=" + to, "/study/points=3"});
    return told(study, more);
  };
  const std::string words = "warning: /study/parameter: ";
  // A constant stiffness has no contact angle.
  const std::string angle = "/stage/lumped/sun/bearing/contact_angle_deg";
  EXPECT_TRUE(has(swept(angle, "0", "40"), words + angle + " has no effect on the response"));
  EXPECT_FALSE(has(swept(angle, "0", "40", {"/stage/lumped/sun/bearing/law=palmgren_radial"}), "no effect"));
  // A given mass does not follow the bore.
  const std::string bore = "/stage/catalogue/sun/bore_mm";
  EXPECT_FALSE(has(swept(bore, "20", "40"), "no effect"));
  EXPECT_TRUE(
      has(swept(bore, "20", "40", {"/stage/lumped/sun/mass_kg=1.6", "/stage/lumped/sun/inertia_over_r2_kg=1.2"}),
          words + bore + " has no effect on the response"));
  // Gaps far beyond any motion still change the equations.
  EXPECT_FALSE(has(swept("sun_planet_backlash", "1000", "5000"), "no effect"));
  EXPECT_FALSE(has(swept("sun_bearing_clearance", "0", "1"), "no effect"));
}

TEST(StudyWarnings, EndsOfARangeAreLookedAtAndTheWorstOneIsTold) {
  const std::string speed = "inputs/tang2020_speed.json";
  const auto fast = told(speed, {"/study/to=20"});
  EXPECT_TRUE(has(fast, "warning: /stage/lumped/sun: its teeth run at")) << joined(fast);
  const auto strong = told(speed, {"/stage/load/power_kW=100000"});
  ASSERT_FALSE(strong.empty());
  // Torque is power over speed: the greatest force is that of the lowest speed.
  EXPECT_TRUE(has(strong, "warning: /stage/load: the mean force of the sun-planet mesh, 2.18")) << joined(strong);
  const auto wide = told("inputs/tang2020_backlash_1.17.json", {"/study/to=100"});
  EXPECT_TRUE(has(wide, "/stage/lumped/sun_planet_mesh/backlash_half_um: the sun-planet mesh has 2 mm"))
      << joined(wide);
  const auto damped = told("inputs/tang2020_map.json", {"/study/second/to=1.5"});
  EXPECT_TRUE(has(damped, "/stage/lumped/sun_planet_mesh/damping_ratio: is 1.5")) << joined(damped);
}

TEST(StudyWarnings, CentrifugalForceIsMissedWhereNobodyChose) {
  const std::string held = "inputs/tang2020_speed_fixed_ring.json";
  const std::string words = "warning: /model/centrifugal: the centrifugal force of a planet, ";
  const auto nobody = told(held, {"/model=null"});
  EXPECT_EQ(std::ranges::count_if(nobody, [&](const std::string& line) { return line.starts_with(words); }), 1)
      << joined(nobody);
  for (const char* chosen : {"\"left_out\"", "\"included\""})
    EXPECT_FALSE(has(told(held, {std::string("/model/centrifugal=") + chosen}), words)) << chosen;
  EXPECT_FALSE(has(told(held, {"/model=null", "/study/from=0.01", "/study/to=0.02"}), words));  // too slow to matter
  EXPECT_FALSE(has(told("inputs/tang2020_speed.json"), words));  // the paper's equations as they are
}

TEST(StudyWarnings, TheMostImportantComesFirst) {
  const auto lines =
      told("inputs/tang2020_run.json", {"/stage/lumped/sun/support_damping_ratio=0", "/stage/lumped/ring/mass_kg=40",
                                        "/operation/mesh_frequency_ratio=7"});
  ASSERT_EQ(lines.size(), 3U) << joined(lines);
  EXPECT_TRUE(has({lines[0]}, "its teeth run at")) << joined(lines);
  EXPECT_TRUE(has({lines[1]}, "/stage/lumped/ring/mass_kg")) << joined(lines);
  EXPECT_TRUE(has({lines[2]}, "without damping")) << joined(lines);
}

TEST(ModelFamily, HasTheDerivativeByAnyNumberOfTheInput) {
  const LoadedInput input = load_input("inputs/tang2020_speed.json");
  struct Row {
    const char* parameter;
    double value;
  };
  for (const auto& [parameter, value] :
       {Row{"mesh_frequency_ratio", 0.9}, Row{"/stage/lumped/planet/bearing_N_per_m", 4.1e8},
        Row{"/stage/load/power_kW", 300.0}, Row{"/stage/lumped/sun_planet_mesh/damping_ratio", 0.06}}) {
    const double step = 1e-3 * value;
    const studies::ModelAt family = model_family(input, parameter, step);
    const model::DynamicModel m = family(value);
    // Displacements of some b_c, off all kinks.
    std::vector<double> y(m.dimension);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = 1.3 + 0.37 * std::sin(1.0 + 2.3 * static_cast<double>(i));
    constexpr double s = 0.7;
    const auto slope = [&](const model::DynamicModel& of) {
      std::vector<double> d(of.dimension);
      of.right_hand_side(model::segment_at(of.breakpoints, s), s, y.data(), d.data());
      return d;
    };
    const std::vector<double> up = slope(family(value + step));
    const std::vector<double> down = slope(family(value - step));
    std::vector<double> derivative(m.dimension);
    m.parameter_derivative(model::segment_at(m.breakpoints, s), s, y.data(), derivative.data());
    double largest = 0.0;
    for (const double d : derivative) largest = std::max(largest, std::abs(d));
    EXPECT_GT(largest, 0.0) << parameter;
    constexpr double of_second_order = 1e-5;  // of a central difference over 1e-3 of the value, in parts of the largest
    for (std::size_t i = 0; i < y.size(); ++i)
      EXPECT_NEAR(derivative[i], (up[i] - down[i]) / (2.0 * step), of_second_order * largest) << parameter << ' ' << i;
  }
  EXPECT_THROW((void)model_family(input, "/stage/lumped/planets", 1e-3)(1.0), InputError);
}

TEST(StudyWarnings, AnEstimatedErrorThatExceedsTheDeflectionIsTold) {
  const std::string study = "inputs/tang2020_run.json";
  const std::string words = "um: the estimate decides the regime";
  const std::string by_rule = "/stage/catalogue/error_amplitude=null";  // the default
  const auto light = told(study, {by_rule});
  EXPECT_EQ(std::ranges::count_if(light, [&](const std::string& l) { return l.ends_with("is meant"); }), 1)
      << joined(light);
  EXPECT_TRUE(has(light, "/stage/lumped/ring_planet_mesh/error_amplitude_um: is 4.75 um, an estimate"))
      << joined(light);
  // Under a load that yields more than the error there is nothing to say.
  EXPECT_FALSE(has(told(study, {by_rule, "/stage/load/power_kW=3000"}), words));
  // What somebody states is no estimate: the rule, the amplitude, or what the study varies.
  for (const char* rule : {"single_pitch", "profile_form"})
    EXPECT_FALSE(has(told(study, {std::string("/stage/catalogue/error_amplitude=") + rule}), words)) << rule;
  const std::string sun = "/stage/lumped/sun_planet_mesh/error_amplitude_um";
  const std::string ring = "/stage/lumped/ring_planet_mesh/error_amplitude_um";
  EXPECT_FALSE(has(told(study, {by_rule, sun + "=20", ring + "=20"}), words));
  EXPECT_TRUE(has(told(study, {by_rule, sun + "=20"}), words));
  EXPECT_FALSE(has(told("inputs/tang2020_damping_1.21.json",
                        {by_rule, ring + "=1", "/study/parameter=" + sun, "/study/from=1", "/study/to=20"}),
                   words));
  // An origin that says estimate is one.
  const std::string estimated = R"(={"error_amplitude_um": 20, "damping_ratio": 0.05, "origin": "estimate: grade 8"})";
  EXPECT_TRUE(has(told(study, {"/stage/lumped/sun_planet_mesh" + estimated}), words));
}

TEST(StudyWarnings, AnglesBetweenPlacesThatFitAreTold) {
  const std::string study = "inputs/tang2020_damping_1.21.json";
  const auto swept = [&](const std::string& to, const std::string& points) {
    return told(study, {"/stage/planets/angles_deg=[0, 120, 240]", "/study/parameter=/stage/planets/angles_deg/1",
                        "/study/from=120", "/study/to=" + to, "/study/points=" + points});
  };
  // 108 teeth: each 10/3 degrees. Both ends fit, and of 11 values every fifth.
  EXPECT_TRUE(has(swept("126.6666667", "11"),
                  "warning: /study/parameter: at 8 of 11 values of "
                  "/stage/planets/angles_deg/1 the planets cannot be assembled; one fits "
                  "every 3.33333 degrees"))
      << joined(swept("126.6666667", "11"));
  EXPECT_EQ(joined(swept("126.6666667", "3")), "");
}

TEST(StudyWarnings, HarmonicsThatNobodyChoseAreToldWithWhatTheyLose) {
  const std::string study = "inputs/tang2020_run.json";
  const std::string words = "2 harmonics of the stiffness of the sun-planet mesh vary by 7.09";
  const std::vector<std::string> nobody = {"/stage/catalogue/mesh_stiffness=null"};
  EXPECT_TRUE(has(told(study, nobody), "warning: /stage/catalogue/mesh_stiffness/form: 2 harmonics of"))
      << joined(told(study, nobody));
  EXPECT_TRUE(stiffness_notes(load_input(study, parse_assignments(nobody))).empty());
  // Chosen, they are a line of gear and check.
  EXPECT_EQ(joined(told(study)), "");
  EXPECT_TRUE(has(stiffness_notes(load_input(study)), words)) << joined(stiffness_notes(load_input(study)));
  const auto curve = parse_assignments(std::vector<std::string>{"/stage/catalogue/mesh_stiffness/form=curve"});
  EXPECT_TRUE(stiffness_notes(load_input(study, curve)).empty());
}

}  // namespace
}  // namespace epicyclic::input::study_model_test
