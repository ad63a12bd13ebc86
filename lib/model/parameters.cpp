#include "model/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "core/errors.hpp"
#include "gear/bearing.hpp"
#include "gear/ehl_friction.hpp"
#include "gear/friction_path.hpp"
#include "gear/kinematics.hpp"
#include "gear/reversal.hpp"
#include "model/layout.hpp"

namespace epicyclic::model {

namespace {

constexpr double radian = std::numbers::pi / 180.0;
constexpr double two_pi = 2.0 * std::numbers::pi;

// Phases nearer than this are one: rounding of z phi / 2 pi for the planets of one set.
constexpr double phase_resolution = 1e-11;

double wrapped(double phase) {
  const double w = phase - std::floor(phase);
  return w > 1.0 - phase_resolution ? 0.0 : w;
}

double per_planet(const std::vector<double>& values, std::size_t i) {
  return values.size() == 1 ? values[0] : values[i];
}

/// Values of rows that are kept.
std::vector<double> kept(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> r;
  for (const std::size_t k : rows) r.push_back(values[k]);
  return r;
}

/// Every second row of a smooth function is sufficient for an estimate of the error of all rows. Other rows stay as
/// they are.
gear::StiffnessCurve halved(gear::StiffnessCurve curve) {
  if (curve.interpolation != Interpolation::smooth) return curve;
  const auto rows = every_second(curve.phase, curve.breakpoints);
  curve.phase = kept(curve.phase, rows);
  curve.stiffness_N_per_m = kept(curve.stiffness_N_per_m, rows);
  return curve;
}
gear::ErrorCurve halved(gear::ErrorCurve curve) {
  if (curve.interpolation != Interpolation::smooth) return curve;
  const auto rows = every_second(curve.phase, curve.breakpoints);
  curve.phase = kept(curve.phase, rows);
  curve.error_um = kept(curve.error_um, rows);
  return curve;
}
gear::EhlFriction halved(gear::EhlFriction e) {
  if (e.share_interpolation != Interpolation::smooth) return e;
  const auto rows = every_second(e.share_position, {});
  e.share_position = kept(e.share_position, rows);
  e.share = kept(e.share, rows);
  return e;
}

/// A cos h(s + psi) + B sin h(s + psi) as harmonics of s, psi = 2 pi phase_cycles; backward - B, of e as a function
/// [G-rev].
template <std::size_t N>
void add_harmonic(Row<double, N>& cosine, Row<double, N>& sine, std::size_t planet, double a, double b, double psi) {
  cosine[planet] += a * std::cos(psi) + b * std::sin(psi);
  sine[planet] += b * std::cos(psi) - a * std::sin(psi);
}

/// Harmonics of the error beside the sine of each planet, and the table.                                  [M-e]
template <std::size_t N>
void fill_further_errors(MeshParameters<double, N>& m, const gear::Mesh& mesh, const Scales& scales, bool halve,
                         bool backward) {
  if (mesh.error_curve) {
    const gear::ErrorCurve curve = halve ? halved(*mesh.error_curve) : *mesh.error_curve;
    m.error_curve = std::make_shared<PeriodicTrack<3>>(
        error_track(backward ? gear::reversed(curve) : curve, scales.displacement_um(1.0)));
  }
  const std::vector<double> none;
  const std::vector<double>& a = mesh.error_cos_um ? *mesh.error_cos_um : none;
  const std::vector<double>& b = mesh.error_sin_um ? *mesh.error_sin_um : none;
  const std::size_t harmonics = std::max(a.size(), b.size());
  const std::size_t further = harmonics > 1 ? harmonics - 1 : 0;
  m.further_error_cos.assign(further, Row<double, N>(0.0));
  m.further_error_sin.assign(further, Row<double, N>(0.0));
  const auto amplitude = [&](const std::vector<double>& um, std::size_t h) {
    return h < um.size() ? scales.displacement(um[h] * 1e-6) : 0.0;
  };
  for (std::size_t h = 0; h < harmonics; ++h)
    for (std::size_t i = 0; i < N; ++i)
      add_harmonic(h == 0 ? m.error_cos : m.further_error_cos[h - 1], h == 0 ? m.error_sin : m.further_error_sin[h - 1],
                   i, amplitude(a, h), backward ? -amplitude(b, h) : amplitude(b, h),
                   static_cast<double>(h + 1) * two_pi * m.phase_cycles[i]);
}

/// Completes a mesh whose sines and cosines are known.
/// @param mesh_cycles  mesh phase of a planet per revolution of its angle: -z_s or +z_r
template <std::size_t N>
void fill_mesh(MeshParameters<double, N>& m, const gear::Mesh& mesh, const std::vector<double>& angles_deg,
               int mesh_cycles, double lead, double effective_mass, const Scales& scales, bool halve, bool backward) {
  m.half_gap = scales.displacement(mesh.backlash_half_um * 1e-6);
  m.stiffness = scales.stiffness(mesh.stiffness_N_per_m);
  m.damping =
      scales.damping(2.0 * mesh.damping_ratio.value_or(0.0) * std::sqrt(mesh.stiffness_N_per_m * effective_mass));
  if (mesh.stiffness_curve) {
    const gear::StiffnessCurve curve = halve ? halved(*mesh.stiffness_curve) : *mesh.stiffness_curve;
    m.stiffness_curve = std::make_shared<PeriodicTrack<1>>(
        stiffness_track(backward ? gear::reversed(curve) : curve, 1.0 / scales.stiffness(1.0)));
  }
  const double along = backward ? -1.0 : 1.0;  // of the mesh's position with the phase s
  m.harmonics = std::max(mesh.stiffness_cos_N_per_m.size(), mesh.stiffness_sin_N_per_m.size());
  m.stiffness_cos.resize(m.harmonics);
  m.stiffness_sin.resize(m.harmonics);
  for (std::size_t i = 0; i < N; ++i) {
    m.phase_cycles[i] = wrapped(along * (mesh_cycles * (angles_deg[i] - angles_deg[0]) / 360.0 + lead));
    for (std::size_t h = 0; h < m.harmonics; ++h) {
      // A cos h(s + psi) + B sin h(s + psi), psi = 2 pi phase_cycles; backward - B [G-rev]
      const double c = h < mesh.stiffness_cos_N_per_m.size() ? scales.stiffness(mesh.stiffness_cos_N_per_m[h]) : 0.0;
      const double s =
          h < mesh.stiffness_sin_N_per_m.size() ? along * scales.stiffness(mesh.stiffness_sin_N_per_m[h]) : 0.0;
      const double psi = static_cast<double>(h + 1) * two_pi * m.phase_cycles[i];
      m.stiffness_cos[h][i] = c * std::cos(psi) + s * std::sin(psi);
      m.stiffness_sin[h][i] = s * std::cos(psi) - c * std::sin(psi);
    }
    const double amplitude = along * scales.displacement(per_planet(mesh.error_amplitude_um, i) * 1e-6);
    const double theta = two_pi * m.phase_cycles[i] + along * per_planet(mesh.error_phase_deg, i) * radian;
    m.error_cos[i] = amplitude * std::sin(theta);
    m.error_sin[i] = amplitude * std::cos(theta);
    m.error_mean[i] = scales.displacement(mesh.error_mean_um ? per_planet(*mesh.error_mean_um, i) * 1e-6 : 0.0);
  }
  fill_further_errors(m, mesh, scales, halve, backward);
  constexpr double rounding = 1e-9;  // of a mesh period
  m.in_phase = true;
  for (const double cycles : m.phase_cycles) {
    const double apart = cycles - m.phase_cycles[0];
    m.in_phase = m.in_phase && std::abs(apart - std::round(apart)) <= rounding;
  }
}

/// Of lubricated contact.
/// @param grids  to take; as the error requires if there are none
gear::FrictionTable lubricated_table(const gear::EhlFriction& e, const gear::LineOfAction& line,
                                     const gear::MeshLoad& load, std::vector<IntervalGrid> grids, bool halve) {
  if (!halve) return gear::friction_table(e, line, load, grids);
  if (grids.empty()) grids = gear::friction_table(e, line, load).grids;
  for (IntervalGrid& g : grids)
    if (g.can_be_halved()) g = g.halved();
  return gear::friction_table(halved(e), line, load, grids);
}

/// @param lead  difference from the common phase of a given table to the mesh's own phase; a path has its own phase
///              already
std::shared_ptr<const FrictionTrack> make_track(const gear::Friction& friction, const gear::Stage& stage,
                                                gear::LineOfAction (*line_of)(const gear::Stage&), double lead,
                                                const gear::MeshLoad& load, const FrictionTrack* like, bool halve) {
  if (!friction.any()) return nullptr;
  const gear::LineOfAction line = line_of(stage);
  const bool backward = stage.runs_backward();
  const auto track = [&](const gear::FrictionTable& table, double by) {
    return std::make_shared<FrictionTrack>(backward ? gear::reversed(table) : table, backward ? -by : by,
                                           line.base_radius_1_mm, line.base_radius_2_mm);
  };
  if (friction.table) return track(*friction.table, lead);
  if (friction.ehl) {
    std::vector<IntervalGrid> grids = like != nullptr ? like->grids() : std::vector<IntervalGrid>{};
    if (backward) grids = gear::reversed(std::move(grids));
    return track(lubricated_table(*friction.ehl, line, load, std::move(grids), halve), 0.0);
  }
  return track(gear::friction_table(*friction.coefficient, line), 0.0);
}

/// A pin that stands elsewhere moves the planet and so unloads its meshes, with t along the direction of the torque and
/// r outward:
///
///   e_0sp = t cos alpha_sp + r sin alpha_sp ,  e_0rp = t cos alpha_rp - r sin alpha_rp                    [M-pin]
///
/// So does a pin circle whose centre is beside the axis of the carrier. The change of the centrifugal force, of r /
/// r_c, is left out.
template <std::size_t N>
void add_pin_errors(Parameters<double, N>& p, const gear::Stage& stage, const Scales& scales) {
  const gear::PressureAngles alpha = gear::pressure_angles(stage);
  const double along_torque = gear::is_mirrored(stage) ? -1.0 : 1.0;
  const auto add = [&](const std::optional<std::vector<double>>& errors_um, double to_sun, double to_ring) {
    if (!errors_um) return;
    for (std::size_t i = 0; i < N; ++i) {
      const double error = scales.displacement(per_planet(*errors_um, i) * 1e-6);
      p.sun_planet.error_mean[i] += to_sun * error;
      p.ring_planet.error_mean[i] += to_ring * error;
    }
  };
  const auto tangential = [&](const std::optional<std::vector<double>>& errors_um) {
    add(errors_um, along_torque * std::cos(alpha.sun_planet), along_torque * std::cos(alpha.ring_planet));
  };
  const auto radial = [&](const std::optional<std::vector<double>>& errors_um) {
    add(errors_um, std::sin(alpha.sun_planet), -std::sin(alpha.ring_planet));
  };
  tangential(stage.planet.pin_error_tangential_um);
  radial(stage.planet.pin_error_radial_um);
  if (const auto& amount = stage.carrier.errors.eccentricity_um) {
    std::vector<double> ahead, outward;
    for (const double planet_deg : stage.planet_angles_deg()) {
      const double angle = (stage.carrier.errors.eccentricity_phase_deg.value_or(0.0) - planet_deg) * radian;
      ahead.push_back(*amount * std::sin(angle));
      outward.push_back(*amount * std::cos(angle));
    }
    tangential(ahead);
    radial(outward);
  }
}

/// Errors that repeat with the rotations of sun, planets and ring relative to the carrier, along the torque on the sun
/// (d = 1; against it d = -1), with phi_i from planet 1 for the teeth [M-shaft]:
///
///   sun      e_spi = - E_s sin(psi_s + d s / z_s + phi_spi)
///   planet   e_spi = E_p sin(theta + phi_spi) ,  e_rpi = E_p sin(theta - phi_rpi)
///            theta = phi_i + psi_pi - d s / z_p
///   ring     e_rpi = - E_r sin(psi_r - d s / z_r - phi_rpi)
///   teeth    e_i = p_k where tooth k passes planet i, by the trigonometric polynomial through all teeth;
///            of planets where d (s + 2 pi lambda_i) / z_p = 2 pi k / z_p, for each of both flanks
///
/// In the mirror image all angles have the other sign.
template <std::size_t N>
class Shafts {
 public:
  Shafts(Parameters<double, N>& p, const gear::Stage& stage, const Scales& scales)
      : p_(p),
        stage_(stage),
        scales_(scales),
        mirror_(gear::is_mirrored(stage) ? -1.0 : 1.0),
        along_(stage.runs_backward() ? -1.0 : 1.0),
        angles_(stage.angles_along_torque_deg()) {
    for (double& angle : angles_) angle *= radian;
  }

  void fill() {
    const gear::PressureAngles alpha = gear::pressure_angles(stage_);
    const auto line_sp = [&](std::size_t i) { return alpha.sun_planet - angles_[i]; };
    const auto line_rp = [&](std::size_t i) { return -alpha.ring_planet - angles_[i]; };
    add_central(stage_.sun, p_.sun_planet, along_, line_sp);
    add_central(stage_.ring, p_.ring_planet, -along_, line_rp);
    add_planets(p_.sun_planet, line_sp, stage_.planet.pitch_error_um);
    add_planets(p_.ring_planet, line_rp, stage_.planet.pitch_error_ring_um);
  }

 private:
  using Errors = ShaftErrors<double, N>;

  [[nodiscard]] double length(double um) const { return scales_.displacement(um * 1e-6); }

  static Errors none(int teeth, std::size_t harmonics) {
    return {1.0 / teeth, std::vector<Row<double, N>>(harmonics, 0.0), std::vector<Row<double, N>>(harmonics, 0.0)};
  }

  /// amplitude sin(phase + direction s / teeth).
  static void add_sine(Errors& errors, std::size_t i, double amplitude, double phase, double direction) {
    errors.cosine[0][i] += amplitude * std::sin(phase);
    errors.sine[0][i] += direction * amplitude * std::cos(phase);
  }

  /// @param direction  of the rotation relative to the carrier
  /// @param line       angle of the line of action of planet i
  template <class F>
  void add_central(const gear::CentralMember& member, MeshParameters<double, N>& mesh, double direction,
                   const F& line) {
    const auto& [eccentricity, phase_deg, pitch] = member.errors;
    if (!eccentricity && !pitch) return;
    const std::size_t teeth = pitch ? pitch->size() : 2;
    Errors errors = none(*member.teeth, std::min(gear::harmonics_max, teeth / 2));
    for (std::size_t i = 0; i < N; ++i) {
      if (eccentricity)
        add_sine(errors, i, -length(*eccentricity), mirror_ * phase_deg.value_or(0.0) * radian + line(i), direction);
      if (pitch) add_teeth(errors, mesh, i, *pitch, angles_[i] - angles_[0], direction);
    }
    mesh.shafts.push_back(std::move(errors));
  }

  /// sum_h c_h cos h (at - direction s / teeth - angle of the tooth), and the mean.
  void add_teeth(Errors& errors, MeshParameters<double, N>& mesh, std::size_t i, std::span<const double> pitch,
                 double at, double direction) const {
    const auto count = static_cast<double>(pitch.size());
    for (std::size_t h = 1; h <= errors.cosine.size(); ++h) {
      const double part = (2 * h == pitch.size() ? 1.0 : 2.0) / count;
      for (std::size_t k = 0; k < pitch.size(); ++k) {
        const double tooth = mirror_ * two_pi * static_cast<double>(k) / count;
        const double angle = static_cast<double>(h) * (at - tooth);
        errors.cosine[h - 1][i] += part * length(pitch[k]) * std::cos(angle);
        errors.sine[h - 1][i] += direction * part * length(pitch[k]) * std::sin(angle);
      }
    }
    mesh.error_mean[i] += length(std::accumulate(pitch.begin(), pitch.end(), 0.0) / count);
  }

  /// @param pitch  of the flanks in this mesh
  template <class F>
  void add_planets(MeshParameters<double, N>& mesh, const F& line, const std::optional<std::vector<double>>& pitch) {
    const auto& [amount, phase_deg] = std::tie(stage_.planet.eccentricity_um, stage_.planet.eccentricity_phase_deg);
    if (!amount && !pitch) return;
    const auto teeth = static_cast<std::size_t>(*stage_.planet.teeth);
    Errors errors = none(*stage_.planet.teeth, pitch ? std::min(gear::harmonics_max, teeth / 2) : 1);
    for (std::size_t i = 0; i < N; ++i) {
      if (amount) {
        const double own = phase_deg ? mirror_ * per_planet(*phase_deg, i) * radian : 0.0;
        add_sine(errors, i, length(per_planet(*amount, i)), angles_[i] + own + line(i), -along_);
      }
      if (pitch) {
        const std::span<const double> all(*pitch);
        add_teeth(errors, mesh, i, all.size() > teeth ? all.subspan(i * teeth, teeth) : all,
                  along_ * two_pi * mesh.phase_cycles[i] / static_cast<double>(teeth), -along_);
      }
    }
    mesh.shafts.push_back(std::move(errors));
  }

  Parameters<double, N>& p_;
  const gear::Stage& stage_;
  const Scales& scales_;
  double mirror_;
  double along_;
  std::vector<double> angles_;
};

template <std::size_t N>
void append_breakpoints(const MeshParameters<double, N>& mesh, std::vector<double>& phases) {
  const auto append = [&](const std::vector<double>& own_phases) {
    for (std::size_t i = 0; i < N; ++i)
      for (const double own : own_phases) phases.push_back(wrapped(own - mesh.phase_cycles[i]));
  };
  const auto append_of = [&](const auto& track) {
    append(track.breakpoints());
    append(track.spacing().stops());
  };
  if (mesh.friction) append_of(*mesh.friction);
  if (mesh.stiffness_curve) append_of(*mesh.stiffness_curve);
  if (mesh.error_curve) append_of(*mesh.error_curve);
}

/// d of [M-rows] of one kind of mesh at a common phase, in s. The highest of H harmonics is sampled twice a period.
template <std::size_t N>
double sampling_interval(const MeshParameters<double, N>& mesh, double common_phase) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < N; ++i) {
    const double own = common_phase + mesh.phase_cycles[i];
    if (mesh.friction) least = std::min(least, mesh.friction->spacing().at(own));
    if (mesh.stiffness_curve) least = std::min(least, mesh.stiffness_curve->spacing().at(own));
    if (mesh.error_curve) least = std::min(least, mesh.error_curve->spacing().at(own));
  }
  if (mesh.harmonics > 0) least = std::min(least, 0.5 / static_cast<double>(mesh.harmonics));
  if (!mesh.further_error_cos.empty())
    least = std::min(least, 0.5 / static_cast<double>(mesh.further_error_cos.size() + 1));
  return two_pi * least;
}

template <std::size_t N>
MeshPlaces<N> places(const MeshParameters<double, N>& mesh, double common_phase) {
  MeshPlaces<N> r{};
  for (std::size_t i = 0; i < N; ++i) {
    if (mesh.friction) r.friction[i] = mesh.friction->place(common_phase + mesh.phase_cycles[i]);
    if (mesh.stiffness_curve) r.stiffness[i] = mesh.stiffness_curve->place(common_phase + mesh.phase_cycles[i]);
    if (mesh.error_curve) r.error[i] = mesh.error_curve->place(common_phase + mesh.phase_cycles[i]);
  }
  return r;
}

template <std::size_t N>
void make_segments(Parameters<double, N>& p) {
  std::vector<double> phases;
  append_breakpoints(p.sun_planet, phases);
  append_breakpoints(p.ring_planet, phases);
  std::sort(phases.begin(), phases.end());
  phases.erase(std::unique(phases.begin(), phases.end(), [](double a, double b) { return b - a < phase_resolution; }),
               phases.end());
  // Segments are shorter than a period, so that a phase distinguishes the start of one from its end.
  if (phases.size() == 1) phases.push_back(wrapped(phases[0] + 0.5));
  std::sort(phases.begin(), phases.end());
  const auto add_segment = [&](double inside) {
    p.segments.push_back({places(p.sun_planet, inside), places(p.ring_planet, inside)});
    p.sampling_interval.push_back(
        std::min(sampling_interval(p.sun_planet, inside), sampling_interval(p.ring_planet, inside)));
  };
  for (std::size_t k = 0; k < phases.size(); ++k) {
    p.breakpoints.push_back(two_pi * phases[k]);
    const double next = k + 1 < phases.size() ? phases[k + 1] : phases[0] + 1.0;
    add_segment(wrapped(0.5 * (phases[k] + next)));
  }
  if (phases.empty()) add_segment(0.0);
  // The same in each mesh period.
  const std::size_t one = p.breakpoints.size();
  for (int period = 1; period < p.mesh_periods; ++period)
    for (std::size_t k = 0; k < one; ++k) {
      p.breakpoints.push_back(two_pi * period + p.breakpoints[k]);
      p.segments.push_back(p.segments[k]);
      p.sampling_interval.push_back(p.sampling_interval[k]);
    }
}

struct GyroscopicForm {
  bool on, relative, carrier_row;
};

GyroscopicForm gyroscopic_form(gear::Boundary boundary, Gyroscopic wanted) {
  if (wanted == Gyroscopic::automatic)
    wanted = boundary == gear::Boundary::as_printed ? Gyroscopic::as_printed : Gyroscopic::invariant;
  return {wanted != Gyroscopic::off, wanted == Gyroscopic::invariant, wanted == Gyroscopic::carrier_row};
}

/// Masses and inertias over m_p, and their inverses.
template <std::size_t N>
void fill_bodies(Parameters<double, N>& p, const gear::Stage& stage, const Scales& scales) {
  const auto ratio = [&](double kg) { return scales.mass_ratio(kg); };
  for (std::size_t i = 0; i < N; ++i) {
    p.mass_p[i] = ratio(stage.planet.mass_kg[i]);
    p.inertia_p[i] = ratio(stage.planet.inertia_over_r2_kg[i]);
    p.inverse_mass_p[i] = 1.0 / p.mass_p[i];
    p.inverse_inertia_p[i] = 1.0 / p.inertia_p[i];
  }
  p.planets_mass = static_cast<double>(N) * ratio(stage.planet.mass_kg);
  p.mass_s = ratio(stage.sun.mass_kg);
  p.mass_r = ratio(stage.ring.mass_kg);
  p.mass_c = ratio(stage.carrier.mass_kg);
  p.inertia_s = ratio(stage.sun.inertia_over_r2_kg);
  p.inertia_r = ratio(stage.ring.inertia_over_r2_kg);
  p.inertia_c = ratio(stage.carrier.inertia_over_r2_kg);
  p.inverse_mass_s = 1.0 / p.mass_s;
  p.inverse_mass_r = 1.0 / p.mass_r;
  p.inverse_mass_c = 1.0 / p.mass_c;
  p.inverse_inertia_s = 1.0 / p.inertia_s;
  p.inverse_inertia_r = 1.0 / p.inertia_r;
  p.inverse_inertia_c = 1.0 / p.inertia_c;
}

/// Stiffness and damping of what holds the members, and the law of the sun's bearing.
template <std::size_t N>
void fill_supports(Parameters<double, N>& p, const gear::Stage& stage, const Scales& scales) {
  // Nothing moves against a rigid one.
  const auto stiffness = [&](double value) { return std::isfinite(value) ? scales.stiffness(value) : 0.0; };
  const auto support = [&](const gear::CentralMember& m) { return stiffness(m.support_N_per_m); };
  const auto support_damping = [&](const gear::CentralMember& m) {
    return scales.damping(m.damping.of(m.support_N_per_m, m.mass_kg));
  };
  // No support, no dashpot: a member that is free in rotation has nothing to be damped against.
  const auto torsion = [&](const gear::CentralMember& m) { return stiffness(m.torsional_support_N_per_m); };
  const auto dashpot = [&](double torsion_N_per_m, const auto& m) {
    return torsion_N_per_m == 0.0 ? 0.0 : scales.damping(m.damping.of(torsion_N_per_m, m.inertia_over_r2_kg));
  };
  const auto torsion_damping = [&](const gear::CentralMember& m) { return dashpot(m.torsional_support_N_per_m, m); };
  const double planet_torsion = stage.planet.torsional_support_N_per_m.value_or(0.0);
  p.support_s = support(stage.sun);
  p.support_r = support(stage.ring);
  p.support_c = support(stage.carrier);
  p.damping_s = support_damping(stage.sun);
  p.damping_r = support_damping(stage.ring);
  p.damping_c = support_damping(stage.carrier);
  p.torsion_r = torsion(stage.ring);
  p.torsion_c = torsion(stage.carrier);
  p.torsion_damping_r = torsion_damping(stage.ring);
  p.torsion_damping_c = torsion_damping(stage.carrier);
  p.torsion_s = torsion(stage.sun);
  p.torsion_p = stiffness(planet_torsion);
  p.torsion_damping_s = torsion_damping(stage.sun);
  p.torsion_damping_p = dashpot(planet_torsion, stage.planet);
  for (std::size_t i = 0; i < N; ++i) {
    const double bearing = stage.planet.bearing_N_per_m[i];
    p.bearing_p[i] = stiffness(bearing);
    p.bearing_damping_p[i] = scales.damping(stage.planet.damping.of(bearing, stage.planet.mass_kg[i]));
  }
  p.planet_half_gap = scales.displacement(stage.planet.bearing_clearance_half_um.value_or(0.0) * 1e-6);
  p.planet_gap = stage.planet.bearing_clearance_half_um.has_value();
  p.sun_half_gap = scales.displacement(stage.sun_bearing.clearance_half_um * 1e-6);
  p.sun_law = stage.sun_bearing.law;
  const bool hertzian = p.sun_law == gear::BearingLaw::palmgren_xy || p.sun_law == gear::BearingLaw::palmgren_radial;
  p.sun_hertz = hertzian ? scales.hertz(gear::palmgren_coefficient(stage.sun_bearing)) : 0.0;
}

/// Torques as forces at the base radii and at the planets' centres.
template <std::size_t N>
void fill_loads(Parameters<double, N>& p, const gear::Stage& stage, const Scales& scales, double mesh_frequency) {
  const gear::Torques torque = gear::torques(stage, mesh_frequency);
  constexpr double m_per_mm = 1e-3;
  p.drive = scales.force(torque.sun / (*stage.sun.base_radius_mm * m_per_mm));
  if (stage.boundary == gear::Boundary::fixed_sun) p.drive = 0.0;  // its support bears the torque
  if (stage.is_pair()) {
    // The torque on gear 2 is the static force on its base circle, whatever the digits of the radii.
    p.output_load = p.drive;
    p.ring_drive = p.carrier_load = 0.0;
    const gear::Load& load = stage.load;
    p.input_cos = load.input_cos.value_or(std::vector<double>{});
    p.input_sin = load.input_sin.value_or(std::vector<double>{});
    p.output_cos = load.output_cos.value_or(std::vector<double>{});
    p.output_sin = load.output_sin.value_or(std::vector<double>{});
    p.torque_harmonics = std::max({p.input_cos.size(), p.input_sin.size(), p.output_cos.size(), p.output_sin.size()});
    for (auto* list : {&p.input_cos, &p.input_sin, &p.output_cos, &p.output_sin}) list->resize(p.torque_harmonics);
    return;
  }
  p.output_load = 0.0;
  p.ring_drive = scales.force(torque.ring / (*stage.ring.base_radius_mm * m_per_mm));
  p.carrier_load = scales.force(torque.carrier / (*stage.centre_distance_mm * m_per_mm));
}

/// Both meshes with their friction.
/// @param like  as for make_parameters()
template <std::size_t N>
void fill_meshes(Parameters<double, N>& p, const gear::Stage& stage, const Scales& scales, double mesh_frequency,
                 bool halved_tables, const Parameters<double, N>* like) {
  const std::vector<double> angles = stage.angles_along_torque_deg();
  const bool backward = stage.runs_backward();
  const auto reduced = [](double a, double b) { return 1.0 / (1.0 / a + 1.0 / b); };
  const double m_s = stage.sun.inertia_over_r2_kg;
  const double m_p = stage.planet.inertia_over_r2_kg;
  fill_mesh(p.sun_planet, stage.sun_planet_mesh, angles, -*stage.sun.teeth, 0.0, reduced(m_s, m_p), scales,
            halved_tables, backward);
  const auto friction = [&, load = gear::mean_mesh_load(stage, mesh_frequency)](
                            const gear::Friction& f, auto line_of, double lead,
                            MeshParameters<double, N> Parameters<double, N>::*mesh) {
    const FrictionTrack* other = like != nullptr ? (like->*mesh).friction.get() : nullptr;
    (p.*mesh).friction = make_track(f, stage, line_of, lead, load, other, halved_tables);
  };
  friction(stage.sun_planet_mesh.friction, gear::sun_planet_line, 0.0, &Parameters<double, N>::sun_planet);
  if (stage.is_pair()) return;
  const double m_r = stage.ring.inertia_over_r2_kg;
  fill_mesh(p.ring_planet, stage.ring_planet_mesh, angles, *stage.ring.teeth, stage.ring_mesh_lead_1, reduced(m_p, m_r),
            scales, halved_tables, backward);
  friction(stage.ring_planet_mesh.friction, gear::ring_planet_line, stage.ring_mesh_lead_1,
           &Parameters<double, N>::ring_planet);
}

}  // namespace

template <std::size_t N>
Parameters<double, N> make_geometry(const gear::Stage& stage) {
  const gear::PressureAngles alpha = gear::pressure_angles(stage);
  const std::vector<double> angles = stage.angles_along_torque_deg();
  Parameters<double, N> p;
  p.cos_alpha_sp = std::cos(alpha.sun_planet);
  p.cos_alpha_rp = std::cos(alpha.ring_planet);
  for (std::size_t i = 0; i < N; ++i) {
    const double phi = angles[i] * radian;
    p.sin_phi[i] = std::sin(phi);
    p.cos_phi[i] = std::cos(phi);
    p.sun_planet.sine[i] = std::sin(alpha.sun_planet - phi);
    p.sun_planet.cosine[i] = std::cos(alpha.sun_planet - phi);
    p.ring_planet.sine[i] = std::sin(alpha.ring_planet + phi);
    p.ring_planet.cosine[i] = std::cos(alpha.ring_planet + phi);
  }
  return p;
}

template <std::size_t N>
Parameters<double, N> make_parameters(const gear::Stage& stage, const Scales& scales, double mesh_frequency_ratio,
                                      const ModelOptions& options, const Parameters<double, N>* like) {
  options.validate();
  const double mesh_frequency = mesh_frequency_ratio * scales.omega_sn;
  Parameters<double, N> p = make_geometry<N>(stage);
  p.omega = mesh_frequency_ratio;
  fill_bodies(p, stage, scales);
  fill_supports(p, stage, scales);
  fill_loads(p, stage, scales, mesh_frequency);
  fill_meshes(p, stage, scales, mesh_frequency, options.halved_tables, like);
  add_pin_errors(p, stage, scales);
  Shafts<N>(p, stage, scales).fill();
  p.boundary = stage.boundary;
  p.mesh_periods = stage.mesh_periods();
  make_segments(p);
  if (p.torque_harmonics > 0)
    for (double& interval : p.sampling_interval)
      interval = std::min(interval, two_pi * 0.5 / static_cast<double>(p.torque_harmonics));

  const GyroscopicForm form = gyroscopic_form(stage.boundary, options.gyroscopic);
  const double direction = stage.runs_backward() ? -1.0 : 1.0;
  p.carrier_speed = form.on ? direction * gear::carrier_speed(stage, mesh_frequency) / scales.omega_sn : 0.0;
  for (std::size_t i = 0; i < N; ++i)
    p.centrifugal[i] =
        options.centrifugal == Centrifugal::included
            ? scales.force(gear::planet_centrifugal_force(stage, mesh_frequency, stage.planet.mass_kg[i]))
            : 0.0;
  p.gyroscopic_relative = form.relative;
  p.gyroscopic_carrier_row = form.carrier_row;
  p.smooth = options.clearance_smoothing > 0.0;
  p.smoothing = options.clearance_smoothing;
  p.gap_damping = options.gap_damping;
  return p;
}

template <std::size_t N>
std::vector<double> constant_values(const Parameters<double, N>& p) {
  std::vector<double> values;
  for_each_constant(p, [&](double x) { values.push_back(x); });
  return values;
}

#define EPICYCLIC_INSTANTIATE(N)                                                                                    \
  template std::vector<double> constant_values<N>(const Parameters<double, N>&);                                    \
  template Parameters<double, N> make_geometry<N>(const gear::Stage&);                                              \
  template Parameters<double, N> make_parameters<N>(const gear::Stage&, const Scales&, double, const ModelOptions&, \
                                                    const Parameters<double, N>*);
EPICYCLIC_FOR_PLANETS(EPICYCLIC_INSTANTIATE)
#undef EPICYCLIC_INSTANTIATE

}  // namespace epicyclic::model
