// A lone pair of gears from a drawing: the numbers of the external mesh of a stage with the same gears, the pair that
// is given by them as lumped values, and what is refused.
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "gear/gear_set.hpp"
#include "input/study_input.hpp"
#include "input/study_model.hpp"
#include "model/dynamic_model.hpp"

namespace epicyclic::input::pair_drawing_test {
namespace {

using nlohmann::json;

/// Four planets: their share of a torque on the sun has no rounding.
constexpr int planets = 4;

/// A ring stage of 24/30/84 teeth with shifts, grade, bores, lubricant, and reliefs or none.
json ring_stage(const char* form, bool modified) {
  json stage = json::parse(R"({
    "boundary": "fixed_ring", "planets": { "count": 4, "angles_deg": [0, 90, 180, 270] }, "load": { "torque_Nm": 800 },
    "catalogue": {
      "sun": { "teeth": 24, "module_mm": 3, "profile_shift": 0.3, "width_mm": 32, "accuracy_grade": 6, "bore_mm": 20 },
      "planet": { "teeth": 30, "module_mm": 3, "profile_shift": 0.1, "width_mm": 30, "accuracy_grade": 7,
                  "bore_mm": 40 },
      "ring": { "teeth": 84, "module_mm": 3, "profile_shift": 0.5, "width_mm": 30, "outer_diameter_mm": 290 },
      "carrier": { "body": { "plate_thickness_mm": 9, "outer_diameter_mm": 210, "pin_diameter_mm": 24,
                             "pin_length_mm": 33 } },
      "lubrication": { "viscosity_mPas": 15 } },
    "lumped": {
      "sun": { "support_N_per_m": 1e8, "support_damping_ratio": 0.05 },
      "ring": { "support_N_per_m": 1e8, "torsional_support_N_per_m": 1e9, "support_damping_ratio": 0.05 },
      "carrier": { "support_N_per_m": 1e8, "support_damping_ratio": 0.05 },
      "planet": { "bearing_N_per_m": 2e8, "support_damping_ratio": 0.05 },
      "sun_planet_mesh": { "damping_ratio": 0.05 }, "ring_planet_mesh": { "damping_ratio": 0.05 } } })");
  stage["catalogue"]["mesh_stiffness"] = {{"form", form}};
  if (modified) {
    stage["catalogue"]["sun"]["tip_relief"] = {{"amount_um", 15}, {"start_diameter_mm", 75}};
    stage["catalogue"]["planet"]["root_relief"] = {{"amount_um", 10}, {"start_diameter_mm", 89}};
    stage["catalogue"]["planet"]["crowning_um"] = 4;
  }
  return stage;
}

/// Its sun and one of its planets, with their part of the torque.
json pair_of(json stage) {
  stage["boundary"] = "pair";
  stage.erase("planets");
  stage["load"]["torque_Nm"] = stage["load"]["torque_Nm"].get<double>() / planets;
  for (const char* key : {"ring", "carrier"}) {
    stage["catalogue"].erase(key);
    stage["lumped"].erase(key);
  }
  stage["lumped"].erase("ring_planet_mesh");
  return stage;
}

LoadedInput loaded(const json& stage) { return load_input_text(stage.dump(), "stage.json"); }

/// Problems of a stage, a line each.
std::string refusal(const json& stage) {
  std::string lines;
  try {
    (void)loaded(stage);
  } catch (const InputProblems& error) {
    for (const Problem& problem : error.problems()) lines += problem.text() + "\n";
  }
  return lines;
}

void expect_the_same_numbers(const json& stage) {
  const LoadedInput of_stage = loaded(stage);
  const LoadedInput of_pair = loaded(pair_of(stage));
  for (const char* part : {"sun", "planet", "sun_planet_mesh"})
    EXPECT_EQ(of_pair.resolved["lumped"][part], of_stage.resolved["lumped"][part]) << part;
  EXPECT_EQ(of_pair.resolved["planets"]["centre_distance_mm"], of_stage.resolved["planets"]["centre_distance_mm"]);
  for (const char* key : {"ring", "carrier", "ring_planet_mesh", "ring_mesh_lead_1"})
    EXPECT_FALSE(of_pair.resolved["lumped"].contains(key)) << key;
  EXPECT_FALSE(of_pair.resolved["catalogue"].contains("ring"));
}

TEST(PairFromDrawing, HasTheNumbersOfTheExternalMeshOfAStage) {
  for (const char* form : {"harmonics", "curve"})
    for (const bool modified : {false, true}) expect_the_same_numbers(ring_stage(form, modified));
}

TEST(PairFromDrawing, HasTheLoadedContactOfTheExternalMeshOfAStage) {
  const json stage = ring_stage("curve", true);
  const gear::Stage whole = loaded(stage).study.stage;
  const gear::Stage pair = loaded(pair_of(stage)).study.stage;
  const gear::GearSet set = gear::make_gear_set(pair);
  const gear::LoadedContacts of_stage = gear::loaded_contacts(gear::make_gear_set(whole), 800.0);
  const gear::LoadedContacts of_pair = gear::loaded_contacts(set, 800.0 / planets);
  ASSERT_TRUE(of_stage.ring_planet.has_value());
  EXPECT_FALSE(of_pair.ring_planet.has_value());
  const double force_N = of_pair.sun_planet.force_N();
  EXPECT_EQ(force_N, of_stage.sun_planet.force_N());
  for (int k = 0; k < 16; ++k)
    EXPECT_EQ(of_pair.sun_planet.transmission_error_um(k / 16.0, force_N),
              of_stage.sun_planet.transmission_error_um(k / 16.0, force_N));
  EXPECT_TRUE(gear::bodies(set).sun.mass_kg > 0.0);
  EXPECT_FALSE(gear::bodies(set).ring.has_value());
}

/// Without what the values were computed from, and without their origins.
json as_lumped(json resolved) {
  resolved.erase("catalogue");
  resolved["lumped"]["sun"].erase("origin");
  return json::parse(resolved.dump(), [](int, json::parse_event_t event, json& parsed) {
    return event != json::parse_event_t::key || parsed != "origin";
  });
}

TEST(PairFromDrawing, IsThePairOfItsComputedValues) {
  for (const bool rigid : {true, false}) {
    json drawn = pair_of(ring_stage("curve", true));
    if (rigid) {
      drawn["lumped"].erase("sun");
      drawn["lumped"].erase("planet");
    }
    const LoadedInput of_drawing = loaded(drawn);
    const LoadedInput of_values = loaded(as_lumped(of_drawing.resolved));
    const auto model_of = [](const gear::Stage& stage) {
      return model::make_dynamic_model(stage, model::scales_of(stage), 0.7, {});
    };
    const model::DynamicModel a = model_of(of_drawing.study.stage);
    const model::DynamicModel b = model_of(of_values.study.stage);
    EXPECT_EQ(a.dimension, rigid ? 2U : 10U);
    ASSERT_EQ(a.dimension, b.dimension);
    std::vector<double> y, of_a(a.dimension), of_b(b.dimension);
    for (std::size_t k = 0; k < a.dimension; ++k) y.push_back(0.1 + 0.03 * static_cast<double>(k));
    for (int k = 0; k < 16; ++k) {
      const double s = 0.39 * k;
      a.right_hand_side(model::segment_at(a.breakpoints, s), s, y.data(), of_a.data());
      b.right_hand_side(model::segment_at(b.breakpoints, s), s, y.data(), of_b.data());
      EXPECT_EQ(of_a, of_b) << k;
    }
  }
}

TEST(PairFromDrawing, OnlyRotatesWithoutBearingsAndFollowsThoseOfTheCatalogue) {
  json drawn = pair_of(ring_stage("harmonics", false));
  drawn["lumped"].erase("sun");
  drawn["lumped"].erase("planet");
  const LoadedInput rigid = loaded(drawn);
  EXPECT_EQ(rigid.resolved["lumped"]["sun"]["support_N_per_m"], "rigid");
  EXPECT_EQ(rigid.resolved["lumped"]["planet"]["bearing_N_per_m"], "rigid");
  EXPECT_EQ(rigid.study.stage.planet_count, 1);
  // A resolved input with bearings in its catalogue: what was computed is computed anew, and back again.
  json with_bearings = rigid.resolved;
  with_bearings["catalogue"]["sun_bearing"] = {{"type", "6208"}};
  with_bearings["catalogue"]["planet_bearing"] = {{"type", "NU210"}};
  const LoadedInput held = loaded(with_bearings);
  EXPECT_TRUE(held.resolved["lumped"]["sun"]["support_N_per_m"].is_number());
  EXPECT_TRUE(held.resolved["lumped"]["planet"]["bearing_N_per_m"].is_number());
  EXPECT_EQ(held.study.stage.sun_bearing.rating.rolling_elements, gear::RollingElements::balls);
  EXPECT_EQ(held.study.stage.planet.rating.rolling_elements, gear::RollingElements::rollers);
  EXPECT_GT(held.study.stage.sun_bearing.rating.dynamic_load_rating_kN.value_or(0.0), 0.0);
  json back = held.resolved;
  back["catalogue"].erase("sun_bearing");
  back["catalogue"].erase("planet_bearing");
  EXPECT_EQ(loaded(back).resolved["lumped"]["sun"]["support_N_per_m"], "rigid");
}

TEST(PairFromDrawing, WarnsOfItsTeeth) {
  json drawn = pair_of(ring_stage("harmonics", false));
  drawn["catalogue"]["sun"]["teeth"] = 14;
  drawn["catalogue"]["sun"]["profile_shift"] = 0.0;
  drawn["catalogue"]["sun"]["bore_mm"] = 10;
  std::string lines;
  for (const std::string& line : gear_warnings(loaded(drawn))) lines += line + "\n";
  EXPECT_NE(lines.find("/catalogue/sun: undercut"), std::string::npos) << lines;
  EXPECT_EQ(lines.find("planets"), std::string::npos) << lines;
  EXPECT_EQ(lines.find("ring"), std::string::npos) << lines;
}

TEST(PairFromDrawing, RefusesWhatItHasNotAndSaysWhatToDo) {
  const json stage = ring_stage("harmonics", false);
  const json pair = pair_of(stage);
  struct Case {
    std::string pointer;
    json value;
    std::string told;
  };
  const std::vector<Case> cases = {
      {"/catalogue/ring", stage["catalogue"]["ring"], "/catalogue/ring: must be left out: a pair has gear 1"},
      {"/catalogue/carrier", stage["catalogue"]["carrier"], "/catalogue/carrier: must be left out"},
      {"/catalogue/mesh_stiffness/ring_planet_factor", 0.9, "ring_planet_factor: must be left out"},
      {"/catalogue/sun/module_mm", 3.2, "/catalogue/planet/module_mm: base pitches of both gears differ"},
      {"/planets", {{"centre_distance_mm", 86.0}}, "the pair's mesh has a contact ratio of 0."},
      {"/planets", {{"centre_distance_mm", 80.0}}, "teeth of the pair's mesh overlap by"},
      {"/planets", {{"count", 3}}, "/planets/count: must be 1 with boundary pair"},
      {"/catalogue/sun_bearing", {{"type", "6999"}}, "/catalogue/sun_bearing/type: \"6999\" is not among"},
      {"/lumped/sun/support_N_per_m", "rigid", "/lumped/planet/bearing_N_per_m: must be \"rigid\" if"},
      {"/lumped/ring", {{"mass_kg", 1.0}}, "/lumped/ring"},
  };
  EXPECT_EQ(refusal(pair), "");
  for (const Case& c : cases) {
    json changed = pair;
    changed[json::json_pointer(c.pointer)] = c.value;
    const std::string lines = refusal({{"stage", changed}, {"study", {{"kind", "run"}}}});
    EXPECT_NE(lines.find(c.told), std::string::npos) << c.pointer << "\n" << lines;
  }
  json without_gear = pair;
  without_gear["catalogue"].erase("planet");
  EXPECT_NE(refusal(without_gear).find("/catalogue/planet: is missing"), std::string::npos);
  json without_ring = stage;
  without_ring["catalogue"].erase("ring");
  EXPECT_NE(refusal(without_ring).find("/catalogue/ring: is missing"), std::string::npos) << refusal(without_ring);
  json relieved = pair_of(ring_stage("harmonics", true));
  relieved["load"] = {{"power_kW", 40}};
  EXPECT_NE(refusal(relieved).find("/catalogue/mesh_stiffness/design_torque_Nm: is missing"), std::string::npos);
}

}  // namespace
}  // namespace epicyclic::input::pair_drawing_test
