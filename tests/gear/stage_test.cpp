#include "gear/stage.hpp"

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "problems/r1.hpp"

namespace epicyclic::gear::stage_test {
namespace {

struct Rule {
  const char* pointer;  ///< what the line must begin with
  const char* words;    ///< what it must contain
  std::function<void(Stage&)> break_it;
  Stage base = problems::r1();
};

void expect_each_rule(const std::vector<Rule>& rules, std::vector<std::string> (*check)(const Stage&)) {
  for (const Rule& rule : rules) {
    Stage s = rule.base;
    EXPECT_TRUE(check(s).empty()) << rule.pointer << ": the base stage is wrong already: " << check(s).front();
    rule.break_it(s);
    const std::vector<std::string> lines = check(s);
    bool found = false;
    std::string all;
    for (const std::string& line : lines) {
      found = found || (line.starts_with(std::string(rule.pointer) + ": ") && line.find(rule.words) != line.npos);
      all += line + "\n";
    }
    EXPECT_TRUE(found) << rule.pointer << " '" << rule.words << "' is not among:\n" << all;
  }
}

TEST(Stage, AnglesAreEquallySpacedUnlessGiven) {
  Stage s = problems::r1();
  EXPECT_EQ(s.planet_angles_deg(), (std::vector<double>{0.0, 120.0, 240.0}));
  s = problems::with_unequal_angles(s);
  EXPECT_EQ(s.planet_angles_deg(), (std::vector<double>{0.0, 110.0, 250.0}));
}

TEST(Stage, GoodStagesHaveNoProblems) {
  const Stage good[] = {problems::r1(),
                        problems::as_printed(problems::r1()),
                        problems::star(problems::r1()),
                        problems::rigid_ring(problems::r1()),
                        problems::r1_nonlinear(),
                        problems::with_unequal_angles(problems::r1_nonlinear()),
                        problems::with_teeth(problems::r1(), 28, 26, 80, 3),
                        problems::with_teeth(problems::r1(), 30, 24, 78, 4),
                        problems::with_teeth(problems::r1(), 24, 26, 76, 5),
                        problems::tang2020()};
  for (const Stage& s : good) {
    EXPECT_EQ(problems_for_modes(s), std::vector<std::string>{}) << s.name;
    EXPECT_EQ(problems_for_dynamics(s), std::vector<std::string>{}) << s.name;
  }
}

TEST(Stage, ModesAllowRigidAndFreeSupports) {
  Stage s = problems::r1();
  s.sun.support_N_per_m = rigid;
  s.planet.bearing_N_per_m = rigid;
  s.carrier.support_N_per_m = 0.0;
  s.ring.torsional_support_N_per_m = 0.0;
  s.sun.teeth.reset();
  s.load = {};
  EXPECT_EQ(problems_for_modes(s), std::vector<std::string>{});
}

TEST(Stage, ModesNameEachRuleThatIsBroken) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  expect_each_rule(
      {
          {"/planets/count", "(1)", [](Stage& s) { s.planet_count = 1; }},
          {"/planets/count", "(7)", [](Stage& s) { s.planet_count = 7; }},
          {"/planets/angles_deg", "has 2 angles for 3",
           [](Stage& s) {
             s.angles_deg = {0.0, 120.0};
           }},
          {"/planets/angles_deg/2", "place of another",
           [](Stage& s) {
             s.angles_deg = {0.0, 120.0, 360.0};
           }},
          {"/lumped/sun/mass_kg", "positive", [](Stage& s) { s.sun.mass_kg = 0.0; }},
          {"/lumped/ring/inertia_over_r2_kg", "(-1)", [](Stage& s) { s.ring.inertia_over_r2_kg = -1.0; }},
          {"/lumped/carrier/mass_kg", "positive", [](Stage& s) { s.carrier.mass_kg = rigid; }},
          {"/lumped/sun/support_N_per_m", "at least 0", [](Stage& s) { s.sun.support_N_per_m = -1.0; }},
          {"/lumped/ring/torsional_support_N_per_m", "at least 0",
           [](Stage& s) { s.ring.torsional_support_N_per_m = -2.0; }},
          {"/lumped/carrier/support_N_per_m", "at least 0", [](Stage& s) { s.carrier.support_N_per_m = nan; }},
          {"/lumped/planet/mass_kg", "positive", [](Stage& s) { s.planet.mass_kg = 0.0; }},
          {"/lumped/planet/inertia_over_r2_kg", "positive", [](Stage& s) { s.planet.inertia_over_r2_kg = nan; }},
          {"/lumped/planet/bearing_N_per_m", "at least 0", [](Stage& s) { s.planet.bearing_N_per_m = -1.0; }},
          {"/lumped/sun_planet_mesh/stiffness_N_per_m", "positive",
           [](Stage& s) { s.sun_planet_mesh.stiffness_N_per_m = 0.0; }},
          {"/lumped/ring_planet_mesh/stiffness_N_per_m", "positive",
           [](Stage& s) { s.ring_planet_mesh.stiffness_N_per_m = rigid; }},
          {"/planets/centre_distance_mm", "between 0 and 1", [](Stage& s) { s.centre_distance_mm = 50.0; }},
          {"/lumped/sun_planet_mesh/operating_pressure_angle_deg", "does not fit",
           [](Stage& s) { s.sun_planet_mesh.operating_pressure_angle_deg = 30.3; }},
          {"/lumped/ring_planet_mesh/operating_pressure_angle_deg", "does not fit",
           [](Stage& s) { s.ring_planet_mesh.operating_pressure_angle_deg = 21.957; }},
          {"/lumped/ring_planet_mesh/operating_pressure_angle_deg", "is missing",
           [](Stage& s) { s.ring.base_radius_mm.reset(); }},
      },
      problems_for_modes);
}

TEST(Stage, MotionNamesEachRuleThatIsBroken) {
  const char* k_su = "/lumped/sun/torsional_support_N_per_m";
  const char* k_ru = "/lumped/ring/torsional_support_N_per_m";
  const char* k_cu = "/lumped/carrier/torsional_support_N_per_m";
  const Stage as_printed = problems::as_printed(problems::r1());
  const Stage star = problems::star(problems::r1());
  expect_each_rule(
      {
          {"/lumped/sun/teeth", "missing", [](Stage& s) { s.sun.teeth.reset(); }},
          {"/lumped/ring/base_radius_mm", "missing", [](Stage& s) { s.ring.base_radius_mm.reset(); }},
          {"/lumped/planet/teeth", "missing", [](Stage& s) { s.planet.teeth.reset(); }},
          {"/lumped/planet/base_radius_mm", "missing", [](Stage& s) { s.planet.base_radius_mm.reset(); }},
          {"/planets/centre_distance_mm", "missing", [](Stage& s) { s.centre_distance_mm.reset(); }},
          {"/lumped/sun/support_N_per_m", "modes only", [](Stage& s) { s.sun.support_N_per_m = rigid; }},
          {"/lumped/ring/support_N_per_m", "modes only", [](Stage& s) { s.ring.support_N_per_m = rigid; }},
          {"/lumped/carrier/support_N_per_m", "modes only", [](Stage& s) { s.carrier.support_N_per_m = rigid; }},
          {"/lumped/planet/bearing_N_per_m", "modes only", [](Stage& s) { s.planet.bearing_N_per_m = rigid; }},
          {"/lumped/planet/bearing_N_per_m", "positive", [](Stage& s) { s.planet.bearing_N_per_m = 0.0; }},
          {k_su, "fixed_ring", [](Stage& s) { s.sun.torsional_support_N_per_m = 1.0; }},
          {k_ru, "positive", [](Stage& s) { s.ring.torsional_support_N_per_m = 0.0; }},
          {k_cu, "must be 0", [](Stage& s) { s.carrier.torsional_support_N_per_m = 1.0; }},
          {k_su, "as_printed", [](Stage& s) { s.sun.torsional_support_N_per_m = 1.0; }, as_printed},
          {k_ru, "as_printed", [](Stage& s) { s.ring.torsional_support_N_per_m = 1.0; }, as_printed},
          {k_cu, "as_printed", [](Stage& s) { s.carrier.torsional_support_N_per_m = 0.0; }, as_printed},
          {k_ru, "star", [](Stage& s) { s.ring.torsional_support_N_per_m = rigid; }, star},
          {k_cu, "star", [](Stage& s) { s.carrier.torsional_support_N_per_m = rigid; }, star},
          {"/lumped/ring/base_radius_mm", "z_r / z_s", [](Stage& s) { s.ring.base_radius_mm = 96.3005; }},
          {"/lumped/planet/base_radius_mm", "z_p / z_s", [](Stage& s) { s.planet.teeth = 26; }},
          {"/lumped/ring_planet_mesh/damping_ratio", "missing",
           [](Stage& s) { s.ring_planet_mesh.damping_ratio.reset(); }},
          {"/lumped/sun_planet_mesh/error_amplitude_um", "has 2 numbers",
           [](Stage& s) {
             s.sun_planet_mesh.error_amplitude_um = {1.0, 2.0};
           }},
          {"/lumped/ring_planet_mesh/error_phase_deg", "has 4 numbers",
           [](Stage& s) {
             s.ring_planet_mesh.error_phase_deg = {1.0, 2.0, 3.0, 4.0};
           }},
          {"/lumped/sun_planet_mesh/stiffness_N_per_m", "must stay positive",
           [](Stage& s) {
             s.sun_planet_mesh.stiffness_cos_N_per_m = {0.0, 1.3e9};
           }},
          {"/lumped/sun/bearing/balls", "missing",
           [](Stage& s) {
             s.sun_bearing.law = BearingLaw::palmgren_xy;
             s.sun_bearing.ball_diameter_mm = 16.67;
           }},
          {"/lumped/sun/bearing/ball_diameter_mm", "missing",
           [](Stage& s) {
             s.sun_bearing.law = BearingLaw::palmgren_radial;
             s.sun_bearing.balls = 10;
           }},
          {"/load", "exclude", [](Stage& s) { s.load.torque_Nm = 1.0; }},
          {"/load", "needs", [](Stage& s) { s.load.power_kW.reset(); }},
      },
      problems_for_dynamics);
}

TEST(Stage, FrictionTablesNameEachRuleThatIsBroken) {
  Stage base = problems::r1();
  base.sun_planet_mesh.friction.table =
      FrictionTable{{0.0, 0.0, 0.4, 0.4, 0.7}, {1, 2, 3, 4, 5}, {1, 2, 3, 4, 5}, {1, 2, 3, 4, 5}, {0.0, 0.4}};
  const auto table = [](Stage& s) -> FrictionTable& { return *s.sun_planet_mesh.friction.table; };
  const std::string at = "/lumped/sun_planet_mesh/friction";
  const std::string force = at + "/force_ratio";
  const std::string driving = at + "/moment_ratio_mm/driving";
  const std::string driven = at + "/moment_ratio_mm/driven";
  const std::string phase = at + "/phase";
  const std::string row_1 = at + "/phase/1";
  const std::string row_2 = at + "/phase/2";
  const std::string row_3 = at + "/phase/3";
  const std::string row_4 = at + "/phase/4";
  const std::string breakpoint_0 = at + "/breakpoints/0";
  const std::string breakpoint_1 = at + "/breakpoints/1";
  expect_each_rule(
      {
          {force.c_str(), "has 4 numbers", [&](Stage& s) { table(s).force_ratio.pop_back(); }, base},
          {driving.c_str(), "has 4 numbers", [&](Stage& s) { table(s).moment_driving_mm.pop_back(); }, base},
          {driven.c_str(), "has 4 numbers", [&](Stage& s) { table(s).moment_driven_mm.pop_back(); }, base},
          {phase.c_str(), "at least 2",
           [&](Stage& s) {
             table(s) = {{0.0}, {1}, {1}, {1}, {}};
           },
           base},
          {row_4.c_str(), "[0, 1)", [&](Stage& s) { table(s).phase[4] = 1.0; }, base},
          {row_4.c_str(), "must rise", [&](Stage& s) { table(s).phase[4] = 0.3; }, base},
          {row_3.c_str(), "not among the breakpoints", [&](Stage& s) { table(s).breakpoints = {0.0}; }, base},
          {row_2.c_str(), "more than twice", [&](Stage& s) { table(s).phase[2] = 0.0; }, base},
          {breakpoint_1.c_str(), "[0, 1)", [&](Stage& s) { table(s).breakpoints[1] = 1.0; }, base},
          {breakpoint_1.c_str(), "must rise",
           [&](Stage& s) {
             table(s).breakpoints = {0.4, 0.0};
           },
           base},
          {breakpoint_0.c_str(), "needs a row",
           [&](Stage& s) {
             table(s).breakpoints = {0.1, 0.4};
           },
           base},
      },
      problems_for_dynamics);
}

TEST(Assembly, ThePlacesOfAPlanetAreWholeTeethOfSunAndRingApart) {
  EXPECT_NEAR(assembly_angle_deg(98, 0.0, 100.0), 360.0 * 27 / 98, 1e-12);
  EXPECT_NEAR(assembly_angle_deg(98, 10.0, 100.0), 10.0 + 360.0 * 25 / 98, 1e-12);  // 24.5 is rounded up
  Stage s = problems::with_gap(problems::r1());
  EXPECT_TRUE(assembly_misfits(s).empty());
  const int teeth = *s.sun.teeth + *s.ring.teeth;
  s.angles_deg = {5.0, 125.0, 5.0 + 360.0 * 73 / teeth};
  const std::vector<Misfit> misfits = assembly_misfits(s);
  EXPECT_TRUE(misfits.empty());
  s.angles_deg[1] = 126.0;
  ASSERT_EQ(assembly_misfits(s).size(), 1U);
  EXPECT_EQ(assembly_misfits(s)[0].planet, 1U);
  EXPECT_NEAR(assembly_misfits(s)[0].nearest_deg, assembly_angle_deg(teeth, 5.0, 126.0), 1e-12);
  s.ring.teeth.reset();
  EXPECT_TRUE(assembly_misfits(s).empty());
}

}  // namespace
}  // namespace epicyclic::gear::stage_test
