#include "reports/gear_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "figures/sketch.hpp"
#include "gear/bearing.hpp"
#include "model/modes.hpp"

namespace epicyclic::reports {

namespace {

namespace fs = std::filesystem;

constexpr double pi = std::numbers::pi;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

using namespace figures::ink;

std::string titled(const gear::Stage& stage, std::string_view what) {
  return stage.name.empty() ? std::string(what) : fmt::format("{}:  {}", figures::verbatim_text(stage.name), what);
}

GearFigure draw(const figures::Sketch& sketch, const fs::path& folder, const figures::FigureText& text,
                const figures::FigureRange& x, const figures::FigureRange& y,
                const std::vector<figures::FigureMarker>& markers = {}, const figures::FigureCanvas& canvas = {}) {
  return {sketch.stem(), sketch.draw(folder, text, x, y, markers, canvas)};
}

/// Places on the canvas, in shares of its width and height.
struct Frame {
  double left, right, bottom;
};

/// For drawings that are true to scale: a frame of known shape.
void fix_frame(figures::Sketch& sketch, const Frame& frame) {
  sketch.command(fmt::format("set size ratio -1\nset lmargin screen {}\nset rmargin screen {}\nset bmargin screen {}",
                             figures::figure_number(frame.left), figures::figure_number(frame.right),
                             figures::figure_number(frame.bottom)));
}

using Row2 = std::array<double, 2>;
using Row3 = std::array<double, 3>;
using Curve = std::vector<Row2>;

constexpr Row2 interruption{not_a_number, not_a_number};

figures::FigureRange range_of_y(std::initializer_list<const Curve*> curves) {
  figures::FigureRange range;
  for (const Curve* curve : curves)
    for (const Row2& row : *curve) range.include(row[1]);
  return range.widened(figures::figure_margin);
}

// ---------------------------------------------------------------------------------------------------------------------
// Curves over the mesh phase

constexpr int periods_shown = 2;
constexpr std::string_view phase_label = "Mesh phase  s / 2π";

/// A table over one period, whose first row is the left side of phase 0, over the periods shown; a jump is a vertical
/// line.
Curve repeated(const std::vector<double>& phase, const std::vector<double>& value, double unit) {
  Curve curve;
  for (int period = 0; period < periods_shown; ++period)
    for (std::size_t i = period == 0 ? 1 : 0; i < phase.size(); ++i)
      curve.push_back({phase[i] + period, value[i] / unit});
  curve.push_back({static_cast<double>(periods_shown), value.front() / unit});
  return curve;
}

/// @param name, index  of the mesh; empty: a pair has one
GearFigure stiffness_figure(const fs::path& folder, std::string_view stem, const gear::Stage& stage,
                            const gear::MeshedPair& mesh, const gear::FourierSeries& series, std::string_view name,
                            std::string_view index) {
  constexpr double unit = 1e9;
  const gear::StiffnessCurve table = gear::stiffness_curve(mesh);
  const Curve energy = repeated(table.phase, table.stiffness_N_per_m, unit);
  Curve fourier;
  const int samples = 256 * std::max(1, static_cast<int>(series.cosine.size()) / 4);
  for (int i = 0; i <= periods_shown * samples; ++i) {
    const double phase = static_cast<double>(i) / samples;
    fourier.push_back({phase, series.at(phase) / unit});
  }
  const Curve mean{{0.0, series.mean / unit}, {static_cast<double>(periods_shown), series.mean / unit}};

  figures::Sketch sketch(stem);
  sketch.add(mean, figures::dashed(dark_grey, 1.5, "(10,7)"));
  sketch.add(energy, figures::solid(blue), "energy method");
  sketch.add(fourier, figures::solid(red), fmt::format("Fourier, {} harmonics", series.cosine.size()));
  sketch.entry(figures::dashed(dark_grey, 1.5, "(10,7)"), "mean");
  return draw(
      sketch, folder,
      {titled(stage, name.empty() ? "mesh stiffness" : fmt::format("{} mesh stiffness", name)),
       std::string(phase_label),
       index.empty() ? "Mesh stiffness  k  [10^9 N/m]" : fmt::format("Mesh stiffness  k_{{{}}}  [10^9 N/m]", index)},
      {0.0, periods_shown}, range_of_y({&energy, &fourier}));
}

// ---------------------------------------------------------------------------------------------------------------------
// Load sharing and friction along the path of contact

GearFigure load_sharing_figure(const fs::path& folder, const gear::Stage& stage, const gear::GearSet& set) {
  figures::Sketch sketch("load_sharing");
  double longest = 0.0;
  const auto add = [&](const gear::MeshedPair& mesh, std::string_view recording, std::string_view title) {
    // The table of lubricated contact has both sides of each jump; the lubricant does not matter here.
    const gear::EhlFriction table = gear::ehl_of(mesh, {});
    Curve curve;
    for (std::size_t i = 0; i < table.share.size(); ++i) curve.push_back({table.share_position[i], table.share[i]});
    sketch.add(curve, recording, title);
    longest = std::max(longest, mesh.contact_ratio());
  };
  add(set.sun_planet, figures::solid(blue), set.is_pair() ? "" : "sun-planet");
  if (!set.is_pair()) add(set.ring_planet, figures::dashed(red, 2, "(14,6)"), "ring-planet");
  return draw(sketch, folder,
              {titled(stage, "load sharing of tooth pairs"), "Distance from the start of contact  [base pitches]",
               "Share of a tooth pair in the mesh force  L"},
              {0.0, longest}, {0.0, 1.05});
}

/// One mesh as the friction figures see it.
struct LubricatedMesh {
  gear::EhlFriction ehl;
  gear::LineOfAction line;
};

/// As the model has it, or from catalogue data; nothing if there is no lubrication.
std::optional<LubricatedMesh> lubricated_mesh(const gear::Mesh& given, const gear::MeshedPair& mesh,
                                              const std::optional<gear::Lubrication>& lubrication) {
  const gear::Pair& p = mesh.pair;
  const gear::LineOfAction line{p.driving.base_radius_mm, p.driven.base_radius_mm, p.theoretical_length_mm,
                                p.pitch_arm_mm,           p.base_pitch_mm,         p.internal()};
  if (given.friction.ehl && !given.friction.ehl->share.empty()) return LubricatedMesh{*given.friction.ehl, line};
  if (lubrication) return LubricatedMesh{gear::ehl_of(mesh, *lubrication), line};
  return std::nullopt;
}

/// f = - mu sgn(sliding) against the distance from the pitch point, where f vanishes with a kink.
Curve friction_along_path(const LubricatedMesh& mesh, const gear::MeshLoad& load) {
  Curve curve;
  for (std::size_t i = 0; i < mesh.ehl.share.size(); ++i) {
    const double position = mesh.ehl.share_position[i];
    const gear::LubricatedContact contact =
        gear::lubricated_contact(mesh.ehl, mesh.line, load, position, mesh.ehl.share[i]);
    const double f = -std::copysign(gear::xu_friction_coefficient(contact), contact.slide_to_roll);
    const double distance = mesh.ehl.path_start_mm + mesh.line.base_pitch_mm * position - mesh.line.pitch_arm_mm;
    if (!curve.empty() && curve.back()[0] < 0.0 && distance > 0.0) curve.push_back({0.0, 0.0});
    curve.push_back({distance, f});
  }
  return curve;
}

Curve force_ratio(const LubricatedMesh& mesh, const gear::MeshLoad& load) {
  const gear::FrictionTable table = gear::friction_table(mesh.ehl, mesh.line, load);
  return repeated(table.phase, table.force_ratio, 1.0);
}

std::string at_load(const gear::MeshLoad& load) {
  return fmt::format("F = {:.0f} N, base circles at {:.1f} m/s", load.force_N, load.base_speed_m_per_s);
}

void add_zero_line(figures::Sketch& sketch, const figures::FigureRange& x) {
  sketch.add(Curve{{x.low, 0.0}, {x.high, 0.0}}, figures::solid(light_grey, 1));
}

/// @param ring  empty for a pair, whose curve needs no name
void add_curves(figures::Sketch& sketch, const Curve& sun, const Curve& ring) {
  sketch.add(sun, figures::solid(blue), ring.empty() ? "" : "sun-planet");
  if (!ring.empty()) sketch.add(ring, figures::dashed(red, 2, "(14,6)"), "ring-planet");
}

/// @param ring  none of a pair
GearFigure friction_figure(const fs::path& folder, const gear::Stage& stage, const LubricatedMesh& sun,
                           const std::optional<LubricatedMesh>& ring, const gear::MeshLoad& load) {
  const Curve sun_curve = friction_along_path(sun, load);
  const Curve ring_curve = ring ? friction_along_path(*ring, load) : Curve();
  figures::FigureRange x;
  x.include(0.0);  // the pitch point is shown even if no path reaches it
  for (const Curve* curve : {&sun_curve, &ring_curve})
    for (const Row2& row : *curve) x.include(row[0]);
  x = x.widened(figures::figure_margin);
  figures::Sketch sketch("friction");
  add_zero_line(sketch, x);
  add_curves(sketch, sun_curve, ring_curve);
  sketch.add(Curve{sun_curve.front(), sun_curve.back()}, figures::dots(blue, 0.9));
  if (ring) sketch.add(Curve{ring_curve.front(), ring_curve.back()}, figures::dots(red, 0.9));
  return draw(
      sketch, folder,
      {titled(stage, "tooth friction at " + at_load(load)),
       "Distance from the pitch point along the line of action  [mm]", "Friction coefficient  f = −μ sgn(V_1 − V_2)"},
      x, range_of_y({&sun_curve, &ring_curve}), {{0.0, "pitch point"}});
}

GearFigure friction_ratio_figure(const fs::path& folder, const gear::Stage& stage, const LubricatedMesh& sun,
                                 const std::optional<LubricatedMesh>& ring, const gear::MeshLoad& load) {
  const Curve sun_curve = force_ratio(sun, load);
  const Curve ring_curve = ring ? force_ratio(*ring, load) : Curve();
  const figures::FigureRange x{0.0, periods_shown};
  figures::Sketch sketch("friction_ratio");
  add_zero_line(sketch, x);
  add_curves(sketch, sun_curve, ring_curve);
  return draw(sketch, folder,
              {titled(stage, "friction force at " + at_load(load)),
               ring ? fmt::format("{} of each mesh", phase_label) : std::string(phase_label),
               "Friction force over mesh force  A = Σ L_j f_j"},
              x, range_of_y({&sun_curve, &ring_curve}));
}

// ---------------------------------------------------------------------------------------------------------------------
// Static transmission error

std::string titled_error(const gear::Stage& stage, const TransmissionErrorTable& table) {
  if (stage.is_pair()) return titled(stage, "static transmission error");
  return titled(stage,
                fmt::format("static transmission error, {} mesh", table.mesh == "sp" ? "sun-planet" : "ring-planet"));
}

GearFigure error_over_torque(const fs::path& folder, const TransmissionErrorTable& table, const gear::Stage& stage) {
  figures::Sketch sketch("static_transmission_error_" + table.mesh);
  figures::FigureRange y;
  const auto add = [&](const auto& value, const std::string& style, std::string_view title) {
    Curve curve;
    for (const TransmissionErrorRow& row : table.rows) {
      curve.push_back({row.torque_Nm, value(row)});
      y.include(curve.back()[1]);
    }
    sketch.add(curve, style, title);
  };
  add([](const TransmissionErrorRow& r) { return r.error.peak_to_peak_um; }, figures::solid(blue), "peak to peak");
  add([](const TransmissionErrorRow& r) { return r.model.peak_to_peak_um; }, figures::dashed(light_blue, 2, "(8,5)"),
      "peak to peak, model");
  add([](const TransmissionErrorRow& r) { return r.error.harmonic_um[0]; }, figures::solid(red), "harmonic 1");
  add([](const TransmissionErrorRow& r) { return r.error.harmonic_um[1]; }, figures::dashed(green, 2, "(14,6)"),
      "harmonic 2");
  add([](const TransmissionErrorRow& r) { return r.error.harmonic_um[2]; }, figures::dashed(ochre, 2, "(4,4)"),
      "harmonic 3");
  figures::FigureRange range = y.widened(figures::figure_margin);
  range.low = 0.0;
  return draw(
      sketch, folder,
      {titled_error(stage, table), stage.is_pair() ? "Torque on gear 1  T_1  [N m]" : "Torque on the sun  T_D  [N m]",
       "Static transmission error  [μm]"},
      {0.0, table.rows.back().torque_Nm}, range, {{table.design_torque_Nm, "design torque"}});
}

GearFigure error_over_phase(const fs::path& folder, const TransmissionErrorTable& table, const gear::Stage& stage) {
  figures::Sketch sketch("transmission_error_phase_" + table.mesh);
  constexpr int samples = 400;
  figures::FigureRange y;
  const std::array<std::pair<double, std::string>, 5> curves = {{{0.0, figures::dashed(dark_grey, 1.5, "(10,7)")},
                                                                 {0.5, figures::solid(light_blue)},
                                                                 {1.0, figures::solid(blue, 3)},
                                                                 {1.5, figures::solid(ochre)},
                                                                 {2.0, figures::solid(red)}}};
  for (const auto& [share, style] : curves) {
    Curve curve;
    for (int i = 0; i <= periods_shown * samples; ++i) {
      const double phase = static_cast<double>(i) / samples;
      curve.push_back(
          {phase, table.contact.transmission_error_um(phase - std::floor(phase), share * table.contact.force_N())});
      y.include(curve.back()[1]);
    }
    sketch.add(curve, style, share == 0.0 ? "no load" : fmt::format("{:.4g} N m", share * table.design_torque_Nm));
  }
  return draw(sketch, folder,
              {titled_error(stage, table), std::string(phase_label), "Static transmission error  δ  [μm]"},
              {0.0, periods_shown}, y.widened(figures::figure_margin));
}

// ---------------------------------------------------------------------------------------------------------------------
// Bearings

struct NamedBearing {
  std::string member;
  gear::SupportBearing support;
  gear::BearingData data;
};

std::vector<NamedBearing> bearings_of(const gear::Catalogue& catalogue, bool pair) {
  std::vector<NamedBearing> bearings;
  const auto add = [&](std::string_view member, const std::optional<gear::SupportBearing>& support) {
    if (!support) return;
    if (const auto data = gear::bearing_data(*support))
      bearings.push_back({fmt::format("{}, {}", member, figures::verbatim_text(data->name)), *support, *data});
  };
  add(pair ? "gear 1" : "sun", catalogue.sun_bearing);
  add(pair ? "gear 2" : "planet", catalogue.planet_bearing);
  add("carrier", catalogue.carrier.bearing);
  return bearings;
}

/// @param law  value at an approach, stiffness or force
GearFigure bearing_figure(const fs::path& folder, std::string_view stem, const gear::Stage& stage,
                          const std::vector<NamedBearing>& bearings, double (gear::BearingData::*law)(double) const,
                          double unit, std::string_view title, std::string_view label) {
  constexpr double micrometre = 1e-6;
  constexpr int samples = 200;
  double reach_um = 0.0;
  for (const NamedBearing& bearing : bearings) reach_um = std::max(reach_um, 2.0 * bearing.support.approach_um);
  figures::Sketch sketch(stem);
  double highest = 0.0;
  Curve chosen;
  for (std::size_t k = 0; k < bearings.size(); ++k) {
    const auto value = [&](double um) { return (bearings[k].data.*law)(um * micrometre) / unit; };
    Curve curve;
    // Squares: the stiffness starts with an infinite slope.
    for (int i = 0; i <= samples; ++i) {
      const double approach = reach_um * i * i / (samples * samples);
      curve.push_back({approach, value(approach)});
    }
    highest = std::max(highest, curve.back()[1]);
    sketch.add(curve, k == 0 ? figures::solid(blue) : figures::dashed(red, 2, "(14,6)"), bearings[k].member);
    chosen.push_back({bearings[k].support.approach_um, value(bearings[k].support.approach_um)});
  }
  sketch.add(chosen, figures::dots(dark_grey, 1.1), "approach of the stage");
  return draw(sketch, folder,
              {titled(stage, title), "Elastic approach beyond the clearance  δ  [μm]", std::string(label)},
              {0.0, reach_um}, {0.0, (1.0 + figures::figure_margin) * highest});
}

// ---------------------------------------------------------------------------------------------------------------------
// Teeth in mesh

/// A point of half a tooth: radius, and angle from the tooth's centre line.
struct PolarPoint {
  double radius, angle;
};

/// Does a rack cut this tooth's root, without undercut and within the tooth?
bool has_rack_fillet(const gear::Tooth& tooth) {
  return !tooth.internal && tooth.rounding_clearance() > 0.0 && tooth.profile_shift >= tooth.undercut_limit() &&
         tooth.form_radius_mm() < tooth.tip_radius_mm;
}

/// Radii of the vertices of an involute from `root` to `tip`: even steps of its roll angle, and the `wanted` ones.
std::vector<double> flank_radii(const gear::Tooth& tooth, double root, double tip, const std::vector<double>& wanted) {
  constexpr int steps = 48;
  const auto roll = [&](double radius) { return std::tan(tooth.pressure_angle_at(radius)); };
  std::vector<double> radii{root};
  for (int i = 1; i < steps; ++i)
    radii.push_back(tooth.base_radius_mm * std::hypot(1.0, roll(root) + (roll(tip) - roll(root)) * i / steps));
  radii.push_back(tip);
  const auto [low, high] = std::minmax(root, tip);
  for (const double radius : wanted)
    if (radius > low && radius < high) radii.push_back(radius);
  std::sort(radii.begin(), radii.end());
  if (root > tip) std::reverse(radii.begin(), radii.end());
  return radii;
}

/// Half a tooth from the middle of its space to the middle of its tip, angles falling from pi / z to 0.
std::vector<PolarPoint> half_tooth(const gear::Tooth& tooth, const std::vector<double>& contact_radii) {
  constexpr int arc_steps = 8;
  constexpr int fillet_steps = 24;
  std::vector<PolarPoint> half;
  const auto arc = [&](double radius, double from, double to) {
    for (int i = 0; i <= arc_steps; ++i) half.push_back({radius, from + (to - from) * i / arc_steps});
  };
  const double half_pitch = pi / tooth.teeth;
  double foot = tooth.root_radius_mm;  // beginning of the involute
  if (has_rack_fillet(tooth)) {
    const auto at = [&](double gamma) {
      const gear::ProfilePoint p = tooth.fillet(gamma);
      return PolarPoint{std::hypot(p.x, p.y), std::atan2(p.x, p.y)};
    };
    arc(tooth.root_radius_mm, half_pitch, at(0.5 * pi).angle);
    for (int i = 1; i < fillet_steps; ++i)
      half.push_back(at(0.5 * pi + (tooth.pressure_angle - 0.5 * pi) * i / fillet_steps));
    foot = tooth.form_radius_mm();
  } else {
    foot = std::max(foot, tooth.base_radius_mm);
    arc(tooth.root_radius_mm, half_pitch, std::min(half_pitch, tooth.half_angle_at(foot)));
  }
  for (const double radius : flank_radii(tooth, foot, tooth.tip_radius_mm, contact_radii))
    half.push_back({radius, std::min(half_pitch, tooth.half_angle_at(radius))});
  arc(tooth.tip_radius_mm, tooth.half_angle_at(tooth.tip_radius_mm), 0.0);
  return half;
}

DrawnPoint polar(const DrawnPoint& centre, double radius, double angle) {
  return {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
}

/// Teeth whose centre lines are within `spread` of the angle `towards`, one of them at `tooth_angle`.
std::vector<DrawnPoint> outline(const gear::Tooth& tooth, const std::vector<double>& contact_radii,
                                const DrawnPoint& axis, double tooth_angle, double towards, double spread) {
  const std::vector<PolarPoint> half = half_tooth(tooth, contact_radii);
  const std::vector<PolarPoint> other_half(half.rbegin(), half.rend());
  const double pitch = 2.0 * pi / tooth.teeth;
  const int first = static_cast<int>(std::ceil((towards - spread - tooth_angle) / pitch));
  const int last = static_cast<int>(std::floor((towards + spread - tooth_angle) / pitch));
  std::vector<DrawnPoint> points;
  for (int k = first; k <= last; ++k) {
    const double centre_line = tooth_angle + k * pitch;
    for (const PolarPoint& p : half) points.push_back(polar(axis, p.radius, centre_line - p.angle));
    for (const PolarPoint& p : other_half) points.push_back(polar(axis, p.radius, centre_line + p.angle));
  }
  return points;
}

/// Half of the angle that contains the teeth within `reach` of the line of centres, with one pitch to spare.
double spread_of(const gear::Tooth& tooth, double reach_mm) {
  const double least = std::min(tooth.tip_radius_mm, tooth.root_radius_mm);
  return std::min(pi, std::asin(std::min(1.0, reach_mm / least)) + 2.0 * pi / tooth.teeth);
}

/// The teeth of the driven member in mesh, seen from its axis.
double driven_direction(const gear::Pair& pair) { return pair.internal() ? 0.5 * pi : -0.5 * pi; }

/// A nanometre: digits beyond it only make the file longer.
double drawn(double mm) {
  constexpr double per_mm = 1e6;
  return std::round(mm * per_mm) / per_mm;
}

Curve rows(const std::vector<DrawnPoint>& points) {
  Curve curve;
  for (const DrawnPoint& p : points) curve.push_back({drawn(p.x), drawn(p.y)});
  return curve;
}

Curve arc_about(const DrawnPoint& centre, double radius, double towards, double spread) {
  constexpr int steps = 180;
  Curve curve;
  for (int i = 0; i <= steps; ++i) {
    const DrawnPoint p = polar(centre, radius, towards + spread * (2.0 * i / steps - 1.0));
    curve.push_back({drawn(p.x), drawn(p.y)});
  }
  return curve;
}

/// The window of a drawing of a pair: its path of contact with the pitch point, and the teeth around them.
struct Window {
  figures::FigureRange x, y;
};

Window window_of(const gear::Pair& pair) {
  constexpr double margin = 2.0;             // modules around the path
  constexpr double width_over_height = 1.9;  // of the frame that teeth_figure() sets
  const double sine = std::sin(pair.pressure_angle);
  const double cosine = std::cos(pair.pressure_angle);
  Window w;
  for (const double l : {pair.start_mm, pair.pitch_arm_mm, pair.end_mm}) {
    w.x.include((l - pair.pitch_arm_mm) * cosine);
    w.y.include((l - pair.pitch_arm_mm) * sine);
  }
  // Tips and roots on the line of centres: whole teeth are seen.
  const double up = pair.internal() ? 1.0 : -1.0;
  const double r_1 = pair.pitch_radius_1_mm();
  const double r_2 = pair.pitch_radius_2_mm();
  for (const double y : {pair.driving.root_radius_mm - r_1, pair.driving.tip_radius_mm - r_1,
                         up * (pair.driven.root_radius_mm - r_2), up * (pair.driven.tip_radius_mm - r_2)})
    w.y.include(y);
  const double m = pair.driving.module_mm;
  double width = w.x.high - w.x.low + 2.0 * margin * m;
  double height = w.y.high - w.y.low + margin * m;
  width = std::max(width, height * width_over_height);
  height = width / width_over_height;
  const double x = 0.5 * (w.x.low + w.x.high);
  const double y = 0.5 * (w.y.low + w.y.high);
  return {{x - 0.5 * width, x + 0.5 * width}, {y - 0.5 * height, y + 0.5 * height}};
}

struct PairNames {
  std::string_view stem, driving, driven, index;
  std::string_view driving_colour, driven_colour, driving_tint, driven_tint;
};

void label_point(figures::Sketch& sketch, const DrawnPoint& p, std::string_view text, std::string_view place) {
  sketch.command(fmt::format("set label {} at first {}, first {} {} front boxed font ',20'",
                             figures::gnuplot_quoted(text), figures::figure_number(p.x), figures::figure_number(p.y),
                             place));
}

/// A member of a pair as it is drawn.
struct DrawnMember {
  const gear::Tooth& tooth;
  const std::vector<DrawnPoint>& teeth;
  DrawnPoint axis;
  double towards, spread;  // the teeth are within +- spread of this direction [rad]
  double pitch_radius;
  std::string_view name, colour, tint;
};

constexpr double outline_width = 1.8;
constexpr double path_width = 4.5;

std::string pitch_style(std::string_view colour) { return figures::dashed(colour, 1.2, "(12,8)"); }
std::string base_style(std::string_view colour) { return figures::solid(colour, 0.8); }

/// Filled section: the teeth, closed by the material behind them.
void add_body(figures::Sketch& sketch, const DrawnMember& m) {
  Curve body = rows(m.teeth);
  if (m.tooth.internal) {
    const Curve rim = arc_about(m.axis, m.tooth.root_radius_mm + 10.0 * m.tooth.module_mm, m.towards, 1.5 * m.spread);
    body.insert(body.end(), rim.rbegin(), rim.rend());
  } else {
    body.push_back({drawn(m.axis.x), drawn(m.axis.y)});
  }
  sketch.add(body, fmt::format("filledcurves closed fillstyle solid 1.0 noborder fillcolor '{}'", m.tint));
}

void add_lines(figures::Sketch& sketch, const DrawnMember& m) {
  sketch.add(arc_about(m.axis, m.pitch_radius, m.towards, m.spread), pitch_style(m.colour));
  sketch.add(arc_about(m.axis, m.tooth.base_radius_mm, m.towards, m.spread), base_style(m.colour));
  sketch.add(rows(m.teeth), figures::solid(m.colour, outline_width));
}

/// Line of action, path of contact, pitch point and contacts.
void add_contact(figures::Sketch& sketch, const MeshDrawing& drawing, double pressure_angle, double far) {
  const DrawnPoint end{far * std::cos(pressure_angle), far * std::sin(pressure_angle)};
  sketch.add(rows({{-end.x, -end.y}, end}), figures::solid(dark_grey, 1));
  sketch.add(rows({drawing.start, drawing.end}), figures::solid(green, path_width));
  sketch.add(Curve{{0.0, 0.0}}, figures::dots(dark_grey, 1.3));
  sketch.add(rows(drawing.contacts), figures::dots("#ffffff", 1.5));
  sketch.add(rows(drawing.contacts), figures::dots(green, 1.1));
  sketch.command("set style textbox opaque noborder fillcolor '#ffffff' margins 0.4,0.4");
  label_point(sketch, drawing.start, "start", "right offset character -1,0.9");
  label_point(sketch, drawing.end, "end", "left offset character 1,-0.7");
  label_point(sketch, {0.0, 0.0}, "pitch point", "left offset character 0.7,-1.4");
}

GearFigure teeth_figure(const fs::path& folder, const gear::Stage& stage, const gear::Pair& pair,
                        const PairNames& names) {
  const Window window = window_of(pair);
  const double reach = std::max(std::abs(window.x.low), std::abs(window.x.high)) + pair.driving.module_mm;
  // The middle of the reach in which most pairs are in contact.
  const double rest = pair.contact_ratio() - std::floor(pair.contact_ratio());
  const MeshDrawing drawing = mesh_drawing(pair, 0.5 * rest, reach);
  const DrawnMember driving{pair.driving,
                            drawing.driving,
                            drawing.driving_axis,
                            0.5 * pi,
                            spread_of(pair.driving, reach),
                            pair.pitch_radius_1_mm(),
                            names.driving,
                            names.driving_colour,
                            names.driving_tint};
  const DrawnMember driven{pair.driven,
                           drawing.driven,
                           drawing.driven_axis,
                           driven_direction(pair),
                           spread_of(pair.driven, reach),
                           pair.pitch_radius_2_mm(),
                           names.driven,
                           names.driven_colour,
                           names.driven_tint};
  figures::Sketch sketch(names.stem);
  for (const DrawnMember* m : {&driven, &driving}) add_body(sketch, *m);
  for (const DrawnMember* m : {&driven, &driving}) add_lines(sketch, *m);
  add_contact(sketch, drawing, pair.pressure_angle, 2.0 * (window.x.high - window.x.low));
  for (const DrawnMember* m : {&driving, &driven}) sketch.entry(figures::solid(m->colour, outline_width), m->name);
  sketch.entry(pitch_style(dark_grey), "pitch circles");
  sketch.entry(base_style(dark_grey), "base circles");
  sketch.entry(figures::solid(green, path_width), "path of contact");

  const double degrees = pair.pressure_angle * 180.0 / pi;
  const std::string title =
      names.index.empty() ? fmt::format("teeth in mesh,  α_w = {:.2f}°,  ε_α = {:.3f}", degrees, pair.contact_ratio())
                          : fmt::format("{}-{} mesh,  α_{{{}}} = {:.2f}°,  ε_{{{}}} = {:.3f}", names.driving,
                                        names.driven, names.index, degrees, names.index, pair.contact_ratio());
  fix_frame(sketch, {0.075, 0.975, 0.12});
  // Long lines are cut at the frame, and nothing filled hides the tics.
  sketch.command("set clip two\nset tics front");
  return draw(sketch, folder, {titled(stage, title), "x  [mm]", "y  [mm]"}, window.x, window.y);
}

// ---------------------------------------------------------------------------------------------------------------------
// Modes

struct TypeStyle {
  model::ModeType type;
  std::string_view colour, dash;
  double width;
  std::string mark;
};

/// The rotational modes are emphasized: only they respond to meshes that are in phase.
const std::array<TypeStyle, 4>& type_styles() {
  static const std::array<TypeStyle, 4> styles{
      {{model::ModeType::translational, blue, "(14,6)", 1.4, figures::dots(blue, 1, 6)},
       {model::ModeType::planet, green, "(3,5)", 1.8, figures::dots(green, 1, 4)},
       {model::ModeType::other, purple, "(14,5,3,5)", 1.6, figures::dots(purple, 1, 8)},
       {model::ModeType::rotational, red, "solid", 2, figures::dots(red, 1.1)}}};
  return styles;
}

constexpr int mesh_harmonics_shown = 3;

/// The intersection of harmonic h with a frequency, if it is in the figure.
Curve resonances(const std::vector<model::Mode>& modes, model::ModeType type, double speed_max) {
  Curve points;
  for (const model::Mode& mode : modes)
    for (int h = 1; h <= mesh_harmonics_shown; ++h) {
      const double speed = mode.frequency_ratio / h;
      if (mode.type == type && speed > 0.0 && speed <= speed_max) points.push_back({speed, mode.frequency_ratio});
    }
  return points;
}

Curve frequency_lines(const std::vector<model::Mode>& modes, model::ModeType type, double speed_max) {
  Curve lines;
  for (const model::Mode& mode : modes) {
    if (mode.type != type || mode.frequency_ratio == 0.0) continue;
    if (!lines.empty()) lines.push_back(interruption);
    lines.push_back({0.0, mode.frequency_ratio});
    lines.push_back({speed_max, mode.frequency_ratio});
  }
  return lines;
}

/// A height that is far from all frequencies: the middle of their widest gap.
double free_height(const std::vector<model::Mode>& modes, double frequency_max) {
  std::vector<double> heights{0.0, 1.0, frequency_max};
  for (const model::Mode& mode : modes) heights.push_back(mode.frequency_ratio);
  std::sort(heights.begin(), heights.end());
  double widest = 0.0;
  double middle = 0.5 * frequency_max;
  for (std::size_t k = 1; k < heights.size(); ++k) {
    if (heights[k] - heights[k - 1] <= widest) continue;
    widest = heights[k] - heights[k - 1];
    middle = 0.5 * (heights[k] + heights[k - 1]);
  }
  return middle;
}

void add_harmonics(figures::Sketch& sketch, double frequency_max, double label_height) {
  Curve lines;
  for (int h = 1; h <= mesh_harmonics_shown; ++h) {
    if (h > 1) lines.push_back(interruption);
    lines.push_back({0.0, 0.0});
    lines.push_back({frequency_max / h, frequency_max});
    const std::string factor = h == 1 ? std::string() : fmt::format("{} ", h);
    sketch.command(fmt::format("set label '{}Ω' at first {}, first {} center front boxed font ',20' textcolor '{}'",
                               factor, figures::figure_number(label_height / h), figures::figure_number(label_height),
                               dark_grey));
  }
  sketch.add(lines, figures::solid(dark_grey, 1.2));
}

/// Frequencies in kHz on the right.
void add_frequency_axis(figures::Sketch& sketch, double frequency_max, double omega_sn) {
  const double unit_kHz = omega_sn / (2.0 * pi) * 1e-3;
  sketch.command("set ytics nomirror");
  sketch.command(fmt::format("set y2range [0:{}]", figures::figure_number(frequency_max * unit_kHz)));
  constexpr double with_decimals = 5.0;  // tics below need more room
  sketch.command(fmt::format("set y2tics\nset my2tics 5\nset y2label 'Frequency  [kHz]'\nset rmargin screen {}",
                             frequency_max * unit_kHz < with_decimals ? 0.9 : 0.915));
}

GearFigure campbell_figure(const fs::path& folder, const gear::Stage& stage, const std::vector<model::Mode>& modes,
                           double omega_sn) {
  const double highest = modes.back().frequency_ratio;
  const double frequency_max = 1.08 * std::max(1.0, highest);
  const double speed_max = frequency_max;  // at which the first harmonic leaves the figure
  figures::Sketch sketch("campbell");
  sketch.command("set style textbox opaque noborder fillcolor '#ffffff' margins 0.4,0.4");
  add_frequency_axis(sketch, frequency_max, omega_sn);
  sketch.add(Curve{{0.0, 1.0}, {speed_max, 1.0}}, figures::solid(light_grey, 1));
  sketch.command(
      "set label 'ω_{sn}' at graph 1, first 1 right offset character -0.8,0.55 font ',20' textcolor '#707070'");
  add_harmonics(sketch, frequency_max, free_height(modes, frequency_max));
  for (const TypeStyle& recording : type_styles())
    sketch.add(frequency_lines(modes, recording.type, speed_max),
               figures::dashed(recording.colour, recording.width, recording.dash));
  for (const TypeStyle& recording : type_styles())
    sketch.add(resonances(modes, recording.type, speed_max), recording.mark);
  // The last symbol drawn, on top, is the first in the legend.
  const std::vector<TypeStyle> legend(type_styles().rbegin(), type_styles().rend());
  for (const TypeStyle& recording : legend)
    if (std::any_of(modes.begin(), modes.end(), [&](const model::Mode& mode) { return mode.type == recording.type; }))
      sketch.entry(figures::dashed(recording.colour, recording.width, recording.dash),
                   model::to_string(recording.type));
  sketch.entry(figures::solid(dark_grey, 1.2), "mesh harmonics");
  return draw(
      sketch, folder,
      {titled(stage, "Campbell diagram"), "Mesh frequency ratio  Ω = ω_m / ω_{sn}", "Natural frequency  ω / ω_{sn}"},
      {0.0, speed_max}, {0.0, frequency_max});
}

/// Radii of the circles of the members, in centre distances.
struct SchematicRadii {
  double sun, planet, ring;                 // as drawn; in place of the ring's half of the width of a pair
  double sun_base, planet_base, ring_base;  // of u = r theta
};

/// Of the stage, or typical ones if it has only masses and stiffnesses.
SchematicRadii schematic_radii(const gear::Stage& stage) {
  const auto& s = stage.sun.base_radius_mm;
  const auto& p = stage.planet.base_radius_mm;
  const auto& r = stage.ring.base_radius_mm;
  if (stage.is_pair()) {
    const double a = s && p ? stage.centre_distance_mm.value_or(*s + *p) : 0.0;
    if (a == 0.0) return {0.5, 0.5, 1.0, 0.5, 0.5, 1.0};
    const double first = *s / (*s + *p);
    return {first, 1.0 - first, 1.0, *s / a, *p / a, 1.0};
  }
  if (!s || !p || !r || !stage.centre_distance_mm) return {0.5, 0.5, 1.5, 0.5, 0.5, 1.5};
  const double a = *stage.centre_distance_mm;
  const double sun = *s / (*s + *p);  // operating pitch circles touch
  return {sun, 1.0 - sun, 2.0 - sun, *s / a, *p / a, *r / a};
}

/// One shape of a mode: of several at one frequency that in which one coordinate, named by the type, moves most, so
/// that the drawing does not depend on which basis the eigenvalue solver returned.
Eigen::VectorXd drawn_shape(const model::Mode& mode, std::size_t planets) {
  using model::Slots;
  std::vector<std::size_t> slots;
  if (mode.type == model::ModeType::translational)
    slots = {Slots::x_s, Slots::x_r(planets), Slots::x_c(planets)};
  else
    for (Eigen::Index k = 0; k < mode.shapes.rows(); ++k) slots.push_back(static_cast<std::size_t>(k));
  const auto row = [&](std::size_t slot) { return mode.shapes.row(static_cast<Eigen::Index>(slot)); };
  double largest = 0.0;
  for (const std::size_t slot : slots) largest = std::max(largest, row(slot).norm());
  constexpr double tie = 0.999;
  for (const std::size_t slot : slots)
    if (row(slot).norm() >= tie * largest && largest > 0.0) return mode.shapes * row(slot).transpose().normalized();
  return mode.shapes.col(0);
}

/// The circles and marks of all panels, one list per kind of member.
class ShapeDrawing {
 public:
  explicit ShapeDrawing(const gear::Stage& stage)
      : pair_(stage.is_pair()), radii_(schematic_radii(stage)), angles_(stage.planet_angles_deg()) {
    for (double& angle : angles_) angle *= pi / 180.0;
  }

  /// The members at rest and displaced, in a panel about (x, y).
  void add_panel(const model::Mode& mode, double x, double y) {
    using model::Layout;
    using model::Slots;
    const std::size_t n = angles_.size();
    const Eigen::VectorXd shape = drawn_shape(mode, n);
    // Rotations count as displacements of the base circles.
    constexpr double largest_shown = 0.25;
    const double scale = largest_shown / shape.cwiseAbs().maxCoeff();
    const auto at = [&](std::size_t slot) { return scale * shape(static_cast<Eigen::Index>(slot)); };
    const auto displacement = [&](std::size_t slot_x, std::size_t slot_y, std::size_t slot_u, double base) {
      return Displacement{at(slot_x), at(slot_y), at(slot_u) / base};
    };
    if (pair_) {
      const double axis = x - (radii_.planet - radii_.sun + 1.0) / 2.0;  // the pair in the middle
      place(axis + 1.0, y, radii_.planet, pi,
            displacement(Slots::x_p(0), Slots::y_p(0), Slots::w_p(0), radii_.planet_base), planet_member);
      place(axis, y, radii_.sun, 0.0, displacement(Slots::x_s, Slots::y_s, Slots::w_s, radii_.sun_base), sun_member);
      return;
    }
    const Displacement none{};
    const Displacement carrier = displacement(Slots::x_c(n), Slots::y_c(n), Slots::u_c(Layout::full, n), 1.0);
    carrier_of(x, y, none, rest_marks_);
    carrier_of(x, y, carrier, marks_[carrier_member]);
    place(x, y, radii_.ring, 0.5 * pi, displacement(Slots::x_r(n), Slots::y_r(n), Slots::u_r(n), radii_.ring_base),
          ring_member);
    for (std::size_t i = 0; i < n; ++i)
      place(x + std::cos(angles_[i]), y + std::sin(angles_[i]), radii_.planet, angles_[i],
            displacement(Slots::x_p(i), Slots::y_p(i), Slots::w_p(i), radii_.planet_base), planet_member);
    place(x, y, radii_.sun, 0.5 * pi, displacement(Slots::x_s, Slots::y_s, Slots::w_s, radii_.sun_base), sun_member);
  }

  void show(figures::Sketch& sketch) const {
    static constexpr std::array<std::string_view, 4> names{"sun", "planets", "ring", "carrier"};
    static constexpr std::array<std::string_view, 4> colours{blue, red, green, ochre};
    static_assert(names.size() == carrier_member + 1);
    sketch.add(rest_circles_, circles(light_grey, 1));
    sketch.add(rest_marks_, figures::solid(light_grey, 1));
    for (const std::size_t k : {carrier_member, ring_member, planet_member, sun_member}) {
      if (circles_[k].empty() && marks_[k].empty()) continue;
      sketch.add(circles_[k], circles(colours[k], 1.6));
      sketch.add(marks_[k], figures::solid(colours[k], 1.8));
    }
    static constexpr std::array<std::string_view, 2> names_of_pair{"gear 1", "gear 2"};
    if (pair_)
      for (std::size_t k = 0; k < names_of_pair.size(); ++k)
        sketch.entry(figures::solid(colours[k], 2), names_of_pair[k]);
    else
      for (std::size_t k = 0; k < names.size(); ++k) sketch.entry(figures::solid(colours[k], 2), names[k]);
    sketch.entry(figures::solid(light_grey, 1), "at rest");
  }

  [[nodiscard]] double outer_radius() const { return radii_.ring; }

 private:
  enum Member : std::size_t { sun_member, planet_member, ring_member, carrier_member };
  struct Displacement {
    double x = 0, y = 0, angle = 0;
  };

  static std::string circles(std::string_view colour, double width) {
    return fmt::format("circles linecolor '{}' linewidth {} fillstyle empty", colour, figures::figure_number(width));
  }

  static void mark(Curve& marks, double x, double y, double from, double to, double angle) {
    marks.push_back({x + from * std::cos(angle), y + from * std::sin(angle)});
    marks.push_back({x + to * std::cos(angle), y + to * std::sin(angle)});
    marks.push_back(interruption);
  }

  void place(double x, double y, double radius, double towards, const Displacement& m, Member member) {
    rest_circles_.push_back({x, y, radius});
    circles_[member].push_back({x + m.x, y + m.y, radius});
    // A ring has no spoke: its mark is a short one at the rim.
    const double inner = member == ring_member ? 0.9 * radius : 0.0;
    mark(rest_marks_, x, y, inner, radius, towards);
    mark(marks_[member], x + m.x, y + m.y, inner, radius, towards + m.angle);
  }

  void carrier_of(double x, double y, const Displacement& m, Curve& marks) const {
    for (const double angle : angles_) mark(marks, x + m.x, y + m.y, 0.0, 1.0, angle + m.angle);
  }

  bool pair_;
  SchematicRadii radii_;
  std::vector<double> angles_;
  std::vector<Row3> rest_circles_;
  Curve rest_marks_;
  std::array<std::vector<Row3>, 4> circles_;  // none of the carrier
  std::array<Curve, 4> marks_;
};

/// Type, and frequency in a line of its own.
std::array<std::string, 2> panel_titles(const model::Mode& mode, double omega_sn) {
  std::string type(model::to_string(mode.type));
  if (mode.multiplicity > 1) type += fmt::format(" ×{}", mode.multiplicity);
  if (mode.frequency_ratio == 0.0) return {type, "rigid-body mode"};
  return {type, fmt::format("{:.3f} ω_{{sn}},  {:.0f} Hz", mode.frequency_ratio,
                            mode.frequency_ratio * omega_sn / (2.0 * pi))};
}

/// All of them: the figure is as high as they need.
GearFigure mode_shapes_figure(const fs::path& folder, const gear::Stage& stage, const std::vector<model::Mode>& modes,
                              double omega_sn) {
  constexpr std::size_t columns_of_pair = 3;
  const std::size_t columns = stage.is_pair() ? std::min(modes.size(), columns_of_pair) : modes.size() > 12 ? 6 : 4;
  const std::size_t lines = (modes.size() + columns - 1) / columns;
  ShapeDrawing drawing(stage);
  // In radii of the ring, which moves by no more than a sixth of it.
  const double width = (columns > 4 ? 2.9 : 3.4) * drawing.outer_radius();
  const double text_line = 0.19 * drawing.outer_radius() * static_cast<double>(columns) / 4.0;
  const double height = 2.5 * drawing.outer_radius() + 2.0 * text_line;
  figures::Sketch sketch("mode_shapes");
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const double x = width * static_cast<double>(k % columns);
    const double y = -height * static_cast<double>(k / columns);
    drawing.add_panel(modes[k], x, y - text_line);
    double text_y = y + 0.5 * height - 0.5 * text_line;
    for (const std::string& text : panel_titles(modes[k], omega_sn)) {
      sketch.command(fmt::format("set label {} at first {}, first {} center font ',17'", figures::gnuplot_quoted(text),
                                 figures::figure_number(x), figures::figure_number(text_y)));
      text_y -= text_line;
    }
  }
  drawing.show(sketch);
  sketch.command("unset border\nunset tics");
  constexpr Frame frame{0.01, 0.99, 0.01};
  fix_frame(sketch, frame);
  constexpr double above = 110;  // title and legend [pixels]
  figures::FigureCanvas canvas;
  const double scale = (frame.right - frame.left) * canvas.width / (width * static_cast<double>(columns));
  canvas.height = static_cast<int>(above + scale * height * static_cast<double>(lines));
  return draw(sketch, folder, {titled(stage, "mode shapes"), "", ""},
              {-0.5 * width, width * (static_cast<double>(columns) - 0.5)},
              {-height * (static_cast<double>(lines) - 0.5), 0.5 * height}, {}, canvas);
}

}  // namespace

MeshDrawing mesh_drawing(const gear::Pair& pair, double phase, double reach_mm) {
  const double alpha = pair.pressure_angle;
  const DrawnPoint n{std::cos(alpha), std::sin(alpha)};
  const auto on_line = [&](double l) {
    return DrawnPoint{(l - pair.pitch_arm_mm) * n.x, (l - pair.pitch_arm_mm) * n.y};
  };
  MeshDrawing d;
  d.driving_axis = {0.0, -pair.pitch_radius_1_mm()};
  d.driven_axis = {0.0, pair.internal() ? -pair.pitch_radius_2_mm() : pair.pitch_radius_2_mm()};
  d.start = on_line(pair.start_mm);
  d.end = on_line(pair.end_mm);
  std::vector<double> radii_1;
  std::vector<double> radii_2;
  for (int j = 0; phase + j < pair.contact_ratio(); ++j) {
    const double l = pair.start_mm + (phase + j) * pair.base_pitch_mm;
    d.contacts.push_back(on_line(l));
    radii_1.push_back(pair.radius_1_mm(l));
    radii_2.push_back(pair.radius_2_mm(l));
  }
  const double l = pair.start_mm + phase * pair.base_pitch_mm;
  const double driven_towards = driven_direction(pair);
  const double driving_angle =
      0.5 * pi + alpha - l / pair.driving.base_radius_mm + pair.driving.base_half_angle;  // [F-mesh]
  const double driven_angle = driven_towards + alpha - pair.arm_2_mm(l) / pair.driven.base_radius_mm +
                              (pair.internal() ? -1.0 : 1.0) * pair.driven.base_half_angle;
  d.driving =
      outline(pair.driving, radii_1, d.driving_axis, driving_angle, 0.5 * pi, spread_of(pair.driving, reach_mm));
  d.driven =
      outline(pair.driven, radii_2, d.driven_axis, driven_angle, driven_towards, spread_of(pair.driven, reach_mm));
  return d;
}

std::vector<GearFigure> draw_gear_set_figures(const fs::path& folder, const gear::GearSet& set,
                                              const gear::MeshLoad& load, const gear::Stage& stage) {
  std::vector<GearFigure> figures;
  const bool pair = set.is_pair();
  figures.push_back(stiffness_figure(folder, "stiffness_sp", stage, set.sun_planet, set.sun_planet_stiffness,
                                     pair ? "" : "sun-planet", pair ? "" : "sp"));
  if (!pair)
    figures.push_back(stiffness_figure(folder, "stiffness_rp", stage, set.ring_planet, set.ring_planet_stiffness,
                                       "ring-planet", "rp"));
  figures.push_back(load_sharing_figure(folder, stage, set));

  const std::optional<gear::Lubrication>& lubrication = set.catalogue.lubrication;
  const auto sun = lubricated_mesh(stage.sun_planet_mesh, set.sun_planet, lubrication);
  const auto ring = pair ? std::nullopt : lubricated_mesh(stage.ring_planet_mesh, set.ring_planet, lubrication);
  if (sun && (pair || ring)) {
    figures.push_back(friction_figure(folder, stage, *sun, ring, load));
    figures.push_back(friction_ratio_figure(folder, stage, *sun, ring, load));
  }
  const std::vector<NamedBearing> bearings = bearings_of(set.catalogue, pair);
  if (!bearings.empty()) {
    figures.push_back(bearing_figure(folder, "bearing_stiffness", stage, bearings, &gear::BearingData::stiffness, 1e8,
                                     "bearing stiffness", "Tangent stiffness  dF/dδ  [10^8 N/m]"));
    figures.push_back(bearing_figure(folder, "bearing_force", stage, bearings, &gear::BearingData::force, 1e3,
                                     "bearing force", "Radial force  F  [kN]"));
  }
  if (pair) {
    figures.push_back(teeth_figure(folder, stage, set.sun_planet.pair,
                                   {"teeth_sp", "gear 1", "gear 2", "", blue, red, "#d5dcee", "#f6ddd3"}));
    return figures;
  }
  figures.push_back(teeth_figure(folder, stage, set.sun_planet.pair,
                                 {"teeth_sp", "sun", "planet", "sp", blue, red, "#d5dcee", "#f6ddd3"}));
  figures.push_back(teeth_figure(folder, stage, set.ring_planet.pair,
                                 {"teeth_rp", "planet", "ring", "rp", red, purple, "#f6ddd3", "#e6dcec"}));
  return figures;
}

std::vector<GearFigure> draw_transmission_error_figures(const fs::path& folder,
                                                        const std::vector<TransmissionErrorTable>& tables,
                                                        const gear::Stage& stage) {
  std::vector<GearFigure> figures;
  for (const TransmissionErrorTable& table : tables) {
    figures.push_back(error_over_torque(folder, table, stage));
    figures.push_back(error_over_phase(folder, table, stage));
  }
  return figures;
}

std::vector<GearFigure> draw_mode_figures(const fs::path& folder, const gear::Stage& stage) {
  const model::Scales scales = model::scales_of(stage);
  const std::vector<model::Mode> modes = model::modes(stage, scales);
  return {campbell_figure(folder, stage, modes, scales.omega_sn),
          mode_shapes_figure(folder, stage, modes, scales.omega_sn)};
}

}  // namespace epicyclic::reports
