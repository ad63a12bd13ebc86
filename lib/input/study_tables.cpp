// The tables of all objects of the input: every key, its bounds and its meaning. Defaults are those of the typed
// structs.
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "input/catalogue_table.hpp"
#include "input/origins.hpp"
#include "input/plan_tables.hpp"
#include "input/study_input.hpp"
#include "input/study_kind.hpp"
#include "integrate/methods.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::input {

namespace {

using gear::CentralMember;
using gear::CoulombFriction;
using gear::EhlFriction;
using gear::Friction;
using gear::FrictionTable;
using gear::Mesh;
using gear::Planet;
using gear::Stage;
using nlohmann::json;
using nlohmann::ordered_json;

// Far beyond any gear, on both sides; they catch a wrong unit and keep sums, squares and quotients finite.
constexpr double mass_min = 1e-9;
constexpr double mass_max = 1e7;
constexpr double stiffness_min = 1e-3;
constexpr double stiffness_max = 1e18;
constexpr double gap_max_um = 1e5;
constexpr double largest_angle_deg = 3600;

/// Of a parameter with a name.
Bounds bounds_of(const char* parameter) {
  const studies::NamedParameter& named = *studies::find_parameter(parameter);
  return between(named.least, named.most);
}

const Bounds mass = between(mass_min, mass_max);
const Bounds support = between(0, stiffness_max);
const Bounds stiffness = between(stiffness_min, stiffness_max);
const Bounds length = between(length_min_mm, length_max_mm);
const Bounds gap = between(0, gap_max_um);
const Bounds signed_error = between(-gap_max_um, gap_max_um);
const Bounds damping_ratio = bounds_of("damping_ratio");
const Bounds damping_coefficient = between(0, 1e12);
const Bounds frequency_ratio = bounds_of("mesh_frequency_ratio");
const Bounds integrator_tolerance = between(1e-15, 0.1);
const Bounds table_error = between(0, 1);
const Bounds smoothing_width = between(0, 10);

constexpr auto itself = [](auto& t) -> auto& { return t; };

const std::vector<std::pair<std::string, Interpolation>> interpolations = {
    {"linear", Interpolation::linear}, {"monotone", Interpolation::monotone}, {"smooth", Interpolation::smooth}};
const std::string interpolation_words =
    "linear, monotone (never beyond the rows), or smooth, of fourth order, for rows of a smooth function.";

/// `inner` of the object that `outer` reaches.
template <class F, class G>
auto chain(F outer, G inner) {
  return [ outer, inner ](auto& t) -> auto& { return std::invoke(inner, std::invoke(outer, t)); };
}

/// A member that a stage has and a pair of gears has not.
template <class V>
table_detail::Access<Stage, V> of_stage_only(V Stage::*member) {
  return {[=](Stage& s) -> V& { return s.*member; },
          [=](const Stage& s) -> const V* { return s.is_pair() ? nullptr : &(s.*member); }};
}

/// The two forms of the damping of a member's supports.
template <class T, class F>
void add_damping(Table<T>& table, F damping) {
  table.number("support_damping_ratio",
               chain(
                   damping, [](auto& d) -> auto& { return d.ratio; }),
               damping_ratio, "Damping ratio zeta of the member's supports, c = 2 zeta sqrt(k m) [-].");
  table.number("support_damping_Ns_per_m",
               chain(
                   damping, [](auto& d) -> auto& { return d.coefficient_Ns_per_m; }),
               damping_coefficient, "Damping coefficient of the member's supports [N s/m].");
  table.rule(KeyRule::Kind::at_most_one, {"support_damping_ratio", "support_damping_Ns_per_m"});
}

template <class T, class F>
void add_body(Table<T>& table, F body, const std::string& radius) {
  const auto weight = chain(
      body, [](auto& b) -> auto& { return b.mass_kg; });
  const auto inertia = chain(
      body, [](auto& b) -> auto& { return b.inertia_over_r2_kg; });
  const std::string of_inertia = "Moment of inertia over the square of the " + radius + " [kg]";
  if constexpr (std::is_same_v<T, Planet>) {
    const std::string each = ": one number, or one per planet.";
    table.values("mass_kg", weight, mass, gear::planets_max, "Mass [kg]" + each).required();
    table.values("inertia_over_r2_kg", inertia, mass, gear::planets_max, of_inertia + each).required();
  } else {
    table.number("mass_kg", weight, mass, "Mass [kg].").required();
    table.number("inertia_over_r2_kg", inertia, mass, of_inertia + ".").required();
  }
  add_damping(table, chain(
                         body, [](auto& b) -> auto& { return b.damping; }));
}

template <class T, class F>
void add_gear(Table<T>& table, F body) {
  table.integer("teeth",
                chain(
                    body, [](auto& b) -> auto& { return b.teeth; }),
                between(3, 10000), "Number of teeth [-]; needed for time integration.");
  table.number("base_radius_mm",
               chain(
                   body, [](auto& b) -> auto& { return b.base_radius_mm; }),
               length, "Radius of the base circle [mm]; needed for time integration.");
}

template <class T, class F>
void add_pitch_errors(Table<T>& table, F member) {
  table.numbers("pitch_error_um",
                chain(
                    member, [](auto& m) -> auto& { return m.errors.pitch_error_um; }),
                signed_error, 3, 10000,
                "Cumulative pitch error of each tooth, towards rising angles from the tooth at planet 1 at the mesh "
                "phase 0; positive: the tooth bears less [um].");
}

template <class T, class F>
void add_central(Table<T>& table, F member, const std::string& radius) {
  add_body(table, member, radius);
  table
      .number_or_rigid("support_N_per_m",
                       chain(
                           member, [](auto& m) -> auto& { return m.support_N_per_m; }),
                       support,
                       "Stiffness of the support in x and in y [N/m], or \"rigid\" (modes, and pairs whose gears only "
                       "rotate).")
      .required();
  table.number_or_rigid("torsional_support_N_per_m",
                        chain(
                            member, [](auto& m) -> auto& { return m.torsional_support_N_per_m; }),
                        support,
                        "Stiffness of the torsional support, referred to the " + radius +
                            " [N/m], or \"rigid\" (modes; for the ring also in time integration).");
  const auto errors = chain(
      member, [](auto& m) -> auto& { return m.errors; });
  table.number("eccentricity_um",
               chain(
                   errors, [](auto& e) -> auto& { return e.eccentricity_um; }),
               gap, "Distance from the axis of rotation to the centre of the teeth or pins, half of the run-out [um].");
  table.number("eccentricity_phase_deg",
               chain(
                   errors, [](auto& e) -> auto& { return e.eccentricity_phase_deg; }),
               between(-largest_angle_deg, largest_angle_deg),
               "Direction of the eccentricity at the mesh phase 0, as planet angles are measured [deg].");
}

/// @param rating  reaches the rating of a T
/// @param usual   the rolling elements where none are named
template <class T, class F>
void add_rating(Table<T>& t, F rating, const std::string& usual) {
  t.number("dynamic_load_rating_kN",
           chain(
               rating, [](auto& r) -> auto& { return r.dynamic_load_rating_kN; }),
           between(1e-3, 1e6), "Basic dynamic radial load rating C [kN]; with it results have the bearing's life L10.");
  t.choice("rolling_elements",
           chain(
               rating, [](auto& r) -> auto& { return r.rolling_elements; }),
           std::vector<std::pair<std::string, gear::RollingElements>>{{"balls", gear::RollingElements::balls},
                                                                      {"rollers", gear::RollingElements::rollers}},
           "Decides the exponent of the life, 3 or 10/3; " + usual + " if not given.");
  t.rule(KeyRule::Kind::needs, {"rolling_elements", "dynamic_load_rating_kN"});
}

const Table<gear::BearingRating>& planet_bearing_table() {
  static const auto table = [] {
    Table<gear::BearingRating> t("bearing", "Load rating of the planet's bearing.");
    add_rating(t, itself, "rollers");
    return t;
  }();
  return table;
}

const Table<gear::SunBearing>& bearing_table() {
  static const auto table = [] {
    Table<gear::SunBearing> t("bearing", "Law of the sun's bearing and its rolling elements.");
    t.choice(
        "law", &gear::SunBearing::law,
        std::vector<std::pair<std::string, gear::BearingLaw>>{{"linear_xy", gear::BearingLaw::linear_xy},
                                                              {"palmgren_xy", gear::BearingLaw::palmgren_xy},
                                                              {"linear_radial", gear::BearingLaw::linear_radial},
                                                              {"palmgren_radial", gear::BearingLaw::palmgren_radial}},
        "Force of the bearing against the sun's displacement: with a constant stiffness or Palmgren's, along x and "
        "y each or along the radius.");
    t.integer("balls", &gear::SunBearing::balls, between(3, 1000), "Number of balls [-]; for the Palmgren laws.");
    t.number("ball_diameter_mm", &gear::SunBearing::ball_diameter_mm, length,
             "Diameter of a ball [mm]; for the Palmgren laws.");
    t.number("contact_angle_deg", &gear::SunBearing::contact_angle_deg, from_below(0, 90), "Contact angle [deg].");
    add_rating(
        t, [](auto& bearing) -> auto& { return bearing.rating; }, "balls");
    return t;
  }();
  return table;
}

const Table<Stage>& sun_table() {
  static const auto table = [] {
    Table<Stage> t("sun", "The sun.");
    const auto sun = [](auto& s) -> auto& { return s.sun; };
    add_central(t, sun, "base radius");
    add_gear(t, sun);
    add_pitch_errors(t, sun);
    t.number(
        "bearing_clearance_half_um", [](auto& s) -> auto& { return s.sun_bearing.clearance_half_um; }, gap,
        "Half the clearance of the bearing [um].");
    t.object("bearing", &Stage::sun_bearing, bearing_table());
    return t;
  }();
  return table;
}

const Table<CentralMember>& ring_table() {
  static const auto table = [] {
    Table<CentralMember> t("ring", "The ring.");
    add_central(t, itself, "base radius");
    add_gear(t, itself);
    add_pitch_errors(t, itself);
    return t;
  }();
  return table;
}

const Table<CentralMember>& carrier_table() {
  static const auto table = [] {
    Table<CentralMember> t("carrier", "The carrier.");
    add_central(t, itself, "centre distance");
    return t;
  }();
  return table;
}

const Table<Planet>& planet_table() {
  static const auto table = [] {
    Table<Planet> t("planet", "The planets.");
    add_body(t, itself, "base radius");
    add_gear(t, itself);
    t.values_or_rigid("bearing_N_per_m", &Planet::bearing_N_per_m, support, gear::planets_max,
                      "Stiffness of the planet bearing, the same in all directions [N/m]: one number, one per planet, "
                      "or \"rigid\" (modes, and pairs whose gears only rotate).")
        .required();
    t.number("bearing_clearance_half_um", &Planet::bearing_clearance_half_um, gap,
             "Half the radial clearance of the planet bearing [um]; no clearance if it is not given.");
    t.object("bearing", &Planet::rating, planet_bearing_table());
    t.number("torsional_support_N_per_m", &Planet::torsional_support_N_per_m, support,
             "Of gear 2 of a pair: stiffness of the torsional support, referred to the base radius [N/m].");
    t.number_or_numbers("pin_error_tangential_um", &Planet::pin_error_tangential_um, signed_error, gear::planets_max,
                        "Position error of the pin in the carrier towards rising planet angles [um]: one number, or "
                        "one per planet.");
    t.number_or_numbers("pin_error_radial_um", &Planet::pin_error_radial_um, signed_error, gear::planets_max,
                        "Position error of the pin in the carrier, outward [um]: one number, or one per planet.");
    t.number_or_numbers("eccentricity_um", &Planet::eccentricity_um, gap, gear::planets_max,
                        "Distance from the planet's axis to the centre of its teeth, half of the run-out [um]: one "
                        "number, or one per planet.");
    const std::string in_order =
        " The first tooth is in contact at the mesh phase 0, the next ones follow towards rising angles. There are as "
        "many numbers as teeth, or as the teeth of all planets. Positive: the tooth bears less [um].";
    t.numbers("pitch_error_um", &Planet::pitch_error_um, signed_error, 3, 10000,
              "Cumulative pitch error of each flank in mesh with the sun, or of gear 2 of a pair." + in_order);
    t.numbers("pitch_error_ring_um", &Planet::pitch_error_ring_um, signed_error, 3, 10000,
              "Cumulative pitch error of each flank in mesh with the ring." + in_order);
    t.number_or_numbers("eccentricity_phase_deg", &Planet::eccentricity_phase_deg,
                        between(-largest_angle_deg, largest_angle_deg), gear::planets_max,
                        "Direction of the eccentricity at the mesh phase 0, from the planet's own radius [deg]: one "
                        "number, or one per planet.");
    return t;
  }();
  return table;
}

/// "moment_ratio_mm": {"driving": [...], "driven": [...]} in the members of the friction table.
const Table<FrictionTable>& moment_table() {
  static const auto table = [] {
    Table<FrictionTable> t("moment_ratio_mm", "Moment of the friction over the normal force, about the members' axes.");
    const auto arm = between(-length_max_mm, length_max_mm);
    t.numbers("driving", &FrictionTable::moment_driving_mm, arm, 2, 100000,
              "B about the axis of the driving member, at each phase [mm].")
        .required();
    t.numbers("driven", &FrictionTable::moment_driven_mm, arm, 2, 100000,
              "B about the axis of the driven member, at each phase [mm].")
        .required();
    return t;
  }();
  return table;
}

const Table<EhlFriction>& lubricated_table() {
  static const auto table = [] {
    Table<EhlFriction> t("lubricated", "Friction of lubricated contact, a function of place, load and speed.");
    t.number("viscosity_mPas", &EhlFriction::viscosity_mPas, between(1, 2000),
             "Dynamic viscosity of the oil at its inlet [mPa s].");
    t.number("roughness_um", &EhlFriction::roughness_um, between(0, 1.5), "RMS roughness of the flanks [um].");
    t.number("equivalent_modulus_GPa", &EhlFriction::equivalent_modulus_GPa, between(1e-6, 5000),
             "E' = 2 / ((1 - nu1^2) / E1 + (1 - nu2^2) / E2) [GPa].")
        .required();
    t.number("width_mm", &EhlFriction::width_mm, length, "Face width in contact [mm].").required();
    t.number("contact_ratio", &EhlFriction::contact_ratio, between(1, 3), "Contact ratio [-].").required();
    t.number("path_start_mm", &EhlFriction::path_start_mm, between(-length_max_mm, length_max_mm),
             "Friction arm of the driving member where contact starts [mm].")
        .required();
    t.numbers("load_share_position", &EhlFriction::share_position, between(0, 3), 2, 100000,
              "Positions of a pair, in base pitches from the start of contact, 0 to the contact ratio, rising [-].");
    t.numbers("load_share", &EhlFriction::share, between(0, 1), 2, 100000,
              "Share of the load on the pair at each position; equal sharing if not given [-].");
    t.choice("load_share_interpolation", &EhlFriction::share_interpolation, interpolations,
             "Between the rows of the load share: " + interpolation_words);
    t.number("load_share_error", &EhlFriction::share_error, table_error,
             "Greatest error of the share between its rows [-].");
    t.number("table_tolerance", &EhlFriction::table_tolerance, table_tolerance,
             "Error that the rows of the friction table are made fine enough for at each operating point, of friction "
             "over normal force [-].");
    t.rule(KeyRule::Kind::together, {"load_share_position", "load_share"});
    return t;
  }();
  return table;
}

const Table<Friction>& friction_table() {
  static const auto table = [] {
    Table<Friction> t("friction",
                      "Tooth friction: a coefficient on an idealised path of contact, a table, or lubricated contact.");
    t.number("coefficient", within(&Friction::coefficient, &CoulombFriction::coefficient), between(0, 1),
             "Coulomb coefficient mu on the path of contact [-].");
    t.object("lubricated", present(&Friction::ehl), lubricated_table());
    t.number("contact_ratio", within(&Friction::coefficient, &CoulombFriction::contact_ratio), between(1, 3),
             "Contact ratio [-].");
    t.number(
        "path_start_mm", within(&Friction::coefficient, &CoulombFriction::path_start_mm),
        between(-length_max_mm, length_max_mm),
        "Friction arm of the driving member where contact starts [mm]; the path is symmetric about the pitch point "
        "if it is not given.");
    t.numbers("phase", within(&Friction::table, &FrictionTable::phase), from_below(0, 1), 2, 100000,
              "Mesh phase s / 2 pi of the table's rows, rising [-].");
    t.numbers("force_ratio", within(&Friction::table, &FrictionTable::force_ratio), between(-1, 1), 2, 100000,
              "A, friction force over normal force, at each phase [-].");
    Field<Friction> moment;
    moment.key = "moment_ratio_mm";
    moment.description = moment_table().description();
    moment.read = [](const json& value, const std::string& pointer, Friction& friction, ReadContext& context) {
      if (!friction.table) friction.table.emplace();
      moment_table().read(value, pointer, *friction.table, context);
    };
    moment.write = [](const Friction& friction) {
      return friction.table ? moment_table().write(*friction.table) : json();
    };
    moment.schema = [] { return moment_table().schema(); };
    moment.collect = [](const std::string& pointer, std::vector<KeyPlace>& places) {
      moment_table().collect(pointer, places);
    };
    moment.change = [](std::string_view rest, double value, const std::string& pointer, Friction& friction,
                       ReadContext& context) {
      return friction.table && moment_table().change(rest, value, pointer, *friction.table, context);
    };
    t.custom(std::move(moment));
    t.numbers("breakpoints", within(&Friction::table, &FrictionTable::breakpoints), from_below(0, 1), 0, 1000,
              "Phases where the table jumps or kinks [-].");
    t.choice("interpolation", within(&Friction::table, &FrictionTable::interpolation), interpolations,
             "Between the rows of the table: " + interpolation_words);
    t.rule(KeyRule::Kind::not_empty, {"coefficient", "phase", "lubricated"});
    t.rule(KeyRule::Kind::at_most_one, {"coefficient", "phase", "lubricated"});
    t.rule(KeyRule::Kind::together, {"phase", "force_ratio", "moment_ratio_mm"});
    t.rule(KeyRule::Kind::needs, {"contact_ratio", "coefficient"});
    t.rule(KeyRule::Kind::needs, {"path_start_mm", "coefficient"});
    t.rule(KeyRule::Kind::needs, {"breakpoints", "phase"});
    t.rule(KeyRule::Kind::needs, {"interpolation", "phase"});
    return t;
  }();
  return table;
}

/// Keys of a curve that a CSV file gives in place of its rows. The loader replaces them by the rows [curve_files.hpp].
template <class T>
void add_file(Table<T>& table, const std::string& column) {
  const auto text = [&](const char* key, std::string description) {
    Field<T> field;
    field.key = key;
    field.description = std::move(description);
    field.read = [](const json& value, const std::string& pointer, T&, ReadContext& context) {
      if (!value.is_string())
        context.add(Finding::Kind::type, pointer, "is " + described(value) + ", must be a string");
    };
    field.write = [](const T&) { return json(); };
    field.schema = [] { return ordered_json{{"type", "string"}}; };
    table.custom(std::move(field));
  };
  text("file", "CSV file with the columns `phase` and `" + column +
                   "`, in place of the rows, relative to the file that "
                   "names it.");
  text("column", "Column of the file in place of `" + column + "`.");
  table.rule(KeyRule::Kind::exactly_one, {"file", "phase"});
  table.rule(KeyRule::Kind::together, {"phase", column});
  table.rule(KeyRule::Kind::needs, {"column", "file"});
}

const Table<gear::ErrorCurve>& error_table() {
  static const auto table = [] {
    using gear::ErrorCurve;
    Table<ErrorCurve> t(
        "error_curve", "Transmission error over the mesh's own phase, beside the harmonics, the same for all planets.");
    add_file(t, "error_um");
    t.numbers("phase", &ErrorCurve::phase, from_below(0, 1), 2, 100000,
              "Phase of the rows, 0 where a pair enters, rising [-].");
    t.numbers("error_um", &ErrorCurve::error_um, signed_error, 2, 100000,
              "Transmission error at each phase [um]. Positive unloads the mesh.");
    t.numbers("breakpoints", &ErrorCurve::breakpoints, from_below(0, 1), 0, 1000,
              "Phases where the curve has a kink [-]. It must not jump.");
    t.choice("interpolation", &ErrorCurve::interpolation, interpolations,
             "Between the rows of the curve: " + interpolation_words);
    t.number("error", &ErrorCurve::error, table_error,
             "Greatest error between the rows, relative to the largest row [-].");
    return t;
  }();
  return table;
}

}  // namespace

const Table<gear::StiffnessCurve>& stiffness_curve_table() {
  static const auto table = [] {
    using gear::StiffnessCurve;
    Table<StiffnessCurve> t("stiffness_curve", "Mesh stiffness over the mesh's own phase, in place of harmonics.");
    add_file(t, "stiffness_N_per_m");
    t.numbers("phase", &StiffnessCurve::phase, from_below(0, 1), 2, 100000,
              "Phase of the rows, 0 where a pair enters, rising; a jump is two rows of one phase [-].");
    t.numbers("stiffness_N_per_m", &StiffnessCurve::stiffness_N_per_m, stiffness, 2, 100000,
              "Stiffness at each phase [N/m].");
    t.numbers("breakpoints", &StiffnessCurve::breakpoints, from_below(0, 1), 0, 1000,
              "Phases where the curve jumps or kinks [-].");
    t.choice("interpolation", &StiffnessCurve::interpolation, interpolations,
             "Between the rows of the curve: " + interpolation_words);
    t.number("error", &StiffnessCurve::error, table_error,
             "Greatest error between the rows, relative to the mean [-].");
    return t;
  }();
  return table;
}

namespace {

const Table<Mesh>& mesh_table() {
  static const auto table = [] {
    Table<Mesh> t("mesh", "A mesh, the same for all planets but for the errors.");
    const auto harmonic = between(-stiffness_max, stiffness_max);
    t.number("stiffness_N_per_m", &Mesh::stiffness_N_per_m, stiffness, "Mean mesh stiffness k_0 [N/m].").required();
    t.numbers("stiffness_cos_N_per_m", &Mesh::stiffness_cos_N_per_m, harmonic, 0, gear::harmonics_max,
              "Cosine coefficients of the harmonics 1, 2, ... of the stiffness on the mesh's own phase [N/m].");
    t.numbers("stiffness_sin_N_per_m", &Mesh::stiffness_sin_N_per_m, harmonic, 0, gear::harmonics_max,
              "Sine coefficients of the harmonics 1, 2, ... of the stiffness on the mesh's own phase [N/m].");
    t.object("stiffness_curve", present(&Mesh::stiffness_curve), stiffness_curve_table());
    t.number("operating_pressure_angle_deg", &Mesh::operating_pressure_angle_deg, from_below(0, 90),
             "Operating pressure angle [deg]; base radii and centre distance decide where they are given.");
    t.number("damping_ratio", &Mesh::damping_ratio, damping_ratio,
             "Damping ratio zeta of the mesh, c = 2 zeta sqrt(k_0 m_e) [-]; needed for time integration.");
    t.number("backlash_half_um", &Mesh::backlash_half_um, gap, "Half the backlash, on the line of action [um].");
    t.number_or_numbers("error_amplitude_um", &Mesh::error_amplitude_um, gap, gear::planets_max,
                        "Amplitude of the transmission error [um]: one number, or one per planet.");
    t.number_or_numbers("error_phase_deg", &Mesh::error_phase_deg, between(-largest_angle_deg, largest_angle_deg),
                        gear::planets_max, "Phase of the transmission error [deg]: one number, or one per planet.");
    t.numbers("error_cos_um", &Mesh::error_cos_um, signed_error, 0, gear::harmonics_max,
              "Cosine coefficients of the harmonics 1, 2, ... of the transmission error on the mesh's own phase, the "
              "same for all planets and beside error_amplitude_um [um].");
    t.numbers("error_sin_um", &Mesh::error_sin_um, signed_error, 0, gear::harmonics_max,
              "Sine coefficients of the same [um].");
    t.object("error_curve", present(&Mesh::error_curve), error_table());
    t.number_or_numbers("error_mean_um", &Mesh::error_mean_um, signed_error, gear::planets_max,
                        "Constant part of the transmission error, of tooth thickness or spacing [um]: one number, or "
                        "one per planet. Positive unloads the mesh.");
    t.object("friction", &Mesh::friction, friction_table());
    return t;
  }();
  return table;
}

bool is_a_pair(const void* stage) { return static_cast<const Stage*>(stage)->is_pair(); }

const Table<Stage>& lumped_table() {
  static const auto table = [] {
    Table<Stage> t("lumped", "The stage as lumped values.");
    t.object("sun", itself, sun_table()).required();
    t.object("ring", of_stage_only(&Stage::ring), ring_table()).required_unless("boundary", is_a_pair);
    t.object("carrier", of_stage_only(&Stage::carrier), carrier_table()).required_unless("boundary", is_a_pair);
    t.object("planet", &Stage::planet, planet_table()).required();
    t.object("sun_planet_mesh", &Stage::sun_planet_mesh, mesh_table()).required();
    t.object("ring_planet_mesh", of_stage_only(&Stage::ring_planet_mesh), mesh_table())
        .required_unless("boundary", is_a_pair);
    t.number("ring_mesh_lead_1", of_stage_only(&Stage::ring_mesh_lead_1), between(-1, 1),
             "Share of a mesh period by which the ring-planet mesh leads the sun-planet mesh [-].");
    return t;
  }();
  return table;
}

const Table<Stage>& planets_table() {
  static const auto table = [] {
    Table<Stage> t("planets", "How many planets there are, and where.");
    t.integer("count", &Stage::planet_count, between(1, gear::planets_max),
              "Number of planets [-], 2 to 6; 1 of a pair, for which it need not be given.")
        .required_unless("boundary", is_a_pair);
    t.numbers("angles_deg", &Stage::angles_deg, between(-largest_angle_deg, largest_angle_deg), 1, gear::planets_max,
              "Angle of each planet [deg]; equally spaced from 0 if not given.");
    t.number("centre_distance_mm", &Stage::centre_distance_mm, length,
             "Distance between the axes of sun and planet, or of the gears of a pair [mm]; needed for time integration "
             "of a stage.");
    return t;
  }();
  return table;
}

const Table<gear::Load>& load_table() {
  static const auto table = [] {
    Table<gear::Load> t("load", "Load of the stage, on the sun: a power or a torque.");
    t.number("power_kW", &gear::Load::power_kW, between(1e-9, 1e6),
             "Power [kW]: the torque is power over the sun's speed, and falls with it.");
    t.number("torque_Nm", &gear::Load::torque_Nm, between(-1e9, 1e9),
             "Torque on the sun [N m], at every speed. A negative one loads the other flanks: the stage is mirrored.");
    const auto harmonics = [&](const char* key, std::optional<std::vector<double>> gear::Load::*member,
                               const char* words) {
      t.numbers(key, member, between(-1000, 1000), 0, gear::harmonics_max,
                std::string("Of a pair: ") + words + " [-].");
    };
    harmonics("input_torque_cos", &gear::Load::input_cos,
              "cosine coefficients of the harmonics 1, 2, ... of the mesh frequency in the torque on gear 1, over its "
              "mean");
    harmonics("input_torque_sin", &gear::Load::input_sin, "sine coefficients of the same");
    harmonics("output_torque_cos", &gear::Load::output_cos,
              "cosine coefficients of the harmonics 1, 2, ... of the mesh frequency in the torque on gear 2, over its "
              "mean");
    harmonics("output_torque_sin", &gear::Load::output_sin, "sine coefficients of the same");
    t.rule(KeyRule::Kind::exactly_one, {"power_kW", "torque_Nm"});
    return t;
  }();
  return table;
}

const Table<Study>& operation_table() {
  static const auto table = [] {
    Table<Study> t("operation", "The operating point.");
    // Not beside a speed that is given in its place.
    const table_detail::Access<Study, double> omega = {
        [](Study& s) -> double& { return s.mesh_frequency_ratio; },
        [](const Study& s) { return s.given_speed.any() ? nullptr : &s.mesh_frequency_ratio; }};
    t.number("mesh_frequency_ratio", omega, frequency_ratio,
             "Mesh frequency over the reference frequency omega_sn [-], where no sweep varies it.");
    const auto speed = [&](const char* key, std::optional<double> GivenSpeed::*member, const char* description) {
      t.number(
          key, [member](auto& study) -> auto& { return study.given_speed.*member; }, between(1e-9, 1e9), description);
    };
    speed("sun_speed_rpm", &GivenSpeed::sun_speed_rpm, "Speed of the sun [rpm], in place of mesh_frequency_ratio.");
    speed("carrier_speed_rpm", &GivenSpeed::carrier_speed_rpm,
          "Speed of the carrier [rpm], in place of mesh_frequency_ratio.");
    speed("mesh_frequency_Hz", &GivenSpeed::mesh_frequency_Hz,
          "Mesh frequency [Hz], in place of mesh_frequency_ratio.");
    t.rule(KeyRule::Kind::at_most_one,
           {"mesh_frequency_ratio", "sun_speed_rpm", "carrier_speed_rpm", "mesh_frequency_Hz"});
    return t;
  }();
  return table;
}

const Table<Study>& integrator_table() {
  static const auto table = [] {
    using integrate::IntegratorOptions;
    Table<Study> t("integrator", "Integration in time.");
    const auto of = [](auto member) { return chain(&Study::integrator, member); };
    t.choice(
        "method", of([](auto& i) -> auto& { return i.method; }), integrate::method_names(),
        "Method: an embedded Runge-Kutta pair of ARKODE, explicit or implicit, or CVODE with Adams or BDF formulas.");
    t.number("relative_tolerance", of([](auto& i) -> auto& { return i.relative_tolerance; }), integrator_tolerance,
             "Relative tolerance of a step [-].");
    t.number("absolute_tolerance", of([](auto& i) -> auto& { return i.absolute_tolerance; }), between(tolerance_min, 1),
             "Absolute tolerance of a step, in the units of the state.");
    t.integer("max_steps_per_period", of([](auto& i) -> auto& { return i.max_steps_per_period; }), between(1, 1e9),
              "Steps attempted in one mesh period before a point is given up [-].");
    t.number("max_step_periods", of([](auto& i) -> auto& { return i.max_step_periods; }), between(0, 1),
             "Longest step, in mesh periods [-]; 0: as long as the tolerance and the rows of tables allow.");
    t.number("escape_bound", of([](auto& i) -> auto& { return i.escape_bound; }), between(10, 1e15),
             "A state component beyond this counts as diverged, in the units of the state.");
    t.integer("max_order", of([](auto& i) -> auto& { return i.max_order; }), between(0, 12),
              "Highest order of a CVODE method [-]; 0: the method's own, 12 (Adams) or 5 (BDF).");
    t.boolean("locate_contacts", of([](auto& i) -> auto& { return i.locate_contacts; }),
              "Contact changes are located and stepped onto (explicit Runge-Kutta methods): for reference, at several "
              "times the cost.");
    t.number(
        "clearance_smoothing", [](auto& s) -> auto& { return s.model.clearance_smoothing; }, smoothing_width,
        "Width of the smooth clearance, in b_c [-]; 0 for the exact, piecewise linear one.");
    return t;
  }();
  return table;
}

const Table<model::ModelOptions>& model_table() {
  static const auto table = [] {
    using model::Centrifugal;
    using model::GapDamping;
    using model::Gyroscopic;
    Table<model::ModelOptions> t("model", "Variants of terms of the model.");
    t.choice("gap_damping", &model::ModelOptions::gap_damping,
             std::vector<std::pair<std::string, GapDamping>>{{"always", GapDamping::always},
                                                             {"contact_slope", GapDamping::contact_slope}},
             "Whether mesh damping acts through the open gap.");
    t.choice("gyroscopic", &model::ModelOptions::gyroscopic,
             std::vector<std::pair<std::string, Gyroscopic>>{{"automatic", Gyroscopic::automatic},
                                                             {"off", Gyroscopic::off},
                                                             {"as_printed", Gyroscopic::as_printed},
                                                             {"carrier_row", Gyroscopic::carrier_row},
                                                             {"invariant", Gyroscopic::invariant}},
             "Form of the terms with the carrier's speed.");
    t.choice(
        "centrifugal", &model::ModelOptions::centrifugal,
        std::vector<std::pair<std::string, Centrifugal>>{{"left_out", Centrifugal::left_out},
                                                         {"included", Centrifugal::included}},
        "Whether planets' bearings bear the centrifugal force m_p omega_c^2 r_c of their planets, which the paper's "
        "equations leave out.");
    return t;
  }();
  return table;
}

/// Kinds that this program can compute.
std::vector<const StudyKind*> kinds() {
  std::vector<const StudyKind*> able = study_kinds();
  std::erase_if(able, [](const StudyKind* kind) { return !kind->missing.empty(); });
  return able;
}

/// The kind that has least to find fault with.
const StudyKind& likely_kind(const json& plan, const std::string& pointer) {
  const StudyKind* likely = nullptr;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const StudyKind* kind : kinds()) {
    Study study;
    study.plan = Plan(*kind);
    ReadContext context;
    kind->table().read(plan, pointer, study, context);
    if (context.findings.size() >= fewest) continue;
    fewest = context.findings.size();
    likely = kind;
  }
  return *likely;
}

void read_plan(const json& value, const std::string& pointer, Study& study, ReadContext& context) {
  if (!table_detail::check_object(value, pointer, context)) return;
  std::vector<std::string> names;
  for (const StudyKind* kind : kinds()) names.emplace_back(kind->name);
  const StudyKind* read_as = nullptr;
  const auto kind = value.find("kind");
  if (kind != value.end() && kind->is_string()) {
    const auto& name = kind->get_ref<const std::string&>();
    read_as = find_kind(name);
    if (read_as == nullptr)
      context.add(Finding::Kind::range, pointer + "/kind",
                  "is \"" + name + "\", must be one of: " + listed(names) + suggestion(name, names));
    else if (!read_as->missing.empty())
      return context.add(Finding::Kind::range, pointer + "/kind",
                         "is \"" + name + "\": " + std::string(read_as->missing));
  } else if (kind != value.end()) {
    context.add(Finding::Kind::type, pointer + "/kind",
                "is " + described(*kind) + ", must be one of: " + listed(names));
  }
  if (read_as == nullptr) read_as = &likely_kind(value, pointer);
  study.plan = Plan(*read_as);
  read_as->table().read(value, pointer, study, context);
}

}  // namespace

const Table<Stage>& stage_table() {
  static const auto table = [] {
    Table<Stage> t("stage", "A planetary stage.");
    t.text("name", &Stage::name, "Name of the stage.");
    t.choice("boundary", &Stage::boundary, named<gear::Boundary>(gear::boundary_names),
             "Member that is held: the ring, the carrier (`star`), the sun (`fixed_sun`), none (`free`), or none as "
             "in the printed equations of Tang et al. (`as_printed`). `pair` is a lone pair: `sun` is gear 1, which "
             "drives, `planet` is gear 2.");
    t.choice("driver", &Stage::driver,
             std::vector<std::pair<std::string, gear::Driver>>{
                 {"sun", gear::Driver::sun}, {"carrier", gear::Driver::carrier}, {"ring", gear::Driver::ring}},
             "Member through which power enters. With carrier or ring the sun rotates against its torque. With "
             "boundary `fixed_sun` it is the carrier or the ring.");
    t.number("carrier_to_sun_speed", &Stage::carrier_to_sun_speed, between(-100, 0.99),
             "Speed of the carrier over that of the sun with boundary `free` [-].");
    t.object("planets", itself, planets_table()).required_unless("boundary", is_a_pair);
    t.object("load", &Stage::load, load_table());
    t.object("catalogue", present(&Stage::catalogue), catalogue_table());
    t.object("lumped", itself, lumped_table()).required();
    return t;
  }();
  return table;
}

const Table<Study>& study_table() {
  static const auto table = [] {
    Table<Study> t("study", "A study: a stage, an operating point, and what to compute.");
    t.text("name", &Study::name, "Name of the study.");
    t.object("stage", &Study::stage, stage_table()).required();
    {
      Field<Study> patch;  // used up by the loader before the table reads
      patch.key = "stage_patch";
      patch.description = "A JSON merge patch (RFC 7386) on the stage.";
      patch.read = [](const json&, const std::string&, Study&, ReadContext&) {};
      patch.write = [](const Study&) { return json(); };
      patch.schema = [] { return ordered_json{{"type", "object"}}; };
      t.custom(std::move(patch));
    }
    t.object("operation", itself, operation_table());
    t.object("integrator", itself, integrator_table());
    t.object("model", &Study::model, model_table());
    Field<Study> plan;
    plan.key = "study";
    plan.description = "What is computed.";
    plan.read = read_plan;
    plan.write = [](const Study& study) {
      return study.has_dynamics() ? study.plan.kind()->table().write(study) : json();
    };
    plan.schema = [] {
      ordered_json any = ordered_json::array();
      for (const StudyKind* kind : kinds()) {
        Study plain;
        plain.plan = Plan(*kind);
        any.push_back(kind->table().schema(plain));
      }
      return ordered_json{{"anyOf", any}};
    };
    plan.collect = [](const std::string& pointer, std::vector<KeyPlace>& places) {
      for (const StudyKind* kind : kinds()) kind->table().collect(pointer, places);
    };
    t.custom(std::move(plan)).required();
    return t;
  }();
  return table;
}

namespace {

/// Schema of a stage with catalogue data: values that the program can compute are not required.
ordered_json catalogue_stage_schema(ordered_json stage) {
  const std::function<void(ordered_json&)> relax = [&](ordered_json& object) {
    object.erase("required");
    if (const auto properties = object.find("properties"); properties != object.end())
      for (auto& [key, property] : properties->items()) relax(property);
  };
  relax(stage["properties"]["lumped"]);
  stage["required"] = {"catalogue"};
  stage["title"] = "stage of catalogue data";
  return stage;
}

}  // namespace

std::string schema_text() {
  ordered_json study = study_table().schema();
  study["properties"]["stage"] = {
      {"anyOf",
       {{{"type", "string"}, {"minLength", 1}, {"description", "Path of the stage file, relative to the study file."}},
        {{"$ref", "#/$defs/stage"}},
        {{"$ref", "#/$defs/catalogue_stage"}}}},
      {"description", "The stage: a file, or the object itself."}};

  std::string words;
  for (const auto word : origin_words) words += (words.empty() ? "" : "|") + std::string(word);
  const ordered_json origin_text = {{"type", "string"}, {"pattern", "^(" + words + ")(: [\\s\\S]*)?$"}};
  const ordered_json origin = {
      {"description", "Where values come from: one text for all values of the object, or one for each key of it."},
      {"anyOf", {origin_text, {{"type", "object"}, {"additionalProperties", origin_text}}}}};

  ordered_json stage = stage_table().schema();
  ordered_json catalogue_stage = catalogue_stage_schema(stage);
  // The keys of lumped_table() that are not required of a pair.
  const ordered_json of_pair = {{"properties", {{"boundary", {{"const", "pair"}}}}}, {"required", {"boundary"}}};
  stage["if"] = of_pair;
  catalogue_stage["if"] = of_pair;
  catalogue_stage["else"] = {
      {"required", {"planets"}},
      {"properties", {{"planets", {{"required", {"count"}}}}, {"catalogue", {{"required", {"ring"}}}}}}};
  stage["else"] = {
      {"required", {"planets"}},
      {"properties",
       {{"planets", {{"required", {"count"}}}}, {"lumped", {{"required", {"ring", "carrier", "ring_planet_mesh"}}}}}}};
  for (ordered_json* file : {&study, &stage, &catalogue_stage})
    (*file)["properties"][schema_key] = {
        {"type", "string"}, {"description", "Of a file: where the schema is, for editors. Nothing depends on it."}};

  const ordered_json schema = {
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"title", "epicyclic input: a study, or a stage alone"},
      {"anyOf", {{{"$ref", "#/$defs/study"}}, {{"$ref", "#/$defs/stage"}}, {{"$ref", "#/$defs/catalogue_stage"}}}},
      {"$defs", {{"study", study}, {"stage", stage}, {"catalogue_stage", catalogue_stage}, {"origin", origin}}}};
  return schema.dump(2) + "\n";
}

}  // namespace epicyclic::input
