#include "io/stage_completion.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "gear/bearing.hpp"
#include "gear/gear_set.hpp"
#include "io/catalogue_table.hpp"
#include "io/study_input.hpp"

namespace epicyclic::io {

namespace {

using nlohmann::json;

bool is_computed(const json& origin) {
  return origin.is_string() && origin.get_ref<const std::string&>().rfind(computed_word, 0) == 0;
}

/// Writes values that are not there yet, with their origins.
class Filler {
 public:
  explicit Filler(json& object) : object_(&object) {
    if (!object.is_object()) object = json::object();
  }

  /// @param formula  tag and words, behind "computed: "
  template <class V>
  void fill(const std::string& key, const V& value, const std::string& formula) {
    if (object_->contains(key)) return;
    (*object_)[key] = value;
    (*object_)["origin"][key] = std::string(computed_word) + ": " + formula;
  }
  [[nodiscard]] bool has(const std::string& key) const { return object_->contains(key); }
  /// The object below a key, made if it is not there.
  [[nodiscard]] Filler below(const std::string& key) { return Filler((*object_)[key]); }

 private:
  json* object_;
};

/// What of the stage the gear set needs, read by the tables' own means; nothing if it cannot be read.
std::optional<gear::Stage> readable_part(const json& stage) {
  gear::Stage part;
  ReadContext context;
  json asked = json::object();
  for (const char* key : {"boundary", "planets", "catalogue"})
    if (const auto it = stage.find(key); it != stage.end()) asked[key] = *it;
  stage_table().read(asked, "", part, context);
  const auto of_lumped = [](const Finding& f) {
    return f.kind == Finding::Kind::missing_key && f.pointer.rfind("/lumped", 0) == 0;
  };
  if (!std::all_of(context.findings.begin(), context.findings.end(), of_lumped)) return std::nullopt;
  return part;
}

void fill_body(Filler& member, const std::optional<gear::MassAndInertia>& body, double radius_mm,
               const std::string& tag) {
  if (!body) return;
  const double radius_m = radius_mm * 1e-3;
  member.fill("mass_kg", body->mass_kg, tag);
  member.fill("inertia_over_r2_kg", body->inertia_kg_m2 / (radius_m * radius_m), tag + ", over the radius squared");
}

void fill_gear(Filler& member, const gear::Tooth& tooth) {
  member.fill("teeth", tooth.teeth, "as in catalogue");
  member.fill("base_radius_mm", tooth.base_radius_mm, "[G-inv] module, teeth and pressure angle");
}

/// Tangent stiffness of a bearing at its approach.
double support_stiffness(const gear::SupportBearing& bearing) {
  return gear::palmgren_stiffness(gear::bearing_data(bearing)->coefficient(), bearing.approach_um * 1e-6);
}

std::string bearing_tag(const gear::SupportBearing& bearing) {
  return "[G-11] tangent stiffness of bearing " + gear::bearing_data(bearing)->name + " at an approach of " +
         number_text(bearing.approach_um) + " um";
}

void fill_mesh(Filler mesh, const gear::MeshedPair& pair, const gear::FourierSeries& series,
               const gear::Catalogue& catalogue, const std::optional<gear::Tolerances>& first,
               const std::optional<gear::Tolerances>& second) {
  mesh.fill("stiffness_N_per_m", series.mean, "[G-k] energy method, mean over a mesh period");
  const bool harmonics_given = mesh.has("stiffness_cos_N_per_m") || mesh.has("stiffness_sin_N_per_m");
  if (catalogue.stiffness.form == gear::StiffnessForm::harmonics) {
    if (!mesh.has("stiffness_curve")) {
      mesh.fill("stiffness_cos_N_per_m", series.cosine, "[G-4] energy method, Fourier series");
      mesh.fill("stiffness_sin_N_per_m", series.sine, "[G-4] energy method, Fourier series");
    }
  } else if (!harmonics_given) {
    const gear::StiffnessCurve curve = gear::stiffness_curve(pair);
    Filler rows = mesh.below("stiffness_curve");
    const std::string tag = "[G-k] energy method";
    // Given rows stand as a whole.
    if (!rows.has("phase") && !rows.has("stiffness_N_per_m")) {
      rows.fill("phase", curve.phase, tag);
      rows.fill("stiffness_N_per_m", curve.stiffness_N_per_m, tag);
      rows.fill("breakpoints", curve.breakpoints, tag);
    }
  }
  mesh.fill("backlash_half_um", 500.0 * std::max(0.0, pair.pair.normal_backlash_mm()),
            "[G-j] half of the nominal normal backlash at the centre distance");
  if (first || second)
    mesh.fill("error_amplitude_um", std::max(first ? first->single_pitch : 0.0, second ? second->single_pitch : 0.0),
              "[G-1328] single pitch deviation of the accuracy grade, the larger of the two members");
  if (catalogue.lubrication && !mesh.has("friction")) {
    const gear::Friction::Ehl e = gear::ehl_of(pair, *catalogue.lubrication);
    Filler friction = mesh.below("friction").below("lubricated");
    friction.fill("viscosity_mPas", e.viscosity_mPas, "as in catalogue");
    friction.fill("roughness_um", e.roughness_um, "as in catalogue");
    friction.fill("equivalent_modulus_GPa", e.equivalent_modulus_GPa, "[G-8]");
    friction.fill("width_mm", e.width_mm, "the smaller face width");
    friction.fill("contact_ratio", e.contact_ratio, "[G-path]");
    friction.fill("path_start_mm", e.path_start_mm, "[G-path]");
    friction.fill("load_share_position", e.share_position, "[G-L]");
    friction.fill("load_share", e.share, "[G-L]");
  }
}

void fill_stage(json& stage, const gear::Stage& read) {
  const gear::GearSet set = gear::make_gear_set(read);
  const gear::Catalogue& c = set.catalogue;
  const gear::Bodies bodies = gear::bodies(set);
  const gear::MemberTolerances tolerances = gear::member_tolerances(set);
  Filler(stage["planets"]).fill("centre_distance_mm", set.centre_distance_mm, "[G-a0] sun and planet without backlash");
  Filler lumped(stage["lumped"]);
  Filler sun = lumped.below("sun");
  fill_gear(sun, set.sun);
  fill_body(sun, bodies.sun, set.sun.base_radius_mm, "[G-M] cylinder between bore and mean of tip and root radius");
  if (c.sun_bearing) {
    const gear::BearingData data = *gear::bearing_data(*c.sun_bearing);
    sun.fill("support_N_per_m", support_stiffness(*c.sun_bearing), bearing_tag(*c.sun_bearing));
    Filler bearing = sun.below("bearing");
    const std::string origin = "bearing " + data.name + ", " + data.origin;
    bearing.fill("balls", data.balls, origin);
    bearing.fill("ball_diameter_mm", data.ball_diameter_mm, origin);
    bearing.fill("contact_angle_deg", data.contact_angle_deg, "as in catalogue");
  }
  Filler planet = lumped.below("planet");
  fill_gear(planet, set.planet);
  fill_body(planet, bodies.planet, set.planet.base_radius_mm,
            "[G-M] cylinder between bore and mean of tip and root radius");
  Filler ring = lumped.below("ring");
  fill_gear(ring, set.ring);
  fill_body(ring, bodies.ring, set.ring.base_radius_mm, "[G-M] ring between mean of tip and root radius and rim");
  Filler carrier = lumped.below("carrier");
  fill_body(carrier, bodies.carrier, set.centre_distance_mm, "[G-Mc] cheeks and pins");
  if (c.carrier.bearing)
    carrier.fill("support_N_per_m", support_stiffness(*c.carrier.bearing), bearing_tag(*c.carrier.bearing));
  if (c.carrier.shaft && read.boundary != gear::Boundary::fixed_ring) {
    const gear::OutputShaft& shaft = *c.carrier.shaft;
    const double torsion =
        gear::shaft_torsion(shaft.diameter_mm, shaft.inner_diameter_mm, shaft.length_mm, c.material.shear_modulus());
    const double radius_m = set.centre_distance_mm * 1e-3;
    carrier.fill("torsional_support_N_per_m", torsion / (radius_m * radius_m),
                 "[G-GJ] output shaft, referred to the centre distance");
  }
  fill_mesh(lumped.below("sun_planet_mesh"), set.sun_planet, set.sun_planet_stiffness, c, tolerances.sun,
            tolerances.planet);
  fill_mesh(lumped.below("ring_planet_mesh"), set.ring_planet, set.ring_planet_stiffness, c, tolerances.planet,
            tolerances.ring);
  lumped.fill("ring_mesh_lead_1", set.ring_mesh_lead, "[G-1] from the paths of contact");
}

}  // namespace

void drop_computed(json& object) {
  if (!object.is_object()) return;
  if (const auto origin = object.find("origin"); origin != object.end() && origin->is_object()) {
    std::vector<std::string> dropped;
    for (const auto& [key, text] : origin->items())
      if (is_computed(text)) dropped.push_back(key);
    for (const std::string& key : dropped) {
      object["origin"].erase(key);
      object.erase(key);
    }
    if (object["origin"].empty()) object.erase("origin");
  }
  std::vector<std::string> emptied;
  for (auto& [key, child] : object.items()) {
    if (!child.is_object() || key == "origin") continue;
    const bool was_empty = child.empty();
    drop_computed(child);
    if (child.empty() && !was_empty) emptied.push_back(key);
  }
  for (const std::string& key : emptied) object.erase(key);
}

namespace {

/// Differs by more than the rounding of another machine's library?
bool differs(const json& a, const json& b) {
  constexpr double rounding = 1e-9;
  if (a.is_number() && b.is_number()) {
    const double x = a.get<double>();
    const double y = b.get<double>();
    return !(std::abs(x - y) <= rounding * std::max(std::abs(x), std::abs(y)));
  }
  if (a.is_array() && b.is_array() && a.size() == b.size())
    return !std::equal(a.begin(), a.end(), b.begin(), [](const json& p, const json& q) { return !differs(p, q); });
  return a != b;
}

/// Puts back what was dropped as computed and nothing computes.
void restore(const json& given, json& now) {
  if (!given.is_object()) return;
  if (!now.is_object()) now = json::object();
  const auto origin = given.find("origin");
  for (const auto& [key, value] : given.items()) {
    if (key == "origin" || key == "note") continue;
    if (value.is_object()) {
      restore(value, now[key]);
      if (now[key].empty()) now.erase(key);
    } else if (!now.contains(key)) {
      now[key] = value;
      if (origin != given.end() && origin->is_object() && origin->contains(key)) now["origin"][key] = (*origin)[key];
    }
  }
}

/// Values that were given as computed, and were computed anew to something else.
void note_ignored(const json& given, const json& now, const std::string& pointer, std::vector<std::string>& notes) {
  if (!given.is_object() || !now.is_object()) return;
  const auto origin = given.find("origin");
  for (const auto& [key, value] : given.items()) {
    if (key == "origin" || key == "note") continue;
    const std::string place = pointer + pointer_step(key);
    const auto there = now.find(key);
    if (value.is_object()) {
      if (there != now.end()) note_ignored(value, *there, place, notes);
    } else if (origin != given.end() && origin->is_object() && origin->contains(key) && is_computed((*origin)[key]) &&
               there != now.end() && differs(value, *there)) {
      notes.push_back(place +
                      ": the value in the file is ignored and computed anew, since its origin says \"computed\"; "
                      "give it another origin to make it stand");
    }
  }
}

}  // namespace

bool complete_stage(json& stage, const std::string& root, ReadContext& context) {
  if (!stage.is_object() || !stage.contains("catalogue")) return true;
  json given = json::object();
  for (const char* key : {"planets", "lumped"})
    if (const auto it = stage.find(key); it != stage.end()) {
      if (!it->is_object()) return false;
      given[key] = *it;
      drop_computed(*it);
    }
  // Of the planets only the centre distance is ever computed.
  if (given.contains("planets")) {
    json kept = given["planets"];
    kept.erase("centre_distance_mm");
    restore(kept, stage["planets"]);
  }
  const auto read = readable_part(stage);
  if (!read) return false;
  const auto problems = gear::catalogue_problems(*read);
  for (const std::string& problem : problems) {
    const auto colon = problem.find(": ");
    context.add(Finding::Kind::rule, root + problem.substr(0, colon), problem.substr(colon + 2));
  }
  if (!problems.empty()) return false;
  fill_stage(stage, *read);
  if (given.contains("lumped")) restore(given["lumped"], stage["lumped"]);
  note_ignored(given, stage, root, context.notes);
  return true;
}

}  // namespace epicyclic::io
