#include "gear/gear_set.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "lines.hpp"
#include "problems/table1.hpp"

namespace epicyclic::gear::gear_set_test {
namespace {

using problems::degree;
using test::has_line;
using test::joined;
constexpr double pi = std::numbers::pi;
constexpr double rounding_mm = 1e-13;       // of a few operations on some 100 mm
constexpr double rounding_periods = 1e-13;  // of angles times up to 81 teeth

/// Table 1 with a change, and without its Fourier series, which takes most of the time.
Stage changed(const std::function<void(Stage&, Catalogue&)>& change) {
  Stage s = problems::table1();
  s.catalogue->stiffness.harmonics = 0;
  change(s, *s.catalogue);
  return s;
}

Stage as_it_is() {
  return changed([](Stage&, Catalogue&) {});
}

struct Rule {
  const char* pointer;
  const char* words;
  std::function<void(Stage&, Catalogue&)> break_it;
};

TEST(GearSet, Table1HasNoProblems) { EXPECT_EQ(joined(catalogue_problems(as_it_is())), ""); }

/// Standard teeth of module 2.
void in_one_profile(Catalogue& c, int sun, int planet, int ring, double angle_deg) {
  c.sun.data = {sun, 2, angle_deg, 0, 1, 0.25, 25, {}, {}};
  c.planet.data = {planet, 2, angle_deg, 0, 1, 0.25, 25, {}, {}};
  c.ring.data = {ring, 2, angle_deg, 0, 1, 0.25, 25, {}, {}};
  c.sun.bore_mm = c.planet.bore_mm = 10;
}

TEST(GearSet, EachProblemIsToldAtItsPlace) {
  const std::vector<Rule> rules = {
      {"/catalogue/ring/module_mm", "base pitches of planet and ring differ by 18.2",
       [](Stage&, Catalogue& c) { c.ring.base_pitch = BasePitch::as_given; }},
      {"/catalogue/planet/module_mm", "base pitches of sun and planet differ",
       [](Stage&, Catalogue& c) { c.planet.data.module_mm = 2.64; }},
      {"/catalogue/planet", "the sun-planet mesh has a contact ratio of 0.9",
       [](Stage&, Catalogue& c) { c.sun.data.addendum_coefficient = c.planet.data.addendum_coefficient = 0.8; }},
      {"/catalogue/ring", "the ring-planet mesh has a contact ratio of 0.9",
       [](Stage&, Catalogue& c) { c.ring.data.addendum_coefficient = 0.75; }},
      {"/catalogue/sun", "the tooth is pointed", [](Stage&, Catalogue& c) { c.sun.data.tip_diameter_mm = 83.0; }},
      {"/catalogue/planet", "the tooth is pointed", [](Stage&, Catalogue& c) { c.planet.data.tip_diameter_mm = 78.0; }},
      {"/catalogue/sun", "the rack that cuts it is pointed before its depth of 1.25 modules",
       [](Stage&, Catalogue& c) { in_one_profile(c, 24, 30, 84, 35); }},
      {"/catalogue/ring", "its teeth meet before the root radius",
       [](Stage&, Catalogue& c) { in_one_profile(c, 24, 30, 84, 35); }},
      {"/catalogue/ring", "its teeth meet before the root radius",
       [](Stage&, Catalogue& c) { in_one_profile(c, 40, 50, 140, 33); }},
      {"/planets/count", "neighbouring planets overlap by", [](Stage& s, Catalogue&) { s.planet_count = 6; }},
      {"/planets/angles_deg", "neighbouring planets overlap by",
       [](Stage& s, Catalogue&) {
         s.angles_deg = {0.0, 50.0, 180.0};
       }},
      {"/catalogue/planet", "its tip cuts",
       [](Stage&, Catalogue& c) {
         c.sun.data.clearance_coefficient = 0.0;
         c.planet.data.addendum_coefficient = 1.1;
       }},
      {"/catalogue/sun", "its tip cuts", [](Stage&, Catalogue& c) { c.planet.data.root_diameter_mm = 66.0; }},
      {"/catalogue/ring", "its tip cuts", [](Stage&, Catalogue& c) { c.ring.data.tip_diameter_mm = 206.0; }},
      {"/catalogue/sun/bore_mm", "must be smaller than the root circle",
       [](Stage&, Catalogue& c) { c.sun.bore_mm = 68.0; }},
      {"/catalogue/planet/bore_mm", "must be smaller than the root circle",
       [](Stage&, Catalogue& c) { c.planet.bore_mm = 64.0; }},
      {"/catalogue/ring/outer_diameter_mm", "must be larger than the root circle",
       [](Stage&, Catalogue& c) { c.ring.outer_diameter_mm = 220.0; }},
      {"/catalogue/sun_bearing/type", "is not among the bearings known here",
       [](Stage&, Catalogue& c) { c.sun_bearing->type = "6413"; }},
      {"/catalogue/carrier/bearing/type", "NU204 to NU224",
       [](Stage&, Catalogue& c) { c.carrier.bearing->type = "NU2220"; }},
      {"/catalogue/ring", "teeth of the ring-planet mesh overlap by 0.",
       [](Stage&, Catalogue& c) { c.ring.data.profile_shift = 0.9; }},
      {"/catalogue/planet", "teeth of the sun-planet mesh overlap by",
       [](Stage& s, Catalogue&) { s.centre_distance_mm = 71.5; }},
      {"/catalogue/sun", "at least 3 teeth", [](Stage&, Catalogue& c) { c.sun.data.teeth = 0; }},
      {"/catalogue/ring", "an internal tooth needs", [](Stage&, Catalogue& c) { c.ring.data.tip_diameter_mm = 190.0; }},
      {"/catalogue/sun/accuracy_grade", "accuracy grades", [](Stage&, Catalogue& c) { c.sun.accuracy_grade = 13; }},
      {"/planets/centre_distance_mm", "leave no line of action",
       [](Stage& s, Catalogue& c) {
         s.centre_distance_mm = 60.0;
         c.tips = Tips::full;
       }},
  };
  for (const Rule& rule : rules) {
    const std::vector<std::string> lines = catalogue_problems(changed(rule.break_it));
    EXPECT_TRUE(has_line(lines, rule.pointer, rule.words)) << rule.pointer << ": " << rule.words << "\nnot among:\n"
                                                           << joined(lines);
  }
}

TEST(GearSet, ARingThatDoesNotFitIsToldWhatWould) {
  const auto lines_of_ring = [](int teeth, double shift, double module_mm) {
    return catalogue_problems(changed([&](Stage& s, Catalogue& c) {
      s.centre_distance_mm.reset();
      c.sun.data = {45, 6, 22.5, 0.2, 1, 0.25, 80, {}, {}};
      c.planet.data = {30, 6, 22.5, 0.3, 1, 0.25, 80, {}, {}};
      c.ring.data = {teeth, module_mm, 22.5, shift, 1, 0.25, 80, {}, {}};
      c.ring.base_pitch = BasePitch::as_given;
      c.ring.outer_diameter_mm.reset();
      c.sun.bore_mm = c.planet.bore_mm = 0.0;
    }));
  };
  EXPECT_TRUE(has_line(lines_of_ring(105, 0.3, 6.0), "/catalogue/ring", "x_s + 2 x_p = 0.8"));
  EXPECT_TRUE(has_line(lines_of_ring(104, 0.8, 6.0), "/catalogue/ring", "z_s + 2 z_p = 105 is not z_r = 104"));
  // With that shift nothing overlaps; between modules shifts are not compared.
  for (const auto& lines : {lines_of_ring(105, 0.8, 6.0), lines_of_ring(105, 0.3, 5.9)})
    for (const std::string& line : lines) EXPECT_EQ(line.find("x_s + 2 x_p"), std::string::npos) << line;
  EXPECT_EQ(joined(lines_of_ring(105, 0.8, 6.0)), "");
}

TEST(GearSet, ProblemsOfSeveralMembersAreToldTogether) {
  const auto lines = catalogue_problems(changed([](Stage&, Catalogue& c) {
    c.sun.bore_mm = 68.0;
    c.planet.bore_mm = 64.0;
  }));
  EXPECT_EQ(lines.size(), 2U) << joined(lines);
}

TEST(GearSet, InvoluteInterferenceIsTold) {
  // 12 and 18 standard teeth: the planet's tip reaches beyond the sun's tangent point.
  Stage s = changed([](Stage&, Catalogue& c) {
    c = {};
    c.sun.data = {12, 2, 20, 0, 1, 0.25, 20, {}, {}};
    c.planet.data = {18, 2, 20, 0, 1, 0.25, 20, {}, {}};
    c.ring.data = {48, 2, 20, 0, 1, 0.25, 20, {}, {}};
  });
  EXPECT_TRUE(has_line(catalogue_problems(s), "/catalogue/planet", "before the tangent point of the driving member"))
      << joined(catalogue_problems(s));
}

TEST(GearSet, GivenCentreDistanceDecidesAndLengthensTheShortenedTips) {
  // A larger distance shortens the tips less: the tip clearance stays.
  const GearSet tight = make_gear_set(as_it_is());
  const GearSet wide = make_gear_set(changed([](Stage& s, Catalogue&) { s.centre_distance_mm = 71.82; }));
  EXPECT_EQ(wide.centre_distance_mm, 71.82);
  EXPECT_NEAR((tight.tip_shortening - wide.tip_shortening) * 2.63, 71.82 - tight.centre_distance_mm, rounding_mm);
  EXPECT_NEAR(wide.sun_planet.pair.tip_clearance_1_mm(), 0.25 * 2.63, rounding_mm);
  EXPECT_GT(wide.sun_planet.pair.backlash_mm(), 0.0);
}

TEST(GearSet, TipsAreNeverLengthened) {
  const GearSet standard = make_gear_set(changed([](Stage& s, Catalogue& c) {
    s.centre_distance_mm = 69.0;
    c.sun.data.profile_shift = c.planet.data.profile_shift = 0.1;
    c.ring.data.profile_shift = 0.1;
  }));
  EXPECT_EQ(standard.tip_shortening, 0.0);
  EXPECT_EQ(standard.sun.tip_radius_mm, external_tooth(standard.catalogue.sun.data).tip_radius_mm);
}

TEST(GearSet, ABoreDoesNotMakeTheTeethStifferAndASolidGearIsNotSofter) {
  // The annulus of the formula is held fast along its inner circle: as the bore's radius it would make a gear with a
  // bore of 30 mm 1.7 times as stiff as a solid one.
  const auto mean = [](double bore, double ratio) {
    Stage s = changed([&](Stage&, Catalogue& c) {
      c.sun.bore_mm = c.planet.bore_mm = bore;
      c.sun.body_radius_ratio = c.planet.body_radius_ratio = ratio;
    });
    return make_gear_set(s).sun_planet_stiffness.mean;
  };
  const ExternalGear as_drawn;
  const double solid = mean(0.0, as_drawn.body_radius_ratio);
  double before = solid;
  for (double bore = 0.5; bore <= 62.0; bore += 0.5) {
    const double k = mean(bore, as_drawn.body_radius_ratio);
    EXPECT_LE(k, before) << bore;
    EXPECT_GE(k, 0.99 * before) << bore;
    before = k;
  }
  // With a body that winds up teeth are softer, the more so the smaller its inner circle.
  before = solid;
  for (double ratio = 1.5; ratio <= 7.0; ratio += 0.5) {
    const double k = mean(0.0, ratio);
    EXPECT_LT(k, before) << ratio;
    before = k;
  }
}

TEST(GearSet, MeanStiffnessOfSolidGearsIsThatOfIsoForSolidDiscs) {
  // ISO 6336-1:2006, 9.3, method B, holds for solid discs; models of this kind differ by 30 %.
  struct Row {
    int z_1;
    double x_1;
    int z_2;
    double x_2, angle;
  };
  constexpr double between_models = 0.3;
  for (const Row& r : {Row{20, 0, 20, 0, 20}, Row{20, 0.3, 40, 0.1, 20}, Row{30, 0, 60, 0, 20}, Row{19, 0, 48, 0, 20},
                       Row{21, 0, 28, 0, 20}, Row{25, 0.5, 30, 0.5, 20}, Row{40, 0, 40, 0, 20},
                       Row{17, 0.3, 60, -0.2, 20}, Row{62, 0, 62, 0, 20}, Row{100, 0, 100, 0, 20},
                       Row{24, 0.3, 24, 0.3, 22.5}, Row{18, 0.4, 36, 0.2, 20}, Row{27, 0.623, 25, 0.775, 25}}) {
    const Tooth t_1 = external_tooth({r.z_1, 3, r.angle, r.x_1, 1, 0.25, 20, {}, {}});
    const Tooth t_2 = external_tooth({r.z_2, 3, r.angle, r.x_2, 1, 0.25, 20, {}, {}});
    MeshedPair mesh{make_pair(t_1, t_2, tight_centre_distance_mm(t_1, t_2)),
                    {t_1, {}, solid_body_ratio, {}},
                    {t_2, {}, solid_body_ratio, {}},
                    {},
                    1.0};
    EXPECT_NEAR(fourier_series(mesh, 0).mean / iso_stiffness(mesh).mesh, 1.0, between_models) << r.z_1 << '/' << r.z_2;
    mesh.driving.radius_ratio = mesh.driven.radius_ratio = 7.0;  // what a bore of 0 stood for
    EXPECT_LT(fourier_series(mesh, 0).mean / iso_stiffness(mesh).mesh, 0.5) << r.z_1 << '/' << r.z_2;
  }
}

/// lambda_sr by placing the planet: at the origin of the plane the sun, at (a, 0) the planet; the sun turns
/// counterclockwise and drives, the planet turns clockwise. Where is a planet's tooth when its contact with the sun
/// begins, and where when its contact with the ring begins? The planet turns from one to the other.
double placed_lead(const GearSet& g) {
  const double a = g.centre_distance_mm;
  const auto tooth_angle = [&](double x, double y, double side) {
    // Contact on the flank on one side of the tooth's centre line.
    const double radius = std::hypot(x - a, y);
    return std::atan2(y, x - a) + side * g.planet.half_angle_at(radius);
  };
  // Sun mesh: from N_1 at angle -alpha on the sun along (sin, cos); the sun pushes the planet's tooth towards +y, which
  // there is clockwise: the tooth's centre is at a smaller angle than its flank.
  const Pair& sp = g.sun_planet.pair;
  const double alpha = sp.pressure_angle;
  const double at_sun = tooth_angle(g.sun.base_radius_mm * std::cos(alpha) + sp.start_mm * std::sin(alpha),
                                    -g.sun.base_radius_mm * std::sin(alpha) + sp.start_mm * std::cos(alpha), -1.0);
  // Ring mesh: from N_1 at angle +alpha on the planet along (sin, -cos); the planet's tooth pushes towards -y,
  // clockwise: its centre is at a larger angle than its flank.
  const Pair& rp = g.ring_planet.pair;
  const double beta = rp.pressure_angle;
  const double at_ring = tooth_angle(a + g.planet.base_radius_mm * std::cos(beta) + rp.start_mm * std::sin(beta),
                                     g.planet.base_radius_mm * std::sin(beta) - rp.start_mm * std::cos(beta), 1.0);
  // Clockwise from the start with the ring to that with the sun, in pitches.
  const double turns = (at_ring - at_sun) * g.planet.teeth / (2.0 * pi);
  return turns - std::floor(turns);
}

TEST(GearSet, LeadOfTheRingMeshIsThatOfThePlacedPlanet) {
  const std::vector<std::function<void(Stage&, Catalogue&)>> sets = {
      [](Stage&, Catalogue&) {},
      [](Stage&, Catalogue& c) { c.tips = Tips::full; },
      [](Stage&, Catalogue& c) { c.ring.data.addendum_coefficient = 1.2; },
      [](Stage& s, Catalogue&) { s.centre_distance_mm = 71.8; },
      [](Stage&, Catalogue& c) {
        c.sun.data = {24, 2, 20, 0.1, 1, 0.25, 20, {}, {}};
        c.planet.data = {30, 2, 20, -0.1, 1, 0.25, 20, {}, {}};
        c.ring.data = {84, 2, 20, 0.0, 1, 0.25, 20, {}, {}};
      },
      [](Stage&, Catalogue& c) {
        c.sun.data = {31, 2, 20, 0.3, 1, 0.25, 20, {}, {}};
        c.planet.data = {22, 2, 20, 0.4, 1, 0.25, 20, {}, {}};
        c.ring.data = {77, 2, 20, 1.0, 1, 0.25, 20, {}, {}};
      },
  };
  for (std::size_t k = 0; k < sets.size(); ++k) {
    const GearSet g = make_gear_set(changed(sets[k]));
    EXPECT_NEAR(std::remainder(g.ring_mesh_lead - placed_lead(g), 1.0), 0.0, rounding_periods) << k;
    EXPECT_GE(g.ring_mesh_lead, 0.0);
    EXPECT_LT(g.ring_mesh_lead, 1.0);
  }
  constexpr double fourth_digit = 0.5e-4;  // half a unit of it
  EXPECT_NEAR(placed_lead(make_gear_set(as_it_is())), 0.3023, fourth_digit);
}

TEST(GearSet, PlanetsOfTable1AreInPhase) {
  // 27 / 3 and 81 / 3 are whole.
  const GearSet g = make_gear_set(as_it_is());
  const auto phases = planet_phases(g);
  ASSERT_EQ(phases.size(), 3U);
  for (const PlanetPhases& p : phases) {
    EXPECT_EQ(p.sun_planet, 0.0);
    EXPECT_NEAR(p.ring_planet, g.ring_mesh_lead, rounding_periods);
  }
}

TEST(GearSet, PhasesFollowTheTeethThatPassAPlanet) {
  // A sun's tooth that is at planet 1 at s = 0 comes to a planet at phi after phi z_s / 2 pi periods, a ring's tooth,
  // turning the other way, has been there as long ago.
  const GearSet g = make_gear_set(changed([](Stage& s, Catalogue&) { s.angles_deg = {0.0, 110.0, 250.0}; }));
  const auto phases = planet_phases(g);
  for (std::size_t i = 0; i < 3; ++i) {
    const double phi = g.angles_deg[i] * degree;
    const double until_next = std::remainder(phases[i].sun_planet + phi * 27.0 / (2.0 * pi), 1.0);
    EXPECT_NEAR(until_next, 0.0, rounding_periods) << i;
    EXPECT_NEAR(std::remainder(phases[i].ring_planet - g.ring_mesh_lead - phi * 81.0 / (2.0 * pi), 1.0), 0.0,
                rounding_periods)
        << i;
    // The teeth must fit both: (z_s + z_r) phi / 2 pi is whole, so the ring leads every sun mesh alike.
    EXPECT_NEAR(std::remainder(phases[i].ring_planet - phases[i].sun_planet - g.ring_mesh_lead, 1.0), 0.0,
                rounding_periods)
        << i;
  }
}

TEST(GearSet, PhasesDoNotDependOnWhereThePlanetsAreCountedFrom) {
  const auto phases = [](std::vector<double> angles) {
    return planet_phases(make_gear_set(changed([&](Stage& s, Catalogue&) { s.angles_deg = std::move(angles); })));
  };
  const auto a = phases({0.0, 110.0, 250.0});
  const auto b = phases({37.0, 147.0, 287.0});
  const auto c = phases({0.0, 110.0, 250.0 - 360.0});
  for (std::size_t i = 0; i < 3; ++i)
    for (const auto* other : {&b, &c}) {
      EXPECT_NEAR(std::remainder(a[i].sun_planet - (*other)[i].sun_planet, 1.0), 0.0, rounding_periods) << i;
      EXPECT_NEAR(std::remainder(a[i].ring_planet - (*other)[i].ring_planet, 1.0), 0.0, rounding_periods) << i;
    }
}

TEST(GearSet, PlanetGapIsThatOfTheNearestNeighbours) {
  const GearSet three = make_gear_set(as_it_is());
  const double side = three.centre_distance_mm * std::sqrt(3.0);
  EXPECT_NEAR(planet_gap_mm(three), side - 2.0 * three.planet.tip_radius_mm, rounding_mm);
  // Over the end of the circle, too: 350 and 20 deg are 30 deg apart.
  GearSet close = three;
  close.angles_deg = {20.0, 120.0, 350.0};
  const double chord = 2.0 * close.centre_distance_mm * std::sin(15.0 * degree);
  EXPECT_NEAR(planet_gap_mm(close), chord - 2.0 * three.planet.tip_radius_mm, rounding_mm);
}

TEST(GearSet, StiffnessCurveIsTheMeshesOwnOnBothSidesOfItsJumps) {
  const GearSet g = make_gear_set(as_it_is());
  for (const MeshedPair& mesh : {g.sun_planet, g.ring_planet, problems::tall_pair()}) {
    const StiffnessCurve c = stiffness_curve(mesh);
    ASSERT_EQ(c.phase.size(), c.stiffness_N_per_m.size());
    EXPECT_EQ(c.breakpoints, mesh.breakpoints());
    for (std::size_t k = 0; k < c.phase.size(); ++k) {
      const bool left = k == 0 || (k + 1 < c.phase.size() && c.phase[k + 1] == c.phase[k]);
      const double phase = k == 0 ? 1.0 : c.phase[k];
      EXPECT_EQ(c.stiffness_N_per_m[k], mesh.stiffness(phase, phase + (left ? -1e-3 : 1e-3))) << k;
    }
    Stage s = problems::tang2020();
    s.sun_planet_mesh.stiffness_curve = c;
    s.sun_planet_mesh.stiffness_N_per_m = fourier_series(mesh, 1).mean;
    s.sun_planet_mesh.stiffness_cos_N_per_m.clear();
    s.sun_planet_mesh.stiffness_sin_N_per_m.clear();
    EXPECT_EQ(joined(problems_for_dynamics(s)), "");
  }
}

TEST(GearSet, FrictionOfAMeshPassesTheRulesOfAStage) {
  const GearSet g = make_gear_set(as_it_is());
  Stage s = problems::tang2020();
  s.sun_planet_mesh.friction = {};
  s.ring_planet_mesh.friction = {};
  s.sun_planet_mesh.friction.ehl = ehl_of(g.sun_planet, *g.catalogue.lubrication);
  s.ring_planet_mesh.friction.ehl = ehl_of(g.ring_planet, *g.catalogue.lubrication);
  EXPECT_EQ(joined(problems_for_dynamics(s)), "");
  EXPECT_EQ(s.sun_planet_mesh.friction.ehl->width_mm, 60.0);
  // E' of Eq. (8): 206 / (1 - 0.09).
  constexpr double rounding_GPa = 1e-12;  // of a few operations on some 200
  EXPECT_NEAR(s.sun_planet_mesh.friction.ehl->equivalent_modulus_GPa, 206.0 / 0.91, rounding_GPa);
}

TEST(GearSet, NarrowerMemberDecidesTheContactWidth) {
  const GearSet g = make_gear_set(changed([](Stage&, Catalogue& c) { c.planet.data.width_mm = 55.0; }));
  EXPECT_EQ(ehl_of(g.sun_planet, {}).width_mm, 55.0);
  EXPECT_EQ(ehl_of(g.ring_planet, {}).width_mm, 55.0);
}

TEST(GearSet, WithoutCatalogueThereIsNone) {
  Stage s = problems::tang2020();
  EXPECT_THROW((void)make_gear_set(s), DomainError);
}

}  // namespace
}  // namespace epicyclic::gear::gear_set_test
