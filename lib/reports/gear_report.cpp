#include "reports/gear_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "core/errors.hpp"
#include "gear/bearing.hpp"
#include "gear/kinematics.hpp"
#include "gear/reversal.hpp"
#include "input/estimates.hpp"
#include "reports/markdown.hpp"

namespace epicyclic::reports {

namespace {

constexpr double degree = 180.0 / std::numbers::pi;

/// Collects quantities of one group.
class Group {
 public:
  Group(std::vector<Quantity>& all, std::string name) : all_(all), name_(std::move(name)) {}

  void add(const std::string& name, const std::string& symbol, double value, const std::string& unit,
           const std::string& formula) {
    all_.push_back({name_, name, symbol, value, unit, formula});
  }

 private:
  std::vector<Quantity>& all_;
  std::string name_;
};

/// @param module_formula  source of the module
void add_tooth(std::vector<Quantity>& all, const gear::Tooth& t, const std::string& member, const std::string& title,
               const std::string& index, const std::string& module_formula) {
  Group g(all, "Teeth of " + title);
  const auto name = [&](const char* what) { return member + "_" + what; };
  g.add(name("module"), "m_" + index, t.module_mm, "mm", module_formula);
  g.add(name("reference_radius"), "r_" + index, t.reference_radius_mm, "mm", "[G-inv]");
  g.add(name("base_radius"), "r_b" + index, t.base_radius_mm, "mm", "[G-inv]");
  g.add(name("tip_radius"), "r_a" + index, t.tip_radius_mm, "mm", "[G-tooth]");
  g.add(name("root_radius"), "r_f" + index, t.root_radius_mm, "mm", "[G-tooth]");
  if (!t.internal) g.add(name("form_radius"), "r_F" + index, t.form_radius_mm(), "mm", "[G-form]");
  g.add(name("base_half_angle"), "α_2" + index, t.base_half_angle, "rad", "[G-tooth]");
  g.add(name("base_pitch"), "p_b" + index, t.base_pitch_mm(), "mm", "[G-inv]");
  g.add(name("tip_thickness"), "s_a" + index, t.thickness_at(t.tip_radius_mm), "mm", "[G-tooth]");
  if (!t.internal) g.add(name("undercut_limit"), "x_min" + index, t.undercut_limit(), "-", "[G-form]");
}

/// @param index  of the symbols; empty: those of a lone pair
void add_pair(std::vector<Quantity>& all, const gear::Pair& p, const std::string& mesh, const std::string& index,
              const std::string& title) {
  Group g(all, "Contact of " + title);
  const auto name = [&](const char* what) { return mesh + "_" + what; };
  const bool lone = index.empty();
  g.add(name("operating_pressure_angle"), lone ? "α_w" : "α_" + index, p.pressure_angle * degree, "deg", "[G-pair]");
  try {
    g.add(name("tight_centre_distance"), "a_0" + index, tight_centre_distance_mm(p.driving, p.driven), "mm", "[G-a0]");
  } catch (const DomainError&) {
    // Teeth that fit at no centre distance without backlash: there is no such distance to report.
  }
  g.add(name("operating_pitch_radius_driving"), "r_w1", p.pitch_radius_1_mm(), "mm", "[G-pair]");
  g.add(name("operating_pitch_radius_driven"), "r_w2", p.pitch_radius_2_mm(), "mm", "[G-pair]");
  g.add(name("line_of_action_length"), "N_1N_2", p.theoretical_length_mm, "mm", "[G-pair]");
  g.add(name("contact_start"), "N_1B_2", p.start_mm, "mm", "[G-path]");
  g.add(name("contact_end"), "N_1B_1", p.end_mm, "mm", "[G-path]");
  g.add(name("pitch_point"), "N_1C", p.pitch_arm_mm, "mm", "[G-path]");
  g.add(name("start_beyond_pitch_point"), "CB_2", p.start_mm - p.pitch_arm_mm, "mm", "[G-path]");
  g.add(name("end_beyond_pitch_point"), "CB_1", p.end_mm - p.pitch_arm_mm, "mm", "[G-path]");
  g.add(name("contact_ratio"), lone ? "ε_α" : "ε_" + index, p.contact_ratio(), "-", "[G-path]");
  g.add(name("backlash"), "j_t", p.backlash_mm(), "mm", "[G-j]");
  g.add(name("normal_backlash"), "j_bn", p.normal_backlash_mm(), "mm", "[G-j]");
  g.add(name("tip_clearance_driving"), "c_1", p.tip_clearance_1_mm(), "mm", "[G-pair]");
  g.add(name("tip_clearance_driven"), "c_2", p.tip_clearance_2_mm(), "mm", "[G-pair]");
  g.add(name("active_radius_driving"), "r_A1", p.radius_1_mm(p.start_mm), "mm", "[G-path]");
  g.add(name("active_radius_driven"), "r_A2", p.radius_2_mm(p.end_mm), "mm", "[G-path]");
}

void add_stiffness(std::vector<Quantity>& all, const gear::MeshedPair& m, const gear::FourierSeries& series,
                   const std::string& mesh, const std::string& title) {
  Group g(all, "Stiffness of " + title);
  const auto name = [&](const std::string& what) { return mesh + "_" + what; };
  const gear::StiffnessRange range = gear::stiffness_range(m);
  const gear::IsoStiffness iso = gear::iso_stiffness(m);
  g.add(name("stiffness_mean"), "k_0", series.mean, "N/m", "[G-k]");
  g.add(name("stiffness_least"), "k_min", range.least, "N/m", "[G-k]");
  g.add(name("stiffness_greatest"), "k_max", range.greatest, "N/m", "[G-k]");
  for (std::size_t h = 0; h < series.cosine.size(); ++h) {
    const std::string order = std::to_string(h + 1);
    g.add(name("stiffness_cos_" + order), "A_" + order, series.cosine[h], "N/m", "[G-4]");
    g.add(name("stiffness_sin_" + order), "B_" + order, series.sine[h], "N/m", "[G-4]");
  }
  g.add(name("iso_single_stiffness"), "c'b", iso.single, "N/m", "[G-iso]");
  g.add(name("iso_mesh_stiffness"), "c_γ b", iso.mesh, "N/m", "[G-iso]");
  g.add(name("iso_ratio"), "k_0/(c_γ b)", series.mean / iso.mesh, "-", "[G-iso]");
  const auto compliance = [&](const gear::ToothBody& body, double radius, const std::string& member) {
    if (!body.tooth.internal) {
      g.add(name(member + "_body_radius_ratio"), "h_f", body.radius_ratio, "-", "[G-kf], fitted for 1.4 to 7");
      g.add(name(member + "_root_half_angle"), "θ_f",
            body.root_half_angle.value_or(gear::root_half_angle(body.tooth, m.options.fillet)), "rad",
            "[G-kf], fitted for 0.01 to 0.12");
    }
    const gear::ToothCompliance c = m.compliance(body, radius);
    g.add(name(member + "_bending_compliance"), "1/k_b", c.bending, "m/N", body.tooth.internal ? "[G-kr]" : "[G-kb]");
    g.add(name(member + "_shear_compliance"), "1/k_s", c.shear, "m/N", body.tooth.internal ? "[G-kr]" : "[G-ks]");
    g.add(name(member + "_axial_compliance"), "1/k_a", c.axial, "m/N", body.tooth.internal ? "[G-kr]" : "[G-ka]");
    g.add(name(member + "_foundation_compliance"), "1/k_f", c.foundation, "m/N",
          body.tooth.internal ? "[G-kfr]" : "[G-kf]");
  };
  const double middle = 0.5 * (m.pair.start_mm + m.pair.end_mm);
  compliance(m.driving, m.pair.radius_1_mm(middle), "driving");
  compliance(m.driven, m.pair.radius_2_mm(middle), "driven");
}

void add_tolerances(std::vector<Quantity>& all, const std::optional<gear::Tolerances>& t, const std::string& member,
                    const std::string& title) {
  if (!t) return;
  Group g(all, "Tolerances of " + title);
  const auto name = [&](const char* what) { return member + "_" + what; };
  g.add(name("single_pitch_deviation"), "f_pt", t->single_pitch, "um", "[G-1328]");
  g.add(name("cumulative_pitch_deviation"), "F_p", t->cumulative_pitch, "um", "[G-1328]");
  g.add(name("profile_deviation"), "F_α", t->profile, "um", "[G-1328]");
  g.add(name("profile_form_deviation"), "f_fα", t->profile_form, "um", "[G-1328]");
  g.add(name("profile_slope_deviation"), "f_Hα", t->profile_slope, "um", "[G-1328]");
  g.add(name("helix_deviation"), "F_β", t->helix, "um", "[G-1328]");
  g.add(name("single_flank_deviation"), "f_i'", t->single_flank, "um", "[G-1328], from memory of the standard");
}

std::string shown(double value) {
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  return size >= 1e6 || size < 1e-3 ? fmt::format("{:.6e}", value) : fmt::format("{:.7g}", value);
}

void append_values(std::string& page, const nlohmann::json& value, const std::string& pointer,
                   const std::string& origin, const std::string& key) {
  if (value.is_object()) {
    const auto origins = value.find("origin");
    for (const auto& [name, child] : value.items()) {
      if (name == "origin" || name == "note") continue;
      std::string of_child;
      if (origins != value.end() && origins->is_object())
        if (const auto text = origins->find(name); text != origins->end()) of_child = text->get<std::string>();
      append_values(page, child, pointer + "/" + name, of_child, name);
    }
    return;
  }
  constexpr std::size_t shown_most = 6;
  std::string text;
  if (value.is_number()) {
    text = shown(value.get<double>());
  } else if (value.is_array() && value.size() > shown_most) {
    text = fmt::format("{} numbers", value.size());
  } else if (value.is_array()) {
    for (const auto& element : value)
      text += (text.empty() ? "" : ", ") + (element.is_number() ? shown(element.get<double>()) : element.dump());
  } else {
    text = value.is_string() ? value.get<std::string>() : value.dump();
  }
  page += fmt::format("| `{}` | {} | {} | {} |\n", markdown_cell(pointer), markdown_cell(text), input::unit_of(key),
                      markdown_cell(origin));
}

/// The rotational modes, and the harmonics of the mesh frequency that excite them. Harmonic h of equally spaced, equal
/// planets reaches planet i with the phase 2 pi h z_s i / N. It is the same for all only if h z_s / N is whole (Parker,
/// J. Sound Vib. 236 (2000) 561).
std::string rotational_modes(const gear::Stage& stage, const std::vector<model::Mode>& modes) {
  std::string list;
  for (const model::Mode& mode : modes)
    if (mode.type == model::ModeType::rotational && mode.frequency_ratio > 0.0)
      list += fmt::format("{}{:.3f}", list.empty() ? "" : ", ", mode.frequency_ratio);
  if (list.empty())
    return "None of these modes is rotational. All planets have the same deflections only if the sums of cos φ_i and "
           "sin φ_i are 0, as those of equally spaced planets.";
  std::string text =
      "Rotational modes, in which all planets have the same deflections in their own directions, are at ω/ω_sn = " +
      list + ".";
  const std::vector<double> angles = stage.planet_angles_deg();
  constexpr double angle_rounding_deg = 1e-9;
  for (std::size_t i = 0; i < angles.size(); ++i)
    if (std::abs(angles[i] - angles[0] - 360.0 * static_cast<double>(i) / static_cast<double>(angles.size())) >
        angle_rounding_deg)
      return text;
  if (!stage.sun.teeth) return text;
  // Planets that cannot be assembled have phases of their own in the ring mesh.
  if (stage.ring.teeth && (*stage.sun.teeth + *stage.ring.teeth) % stage.planet_count != 0) return text;
  const int common = std::gcd(*stage.sun.teeth, stage.planet_count);
  if (common == stage.planet_count)
    return text +
           fmt::format(" The planets mesh in phase (z_s/N = {} is an integer): equal planets excite only these modes.",
                       *stage.sun.teeth / stage.planet_count);
  return text + fmt::format(
                    " The planets mesh out of phase (z_s/N = {}/{}). With equal planets the harmonics {}, {}, ... of "
                    "the mesh frequency excite these modes; all other harmonics excite translational and planet modes.",
                    *stage.sun.teeth, stage.planet_count, stage.planet_count / common, 2 * stage.planet_count / common);
}

/// Is the centre distance that of sun and planet without backlash?
bool is_tight(const gear::GearSet& set) {
  constexpr double rounding_mm = 1e-9;
  try {
    return std::abs(set.centre_distance_mm - tight_centre_distance_mm(set.sun, set.planet)) < rounding_mm;
  } catch (const DomainError&) {
    return false;  // there is none
  }
}

/// Frequencies of each type, rising, as often as their multiplicity [Hz]; all under one key if types are not
/// distinguished.
using Frequencies = std::map<std::optional<model::ModeType>, std::vector<double>>;

Frequencies frequencies(const gear::Stage& stage, const std::vector<model::Mode>& modes, bool by_type) {
  const double hertz = model::scales_of(stage).omega_sn / (2.0 * std::numbers::pi);
  Frequencies all;
  for (const model::Mode& mode : modes) {
    auto& of_type = all[by_type ? std::optional(mode.type) : std::nullopt];
    of_type.insert(of_type.end(), static_cast<std::size_t>(mode.multiplicity), mode.frequency_ratio * hertz);
  }
  return all;
}

bool are_alike(const Frequencies& a, const Frequencies& b) {
  return std::ranges::equal(
      a, b, [](const auto& x, const auto& y) { return x.first == y.first && x.second.size() == y.second.size(); });
}

/// What a stage has beside two gears: the ring's module, assembly and phases.
void add_stage(std::vector<Quantity>& all, const gear::GearSet& set, const gear::Stage& stage) {
  Group g(all, "Stage");
  g.add("base_pitch_mismatch", "Δp_b", 1e3 * set.base_pitch_mismatch_mm, "um", "planet minus ring as given");
  g.add("ring_module_as_given", "m_r", set.catalogue.ring.data.module_mm, "mm", "given");
  const double teeth = set.sun.teeth + set.ring.teeth;
  g.add("assembly_number", "(z_s+z_r)/N", teeth / static_cast<double>(set.angles_deg.size()), "-",
        "an integer if equally spaced planets can be assembled");
  g.add("planet_gap", "", gear::planet_gap_mm(set), "mm", "between tip circles of neighbouring planets");
  g.add("ring_mesh_lead", "λ_sr", set.ring_mesh_lead, "-", "[G-1]");
  const auto phases = gear::planet_phases(set);
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    g.add("sun_mesh_phase_" + number, "λ_sp" + number, phases[i].sun_planet, "-", "[M-phase]");
    g.add("ring_mesh_phase_" + number, "λ_rp" + number, phases[i].ring_planet, "-", "[M-phase], λ_sr included");
  }
  try {
    g.add("ring_addendum_bound", "h_ar max", gear::ring_addendum_bound(stage), "-",
          "largest value with contact of the ring-planet mesh only beyond its pitch point");
  } catch (const DomainError&) {
    // No addendum puts the whole path beyond the pitch point: there is no bound to report.
  }
}

}  // namespace

std::vector<Quantity> gear_quantities(const gear::GearSet& set, const gear::Stage& stage) {
  std::vector<Quantity> all;
  const bool pair = set.is_pair();
  {
    Group g(all, pair ? "Pair" : "Stage");
    g.add("centre_distance", "a", set.centre_distance_mm, "mm", is_tight(set) ? "[G-a0]" : "given");
    g.add("tip_shortening", "k", set.tip_shortening, "-", "[G-k-tip]");
  }
  if (!pair) add_stage(all, set, stage);
  const std::string first = pair ? "gear 1" : "the sun";
  const std::string second = pair ? "gear 2" : "the planet";
  const std::string index_1 = pair ? "1" : "s";
  const std::string index_2 = pair ? "2" : "p";
  add_tooth(all, set.sun, "sun", first, index_1, "given");
  add_tooth(all, set.planet, "planet", second, index_2, "given");
  if (!pair) {
    const bool given_module = set.ring.module_mm == set.catalogue.ring.data.module_mm;
    add_tooth(all, set.ring, "ring", "the ring", "r", given_module ? "given" : "[G-mr]");
  }
  add_pair(all, set.sun_planet.pair, "sun_planet", pair ? "" : "sp", pair ? "the pair" : "sun and planet");
  if (!pair) add_pair(all, set.ring_planet.pair, "ring_planet", "rp", "planet and ring");
  add_stiffness(all, set.sun_planet, set.sun_planet_stiffness, "sun_planet", pair ? "the mesh" : "the sun-planet mesh");
  if (!pair) add_stiffness(all, set.ring_planet, set.ring_planet_stiffness, "ring_planet", "the ring-planet mesh");
  const gear::Bodies bodies = gear::bodies(set);
  {
    Group g(all, "Bodies");
    const auto body = [&](const std::optional<gear::MassAndInertia>& b, const std::string& member,
                          const std::string& index, const char* tag) {
      if (!b) return;
      g.add(member + "_mass", "M_" + index, b->mass_kg, "kg", tag);
      g.add(member + "_inertia", "I_" + index, b->inertia_kg_m2, "kg m2", tag);
    };
    body(bodies.sun, "sun", index_1, "[G-M]");
    body(bodies.planet, "planet", index_2, "[G-M]");
    body(bodies.ring, "ring", "r", "[G-M]");
    body(bodies.carrier, "carrier", "c", "[G-Mc]");
  }
  const gear::MemberTolerances tolerances = gear::member_tolerances(set);
  add_tolerances(all, tolerances.sun, "sun", first);
  add_tolerances(all, tolerances.planet, "planet", second);
  add_tolerances(all, tolerances.ring, "ring", "the ring");
  return all;
}

std::vector<Quantity> operating_quantities(const gear::Stage& stage, double mesh_frequency_ratio) {
  std::vector<Quantity> all;
  const model::Scales scales = model::scales_of(stage);
  Group g(all, "Operating point");
  g.add("omega_sn", "ω_sn", scales.omega_sn, "rad/s", "[M-23]");
  g.add("frequency_sn", "ω_sn/2π", scales.omega_sn / (2.0 * std::numbers::pi), "Hz", "[M-23]");
  if (!gear::problems_for_dynamics(stage).empty()) return all;
  const double mesh_frequency = mesh_frequency_ratio * scales.omega_sn;
  const gear::Speeds speeds = gear::speeds(stage, mesh_frequency);
  const gear::Torques torques = gear::torques(stage, mesh_frequency);
  const gear::MeshLoad load = gear::mean_mesh_load(stage, mesh_frequency);
  g.add("mesh_frequency_ratio", "Ω", mesh_frequency_ratio, "-", "of the study; 1 for a stage alone");
  g.add("mesh_frequency", "ω_m", mesh_frequency, "rad/s", "[M-23]");
  const bool pair = stage.is_pair();  // it has no carrier and no ring
  g.add("sun_speed", pair ? "n_1" : "n_s", speeds.sun * gear::rpm, "rpm", "[G-kin]");
  if (!pair) g.add("carrier_speed", "n_c", speeds.carrier * gear::rpm, "rpm", "[G-kin]");
  g.add("sun_torque", pair ? "T_1" : "T_D", torques.sun, "N m", "[G-kin]");
  if (!pair) {
    g.add("carrier_load_torque", "T_c", torques.carrier, "N m", "[G-kin], external");
    g.add("ring_load_torque", "T_r", torques.ring, "N m", "[G-kin], external; without the reaction of a support");
  }
  g.add("mean_mesh_force", "F", load.force_N, "N", pair ? "T_1 / r_b1" : "T_D / (N r_bs)");
  g.add("mean_planet_load", "F_p", gear::mean_planet_load(stage, mesh_frequency), "N",
        pair ? "on each bearing" : "both mesh forces on a planet's bearing");
  if (!pair)
    g.add("planet_centrifugal_force", "m_p ω_c² r_c", gear::planet_centrifugal_force(stage, mesh_frequency), "N",
          "[G-cf], in the equations of motion with /model/centrifugal \"included\"");
  g.add("mean_deflection", "F/k_0", gear::static_deflection_um(stage.sun_planet_mesh, load), "um",
        pair ? "at the mean stiffness" : "sun-planet mesh");
  if (!pair)
    g.add("mean_deflection_ring_planet", "F/k_0", gear::static_deflection_um(stage.ring_planet_mesh, load), "um",
          "ring-planet mesh");
  const auto error = [&](const std::string& name, const gear::Mesh& mesh) {
    const double amplitude = std::ranges::max(mesh.error_amplitude_um);
    g.add(name + "_error_amplitude", "E", amplitude, "um",
          pair ? "[G-error], or as given" : "[G-error], or as given; the largest of the planets");
    g.add(name + "_error_over_deflection", "E k_0/F", amplitude / gear::static_deflection_um(mesh, load), "-",
          "above 1 the error displaces the mesh more than the load does");
  };
  error("sun_planet", stage.sun_planet_mesh);
  if (!pair) error("ring_planet", stage.ring_planet_mesh);
  return all;
}

std::string quantities_csv(const std::vector<Quantity>& quantities) {
  CsvWriter csv({"name", "value", "unit", "symbol", "formula", "group"});
  for (const Quantity& q : quantities) csv.row(q.name, q.value, q.unit, q.symbol, q.formula, q.group);
  return csv.text();
}

std::vector<std::string> contact_verdicts(const gear::GearSet& set, const gear::Stage& stage) {
  const auto verdict = [](const gear::Pair& p, const std::string& mesh) {
    const double start = p.start_mm - p.pitch_arm_mm;
    const double end = p.end_mm - p.pitch_arm_mm;
    const char* side = p.side() == gear::PitchSide::beyond   ? "wholly beyond its pitch point"
                       : p.side() == gear::PitchSide::before ? "wholly before its pitch point"
                                                             : "across its pitch point";
    return fmt::format("The {} mesh lies {}: contact from {:+.3f} to {:+.3f} mm of it, contact ratio {:.4f}.", mesh,
                       side, start, end, p.contact_ratio());
  };
  if (set.is_pair()) return {verdict(set.sun_planet.pair, "pair's")};
  std::vector<std::string> lines = {verdict(set.sun_planet.pair, "sun-planet"),
                                    verdict(set.ring_planet.pair, "ring-planet")};
  try {
    const gear::GearData& ring = set.catalogue.ring.data;
    const std::string now = ring.tip_diameter_mm
                                ? fmt::format("the tip diameter given stands for {:.4f}", gear::addendum_of(set.ring))
                                : fmt::format("it is {}", ring.addendum_coefficient);
    lines.push_back(
        fmt::format("The ring-planet mesh is wholly beyond its pitch point if the addendum coefficient of the ring is "
                    "below {:.4f} ({}). The contact ratio limits it from below.",
                    gear::ring_addendum_bound(stage), now));
  } catch (const DomainError&) {
    lines.push_back(fmt::format(
        "No addendum coefficient of the ring from {} to {} puts the whole ring-planet mesh beyond its pitch "
        "point.",
        gear::ring_addenda_searched.first, gear::ring_addenda_searched.second));
  }
  return lines;
}

std::string operation_verdict(const gear::Stage& stage, double mesh_frequency_ratio) {
  const double mesh_frequency = mesh_frequency_ratio * model::scales_of(stage).omega_sn;
  const gear::Speeds speeds = gear::speeds(stage, mesh_frequency);
  constexpr double giga = 1e9;
  if (stage.is_pair())
    return fmt::format(
        "A pair of {}/{} teeth: ω_m = {:.4g} ω_1; at Ω = {:.4g} gear 1 rotates at {:.0f} rpm, T_1 = {:.4g} N m, mean "
        "mesh force {:.4g} N; mean stiffness {:.4g} 10^9 N/m.",
        *stage.sun.teeth, *stage.planet.teeth, mesh_frequency / speeds.sun, mesh_frequency_ratio,
        speeds.sun * gear::rpm, gear::torques(stage, mesh_frequency).sun,
        gear::mean_mesh_load(stage, mesh_frequency).force_N, stage.sun_planet_mesh.stiffness_N_per_m / giga);
  const bool held = stage.boundary == gear::Boundary::fixed_sun;
  return fmt::format(
      "{}/{}/{} teeth, {} planets: ω_m = {:.4g} {}; at Ω = {:.4g} the sun rotates at {:.0f} rpm, the carrier at "
      "{:.0f} rpm, T_D = {:.4g} N m, mean mesh force {:.4g} N; mean stiffness {:.4g} (sun-planet) and {:.4g} "
      "(ring-planet) 10^9 "
      "N/m.",
      *stage.sun.teeth, *stage.planet.teeth, *stage.ring.teeth, stage.planet_count,
      mesh_frequency / (held ? speeds.carrier : speeds.sun), held ? "ω_c" : "ω_s", mesh_frequency_ratio,
      speeds.sun * gear::rpm, speeds.carrier * gear::rpm, gear::torques(stage, mesh_frequency).sun,
      gear::mean_mesh_load(stage, mesh_frequency).force_N, stage.sun_planet_mesh.stiffness_N_per_m / giga,
      stage.ring_planet_mesh.stiffness_N_per_m / giga);
}

std::string drive_words(const gear::Stage& stage) {
  const bool negative = gear::is_mirrored(stage);
  if (!stage.runs_backward() && !negative && stage.boundary != gear::Boundary::fixed_sun) return {};
  if (stage.is_pair()) return "gear 1 drives; loaded flanks: those of negative torque on gear 1";
  const std::string flanks =
      std::string("loaded flanks: those of ") + (negative ? "negative" : "positive") + " torque on the sun";
  if (stage.boundary == gear::Boundary::fixed_sun) {
    const bool carrier_drives = stage.driver == gear::Driver::carrier;
    return fmt::format("the {} drives, the {} is driven; the sun is held; {}", carrier_drives ? "carrier" : "ring",
                       carrier_drives ? "ring" : "carrier", flanks);
  }
  if (stage.boundary == gear::Boundary::free)
    return fmt::format("no member is held; as seen from the carrier the sun rotates {} its torque; {}",
                       stage.runs_backward() ? "against" : "with", flanks);
  const bool is_star = stage.boundary == gear::Boundary::star;
  const bool by_carrier = stage.driver == gear::Driver::carrier;
  const bool by_sun = stage.driver == gear::Driver::sun;
  return fmt::format("the {} drives, the {} is driven; the sun rotates {} its torque; {}",
                     by_sun       ? "sun"
                     : by_carrier ? "carrier"
                                  : "ring",
                     !by_sun   ? "sun"
                     : is_star ? "ring"
                               : "carrier",
                     stage.runs_backward() ? "against" : "with", flanks);
}

std::string error_words(const gear::Stage& stage, double mesh_frequency_ratio) {
  const gear::MeshLoad load = gear::mean_mesh_load(stage, mesh_frequency_ratio * model::scales_of(stage).omega_sn);
  const auto of = [&](const char* name, const gear::Mesh& mesh) {
    const double amplitude = std::ranges::max(mesh.error_amplitude_um);
    const double deflection = gear::static_deflection_um(mesh, load);
    std::string further;
    if (mesh.error_cos_um || mesh.error_sin_um) further += ", and its harmonics";
    if (mesh.error_curve) {
      const auto [least, greatest] = std::ranges::minmax(mesh.error_curve->error_um);
      further += fmt::format(", and a curve of {:.3g} um from peak to peak", greatest - least);
    }
    return fmt::format("{}{:.3g} um on a static deflection of {:.3g} um ({:.3g} times){}", name, amplitude, deflection,
                       amplitude / deflection, further);
  };
  const std::string amplitude = "amplitude of the transmission error: ";
  if (stage.is_pair()) return amplitude + of("", stage.sun_planet_mesh);
  return amplitude + of("sun-planet ", stage.sun_planet_mesh) + ", " + of("ring-planet ", stage.ring_planet_mesh);
}

std::vector<ModeRange> mode_ranges(const input::LoadedInput& input, const std::vector<model::Mode>& modes) {
  std::vector<input::PointerValue> soft, stiff;
  for (const auto& [pointer, range] : input::estimated_values(input)) {
    const bool is_mass = pointer.ends_with("_kg");
    if (!is_mass && !pointer.ends_with("_N_per_m")) continue;
    soft.push_back({pointer, is_mass ? range.to : range.from});
    stiff.push_back({pointer, is_mass ? range.from : range.to});
  }
  if (soft.empty()) return {};
  const gear::Stage& given = input.study.stage;
  const gear::Stage low = input.with_values(soft).stage;
  const gear::Stage high = input.with_values(stiff).stage;
  const auto low_modes = model::modes(low, model::scales_of(low));
  const auto high_modes = model::modes(high, model::scales_of(high));
  const auto at_all_stiffnesses = [&](bool by_type) {
    return std::array{frequencies(given, modes, by_type), frequencies(low, low_modes, by_type),
                      frequencies(high, high_modes, by_type)};
  };
  auto all = at_all_stiffnesses(true);
  const bool by_type = are_alike(all[0], all[1]) && are_alike(all[0], all[2]);
  if (!by_type) all = at_all_stiffnesses(false);
  std::map<std::optional<model::ModeType>, std::size_t> place;
  std::vector<ModeRange> ranges;
  for (const model::Mode& mode : modes) {
    const auto type = by_type ? std::optional(mode.type) : std::nullopt;
    std::size_t& k = place[type];
    // Of a multiple one all places: the least of the first, the greatest of the last.
    const std::size_t last = k + static_cast<std::size_t>(mode.multiplicity) - 1;
    ranges.push_back({all[1].at(type)[k], all[2].at(type)[last]});
    k = last + 1;
  }
  return ranges;
}

std::string range_words(const std::vector<ModeRange>& ranges) {
  const auto times = [](const ModeRange& r) { return r.from > 0.0 ? r.to / r.from : 0.0; };
  const auto widest = std::ranges::max_element(ranges, {}, times);
  return fmt::format(
      "The ranges of the estimated stiffnesses give each natural frequency a range. The widest is that of mode {}, "
      "{:.0f} to {:.0f} Hz.",
      widest - ranges.begin() + 1, widest->from, widest->to);
}

std::string gear_page(const GearPage& page, const input::LoadedInput& input, const std::vector<model::Mode>& modes,
                      const model::Scales& scales) {
  std::string text = fmt::format("# {}\n\n", markdown_cell(page.title));
  for (const std::string& line : page.verdicts) text += "* " + line + "\n";
  if (!page.warnings.empty()) {
    text += "\n## Warnings\n\n";
    for (const std::string& line : page.warnings) text += "* " + markdown_cell(line) + "\n";
  }
  if (!page.figures.empty()) {
    text += "\n## Figures\n\n";
    for (const std::string& stem : page.figures) text += fmt::format("![{0}](figures/{0}.png)\n", stem);
  }
  text += page.transmission_error;
  std::string group;
  for (const Quantity& q : page.quantities) {
    if (q.group != group) {
      group = q.group;
      text += fmt::format(
          "\n## {}\n\n| quantity | symbol | value | unit | formula or origin |\n|---|---|---|---|---|\n", group);
    }
    text += fmt::format("| {} | {} | {} | {} | {} |\n", q.name, q.symbol, shown(q.value), q.unit, q.formula);
  }

  const bool ranged = !page.mode_ranges.empty();
  text += fmt::format(
      "\n## Modes\n\nLinear stage at mean stiffness, gaps closed, no rotation [M-K]. Shares of the elastic "
      "energy.{}\n\n"
      "| mode | frequency Hz | ω/ω_sn | type | multiplicity | most elastic energy in "
      "|{}\n|---|---|---|---|---|---|{}\n",
      ranged ? " The range of a frequency is from the softest to the stiffest stage within the ranges of the estimated "
               "values."
             : "",
      ranged ? " range Hz |" : "", ranged ? "---|" : "");
  const model::LinearStage linear = model::linear_stage(input.study.stage, scales);
  std::size_t number = 1;
  for (const model::Mode& mode : modes) {
    const model::ModalEnergies energies = model::modal_energies(linear, mode, input.study.stage.planet_count);
    std::size_t most = 0;
    for (std::size_t k = 1; k < model::element_count; ++k)
      if (energies.elastic[k] > energies.elastic[most]) most = k;
    const std::string where = mode.frequency_ratio > 0.0
                                  ? fmt::format("{} {:.0f} %", model::to_string(static_cast<model::Element>(most)),
                                                100.0 * energies.elastic[most])
                                  : std::string("rigid-body mode");
    const std::string range =
        ranged ? fmt::format(" {:.1f} to {:.1f} |", page.mode_ranges[number - 1].from, page.mode_ranges[number - 1].to)
               : std::string();
    text += fmt::format("| {} | {:.1f} | {:.4f} | {} | {} | {} |{}\n", number++,
                        mode.frequency_ratio * scales.omega_sn / (2.0 * std::numbers::pi), mode.frequency_ratio,
                        model::to_string(mode.type), mode.multiplicity, where, range);
  }
  if (input.study.stage.is_pair())
    text += fmt::format(
        "\nThe scale ω_sn = {:.1f} rad/s [M-23] is the natural frequency of the pair with rigid bearings and without "
        "torsional supports.",
        scales.omega_sn);
  else
    text += fmt::format(
        "\nThe scale ω_sn = {:.1f} rad/s [M-23] is that of one sun-planet pair alone. It is not the frequency of a "
        "mode. {}",
        scales.omega_sn, rotational_modes(input.study.stage, modes));
  text += "\n\n## All values of the model and their origins\n\n| value | | unit | origin |\n|---|---|---|---|\n";
  const nlohmann::json& resolved = input.resolved;
  const nlohmann::json& stage = resolved.contains("stage") ? resolved["stage"] : resolved;
  nlohmann::json shown_parts = nlohmann::json::object();
  for (const char* part : {"origin", "boundary", "planets", "load", "catalogue", "lumped"})
    if (const auto it = stage.find(part); it != stage.end()) shown_parts[part] = *it;
  append_values(text, shown_parts, "", "", "");
  if (!page.files.empty()) {
    text += "\n## Data\n\n";
    for (const std::string& file : page.files)
      text += fmt::format("* [{0}]({0}){1}\n", file,
                          file == "load_sharing.csv" && !input.study.stage.is_pair()
                              ? ": of tooth pairs; `epicyclic run` computes that of planets"
                              : "");
  }
  text += "\nlib/EQUATIONS.md explains the tags in brackets.\n";
  return text;
}

}  // namespace epicyclic::reports
