// The gears of Table 1 of Tang et al. 2020 as a catalogue, completed as in docs/theory/parameters.md, sections 1 to 3.
// Numbers are written here once more, apart from inputs/, so that neither can drift unseen.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "gear/catalogue.hpp"
#include "gear/friction_path.hpp"
#include "gear/mesh_stiffness.hpp"
#include "gear/pair.hpp"
#include "gear/stage.hpp"
#include "problems/r1.hpp"

namespace epicyclic::problems {

inline constexpr double degree = std::numbers::pi / 180.0;

/// Teeth, module, pressure angle, shift, addendum, clearance, width.
inline gear::GearData table1_sun() { return {27, 2.63, 25, 0.623, 1, 0.25, 60, {}, {}}; }
inline gear::GearData table1_planet() { return {25, 2.63, 25, 0.775, 1, 0.25, 60, {}, {}}; }
/// As printed: its base pitch is 0.24 % off the planet's.
inline gear::GearData table1_ring() { return {81, 2.57, 22.3, 1, 1, 0.25, 60, {}, {}}; }

inline gear::Catalogue table1_catalogue() {
  gear::Catalogue c;
  c.sun = {table1_sun(), 6, 30, 2.0, {}};
  c.planet = {table1_planet(), 6, 44, 1.437534090909091, {}};
  c.sun_bearing = gear::SupportBearing{"6213", 10};
  c.ring = {table1_ring(), 6, 240, gear::BasePitch::of_planet, {}};
  c.carrier.body = gear::CarrierBody{2, 15, 194, 70, 30, 90};
  c.carrier.bearing = gear::SupportBearing{"6020", 10};
  c.carrier.shaft = gear::OutputShaft{60, 0, 150};
  c.lubrication = gear::Lubrication{5, 0.6};
  return c;
}

/// The stage of Table 1 with its catalogue and a fixed ring; the centre distance is left to the gears.
inline gear::Stage table1() {
  gear::Stage s = tang2020();
  s.name = "table1";
  s.boundary = gear::Boundary::fixed_ring;
  s.centre_distance_mm.reset();
  s.catalogue = table1_catalogue();
  return s;
}

/// The line of action of a pair, for the friction of its path.
inline gear::LineOfAction line_of(const gear::Pair& p) {
  return {p.driving.base_radius_mm, p.driven.base_radius_mm, p.theoretical_length_mm,
          p.pitch_arm_mm,           p.base_pitch_mm,         p.internal()};
}

/// A pair of external gears at its reference centre distance, Sainsot's h_f = 2 for both.
inline gear::MeshedPair standard_pair(gear::GearData first, int teeth_2, const gear::Material& material) {
  gear::GearData second = first;
  second.teeth = teeth_2;
  const gear::Tooth t_1 = gear::external_tooth(first);
  const gear::Tooth t_2 = gear::external_tooth(second);
  const double distance = 0.5 * first.module_mm * (first.teeth + teeth_2);
  return {gear::make_pair(t_1, t_2, distance), {t_1, material, 2.0, {}}, {t_2, material, 2.0, {}}, {}, 1.0};
}

/// 19 and 48 teeth: the gears of Tian 2004 and Wu et al. 2008.
inline gear::MeshedPair tian_pair() {
  return standard_pair({19, 3.175, 20, 0, 1, 0.25, 16, {}, {}}, 48, {206.8, 0.3, 7850});
}
/// 20 and 20 teeth: the gears of Yi et al. 2019.
inline gear::MeshedPair yi_pair() { return standard_pair({20, 10, 20, 0, 1, 0.25, 30, {}, {}}, 20, {200, 0.3, 7850}); }
/// Tall teeth with a contact ratio above 2.
inline gear::MeshedPair tall_pair() {
  return standard_pair({45, 2, 20, 0, 1.3, 0.25, 20, {}, {}}, 60, {206, 0.3, 7850});
}

}  // namespace epicyclic::problems
