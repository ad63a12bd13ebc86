#include "gear/warnings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "core/errors.hpp"
#include "gear/accuracy.hpp"
#include "gear/ehl_friction.hpp"
#include "gear/friction_path.hpp"
#include "gear/kinematics.hpp"

namespace epicyclic::gear {

namespace {

constexpr double radian = std::numbers::pi / 180.0;

// Usual values of design guides, in modules.
constexpr double tip_thickness_usual = 0.25;
constexpr double tip_clearance_least = 0.1;
constexpr double tip_clearance_most = 0.6;
constexpr double planet_gap_usual = 0.5;
// Of tooth heights and of modules.
constexpr double external_rim_usual = 1.2;
constexpr double ring_rim_usual = 3.5;
// Over ISO/TR 10064-2's least one.
constexpr double backlash_most = 4.0;
constexpr double backlash_least = 0.01;
constexpr double half_clearance_most = 0.5;   // in modules
constexpr double form_overrun = 0.1;          // in modules; standard tips of rings overrun by half of it
constexpr double error_most = 0.1;            // in modules, where ISO 1328-1 has no tolerances
constexpr double mesh_damping_least = 0.003;  // over critical
constexpr double gravity = 9.80665;           // m/s^2
constexpr double pressure_least_GPa = 0.02;
constexpr double strength_Pa = 1e9;
constexpr double pressure_most_GPa = 1.65 * 1.6;
constexpr double mass_most = 3.0;            // over that of the drawing, or below it
constexpr double gyration_most = 2.0;        // over the member's radius
constexpr double inertia_least = 0.1;        // I / r^2 over the mass; a solid disc has 0.5
constexpr double stiffness_deviation = 0.3;  // from ISO 6336-1
constexpr double truncation_most = 0.05;     // of the variation
constexpr double width_most = 1.5;           // over that of the gear in mesh
constexpr double density_least = 900.0;      // kg/m^3, of plastics
constexpr double density_most = 20000.0;     // kg/m^3, of tungsten and gold
constexpr double plate_least = 0.02;         // thickness over the planet's face width

const std::string sun_pointer = "/catalogue/sun";
const std::string planet_pointer = "/catalogue/planet";
const std::string ring_pointer = "/catalogue/ring";

/// Recommended least backlash of ISO/TR 10064-2, normal to the flanks [mm].
double recommended_backlash_mm(double centre_distance_mm, double module_mm) {
  return (0.06 + 0.0005 * centre_distance_mm + 0.03 * module_mm) * 2.0 / 3.0;
}

void check_backlash(Warnings& out, const std::string& pointer, const std::string& mesh, double backlash_mm,
                    double centre_distance_mm, double module_mm, const std::string& remedy) {
  const double recommended = recommended_backlash_mm(centre_distance_mm, module_mm);
  const double times = backlash_mm / recommended;
  if (times > backlash_most)
    out.add_once(Rank::doubtful, times / backlash_most, pointer, "backlash of the " + mesh + " mesh", "the ", mesh,
                 " mesh has ", backlash_mm, " mm of backlash on its line of action, ", backlash_mm / module_mm,
                 " modules and ", times, " times the least that ISO/TR 10064-2 recommends (", recommended, " mm)",
                 remedy);
  if (times > 0.0 && times < backlash_least)
    out.add_once(Rank::doubtful, backlash_least / times, pointer, "backlash of the " + mesh + " mesh", "the ", mesh,
                 " mesh has ", 1e3 * backlash_mm, " um of backlash on its line of action, ", times,
                 " times the least that ISO/TR 10064-2 recommends (", 1e3 * recommended,
                 " um); without any it is 0, and the key takes half of it in um");
}

void check_tooth(Warnings& out, const Tooth& t, const std::string& pointer) {
  const double tip = t.thickness_at(t.tip_radius_mm) / t.module_mm;
  if (tip < tip_thickness_usual)
    out.add(Rank::note, tip_thickness_usual / tip, pointer, "tip", "tip thickness ", tip, " modules; at least ",
            tip_thickness_usual, " is usual");
  if (!t.internal && t.profile_shift < t.undercut_limit())
    out.add(Rank::note, 1.0, pointer, "undercut", "undercut: the profile shift ", t.profile_shift, " is below ",
            t.undercut_limit());
}

/// @param driving, driven  pointers
void check_pair(Warnings& out, const Pair& p, const std::string& driving, const std::string& driven,
                const std::string& mesh, const std::string& remedy) {
  const double module = p.driving.module_mm;
  const auto tip = [&](const std::string& pointer, double clearance) {
    const double modules = clearance / module;
    if (modules < tip_clearance_least)
      out.add(Rank::note, 1.0, pointer, "tip clearance in the " + mesh + " mesh", "tip clearance of ", clearance,
              " mm in the ", mesh, " mesh, ", modules, " modules; at least ", tip_clearance_least, " is usual");
    if (modules > tip_clearance_most)
      out.add_once(Rank::doubtful, modules / tip_clearance_most, pointer, "wide tip clearance in the " + mesh + " mesh",
                   "tip clearance of ", clearance, " mm in the ", mesh, " mesh, ", modules, " modules; at most ",
                   tip_clearance_most, " is usual");
  };
  tip(driving, p.tip_clearance_1_mm());
  tip(driven, p.tip_clearance_2_mm());
  constexpr double rounding_mm = 1e-6;
  if (p.backlash_mm() < -rounding_mm)
    out.add(Rank::note, 1.0, driven, "overlap", "nominal teeth of the ", mesh, " mesh overlap by ", -p.backlash_mm(),
            " mm; thinning must make up for it");
  check_backlash(out, driven, mesh, p.normal_backlash_mm(), p.centre_distance_mm, module, remedy);
  // Contact counts as long as the tips reach, also where there is no involute to meet.
  const auto form = [&](const std::string& pointer, double lowest_mm, const Tooth& tooth) {
    const double form_mm = tooth.form_radius_mm();
    const double below_mm = form_mm - lowest_mm;
    if (!(below_mm > 0.0)) return;
    const auto curvature_mm = [&](double radius_mm) {
      return std::sqrt(std::max(0.0, (radius_mm - tooth.base_radius_mm) * (radius_mm + tooth.base_radius_mm)));
    };
    const double lost = (curvature_mm(form_mm) - curvature_mm(lowest_mm)) / p.base_pitch_mm;
    out.add(below_mm > form_overrun * module ? Rank::doubtful : Rank::note, 1.0, pointer,
            "form of the " + mesh + " mesh", "contact of the ", mesh, " mesh reaches down to radius ", lowest_mm,
            " mm, below the end of the rack-cut involute at ", form_mm, " mm; it is counted: contact ratio ",
            p.contact_ratio(), ", without it ", p.contact_ratio() - lost);
  };
  form(driving, p.radius_1_mm(p.start_mm), p.driving);
  if (!p.internal()) form(driven, p.radius_2_mm(p.end_mm), p.driven);
}

/// The wider gear's end bears nothing.
void check_widths(Warnings& out, const MeshedPair& m, const std::string& driving, const std::string& driven,
                  const std::string& mesh) {
  const bool first = m.driving.tooth.width_mm > m.driven.tooth.width_mm;
  const double wider_mm = (first ? m.driving : m.driven).tooth.width_mm;
  const double ratio = wider_mm / m.face_width_mm();
  if (ratio > width_most)
    out.add(Rank::doubtful, ratio / width_most, (first ? driving : driven) + "/width_mm",
            "width in the " + mesh + " mesh", "is ", wider_mm, " mm, ", ratio, " times that of the other gear of the ",
            mesh, " mesh, ", m.face_width_mm(), " mm, which alone bears and yields");
}

void check_body(Warnings& out, const MeshedPair& m, const ToothBody& b, double bore_mm, const std::string& pointer) {
  if (!m.options.foundation) return;
  const double theta = b.root_half_angle.value_or(root_half_angle(b.tooth, m.options.fillet));
  if (!sainsot_coefficients(theta, b.radius_ratio).in_range)
    out.add(Rank::note, 1.0, pointer, "fit of the body", "Sainsot's body compliance is used outside its fit: h_f ",
            b.radius_ratio, " (1.4 to 7), theta_f ", theta, " rad (0.01 to 0.12)");
  const double rim = b.tooth.root_radius_mm - 0.5 * bore_mm;
  const double usual = external_rim_usual * (b.tooth.tip_radius_mm - b.tooth.root_radius_mm);
  if (rim < usual)
    out.add(Rank::note, usual / rim, pointer, "rim", "the bore leaves a rim of ", rim,
            " mm under the teeth; the mesh stiffness counts no bending of a rim, which ISO 6336-3 (Y_B) does below ",
            usual, " mm, ", external_rim_usual, " tooth heights");
}

/// Mass and gyration of a member against its drawing; without one, gyration against its radius.
void check_member(Warnings& out, const std::string& member, double mass, double inertia_over_r2, double radius_mm,
                  const std::optional<MassAndInertia>& body) {
  const std::string pointer = "/lumped/" + member;
  const double gyration = std::sqrt(inertia_over_r2 / mass);
  if (gyration > gyration_most)
    out.add(Rank::doubtful, gyration / gyration_most, pointer + "/inertia_over_r2_kg", "gyration", "is ",
            inertia_over_r2, " kg with a mass of ", mass, " kg: a radius of gyration of ", gyration,
            " times the member's own radius of reference; is a rotor counted in, or the unit another one?");
  if (const double ratio = inertia_over_r2 / mass; ratio < inertia_least)
    out.add(Rank::doubtful, inertia_least / ratio, pointer + "/inertia_over_r2_kg", "gyration", "is ", inertia_over_r2,
            " kg with a mass of ", mass, " kg, ", ratio,
            " of it; a solid disc has about half. The key takes the inertia over the radius squared, in kg; is it the "
            "inertia itself, or the unit another one?");
  if (!body) return;
  const double radius_m = radius_mm * 1e-3;
  const auto against = [&](const char* key, const char* subject, double given, double drawn) {
    const double times = given / drawn;
    const double excess = std::max(times, 1.0 / times) / mass_most;
    if (excess > 1.0)
      out.add(Rank::doubtful, excess, pointer + key, subject, "is ", given, " kg, ", times, " times the ", drawn,
              " kg of the body that the catalogue data describe");
  };
  against("/mass_kg", "mass", mass, body->mass_kg);
  against("/inertia_over_r2_kg", "gyration", inertia_over_r2, body->inertia_kg_m2 / (radius_m * radius_m));
}

void check_iso(Warnings& out, const std::string& pointer, double stiffness, const MeshedPair& mesh) {
  const double iso = iso_stiffness(mesh).mesh;
  const double ratio = stiffness / iso;
  if (std::abs(ratio - 1.0) > stiffness_deviation)
    out.add(Rank::doubtful, std::abs(ratio - 1.0) / stiffness_deviation, pointer + "/stiffness_N_per_m", "ISO", "is ",
            stiffness, " N/m, ", ratio, " times c_gamma b of ISO 6336-1:2006, 9.3, method B, ", iso,
            " N/m; models of this kind differ by ", 100.0 * stiffness_deviation, " %");
}

bool has_harmonics_of(const Mesh& mesh, const FourierSeries& computed) {
  const auto as_computed = [](const std::vector<double>& a, const std::vector<double>& b) {
    constexpr double rounding = 1e-9;
    return std::ranges::equal(a, b, [](double x, double y) { return std::abs(x - y) <= rounding * std::abs(y); });
  };
  return !mesh.stiffness_cos_N_per_m.empty() && as_computed(mesh.stiffness_cos_N_per_m, computed.cosine) &&
         as_computed(mesh.stiffness_sin_N_per_m, computed.sine);
}

/// Harmonics that were computed with another mean keep their amplitudes.
void check_mean(Warnings& out, const std::string& pointer, const Mesh& mesh, const FourierSeries& computed,
                const std::string& factor) {
  if (!has_harmonics_of(mesh, computed)) return;
  const double ratio = mesh.stiffness_N_per_m / computed.mean;
  constexpr double unlike = 0.01;
  if (std::abs(ratio - 1.0) > unlike)
    out.add(Rank::doubtful, std::abs(ratio - 1.0) / unlike, pointer + "/stiffness_N_per_m", "mean", "is ",
            mesh.stiffness_N_per_m, " N/m, but its harmonics are those of the computed mean of ", computed.mean,
            " N/m: relative to the mean they are ", 1.0 / ratio, " times as large; ", factor,
            " in /catalogue/mesh_stiffness scales both");
}

void check_assembly(Warnings& out, const Stage& s) {
  for (const Misfit& m : assembly_misfits(s)) {
    const double cycles = (*s.sun.teeth + *s.ring.teeth) * (m.angle_deg - s.planet_angles_deg()[0]) / 360.0;
    out.add(Rank::impossible, 1.0,
            s.angles_deg.empty() ? "/planets/count" : "/planets/angles_deg/" + std::to_string(m.planet),
            "assembly of planet " + std::to_string(m.planet + 1), "planet ", static_cast<double>(m.planet + 1), " at ",
            m.angle_deg, " deg cannot be assembled: (z_s + z_r)(phi_i - phi_1) / 360 deg = ", cycles,
            " is not whole; it could at ", std::fmod(m.nearest_deg, 360.0), " deg");
  }
}

void check_damping(Warnings& out, const std::string& pointer, double stiffness, double mass,
                   const SupportDamping& damping) {
  if (!(stiffness > 0.0) || !std::isfinite(stiffness)) return;
  const double c = damping.of(stiffness, mass);
  if (c == 0.0)
    out.add(Rank::note, 1.0, pointer, "damping",
            "has a support without damping; oscillations of its modes may never decay");
  const double ratio = c / (2.0 * std::sqrt(stiffness * mass));
  if (ratio >= 1.0)
    out.add(Rank::doubtful, ratio, pointer, "damping", "its support is damped ", ratio,
            " times critically; steel in bearings has 0.01 to 0.1");
}

void check_mesh_damping(Warnings& out, const std::string& pointer, const Mesh& mesh) {
  if (const double ratio = mesh.damping_ratio.value_or(0.0); ratio >= 1.0)
    out.add(Rank::doubtful, ratio, pointer + "/damping_ratio", "damping", "is ", ratio,
            ", at or above critical; meshes have 0.03 to 0.17");
  else if (mesh.damping_ratio && ratio < mesh_damping_least)
    out.add(Rank::note, 1.0, pointer + "/damping_ratio", "damping", "is ", ratio,
            ": oscillations may never decay; meshes have 0.03 to 0.17");
}

/// Largest error of a gear by ISO 1328-1: the total pitch deviation of its coarsest grade [um].
double coarsest_error_um(double module, int teeth) {
  constexpr int coarsest_grade = 12;
  constexpr double any_width_mm = 20.0;  // no matter
  try {
    return tolerances(coarsest_grade, module, module * teeth, any_width_mm, 1.0).cumulative_pitch;
  } catch (const DomainError&) {  // beyond the sizes of the standard
    return 1e3 * error_most * module;
  }
}

void check_error(Warnings& out, const std::string& pointer, const Mesh& mesh, double module, int teeth) {
  const double largest_um = std::ranges::max(mesh.error_amplitude_um);
  const double most_um = coarsest_error_um(module, teeth);
  if (largest_um > most_um)
    out.add(Rank::doubtful, largest_um / most_um, pointer + "/error_amplitude_um", "error", "is ", largest_um, " um, ",
            1e-3 * largest_um / module, " modules; the total pitch deviation of the coarsest grade of ISO 1328 is ",
            most_um, " um");
}

/// A member whose support yields to its own weight by more than a module.
void check_sag(Warnings& out, const std::string& pointer, double mass, double stiffness, double module) {
  if (!(stiffness > 0.0) || !std::isfinite(stiffness)) return;
  const double modules = 1e3 * mass * gravity / stiffness / module;
  constexpr double beyond_any_machine = 1e9;
  if (modules > beyond_any_machine)
    out.add(Rank::doubtful, beyond_any_machine, pointer, "support", "is ", stiffness,
            " N/m, which its own weight moves by more than ", beyond_any_machine,
            " modules; a member that floats has 0, bearings 1e6 to 1e9 N/m");
  else if (modules > 1.0)
    out.add(Rank::doubtful, modules, pointer, "support", "is ", stiffness, " N/m, which its own weight moves by ",
            modules * module, " mm, ", modules, " modules; a member that floats has 0, bearings 1e6 to 1e9 N/m");
}

/// One mesh with another kind of friction than the other.
void check_friction(Warnings& out, const Stage& s) {
  const auto words = [](const Friction& f) {
    return f.ehl ? "lubricated contact" : f.coefficient ? "a coefficient of friction" : f.table ? "a table" : "none";
  };
  if (s.is_pair()) return;
  const std::string sun = words(s.sun_planet_mesh.friction);
  const std::string ring = words(s.ring_planet_mesh.friction);
  if (sun != ring)
    out.add(Rank::doubtful, 1.0, "/lumped/ring_planet_mesh/friction", "friction",
            "the two meshes have different kinds of friction: sun-planet ", sun, ", ring-planet ", ring,
            "; give both the same, unless it is meant");
}

/// m of the drawing, or of teeth of 20 degrees.
double module_mm(const Stage& s) {
  if (s.catalogue) return s.catalogue->planet.data.module_mm;
  return 2.0 * *s.planet.base_radius_mm / (*s.planet.teeth * std::cos(20.0 * radian));
}

/// A stage for modes alone has no module to measure gaps by.
void check_gaps(Warnings& out, const Stage& s) {
  if (!s.planet.teeth || !s.planet.base_radius_mm || !s.centre_distance_mm) return;
  const double module = module_mm(s);
  const auto backlash = [&](const std::string& pointer, const std::string& mesh, const Mesh& m) {
    check_backlash(out, pointer + "/backlash_half_um", mesh, 2e-3 * m.backlash_half_um, *s.centre_distance_mm, module,
                   "; the key takes half of it");
  };
  backlash("/lumped/sun_planet_mesh", "sun-planet", s.sun_planet_mesh);
  if (!s.is_pair()) backlash("/lumped/ring_planet_mesh", "ring-planet", s.ring_planet_mesh);
  const auto clearance = [&](const char* pointer, const char* member, double half_um) {
    const double modules = 1e-3 * half_um / module;
    if (modules > half_clearance_most)
      out.add(Rank::doubtful, modules / half_clearance_most, pointer, "clearance", "is ", half_um, " um, ", modules,
              " modules: the ", member, " may move out of its meshes before its bearing holds it");
  };
  clearance("/lumped/sun/bearing_clearance_half_um", "sun", s.sun_bearing.clearance_half_um);
  clearance("/lumped/planet/bearing_clearance_half_um", "planet", s.planet.bearing_clearance_half_um.value_or(0.0));
  check_error(out, "/lumped/sun_planet_mesh", s.sun_planet_mesh, module, *s.planet.teeth);
  check_sag(out, "/lumped/sun/support_N_per_m", s.sun.mass_kg, s.sun.support_N_per_m, module);
  if (s.is_pair()) return;
  check_error(out, "/lumped/ring_planet_mesh", s.ring_planet_mesh, module, *s.planet.teeth);
  check_sag(out, "/lumped/ring/support_N_per_m", s.ring.mass_kg, s.ring.support_N_per_m, module);
  check_sag(out, "/lumped/carrier/support_N_per_m", s.carrier.mass_kg, s.carrier.support_N_per_m, module);
  check_sag(out, "/lumped/planet/bearing_N_per_m", s.planet.mass_kg, s.planet.bearing_N_per_m, module);
}

void check_speed(Warnings& out, const std::string& pointer, const std::string& what, double angular, double radius_mm,
                 double density) {
  const double speed = std::abs(angular) * radius_mm * 1e-3;
  const double stress = density * speed * speed;
  if (stress > strength_Pa)
    out.add(Rank::impossible, speed / std::sqrt(strength_Pa / density), pointer, "speed", what, " run at ", speed,
            " m/s (", std::abs(angular) * rpm, " rpm): a rim at that speed bears ", 1e-6 * stress,
            " MPa of hoop stress, and gear steel breaks at some ", 1e-6 * strength_Pa, " MPa");
}

void check_deflection(Warnings& out, const std::string& pointer, const std::string& what, double force,
                      double stiffness, double module) {
  const double modules = 1e3 * force / stiffness / module;
  if (!std::isfinite(modules))
    out.add(Rank::impossible, std::numeric_limits<double>::max(), pointer, "deflection", what, " with ", stiffness,
            " N/m holds nothing against the static load of ", force, " N");
  else if (modules > 1.0)
    out.add(Rank::impossible, modules, pointer, "deflection", what, " yields by ", modules * module, " mm, ", modules,
            " modules, under the static load");
}

void check_pressure(Warnings& out, const EhlFriction& contact, const LineOfAction& line, const MeshLoad& load,
                    const std::string& mesh) {
  const double pressure = lubrication_range(contact, line, load).greatest_pressure_GPa;
  if (pressure > pressure_most_GPa)
    out.add_once(Rank::impossible, pressure / pressure_most_GPa, "/load", "force", "the mean force of the ", mesh,
                 " mesh, ", load.force_N, " N on a width of ", contact.width_mm, " mm, presses its flanks with ",
                 pressure, " GPa; the best case-hardened steel bears ", pressure_most_GPa, " GPa, and at rest only");
  if (pressure > 0.0 && pressure < pressure_least_GPa)
    out.add_once(Rank::doubtful, pressure_least_GPa / pressure, "/load", "force", "the mean force of the ", mesh,
                 " mesh, ", load.force_N, " N on a width of ", contact.width_mm, " mm, presses its flanks with ",
                 1e3 * pressure, " MPa: next to no load; gears under load have 300 to 1500 MPa");
}

void check_density(Warnings& out, double density) {
  const double beyond = std::max(density_least / density, density / density_most);
  if (beyond > 1.0)
    out.add(Rank::doubtful, beyond, "/catalogue/material/density_kg_per_m3", "density", "is ", density,
            " kg/m^3; plastics have 1000, steel 7850, tungsten 19300");
}

/// Pins and plates that could not hold the planets.
void check_carrier(Warnings& out, const CarrierBody& b, const GearSet& set) {
  const auto doubtful = [&](const char* key, double measure, const auto&... words) {
    out.add(Rank::doubtful, measure, std::string("/catalogue/carrier/body/") + key, "carrier", words...);
  };
  const double circle_mm = 2.0 * set.centre_distance_mm;
  if (b.outer_diameter_mm < circle_mm)
    doubtful("outer_diameter_mm", circle_mm / b.outer_diameter_mm, "is ", b.outer_diameter_mm,
             " mm, and the pins' axes lie outside of such plates, on a circle of ", circle_mm, " mm");
  if (b.inner_diameter_mm > circle_mm)
    doubtful("inner_diameter_mm", b.inner_diameter_mm / circle_mm, "is ", b.inner_diameter_mm,
             " mm, and the pins' axes lie inside of it, on a circle of ", circle_mm, " mm");
  const double bore_mm = set.catalogue.planet.bore_mm;
  if (bore_mm > 0.0 && b.pin_diameter_mm > bore_mm)
    doubtful("pin_diameter_mm", b.pin_diameter_mm / bore_mm, "is ", b.pin_diameter_mm,
             " mm, more than the planets' bore of ", bore_mm, " mm");
  const double width_mm = set.planet.width_mm;
  if (b.pin_length_mm < width_mm)
    doubtful("pin_length_mm", width_mm / b.pin_length_mm, "is ", b.pin_length_mm,
             " mm, less than the planets' face width of ", width_mm, " mm");
  if (b.plate_thickness_mm < plate_least * width_mm)
    doubtful("plate_thickness_mm", plate_least * width_mm / b.plate_thickness_mm, "is ", b.plate_thickness_mm,
             " mm beside planets of ", width_mm, " mm");
}

}  // namespace

std::vector<Warning> catalogue_warnings(const GearSet& set) {
  Warnings out;
  check_tooth(out, set.sun, sun_pointer);
  check_tooth(out, set.planet, planet_pointer);
  if (!set.is_pair()) check_tooth(out, set.ring, ring_pointer);
  // Wide meshes mostly come from tooth numbers that no centre distance suits.
  const std::string remedy = set.is_pair() ? std::string() : ring_misfit(set);
  const std::string words = sun_planet_words(set.is_pair());
  check_pair(out, set.sun_planet.pair, sun_pointer, planet_pointer, words, remedy);
  if (!set.is_pair()) check_pair(out, set.ring_planet.pair, planet_pointer, ring_pointer, "ring-planet", remedy);
  if (!set.is_pair() && ring_shift_has_other_sign(set))
    out.add(Rank::doubtful, 1.0, ring_pointer + "/profile_shift", "sign", "is ", set.ring.profile_shift, " and leaves ",
            set.ring_planet.pair.backlash_mm(), " mm of backlash in the ring-planet mesh", remedy);
  check_widths(out, set.sun_planet, sun_pointer, planet_pointer, words);
  if (!set.is_pair()) check_widths(out, set.ring_planet, planet_pointer, ring_pointer, "ring-planet");
  if (set.catalogue.ring.base_pitch == BasePitch::of_planet && set.base_pitch_mismatch_mm != 0.0)
    out.add(Rank::note, 1.0, ring_pointer + "/module_mm", "module", "replaced: ", set.catalogue.ring.data.module_mm,
            " mm would give base pitches that differ by ", 1e3 * std::abs(set.base_pitch_mismatch_mm), " um; ",
            set.ring_module_mm, " mm is used");
  if (!set.is_pair() && planet_gap_mm(set) < planet_gap_usual * set.planet.module_mm)
    out.add(Rank::note, 1.0, "/planets/count", "gap", "neighbouring planets leave a gap of ", planet_gap_mm(set),
            " mm only");
  check_density(out, set.catalogue.material.density_kg_per_m3);
  if (set.catalogue.carrier.body) check_carrier(out, *set.catalogue.carrier.body, set);
  check_body(out, set.sun_planet, set.sun_planet.driving, set.catalogue.sun.bore_mm, sun_pointer);
  check_body(out, set.sun_planet, set.sun_planet.driven, set.catalogue.planet.bore_mm, planet_pointer);
  if (const auto outer = set.catalogue.ring.outer_diameter_mm) {
    const double rim = 0.5 * *outer - set.ring.root_radius_mm;
    const double usual = ring_rim_usual * set.ring.module_mm;
    if (rim < usual)
      out.add(Rank::note, usual / rim, ring_pointer + "/outer_diameter_mm", "rim", "leaves a rim of ", rim,
              " mm under the teeth; the mesh stiffness counts no bending of a rim, which ISO 6336-3 (Y_B) does below ",
              usual, " mm, ", ring_rim_usual, " modules");
  }
  return out.take();
}

std::vector<Warning> catalogue_warnings(const GearSet& set, const Stage& stage) {
  Warnings out;
  check_iso(out, "/lumped/sun_planet_mesh", stage.sun_planet_mesh.stiffness_N_per_m, set.sun_planet);
  if (!set.is_pair())
    check_iso(out, "/lumped/ring_planet_mesh", stage.ring_planet_mesh.stiffness_N_per_m, set.ring_planet);
  check_mean(out, "/lumped/sun_planet_mesh", stage.sun_planet_mesh, set.sun_planet_stiffness, "sun_planet_factor");
  if (!set.is_pair())
    check_mean(out, "/lumped/ring_planet_mesh", stage.ring_planet_mesh, set.ring_planet_stiffness,
               "ring_planet_factor");
  const Bodies of_drawings = bodies(set);
  const auto member = [&](const std::string& name, const auto& m, double radius_mm,
                          const std::optional<MassAndInertia>& body) {
    check_member(out, name, m.mass_kg, m.inertia_over_r2_kg, radius_mm, body);
  };
  member("sun", stage.sun, set.sun.base_radius_mm, of_drawings.sun);
  member("planet", stage.planet, set.planet.base_radius_mm, of_drawings.planet);
  if (!set.is_pair()) {
    member("ring", stage.ring, set.ring.base_radius_mm, of_drawings.ring);
    member("carrier", stage.carrier, set.centre_distance_mm, of_drawings.carrier);
  }
  std::vector<Warning> all = catalogue_warnings(set);
  std::ranges::move(out.take(), std::back_inserter(all));
  return all;
}

std::vector<Warning> mass_warnings(const Stage& s) {
  Warnings out;
  if (!s.catalogue && !s.is_pair())
    for (const auto& [name, mass, inertia] :
         {std::tuple("sun", s.sun.mass_kg, s.sun.inertia_over_r2_kg),
          std::tuple("planet", double{s.planet.mass_kg}, double{s.planet.inertia_over_r2_kg}),
          std::tuple("ring", s.ring.mass_kg, s.ring.inertia_over_r2_kg),
          std::tuple("carrier", s.carrier.mass_kg, s.carrier.inertia_over_r2_kg)})
      check_member(out, name, mass, inertia, 0.0, std::nullopt);
  return out.take();
}

std::vector<Warning> truncation_warnings(const GearSet& set, const Stage& stage) {
  Warnings out;
  const auto check = [&](const std::string& words, const Mesh& mesh, const MeshedPair& pair,
                         const FourierSeries& series) {
    if (mesh.stiffness_curve || !has_harmonics_of(mesh, series)) return;
    const auto variation = [](const StiffnessRange& range) { return range.greatest - range.least; };
    const double of_series = variation(stiffness_range(series));
    const double of_curve = variation(stiffness_range(pair));
    const double off = std::abs(of_series / of_curve - 1.0);
    if (off > truncation_most)
      out.add(Rank::doubtful, off / truncation_most, "/catalogue/mesh_stiffness/form", words,
              static_cast<double>(series.cosine.size()), " harmonics of the stiffness of the ", words, " mesh vary by ",
              of_series, " N/m from peak to peak, in place of ", of_curve, " N/m of the whole curve, ",
              std::round(100.0 * (of_series / of_curve - 1.0)), " %; \"form\": \"curve\" takes all of it");
  };
  check(sun_planet_words(set.is_pair()), stage.sun_planet_mesh, set.sun_planet, set.sun_planet_stiffness);
  if (!set.is_pair()) check("ring-planet", stage.ring_planet_mesh, set.ring_planet, set.ring_planet_stiffness);
  return out.take();
}

std::vector<Warning> warnings_for_dynamics(const Stage& s) {
  Warnings out;
  check_assembly(out, s);
  check_damping(out, "/lumped/sun", s.sun.support_N_per_m, s.sun.mass_kg, s.sun.damping);
  if (s.planet_count == 2 && s.sun.support_N_per_m == 0.0)
    out.add(Rank::doubtful, 1.0, "/lumped/sun/support_N_per_m", "floating sun",
            "is 0 with two planets: nothing holds the sun across them, and it drifts away");
  if (!s.is_pair()) {
    check_damping(out, "/lumped/ring", s.ring.support_N_per_m, s.ring.mass_kg, s.ring.damping);
    check_damping(out, "/lumped/carrier", s.carrier.support_N_per_m, s.carrier.mass_kg, s.carrier.damping);
    check_mesh_damping(out, "/lumped/ring_planet_mesh", s.ring_planet_mesh);
  }
  check_damping(out, "/lumped/planet", s.planet.bearing_N_per_m, s.planet.mass_kg, s.planet.damping);
  check_mesh_damping(out, "/lumped/sun_planet_mesh", s.sun_planet_mesh);
  check_gaps(out, s);
  check_friction(out, s);
  return out.take();
}

std::vector<Warning> warnings_at(const Stage& s, double mesh_frequency, const GearSet* set) {
  Warnings out;
  if (!problems_for_dynamics(s).empty()) return {};
  const double density = s.catalogue ? s.catalogue->material.density_kg_per_m3 : Material{}.density_kg_per_m3;
  const Speeds w = speeds(s, mesh_frequency);
  check_speed(out, "/lumped/sun", "its teeth", w.sun, *s.sun.base_radius_mm, density);
  check_speed(out, "/lumped/planet", "its teeth", carrier_speed(s, mesh_frequency) - mesh_frequency / *s.planet.teeth,
              *s.planet.base_radius_mm, density);
  if (!s.is_pair()) check_speed(out, "/lumped/carrier", "the planets' axes", w.carrier, *s.centre_distance_mm, density);

  const MeshLoad load = mean_mesh_load(s, mesh_frequency);
  const PressureAngles alpha = pressure_angles(s);
  const double module = module_mm(s);
  const auto mesh = [&](const std::string& name, const Mesh& m, const LineOfAction& line, const MeshedPair* pair) {
    check_deflection(out, "/lumped/" + name + "_mesh/stiffness_N_per_m", "the mesh", load.force_N, m.stiffness_N_per_m,
                     module);
    const std::string words = name == "sun_planet" ? sun_planet_words(s.is_pair()) : "ring-planet";
    if (pair != nullptr)
      check_pressure(out, ehl_of(*pair, Lubrication{}), line, load, words);
    else if (m.friction.ehl && !m.friction.ehl->share.empty())
      check_pressure(out, *m.friction.ehl, line, load, words);
  };
  mesh("sun_planet", s.sun_planet_mesh, sun_planet_line(s), set == nullptr ? nullptr : &set->sun_planet);
  if (!s.is_pair())
    mesh("ring_planet", s.ring_planet_mesh, ring_planet_line(s), set == nullptr ? nullptr : &set->ring_planet);
  check_deflection(out, "/lumped/planet/bearing_N_per_m", "the planet's bearing", mean_planet_load(s, mesh_frequency),
                   s.planet.bearing_N_per_m, module);
  if (s.boundary == Boundary::fixed_ring && std::isfinite(s.ring.torsional_support_N_per_m))
    check_deflection(out, "/lumped/ring/torsional_support_N_per_m", "the ring's torsional support",
                     s.planet_count * load.force_N, s.ring.torsional_support_N_per_m, module);
  if (s.boundary == Boundary::fixed_sun)
    check_deflection(out, "/lumped/sun/torsional_support_N_per_m", "the sun's torsional support",
                     s.planet_count * load.force_N, s.sun.torsional_support_N_per_m, module);
  if (s.boundary == Boundary::star)
    check_deflection(out, "/lumped/carrier/torsional_support_N_per_m", "the carrier's torsional support",
                     s.planet_count * load.force_N * (std::cos(alpha.sun_planet) + std::cos(alpha.ring_planet)),
                     s.carrier.torsional_support_N_per_m, module);
  return out.take();
}

}  // namespace epicyclic::gear
