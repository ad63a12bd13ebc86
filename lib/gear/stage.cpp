#include "gear/stage.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "gear/messages.hpp"
#include "gear/reversal.hpp"

namespace epicyclic::gear {

namespace {

// How far printed radii, centre distance, angle and teeth may disagree: five digits are what catalogues give.
constexpr double radii_tolerance = 1e-4;
constexpr double angle_tolerance_deg = 0.02;
// Rows of a friction table nearer than this coincide after a shift by a phase.
constexpr double phase_resolution = 1e-9;
// Neighbouring planets nearer than this have no room for teeth.
constexpr double angle_resolution_deg = 1e-6;

void check_positive(Problems& out, const std::string& pointer, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) out.add(pointer, "must be a positive number (", value, ")");
}

void check_support(Problems& out, const std::string& pointer, double value) {
  if (!(value >= 0.0)) out.add(pointer, "must be at least 0 or \"rigid\" (", value, ")");
}

void check_member(Problems& out, const std::string& pointer, const CentralMember& m) {
  check_positive(out, pointer + "/mass_kg", m.mass_kg);
  check_positive(out, pointer + "/inertia_over_r2_kg", m.inertia_over_r2_kg);
  check_support(out, pointer + "/support_N_per_m", m.support_N_per_m);
  check_support(out, pointer + "/torsional_support_N_per_m", m.torsional_support_N_per_m);
}

void check_angles(Problems& out, const Stage& s) {
  if (s.angles_deg.empty()) return;
  if (static_cast<int>(s.angles_deg.size()) != s.planet_count) {
    out.add("/planets/angles_deg", "has ", static_cast<double>(s.angles_deg.size()), " angles for ",
            static_cast<double>(s.planet_count), " planets");
    return;
  }
  for (std::size_t i = 0; i < s.angles_deg.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::abs(std::remainder(s.angles_deg[i] - s.angles_deg[j], 360.0)) < angle_resolution_deg)
        out.add("/planets/angles_deg/" + std::to_string(i), "is the place of another planet (", s.angles_deg[i], ")");
}

/// Base radii and centre distance of one mesh decide its pressure angle, or it is given; both must agree.
void check_pressure_angle(Problems& out, const std::string& pointer, const Mesh& mesh, std::optional<double> base_sum,
                          std::optional<double> centre_distance) {
  if (base_sum && centre_distance) {
    const double cosine = *base_sum / *centre_distance;
    if (!(cosine > 0.0) || !(cosine < 1.0)) {
      out.add("/planets/centre_distance_mm", "base radii need cos(alpha) = ", *base_sum, " / ", *centre_distance, " = ",
              cosine, " between 0 and 1 for ", pointer);
      return;
    }
    const double angle = std::acos(cosine) * 180.0 / std::numbers::pi;
    if (mesh.operating_pressure_angle_deg && std::abs(angle - *mesh.operating_pressure_angle_deg) > angle_tolerance_deg)
      out.add(pointer + "/operating_pressure_angle_deg", *mesh.operating_pressure_angle_deg,
              " deg does not fit base radii and centre distance, which give ", angle, " deg (at most ",
              angle_tolerance_deg, " deg apart)");
  } else if (!mesh.operating_pressure_angle_deg) {
    out.add(pointer + "/operating_pressure_angle_deg",
            "is missing; it, or all base radii with planets/centre_distance_mm, must be given");
  }
}

std::optional<double> sum(std::optional<double> a, std::optional<double> b, double sign) {
  if (!a || !b) return std::nullopt;
  return *a + sign * *b;
}

void check_per_planet(Problems& out, const std::string& pointer, const std::vector<double>& values, int planets) {
  if (values.size() != 1 && static_cast<int>(values.size()) != planets)
    out.add(pointer, "has ", static_cast<double>(values.size()), " numbers; one, or one for each of ",
            static_cast<double>(planets), " planets, are needed");
}

/// Rows of a table over the phase: rising, in [0, 1), a jump as two rows at a breakpoint.
void check_rows(Problems& out, const std::string& pointer, const std::vector<double>& phase,
                const std::vector<double>& breakpoints) {
  const std::size_t n = phase.size();
  const auto is_breakpoint = [&](double p) {
    return std::find(breakpoints.begin(), breakpoints.end(), p) != breakpoints.end();
  };
  const auto outside = [](double p) { return !(p >= 0.0) || !(p < 1.0); };
  if (n > 1 && phase.front() + 1.0 - phase.back() < phase_resolution)
    out.add(pointer + "/phase", "the last row is too near to the first one of the next period");
  if (n < 2) out.add(pointer + "/phase", "needs at least 2 rows (", static_cast<double>(n), ")");
  for (std::size_t k = 0; k < n; ++k) {
    const std::string row = pointer + "/phase/" + std::to_string(k);
    if (outside(phase[k])) out.add(row, "must be in [0, 1) (", phase[k], ")");
    if (k == 0) continue;
    if (phase[k] > phase[k - 1] && phase[k] - phase[k - 1] < phase_resolution)
      out.add(row, "is too near to the row before it (", phase[k], " after ", phase[k - 1], ", at least ",
              phase_resolution, " apart)");
    if (phase[k] < phase[k - 1]) out.add(row, "phases must rise (", phase[k], " after ", phase[k - 1], ")");
    if (phase[k] == phase[k - 1] && !is_breakpoint(phase[k]))
      out.add(row, "stands twice, a jump, but is not among the breakpoints (", phase[k], ")");
    if (k > 1 && phase[k] == phase[k - 2]) out.add(row, "stands more than twice (", phase[k], ")");
  }
  for (std::size_t k = 0; k < breakpoints.size(); ++k) {
    const double b = breakpoints[k];
    const std::string row = pointer + "/breakpoints/" + std::to_string(k);
    if (outside(b)) out.add(row, "must be in [0, 1) (", b, ")");
    if (k > 0 && !(b > breakpoints[k - 1])) out.add(row, "breakpoints must rise (", b, ")");
    if (std::find(phase.begin(), phase.end(), b) == phase.end())
      out.add(row, "needs a row of the table at this phase (", b, ")");
  }
}

/// @returns whether a column is as long as the phases
bool check_length(Problems& out, const std::string& pointer, std::size_t size, std::size_t rows) {
  if (size != rows)
    out.add(pointer, "has ", static_cast<double>(size), " numbers, phase has ", static_cast<double>(rows));
  return size == rows;
}

void check_stiffness_curve(Problems& out, const std::string& pointer, const Mesh& mesh) {
  const StiffnessCurve& c = *mesh.stiffness_curve;
  const std::string place = pointer + "/stiffness_curve";
  if (!check_length(out, place + "/stiffness_N_per_m", c.stiffness_N_per_m.size(), c.phase.size())) return;
  check_rows(out, place, c.phase, c.breakpoints);
  // Scales and damping take the mean from stiffness_N_per_m: it must be that of the curve.
  double mean = 0.0;
  for (std::size_t k = 0; k < c.phase.size(); ++k) {
    const bool last = k + 1 == c.phase.size();
    const double to = last ? c.phase.front() + 1.0 : c.phase[k + 1];
    const double next = last ? c.stiffness_N_per_m.front() : c.stiffness_N_per_m[k + 1];
    mean += 0.5 * (to - c.phase[k]) * (c.stiffness_N_per_m[k] + next);
  }
  constexpr double mean_tolerance = 0.01;
  if (!(std::abs(mean / mesh.stiffness_N_per_m - 1.0) <= mean_tolerance))
    out.add(pointer + "/stiffness_N_per_m", "is ", mesh.stiffness_N_per_m, " N/m, but the mean of the curve is ", mean,
            " N/m (relative difference at most ", mean_tolerance, ")");
  if (!mesh.stiffness_cos_N_per_m.empty() || !mesh.stiffness_sin_N_per_m.empty())
    out.add(place, "stands in place of harmonics: stiffness_cos_N_per_m and stiffness_sin_N_per_m exclude it");
}

/// A curve without jumps: e' would be infinite there.
void check_error_curve(Problems& out, const std::string& pointer, const ErrorCurve& c) {
  if (!check_length(out, pointer + "/error_um", c.error_um.size(), c.phase.size())) return;
  check_rows(out, pointer, c.phase, c.breakpoints);
  for (std::size_t k = 1; k < c.phase.size(); ++k)
    if (c.phase[k] == c.phase[k - 1])
      out.add(pointer + "/phase/" + std::to_string(k), "stands twice (", c.phase[k],
              "): the transmission error must not jump; a kink is one row at a breakpoint");
}

void check_stiffness(Problems& out, const std::string& pointer, const Mesh& mesh) {
  constexpr int samples = 1024;
  const auto& c = mesh.stiffness_cos_N_per_m;
  const auto& s = mesh.stiffness_sin_N_per_m;
  double swing = 0.0;
  for (const auto* amplitudes : {&c, &s})
    for (const double amplitude : *amplitudes) swing += std::abs(amplitude);
  constexpr double rounding = 1e-12;  // of the sums
  // Harmonics that together are less than the mean leave the stiffness positive everywhere: no need to sample it.
  if (swing < (1.0 - rounding) * mesh.stiffness_N_per_m) return;
  double lowest = mesh.stiffness_N_per_m;
  for (int k = 0; k < samples; ++k) {
    const double phase = 2.0 * std::numbers::pi * k / samples;
    double stiffness = mesh.stiffness_N_per_m;
    for (std::size_t h = 0; h < c.size(); ++h) stiffness += c[h] * std::cos(static_cast<double>(h + 1) * phase);
    for (std::size_t h = 0; h < s.size(); ++h) stiffness += s[h] * std::sin(static_cast<double>(h + 1) * phase);
    lowest = std::min(lowest, stiffness);
  }
  if (!(lowest > 0.0))
    out.add(pointer + "/stiffness_N_per_m", "mean ", mesh.stiffness_N_per_m, " N/m and harmonics together fall to ",
            lowest, " N/m within a mesh period; stiffness must stay positive");
}

void check_friction_table(Problems& out, const std::string& pointer, const FrictionTable& t) {
  const std::size_t n = t.phase.size();
  const bool lengths =
      static_cast<int>(check_length(out, pointer + "/force_ratio", t.force_ratio.size(), n)) &
      static_cast<int>(check_length(out, pointer + "/moment_ratio_mm/driving", t.moment_driving_mm.size(), n)) &
      static_cast<int>(check_length(out, pointer + "/moment_ratio_mm/driven", t.moment_driven_mm.size(), n));
  if (lengths) check_rows(out, pointer, t.phase, t.breakpoints);
}

void check_ehl(Problems& out, const std::string& pointer, const EhlFriction& e) {
  if (!(e.equivalent_modulus_GPa > 0.0)) out.add(pointer + "/equivalent_modulus_GPa", "is missing");
  if (!(e.width_mm > 0.0)) out.add(pointer + "/width_mm", "is missing");
  const auto& p = e.share_position;
  if (p.size() != e.share.size()) {
    out.add(pointer + "/load_share", "has ", static_cast<double>(e.share.size()), " numbers, load_share_position has ",
            static_cast<double>(p.size()));
    return;
  }
  if (p.empty()) return;
  constexpr double position_resolution = 1e-6;
  if (p.size() < 2 || p.front() != 0.0 || std::abs(p.back() - e.contact_ratio) > position_resolution)
    out.add(pointer + "/load_share_position", "must go from 0 to the contact ratio, ", e.contact_ratio);
  for (std::size_t k = 1; k < p.size(); ++k)
    if (p[k] < p[k - 1])
      out.add(pointer + "/load_share_position/" + std::to_string(k), "must rise (", p[k], " after ", p[k - 1], ")");
}

void check_dynamics_of_member(Problems& out, const std::string& pointer, const CentralMember& m) {
  if (!m.teeth) out.add(pointer + "/teeth", "is missing; time integration needs it");
  if (!m.base_radius_mm) out.add(pointer + "/base_radius_mm", "is missing; time integration needs it");
}

void check_finite_support(Problems& out, const std::string& pointer, double stiffness) {
  if (!std::isfinite(stiffness)) out.add(pointer, "\"rigid\" is for modes only; time integration needs a number");
}

/// Which torsional supports each boundary allows (docs/theory/model.md, section 4).
void check_torsion(Problems& out, const Stage& s) {
  const std::string key = "/torsional_support_N_per_m";
  const double k_su = s.sun.torsional_support_N_per_m;
  const double k_ru = s.ring.torsional_support_N_per_m;
  const double k_cu = s.carrier.torsional_support_N_per_m;
  if (s.planet.torsional_support_N_per_m) out.add("/lumped/planet" + key, "is of gear 2 of a pair; planets have none");
  const std::string name(
      std::ranges::find(boundary_names, s.boundary, [](const auto& named) { return named.second; })->first);
  const auto must_rotate = [&](const char* member, double k) {
    if (k != 0.0)
      out.add(std::string("/lumped/") + member + key, "must be 0 with boundary ", name, ", where the ", member,
              " is free (", k, ")");
  };
  if (s.boundary == Boundary::fixed_sun || s.boundary == Boundary::free) {
    must_rotate("ring", k_ru);
    must_rotate("carrier", k_cu);
    if (s.boundary == Boundary::free)
      must_rotate("sun", k_su);
    else if (!(k_su > 0.0) || !std::isfinite(k_su))
      out.add("/lumped/sun" + key, "must be a positive number with boundary fixed_sun, where the sun is grounded (",
              k_su, ")");
    return;
  }
  if (k_su != 0.0)
    out.add("/lumped/sun" + key, "must be 0 with boundary ", name, ", where the sun is driven (", k_su, ")");
  if (s.boundary == Boundary::fixed_ring) {
    if (!(k_ru > 0.0))
      out.add("/lumped/ring" + key, "must be positive or \"rigid\" with boundary fixed_ring (", k_ru, ")");
    if (k_cu != 0.0)
      out.add("/lumped/carrier" + key, "must be 0 with boundary fixed_ring, where the carrier is the output (", k_cu,
              ")");
  } else {
    if (k_ru != 0.0)
      out.add("/lumped/ring" + key, "must be 0 with boundary ", name, ", where the ring is free (", k_ru, ")");
    if (!(k_cu > 0.0) || !std::isfinite(k_cu))
      out.add("/lumped/carrier" + key, "must be a positive number with boundary ", name,
              ", where the carrier is grounded (", k_cu, ")");
  }
}

/// Power enters through the sun or through the other member that is not held.
void check_driver(Problems& out, const Stage& s) {
  if (s.boundary == Boundary::fixed_sun) {
    if (s.driver == Driver::sun)
      out.add("/driver", "must be carrier or ring with boundary fixed_sun, where the sun is held");
    return;
  }
  if (s.driver == Driver::sun) return;
  const bool carrier = s.driver == Driver::carrier;
  if (s.boundary == Boundary::free) {
    if (!carrier) out.add("/driver", "must be sun or carrier with boundary free");
    return;
  }
  if (s.boundary == Boundary::as_printed)
    out.add("/driver", "must be sun with boundary as_printed, whose equations have no other drive");
  else if (carrier != (s.boundary == Boundary::fixed_ring))
    out.add("/driver", carrier ? "must be sun or ring with boundary star, where the carrier is held"
                               : "must be sun or carrier with boundary fixed_ring, where the ring is held");
}

/// The speeds of a differential.
void check_speed_ratio(Problems& out, const Stage& s) {
  const std::string key = "/carrier_to_sun_speed";
  if (s.carrier_to_sun_speed.has_value() != (s.boundary == Boundary::free))
    out.add(key, s.carrier_to_sun_speed ? "is for boundary free only" : "is missing; boundary free needs it");
  if (s.boundary == Boundary::free && s.load.power_kW)
    out.add("/load/power_kW", "is shared by three members with boundary free; give torque_Nm");
}

/// Errors that repeat with the rotation of a member.
void check_shaft_errors(Problems& out, const Stage& s) {
  const auto phase_needs_amount = [&](const std::string& place, bool phase, bool amount) {
    if (phase && !amount) out.add(place + "/eccentricity_phase_deg", "needs eccentricity_um");
  };
  for (const auto& [place, member] : {std::pair("/lumped/sun", &s.sun), std::pair("/lumped/ring", &s.ring),
                                      std::pair("/lumped/carrier", &s.carrier)}) {
    const ShaftErrors& e = member->errors;
    phase_needs_amount(place, e.eccentricity_phase_deg.has_value(), e.eccentricity_um.has_value());
    if (e.pitch_error_um && member->teeth && static_cast<int>(e.pitch_error_um->size()) != *member->teeth)
      out.add(std::string(place) + "/pitch_error_um", "has ", static_cast<double>(e.pitch_error_um->size()),
              " numbers; one for each of ", static_cast<double>(*member->teeth), " teeth is needed");
  }
  const std::string planet = "/lumped/planet";
  phase_needs_amount(planet, s.planet.eccentricity_phase_deg.has_value(), s.planet.eccentricity_um.has_value());
  for (const auto& [key, errors] : {std::pair("/pitch_error_um", &s.planet.pitch_error_um),
                                    std::pair("/pitch_error_ring_um", &s.planet.pitch_error_ring_um)}) {
    if (!*errors || !s.planet.teeth) continue;
    const auto count = static_cast<int>((*errors)->size());
    if (count != *s.planet.teeth && count != *s.planet.teeth * s.planet_count)
      out.add(planet + key, "has ", static_cast<double>(count), " numbers; one for each of ",
              static_cast<double>(*s.planet.teeth), " teeth is needed, of all planets or of one after the other");
  }
  if (s.is_pair() && s.planet.pitch_error_ring_um)
    out.add(planet + "/pitch_error_ring_um", "must be left out: a pair has no ring; gear 2 has pitch_error_um");
  if (s.planet.eccentricity_um)
    check_per_planet(out, planet + "/eccentricity_um", *s.planet.eccentricity_um, s.planet_count);
  if (s.planet.eccentricity_phase_deg)
    check_per_planet(out, planet + "/eccentricity_phase_deg", *s.planet.eccentricity_phase_deg, s.planet_count);
  if (s.sun.teeth && s.planet.teeth && (s.ring.teeth || s.is_pair()) && s.mesh_periods() > mesh_periods_max)
    out.add("/lumped", "errors of several shafts repeat after more than ", static_cast<double>(mesh_periods_max),
            " mesh periods, the least common multiple of the teeth; give the errors of fewer members at once");
}

void check_compatibility(Problems& out, const Stage& s) {
  if (!s.sun.teeth || !s.sun.base_radius_mm) return;
  if (!s.is_pair()) {
    if (!s.ring.teeth || !s.ring.base_radius_mm) return;
    const double radii = *s.ring.base_radius_mm / *s.sun.base_radius_mm;
    const double teeth = static_cast<double>(*s.ring.teeth) / *s.sun.teeth;
    if (std::abs(radii / teeth - 1.0) > radii_tolerance)
      out.add("/lumped/ring/base_radius_mm", "r_br / r_bs = ", radii, " does not fit z_r / z_s = ", teeth,
              " (relative difference at most ", radii_tolerance, ")");
  }
  if (!s.planet.teeth || !s.planet.base_radius_mm) return;
  const double planet_radii = *s.planet.base_radius_mm / *s.sun.base_radius_mm;
  const double planet_teeth = static_cast<double>(*s.planet.teeth) / *s.sun.teeth;
  if (std::abs(planet_radii / planet_teeth - 1.0) > radii_tolerance)
    out.add("/lumped/planet/base_radius_mm", "r_bp / r_bs = ", planet_radii, " does not fit z_p / z_s = ", planet_teeth,
            " (relative difference at most ", radii_tolerance, ")");
}

void check_mesh_for_dynamics(Problems& out, const std::string& pointer, const Mesh& mesh) {
  if (!mesh.damping_ratio) out.add(pointer + "/damping_ratio", "is missing; time integration needs it");
}

/// A member of which nothing is given.
bool is_absent(const CentralMember& m) { return m.mass_kg == 0.0 && m.inertia_over_r2_kg == 0.0 && !m.errors.repeat(); }

/// Members and meshes of a planetary stage beside sun and planets.
void check_stage_members(Problems& out, const Stage& s) {
  check_member(out, "/lumped/ring", s.ring);
  check_member(out, "/lumped/carrier", s.carrier);
  check_positive(out, "/lumped/ring_planet_mesh/stiffness_N_per_m", s.ring_planet_mesh.stiffness_N_per_m);
  check_pressure_angle(out, "/lumped/ring_planet_mesh", s.ring_planet_mesh,
                       sum(s.ring.base_radius_mm, s.planet.base_radius_mm, -1.0), s.centre_distance_mm);
}

/// A pair has no ring and no carrier.
void check_pair_members(Problems& out, const Stage& s) {
  for (const auto& [pointer, member] : {std::pair("/lumped/ring", &s.ring), std::pair("/lumped/carrier", &s.carrier)})
    if (!is_absent(*member)) out.add(pointer, "must be left out: a pair has gear 1 (sun) and gear 2 (planet) alone");
  if (s.ring_planet_mesh.stiffness_N_per_m != 0.0)
    out.add("/lumped/ring_planet_mesh", "must be left out: a pair has one mesh, sun_planet_mesh");
  if (s.planet.pin_error_tangential_um || s.planet.pin_error_radial_um)
    out.add("/lumped/planet", "pin errors are of planets in a carrier; a pair has error_mean_um of its mesh");
  if (s.driver != Driver::sun) out.add("/driver", "must be sun: gear 1 drives a pair");
  if (s.planet.torsional_support_N_per_m)
    check_support(out, "/lumped/planet/torsional_support_N_per_m", *s.planet.torsional_support_N_per_m);
}

/// Bearings of a pair are rigid together or not at all; its torsional supports are finite.
void check_pair_supports(Problems& out, const Stage& s) {
  if (std::isfinite(s.sun.support_N_per_m) != std::isfinite(s.planet.bearing_N_per_m))
    out.add("/lumped/planet/bearing_N_per_m",
            "must be \"rigid\" if the support of gear 1 is, and a number if it is a number");
  check_finite_support(out, "/lumped/sun/torsional_support_N_per_m", s.sun.torsional_support_N_per_m);
  check_finite_support(out, "/lumped/planet/torsional_support_N_per_m",
                       s.planet.torsional_support_N_per_m.value_or(0.0));
}

/// Harmonics of the torques, which gear 1 and gear 2 of a pair have.
void check_torque_harmonics(Problems& out, const Stage& s) {
  const struct {
    const char* key;
    const std::optional<std::vector<double>>& ratios;
  } all[] = {{"/load/input_torque_cos", s.load.input_cos},
             {"/load/input_torque_sin", s.load.input_sin},
             {"/load/output_torque_cos", s.load.output_cos},
             {"/load/output_torque_sin", s.load.output_sin}};
  for (const auto& [key, ratios] : all)
    if (ratios && !s.is_pair()) out.add(key, "is for boundary pair only");
}

/// Each number of the planets; the pointer is that of the planet if there are several.
template <class Check>
void for_each_planet(const std::string& pointer, const PerPlanet& values, const Check& check) {
  const std::vector<double>& all = values.values();
  for (std::size_t i = 0; i < all.size(); ++i)
    check(all.size() == 1 ? pointer : pointer + "/" + std::to_string(i), all[i]);
}

/// Masses, inertias and bearings of the planets.
void check_planets(Problems& out, const Stage& s) {
  const std::string place = "/lumped/planet/";
  for (const auto& [key, values] :
       {std::pair("mass_kg", &s.planet.mass_kg), std::pair("inertia_over_r2_kg", &s.planet.inertia_over_r2_kg),
        std::pair("bearing_N_per_m", &s.planet.bearing_N_per_m)})
    check_per_planet(out, place + key, values->values(), s.planet_count);
  const auto positive = [&](const std::string& pointer, double value) { check_positive(out, pointer, value); };
  for_each_planet(place + "mass_kg", s.planet.mass_kg, positive);
  for_each_planet(place + "inertia_over_r2_kg", s.planet.inertia_over_r2_kg, positive);
  for_each_planet(place + "bearing_N_per_m", s.planet.bearing_N_per_m,
                  [&](const std::string& pointer, double value) { check_support(out, pointer, value); });
}

/// What else is wrong cannot be said of another number of planets.
bool has_allowed_count(const Stage& s) {
  return s.is_pair() ? s.planet_count == 1 : s.planet_count >= planets_min && s.planet_count <= planets_max;
}

}  // namespace

int Stage::mesh_periods() const {
  int periods = 1;
  const auto repeats = [&](bool has_errors, const std::optional<int>& teeth) {
    if (has_errors) periods = std::min(std::lcm(periods, teeth.value_or(1)), mesh_periods_max + 1);
  };
  repeats(sun.errors.repeat(), sun.teeth);
  repeats(planet.repeat(), planet.teeth);
  repeats(ring.errors.repeat(), ring.teeth);
  return periods;
}

std::vector<double> Stage::planet_angles_deg() const {
  if (!angles_deg.empty()) return angles_deg;
  std::vector<double> angles;
  for (int i = 0; i < planet_count; ++i) angles.push_back(360.0 * i / planet_count);
  return angles;
}

std::vector<double> Stage::angles_along_torque_deg() const {
  std::vector<double> angles = planet_angles_deg();
  if (is_mirrored(*this))
    for (double& angle : angles) angle = -angle;
  return angles;
}

double assembly_angle_deg(int sun_and_ring_teeth, double first_deg, double angle_deg) {
  return first_deg + 360.0 * std::round(sun_and_ring_teeth * (angle_deg - first_deg) / 360.0) / sun_and_ring_teeth;
}

std::vector<Misfit> assembly_misfits(const Stage& stage) {
  if (!stage.sun.teeth || !stage.ring.teeth) return {};
  constexpr double angle_digits_deg = 1e-3;
  const std::vector<double> angles = stage.planet_angles_deg();
  std::vector<Misfit> misfits;
  for (std::size_t i = 1; i < angles.size(); ++i) {
    const double nearest = assembly_angle_deg(*stage.sun.teeth + *stage.ring.teeth, angles[0], angles[i]);
    if (std::abs(angles[i] - nearest) > angle_digits_deg) misfits.push_back({i, angles[i], nearest});
  }
  return misfits;
}

std::vector<std::string> problems_for_modes(const Stage& s) {
  Problems out;
  if (!has_allowed_count(s)) {
    const auto count = static_cast<double>(s.planet_count);
    if (s.is_pair())
      out.add("/planets/count", "must be 1 with boundary pair (", count, ")");
    else
      out.add("/planets/count", "must be ", static_cast<double>(planets_min), " to ", static_cast<double>(planets_max),
              " (", count, ")");
    return out.take();
  }
  check_angles(out, s);
  check_member(out, "/lumped/sun", s.sun);
  check_planets(out, s);
  check_positive(out, "/lumped/sun_planet_mesh/stiffness_N_per_m", s.sun_planet_mesh.stiffness_N_per_m);
  check_pressure_angle(out, "/lumped/sun_planet_mesh", s.sun_planet_mesh,
                       sum(s.sun.base_radius_mm, s.planet.base_radius_mm, 1.0), s.centre_distance_mm);
  if (s.is_pair())
    check_pair_members(out, s);
  else
    check_stage_members(out, s);
  return out.take();
}

std::vector<std::string> problems_for_dynamics(const Stage& s) {
  Problems out;
  if (!has_allowed_count(s)) return {};  // problems_for_modes() says so
  check_dynamics_of_member(out, "/lumped/sun", s.sun);
  if (!s.is_pair()) check_dynamics_of_member(out, "/lumped/ring", s.ring);
  if (!s.planet.teeth) out.add("/lumped/planet/teeth", "is missing; time integration needs it");
  if (!s.planet.base_radius_mm) out.add("/lumped/planet/base_radius_mm", "is missing; time integration needs it");
  if (!s.is_pair()) {
    if (!s.centre_distance_mm) out.add("/planets/centre_distance_mm", "is missing; time integration needs it");
    check_finite_support(out, "/lumped/sun/support_N_per_m", s.sun.support_N_per_m);
    check_finite_support(out, "/lumped/ring/support_N_per_m", s.ring.support_N_per_m);
    check_finite_support(out, "/lumped/carrier/support_N_per_m", s.carrier.support_N_per_m);
    check_finite_support(out, "/lumped/planet/bearing_N_per_m", s.planet.bearing_N_per_m);
  }
  for_each_planet("/lumped/planet/bearing_N_per_m", s.planet.bearing_N_per_m,
                  [&](const std::string& pointer, double value) {
                    if (!(value > 0.0)) out.add(pointer, "must be positive (", value, ")");
                  });
  if (s.is_pair()) {
    check_pair_supports(out, s);
  } else {
    check_torsion(out, s);
    check_driver(out, s);
  }
  check_torque_harmonics(out, s);
  check_speed_ratio(out, s);
  check_shaft_errors(out, s);
  check_compatibility(out, s);
  const struct {
    const char* pointer;
    const Mesh& mesh;
  } meshes[] = {{"/lumped/sun_planet_mesh", s.sun_planet_mesh}, {"/lumped/ring_planet_mesh", s.ring_planet_mesh}};
  for (const auto& [pointer, mesh] : std::span(meshes).first(s.is_pair() ? 1 : 2)) {
    check_mesh_for_dynamics(out, pointer, mesh);
    check_per_planet(out, std::string(pointer) + "/error_amplitude_um", mesh.error_amplitude_um, s.planet_count);
    check_per_planet(out, std::string(pointer) + "/error_phase_deg", mesh.error_phase_deg, s.planet_count);
    if (mesh.error_mean_um)
      check_per_planet(out, std::string(pointer) + "/error_mean_um", *mesh.error_mean_um, s.planet_count);
    if (mesh.error_curve) check_error_curve(out, std::string(pointer) + "/error_curve", *mesh.error_curve);
    if (mesh.stiffness_curve)
      check_stiffness_curve(out, pointer, mesh);
    else
      check_stiffness(out, pointer, mesh);
    if (mesh.friction.ehl) check_ehl(out, std::string(pointer) + "/friction/lubricated", *mesh.friction.ehl);
    if (mesh.friction.table) check_friction_table(out, std::string(pointer) + "/friction", *mesh.friction.table);
  }
  for (const auto& [key, errors] :
       {std::pair("tangential", &s.planet.pin_error_tangential_um), std::pair("radial", &s.planet.pin_error_radial_um)})
    if (*errors)
      check_per_planet(out, std::string("/lumped/planet/pin_error_") + key + "_um", **errors, s.planet_count);
  if (s.planet.bearing_clearance_half_um && !std::isfinite(s.planet.bearing_N_per_m))
    out.add("/lumped/planet/bearing_clearance_half_um", "needs a bearing that is not rigid");
  const bool hertzian =
      s.sun_bearing.law == BearingLaw::palmgren_xy || s.sun_bearing.law == BearingLaw::palmgren_radial;
  if (hertzian && !s.sun_bearing.balls) out.add("/lumped/sun/bearing/balls", "is missing; the Palmgren laws need it");
  if (hertzian && !s.sun_bearing.ball_diameter_mm)
    out.add("/lumped/sun/bearing/ball_diameter_mm", "is missing; the Palmgren laws need it");
  if (s.load.power_kW.has_value() == s.load.torque_Nm.has_value())
    out.add("/load", s.load.power_kW ? "power_kW and torque_Nm exclude each other" : "needs power_kW or torque_Nm");
  constexpr double least_torque = 1e-9;
  if (s.load.torque_Nm && !(std::abs(*s.load.torque_Nm) >= least_torque))
    out.add("/load/torque_Nm", "must be at least 1e-9 N m, of either sign (", *s.load.torque_Nm, ")");
  return out.take();
}

}  // namespace epicyclic::gear
