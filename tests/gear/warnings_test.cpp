#include "gear/warnings.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lines.hpp"
#include "problems/r1.hpp"
#include "problems/table1.hpp"

namespace epicyclic::gear::warnings_test {
namespace {

using test::has_line;
using test::joined;

Stage changed(const std::function<void(Stage&, Catalogue&)>& change) {
  Stage s = problems::table1();
  s.catalogue->stiffness.harmonics = 0;
  change(s, *s.catalogue);
  return s;
}

Stage as_it_is() {
  return changed([](Stage&, Catalogue&) {});
}

std::vector<std::string> lines_of(std::vector<Warning> warnings) {
  put_in_order(warnings);
  std::vector<std::string> lines;
  for (const Warning& w : warnings) lines.push_back(w.text());
  return lines;
}

std::vector<std::string> drawn(const GearSet& set) { return lines_of(catalogue_warnings(set)); }

struct Rule {
  const char* pointer;
  const char* words;
  std::function<void(Stage&, Catalogue&)> break_it;
};

TEST(Warnings, Table1IsWarnedOfItsReplacedModuleOnly) {
  const auto lines = drawn(make_gear_set(as_it_is()));
  EXPECT_EQ(lines.size(), 1U) << joined(lines);
  EXPECT_TRUE(has_line(lines, "/catalogue/ring/module_mm", "2.57627 mm is used")) << joined(lines);
  EXPECT_TRUE(has_line(lines, "/catalogue/ring/module_mm", "differ by 18.2")) << joined(lines);
}

TEST(Warnings, EachOneOnDrawingsIsToldAtItsPlace) {
  const std::vector<Rule> rules = {
      {"/catalogue/planet", "tip thickness 0.2",
       [](Stage&, Catalogue& c) {
         c.tips = Tips::full;
         c.planet.data.addendum_coefficient = 1.03;
       }},
      {"/catalogue/sun", "undercut: the profile shift 0.2 is below 0.298",
       [](Stage&, Catalogue& c) {
         c.sun.data = {12, 2, 20, 0.2, 1, 0.25, 20, {}, {}};
         c.planet.data = {18, 2, 20, -0.2, 0.9, 0.25, 20, {}, {}};
         c.ring.data = {48, 2, 20, -0.2, 0.8, 0.25, 20, {}, {}};
         c.ring.base_pitch = BasePitch::as_given;
         c.planet.bore_mm = 10;
         c.sun.bore_mm = 5;
       }},
      {"/planets/count", "leave a gap of",
       [](Stage& s, Catalogue& c) {
         s.planet_count = 6;
         c.planet.data.tip_diameter_mm = 71.0;
       }},
      {"/catalogue/sun", "tip clearance of",
       [](Stage&, Catalogue& c) {
         c.tips = Tips::full;
         c.planet.data.clearance_coefficient = 0.2;
       }},
      {"/catalogue/ring", "overlap by", [](Stage&, Catalogue& c) { c.ring.data.profile_shift = 0.998; }},
      {"/catalogue/planet", "the bore leaves a rim of 1.6", [](Stage&, Catalogue& c) { c.planet.bore_mm = 60; }},
      {"/catalogue/ring/outer_diameter_mm", "leaves a rim of 4.8",
       [](Stage&, Catalogue& c) { c.ring.outer_diameter_mm = 230; }},
      {"/catalogue/sun", "Sainsot's body compliance", [](Stage&, Catalogue& c) { c.sun.body_radius_ratio = 7.1; }},
      {"/catalogue/sun", "Sainsot's body compliance", [](Stage&, Catalogue& c) { c.sun.body_radius_ratio = 1.2; }},
      {"/catalogue/sun/width_mm", "2 times that of the other gear of the sun-planet mesh, 60 mm",
       [](Stage&, Catalogue& c) { c.sun.data.width_mm = 120; }},
      {"/catalogue/planet/width_mm", "of the ring-planet mesh, 30 mm",
       [](Stage&, Catalogue& c) { c.ring.data.width_mm = 30; }},
      {"/catalogue/material/density_kg_per_m3", "is 7.85 kg/m^3",
       [](Stage&, Catalogue& c) { c.material.density_kg_per_m3 = 7.85; }},
      {"/catalogue/carrier/body/outer_diameter_mm", "the pins' axes lie outside",
       [](Stage&, Catalogue& c) { c.carrier.body = {2, 20, 100, 0, 30, 80}; }},
      {"/catalogue/carrier/body/inner_diameter_mm", "the pins' axes lie inside",
       [](Stage&, Catalogue& c) { c.carrier.body = {2, 20, 190, 150, 30, 80}; }},
      {"/catalogue/carrier/body/pin_diameter_mm", "more than the planets' bore of 44 mm",
       [](Stage&, Catalogue& c) {
         c.planet.bore_mm = 44;
         c.carrier.body = {2, 20, 190, 0, 45, 80};
       }},
      {"/catalogue/carrier/body/pin_length_mm", "less than the planets' face width of 60 mm",
       [](Stage&, Catalogue& c) { c.carrier.body = {2, 20, 190, 0, 30, 0.084}; }},
      {"/catalogue/carrier/body/plate_thickness_mm", "is 0.018 mm beside planets of 60 mm",
       [](Stage&, Catalogue& c) { c.carrier.body = {2, 0.018, 190, 0, 30, 80}; }},
  };
  for (const Rule& rule : rules) {
    const auto lines = drawn(make_gear_set(changed(rule.break_it)));
    EXPECT_TRUE(has_line(lines, rule.pointer, rule.words)) << rule.pointer << ": " << rule.words << "\nnot among:\n"
                                                           << joined(lines);
  }
}

TEST(Warnings, ACarrierThatHoldsItsPlanetsIsNotWarnedOf) {
  for (const CarrierBody& body : {CarrierBody{2, 20, 190, 0, 30, 80}, CarrierBody{1, 2, 144, 140, 44, 60}}) {
    const GearSet set = make_gear_set(changed([&](Stage&, Catalogue& c) {
      c.planet.bore_mm = 44;
      c.carrier.body = body;
      c.sun.data.width_mm = 66;
    }));
    for (const std::string& line : drawn(set)) {
      EXPECT_EQ(line.find("/carrier"), std::string::npos) << line;
      EXPECT_EQ(line.find("width_mm"), std::string::npos) << line;
    }
  }
}

TEST(Warnings, ContactBelowTheRackCutInvoluteIsAWarning) {
  const GearSet usual = make_gear_set(as_it_is());
  GearSet deep = usual;
  deep.sun_planet.pair.start_mm =
      0.9 * std::sqrt(std::pow(usual.sun.form_radius_mm(), 2) - std::pow(usual.sun.base_radius_mm, 2));
  EXPECT_TRUE(has_line(drawn(deep), "/catalogue/sun", "below the end of the rack-cut involute"));
  // Standard gears without shift: the planet's flank ends before the ring's tips do, and the path counts it.
  const auto standard = drawn(make_gear_set(changed([](Stage&, Catalogue& c) {
    c.sun.data = {24, 2, 20, 0, 1, 0.25, 25, {}, {}};
    c.planet.data = {30, 2, 20, 0, 1, 0.25, 25, {}, {}};
    c.ring.data = {84, 2, 20, 0, 1, 0.25, 25, {}, {}};
    c.sun.bore_mm = c.planet.bore_mm = 10;
  })));
  EXPECT_TRUE(has_line(standard, "/catalogue/planet", "it is counted: contact ratio 1.93057, without it 1.81716"))
      << joined(standard);
}

/// 21, 28 and 78 teeth of module 3 without shift: 21 + 2 x 28 = 77.
Stage one_tooth_too_many(std::optional<double> centre_distance_mm) {
  return changed([&](Stage& s, Catalogue& c) {
    s.centre_distance_mm = centre_distance_mm;
    c.sun.data = {21, 3, 20, 0, 1, 0.25, 30, {}, {}};
    c.planet.data = {28, 3, 20, 0, 1, 0.25, 30, {}, {}};
    c.ring.data = {78, 3, 20, 0, 1, 0.25, 30, {}, {}};
    c.ring.base_pitch = BasePitch::as_given;
    c.ring.outer_diameter_mm = 270;
  });
}

TEST(Warnings, ToothNumbersThatDoNotFitLeaveWideMeshes) {
  const auto by_sun = drawn(make_gear_set(one_tooth_too_many(std::nullopt)));
  EXPECT_TRUE(has_line(by_sun, "/catalogue/ring", "mm of backlash on its line of action")) << joined(by_sun);
  EXPECT_TRUE(has_line(by_sun, "/catalogue/ring", "z_s + 2 z_p = 77 is not z_r = 78")) << joined(by_sun);
  EXPECT_TRUE(has_line(by_sun, "/catalogue/planet", "tip clearance of 2.25 mm in the ring-planet mesh, 0.75 modules"))
      << joined(by_sun);
  const auto by_ring = drawn(make_gear_set(one_tooth_too_many(75.0)));
  EXPECT_TRUE(has_line(by_ring, "/catalogue/planet", "mm of backlash on its line of action")) << joined(by_ring);
  EXPECT_TRUE(has_line(by_ring, "/catalogue/sun", "tip clearance of 2.25 mm in the sun-planet mesh"))
      << joined(by_ring);
  // With 77 teeth nothing is to be said of either.
  Stage fits = one_tooth_too_many(std::nullopt);
  fits.catalogue->ring.data.teeth = 77;
  for (const std::string& line : drawn(make_gear_set(fits))) {
    EXPECT_EQ(line.find("backlash"), std::string::npos) << line;
    EXPECT_EQ(line.find("tip clearance"), std::string::npos) << line;
  }
}

TEST(Warnings, GivenValuesAreHeldAgainstTheDrawings) {
  const GearSet set = make_gear_set(changed([](Stage&, Catalogue& c) { c.stiffness.harmonics = 2; }));
  const auto lines = [&](const std::function<void(Stage&)>& change) {
    Stage s = as_it_is();
    // As the drawings have them.
    s.sun_planet_mesh.stiffness_N_per_m = set.sun_planet_stiffness.mean;
    s.ring_planet_mesh.stiffness_N_per_m = set.ring_planet_stiffness.mean;
    change(s);
    return lines_of(catalogue_warnings(set, s));
  };
  EXPECT_EQ(lines([](Stage&) {}).size(), 1U) << joined(lines([](Stage&) {}));
  EXPECT_TRUE(has_line(lines([](Stage& s) { s.sun.mass_kg = 6.0; }), "/lumped/sun/mass_kg", "is 6 kg, 3.6"));
  EXPECT_TRUE(has_line(lines([](Stage& s) { s.carrier.mass_kg = 24.0; }), "/lumped/carrier/mass_kg", "times the 7.5"));
  EXPECT_TRUE(has_line(lines([](Stage& s) { s.sun.mass_kg = 0.5; }), "/lumped/sun/mass_kg", "is 0.5 kg, 0.3"));
  EXPECT_FALSE(has_line(lines([](Stage& s) { s.sun.mass_kg = 0.6; }), "/lumped/sun/mass_kg", "is 0.6 kg"));
  EXPECT_TRUE(
      has_line(lines([](Stage& s) { s.planet.inertia_over_r2_kg = 3.2; }), "/lumped/planet/inertia_over_r2_kg", "3.2"));
  // 1.7 times by a factor, 0.58 by the bodies that a bore of 0 stood for.
  EXPECT_TRUE(has_line(lines([](Stage& s) { s.sun_planet_mesh.stiffness_N_per_m *= 1.5; }),
                       "/lumped/sun_planet_mesh/stiffness_N_per_m", "times c_gamma b of ISO 6336-1:2006, 9.3"));
  EXPECT_TRUE(has_line(lines([](Stage& s) { s.ring_planet_mesh.stiffness_N_per_m *= 0.5; }),
                       "/lumped/ring_planet_mesh/stiffness_N_per_m", "times c_gamma b"));
  // Harmonics of another mean: told where they are the computed ones, and not where they are given, too.
  const auto softer = [&](double times, double harmonics) {
    return lines([&](Stage& s) {
      Mesh& mesh = s.sun_planet_mesh;
      mesh.stiffness_N_per_m *= times;
      mesh.stiffness_cos_N_per_m = set.sun_planet_stiffness.cosine;
      mesh.stiffness_sin_N_per_m = set.sun_planet_stiffness.sine;
      for (double& a : mesh.stiffness_cos_N_per_m) a *= harmonics;
    });
  };
  const std::string words = "relative to the mean they are 1.25 times as large";
  EXPECT_TRUE(has_line(softer(0.8, 1.0), "/lumped/sun_planet_mesh/stiffness_N_per_m", words))
      << joined(softer(0.8, 1.0));
  EXPECT_FALSE(has_line(softer(0.8, 0.8), "/lumped/sun_planet_mesh/stiffness_N_per_m", "harmonics"));
  EXPECT_FALSE(has_line(softer(0.995, 1.0), "/lumped/sun_planet_mesh/stiffness_N_per_m", "harmonics"));
}

TEST(Warnings, EachOneOnTheMotionIsToldAtItsPlace) {
  const Stage usual = problems::with_gap(problems::r1());
  EXPECT_EQ(joined(lines_of(warnings_for_dynamics(usual))), "");
  const struct {
    const char* pointer;
    const char* words;
    std::function<void(Stage&)> break_it;
  } rules[] = {
      {"/planets/count", "cannot be assembled", [](Stage& s) { s.planet_count = 5; }},
      {"/lumped/sun", "without damping", [](Stage& s) { s.sun.damping = {}; }},
      {"/lumped/ring", "damped 1.5 times critically", [](Stage& s) { s.ring.damping.ratio = 1.5; }},
      {"/lumped/planet", "times critically",
       [](Stage& s) {
         s.planet.damping = {std::nullopt, 1e6};
       }},
      {"/lumped/sun_planet_mesh/damping_ratio", "is 1, at or above critical",
       [](Stage& s) { s.sun_planet_mesh.damping_ratio = 1.0; }},
      {"/lumped/ring_planet_mesh/backlash_half_um", "has 1.2 mm of backlash",
       [](Stage& s) { s.ring_planet_mesh.backlash_half_um = 600.0; }},
      {"/lumped/sun/bearing_clearance_half_um", "modules: the sun may move out",
       [](Stage& s) { s.sun_bearing.clearance_half_um = 1500.0; }},
      {"/lumped/sun_planet_mesh/damping_ratio", "is 0: oscillations may never decay",
       [](Stage& s) { s.sun_planet_mesh.damping_ratio = 0.0; }},
      {"/lumped/sun_planet_mesh/backlash_half_um", "has 0.124 um of backlash",
       [](Stage& s) { s.sun_planet_mesh.backlash_half_um = 0.062; }},
      {"/lumped/sun_planet_mesh/error_amplitude_um",
       "the total pitch deviation of the coarsest grade of ISO 1328 is 214 um",
       [](Stage& s) {
         s.sun_planet_mesh.error_amplitude_um = {8.5, 850.0, 8.5};
       }},
      {"/lumped/sun/support_N_per_m", "which its own weight moves by", [](Stage& s) { s.sun.support_N_per_m = 0.02; }},
      {"/lumped/ring_planet_mesh/friction", "sun-planet a coefficient of friction, ring-planet none",
       [](Stage& s) {
         s.sun_planet_mesh.friction = {};
         s.ring_planet_mesh.friction = {};
         s.sun_planet_mesh.friction.coefficient = CoulombFriction{.coefficient = 0.05, .path_start_mm = {}};
       }},
  };
  for (const auto& rule : rules) {
    Stage s = usual;
    rule.break_it(s);
    const auto lines = lines_of(warnings_for_dynamics(s));
    EXPECT_TRUE(has_line(lines, rule.pointer, rule.words)) << rule.pointer << ": " << rule.words << "\nnot among:\n"
                                                           << joined(lines);
  }
}

TEST(Warnings, AnInertiaIsHeldAgainstTheMass) {
  const auto lines = [](double times) {
    Stage s = problems::r1();
    s.planet.inertia_over_r2_kg = times * s.planet.mass_kg;
    return lines_of(mass_warnings(s));
  };
  // A disc has half, a ring all of it; a rotor that is counted in may have more.
  for (const double usual : {0.11, 0.5, 1.0, 3.9}) EXPECT_EQ(joined(lines(usual)), "") << usual;
  EXPECT_TRUE(has_line(lines(0.034), "/lumped/planet/inertia_over_r2_kg", "0.034 of it; a solid disc has about half"))
      << joined(lines(0.034));
  EXPECT_TRUE(has_line(lines(11.6), "/lumped/planet/inertia_over_r2_kg", "a radius of gyration of 3.4"));
}

/// 20, 25 and 70 teeth of module 3 whose meshes fit with x_r = -0.117.
GearSet with_ring_shift(double shift) {
  return make_gear_set(changed([&](Stage&, Catalogue& c) {
    c.sun.data = {20, 3, 20, 0.1, 1, 0.25, 30, {}, {}};
    c.planet.data = {25, 3, 20, -0.1085, 1, 0.25, 30, {}, {}};
    c.ring.data = {70, 3, 20, shift, 1, 0.25, 30, {}, {}};
    c.ring.base_pitch = BasePitch::as_given;
    c.ring.outer_diameter_mm = 250;
  }));
}

TEST(Warnings, ARingShiftOfTheOtherSignConventionIsNamed) {
  EXPECT_TRUE(ring_shift_has_other_sign(with_ring_shift(0.117)));
  EXPECT_TRUE(has_line(drawn(with_ring_shift(0.117)), "/catalogue/ring/profile_shift",
                       "with profile_shift = -0.117 both meshes fit"))
      << joined(drawn(with_ring_shift(0.117)));
  // As it should be, with room for backlash, and where neither sign fits.
  for (const double shift : {-0.117, -0.07, 0.0, 0.3}) {
    EXPECT_FALSE(ring_shift_has_other_sign(with_ring_shift(shift))) << shift;
    EXPECT_FALSE(has_line(drawn(with_ring_shift(shift)), "/catalogue/ring/profile_shift", "")) << shift;
  }
}

TEST(Warnings, HarmonicsThatLoseOfTheStiffnessAreNamedWithWhatTheyLose) {
  const auto lines = [](int harmonics, bool given = false) {
    Stage s = changed([&](Stage&, Catalogue& c) { c.stiffness.harmonics = harmonics; });
    const GearSet set = make_gear_set(s);
    s.sun_planet_mesh.stiffness_cos_N_per_m = set.sun_planet_stiffness.cosine;
    s.sun_planet_mesh.stiffness_sin_N_per_m = set.sun_planet_stiffness.sine;
    if (given) s.sun_planet_mesh.stiffness_sin_N_per_m[0] *= 1.01;
    return lines_of(truncation_warnings(set, s));
  };
  // Peak to peak of the series by its own samples, of the curve between one pair and two: 1.82 and 0.998 10^9 N/m.
  ASSERT_EQ(lines(2).size(), 1U);
  EXPECT_TRUE(
      has_line(lines(2), "/catalogue/mesh_stiffness/form", "2 harmonics of the stiffness of the sun-planet mesh"));
  EXPECT_TRUE(has_line(lines(1), "/catalogue/mesh_stiffness/form", "1 harmonics"));
  EXPECT_TRUE(lines(2, true).empty());  // of the user's own
}

TEST(Warnings, ASeriesLosesWhatItsPeakToPeakLacks) {
  // Of A cos + B sin the variation is 2 sqrt(A^2 + B^2).
  const StiffnessRange one = stiffness_range(FourierSeries{10.0, {3.0}, {4.0}});
  constexpr double of_samples = 1e-2;  // 128 a period: 1 - cos(pi / 128) at most
  EXPECT_NEAR(one.greatest - one.least, 10.0, of_samples);
  EXPECT_NEAR(one.greatest, 15.0, of_samples);
}

TEST(Warnings, AStageForModesAloneIsLookedAtAsFarAsItGoes) {
  Stage s = problems::r1();
  s.sun.teeth.reset();
  s.planet.teeth.reset();
  s.planet.base_radius_mm.reset();
  s.centre_distance_mm.reset();
  s.sun.damping = {};
  EXPECT_EQ(lines_of(warnings_for_dynamics(s)).size(), 1U);
  EXPECT_TRUE(warnings_at(s, 1e4).empty());
}

TEST(Warnings, EachOneOnAnOperatingPointIsToldAtItsPlace) {
  constexpr double omega_sn = 47915.0;
  const GearSet set = make_gear_set(as_it_is());
  const auto at = [&](double omega, const std::function<void(Stage&)>& change) {
    Stage s = problems::r1();
    change(s);
    return lines_of(warnings_at(s, omega * omega_sn, &set));
  };
  for (const double omega : {0.2, 1.0, 3.5}) EXPECT_EQ(joined(at(omega, [](Stage&) {})), "") << omega;
  // rho v^2 of the sun's base circle is 1000 MPa at 357 m/s, Omega = 4.7.
  EXPECT_EQ(joined(at(4.6, [](Stage&) {})), "");
  EXPECT_TRUE(has_line(at(4.8, [](Stage&) {}), "/lumped/sun", "MPa of hoop stress"));
  // The pressure goes with the root of the load: 0.52 GPa with 845 N m of Omega = 0.2 ... 2.64 GPa with some 5 times
  // that of 1.2 GPa.
  const auto load = [&](double torque) {
    return at(1.0, [&](Stage& s) {
      s.load.power_kW.reset();
      s.load.torque_Nm = torque;
    });
  };
  EXPECT_EQ(joined(load(845.0)), "");
  EXPECT_TRUE(has_line(load(3e4), "/load", "presses its flanks with")) << joined(load(3e4));
  EXPECT_TRUE(has_line(load(0.5), "/load", "next to no load")) << joined(load(0.5));
  EXPECT_TRUE(has_line(load(1e6), "/lumped/sun_planet_mesh/stiffness_N_per_m", "modules, under the static load"));
  const auto weak = at(1.0, [](Stage& s) { s.planet.bearing_N_per_m = 1e5; });
  EXPECT_TRUE(has_line(weak, "/lumped/planet/bearing_N_per_m", "yields by 3")) << joined(weak);
  const auto none = at(1.0, [](Stage& s) { s.planet.bearing_N_per_m = 5e-324; });
  EXPECT_TRUE(has_line(none, "/lumped/planet/bearing_N_per_m", "holds nothing")) << joined(none);
  const auto loose = at(1.0, [](Stage& s) { s.ring.torsional_support_N_per_m = 1e6; });
  EXPECT_TRUE(has_line(loose, "/lumped/ring/torsional_support_N_per_m", "yields by 5")) << joined(loose);
}

TEST(Warnings, TheMostImportantOnesComeFirstAndOnce) {
  std::vector<Warning> all = {{Rank::note, 9, "/a", "a", "note"},
                              {Rank::doubtful, 2, "/b", "b", "twice"},
                              {Rank::doubtful, 3, "/b", "b", "three times"},
                              {Rank::doubtful, 5, "/d", "d", "five times"},
                              {Rank::impossible, 1, "/c", "c", "impossible"}};
  put_in_order(all);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].message, "impossible");
  EXPECT_EQ(all[1].message, "five times");
  EXPECT_EQ(all[2].message, "three times");
  EXPECT_EQ(all[3].message, "note");
}

}  // namespace
}  // namespace epicyclic::gear::warnings_test
