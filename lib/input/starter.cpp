#include "input/starter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "core/errors.hpp"
#include "core/text.hpp"
#include "gear/bearing.hpp"
#include "gear/stage.hpp"

namespace epicyclic::input {

using nlohmann::ordered_json;

namespace {

constexpr double addendum = 1.0;    // in modules
constexpr double clearance = 0.25;  // in modules

/// To three digits, as it is typed: 0.3, not 0.30000000000000004.
double neat(double x) {
  constexpr int digits = 3;
  return std::strtod(short_text(x, digits).c_str(), nullptr);  // unlike std::stod it has numbers near 0, and infinity
}

/// Of a gear's root circle.
double root_mm(const Drawing& d, int teeth, double shift) {
  return d.module_mm * (teeth - 2.0 * (addendum + clearance - shift));
}

/// Planets at the angles of the drawing, at which their teeth have to fit both meshes.
void check_assembly(const Drawing& d) {
  gear::Stage stage;
  stage.sun.teeth = d.sun_teeth;
  stage.ring.teeth = d.ring();
  stage.angles_deg = d.angles_deg;
  if (d.angles_deg.empty() || gear::assembly_misfits(stage).empty()) return;
  constexpr int digits = 9;
  std::string given, nearest;
  for (const double angle : d.angles_deg) {
    given += (given.empty() ? "" : ",") + short_text(angle, digits);
    const double at = gear::assembly_angle_deg(d.sun_teeth + d.ring(), d.angles_deg[0], angle);
    nearest += (nearest.empty() ? "" : ",") + short_text(at, digits);
  }
  throw InputError(fmt::format(
      "init: planets at {} degrees cannot be assembled: with {} + {} teeth of sun and ring they stand in steps of "
      "360 / {} degrees from the first one; the nearest such angles are {}",
      given, d.sun_teeth, d.ring(), d.sun_teeth + d.ring(), nearest));
}

void check(const Drawing& d) {
  const auto refuse = [](const std::string& what) { throw InputError("init: " + what); };
  for (const int z : {d.sun_teeth, d.planet_teeth, d.pair ? d.sun_teeth : d.ring()})
    if (z < 5 || z > 1000) refuse(fmt::format("{} teeth are none of a gear; from 5 to 1000", z));
  if (!d.pair) {
    if (!d.angles_deg.empty() && d.angles_deg.size() != static_cast<std::size_t>(d.planets))
      refuse(fmt::format("{} angles of {} planets", d.angles_deg.size(), d.planets));
    if (d.planets < gear::planets_min || d.planets > gear::planets_max)
      refuse(fmt::format("{} planets; from {} to {}", d.planets, gear::planets_min, gear::planets_max));
    check_assembly(d);
  }
  const auto positive = [&](const char* what, double x, double most) {
    if (!(x > 0.0 && x <= most)) refuse(fmt::format("{} of {}; must be above 0, at most {}", what, x, most));
  };
  positive("a module", d.module_mm, 100);
  positive("a width", d.width_mm, 2000);
  if (d.torque_Nm) positive("a torque", *d.torque_Nm, 1e8);
  if (d.speed_rpm) positive("a speed", *d.speed_rpm, 1e6);
  for (const double shift : d.profile_shift)
    if (!(std::abs(shift) <= 2.0)) refuse(fmt::format("a profile shift of {}; from -2 to 2", shift));
  if (!(d.pressure_angle_deg >= 10 && d.pressure_angle_deg <= 35))
    refuse(fmt::format("a pressure angle of {}; from 10 to 35 degrees", d.pressure_angle_deg));
}

/// r_b of the sun.
double sun_base_radius_mm(const Drawing& d) {
  return 0.5 * d.module_mm * d.sun_teeth * std::cos(d.pressure_angle_deg * std::numbers::pi / 180.0);
}

/// Radial clearance of deep groove ball bearings up to a bore [um].
struct RadialClearance {
  double bore_mm;
  double least, greatest;
};

/// Group N of ISO 5753-1; larger bores have that of the largest one.
RadialClearance radial_clearance(double bore_mm) {
  constexpr std::array<RadialClearance, 13> rows = {{{10, 2, 13},
                                                     {18, 3, 18},
                                                     {30, 5, 20},
                                                     {40, 6, 20},
                                                     {50, 6, 23},
                                                     {65, 8, 28},
                                                     {80, 10, 30},
                                                     {100, 12, 36},
                                                     {120, 15, 41},
                                                     {140, 18, 48},
                                                     {160, 18, 53},
                                                     {180, 20, 61},
                                                     {200, 25, 71}}};
  const auto* row = std::ranges::find_if(rows, [&](const RadialClearance& r) { return bore_mm <= r.bore_mm; });
  return row == rows.end() ? rows.back() : *row;
}

/// A value with the range that machines have, both as parts and times of it, and the reason; the origin's form is that
/// of input/estimates.hpp.
struct Estimate {
  double value;
  std::string origin;
};
Estimate estimate(double value, double least, double most, const std::string& reason) {
  constexpr int digits = 2;
  return {neat(value), fmt::format("estimate: {} to {}, {}", short_text(least * value, digits),
                                   short_text(most * value, digits), reason)};
}

ordered_json gear_of(const Drawing& d, int teeth, double shift) {
  return {{"teeth", teeth},         {"module_mm", d.module_mm}, {"pressure_angle_deg", d.pressure_angle_deg},
          {"profile_shift", shift}, {"width_mm", d.width_mm},   {"accuracy_grade", 6}};
}

std::string origin_of(const Drawing& d, const std::string& key) {
  return d.assumed.contains(key) ? "choice: not given; replace it by what the drawing has" : "source: drawing";
}

ordered_json origins_of_gear(const Drawing& d, const char* more_key, const std::string& more) {
  return {{"teeth", origin_of(d, "teeth")},
          {"module_mm", origin_of(d, "module_mm")},
          {"pressure_angle_deg", origin_of(d, "pressure_angle_deg")},
          {"profile_shift", origin_of(d, "profile_shift")},
          {"width_mm", origin_of(d, "width_mm")},
          {"accuracy_grade", "estimate: ground gears, ISO 1328 grade 5 to 7; the transmission error follows from it"},
          {more_key, more}};
}

/// A gear with the bore of a hollow shaft.
ordered_json gear_on_shaft(const Drawing& d, int teeth, double shift) {
  ordered_json gear = gear_of(d, teeth, shift);
  gear["bore_mm"] = neat(0.35 * root_mm(d, teeth, shift));
  gear["origin"] =
      origins_of_gear(d, "bore_mm", "estimate: hollow shaft, a third of the root circle; 0 of a solid one");
  return gear;
}

ordered_json whole_curve() {
  return {{"form", "curve"}, {"origin", "choice: the whole curve; a few harmonics lose of its jumps"}};
}

ordered_json lubrication() {
  return {{"viscosity_mPas", 15}, {"origin", "estimate: ISO VG 150 at 85 degrees Celsius; 5 to 50 in service"}};
}

std::string damping(const char* of) {
  return std::string("estimate: 0.02 to 0.1, usual for ") + of +
         "; no drawing states it, and the response depends on it";
}

ordered_json mesh_of(const Drawing& d) {
  const double centre = 0.5 * d.module_mm * (d.sun_teeth + d.planet_teeth);
  return {{"damping_ratio", 0.05},
          {"backlash_half_um", neat(0.5 * 2.0 / 3.0 * (60.0 + 0.5 * centre + 30.0 * d.module_mm))},
          {"origin",
           {{"damping_ratio", damping("steel gears")},
            {"backlash_half_um",
             "estimate: half of the least that ISO/TR 10064-2 recommends at this module and centre distance"}}}};
}

ordered_json load_of(const Drawing& d) {
  const std::string member = d.pair ? "gear 1" : "the sun";
  return {{"torque_Nm", torque_Nm(d)},
          {"origin", d.torque_Nm ? "source: rating, on " + member
                                 : "estimate: on " + member + ", 60 N/mm2 times module and face width" +
                                       (d.pair ? "; give yours" : " on each mesh; give yours")}};
}

ordered_json starter_pair(const Drawing& d) {
  ordered_json stage;
  stage["name"] = d.name;
  stage["note"] =
      "A pair to begin with: gear 1 (sun) drives gear 2 (planet), and both only rotate. What has the origin "
      "\"estimate\" stands on no drawing: values that machines have, with the reason and the range; replace what you "
      "know. `epicyclic keys WORD` explains a key.";
  stage["boundary"] = "pair";
  stage["load"] = load_of(d);
  stage["catalogue"] = {{"sun", gear_on_shaft(d, d.sun_teeth, d.profile_shift[0])},
                        {"planet", gear_on_shaft(d, d.planet_teeth, d.profile_shift[1])},
                        {"mesh_stiffness", whole_curve()},
                        {"lubrication", lubrication()}};
  const std::string held =
      "choice: stiff shafts and bearings, gears that only rotate; take this key out where /stage/catalogue/";
  stage["lumped"] = {{"sun", {{"support_N_per_m", "rigid"}, {"origin", held + "sun_bearing is to give it"}}},
                     {"planet", {{"bearing_N_per_m", "rigid"}, {"origin", held + "planet_bearing is to give it"}}},
                     {"sun_planet_mesh", mesh_of(d)}};
  return stage;
}

}  // namespace

double torque_Nm(const Drawing& d) {
  constexpr double load_N_per_mm2 = 60;
  const double mesh_force_N = load_N_per_mm2 * d.module_mm * d.width_mm;
  return d.torque_Nm ? *d.torque_Nm : neat(mesh_force_N * d.planets * sun_base_radius_mm(d) * 1e-3);
}

std::vector<double> assembly_angles(const Drawing& d) {
  if (d.pair) return {};
  const int sum = d.sun_teeth + d.ring();
  if (sum % d.planets == 0 || !d.angles_deg.empty()) return {};
  std::vector<double> all;
  for (int i = 0; i < d.planets; ++i) all.push_back(gear::assembly_angle_deg(sum, 0.0, 360.0 * i / d.planets));
  return all;
}

ordered_json starter_stage(const Drawing& d) {
  check(d);
  if (d.pair) return starter_pair(d);
  const double m = d.module_mm;
  const double centre = 0.5 * m * (d.sun_teeth + d.planet_teeth);
  const double sun_root = root_mm(d, d.sun_teeth, d.profile_shift[0]);
  const double planet_root = root_mm(d, d.planet_teeth, d.profile_shift[1]);
  const double planet_bore = std::max(neat(planet_root - 6.0 * m), neat(0.3 * planet_root));
  const double ring_outer = neat(m * (d.ring() + 2.0 * (addendum + clearance) + 2.0 * d.profile_shift[2]) + 8.0 * m);
  const double pin = neat(0.6 * planet_bore);

  const ordered_json sun = gear_on_shaft(d, d.sun_teeth, d.profile_shift[0]);
  ordered_json planet = gear_of(d, d.planet_teeth, d.profile_shift[1]);
  planet["bore_mm"] = planet_bore;
  planet["origin"] = origins_of_gear(d, "bore_mm",
                                     "estimate: leaves a rim of 3 modules; from 1.2 tooth depths on ISO 6336-3 "
                                     "counts it as solid");
  ordered_json ring = gear_of(d, d.ring(), d.profile_shift[2]);
  ring["outer_diameter_mm"] = ring_outer;
  ring["origin"] = origins_of_gear(d, "outer_diameter_mm", "estimate: leaves a rim of 4 modules");

  ordered_json planets = {{"count", d.planets}};
  if (!d.angles_deg.empty()) {
    planets["angles_deg"] = d.angles_deg;
    planets["origin"] = "source: drawing";
  } else if (const std::vector<double> at = assembly_angles(d); !at.empty()) {
    planets["angles_deg"] = at;
    planets["origin"] = {
        {"count", origin_of(d, "count")},
        {"angles_deg", fmt::format("choice: nearest to even spacing that can be put together, in steps "
                                   "of 360 / {} degrees",
                                   d.sun_teeth + d.ring())}};
  } else {
    planets["origin"] = origin_of(d, "count");
  }

  ordered_json stage;
  stage["name"] = d.name;
  stage["note"] =
      "A set to begin with: ring held, carrier free. What has the origin \"estimate\" stands on no drawing: values "
      "that "
      "machines have, with the reason and the range; replace what you know. `epicyclic keys WORD` explains a key.";
  stage["boundary"] = "fixed_ring";
  stage["planets"] = planets;
  stage["load"] = load_of(d);
  stage["catalogue"] = {{"sun", sun},
                        {"planet", planet},
                        {"ring", ring},
                        {"carrier",
                         {{"body",
                           {{"plate_thickness_mm", neat(0.3 * d.width_mm)},
                            {"outer_diameter_mm", neat(2.0 * centre + 1.8 * pin)},
                            {"inner_diameter_mm", neat(std::max(sun_root, 2.0 * centre - 2.2 * pin))},
                            {"pin_diameter_mm", pin},
                            {"pin_length_mm", neat(1.1 * d.width_mm)},
                            {"origin", "estimate: two plates about the pins, pins of 0.6 of the planets' bores"}}}}},
                        {"mesh_stiffness", whole_curve()},
                        {"lubrication", lubrication()}};
  // Supports as parts of the mesh stiffness, so that the modes of small and large stages are alike.
  constexpr double mesh_N_per_m_per_mm = 2e7;
  const double mesh = mesh_N_per_m_per_mm * d.width_mm;
  const std::string benchmark =
      "the mesh stiffness, 20 N/(mm um) of width (ISO 6336-1), as in the benchmark of Lin and Parker 1999";
  const Estimate sun_support =
      estimate(mesh / 30.0, 0.5, 20.0,
               "shaft and bearings of a sun that is held, a thirtieth of the mesh stiffness; a "
               "tenth of it or less of one that floats; take this key out where "
               "/stage/catalogue/sun_bearing is to give it");
  const Estimate ring_support =
      estimate(0.2 * mesh, 0.8, 25.0, "0.2 of " + benchmark + "; some hundredths of it of a ring that floats");
  const Estimate ring_torsion = estimate(2.0 * mesh, 0.3, 5.0, "twice " + benchmark);
  const Estimate carrier_support =
      estimate(0.2 * mesh, 0.5, 10.0,
               "0.2 of " + benchmark + "; take this key out where /stage/catalogue/carrier/bearing is to give it");
  const RadialClearance clearance_um = radial_clearance(sun_root);
  constexpr int rollers = 11;  // of a fifth of the bore, nine tenths of the pitch circle full of them
  const double planet_load = 2.0 * 1e3 * torque_Nm(d) / (d.planets * 0.5 * d.module_mm * d.sun_teeth);
  const Estimate planet_bearing = estimate(
      gear::roller_stiffness(planet_load, rollers, 0.8 * d.width_mm), 1.0 / 3.0, 3.0,
      fmt::format("[G-roller] {} rollers of a fifth of the bore, 0.8 of the width long, under {:.3g} N of both "
                  "meshes; less with clearance and a pin that yields, more of full rows of needles",
                  rollers, planet_load));
  stage["lumped"] = {
      {"sun",
       {{"support_N_per_m", sun_support.value},
        {"support_damping_ratio", 0.05},
        {"bearing_clearance_half_um", neat(0.25 * (clearance_um.least + clearance_um.greatest))},
        {"origin",
         {{"support_N_per_m", sun_support.origin},
          {"support_damping_ratio", damping("rolling bearings")},
          {"bearing_clearance_half_um",
           fmt::format("estimate: {} to {}, half the radial clearance of a ball bearing, group N of ISO "
                       "5753-1, on a shaft as thick as the sun's root circle; 0 of one that is preloaded",
                       0.5 * clearance_um.least, 0.5 * clearance_um.greatest)}}}}},
      {"ring",
       {{"support_N_per_m", ring_support.value},
        {"torsional_support_N_per_m", ring_torsion.value},
        {"support_damping_ratio", 0.05},
        {"origin",
         {{"support_N_per_m", ring_support.origin},
          {"torsional_support_N_per_m", ring_torsion.origin},
          {"support_damping_ratio", damping("mounted rings")}}}}},
      {"carrier",
       {{"support_N_per_m", carrier_support.value},
        {"torsional_support_N_per_m", 0},
        {"support_damping_ratio", 0.05},
        {"origin",
         {{"support_N_per_m", carrier_support.origin},
          {"torsional_support_N_per_m", "choice: the carrier is the free output"},
          {"support_damping_ratio", damping("rolling bearings")}}}}},
      {"planet",
       {{"bearing_N_per_m", planet_bearing.value},
        {"support_damping_ratio", 0.05},
        {"origin",
         {{"bearing_N_per_m", planet_bearing.origin}, {"support_damping_ratio", damping("rolling bearings")}}}}},
      {"sun_planet_mesh", mesh_of(d)},
      {"ring_planet_mesh", mesh_of(d)}};
  return stage;
}

ordered_json starter_sweep(const Drawing& d, const std::string& stage_file) {
  ordered_json plan = {{"kind", "sweep"}};
  if (d.speed_rpm) {
    plan["parameter"] = "sun_speed_rpm";
    plan["from"] = neat(0.2 * *d.speed_rpm);
    plan["to"] = neat(1.5 * *d.speed_rpm);
  } else {
    plan["parameter"] = "mesh_frequency_ratio";
    plan["from"] = 0.2;
    plan["to"] = 2;
  }
  plan["points"] = 181;
  plan["directions"] = {"up", "down"};
  plan["crosscheck"] = {{"points", 6}};
  ordered_json study = {
      {"name", d.name + "_speed"},
      {"note", "Diagram over the speed, up and down; some of its points once more by ARKODE and CVODE."},
      {"stage", stage_file}};
  if (d.speed_rpm) study["operation"] = {{"sun_speed_rpm", *d.speed_rpm}};  // of sweeps over something else
  study["model"] = {{"centrifugal", "included"}};
  study["integrator"] = {{"method", "lanes-cash-karp"}, {"relative_tolerance", 1e-8}, {"absolute_tolerance", 1e-10}};
  study["study"] = plan;
  return study;
}

ordered_json starter_run(const Drawing& d, const std::string& stage_file) {
  ordered_json operation;
  if (d.speed_rpm)
    operation["sun_speed_rpm"] = *d.speed_rpm;
  else
    operation["mesh_frequency_ratio"] = 1;
  return {{"name", d.name + "_point"},
          {"note", "One speed with everything: regime, forces, spectra, exponents."},
          {"stage", stage_file},
          {"operation", operation},
          {"model", {{"centrifugal", "included"}}},
          {"study", {{"kind", "run"}, {"transient", "adaptive"}}}};
}

}  // namespace epicyclic::input
