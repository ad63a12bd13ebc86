// Lumped values from catalogue data: what is given stands, what is computed follows the catalogue.
#include "input/stage_completion.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "gear/gear_set.hpp"
#include "input/study_input.hpp"
#include "input/study_model.hpp"
#include "model/dynamic_model.hpp"
#include "model/friction_track.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::input::stage_completion_test {
namespace {

using nlohmann::json;
using test::TemporaryFolder;

const std::filesystem::path stage_file = "inputs/tang2020.json";

LoadedInput loaded(const std::vector<std::string>& sets = {}) {
  return load_input(stage_file, parse_assignments(sets));
}

std::vector<std::string> messages(const std::vector<std::string>& sets) {
  std::vector<std::string> lines;
  try {
    (void)loaded(sets);
  } catch (const InputProblems& error) {
    for (const Problem& problem : error.problems()) lines.push_back(problem.text());
  }
  return lines;
}

bool any_has(const std::vector<std::string>& lines, const std::string& part) {
  for (const std::string& line : lines)
    if (line.find(part) != std::string::npos) return true;
  return false;
}

TEST(StageCompletion, TheFileOfThePaperHoldsNoComputedNumber) {
  std::ifstream file(stage_file);
  const json stage = json::parse(file);
  const json& lumped = stage["lumped"];
  EXPECT_FALSE(stage["planets"].contains("centre_distance_mm"));
  for (const char* member : {"sun", "planet", "ring", "carrier"})
    for (const char* key : {"mass_kg", "inertia_over_r2_kg", "base_radius_mm", "teeth"})
      EXPECT_FALSE(lumped[member].contains(key)) << member << " " << key;
  for (const char* mesh : {"sun_planet_mesh", "ring_planet_mesh"})
    for (const char* key : {"stiffness_N_per_m", "stiffness_cos_N_per_m", "error_amplitude_um", "friction"})
      EXPECT_FALSE(lumped[mesh].contains(key)) << mesh << " " << key;
  EXPECT_FALSE(lumped.contains("ring_mesh_lead_1"));
}

TEST(StageCompletion, EveryComputedValueNamesItsFormula) {
  const json resolved = loaded().resolved;
  EXPECT_EQ(resolved["lumped"]["sun_planet_mesh"]["origin"]["stiffness_N_per_m"],
            "computed: [G-k] energy method, mean over a mesh period");
  EXPECT_EQ(resolved["planets"]["origin"]["centre_distance_mm"], "computed: [G-a0] sun and planet without backlash");
}

TEST(StageCompletion, AResolvedInputResolvesToItself) {
  const TemporaryFolder folder;
  const json resolved = loaded().resolved;
  std::ofstream(folder / "stage.json") << resolved.dump();
  EXPECT_EQ(load_input(folder / "stage.json").resolved, resolved);
}

TEST(StageCompletion, AnEditedValueThatSaysComputedIsIgnoredAloud) {
  const TemporaryFolder folder;
  json resolved = loaded().resolved;
  resolved["lumped"]["sun"]["mass_kg"] = 9.0;
  std::ofstream(folder / "stage.json") << resolved.dump();
  const LoadedInput input = load_input(folder / "stage.json");
  constexpr double digits = 0.5e-3;  // half a unit of the last one
  EXPECT_NEAR(input.study.stage.sun.mass_kg, 1.654, digits);
  ASSERT_EQ(input.notes.size(), 1U);
  EXPECT_EQ(input.notes[0].rfind("/lumped/sun/mass_kg: the value in the file is ignored", 0), 0U);
  EXPECT_TRUE(loaded().notes.empty());
}

TEST(StageCompletion, ValuesThatFollowAnEditOfTheCatalogueAreToldInOneNote) {
  const TemporaryFolder folder;
  json resolved = loaded().resolved;
  resolved["catalogue"]["mesh_stiffness"]["sun_planet_factor"] = 1.1;  // three values of the sun's meshes
  std::ofstream(folder / "stage.json") << resolved.dump();
  EXPECT_EQ(load_input(folder / "stage.json").notes.size(), 3U);
  resolved["catalogue"]["sun"]["addendum_coefficient"] = 1.01;  // its body, contact ratio, friction, tolerances, too
  std::ofstream(folder / "stage.json") << resolved.dump();
  const LoadedInput input = load_input(folder / "stage.json");
  ASSERT_EQ(input.notes.size(), 1U);
  EXPECT_NE(input.notes[0].find(": the value in the file is ignored and computed anew, like "), std::string::npos);
}

TEST(StageCompletion, WhatNothingComputesStandsWhateverItsOriginSays) {
  const TemporaryFolder folder;
  std::ifstream file(stage_file);
  json stage = json::parse(file);
  stage["planets"]["origin"] = "computed: by hand";
  stage["lumped"]["planet"]["origin"] = "computed: by hand";
  std::ofstream(folder / "stage.json") << stage.dump();
  const LoadedInput input = load_input(folder / "stage.json");
  EXPECT_EQ(input.study.stage.planet_count, 3);
  EXPECT_EQ(input.study.stage.planet.bearing_N_per_m, 1e8);
}

TEST(StageCompletion, NumbersThatMakeNoGearsAreProblemsOfTheInput) {
  for (const char* set :
       {"/catalogue/ring/profile_shift=-1", "/catalogue/ring/pressure_angle_deg=5", "/catalogue/planet/profile_shift=5",
        "/catalogue/ring/module_mm=1", "/catalogue/carrier/shaft/inner_diameter_mm=70",
        "/catalogue/carrier/body/inner_diameter_mm=200", "/catalogue/sun/width_mm=1", "/catalogue/ring/teeth=40",
        "/catalogue/lubrication/roughness_um=5"}) {
    const auto lines = messages({set});
    EXPECT_FALSE(lines.empty()) << set;
    EXPECT_TRUE(any_has(lines, "/catalogue/")) << set;
  }
}

TEST(StageCompletion, ABearingMayHaveDataOfItsOwn) {
  const LoadedInput own =
      loaded({R"(/catalogue/carrier/bearing={"balls": 14, "ball_diameter_mm": 16, "approach_um": 10})"});
  EXPECT_EQ(own.study.stage.carrier.support_N_per_m, loaded().study.stage.carrier.support_N_per_m);
  EXPECT_EQ(own.resolved["lumped"]["carrier"]["origin"]["support_N_per_m"],
            "computed: [G-11] tangent stiffness of bearing own data at an approach of 10 um");
  EXPECT_TRUE(any_has(messages({R"(/catalogue/carrier/bearing={"balls": 14})"}), "ball_diameter_mm"));
  EXPECT_TRUE(any_has(messages({R"(/catalogue/carrier/bearing={"approach_um": 10})"}), "/catalogue/carrier/bearing"));
}

TEST(StageCompletion, AWrongLoadShareIsToldWhereItStands) {
  gear::Stage stage = loaded().study.stage;
  ASSERT_TRUE(gear::problems_for_dynamics(stage).empty());
  stage.sun_planet_mesh.friction.ehl->share_position.front() = 0.1;
  EXPECT_TRUE(any_has(gear::problems_for_dynamics(stage),
                      "/lumped/sun_planet_mesh/friction/lubricated/load_share_position: must go from 0"));
}

TEST(StageCompletion, AStageWithoutTeethHasNoWarningOfAssembly) {
  const LoadedInput modes_only = load_input("inputs/lin_parker_1999_n3.json");
  ASSERT_FALSE(modes_only.study.stage.sun.teeth.has_value());
  EXPECT_FALSE(any_has(warnings(modes_only), "cannot be assembled"));
  EXPECT_TRUE(any_has(warnings(loaded({"/planets/count=5"})), "cannot be assembled"));
}

TEST(StageCompletion, AnotherFormOfStiffnessTakesThePlaceOfTheComputedOne) {
  const TemporaryFolder folder;
  std::ofstream(folder / "harmonics.json") << loaded().resolved.dump();
  const LoadedInput curve = load_input(
      folder / "harmonics.json", parse_assignments(std::vector<std::string>{"/catalogue/mesh_stiffness/form=curve"}));
  EXPECT_EQ(curve.resolved["lumped"], loaded({"/catalogue/mesh_stiffness/form=curve"}).resolved["lumped"]);
  std::ofstream(folder / "curve.json") << curve.resolved.dump();
  const LoadedInput back = load_input(
      folder / "curve.json", parse_assignments(std::vector<std::string>{"/catalogue/mesh_stiffness/form=harmonics"}));
  EXPECT_EQ(back.resolved["lumped"], loaded().resolved["lumped"]);
}

TEST(StageCompletion, GivenRowsOfACurveStandAsAWhole) {
  const TemporaryFolder folder;
  json stage = loaded({"/catalogue/mesh_stiffness/form=curve"}).resolved;
  json& rows = stage["lumped"]["sun_planet_mesh"]["stiffness_curve"];
  rows["origin"].erase("stiffness_N_per_m");
  rows["stiffness_N_per_m"][0] = 1.0 + rows["stiffness_N_per_m"][0].get<double>();
  for (const char* form : {"curve", "harmonics"}) {
    stage["catalogue"]["mesh_stiffness"]["form"] = form;
    std::ofstream(folder / "stage.json") << stage.dump();
    const LoadedInput input = load_input(folder / "stage.json");
    EXPECT_EQ(input.resolved["lumped"]["sun_planet_mesh"]["stiffness_curve"], rows) << form;
  }
}

TEST(StageCompletion, AStageThatCannotMoveIsToldWhy) {
  const auto lines = gear_warnings(loaded({"/boundary=star", "/lumped/carrier/torsional_support_N_per_m=0"}));
  EXPECT_TRUE(any_has(lines, "no time integration, no operating point: /lumped/carrier/torsional_support_N_per_m"));
  EXPECT_TRUE(any_has(gear_warnings(loaded({"/planets/count=5"})), "cannot be assembled"));
}

TEST(StageCompletion, AGivenValueStands) {
  const LoadedInput input = loaded({"/lumped/sun/mass_kg=2", "/lumped/sun_planet_mesh/stiffness_N_per_m=1e9"});
  EXPECT_EQ(input.study.stage.sun.mass_kg, 2.0);
  EXPECT_EQ(input.study.stage.sun_planet_mesh.stiffness_N_per_m, 1e9);
  EXPECT_EQ(input.resolved["lumped"]["sun"]["origin"]["mass_kg"], "set: command line");
}

TEST(StageCompletion, ComputedValuesFollowAChangeOfTheCatalogue) {
  const LoadedInput input = loaded();
  const double width = 30.0;
  Study halved = input.with_value("/catalogue/sun/width_mm", width);
  constexpr double rounding_kg = 1e-14;  // of some ten operations
  EXPECT_NEAR(halved.stage.sun.mass_kg, 0.5 * input.study.stage.sun.mass_kg, rounding_kg);
  EXPECT_LT(halved.stage.sun_planet_mesh.stiffness_N_per_m, input.study.stage.sun_planet_mesh.stiffness_N_per_m);
  // The ring's mesh does not know the sun.
  EXPECT_EQ(halved.stage.ring_planet_mesh.stiffness_N_per_m, input.study.stage.ring_planet_mesh.stiffness_N_per_m);
}

TEST(StageCompletion, AValueThatIsSweptIsNotComputedAnew) {
  const LoadedInput input = loaded();
  EXPECT_EQ(input.with_value("/lumped/planet/mass_kg", 3.0).stage.planet.mass_kg, 3.0);
  const Study element = input.with_value("/lumped/sun_planet_mesh/stiffness_cos_N_per_m/1", 5e7);
  EXPECT_EQ(element.stage.sun_planet_mesh.stiffness_cos_N_per_m[1], 5e7);
  EXPECT_EQ(element.stage.sun_planet_mesh.stiffness_N_per_m, input.study.stage.sun_planet_mesh.stiffness_N_per_m);
}

TEST(StageCompletion, AFullCurveReplacesTheHarmonics) {
  const LoadedInput input = loaded({"/catalogue/mesh_stiffness/form=curve"});
  const gear::Mesh& mesh = input.study.stage.sun_planet_mesh;
  ASSERT_TRUE(mesh.stiffness_curve);
  EXPECT_TRUE(mesh.stiffness_cos_N_per_m.empty());
  EXPECT_EQ(mesh.stiffness_curve->breakpoints.size(), 2U);
}

TEST(StageCompletion, TablesAreAsFineAsTheirToleranceAsksAndSayWhatTheyReach) {
  const std::string curve = "/catalogue/mesh_stiffness/form=curve";
  std::size_t curve_rows = 0;
  std::size_t share_rows = 0;
  for (const char* tolerance : {"1e-5", "1e-9", "1e-12"}) {
    const LoadedInput input = loaded({curve, std::string("/catalogue/mesh_stiffness/table_tolerance=") + tolerance,
                                      std::string("/catalogue/lubrication/table_tolerance=") + tolerance});
    for (const char* name : {"sun_planet_mesh", "ring_planet_mesh"}) {
      const json& mesh = input.resolved["lumped"][name];
      const json& rows = mesh["stiffness_curve"];
      EXPECT_EQ(rows["interpolation"], "smooth");
      EXPECT_LE(rows["error"].get<double>(), std::stod(tolerance));
      const json& oil = mesh["friction"]["lubricated"];
      EXPECT_EQ(oil["load_share_interpolation"], "smooth");
      EXPECT_LE(oil["load_share_error"].get<double>(), std::stod(tolerance));
      EXPECT_EQ(oil["table_tolerance"], std::stod(tolerance));
    }
    const json& sun = input.resolved["lumped"]["sun_planet_mesh"];
    EXPECT_GT(sun["stiffness_curve"]["phase"].size(), curve_rows);
    EXPECT_GT(sun["friction"]["lubricated"]["load_share"].size(), share_rows);
    curve_rows = sun["stiffness_curve"]["phase"].size();
    share_rows = sun["friction"]["lubricated"]["load_share"].size();
    const TemporaryFolder folder;
    std::ofstream(folder / "stage.json") << input.resolved.dump();
    EXPECT_EQ(load_input(folder / "stage.json").resolved, input.resolved);
    // Rows that are given are none that something known was sampled at, unless they say so.
    json given = input.resolved;
    given.erase("catalogue");
    json& sun_curve = given["lumped"]["sun_planet_mesh"]["stiffness_curve"];
    sun_curve.erase("interpolation");
    sun_curve["origin"].erase("interpolation");
    std::ofstream(folder / "given.json") << given.dump();
    const gear::Stage stage = load_input(folder / "given.json").study.stage;
    EXPECT_EQ(stage.sun_planet_mesh.stiffness_curve->interpolation, Interpolation::monotone);
    EXPECT_EQ(stage.ring_planet_mesh.stiffness_curve->interpolation, Interpolation::smooth);
  }
}

const std::vector<std::string> relieved = {
    R"(/catalogue/sun/tip_relief={"amount_um": 12, "start_roll_mm": 20.5})",
    R"(/catalogue/planet/tip_relief={"amount_um": 15, "start_diameter_mm": 71, "shape": "parabolic"})",
    "/catalogue/mesh_stiffness/form=curve", "/catalogue/mesh_stiffness/design_torque_Nm=900"};

std::vector<std::string> with(std::vector<std::string> sets, const std::string& more) {
  sets.push_back(more);
  return sets;
}

TEST(StageCompletion, ModifiedFlanksHaveTheTransmissionErrorOfTheirContact) {
  const LoadedInput input = loaded(relieved);
  const gear::Stage& stage = input.study.stage;
  const gear::LoadedContacts contacts = gear::loaded_contacts(gear::make_gear_set(stage), 900.0);
  for (const auto& [mesh, contact] : {std::pair(&stage.sun_planet_mesh, &contacts.sun_planet),
                                      std::pair(&stage.ring_planet_mesh, &*contacts.ring_planet)}) {
    ASSERT_TRUE(mesh->error_curve.has_value());
    const auto error = model::error_track(*mesh->error_curve, 1.0);
    const auto stiffness = model::stiffness_track(*mesh->stiffness_curve, 1e-6);
    for (const double phase : {0.013, 0.2, 0.31, 0.5, 0.77, 0.96}) {
      const double delta = contact->transmission_error_um(phase, contact->force_N());
      const double e = error.at(error.place(phase), phase)[0];
      const double k = stiffness.at(stiffness.place(phase), phase)[0] * 1e-12;  // [N/um]
      EXPECT_NEAR(e, contact->no_load_error_um(phase), 1e-7);
      EXPECT_NEAR(e + contact->force_N() / k, delta, 1e-7) << "exact at the design load";
    }
  }
}

TEST(StageCompletion, AModifiedStageResolvesToItselfAndFollowsItsTorque) {
  const TemporaryFolder folder;
  const json resolved = loaded(relieved).resolved;
  std::ofstream(folder / "stage.json") << resolved.dump();
  EXPECT_EQ(load_input(folder / "stage.json").resolved, resolved);
  // Without a design torque the torque of the load counts, also where a study changes it.
  std::vector<std::string> by_load(relieved.begin(), relieved.end() - 1);
  by_load.push_back(R"(/load={"torque_Nm": 900})");
  const LoadedInput input = loaded(by_load);
  EXPECT_EQ(input.study.stage.sun_planet_mesh.stiffness_N_per_m,
            loaded(relieved).study.stage.sun_planet_mesh.stiffness_N_per_m);
  EXPECT_NE(input.with_value("/load/torque_Nm", 1200.0).stage.sun_planet_mesh.stiffness_N_per_m,
            input.study.stage.sun_planet_mesh.stiffness_N_per_m);
  EXPECT_EQ(loaded(relieved).with_value("/load/power_kW", 300.0).stage.sun_planet_mesh.stiffness_N_per_m,
            loaded(relieved).study.stage.sun_planet_mesh.stiffness_N_per_m);
}

TEST(StageCompletion, ReliefsThatCannotBeAreProblemsOfTheirMember) {
  const std::vector<std::string> without_torque(relieved.begin(), relieved.end() - 1);
  EXPECT_TRUE(any_has(messages(without_torque), "/catalogue/mesh_stiffness/design_torque_Nm: is missing; relief"));
  EXPECT_TRUE(any_has(messages(with(relieved, "/catalogue/sun/tip_relief/start_roll_mm=40")),
                      "/catalogue/sun: the tip relief starts at a length of roll of 40"));
  EXPECT_TRUE(
      any_has(messages(with(relieved, "/catalogue/planet/tip_relief/start_diameter_mm=20")), "inside the base circle"));
  EXPECT_TRUE(any_has(messages(with(relieved, "/catalogue/sun/tip_relief/start_diameter_mm=70")), "start_roll_mm"));
  EXPECT_TRUE(any_has(messages(with(relieved, "/catalogue/sun/tip_relief/amount_um=-1")), "amount_um"));
  EXPECT_TRUE(any_has(messages(with(relieved, "/catalogue/sun/tip_relief/shape=cubic")), "shape"));
}

TEST(StageCompletion, RemovedReliefLeavesNothingBehind) {
  const TemporaryFolder folder;
  json resolved = loaded(relieved).resolved;
  for (const char* member : {"sun", "planet"}) resolved["catalogue"][member].erase("tip_relief");
  std::ofstream(folder / "stage.json") << resolved.dump();
  const gear::Stage stage = load_input(folder / "stage.json").study.stage;
  EXPECT_FALSE(stage.sun_planet_mesh.error_curve.has_value());
  EXPECT_EQ(
      stage.sun_planet_mesh.stiffness_curve->stiffness_N_per_m,
      loaded({"/catalogue/mesh_stiffness/form=curve"}).study.stage.sun_planet_mesh.stiffness_curve->stiffness_N_per_m);
}

TEST(StageCompletion, GivenErrorsReplaceTheAmplitudeOfAGrade) {
  const gear::Stage stage = loaded({"/lumped/sun_planet_mesh/error_cos_um=[1, 2]"}).study.stage;
  EXPECT_EQ(stage.sun_planet_mesh.error_amplitude_um, std::vector{0.0});
  EXPECT_GT(stage.ring_planet_mesh.error_amplitude_um[0], 0.0);
}

// A file with the curve of the energy method is the catalogue's path, to the error of its interpolation.
TEST(StageCompletion, AStiffnessFileOfTheEnergyMethodGivesTheQuasiStaticStatesOfTheCatalogue) {
  const TemporaryFolder folder;
  const std::vector<std::string> moves = {"/boundary=fixed_ring", "/lumped/ring/torsional_support_N_per_m=1e9",
                                          "/catalogue/mesh_stiffness/form=curve"};
  const LoadedInput catalogue = loaded(moves);
  const gear::GearSet set = gear::make_gear_set(catalogue.study.stage);
  const auto states_of = [](const gear::Stage& stage) {
    const model::DynamicModel m = model::make_dynamic_model(stage, model::scales_of(stage), 1.0, {});
    std::vector<double> phases;
    for (int k = 0; k < 60; ++k) phases.push_back(0.1 * k + 0.03);
    std::vector<double> deflections;
    model::MeshDeflections d;
    const auto states = m.quasi_static_states(phases);
    for (std::size_t k = 0; k < phases.size(); ++k) {
      m.deflections(phases[k], states[k].data(), d);
      deflections.push_back(d.sun_planet[0] - m.sun_planet_half_gap);
    }
    return deflections;
  };
  const std::vector<double> exact = states_of(catalogue.study.stage);
  const auto worst = [&](int rows) {
    // Rows beside the breakpoints from the energy method, at both sides of jumps.
    std::string text = "phase,k\n";
    const auto row = [&](double phase, double inside) {
      text += number_text(phase) + "," + number_text(set.sun_planet.stiffness(phase, inside)) + "\n";
    };
    const std::vector<double> breaks = set.sun_planet.breakpoints();
    const double rest = breaks[1];
    text += "0," + number_text(set.sun_planet.stiffness(1.0, 0.5 * (1.0 + rest))) + "\n";
    for (int k = 0; k <= rows; ++k) row(rest * k / rows, 0.5 * rest);
    for (int k = 0; k < rows; ++k) row(rest + (1.0 - rest) * k / rows, 0.5 * (1.0 + rest));
    std::ofstream(folder / "k.csv") << text;
    std::vector<std::string> sets = moves;
    sets.push_back(R"(/lumped/sun_planet_mesh/stiffness_curve={"file": ")" + (folder / "k.csv").string() +
                   R"(", "column": "k", "interpolation": "smooth"})");
    const std::vector<double> of_file = states_of(loaded(sets).study.stage);
    double off = 0.0;
    for (std::size_t k = 0; k < exact.size(); ++k) off = std::max(off, std::abs(of_file[k] / exact[k] - 1.0));
    return off;
  };
  const double coarse = worst(8);
  const double fine = worst(32);
  EXPECT_LT(fine, 1e-7);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_GT(coarse / fine, 16.0) << "the order of the interpolation";
}

TEST(StageCompletion, WithoutLubricationThereIsNoFriction) {
  const LoadedInput input = loaded({"/catalogue/lubrication=null"});
  EXPECT_FALSE(input.study.stage.sun_planet_mesh.friction.any());
}

TEST(StageCompletion, ACoefficientOfFrictionHasThePathOfTheDrawing) {
  const LoadedInput oiled = loaded();
  const LoadedInput input = loaded({"/lumped/sun_planet_mesh/friction/coefficient=0.05"});
  const gear::Friction& friction = input.study.stage.sun_planet_mesh.friction;
  ASSERT_TRUE(friction.coefficient.has_value());
  EXPECT_FALSE(friction.ehl.has_value());
  const gear::EhlFriction& path = *oiled.study.stage.sun_planet_mesh.friction.ehl;
  EXPECT_EQ(friction.coefficient->contact_ratio, path.contact_ratio);
  EXPECT_EQ(friction.coefficient->path_start_mm, path.path_start_mm);
  // The other mesh is as it was, and that is told.
  EXPECT_TRUE(input.study.stage.ring_planet_mesh.friction.ehl.has_value());
  EXPECT_TRUE(any_has(warnings(input), "different kinds of friction"));
  // Of a resolved input, where the computed form stands already.
  const TemporaryFolder folder;
  std::ofstream(folder / "stage.json") << oiled.resolved.dump();
  const LoadedInput again =
      load_input(folder / "stage.json",
                 parse_assignments(std::vector<std::string>{"/lumped/sun_planet_mesh/friction/coefficient=0.05"}));
  EXPECT_EQ(again.resolved["lumped"], input.resolved["lumped"]);
  // And back.
  std::ofstream(folder / "coulomb.json") << input.resolved.dump();
  const LoadedInput back =
      load_input(folder / "coulomb.json",
                 parse_assignments(std::vector<std::string>{"/lumped/sun_planet_mesh/friction/coefficient=null"}));
  EXPECT_EQ(back.resolved["lumped"], oiled.resolved["lumped"]);
}

TEST(StageCompletion, WhatIsTakenOutAndComputedAgainIsTold) {
  const LoadedInput input = loaded({"/lumped/sun_planet_mesh/friction=null"});
  EXPECT_EQ(input.resolved, loaded().resolved);
  EXPECT_TRUE(any_has(warnings(input), "/lumped/sun_planet_mesh/friction: --set")) << "nothing changed, without a word";
  EXPECT_FALSE(any_has(warnings(loaded({"/catalogue/lubrication=null"})), "computed from the catalogue data again"));
}

TEST(StageCompletion, ABearingThatAGivenSupportReplacesIsTold) {
  const auto lines = warnings(loaded({R"(/lumped/sun={"support_N_per_m": 1e7, "origin": "estimate: shaft"})"}));
  EXPECT_TRUE(any_has(lines, "/lumped/sun/support_N_per_m: is given, so the"));
  EXPECT_TRUE(any_has(lines, "/catalogue/sun_bearing gives is not used"));
}

TEST(StageCompletion, AFixedRingGetsNoTorsionalStiffnessOfTheCarrier) {
  const LoadedInput input = loaded({"/boundary=fixed_ring", "/lumped/ring/torsional_support_N_per_m=1e9"});
  EXPECT_EQ(input.study.stage.carrier.torsional_support_N_per_m, 0.0);
}

TEST(StageCompletion, WhatTheCatalogueMakesImpossibleIsToldWithItsNumbers) {
  const auto printed = messages({"/catalogue/ring/base_pitch=as_given"});
  EXPECT_TRUE(any_has(printed, "/catalogue/ring/module_mm: base pitches of planet and ring differ by 18.22"));
  EXPECT_FALSE(any_has(printed, "is missing")) << "what could not be computed is not missing";
  EXPECT_TRUE(any_has(messages({"/catalogue/ring/addendum_coefficient=0.7"}), "contact ratio of 0."));
  EXPECT_TRUE(any_has(messages({"/catalogue/sun/bore_mm=100"}), "/catalogue/sun/bore_mm: the bore, 100 mm"));
  EXPECT_TRUE(any_has(messages({"/catalogue/sun_bearing/type=\"9999\""}), "is not among the bearings known here"));
  EXPECT_TRUE(any_has(messages({"/catalogue/sun/teeth=0"}), "/catalogue/sun/teeth"));
  EXPECT_TRUE(any_has(messages({"/catalogue/sun/modul_mm=2"}), "did you mean"));
}

TEST(StageCompletion, WhatNoDrawingGivesIsMissing) {
  EXPECT_TRUE(any_has(messages({"/catalogue/carrier/body=null"}), "/lumped/carrier/mass_kg: is missing"));
  EXPECT_TRUE(any_has(messages({"/lumped/ring/support_N_per_m=null"}), "/lumped/ring/support_N_per_m: is missing"));
}

TEST(StageCompletion, TheErrorFollowsFromTheFormDeviationUnlessTheStageSaysOtherwise) {
  const auto mesh = [](const LoadedInput& input) { return input.resolved["lumped"]["ring_planet_mesh"]; };
  EXPECT_EQ(mesh(loaded())["error_amplitude_um"], 9.0);  // the paper's stage states the single pitch deviation
  const json usual = mesh(loaded({"/catalogue/error_amplitude=null"}));
  EXPECT_EQ(usual["error_amplitude_um"], 4.75);
  EXPECT_EQ(
      usual["origin"]["error_amplitude_um"],
      "computed: [G-error] half of the profile form deviation of the accuracy grade, the larger of the two members");
}

}  // namespace
}  // namespace epicyclic::input::stage_completion_test
