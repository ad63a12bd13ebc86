#include "gear/gear_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "core/errors.hpp"
#include "core/fitted_rows.hpp"
#include "core/require.hpp"
#include "core/root_finding.hpp"
#include "core/text.hpp"
#include "gear/bearing.hpp"
#include "gear/messages.hpp"

namespace epicyclic::gear {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double radian = pi / 180.0;

// Base pitches that differ by more cannot be a matter of the table's digits, and the model needs r_br / r_bs = z_r /
// z_s.
constexpr double base_pitch_tolerance = 1e-4;
// A module that is off by more was not rounded, but is another one.
constexpr double rounded_module = 0.02;
// A nominal overlap of this share of the module is more than any rounding of a centre distance.
constexpr double overlap_tolerance = 0.01;
constexpr int message_digits = 6;

const std::string sun_pointer = "/catalogue/sun";
const std::string planet_pointer = "/catalogue/planet";
const std::string ring_pointer = "/catalogue/ring";

/// Beside the phase where a crowned pair touches, more rows are of little use.
double reachable(const LoadedContact& contact, double tolerance) {
  constexpr double of_crowned = 1e-5;
  return contact.is_crowned() ? std::max(tolerance, of_crowned) : tolerance;
}

GearData of_planet_base_pitch(GearData ring, const GearData& planet) {
  ring.module_mm =
      planet.module_mm * std::cos(planet.pressure_angle_deg * radian) / std::cos(ring.pressure_angle_deg * radian);
  return ring;
}

double base_pitch(const GearData& d) { return pi * d.module_mm * std::cos(d.pressure_angle_deg * radian); }

ToothBody body_of(const ExternalGear& gear, const Tooth& tooth, const Material& material) {
  ToothBody body{tooth, material, gear.body_radius_ratio, {}};
  if (gear.root_half_angle_deg) body.root_half_angle = *gear.root_half_angle_deg * radian;
  return body;
}

ToothBody body_of(const RingGear& gear, const Tooth& tooth, const Material& material) {
  ToothBody body{tooth, material, 1.0, {}};
  if (gear.root_half_angle_deg) body.root_half_angle = *gear.root_half_angle_deg * radian;
  return body;
}

/// [G-1]
double lead_of_ring_mesh(const Pair& sp, const Pair& rp) {
  const Tooth& planet = sp.driven;
  const double arc =
      planet.base_radius_mm * (pi + sp.pressure_angle + rp.pressure_angle + 2.0 * planet.base_half_angle);
  const double cycles = (arc - sp.arm_2_mm(sp.start_mm) - rp.start_mm) / sp.base_pitch_mm;
  return cycles - std::floor(cycles);
}

/// Teeth, pairs and phases, without stiffness.
GearSet geometry_of(const Stage& stage) {
  if (!stage.catalogue) throw DomainError("the stage has no catalogue data");
  const Catalogue& c = *stage.catalogue;
  c.stiffness.validate();
  GearSet set;
  set.catalogue = c;
  set.angles_deg = stage.planet_angles_deg();
  const GearData& s = c.sun.data;
  const GearData& p = c.planet.data;
  const Tooth sun_full = external_tooth(s);
  const Tooth planet_full = external_tooth(p);
  set.centre_distance_mm =
      stage.centre_distance_mm ? *stage.centre_distance_mm : tight_centre_distance_mm(sun_full, planet_full);
  if (c.tips == Tips::shortened) {
    const double reference = 0.5 * (s.teeth * s.module_mm + p.teeth * p.module_mm);
    set.tip_shortening =
        std::max(0.0, s.profile_shift + p.profile_shift - (set.centre_distance_mm - reference) / p.module_mm);
  }
  set.sun = external_tooth(s, set.tip_shortening);
  set.planet = external_tooth(p, set.tip_shortening);
  const ComplianceOptions& o = c.stiffness.compliance;
  set.sun_planet = {make_pair(set.sun, set.planet, set.centre_distance_mm), body_of(c.sun, set.sun, c.material),
                    body_of(c.planet, set.planet, c.material), o, c.stiffness.sun_planet_factor};
  if (set.is_pair()) return set;
  const GearData ring = c.ring.base_pitch == BasePitch::of_planet ? of_planet_base_pitch(c.ring.data, p) : c.ring.data;
  set.ring = internal_tooth(ring);
  set.ring_module_mm = ring.module_mm;
  set.base_pitch_mismatch_mm = base_pitch(p) - base_pitch(c.ring.data);
  set.ring_planet = {make_pair(set.planet, set.ring, set.centre_distance_mm), body_of(c.planet, set.planet, c.material),
                     body_of(c.ring, set.ring, c.material), o, c.stiffness.ring_planet_factor};
  set.ring_mesh_lead = lead_of_ring_mesh(set.sun_planet.pair, set.ring_planet.pair);
  return set;
}

/// @param remedy  for what overlaps; empty or from "; " on
void check_pair(Problems& out, const Pair& pair, const std::string& driving, const std::string& driven,
                const std::string& mesh, const std::string& remedy) {
  if (!(pair.contact_ratio() >= 1.0))
    out.add(driven, "the ", mesh, " mesh has a contact ratio of ", pair.contact_ratio(),
            ", below 1: contact would be lost between teeth (path ", pair.start_mm, " to ", pair.end_mm,
            " mm, base pitch ", pair.base_pitch_mm, " mm)");
  if (!(pair.contact_ratio() < 3.0))
    out.add(driven, "the ", mesh, " mesh has a contact ratio of ", pair.contact_ratio(), ", must be below 3");
  if (pair.start_mm < 0.0)
    out.add(driven, "its tip, radius ", pair.driven.tip_radius_mm, " mm, meets the ", mesh, " line of action ",
            -pair.start_mm, " mm before the tangent point of the driving member: involute interference");
  if (!pair.internal() && pair.end_mm > pair.theoretical_length_mm)
    out.add(driving, "its tip, radius ", pair.driving.tip_radius_mm, " mm, meets the ", mesh, " line of action ",
            pair.end_mm - pair.theoretical_length_mm,
            " mm behind the tangent point of the driven member: involute interference");
  if (pair.tip_clearance_1_mm() < 0.0)
    out.add(driving, "its tip cuts ", -pair.tip_clearance_1_mm(), " mm into the root of the other member of the ", mesh,
            " mesh", remedy);
  if (pair.tip_clearance_2_mm() < 0.0)
    out.add(driven, "its tip cuts ", -pair.tip_clearance_2_mm(), " mm into the root of the other member of the ", mesh,
            " mesh", remedy);
  if (pair.tip_passing_angle() < 0.0)
    out.add(driven, "tips of the ", mesh, " mesh collide outside the path of contact (trochoid interference, ",
            -pair.tip_passing_angle(), " rad)");
  if (pair.backlash_mm() < -overlap_tolerance * pair.driving.module_mm)
    out.add(driven, "teeth of the ", mesh, " mesh overlap by ", -pair.backlash_mm(),
            " mm on the operating pitch circle at the centre distance of ", pair.centre_distance_mm, " mm", remedy);
}

void check_tip(Problems& out, const Tooth& tooth, const std::string& pointer) {
  const double thickness = tooth.thickness_at(tooth.tip_radius_mm);
  if (thickness <= 0.0)
    out.add(pointer, "the tooth is pointed: thickness ", thickness, " mm at the tip radius of ", tooth.tip_radius_mm,
            " mm");
}

/// What no tool leaves standing: a rack whose flanks meet before it is as deep as the root, spaces of a ring that do.
void check_root(Problems& out, const Tooth& tooth, const GearData& data, const std::string& pointer) {
  if (tooth.internal) {
    const double space_mm =
        2.0 * tooth.root_radius_mm * (std::numbers::pi / tooth.teeth - tooth.half_angle_at(tooth.root_radius_mm));
    if (space_mm <= 0.0)
      out.add(pointer, "its teeth meet before the root radius of ", tooth.root_radius_mm, " mm: the space there is ",
              space_mm, " mm wide");
  } else if (!data.root_diameter_mm && tooth.rack_tip_width() <= 0.0) {
    out.add(pointer, "the rack that cuts it is pointed before its depth of ", tooth.rack_depth(), " modules: at ",
            data.pressure_angle_deg, " degrees its flanks meet at ",
            0.25 * std::numbers::pi / std::tan(tooth.pressure_angle), " modules");
  }
}

/// A DomainError of `make` as a problem of the pointer.
bool tried(Problems& out, const std::string& pointer, const std::function<void()>& make) {
  try {
    make();
    return true;
  } catch (const DomainError& error) {
    out.add(pointer, error.what());
    return false;
  }
}

/// Contact on the fillet has no stiffness in this model.
void check_fillet(Problems& out, const GearSet& set) {
  if (set.catalogue.stiffness.compliance.fillet != Fillet::trochoid) return;
  const auto lowest = [&](const std::string& pointer, const std::string& mesh, double radius, const Tooth& tooth) {
    constexpr double rounding = 1e-9;
    if (radius < tooth.form_radius_mm() * (1.0 - rounding))
      out.add(pointer, "contact of the ", mesh, " mesh reaches down to radius ", radius,
              " mm, onto the fillet that begins at ", tooth.form_radius_mm(),
              " mm: a shorter tip of the other member, or \"fillet\": \"none\"");
  };
  const Pair& sp = set.sun_planet.pair;
  const Pair& rp = set.ring_planet.pair;
  const std::string words = sun_planet_words(set.is_pair());
  lowest(sun_pointer, words, sp.radius_1_mm(sp.start_mm), set.sun);
  lowest(planet_pointer, words, sp.radius_2_mm(sp.end_mm), set.planet);
  if (!set.is_pair()) lowest(planet_pointer, "ring-planet", rp.radius_1_mm(rp.start_mm), set.planet);
}

void check_bodies(Problems& out, const GearSet& set) {
  const CarrierData& carrier_data = set.catalogue.carrier;
  if (carrier_data.body && carrier_data.body->inner_diameter_mm >= carrier_data.body->outer_diameter_mm)
    out.add("/catalogue/carrier/body/inner_diameter_mm", "is ", carrier_data.body->inner_diameter_mm,
            ", must be smaller than outer_diameter_mm = ", carrier_data.body->outer_diameter_mm);
  if (carrier_data.shaft && carrier_data.shaft->inner_diameter_mm >= carrier_data.shaft->diameter_mm)
    out.add("/catalogue/carrier/shaft/inner_diameter_mm", "is ", carrier_data.shaft->inner_diameter_mm,
            ", must be smaller than diameter_mm = ", carrier_data.shaft->diameter_mm);
}

void check_accuracy(Problems& out, const GearSet& set) {
  const auto member = [&](const std::string& pointer, std::optional<int> grade, const Tooth& t, double contact_ratio) {
    if (!grade) return;
    try {
      (void)tolerances(*grade, t.module_mm, 2.0 * t.reference_radius_mm, t.width_mm, contact_ratio);
    } catch (const DomainError& error) {
      out.add(pointer + "/accuracy_grade", error.what(), "; without accuracy_grade, give error_amplitude_um in lumped");
    }
  };
  const Catalogue& c = set.catalogue;
  member(sun_pointer, c.sun.accuracy_grade, set.sun, set.sun_planet.contact_ratio());
  member(planet_pointer, c.planet.accuracy_grade, set.planet, set.sun_planet.contact_ratio());
  if (c.has_ring()) member(ring_pointer, c.ring.accuracy_grade, set.ring, set.ring_planet.contact_ratio());
}

/// Reports each member whose data make no tooth.
bool each_tooth_exists(Problems& out, const Catalogue& c) {
  const bool sun = tried(out, sun_pointer, [&] { (void)external_tooth(c.sun.data); });
  const bool planet = tried(out, planet_pointer, [&] { (void)external_tooth(c.planet.data); });
  const bool ring = !c.has_ring() || tried(out, ring_pointer, [&] { (void)internal_tooth(c.ring.data); });
  return sun && planet && ring;
}

void check_base_pitches(Problems& out, const Catalogue& c) {
  const double sun_pitch = base_pitch(c.sun.data);
  const double planet_pitch = base_pitch(c.planet.data);
  if (std::abs(sun_pitch / planet_pitch - 1.0) > base_pitch_tolerance)
    out.add(planet_pointer + "/module_mm", "base pitches of ", c.has_ring() ? "sun and planet" : "both gears",
            " differ: ", sun_pitch, " and ", planet_pitch, " mm; teeth of one pitch only can mesh");
  if (!c.has_ring()) return;
  const double ring_pitch = base_pitch(c.ring.data);
  if (c.ring.base_pitch == BasePitch::of_planet && std::abs(ring_pitch / planet_pitch - 1.0) > rounded_module)
    out.add(ring_pointer + "/module_mm", "is ", c.ring.data.module_mm,
            " mm; \"base_pitch\": \"of_planet\" makes up for rounding, not for a module that is ",
            100.0 * std::abs(ring_pitch / planet_pitch - 1.0), " % off (at most ", 100.0 * rounded_module, " %; ",
            of_planet_base_pitch(c.ring.data, c.planet.data).module_mm, " mm would fit)");
  if (c.ring.base_pitch == BasePitch::as_given && std::abs(ring_pitch / planet_pitch - 1.0) > base_pitch_tolerance)
    out.add(ring_pointer + "/module_mm", "base pitches of planet and ring differ by ",
            1e3 * std::abs(planet_pitch - ring_pitch), " um (", planet_pitch, " and ", ring_pitch,
            " mm); if the module is rounded, \"base_pitch\": \"of_planet\" takes ",
            of_planet_base_pitch(c.ring.data, c.planet.data).module_mm, " mm in its place");
}

/// First and last bearing of each series: "6004 to 6024, ...".
std::string known_series() {
  std::string known;
  // The last two digits are the bore.
  const auto series = [](std::string_view name) { return name.substr(0, name.find_last_of("0123456789") - 1); };
  const std::span<const BearingType> types = bearing_types();
  for (std::size_t k = 0; k < types.size();) {
    std::size_t last = k;
    while (last + 1 < types.size() && series(types[last + 1].designation) == series(types[k].designation)) ++last;
    known +=
        (known.empty() ? "" : ", ") + std::string(types[k].designation) + " to " + std::string(types[last].designation);
    k = last + 1;
  }
  return known;
}

void check_bearing_types(Problems& out, const Catalogue& c) {
  for (const auto& [pointer, bearing] :
       {std::pair("/catalogue/sun_bearing", &c.sun_bearing), std::pair("/catalogue/planet_bearing", &c.planet_bearing),
        std::pair("/catalogue/carrier/bearing", &c.carrier.bearing)})
    if (*bearing && !bearing_data(**bearing))
      out.add(std::string(pointer) + "/type", "\"", (*bearing)->type, "\" is not among the bearings known here (",
              known_series(), "); give balls and ball_diameter_mm, or rollers and roller_length_mm, instead");
}

/// Whether sun and planet mesh at the centre distance, that of the data or without backlash.
bool meshes_at_its_distance(Problems& out, const Stage& stage) {
  return tried(out, stage.centre_distance_mm ? "/planets/centre_distance_mm" : planet_pointer, [&] {
    const Tooth sun = external_tooth(stage.catalogue->sun.data);
    const Tooth planet = external_tooth(stage.catalogue->planet.data);
    (void)make_pair(sun, planet,
                    stage.centre_distance_mm.value_or(0.0) > 0.0 ? *stage.centre_distance_mm
                                                                 : tight_centre_distance_mm(sun, planet));
  });
}

/// A stage has a ring; a pair has neither ring nor carrier.
void check_members(Problems& out, const Stage& stage) {
  const Catalogue& c = *stage.catalogue;
  if (!stage.is_pair()) {
    if (!c.has_ring()) out.add(ring_pointer, "is missing: the drawing of the ring; only a pair has none");
    return;
  }
  const std::string alone = "must be left out: a pair has gear 1 (sun) and gear 2 (planet) alone";
  if (c.has_ring()) out.add(ring_pointer, alone);
  if (c.carrier.body || c.carrier.bearing || c.carrier.shaft)
    out.add("/catalogue/carrier", alone, "; bearings are sun_bearing and planet_bearing");
  if (c.stiffness.ring_planet_factor != 1.0)
    out.add("/catalogue/mesh_stiffness/ring_planet_factor",
            "must be left out: a pair has one mesh, which sun_planet_factor is for");
}

/// Reliefs within their flanks, and a load.
void check_modified_flanks(Problems& out, const Stage& stage, const GearSet& set) {
  if (!design_torque_Nm(stage))
    out.add("/catalogue/mesh_stiffness/design_torque_Nm",
            "is missing; relief and crowning need the torque on the sun for which their contact is computed, unless "
            "the load is a torque");
  constexpr double any_force_N = 1.0;
  const GearData none{};
  const auto check = [&](const std::string& pointer, const MeshedPair& mesh, const GearData& first,
                         const GearData& second) {
    tried(out, pointer, [&] { (void)LoadedContact(mesh, first, second, any_force_N); });
  };
  const Catalogue& c = set.catalogue;
  check(sun_pointer, set.sun_planet, c.sun.data, none);
  check(planet_pointer, set.sun_planet, none, c.planet.data);
  if (set.is_pair()) return;
  check(planet_pointer, set.ring_planet, c.planet.data, none);
  check(ring_pointer, set.ring_planet, none, c.ring.data);
}

/// Planets beside each other, bores and the rim.
/// @param evenly  no angles are given
void check_room(Problems& out, const GearSet& set, bool evenly) {
  const Catalogue& c = set.catalogue;
  if (!set.is_pair() && planet_gap_mm(set) <= 0.0)
    out.add(evenly ? "/planets/count" : "/planets/angles_deg", "neighbouring planets overlap by ", -planet_gap_mm(set),
            " mm (tip radius ", set.planet.tip_radius_mm, " mm, centre distance ", set.centre_distance_mm, " mm)");
  const auto bore = [&](const ExternalGear& gear, const Tooth& tooth, const std::string& pointer) {
    if (0.5 * gear.bore_mm >= tooth.root_radius_mm)
      out.add(pointer + "/bore_mm", "the bore, ", gear.bore_mm, " mm, must be smaller than the root circle, ",
              2.0 * tooth.root_radius_mm, " mm");
  };
  bore(c.sun, set.sun, sun_pointer);
  bore(c.planet, set.planet, planet_pointer);
  if (c.ring.outer_diameter_mm && 0.5 * *c.ring.outer_diameter_mm <= set.ring.root_radius_mm)
    out.add(ring_pointer + "/outer_diameter_mm", "the rim, ", *c.ring.outer_diameter_mm,
            " mm, must be larger than the root circle, ", 2.0 * set.ring.root_radius_mm, " mm");
}

}  // namespace

bool ring_shift_has_other_sign(const GearSet& set) {
  const double fits_mm = overlap_tolerance * set.planet.module_mm;
  if (!(std::abs(set.ring_planet.pair.backlash_mm()) > fits_mm)) return false;
  GearData other = set.catalogue.ring.data;
  if (set.catalogue.ring.base_pitch == BasePitch::of_planet)
    other = of_planet_base_pitch(other, set.catalogue.planet.data);
  other.profile_shift = -other.profile_shift;
  try {
    const Pair pair = make_pair(set.planet, internal_tooth(other), set.centre_distance_mm);
    return std::abs(pair.backlash_mm()) <= fits_mm && pair.tip_clearance_1_mm() >= 0.0 &&
           pair.tip_clearance_2_mm() >= 0.0;
  } catch (const DomainError&) {
    return false;  // no tooth, or no mesh
  }
}

std::string ring_misfit(const GearSet& set) {
  constexpr int digits = 7;
  if (ring_shift_has_other_sign(set))
    return "; with profile_shift = " + short_text(-set.ring.profile_shift, digits) +
           " both meshes fit: here positive makes the spaces of a ring wider, and some drawings have the other sign";
  const int reach = set.sun.teeth + 2 * set.planet.teeth;
  if (reach != set.ring.teeth)
    return "; z_s + 2 z_p = " + std::to_string(reach) + " is not z_r = " + std::to_string(set.ring.teeth) +
           ", which profile shifts and the centre distance have to make up for";
  if (set.planet.module_mm != set.ring.module_mm || set.planet.pressure_angle != set.ring.pressure_angle) return {};
  const double shift = set.sun.profile_shift + 2.0 * set.planet.profile_shift;
  constexpr double rounding = 1e-6;
  if (std::abs(shift - set.ring.profile_shift) < rounding) return {};
  return "; x_s + 2 x_p = " + short_text(shift, digits) +
         ", with which both meshes have one centre distance, is not x_r = " +
         short_text(set.ring.profile_shift, digits);
}

void StiffnessOptions::validate() const {
  compliance.validate();
  require(harmonics >= 0, "harmonics", harmonics, ">= 0");
  require(sun_planet_factor > 0.0, "sun_planet_factor", sun_planet_factor, "> 0");
  require(ring_planet_factor > 0.0, "ring_planet_factor", ring_planet_factor, "> 0");
  require(table_tolerance > 0.0, "table_tolerance", table_tolerance, "> 0");
}

std::optional<double> design_torque_Nm(const Stage& stage) {
  const std::optional<double>& own = stage.catalogue->stiffness.design_torque_Nm;
  if (own || !stage.load.torque_Nm) return own;
  return std::abs(*stage.load.torque_Nm);  // teeth are symmetric
}

LoadedContacts loaded_contacts(const GearSet& set, double torque_Nm) {
  const double planets = static_cast<double>(set.angles_deg.size());
  const double force_N = torque_Nm / (planets * set.sun.base_radius_mm * 1e-3);
  const auto contact = [&](MeshedPair mesh, const GearData& first, const GearData& second) {
    mesh.loaded = nullptr;
    return LoadedContact(mesh, first, second, force_N);
  };
  const Catalogue& c = set.catalogue;
  LoadedContacts contacts{contact(set.sun_planet, c.sun.data, c.planet.data), {}};
  if (!set.is_pair()) contacts.ring_planet = contact(set.ring_planet, c.planet.data, c.ring.data);
  return contacts;
}

GearSet make_gear_set(const Stage& stage) {
  GearSet set = geometry_of(stage);
  if (set.catalogue.is_modified()) {
    const std::optional<double> torque = design_torque_Nm(stage);
    if (!torque) throw DomainError("modified flanks need a torque");
    LoadedContacts contacts = loaded_contacts(set, *torque);
    const Catalogue& c = set.catalogue;
    if (c.sun.data.is_modified() || c.planet.data.is_modified())
      set.sun_planet.loaded = std::make_shared<LoadedContact>(std::move(contacts.sun_planet));
    if (contacts.ring_planet && (c.planet.data.is_modified() || c.ring.data.is_modified()))
      set.ring_planet.loaded = std::make_shared<LoadedContact>(std::move(*contacts.ring_planet));
  }
  const int harmonics = set.catalogue.stiffness.harmonics;
  set.sun_planet_stiffness = fourier_series(set.sun_planet, harmonics);
  if (!set.is_pair()) set.ring_planet_stiffness = fourier_series(set.ring_planet, harmonics);
  return set;
}

std::vector<std::string> catalogue_problems(const Stage& stage) {
  Problems out(message_digits);
  const Catalogue& c = *stage.catalogue;
  check_members(out, stage);
  auto lines = out.take();
  if (!lines.empty()) return lines;
  if (!each_tooth_exists(out, c)) return out.take();
  check_base_pitches(out, c);
  check_bearing_types(out, c);
  lines = out.take();
  if (!lines.empty()) return lines;
  if (!meshes_at_its_distance(out, stage)) return out.take();
  GearSet set;
  if (!tried(out, stage.is_pair() ? planet_pointer : ring_pointer, [&] { set = geometry_of(stage); }))
    return out.take();
  const bool pair = set.is_pair();
  check_pair(out, set.sun_planet.pair, sun_pointer, planet_pointer, sun_planet_words(pair), {});
  if (!pair) check_pair(out, set.ring_planet.pair, planet_pointer, ring_pointer, "ring-planet", ring_misfit(set));
  check_tip(out, set.sun, sun_pointer);
  check_tip(out, set.planet, planet_pointer);
  if (!pair) check_tip(out, set.ring, ring_pointer);
  check_root(out, set.sun, set.catalogue.sun.data, sun_pointer);
  check_root(out, set.planet, set.catalogue.planet.data, planet_pointer);
  if (!pair) check_root(out, set.ring, set.catalogue.ring.data, ring_pointer);
  check_room(out, set, stage.angles_deg.empty());
  lines = out.take();
  if (!lines.empty()) return lines;
  check_fillet(out, set);
  check_bodies(out, set);
  check_accuracy(out, set);
  lines = out.take();
  if (!lines.empty()) return lines;
  const bool stiff = tried(out, "/catalogue/mesh_stiffness", [&] {
    // Radii of contact rise or fall along the path: flanks that hold its ends hold all of it.
    for (const MeshedPair* mesh : {&set.sun_planet, &set.ring_planet})
      if (mesh == &set.sun_planet || !pair)
        for (const double position : {0.0, mesh->contact_ratio()}) (void)mesh->pair_stiffness(position);
    (void)bodies(set);
  });
  if (stiff && c.is_modified()) check_modified_flanks(out, stage, set);
  return out.take();
}

std::vector<PlanetPhases> planet_phases(const GearSet& set) {
  const auto wrapped = [](double cycles) {
    constexpr double resolution = 1e-11;
    const double w = cycles - std::floor(cycles);
    return w > 1.0 - resolution ? 0.0 : w;
  };
  std::vector<PlanetPhases> phases;
  for (const double angle : set.angles_deg) {
    const double revolution = (angle - set.angles_deg.front()) / 360.0;
    phases.push_back({wrapped(-set.sun.teeth * revolution), wrapped(set.ring.teeth * revolution + set.ring_mesh_lead)});
  }
  return phases;
}

double planet_gap_mm(const GearSet& set) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < set.angles_deg.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double half = 0.5 * std::abs(std::remainder(set.angles_deg[i] - set.angles_deg[j], 360.0)) * radian;
      least = std::min(least, 2.0 * (set.centre_distance_mm * std::sin(half) - set.planet.tip_radius_mm));
    }
  return least;
}

namespace {

/// Rows of a periodic function that is smooth between breakpoints, the first of which is 0.
struct PeriodicRows {
  std::vector<double> phase, value;
  double error = 0;
};

/// @param f      value at a phase, within the part of another phase
/// @param jumps  both sides of each breakpoint; else one row there
template <class F>
PeriodicRows periodic_rows(const std::vector<double>& breaks, double tolerance, bool jumps, const F& f) {
  PeriodicRows rows;
  for (std::size_t k = 0; k < breaks.size(); ++k) {
    const bool last = k + 1 == breaks.size();
    const double from = breaks[k];
    const double to = last ? 1.0 : breaks[k + 1];
    const auto phase = [&](double fraction) { return fraction == 1.0 ? to : from + (to - from) * fraction; };
    const auto fitted =
        fit_rows<1>([&](double fraction) { return std::array{f(phase(fraction), 0.5 * (from + to))}; }, tolerance);
    for (std::size_t i = 0; i < fitted.grid.count + (last || !jumps ? 0 : 1); ++i) {
      rows.phase.push_back(phase(fitted.grid.fraction(i)));
      rows.value.push_back(fitted.rows[i][0]);
    }
    rows.error = std::max(rows.error, fitted.error);
    if (!last || !jumps) continue;
    // The left side of the first breakpoint, phase 0, is the end of the period.
    rows.phase.insert(rows.phase.begin(), 0.0);
    rows.value.insert(rows.value.begin(), fitted.rows.back()[0]);
  }
  return rows;
}

}  // namespace

StiffnessCurve stiffness_curve(const MeshedPair& mesh, double tolerance) {
  StiffnessCurve curve;
  curve.breakpoints = mesh.breakpoints();
  curve.interpolation = Interpolation::smooth;
  const double mean = fourier_series(mesh, 0).mean;
  const double reached = mesh.loaded ? reachable(*mesh.loaded, tolerance) : tolerance;
  PeriodicRows rows = periodic_rows(curve.breakpoints, reached * mean, true,
                                    [&](double phase, double inside) { return mesh.stiffness(phase, inside); });
  curve.phase = std::move(rows.phase);
  curve.stiffness_N_per_m = std::move(rows.value);
  curve.error = rows.error / mean;
  return curve;
}

ErrorCurve error_curve(const LoadedContact& contact, double tolerance) {
  ErrorCurve curve;
  curve.breakpoints = contact.breakpoints();
  curve.interpolation = Interpolation::smooth;
  double largest = 0.0;
  constexpr int samples = 100;
  for (int k = 0; k < samples; ++k)
    largest = std::max(largest, contact.no_load_error_um(static_cast<double>(k) / samples));
  for (const double phase : curve.breakpoints) largest = std::max(largest, contact.no_load_error_um(phase));
  // Nothing is to be resolved of a flank without relief.
  constexpr double least_um = 1e-6;
  largest = std::max(largest, least_um);
  PeriodicRows rows = periodic_rows(curve.breakpoints, tolerance * largest, false,
                                    [&](double phase, double) { return contact.no_load_error_um(phase); });
  curve.phase = std::move(rows.phase);
  curve.error_um = std::move(rows.value);
  curve.error = rows.error / largest;
  return curve;
}

EhlFriction ehl_of(const MeshedPair& mesh, const Lubrication& lubrication) {
  EhlFriction e;
  e.viscosity_mPas = lubrication.viscosity_mPas;
  e.roughness_um = lubrication.roughness_um;
  e.table_tolerance = lubrication.table_tolerance;
  e.equivalent_modulus_GPa = equivalent_modulus(mesh.driving.material, mesh.driven.material);
  e.width_mm = mesh.face_width_mm();
  e.contact_ratio = mesh.contact_ratio();
  e.path_start_mm = mesh.pair.start_mm;
  e.share_interpolation = Interpolation::smooth;
  e.share_error = 0.0;
  // Along the whole path of one pair, broken where the number of pairs changes.
  std::vector<double> breaks;
  for (int j = 0; j <= static_cast<int>(std::floor(e.contact_ratio)); ++j)
    for (const double b : mesh.breakpoints())
      if (b + j < e.contact_ratio - 1e-9) breaks.push_back(b + j);
  breaks.push_back(e.contact_ratio);
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    const double from = breaks[k];
    const double to = breaks[k + 1];
    const auto position = [&](double fraction) { return fraction == 1.0 ? to : from + (to - from) * fraction; };
    const auto fitted =
        fit_rows<1>([&](double fraction) { return std::array{mesh.load_share(position(fraction), 0.5 * (from + to))}; },
                    mesh.loaded ? reachable(*mesh.loaded, lubrication.table_tolerance) : lubrication.table_tolerance);
    for (std::size_t i = 0; i <= fitted.grid.count; ++i) {
      e.share_position.push_back(position(fitted.grid.fraction(i)));
      e.share.push_back(fitted.rows[i][0]);
    }
    e.share_error = std::max(*e.share_error, fitted.error);
  }
  return e;
}

Bodies bodies(const GearSet& set) {
  const Catalogue& c = set.catalogue;
  const double density = c.material.density_kg_per_m3;
  Bodies b;
  b.sun = cylinder(body_radius_mm(set.sun), 0.5 * c.sun.bore_mm, set.sun.width_mm, density);
  b.planet = cylinder(body_radius_mm(set.planet), 0.5 * c.planet.bore_mm, set.planet.width_mm, density);
  if (c.ring.outer_diameter_mm)
    b.ring = cylinder(0.5 * *c.ring.outer_diameter_mm, body_radius_mm(set.ring), set.ring.width_mm, density);
  if (c.carrier.body)
    b.carrier = carrier(*c.carrier.body, static_cast<int>(set.angles_deg.size()), set.centre_distance_mm, density);
  return b;
}

MemberTolerances member_tolerances(const GearSet& set) {
  const Catalogue& c = set.catalogue;
  const auto of = [](std::optional<int> grade, const Tooth& t, double contact_ratio) -> std::optional<Tolerances> {
    if (!grade) return std::nullopt;
    return tolerances(*grade, t.module_mm, 2.0 * t.reference_radius_mm, t.width_mm, contact_ratio);
  };
  return {of(c.sun.accuracy_grade, set.sun, set.sun_planet.contact_ratio()),
          of(c.planet.accuracy_grade, set.planet, set.sun_planet.contact_ratio()),
          c.has_ring() ? of(c.ring.accuracy_grade, set.ring, set.ring_planet.contact_ratio()) : std::nullopt};
}

std::optional<double> error_amplitude_um(ErrorAmplitude from, const std::optional<Tolerances>& first,
                                         const std::optional<Tolerances>& second) {
  std::optional<double> larger;
  for (const auto* member : {&first, &second})
    if (*member)
      larger = std::max(larger.value_or(0.0),
                        from == ErrorAmplitude::profile_form ? 0.5 * (*member)->profile_form : (*member)->single_pitch);
  return larger;
}

double addendum_of(const Tooth& ring) {
  return (ring.reference_radius_mm - ring.tip_radius_mm) / ring.module_mm + ring.profile_shift;
}

double ring_addendum_bound(const Stage& stage) {
  const auto distance = [&](double addendum) {
    Stage changed = stage;
    changed.catalogue->ring.data.addendum_coefficient = addendum;
    changed.catalogue->ring.data.tip_diameter_mm.reset();
    const GearSet set = geometry_of(changed);
    return set.ring_planet.pair.start_mm - set.ring_planet.pair.pitch_arm_mm;
  };
  // Tips on or below the base circle make no tooth: the search stays above it.
  const auto [least, greatest] = ring_addenda_searched;
  double high = greatest;
  constexpr double step = 0.05;
  while (high > least) {
    try {
      (void)distance(high);
      break;
    } catch (const DomainError&) {
      high -= step;
    }
  }
  return find_root(distance, least, high);
}

}  // namespace epicyclic::gear
