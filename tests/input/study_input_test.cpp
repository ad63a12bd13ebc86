#include "input/study_input.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <sstream>

#include <gtest/gtest.h>

#include "input/origins.hpp"
#include "input/study_kind.hpp"
#include "integrate/methods.hpp"
#include "model/layout.hpp"
#include "model/scales.hpp"
#include "studies/branches_options.hpp"
#include "studies/plane_options.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::input::study_input_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::put_file;

// Tests run in the source folder.
const fs::path bad_inputs = "tests/input/bad_inputs";
const fs::path inputs = "inputs";

std::string text_of(const fs::path& path) { return test::contents(path); }

std::vector<Assignment> sets(std::vector<std::string> texts) { return parse_assignments(texts); }

class StudyInput : public ::testing::Test {
 protected:
  StudyInput() {
    put_file(folder / "study.json", text_of(bad_inputs / "study.json"));
    put_file(folder / "stage.json", text_of(bad_inputs / "stage.json"));
  }
  [[nodiscard]] LoadedInput load(const std::vector<std::string>& texts = {}) const {
    return load_input(folder / "study.json", sets(texts));
  }
  /// The resolved JSON as a file of its own, loaded.
  [[nodiscard]] LoadedInput reload(const json& resolved) const {
    put_file(folder / "resolved.json", resolved.dump(2));
    return load_input(folder / "resolved.json");
  }
  test::TemporaryFolder folder;
};

TEST_F(StudyInput, FillsTheTypedStudy) {
  const auto input = load();
  const auto& study = input.study;
  EXPECT_EQ(study.kind(), "sweep");
  EXPECT_EQ(study.name, "base");
  EXPECT_EQ(study.mesh_frequency_ratio, 1.0);
  EXPECT_EQ(study.integrator.relative_tolerance, 1e-8);
  EXPECT_EQ(study.integrator.absolute_tolerance, integrate::IntegratorOptions{}.absolute_tolerance);
  ASSERT_TRUE(study.has_points());
  EXPECT_EQ(study.sweep().axis.points, 3);
  EXPECT_EQ(study.sweep().segments, 1);  // of three points
  const auto& stage = study.stage;
  EXPECT_EQ(stage.boundary, gear::Boundary::fixed_ring);
  EXPECT_EQ(stage.planet_count, 3);
  EXPECT_EQ(stage.ring.support_N_per_m, 2e8);  // by stage_patch
  EXPECT_EQ(stage.sun.support_N_per_m, 1.01e8);
  EXPECT_EQ(stage.sun.teeth, 27);
  EXPECT_EQ(stage.sun_bearing.clearance_half_um, 10);
  EXPECT_EQ(stage.planet.damping.coefficient_Ns_per_m, 1000);
  EXPECT_FALSE(stage.planet.damping.ratio.has_value());
  EXPECT_EQ(stage.sun_planet_mesh.error_amplitude_um, (std::vector{8.5, 8.6, 8.7}));
  EXPECT_EQ(stage.ring_planet_mesh.error_amplitude_um, std::vector{9.0});
  EXPECT_EQ(stage.sun_planet_mesh.friction.coefficient->contact_ratio, 1.2);
  EXPECT_FALSE(stage.sun_planet_mesh.friction.table.has_value());
  ASSERT_TRUE(stage.ring_planet_mesh.friction.table.has_value());
  EXPECT_EQ(stage.ring_planet_mesh.friction.table->moment_driven_mm[2], -0.11);
  EXPECT_EQ(stage.ring_mesh_lead_1, 0.3023);
  EXPECT_EQ(stage.load.power_kW, 400);
  EXPECT_EQ(input.study_file.name, "study.json");
  EXPECT_EQ(input.study_file.bytes, text_of(bad_inputs / "study.json"));
  ASSERT_TRUE(input.stage_file.has_value());
  EXPECT_EQ(input.stage_file->name, "stage.json");
  EXPECT_EQ(input.stage_file->bytes, text_of(bad_inputs / "stage.json"));
}

TEST_F(StudyInput, SaysWhereEachResolvedValueComesFrom) {
  const auto resolved = load({"/integrator/method=arkode-verner65", "/stage/lumped/sun/mass_kg=2"}).resolved;
  EXPECT_EQ(resolved["integrator"]["origin"]["method"], "set: command line");
  EXPECT_EQ(resolved["integrator"]["origin"]["absolute_tolerance"], "default");
  EXPECT_FALSE(resolved["integrator"]["origin"].contains("relative_tolerance"));
  EXPECT_EQ(resolved["stage"]["lumped"]["sun"]["mass_kg"], 2.0);
  EXPECT_EQ(resolved["stage"]["lumped"]["sun"]["origin"]["mass_kg"], "set: command line");
  EXPECT_EQ(resolved["stage"]["lumped"]["ring"]["origin"]["support_N_per_m"], "stage_patch");
  EXPECT_EQ(resolved["stage"]["planets"]["origin"]["angles_deg"], "choice: equal");
  EXPECT_EQ(resolved["study"]["origin"]["period_max"], "default");
  EXPECT_FALSE(resolved.contains("stage_patch"));
}

TEST_F(StudyInput, OriginOfAnObjectCoversWhatIsInItButNoOtherFile) {
  auto study = json::parse(text_of(bad_inputs / "study.json"));
  study["origin"] = "choice: all of it";
  put_file(folder / "study.json", study.dump());
  const auto resolved = load().resolved;
  EXPECT_EQ(resolved["integrator"]["origin"]["method"], "choice: all of it");
  EXPECT_EQ(resolved["integrator"]["origin"]["escape_bound"], "default");
  EXPECT_FALSE(resolved["stage"]["lumped"]["sun"]["origin"].contains("mass_kg"));
}

TEST_F(StudyInput, PatchKeepsTheOriginsThatItGives) {
  auto study = json::parse(text_of(bad_inputs / "study.json"));
  study["stage_patch"] = json::parse(R"({
      "planets": {"angles_deg": null},
      "lumped": {"sun": {"support_damping_ratio": null, "support_damping_Ns_per_m": 5, "mass_kg": 2,
                         "origin": {"mass_kg": "estimate: weighed"}}}})");
  put_file(folder / "study.json", study.dump());
  const auto input = load();
  EXPECT_TRUE(input.study.stage.angles_deg.empty());
  EXPECT_FALSE(input.study.stage.sun.damping.ratio.has_value());
  const auto& stage = input.resolved["stage"];
  EXPECT_FALSE(stage["planets"]["origin"].contains("angles_deg"));
  EXPECT_EQ(stage["lumped"]["sun"]["origin"]["support_damping_Ns_per_m"], "stage_patch");
  EXPECT_EQ(stage["lumped"]["sun"]["origin"]["mass_kg"], "stage_patch: estimate: weighed");
  EXPECT_EQ(reload(input.resolved).resolved, input.resolved);
}

TEST_F(StudyInput, ResolvedInputResolvesToItself) {
  const auto once = load({"/model/gyroscopic=off", "/stage/lumped/ring/torsional_support_N_per_m=\"rigid\""}).resolved;
  const auto twice = reload(once).resolved;
  EXPECT_EQ(once.dump(), twice.dump());
}

TEST_F(StudyInput, FurtherAssignmentsAreMadeInTheFilesAsTheyWereRead) {
  const auto given = load({"/stage/lumped/sun/mass_kg=2"});
  put_file(folder / "study.json", "{");
  put_file(folder / "stage.json", "{}");
  EXPECT_EQ(given.with_further({}).resolved, given.resolved);
  const auto further = given.with_further(sets({"/integrator/relative_tolerance=1e-9"}));
  EXPECT_EQ(further.study.stage.sun.mass_kg, 2.0);
  EXPECT_EQ(further.study.integrator.relative_tolerance, 1e-9);
  EXPECT_EQ(further.study_file.bytes, text_of(bad_inputs / "study.json"));
  EXPECT_EQ(further.stage_file->bytes, text_of(bad_inputs / "stage.json"));
  EXPECT_THROW((void)load(), InputError);
}

TEST_F(StudyInput, AssignmentsComeAfterThePatch) {
  EXPECT_EQ(load({"/stage/lumped/ring/support_N_per_m=3e8"}).study.stage.ring.support_N_per_m, 3e8);
  EXPECT_EQ(load({"/stage_patch/lumped/ring/support_N_per_m=4e8"}).study.stage.ring.support_N_per_m, 4e8);
  EXPECT_EQ(load({"/stage_patch={}"}).study.stage.ring.support_N_per_m, 1.02e8);
  EXPECT_EQ(load({"/stage/planets/angles_deg/1=121"}).study.stage.angles_deg[1], 121);
  EXPECT_EQ(load({"/study/directions=[\"down\"]"}).study.sweep().directions, std::vector{studies::Direction::down});
  EXPECT_EQ(load({"/stage/name=another"}).study.stage.name, "another");
}

TEST_F(StudyInput, AssignmentNamesAnotherStageFile) {
  auto stage = json::parse(text_of(bad_inputs / "stage.json"));
  stage["name"] = "second";
  fs::create_directory(folder / "below");
  put_file(folder / "below/second.json", stage.dump());
  const auto input = load({"/stage=below/second.json"});
  EXPECT_EQ(input.study.stage.name, "second");
  EXPECT_EQ(input.stage_file->name, "second.json");
}

TEST_F(StudyInput, TakesAStageFileAlone) {
  const auto input = load_input(folder / "stage.json", sets({"/stage/lumped/sun/mass_kg=3", "/load/power_kW=1"}));
  EXPECT_EQ(input.study.kind(), "stage");
  EXPECT_FALSE(input.study.has_points());
  EXPECT_EQ(input.study.stage.sun.mass_kg, 3);
  EXPECT_EQ(input.study.stage.load.power_kW, 1);
  EXPECT_FALSE(input.stage_file.has_value());
  EXPECT_TRUE(input.resolved.contains("lumped"));
  EXPECT_EQ(reload(input.resolved).resolved, input.resolved);
  EXPECT_EQ(input.with_value("/lumped/planet/bearing_N_per_m", 7).stage.planet.bearing_N_per_m, 7);
}

TEST_F(StudyInput, TakesAnInlineStage) {
  auto study = json::parse(text_of(bad_inputs / "study.json"));
  study["stage"] = json::parse(text_of(bad_inputs / "stage.json"));
  put_file(folder / "inline.json", study.dump());
  const auto input = load_input(folder / "inline.json");
  EXPECT_FALSE(input.stage_file.has_value());
  EXPECT_EQ(input.resolved, load().resolved);
}

// Editors find the schema by this key of a file.
TEST_F(StudyInput, CurvesFromFilesHaveTheirRows) {
  fs::create_directory(folder / "data");
  put_file(folder / "data" / "k.csv", "phase,other,stiffness_N_per_m\r\n0,1,1e9\r\n0.3,2, 1.4e9\r\n0.3,3,1.1e9\r\n");
  put_file(folder / "e.csv", "phase,error_um,also\n0,1,7\n0.5,-2,8\n");
  json stage = json::parse(text_of(bad_inputs / "stage.json"));
  json& mesh = stage["lumped"]["sun_planet_mesh"];
  for (const char* key : {"stiffness_N_per_m", "stiffness_cos_N_per_m", "stiffness_sin_N_per_m"}) {
    mesh.erase(key);
    if (mesh.contains("origin") && mesh["origin"].is_object()) mesh["origin"].erase(key);
  }
  mesh["stiffness_curve"] = {{"file", "data/k.csv"}, {"interpolation", "linear"}};
  put_file(folder / "stage.json", stage.dump());
  const LoadedInput input =
      load({R"(/stage/lumped/ring_planet_mesh/error_curve={"file": "e.csv", "column": "also", "breakpoints": [0]})"});
  const gear::Mesh& sun = input.study.stage.sun_planet_mesh;
  ASSERT_TRUE(sun.stiffness_curve.has_value());
  EXPECT_EQ(sun.stiffness_curve->phase, (std::vector{0.0, 0.3, 0.3}));
  EXPECT_EQ(sun.stiffness_curve->stiffness_N_per_m, (std::vector{1e9, 1.4e9, 1.1e9}));
  EXPECT_EQ(sun.stiffness_curve->breakpoints, std::vector{0.3}) << "a phase that stands twice";
  EXPECT_NEAR(sun.stiffness_N_per_m, 0.3 * 1.2e9 + 0.7 * 1.05e9, 1.0) << "the mean of the curve";
  const gear::Mesh& ring = input.study.stage.ring_planet_mesh;
  ASSERT_TRUE(ring.error_curve.has_value());
  EXPECT_EQ(ring.error_curve->error_um, (std::vector{7.0, 8.0}));
  EXPECT_EQ(ring.error_curve->breakpoints, std::vector{0.0});
  const json& curve = input.resolved["stage"]["lumped"]["sun_planet_mesh"]["stiffness_curve"];
  EXPECT_FALSE(curve.contains("file"));
  EXPECT_EQ(curve["origin"]["stiffness_N_per_m"], "table: data/k.csv");
  // The resolved input needs no file, and resolves to itself.
  fs::remove_all(folder / "data");
  fs::remove(folder / "e.csv");
  EXPECT_EQ(reload(input.resolved).resolved, input.resolved);
}

TEST_F(StudyInput, FilesOfCurvesThatAreWrongAreRefusedAtTheirPlace) {
  const auto message = [&](const std::string& text, const std::string& more = "") {
    put_file(folder / "e.csv", text);
    try {
      (void)load({R"(/stage/lumped/sun_planet_mesh/error_curve={"file": "e.csv")" + more + "}"});
    } catch (const InputProblems& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto expect = [](const std::string& all, const std::string& part) {
    EXPECT_NE(all.find(part), std::string::npos) << all;
  };
  EXPECT_EQ(message("phase,error_um\n0,1\n0.5,2\n"), "accepted");
  expect(message("phase,um\n0,1\n0.5,2\n"),
         "/stage/lumped/sun_planet_mesh/error_curve/file: the file e.csv: has no "
         "column 'error_um', but phase, um");
  expect(message("phase,error_um\n0,1\n0.5,x\n"), "row 2: 'x' in the column 'error_um' is no number");
  expect(message("phase,error_um\n0,1\n0.5,nan\n"), "is no number");
  expect(message("phase,error_um\n0,1\n0.5\n"), "is no table");
  expect(message("phase,error_um\n0,1\n1.5,2\n"), "/stage/lumped/sun_planet_mesh/error_curve/phase/1");
  expect(message("phase,error_um\n0,1\n0.5,2\n0.5,3\n"), "must not jump");
  expect(message("phase,error_um\n0,1\n"), "/stage/lumped/sun_planet_mesh/error_curve/phase");
  expect(message("phase,error_um\n0,1\n0.5,2\n", R"(, "phase": [0, 0.5])"), "file");
  fs::remove(folder / "e.csv");
  fs::create_directory(folder / "e.csv");
  try {
    (void)load({R"(/stage/lumped/sun_planet_mesh/error_curve={"file": "e.csv"})"});
    ADD_FAILURE() << "a folder is accepted";
  } catch (const InputProblems& error) {
    expect(error.what(), "is a directory, not a CSV file");
  }
  for (const char* file : {R"({"file": "none.csv"})", R"({"file": 3})", R"({"column": "x"})"})
    EXPECT_THROW((void)load({std::string("/stage/lumped/sun_planet_mesh/error_curve=") + file}), InputProblems) << file;
}

TEST_F(StudyInput, TheKeyOfTheSchemaChangesNothing) {
  const json without = load().resolved;
  auto study = json::parse(text_of(bad_inputs / "study.json"));
  auto stage = json::parse(text_of(bad_inputs / "stage.json"));
  study["stage"] = "stage.json";
  study["$schema"] = stage["$schema"] = "../share/epicyclic/input.schema.json";
  put_file(folder / "study.json", study.dump());
  put_file(folder / "stage.json", stage.dump());
  EXPECT_EQ(load().resolved, without);
  EXPECT_NO_THROW((void)load_input(folder / "stage.json"));
  study["$schema"] = 7;
  put_file(folder / "study.json", study.dump());
  const std::string message = test::message_of<InputProblems>([&] { (void)load(); });
  EXPECT_NE(message.find("/$schema: is 7, must be a string"), std::string::npos) << message;
}

TEST_F(StudyInput, ReplacesANumberByPointer) {
  const auto input = load();
  const auto changed = input.with_value("/stage/lumped/planet/bearing_N_per_m", 5e7);
  EXPECT_EQ(changed.stage.planet.bearing_N_per_m, 5e7);
  EXPECT_EQ(changed.stage.sun.mass_kg, input.study.stage.sun.mass_kg);
  EXPECT_EQ(input.with_value("/stage/lumped/sun_planet_mesh/error_amplitude_um/2", 1)
                .stage.sun_planet_mesh.error_amplitude_um[2],
            1);
  EXPECT_EQ(input.with_value("/integrator/relative_tolerance", 1e-9).integrator.relative_tolerance, 1e-9);
  EXPECT_EQ(input.with_value("/integrator/clearance_smoothing", 0.1).model.clearance_smoothing, 0.1);
}

TEST_F(StudyInput, EveryNumberCanBeReplacedByItself) {
  const auto input = load();
  const auto pointers = input.number_pointers();
  EXPECT_GT(pointers.size(), 60U);
  for (const auto& pointer : pointers) {
    const double value = input.resolved.at(json::json_pointer(pointer)).get<double>();
    EXPECT_EQ(study_table().write(input.with_value(pointer, value)), study_table().write(input.study)) << pointer;
  }
}

// Values that follow from catalogue data are not computed anew for a number that they do not follow from.
TEST(Inputs, ANumberReplacedIsANumberWrittenIntoTheResolvedInput) {
  const test::TemporaryFolder folder;
  const LoadedInput input = load_input(inputs / "tang2020_speed.json");
  for (const char* pointer :
       {"/stage/lumped/planet/bearing_N_per_m", "/stage/lumped/sun/mass_kg", "/stage/lumped/ring_mesh_lead_1",
        "/stage/lumped/sun_planet_mesh/stiffness_N_per_m", "/stage/lumped/sun_planet_mesh/backlash_half_um",
        "/stage/lumped/ring_planet_mesh/friction/lubricated/viscosity_mPas", "/stage/lumped/sun/bearing/balls",
        "/stage/load/power_kW", "/stage/planets/centre_distance_mm", "/stage/catalogue/sun/bore_mm",
        "/stage/catalogue/sun_bearing/approach_um", "/operation/mesh_frequency_ratio"}) {
    const json::json_pointer at(pointer);
    ASSERT_TRUE(input.resolved.contains(at)) << pointer;
    const double value = pointer == std::string_view("/stage/lumped/sun/bearing/balls")
                             ? 9
                             : 1.0001 * input.resolved.at(at).get<double>();
    json written = input.resolved;
    written[at] = value;
    if (json& object = written[at.parent_pointer()]; object.contains("origin")) object["origin"].erase(at.back());
    put_file(folder / "written.json", written.dump());
    EXPECT_EQ(study_table().write(input.with_value(pointer, value)),
              study_table().write(load_input(folder / "written.json").study))
        << pointer;
  }
}

/// What an input with this number is like: its study, or pointer and words of all that is wrong but with the plan.
template <class F>
std::string told_by(F make) {
  try {
    return study_table().write(make()).dump();
  } catch (const InputProblems& wrong) {
    std::string problems;
    for (const Problem& p : wrong.problems())
      if (!p.pointer.starts_with("/study")) problems += p.pointer + ": " + p.message + "\n";
    return problems;
  }
}

TEST(Inputs, SoIsEachNumberSoundOrNot) {
  const test::TemporaryFolder folder;
  std::size_t refused = 0;
  for (const char* name : {"tang2020_run.json", "lin_parker_1999_n3.json"}) {
    put_file(folder / "resolved.json", load_input(inputs / name).resolved.dump());
    const LoadedInput input = load_input(folder / "resolved.json");
    for (const std::string& pointer : input.number_pointers()) {
      // Each number of a long table would say the same.
      if (pointer.find("/load_share") != std::string::npos && !pointer.ends_with("/7")) continue;
      const json::json_pointer at(pointer);
      // A value with an origin of its own is one that nobody computes; of an array the origin is that of all.
      json::json_pointer key = at;
      while (input.resolved.at(key.parent_pointer()).is_array()) key = key.parent_pointer();
      const double given = input.resolved.at(at).get<double>();
      for (const double value : {1.0625 * given, 1.0 + given, -1.0, 1e30}) {
        json written = input.resolved;
        written[at] = value;
        if (json& object = written[key.parent_pointer()]; object.contains("origin")) object["origin"].erase(key.back());
        put_file(folder / "written.json", written.dump());
        const std::string replaced = told_by([&] { return input.with_value(pointer, value); });
        refused += replaced.starts_with("/") ? 1U : 0U;
        EXPECT_TRUE(replaced == told_by([&] { return load_input(folder / "written.json").study; }))
            << name << " " << pointer << " = " << value << ": " << replaced.substr(0, 300);
      }
    }
  }
  EXPECT_GT(refused, 50U);
}

TEST(Inputs, AMethodThatCannotLocateContactsIsToldBeforeAnythingRuns) {
  for (const auto& method : integrate::methods()) {
    const auto read = [&] {
      (void)load_input(inputs / "tang2020_speed.json",
                       sets({"/integrator/locate_contacts=true", "/integrator/method=" + std::string(method.name)}));
    };
    if (method.locates_contacts()) {
      EXPECT_NO_THROW(read()) << method.name;
    } else {
      EXPECT_NE(test::message_of<InputError>(read).find("/integrator/locate_contacts"), std::string::npos);
    }
  }
}

TEST(Inputs, TheFirstValueThatIsNotSoundIsTold) {
  const auto refusal = [](const std::vector<std::string>& texts, const char* study) {
    return test::message_of<InputError>([&] { (void)load_input(inputs / study, sets(texts)); });
  };
  const std::string alone = refusal(
      {"/study/parameter=/stage/lumped/sun/bearing/balls", "/study/from=10", "/study/to=12", "/study/points=401"},
      "tang2020_speed.json");
  EXPECT_NE(alone.find("/study/parameter: takes the value 10.005, with which /stage/lumped/sun/bearing/balls"),
            std::string::npos)
      << alone;
  EXPECT_EQ(alone.find("10.01"), std::string::npos) << alone;
  const std::string both =
      refusal({"/study/first/parameter=/stage/lumped/sun/bearing/balls", "/study/first/from=10", "/study/first/to=12",
               "/study/first/points=401", "/study/second/parameter=/stage/catalogue/ring/outer_diameter_mm",
               "/study/second/from=240", "/study/second/to=250", "/study/second/points=3"},
              "tang2020_map.json");
  EXPECT_NE(both.find("/study/first/parameter: takes the value 10.005, with which, and "
                      "/stage/catalogue/ring/outer_diameter_mm = 240, /stage/lumped/sun/bearing/balls"),
            std::string::npos)
      << both;
}

TEST_F(StudyInput, RefusesAValueAsStrictlyAsAFile) {
  const auto input = load();
  const auto message = [&](const std::string& pointer, double value) {
    return test::message_of<InputError>([&] { (void)input.with_value(pointer, value); });
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  const auto mass = message("/stage/lumped/sun/mass_kg", -1);
  EXPECT_TRUE(contains(mass, "stage.json:13: /stage/lumped/sun/mass_kg: is -1, must be >= 1e-09")) << mass;
  const auto typo = message("/stage/lumped/sun/mas_kg", 1);
  EXPECT_TRUE(contains(typo, "did you mean '/stage/lumped/sun/mass_kg'?")) << typo;
  const auto teeth = message("/stage/lumped/sun/teeth", 27.5);
  EXPECT_TRUE(contains(teeth, "is 27.5, must be an integer")) << teeth;
  EXPECT_TRUE(contains(message("/stage/boundary", 1), "must be a number"));
  EXPECT_TRUE(contains(message("/study/points", 5), "part of the plan"));
  EXPECT_TRUE(contains(message("", 5), "no value"));
  EXPECT_TRUE(contains(message("/stage/lumped/sun/mass_kg", std::nan("")), "must be a finite number"));
}

TEST_F(StudyInput, SweepOverAPointerLoads) {
  const auto input =
      load({"/study/parameter=/stage/lumped/planet/bearing_N_per_m", "/study/from=1e7", "/study/to=1e9"});
  EXPECT_EQ(input.study.sweep().axis.name, "/stage/lumped/planet/bearing_N_per_m");
}

/// Omega of a sun's speed, by docs/theory/model.md, section 4: omega_m = z_s z_r / (z_s + z_r) omega_s of a fixed ring.
double ratio_at_rpm(const gear::Stage& stage, double rpm) {
  const double z_s = *stage.sun.teeth;
  const double z_r = *stage.ring.teeth;
  return rpm * M_PI / 30 * z_s * z_r / (z_s + z_r) / model::scales_of(stage).omega_sn;
}

TEST_F(StudyInput, TakesSpeedsInRpmAndHertz) {
  const auto input = load({"/operation/sun_speed_rpm=6000"});
  const gear::Stage& stage = input.study.stage;
  EXPECT_NEAR(input.study.mesh_frequency_ratio, ratio_at_rpm(stage, 6000), 1e-13);
  const double z_ratio = static_cast<double>(*stage.sun.teeth) / (*stage.sun.teeth + *stage.ring.teeth);
  EXPECT_NEAR(load({"/operation/carrier_speed_rpm=6000"}).study.mesh_frequency_ratio,
              ratio_at_rpm(stage, 6000) / z_ratio, 1e-13);
  EXPECT_NEAR(load({"/operation/mesh_frequency_Hz=500"}).study.mesh_frequency_ratio,
              1000 * M_PI / model::scales_of(stage).omega_sn, 1e-13);
  // What is resolved has the speed as it is given.
  EXPECT_EQ(input.resolved["operation"],
            (json{{"sun_speed_rpm", 6000.0}, {"origin", {{"sun_speed_rpm", "set: command line"}}}}));
  EXPECT_EQ(reload(input.resolved).resolved, input.resolved);
  // The last one that is set counts; a file gives one.
  EXPECT_EQ(load({"/operation/carrier_speed_rpm=1", "/operation/sun_speed_rpm=6000"}).study.mesh_frequency_ratio,
            input.study.mesh_frequency_ratio);
  EXPECT_EQ(load({"/operation/sun_speed_rpm=6000", "/operation/mesh_frequency_ratio=2"}).study.mesh_frequency_ratio, 2);
}

TEST_F(StudyInput, OfAResolvedInputASpeedIsStillGivenInRpm) {
  const auto input = load({"/operation/sun_speed_rpm=6000"});
  const auto again = reload(input.resolved);
  EXPECT_EQ(again.given_speed.sun_speed_rpm, std::optional(6000.0));
  EXPECT_EQ(again.study.mesh_frequency_ratio, input.study.mesh_frequency_ratio);
  EXPECT_TRUE(again.notes.empty());
  EXPECT_FALSE(load({"/operation/sun_speed_rpm=6000", "/operation/mesh_frequency_ratio=2"}).given_speed.sun_speed_rpm);
}

TEST_F(StudyInput, ASpeedInRpmStaysWhereTheStageOfAResolvedInputIsChanged) {
  json changed = load({"/operation/sun_speed_rpm=6000"}).resolved;
  changed["stage"]["lumped"]["sun"]["inertia_over_r2_kg"] =
      2.0 * changed["stage"]["lumped"]["sun"]["inertia_over_r2_kg"].get<double>();
  const auto heavier = reload(changed);
  EXPECT_NEAR(heavier.study.mesh_frequency_ratio, ratio_at_rpm(heavier.study.stage, 6000), 1e-13);
  EXPECT_EQ(reload(heavier.resolved).resolved, heavier.resolved);

  json along = load({"/study/parameter=sun_speed_rpm", "/study/from=3000", "/study/to=9000"}).resolved;
  along["stage"]["lumped"]["sun"]["inertia_over_r2_kg"] = changed["stage"]["lumped"]["sun"]["inertia_over_r2_kg"];
  const auto sweep = reload(along);
  EXPECT_NEAR(sweep.study.sweep().axis.to, ratio_at_rpm(sweep.study.stage, 9000), 1e-12);
}

TEST_F(StudyInput, ASpeedInRpmDoesNotFollowWhatAStudyVaries) {
  const auto input = load({"/operation/sun_speed_rpm=6000"});
  const double ratio = input.study.mesh_frequency_ratio;
  const char* const inertia = "/stage/lumped/sun/inertia_over_r2_kg";
  EXPECT_EQ(input.with_value(inertia, 1.1 * input.value_at(inertia)->get<double>()).mesh_frequency_ratio, ratio);
  EXPECT_EQ(input.with_value("/operation/mesh_frequency_ratio", 2).mesh_frequency_ratio, 2);
  EXPECT_NEAR(input.with_value("/operation/sun_speed_rpm", 3000).mesh_frequency_ratio, 0.5 * ratio, 1e-13);
  const json other = input.resolved_with(std::array{PointerValue{"/operation/mesh_frequency_ratio", 2}});
  EXPECT_EQ(other["operation"]["mesh_frequency_ratio"], 2);
  EXPECT_FALSE(other["operation"].contains("sun_speed_rpm"));
}

TEST_F(StudyInput, TakesAxesInRpmAndHertz) {
  constexpr double twelve_digits = 1e-12;  // as the values between an axis's ends have
  const std::string axis = R"({"parameter": "sun_speed_rpm", "from": 3000, "to": 9000, "points": 3})";
  const auto sweep = load({"/study/parameter=sun_speed_rpm", "/study/from=3000", "/study/to=9000"});
  const gear::Stage& stage = sweep.study.stage;
  const double slow = ratio_at_rpm(stage, 3000);
  const double fast = ratio_at_rpm(stage, 9000);
  const auto is_converted = [&](const std::string& name, double from, double to) {
    EXPECT_EQ(name, studies::speed_parameter);
    EXPECT_NEAR(from, slow, twelve_digits);
    EXPECT_NEAR(to, fast, twelve_digits);
  };
  const studies::Axis& along = sweep.study.plan.as<studies::SweepOptions>().axis;
  is_converted(along.name, along.from, along.to);
  EXPECT_EQ(sweep.resolved["study"]["parameter"], "sun_speed_rpm");
  EXPECT_EQ(sweep.resolved["study"]["from"], 3000);
  EXPECT_EQ(sweep.resolved["study"]["origin"]["from"], "set: command line");
  EXPECT_EQ(reload(sweep.resolved).resolved, sweep.resolved);
  for (const auto& axis_speed : {sweep.study.axis_speed, reload(sweep.resolved).study.axis_speed}) {
    ASSERT_TRUE(axis_speed);
    EXPECT_EQ(axis_speed->key, "sun_speed_rpm");
    EXPECT_NEAR(axis_speed->per_ratio * along.to, 9000.0, 1e-8);
  }
  EXPECT_FALSE(load({"/study/from=0.5", "/study/to=1.5"}).study.axis_speed);

  // By its pointer the speed is the same parameter.
  const auto pointed = load(
      {R"(/study={"kind": "sweep", "parameter": "/operation/mesh_frequency_ratio", "from": 0.5, "to": 0.6, "points": 3})"});
  EXPECT_EQ(pointed.study.plan.as<studies::SweepOptions>().axis.name, studies::speed_parameter);
  EXPECT_EQ(pointed.resolved["study"]["parameter"], studies::speed_parameter);
  EXPECT_EQ(reload(pointed.resolved).resolved, pointed.resolved);

  const auto map =
      load({R"(/study={"kind": "map", "first": {"parameter": "damping_ratio", "from": 0.1, "to": 0.2}, "second": )" +
            axis + "}"});
  const studies::Axis& second = map.study.plan.as<studies::MapOptions>().plane.second;
  is_converted(second.name, second.from, second.to);

  const std::size_t components =
      2 *
      model::coordinate_names(model::layout_of(stage, model::CoordinateChoice::relative), stage.planet_count).size();
  const auto branches = load(
      {R"(/study={"kind": "continue", "parameter": "sun_speed_rpm", "from": 3000, "to": 9000, "starts": [3000, 9000],
          "values": [3000], "search": {"values": [9000]}, "loci": {"parameter": "damping_ratio", "from": 0, "to": 1, "near": [9000]},
          "seeds": [{"value": 3000, "max_distance": 9000, "state": [)" +
       [&] {
         std::string zeros = "0";
         for (std::size_t k = 1; k < components; ++k) zeros += ", 0";
         return zeros;
       }() +
       "]}]}"});
  const auto& b = branches.study.plan.as<studies::BranchesOptions>();
  is_converted(b.parameter, b.from, b.to);
  is_converted(studies::speed_parameter, b.starts[0], b.starts[1]);
  is_converted(studies::speed_parameter, b.values[0], b.search->values[0]);
  is_converted(studies::speed_parameter, b.seeds[0].value, *b.seeds[0].max_distance);
  EXPECT_NEAR(b.loci->near[0], fast, twelve_digits);
  EXPECT_EQ(reload(branches.resolved).resolved, branches.resolved);
}

TEST_F(StudyInput, TellsProblemsInTheOrderOfTheTexts) {
  auto text = text_of(bad_inputs / "stage.json");
  text.replace(text.find("1.654"), 5, "-1.65");
  put_file(folder / "stage.json", text);
  try {
    (void)load({"/study/points=0", "/integrator/relative_tolerance=5"});
    FAIL();
  } catch (const InputProblems& error) {
    ASSERT_EQ(error.problems().size(), 3U);
    EXPECT_EQ(error.problems()[0].line, 13);
    EXPECT_EQ(error.problems()[0].pointer, "/stage/lumped/sun/mass_kg");
    EXPECT_EQ(error.problems()[1].line, 0);
  }
}

TEST(Assignments, TakeJsonAndBareWords) {
  const auto all = sets({"/a=1.5", "/a=word", "/a=\"5\"", "/a=[1,2]", "/a=true", "/a=../path.json", "/a/b=x=y"});
  EXPECT_EQ(all[0].value, 1.5);
  EXPECT_EQ(all[1].value, "word");
  EXPECT_EQ(all[2].value, "5");
  EXPECT_EQ(all[3].value, json::parse("[1,2]"));
  EXPECT_EQ(all[4].value, true);
  EXPECT_EQ(all[5].value, "../path.json");
  EXPECT_EQ(all[6].value, "x=y");
  EXPECT_EQ(all[6].pointer, "/a/b");
}

// Such as from a terminal in Latin-1.
TEST(Assignments, MustBeText) {
  for (const std::string& text :
       {std::string("/study/parameter=d\xe9mo"), std::string("/d\xe9mo=1"), std::string("/a=b\0c", 6)}) {
    const auto all = sets({text});
    ASSERT_EQ(all[0].problems.size(), 1U);
    EXPECT_NE(all[0].problems[0].find("is not UTF-8 text"), std::string::npos) << all[0].problems[0];
  }
}

TEST_F(StudyInput, AnAssignmentBesideWhatIsNoOriginIsStillRefused) {
  for (const std::string origin : {"5", "null", "true", "[1]", "5e-324"})
    for (const std::string set : {"/study/from=0.9", "/integrator=null", "/integrator={\"relative_tolerance\":1e-6}"}) {
      auto text = text_of(bad_inputs / "study.json");
      const std::string object = set.starts_with("/study") ? "\"study\": {" : "{";
      text.insert(text.find(object) + object.size(), "\"origin\": " + origin + ",");
      put_file(folder / "study.json", text);
      const std::string message = test::message_of<InputError>([&] { (void)load({set}); });
      EXPECT_NE(message.find("/origin"), std::string::npos) << origin << ", " << set << ": " << message;
    }
}

TEST_F(StudyInput, TellsMalformedAssignmentsWithAllElse) {
  auto text = text_of(bad_inputs / "stage.json");
  text.replace(text.find("1.654"), 5, "-1.65");
  put_file(folder / "stage.json", text);
  try {
    (void)load({"/a", "/b=[1", "/c=1e999", "ok=1", "/study/points=4", "/x/origin=source"});
    FAIL();
  } catch (const InputProblems& error) {
    EXPECT_EQ(error.problems().size(), 6U) << error.what();
  }
}

// ---- the inputs that come with the program

TEST(Inputs, AllLoadAndResolveToThemselves) {
  const test::TemporaryFolder folder;
  int count = 0;
  for (const auto& entry : fs::directory_iterator(inputs)) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path().string());
    ++count;
    const auto input = load_input(entry.path());
    put_file(folder / "resolved.json", input.resolved.dump());
    EXPECT_EQ(load_input(folder / "resolved.json").resolved.dump(), input.resolved.dump());
    EXPECT_EQ(entry.path().stem().string(), input.study.name.empty() ? input.study.stage.name : input.study.name);
  }
  EXPECT_GE(count, 14);
}

TEST(Inputs, EveryValueOfTheCompletedStageSaysWhereItComesFrom) {
  const auto resolved = load_input(inputs / "tang2020.json").resolved;
  int numbers = 0;
  const std::function<void(const json&, const std::string&)> walk = [&](const json& object, const std::string& at) {
    for (const auto& [key, value] : object.items()) {
      if (key == "origin" || key == "note" || key == "name" || key == "boundary" || key == "driver") continue;
      if (value.is_object()) {
        walk(value, at + "/" + key);
      } else {
        ++numbers;
        ASSERT_TRUE(object.contains("origin") && object["origin"].contains(key)) << at << "/" << key;
        EXPECT_NE(object["origin"][key], "default") << at << "/" << key;
      }
    }
  };
  walk(resolved, "");
  EXPECT_GT(numbers, 50);
}

// The bodies of the completed stage, from Table 1 and the dimensions that the file states.
TEST(Inputs, BodiesOfTheCompletedStageFollowFromTheirDimensions) {
  const auto stage = load_input(inputs / "tang2020.json").study.stage;
  constexpr double digits = 1e-14;  // rounding of the formulas
  constexpr double pi = 3.14159265358979323846, degree = pi / 180;
  const auto near = [&](double value, double expected, const char* what) {
    EXPECT_NEAR(value, expected, digits * expected) << what;
  };

  const double module = 2.63, angle = 25 * degree, shift_s = 0.623, shift_p = 0.775;
  const auto involute = [](double a) { return std::tan(a) - a; };
  const double wanted = involute(angle) + 2 * (shift_s + shift_p) / (27 + 25) * std::tan(angle);
  double working = 30 * degree;
  for (int i = 0; i < 50; ++i) working -= (involute(working) - wanted) / std::pow(std::tan(working), 2);
  const double r_bs = module * 27 / 2 * std::cos(angle), r_bp = module * 25 / 2 * std::cos(angle);
  const double r_br = r_bp * 81 / 25, r_c = (r_bs + r_bp) / std::cos(working);
  near(*stage.sun.base_radius_mm, r_bs, "r_bs");
  near(*stage.planet.base_radius_mm, r_bp, "r_bp");
  near(*stage.ring.base_radius_mm, r_br, "r_br");
  near(*stage.centre_distance_mm, r_c, "r_c");

  // Mean of tip and root radius; tips of sun and planet shortened so that 0.25 modules of clearance remain.
  const double shortening = shift_s + shift_p - (r_c / module - 26);
  const auto external = [&](double z, double x) { return module * (z / 2 + (1 + x - shortening - (1.25 - x)) / 2); };
  const double ring_module = module * std::cos(angle) / std::cos(22.3 * degree);
  const double ring_body = ring_module * (81.0 / 2 + 2.25 / 2);
  struct Body {
    double mass, inertia;
  };
  const auto cylinder = [&](double outer_mm, double inner_mm, double length_mm) {
    const double mass = 7850 * pi * (outer_mm * outer_mm - inner_mm * inner_mm) * length_mm * 1e-9;
    return Body{mass, mass * (outer_mm * outer_mm + inner_mm * inner_mm) / 2};  // [kg], [kg mm^2]
  };
  const Body sun = cylinder(external(27, shift_s), 15, 60), planet = cylinder(external(25, shift_p), 22, 60);
  const Body ring = cylinder(120, ring_body, 60), plates = cylinder(97, 35, 30), pin = cylinder(15, 0, 90);
  near(stage.sun.mass_kg, sun.mass, "M_s");
  near(stage.planet.mass_kg, planet.mass, "M_p");
  near(stage.ring.mass_kg, ring.mass, "M_r");
  near(stage.carrier.mass_kg, plates.mass + 3 * pin.mass, "M_c");
  near(stage.sun.inertia_over_r2_kg, sun.inertia / (r_bs * r_bs), "I_s");
  near(stage.planet.inertia_over_r2_kg, planet.inertia / (r_bp * r_bp), "I_p");
  near(stage.ring.inertia_over_r2_kg, ring.inertia / (r_br * r_br), "I_r");
  near(stage.carrier.inertia_over_r2_kg, (plates.inertia + 3 * pin.inertia) / (r_c * r_c) + 3 * pin.mass, "I_c");
}

// ---- bad inputs: the cases that the command is tested with too

std::string unescaped(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 >= text.size()) {
      result += text[i];
      continue;
    }
    const char c = text[++i];
    if (c == 'n') {
      result += '\n';
    } else if (c == '0') {
      result += '\0';
    } else if (c == 'x') {
      result += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      ADD_FAILURE() << "unknown escape in " << text;
    }
  }
  return result;
}

struct BadInput {
  std::string name;
  std::vector<std::pair<std::string, std::string>> steps;
  std::size_t lines = 1;
};

std::vector<BadInput> bad_input_cases() {
  std::vector<BadInput> cases;
  std::istringstream file(text_of(bad_inputs / "cases.txt"));
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    const auto space = line.find(' ');
    const std::string verb = line.substr(0, space);
    const std::string rest = space == std::string::npos ? "" : line.substr(space + 1);
    if (verb == "case") {
      cases.push_back({rest, {}, 1});
    } else if (verb == "lines") {
      cases.back().lines = std::stoul(rest);
    } else {
      cases.back().steps.emplace_back(verb, rest);
    }
  }
  return cases;
}

TEST(BadInputs, AreRefusedWithAClearMessage) {
  const auto cases = bad_input_cases();
  EXPECT_GE(cases.size(), 100U);
  for (const auto& bad : cases) {
    SCOPED_TRACE(bad.name);
    const test::TemporaryFolder folder;
    std::map<std::string, std::string> text = {{"study", text_of(bad_inputs / "study.json")},
                                               {"stage", text_of(bad_inputs / "stage.json")}};
    std::string input = "study.json";
    std::vector<std::string> assignments, expected;
    for (const auto& [verb, rest] : bad.steps) {
      const std::string file = verb.substr(0, 5);
      if (verb == "study" || verb == "stage") {
        const auto arrow = rest.find(" => ");
        ASSERT_NE(arrow, std::string::npos);
        const auto at = text[file].find(rest.substr(0, arrow));
        ASSERT_NE(at, std::string::npos) << rest;
        text[file].replace(at, arrow, unescaped(rest.substr(arrow + 4)));
      } else if (verb == "study_is" || verb == "stage_is") {
        text[file] = unescaped(rest);
      } else if (verb == "study_cut" || verb == "stage_cut") {
        const auto at = text[file].find(rest);
        ASSERT_NE(at, std::string::npos) << rest;
        text[file].erase(at + rest.size());
      } else if (verb == "input") {
        input = rest;
      } else if (verb == "set") {
        assignments.push_back(rest);
      } else if (verb == "expect") {
        expected.push_back(rest);
      } else {
        FAIL() << "unknown verb " << verb;
      }
    }
    EXPECT_FALSE(expected.empty());
    put_file(folder / "study.json", text["study"]);
    put_file(folder / "stage.json", text["stage"]);
    try {
      (void)load_input(folder / input, parse_assignments(assignments));
      ADD_FAILURE() << "accepted";
    } catch (const InputProblems& error) {
      const std::string message = error.what();
      for (const auto& part : expected)
        EXPECT_NE(message.find(part), std::string::npos) << part << "\n in: " << message;
      EXPECT_EQ(error.problems().size(), bad.lines) << message;
    }
  }
}

/// Processor time of an action, which other programs on the machine do not lengthen [s].
template <class F>
double cpu_seconds(F action) {
  const std::clock_t begin = std::clock();
  action();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

// Half a million mistakes cost about what reading the text costs.
TEST(BadInputs, ManyMistakesAreToldInTheTimeOfReading) {
  const test::TemporaryFolder folder;
  constexpr int many = 200000;
  std::string keys, origins, base;
  for (int k = 0; k < many; ++k) {
    keys += "\"key_" + std::to_string(k) + "\": 0, ";
    origins += std::string(k == 0 ? "" : ", ") + "\"of_" + std::to_string(k) + "\": \"set\"";
  }
  const auto stage = text_of(bad_inputs / "stage.json");
  const auto in_stage = [&](const std::string& text) { return "{" + text + stage.substr(1); };
  for (const std::string& text : {in_stage(keys), in_stage(keys + "\"origin\": {" + origins + "}, ")}) {
    put_file(folder / "stage.json", text);
    const double reading = cpu_seconds([&] { (void)parse_json(text, "stage.json"); });
    std::size_t told = 0;
    const double all = cpu_seconds([&] {
      try {
        (void)load_input(folder / "stage.json");
      } catch (const InputProblems& error) {
        told = error.problems().size();
      }
    });
    EXPECT_EQ(told, 201U);  // and that there are more
    EXPECT_LT(all, 12.0 * reading);
    std::printf("%.2f s of reading, %.2f s in all\n", reading, all);
  }
}

// Never a crash, a hang or another exception, whatever a byte is changed to.
TEST(BadInputs, DamagedFilesGiveProblemsOnly) {
  const test::TemporaryFolder folder;
  const auto stage = text_of(bad_inputs / "stage.json");
  put_file(folder / "study.json", text_of(bad_inputs / "study.json"));
  std::size_t refused = 0;
  constexpr std::string_view bytes = "{}[]\",:0-eN ";
  for (std::size_t at = 0; at < stage.size(); at += 7) {
    auto damaged = stage;
    damaged[at] = bytes[at % bytes.size()];
    put_file(folder / "stage.json", damaged);
    try {
      (void)load_input(folder / "study.json");
    } catch (const InputProblems& error) {
      ++refused;
      EXPECT_FALSE(error.problems().empty());
    }
  }
  EXPECT_GT(refused, 200U);
}

// ---- the schema says what the reader does

class SchemaAndReader : public ::testing::Test {
 protected:
  SchemaAndReader() : schema(json::parse(schema_text())) { whole = load_input(bad_inputs / "study.json").resolved; }

  [[nodiscard]] static std::vector<Finding> read(const json& value) {
    ReadContext context;
    Study study;
    study_table().read(value, "", study, context);
    return context.findings;
  }
  [[nodiscard]] static bool found(const json& value, const std::string& pointer, Finding::Kind kind,
                                  const std::string& part = "") {
    for (const auto& finding : read(value))
      if (finding.pointer == pointer && finding.kind == kind && finding.message.find(part) != std::string::npos)
        return true;
    return false;
  }
  [[nodiscard]] static bool any_at(const json& value, const std::string& pointer) {
    for (const auto& finding : read(value))
      if (finding.pointer == pointer && finding.message.find("beside it") == std::string::npos) return true;
    return false;
  }
  [[nodiscard]] json with(const std::string& pointer, const json& value) const {
    json changed = whole;
    changed[json::json_pointer(pointer)] = value;
    return changed;
  }

  void check_number(const json& number, const std::string& pointer, const std::string& in) {
    const bool integer = number["type"] == "integer";
    const auto outside = [&](double bound, bool excluded, double direction) {
      if (excluded) return bound;
      return integer ? bound + direction : std::nextafter(bound, direction * 2e300 + bound);
    };
    const auto inside = [&](double bound, bool excluded, double direction) {
      if (!excluded) return bound;
      return integer ? bound - direction : std::nextafter(bound, -direction * 2e300 + bound);
    };
    const auto place = [&](double value) {
      json changed = whole;
      if (pointer == in) {
        changed[json::json_pointer(in)] = value;
      } else {  // an element of an array: all elements the same, as many as the least
        changed[json::json_pointer(in)] = std::vector<double>(array_size, value);
      }
      return changed;
    };
    for (const auto& [name, direction, excluded] : {std::tuple("minimum", -1.0, false),
                                                    {"exclusiveMinimum", -1.0, true},
                                                    {"maximum", 1.0, false},
                                                    {"exclusiveMaximum", 1.0, true}}) {
      if (!number.contains(name)) continue;
      ++bounds;
      const double bound = number[name].get<double>();
      EXPECT_TRUE(found(place(outside(bound, excluded, direction)), pointer, Finding::Kind::range, number_text(bound)))
          << pointer << " " << name;
      EXPECT_FALSE(any_at(place(inside(bound, excluded, direction)), pointer)) << pointer << " " << name;
    }
    if (integer) {
      EXPECT_TRUE(found(place(3.5), pointer, Finding::Kind::type)) << pointer;
    }
    EXPECT_TRUE(number.contains("minimum") || number.contains("exclusiveMinimum")) << pointer << " has no lower bound";
  }

  /// An array of objects.
  void check_list(const json& array, const std::string& pointer, const json& element) {
    const auto most = array["maxItems"].get<std::size_t>();
    EXPECT_TRUE(found(with(pointer, 1), pointer, Finding::Kind::type)) << pointer;
    EXPECT_TRUE(found(with(pointer, std::vector<json>(most + 1, element)), pointer, Finding::Kind::range)) << pointer;
    EXPECT_FALSE(any_at(with(pointer, std::vector<json>(most, element)), pointer)) << pointer;
    const json before = std::exchange(whole, with(pointer, json::array({element})));
    check_object(array["items"], pointer + "/0");
    whole = before;
  }

  void check_array(const json& array, const std::string& pointer) {
    if (array["items"].contains("properties"))
      return check_list(array, pointer, {{"value", 1.0}, {"state", json::array({0.0})}});
    if (array["items"].contains("enum")) {
      EXPECT_TRUE(found(with(pointer, json::array()), pointer, Finding::Kind::type));
      check_value(array["items"], pointer, {"up"});
      return;
    }
    if (array["items"].value("type", "") == "string") {
      const auto most = array["maxItems"].get<std::size_t>();
      EXPECT_TRUE(found(with(pointer, "a"), pointer, Finding::Kind::type)) << pointer;
      EXPECT_TRUE(found(with(pointer, json::array({"a", 1})), pointer, Finding::Kind::type)) << pointer;
      EXPECT_TRUE(any_at(with(pointer, std::vector<std::string>(most + 1, "a")), pointer)) << pointer;
      EXPECT_FALSE(any_at(with(pointer, std::vector<std::string>(most, "a")), pointer)) << pointer;
      return;
    }
    const auto least = array["minItems"].get<std::size_t>(), most = array["maxItems"].get<std::size_t>();
    const double middle = 0.5;
    if (least > 0) {
      EXPECT_TRUE(found(with(pointer, std::vector<double>(least - 1, middle)), pointer, Finding::Kind::range))
          << pointer;
    }
    EXPECT_TRUE(found(with(pointer, std::vector<double>(most + 1, middle)), pointer, Finding::Kind::range)) << pointer;
    EXPECT_FALSE(any_at(with(pointer, std::vector<double>(most, middle)), pointer)) << pointer;
    array_size = std::max<std::size_t>(1, least);
    check_number(array["items"], pointer + "/0", pointer);
  }

  void check_value(const json& value, const std::string& pointer, const json& element = json()) {
    if (!value.contains("enum") && !value.contains("const") && !value.contains("type")) {  // any JSON value
      for (const json& any : {json(5), json("text"), json::object({{"a", 1}}), json(nullptr)})
        EXPECT_FALSE(any_at(with(pointer, any), pointer)) << pointer;
    } else if (value.contains("enum")) {
      for (const auto& name : value["enum"])
        EXPECT_FALSE(any_at(with(pointer, element.is_null() ? name : json::array({name})), pointer)) << pointer;
      const std::string place = element.is_null() ? pointer : pointer + "/0";
      EXPECT_TRUE(
          found(with(pointer, element.is_null() ? json("zzz") : json::array({"zzz"})), place, Finding::Kind::range))
          << pointer;
    } else if (value.contains("const")) {
      EXPECT_FALSE(any_at(with(pointer, value["const"]), pointer)) << pointer;
    } else if (value["type"] == "array") {
      check_array(value, pointer);
    } else if (value["type"] == "boolean") {
      EXPECT_TRUE(found(with(pointer, 5), pointer, Finding::Kind::type)) << pointer;
      EXPECT_FALSE(any_at(with(pointer, false), pointer)) << pointer;
    } else if (value["type"] == "string") {
      EXPECT_TRUE(found(with(pointer, 5), pointer, Finding::Kind::type)) << pointer;
      EXPECT_FALSE(any_at(with(pointer, "text"), pointer)) << pointer;
    } else {
      check_number(value, pointer, pointer);
    }
  }

  void check_property(const std::string& key, const json& property, const std::string& pointer) {
    if (key == "origin" || key == "stage_patch") return;  // read by the loader
    ++properties;
    if (key == "note") {
      EXPECT_TRUE(found(with(pointer, 5), pointer, Finding::Kind::type)) << pointer;
    } else if (pointer == "/stage") {
      EXPECT_EQ(property["anyOf"][1]["$ref"], "#/$defs/stage");
      check_object(schema["$defs"]["stage"], pointer);
    } else if (property.contains("properties")) {
      check_object(property, pointer);
    } else if (property.contains("additionalProperties")) {  // keys by names that the stage decides
      EXPECT_TRUE(found(with(pointer, 1), pointer, Finding::Kind::type)) << pointer;
      check_number(property["additionalProperties"], pointer + "/x_s", pointer + "/x_s");
    } else if (property.contains("anyOf") && property["anyOf"][0].contains("properties")) {
      for (const auto& alternative : property["anyOf"]) {  // kinds of study
        const json before = whole;
        json other = whole;
        other[json::json_pointer(pointer + "/kind")] = alternative["properties"]["kind"]["const"];
        ReadContext context;
        Study study;
        study_table().read(other, "", study, context);
        whole = study_table().write(study);
        check_object(alternative, pointer);
        whole = before;
      }
    } else if (property.contains("anyOf")) {
      for (const auto& alternative : property["anyOf"]) check_value(alternative, pointer);
    } else {
      check_value(property, pointer);
    }
  }

  /// "/lumped" -> "/properties/lumped"
  static std::string schema_place(const std::string& pointer) {
    std::string place;
    for (const char c : pointer) place += c == '/' ? "/properties/" : std::string(1, c);
    return place;
  }

  void check_object(const json& object, const std::string& pointer) {
    ++objects;
    EXPECT_EQ(object["additionalProperties"], false) << pointer;
    const std::string unknown = pointer + "/zzz";
    EXPECT_TRUE(found(with(unknown, 1), unknown, Finding::Kind::unknown_key)) << pointer;
    EXPECT_TRUE(found(with(pointer, 1), pointer, Finding::Kind::type)) << pointer;
    std::vector<std::string> required = object.value("required", std::vector<std::string>{});
    if (pointer.starts_with("/stage")) {
      const json::json_pointer of_no_pair("/$defs/stage/else" + schema_place(pointer.substr(6)) + "/required");
      if (schema.contains(of_no_pair))
        for (const std::string key : schema[of_no_pair]) required.push_back(key);
    }
    for (const auto& [key, property] : object["properties"].items()) {
      const std::string place = pointer + "/" + key;
      const bool is_required = std::find(required.begin(), required.end(), key) != required.end();
      json without = with(place, 1);
      without[json::json_pointer(pointer)].erase(key);
      EXPECT_EQ(found(without, place, Finding::Kind::missing_key), is_required) << place;
      EXPECT_TRUE(property.contains("description") || key == "origin") << place;
      check_property(key, property, place);
    }
    for (const auto& key : required) EXPECT_TRUE(object["properties"].contains(key)) << pointer << "/" << key;
  }

  json schema, whole;
  std::size_t array_size = 1;
  int properties = 0, objects = 0, bounds = 0;
};

TEST_F(SchemaAndReader, AgreeOnEveryKeyRequirementAndBound) {
  ASSERT_TRUE(read(whole).empty());
  check_object(schema["$defs"]["study"], "");
  EXPECT_GT(objects, 18);
  EXPECT_GT(properties, 100);
  EXPECT_GT(bounds, 120);
}

TEST_F(SchemaAndReader, AgreeThatBasinsLetCellsSettle) {
  int kinds = 0;
  for (const auto& plan : schema["$defs"]["study"]["properties"]["study"]["anyOf"]) {
    const std::string kind = plan["properties"]["kind"]["const"];
    if (!plan["properties"].contains("transient")) continue;
    ++kinds;
    const char* const transient = kind == "basins" ? "adaptive" : "fixed";
    EXPECT_EQ(plan["properties"]["transient"]["default"], transient) << kind;
    json other = whole;
    other["study"] = {{"kind", kind}};
    ReadContext context;
    Study study;
    study_table().read(other, "", study, context);
    EXPECT_EQ(study_table().write(study)["study"]["transient"], transient) << kind;
  }
  const auto of_points = [](const StudyKind* kind) { return kind->missing.empty() && kind->plan != nullptr; };
  EXPECT_EQ(kinds, std::ranges::count_if(study_kinds(), of_points));
}

TEST_F(SchemaAndReader, AgreeOnMethodsAndOrigins) {
  const auto& method = schema["$defs"]["study"]["properties"]["integrator"]["properties"]["method"];
  EXPECT_EQ(method["enum"], json(integrate::method_names()));
  EXPECT_EQ(method["default"], integrate::IntegratorOptions{}.method);
  const std::string pattern = schema["$defs"]["origin"]["anyOf"][0]["pattern"];
  for (const auto word : origin_words) EXPECT_NE(pattern.find(word), std::string::npos);
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(
      schema["anyOf"],
      json::parse(R"([{"$ref": "#/$defs/study"}, {"$ref": "#/$defs/stage"}, {"$ref": "#/$defs/catalogue_stage"}])"));
}

TEST_F(SchemaAndReader, AgreeOnDefaults) {
  const json& study_keys = schema["$defs"]["study"]["properties"];
  int defaults = 0;
  const auto compare = [&](const json& at, const json& read) {
    for (const auto& [key, property] : at["properties"].items()) {
      if (!property.contains("default")) continue;
      EXPECT_EQ(property["default"], read.value(key, json())) << at["title"] << " " << key;
      ++defaults;
    }
  };
  for (const json& plan : study_keys["study"]["anyOf"]) {
    json bare = whole;
    for (const char* key : {"operation", "integrator", "model"}) bare.erase(key);
    bare["study"] = {{"kind", plan["properties"]["kind"]["const"]}};
    ReadContext context;  // what is missing is found, the rest is read
    Study study;
    study_table().read(bare, "", study, context);
    const json written = study_table().write(study);
    compare(plan, written["study"]);
    for (const char* key : {"operation", "integrator", "model"}) compare(study_keys[key], written[key]);
  }
  EXPECT_GT(defaults, 100);
  const json& sweep = study_keys["study"]["anyOf"][0]["properties"];
  EXPECT_EQ(sweep["parameter"]["default"], "mesh_frequency_ratio");
  EXPECT_EQ(sweep["segments"]["default"], "auto");
  EXPECT_EQ(sweep["directions"]["default"], json({"up"}));
}

TEST_F(SchemaAndReader, EveryKeyThatIsWrittenIsInTheSchema) {
  const std::function<void(const json&, const json&, const std::string&)> walk = [&](const json& value, const json& at,
                                                                                     const std::string& pointer) {
    for (const auto& [key, child] : value.items()) {
      ASSERT_TRUE(at["properties"].contains(key)) << pointer << "/" << key;
      if (!child.is_object() || key == "origin") continue;
      const bool root = pointer.empty();
      walk(child,
           root && key == "stage"   ? schema["$defs"]["stage"]
           : root && key == "study" ? at["properties"][key]["anyOf"][0]
                                    : at["properties"][key],
           pointer + "/" + key);
    }
  };
  walk(whole, schema["$defs"]["study"], "");
}

}  // namespace
}  // namespace epicyclic::input::study_input_test
