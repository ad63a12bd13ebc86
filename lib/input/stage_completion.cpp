#include "input/stage_completion.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "gear/bearing.hpp"
#include "gear/gear_set.hpp"
#include "input/catalogue_table.hpp"
#include "input/study_input.hpp"

namespace epicyclic::input {

namespace {

using nlohmann::json;

/// Interpolation in computed rows.
constexpr const char* smooth_word = "smooth";

/// Rolling elements of a bearing.
constexpr const char* balls_word = "balls";
constexpr const char* rollers_word = "rollers";

/// A bearing of a pair that nothing is given of.
constexpr const char* rigid_word = "rigid";

/// Is it a number, or rigid?
bool is_stiffness(const json& value) { return value.is_number() || value == rigid_word; }

/// Is it a number, a row of numbers, or one of the words that are computed? All that is computed is.
bool is_of_computed_kind(const json& value) {
  return value.is_number() || value == smooth_word || value == balls_word || value == rollers_word ||
         value == rigid_word ||
         (value.is_array() &&
          std::all_of(value.begin(), value.end(), [](const json& number) { return number.is_number(); }));
}

/// Is there a given value: neither computed nor a default, by the object's own origins? The tables check a value of a
/// wrong type.
bool is_given(const json& object, const std::string& key) {
  if (!object.contains(key)) return false;
  if (!is_of_computed_kind(object.at(key))) return true;
  const auto origin = object.find("origin");
  if (origin == object.end() || !origin->is_object()) return true;
  const auto text = origin->find(key);
  return text == origin->end() || !may_be_replaced(*text);
}

/// Is any value given?
bool gives(const json& object) {
  for (const auto& [key, value] : object.items())
    if (key != "origin" && key != "note" && is_given(object, key)) return true;
  return false;
}

/// Writes values with the origin of computed values.
class Filler {
 public:
  explicit Filler(json& object) : object_(&object) {
    if (object.is_null()) object = json::object();
  }

  /// @param formula  tag and words, behind "computed: "
  template <class V>
  void fill(const std::string& key, const V& value, const std::string& formula) {
    (*object_)[key] = value;
    (*object_)["origin"][key] = std::string(computed_word) + ": " + formula;
  }
  /// The object below a key, made if it is not there.
  [[nodiscard]] Filler below(const std::string& key) { return Filler((*object_)[key]); }

 private:
  json* object_;
};

/// The part of the stage that the gear set needs, read by the tables; nothing if it cannot be read.
std::optional<gear::Stage> readable_part(const json& stated) {
  gear::Stage part;
  ReadContext context;
  stage_table().read(stated, "", part, context);
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
  return gear::bearing_data(bearing)->stiffness(bearing.approach_um * 1e-6);
}

std::string bearing_tag(const gear::SupportBearing& bearing) {
  const gear::BearingData data = *gear::bearing_data(bearing);
  return std::string(data.kind == gear::RollingElements::balls ? "[G-11]" : "[G-roller]") +
         " tangent stiffness of bearing " + data.name + " at an approach of " + number_text(bearing.approach_um) +
         " um";
}

/// Load rating of a bearing that is known by its designation.
void fill_rating(Filler& member, const gear::BearingData& data) {
  if (!data.dynamic_rating_kN) return;
  Filler bearing = member.below("bearing");
  const std::string origin = "bearing " + data.name + ", " + data.ratings;
  bearing.fill("dynamic_load_rating_kN", *data.dynamic_rating_kN, origin);
  bearing.fill("rolling_elements", data.kind == gear::RollingElements::balls ? balls_word : rollers_word, origin);
}

/// An error in two digits, rounded up, so that another machine's last digits do not show.
double in_two_digits(double error) {
  if (!(error > 0.0)) return 0.0;
  const auto exponent = static_cast<int>(std::floor(std::log10(error))) - 1;
  const auto digits = static_cast<int>(std::ceil(error / std::pow(10.0, exponent)));
  const std::string text = std::to_string(digits) + "e" + std::to_string(exponent);
  std::from_chars(text.data(), text.data() + text.size(), error);
  return error;
}

void fill_mesh(Filler mesh, const gear::MeshedPair& pair, const gear::FourierSeries& series,
               const gear::Catalogue& catalogue, const std::optional<gear::Tolerances>& first,
               const std::optional<gear::Tolerances>& second) {
  const std::string law = pair.loaded ? "[G-secant] modified flanks at the design torque" : "[G-k] energy method";
  mesh.fill("stiffness_N_per_m", series.mean, law + ", mean over a mesh period");
  if (catalogue.stiffness.form == gear::StiffnessForm::harmonics) {
    const std::string fourier =
        pair.loaded ? law + ", Fourier series" : std::string("[G-4] energy method, Fourier series");
    mesh.fill("stiffness_cos_N_per_m", series.cosine, fourier);
    mesh.fill("stiffness_sin_N_per_m", series.sine, fourier);
  } else {
    const gear::StiffnessCurve curve = gear::stiffness_curve(pair, catalogue.stiffness.table_tolerance);
    Filler rows = mesh.below("stiffness_curve");
    const std::string& tag = law;
    rows.fill("phase", curve.phase, tag);
    rows.fill("stiffness_N_per_m", curve.stiffness_N_per_m, tag);
    rows.fill("breakpoints", curve.breakpoints, tag);
    rows.fill("interpolation", smooth_word, "its rows are those of a smooth function");
    rows.fill("error", in_two_digits(*curve.error), "of a curve half as fine, by the order of the interpolation");
  }
  if (pair.loaded) {
    const gear::ErrorCurve curve = gear::error_curve(*pair.loaded, catalogue.stiffness.table_tolerance);
    Filler rows = mesh.below("error_curve");
    const std::string tag = "[G-secant] modified flanks without load";
    rows.fill("phase", curve.phase, tag);
    rows.fill("error_um", curve.error_um, tag);
    rows.fill("breakpoints", curve.breakpoints, tag);
    rows.fill("interpolation", smooth_word, "its rows are those of a smooth function");
    rows.fill("error", in_two_digits(*curve.error), "of a curve half as fine, by the order of the interpolation");
  }
  mesh.fill("backlash_half_um", 500.0 * std::max(0.0, pair.pair.normal_backlash_mm()),
            "[G-j] half of the nominal normal backlash at the centre distance");
  if (const auto amplitude = gear::error_amplitude_um(catalogue.error_amplitude, first, second))
    mesh.fill("error_amplitude_um", *amplitude,
              catalogue.error_amplitude == gear::ErrorAmplitude::profile_form
                  ? "[G-error] half of the profile form deviation of the accuracy grade, the larger of the two members"
                  : "[G-1328] single pitch deviation of the accuracy grade, the larger of the two members");
  Filler coulomb = mesh.below("friction");
  coulomb.fill("contact_ratio", pair.pair.contact_ratio(), "[G-path]");
  coulomb.fill("path_start_mm", pair.pair.start_mm, "[G-path]");
  if (catalogue.lubrication) {
    const gear::EhlFriction e = gear::ehl_of(pair, *catalogue.lubrication);
    Filler friction = mesh.below("friction").below("lubricated");
    friction.fill("viscosity_mPas", e.viscosity_mPas, "as in catalogue");
    friction.fill("roughness_um", e.roughness_um, "as in catalogue");
    friction.fill("equivalent_modulus_GPa", e.equivalent_modulus_GPa, "[G-8]");
    friction.fill("width_mm", e.width_mm, "the smaller face width");
    friction.fill("contact_ratio", e.contact_ratio, "[G-path]");
    friction.fill("path_start_mm", e.path_start_mm, "[G-path]");
    friction.fill("load_share_position", e.share_position, "[G-L]");
    friction.fill("load_share", e.share, "[G-L]");
    friction.fill("load_share_interpolation", smooth_word, "its rows are those of a smooth function");
    friction.fill("load_share_error", in_two_digits(*e.share_error),
                  "of rows half as many, by the order of the interpolation");
    friction.fill("table_tolerance", e.table_tolerance, "as in catalogue");
  }
}

/// Origin of the bearings of a pair without any.
constexpr const char* no_bearings = "no bearing of either gear in catalogue: they only rotate";

/// All values from catalogue data, at their places in a stage, also those that the stage gives itself.
json computed_values(const gear::Stage& read) {
  json stage = json::object();
  const gear::GearSet set = gear::make_gear_set(read);
  const gear::Catalogue& c = set.catalogue;
  const gear::Bodies bodies = gear::bodies(set);
  const gear::MemberTolerances tolerances = gear::member_tolerances(set);
  const std::string gears = set.is_pair() ? "both gears" : "sun and planet";
  Filler(stage["planets"]).fill("centre_distance_mm", set.centre_distance_mm, "[G-a0] " + gears + " without backlash");
  Filler lumped(stage["lumped"]);
  Filler sun = lumped.below("sun");
  fill_gear(sun, set.sun);
  fill_body(sun, bodies.sun, set.sun.base_radius_mm, "[G-M] cylinder between bore and mean of tip and root radius");
  if (c.sun_bearing) {
    const gear::BearingData data = *gear::bearing_data(*c.sun_bearing);
    sun.fill("support_N_per_m", support_stiffness(*c.sun_bearing), bearing_tag(*c.sun_bearing));
    if (data.kind == gear::RollingElements::balls) {
      Filler bearing = sun.below("bearing");
      const std::string origin = "bearing " + data.name + ", " + data.origin;
      bearing.fill("balls", data.elements, origin);
      bearing.fill("ball_diameter_mm", data.ball_diameter_mm, origin);
      bearing.fill("contact_angle_deg", data.contact_angle_deg, "as in catalogue");
    }
    if (set.is_pair()) fill_rating(sun, data);
  } else if (set.is_pair() && !c.planet_bearing) {
    sun.fill("support_N_per_m", rigid_word, no_bearings);
  }
  Filler planet = lumped.below("planet");
  fill_gear(planet, set.planet);
  fill_body(planet, bodies.planet, set.planet.base_radius_mm,
            "[G-M] cylinder between bore and mean of tip and root radius");
  if (c.planet_bearing) {
    const gear::BearingData data = *gear::bearing_data(*c.planet_bearing);
    planet.fill("bearing_N_per_m", data.stiffness(c.planet_bearing->approach_um * 1e-6),
                bearing_tag(*c.planet_bearing) + "; " + data.origin);
    fill_rating(planet, data);
  } else if (set.is_pair() && !c.sun_bearing) {
    planet.fill("bearing_N_per_m", rigid_word, no_bearings);
  }
  fill_mesh(lumped.below("sun_planet_mesh"), set.sun_planet, set.sun_planet_stiffness, c, tolerances.sun,
            tolerances.planet);
  if (set.is_pair()) return stage;
  Filler ring = lumped.below("ring");
  fill_gear(ring, set.ring);
  fill_body(ring, bodies.ring, set.ring.base_radius_mm, "[G-M] ring between mean of tip and root radius and rim");
  Filler carrier = lumped.below("carrier");
  fill_body(carrier, bodies.carrier, set.centre_distance_mm, "[G-Mc] plates and pins");
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
  fill_mesh(lumped.below("ring_planet_mesh"), set.ring_planet, set.ring_planet_stiffness, c, tolerances.planet,
            tolerances.ring);
  lumped.fill("ring_mesh_lead_1", set.ring_mesh_lead, "[G-1] from the paths of contact");
  return stage;
}

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

/// A value of the file with the origin "computed" that differs from the computed one now.
struct Ignored {
  std::string place, origin;
};

/// Writes computed values that are not given; one form of a value may replace another.
void complete(json& object, const json& computed, const std::string& pointer, std::vector<Ignored>& ignored) {
  for (const auto& [key, value] : computed.items()) {
    if (key == "origin") continue;
    const std::string place = pointer + pointer_step(key);
    const auto there = object.find(key);
    if (value.is_object()) {
      if (there == object.end())
        object[key] = value;
      else if (there->is_object())
        complete(*there, value, place, ignored);
      continue;
    }
    if (there != object.end()) {
      const auto same_kind = [&there, &value = value](bool (json::*is)() const noexcept) {
        return (*there.*is)() == (value.*is)();
      };
      const bool alike = is_stiffness(*there) && is_stiffness(value);
      if (is_given(object, key) || !(alike || (same_kind(&json::is_array) && same_kind(&json::is_string)))) continue;
      if (differs(*there, value)) ignored.push_back({place, object["origin"][key].dump()});
    }
    object[key] = value;
    json& origin = object["origin"];
    if (!origin.is_object()) origin = json::object();
    origin[key] = computed.at("origin").at(key);
  }
}

/// A note for each ignored value; one for all if their catalogue data changed and there are many.
void note_ignored(const std::vector<Ignored>& ignored, std::vector<std::string>& notes) {
  constexpr std::size_t most = 4;
  const bool many = ignored.size() > most;
  const std::string others = many ? ", like " + std::to_string(ignored.size() - 1) + " others" : "";
  for (const auto& [place, origin] : std::span(ignored).first(many ? 1 : ignored.size()))
    notes.push_back(place + ": the value in the file is ignored and computed anew" + others +
                    ", since its origin says " + origin + "; give it another origin to make it stand");
}

/// Of the forms of computed friction, lubricated contact alone, or none.
void leave_lubricated(json& computed) {
  json& friction = computed["friction"];
  if (!friction.contains("lubricated"))
    computed.erase("friction");
  else
    friction = {{"lubricated", std::move(friction["lubricated"])}};
}

/// Stiffness and friction of a mesh have several forms. A given form replaces a computed one of another form, also one
/// that was computed earlier.
void choose_forms(json& mesh, json& computed) {
  const auto rows = mesh.find("stiffness_curve");
  if (computed.contains("stiffness_curve")) {
    // Given rows, and given harmonics, count as a whole.
    bool given = rows != mesh.end() && (!rows->is_object() || gives(*rows));
    for (const char* key : {"stiffness_cos_N_per_m", "stiffness_sin_N_per_m"}) given = given || is_given(mesh, key);
    if (given) {
      computed.erase("stiffness_curve");
    } else {
      for (const char* key : {"stiffness_cos_N_per_m", "stiffness_sin_N_per_m"})
        if (mesh.erase(key) > 0) mesh["origin"].erase(key);
    }
  } else if (rows != mesh.end()) {
    if (rows->is_object() && !gives(*rows)) {
      mesh.erase(rows);
    } else {
      computed.erase("stiffness_cos_N_per_m");
      computed.erase("stiffness_sin_N_per_m");
    }
  }
  // Given harmonics or rows of the error replace the amplitude of a tolerance; rows replace those of modified flanks.
  const auto errors = mesh.find("error_curve");
  const bool rows_given = errors != mesh.end() && (!errors->is_object() || gives(*errors));
  if (rows_given || is_given(mesh, "error_cos_um") || is_given(mesh, "error_sin_um")) {
    computed.erase("error_amplitude_um");
    if (!is_given(mesh, "error_amplitude_um") && mesh.erase("error_amplitude_um") > 0)
      mesh["origin"].erase("error_amplitude_um");
  }
  if (rows_given)
    computed.erase("error_curve");
  else if (errors != mesh.end() && !computed.contains("error_curve"))
    mesh.erase(errors);
  const auto friction = mesh.find("friction");
  if (friction == mesh.end()) return leave_lubricated(computed);
  if (!friction->is_object()) {
    computed.erase("friction");
    return;
  }
  // The computed path of a coefficient that was removed is removed, too.
  if (!friction->contains("coefficient") &&
      (friction->contains("contact_ratio") || friction->contains("path_start_mm"))) {
    for (const char* key : {"contact_ratio", "path_start_mm"})
      if (friction->contains(key) && !is_given(*friction, key)) {
        friction->erase(key);
        (*friction)["origin"].erase(key);
      }
    if (!gives(*friction)) {
      mesh.erase(friction);
      return leave_lubricated(computed);
    }
  }
  const auto once = friction->find("lubricated");
  const bool computed_once = once != friction->end() && once->is_object() && once->contains("origin") && !gives(*once);
  if (is_given(*friction, "coefficient")) {
    if (computed_once) friction->erase(once);
    computed["friction"].erase("lubricated");
  } else if (computed_once) {
    leave_lubricated(computed);
  } else {
    computed.erase("friction");
  }
}

/// Bearings and a shaft of the catalogue that something else is given in the place of.
void note_unused(const json& stage, const json& computed, const std::string& root, std::vector<std::string>& notes) {
  struct Place {
    const char *member, *key, *from;
  };
  for (const auto& [member, key, from] : {Place{"sun", "support_N_per_m", "/catalogue/sun_bearing"},
                                          Place{"planet", "bearing_N_per_m", "/catalogue/planet_bearing"},
                                          Place{"carrier", "support_N_per_m", "/catalogue/carrier/bearing"},
                                          Place{"carrier", "torsional_support_N_per_m", "/catalogue/carrier/shaft"}}) {
    const auto place = json::json_pointer("/lumped") / member;
    if (!computed.contains(place / key) || !stage.contains(place) || !stage.at(place).is_object()) continue;
    const json& object = stage.at(place);
    if (!is_given(object, key) || !object.at(key).is_number() || !computed.at(place / key).is_number()) continue;
    const json origin = object.value("origin", json());
    const std::string text = origin.is_object() && origin.contains(key) && origin.at(key).is_string()
                                 ? origin.at(key).get<std::string>()
                                 : std::string();
    if (text.rfind("calibrated", 0) == 0 || text.rfind("set", 0) == 0) continue;  // meant
    notes.push_back(root + (place / key).to_string() + ": is given, so the " + number_text(computed.at(place / key)) +
                    " N/m that " + root + from + " gives is not used; take one of them out");
  }
}

}  // namespace

bool may_be_replaced(const json& origin) { return is_computed(origin) || origin == "default"; }

bool is_computed(const json& origin) {
  return origin.is_string() && origin.get_ref<const std::string&>().rfind(computed_word, 0) == 0;
}

Completion complete_stage(json& stage, const std::string& root, ReadContext& context) {
  if (!stage.is_object() || !stage.contains("catalogue")) return {};
  json stated = json::object();
  for (const char* key : {"boundary", "planets", "catalogue"})
    if (const auto it = stage.find(key); it != stage.end()) stated[key] = *it;
  if (const auto planets = stated.find("planets"); planets != stated.end() && planets->is_object())
    if (!is_given(*planets, "centre_distance_mm")) planets->erase("centre_distance_mm");
  auto read = readable_part(stated);
  if (read && read->catalogue->is_modified() && stage.contains("load")) {
    // The load of modified flanks; it must not keep other values from being computed if it cannot be read.
    stated["load"] = stage["load"];
    if (auto with_load = readable_part(stated))
      read = std::move(with_load);
    else
      read->load.torque_Nm = 1.0;  // in place of one that the reader refuses
  }
  if (!read) return {.complete = false, .computed = {}};
  if (read->is_pair()) read->planet_count = 1;
  const auto problems = gear::catalogue_problems(*read);
  for (const std::string& problem : problems) {
    const auto colon = problem.find(": ");
    context.add(Finding::Kind::rule, root + problem.substr(0, colon), problem.substr(colon + 2));
  }
  if (!problems.empty()) return {.complete = false, .computed = {}};
  Completion completion{.complete = true, .computed = computed_values(*read)};
  json computed = completion.computed;
  json none = json::object();
  const auto lumped = stage.find("lumped");
  for (const char* key : {"sun_planet_mesh", "ring_planet_mesh"}) {
    if (!computed["lumped"].contains(key)) continue;
    const bool there =
        lumped != stage.end() && lumped->is_object() && lumped->contains(key) && (*lumped)[key].is_object();
    choose_forms(there ? (*lumped)[key] : none, computed["lumped"][key]);
  }
  note_unused(stage, computed, root, context.notes);
  std::vector<Ignored> ignored;
  complete(stage, computed, root, ignored);
  note_ignored(ignored, context.notes);
  return completion;
}

nlohmann::json computed_values(nlohmann::json& resolved) {
  const bool bare = !resolved.contains("stage");
  ReadContext unused;
  nlohmann::json computed = complete_stage(bare ? resolved : resolved["stage"], "", unused).computed;
  return bare ? computed : nlohmann::json{{"stage", std::move(computed)}};
}

}  // namespace epicyclic::input
