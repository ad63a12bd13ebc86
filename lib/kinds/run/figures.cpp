// Figures of a run, declared in kinds/run/output.hpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "figures/sketch.hpp"
#include "kinds/run/output.hpp"
#include "model/dynamic_model.hpp"

namespace epicyclic::kinds {

using namespace reports;

namespace {

namespace fs = std::filesystem;

using analysis::Regime;
using studies::History;
using studies::RunResult;
using studies::SignalSpectrum;
using namespace figures::ink;

using Row2 = std::array<double, 2>;
using Curve = std::vector<Row2>;

constexpr std::string_view drive_colour = "#9db4d8";
constexpr std::string_view loss_colour = "#e9dfc0";
constexpr std::string_view back_colour = red;
constexpr std::string_view fine_dash = "(10,7)";
/// Up to this difference, in parts of the values, planets are drawn as one.
constexpr double coincident = 1e-6;
constexpr std::array<std::string_view, 6> planet_colours{blue, red, green, ochre, purple, dark_grey};
constexpr std::string_view time_label = "Mesh periods  s / 2π";

bool has_column(const History& h, const std::string& name) { return h.index_of(name) < h.columns.size(); }

void include(figures::FigureRange& range, const std::vector<double>& values, std::size_t from = 0) {
  for (std::size_t k = from; k < values.size(); ++k) range.include(values[k]);
}

/// At least as wide as given, so that rounding errors do not fill the figure.
figures::FigureRange no_narrower(const figures::FigureRange& range, double width) {
  const double lacking = std::max(0.0, 0.5 * (width - (range.high - range.low)));
  return {range.low - lacking, range.high + lacking};
}

figures::FigureRange y_range(const figures::FigureRange& data) {
  constexpr double least = 1e-6;  // of the values themselves
  return no_narrower(data, least * std::max(std::abs(data.low), std::abs(data.high))).widened(figures::figure_margin);
}

/// Rows of the record that a figure shows.
struct Window {
  std::size_t first = 0, rows = 0;
  double start = 0;    ///< of the first mesh period shown, since the record began [mesh periods]
  double periods = 0;  ///< shown
};

/// The last mesh periods, from the very instant of their beginning if the record has it.
Window last_periods(const History& h, int periods) {
  Window w;
  w.rows = h.rows();
  w.first = first_row(h, periods);
  const double all = static_cast<double>(h.rows()) / static_cast<double>(h.phases);
  w.periods = static_cast<double>(h.rows() - w.first) / static_cast<double>(h.phases);
  w.start = all - w.periods;
  if (w.first > 0) --w.first;
  return w;
}

/// Mesh periods since the window began, of a row.
double time_of(const History& h, const Window& w, std::size_t row) {
  return static_cast<double>(row + 1) / static_cast<double>(h.phases) - w.start;
}

Curve over_time(const History& h, const Window& w, const std::vector<double>& values) {
  Curve curve;
  for (std::size_t k = w.first; k < w.rows; ++k) curve.push_back({time_of(h, w, k), values[k]});
  return curve;
}

Curve pairs(const std::vector<double>& x, const std::vector<double>& y, std::size_t from = 0) {
  Curve curve;
  for (std::size_t k = from; k < x.size(); ++k) curve.push_back({x[k], y[k]});
  return curve;
}

/// Range of one coordinate.
figures::FigureRange range_of(const Curve& curve, std::size_t coordinate) {
  figures::FigureRange range;
  for (const Row2& row : curve) range.include(row[coordinate]);
  return range;
}

/// The figures of one run.
class RunFigures {
 public:
  RunFigures(const fs::path& folder, const RunOutput& output, const RunResult& result)
      : folder_(folder),
        output_(output),
        result_(result),
        h_(result.history),
        title_(figures::verbatim_text(output.points.title)) {}

  std::vector<DrawnFigure> draw() {
    if (h_.rows() > 0 && h_.phases > 0) {
      history();
      phase_portrait();
      poincare_section();
      if (has_crossing(result_)) poincare_crossing();
    }
    for (const SignalSpectrum& s : result_.spectra) {
      if (s.signal == "delta_sp_1")
        spectrum(s, "spectrum", fmt::format("Amplitude of  δ_{{sp,1}}  [{}]", unit_text(s.unit)));
      if (s.signal == "force_sp_1")
        spectrum(s, "spectrum_force", fmt::format("Amplitude of  F_{{sp,1}}  [{}]", unit_text(s.unit)));
    }
    if (has_exponents(result_)) exponents();
    if (has_multipliers(result_)) multipliers();
    if (h_.rows() > 0 && h_.phases > 0) {
      contact();
      mesh_force();
    }
    return std::move(figures_);
  }

 private:
  static std::string unit_text(const std::string& unit) { return unit == "um" ? "µm" : unit; }

  void finish(const figures::Sketch& sketch, const std::string& x_label, const std::string& y_label,
              const figures::FigureRange& x, const figures::FigureRange& y, const figures::FigureCanvas& canvas = {}) {
    figures_.push_back(
        {folder_ / (sketch.stem() + ".png"), sketch.draw(folder_, {title_, x_label, y_label}, x, y, {}, canvas)});
  }

  [[nodiscard]] std::size_t planets() const {
    std::size_t n = 0;
    while (has_column(h_, fmt::format("delta_sp_{}", n + 1))) ++n;
    return n;
  }

  [[nodiscard]] bool periodic() const { return result_.point.regime == Regime::periodic && result_.point.period > 0; }

  /// Deflection against rate in the last periods: the whole periodic orbit, else as much as can be shown.
  [[nodiscard]] Window portrait_window() const {
    return last_periods(
        h_, periodic() ? std::max(output_.options.shown_periods, result_.point.period) : studies::portrait_periods);
  }

  /// delta_sp_1 against its rate over the window.
  [[nodiscard]] Curve portrait(const Window& w) const {
    const studies::Portrait& p = result_.portrait;
    if (p.phases == 0) return pairs(h_.column("delta_sp_1"), h_.column("delta_sp_1_rate"), w.first);
    const auto wanted = static_cast<std::size_t>(std::lround(w.periods * p.phases)) + 1;
    return pairs(p.deflection, p.rate, p.deflection.size() - std::min(wanted, p.deflection.size()));
  }

  /// delta_sp_1 and its rate at whole mesh periods, over the rows from `first` on.
  [[nodiscard]] Curve section(std::size_t first) const {
    const std::vector<double> delta = h_.column("delta_sp_1");
    const std::vector<double> rate = h_.column("delta_sp_1_rate");
    const auto phases = static_cast<std::size_t>(h_.phases);
    Curve curve;
    for (std::size_t k = phases - 1; k < h_.rows(); k += phases)
      if (k >= first) curve.push_back({delta[k], rate[k]});
    return curve;
  }

  void history() {
    if (!has_column(h_, "delta_sp_1")) return;
    const bool ring = has_column(h_, "delta_rp_1");
    const Window w = last_periods(h_, output_.options.shown_periods);
    const Curve sp = over_time(h_, w, h_.column("delta_sp_1"));
    const Curve rp = ring ? over_time(h_, w, h_.column("delta_rp_1")) : Curve{};
    figures::FigureRange data = range_of(sp, 1);
    for (const Row2& row : rp) data.include(row[1]);
    const figures::FigureRange y = y_range(data);
    const figures::FigureRange x{0.0, w.periods};
    figures::Sketch sketch("history");
    // Flanks in the colour of their mesh, or grey if both meshes have the same.
    const bool same = !ring || output_.half_gap_sp == output_.half_gap_rp;
    const auto flanks = [&](double gap, std::string_view colour, const std::string& name) {
      bool seen = false;
      for (const double flank : {gap, -gap}) {
        if (flank < y.low || flank > y.high) continue;
        sketch.add(Curve{{x.low, flank}, {x.high, flank}}, figures::dashed(colour, 1.2, fine_dash));
        seen = true;
      }
      if (seen) sketch.entry(figures::dashed(colour, 1.2, fine_dash), name);
    };
    flanks(output_.half_gap_sp, same ? dark_grey : blue, same ? "flanks  ±b" : "flanks  ±b_{sp}");
    if (!same) flanks(output_.half_gap_rp, red, "flanks  ±b_{rp}");
    sketch.add(sp, figures::solid(blue), "δ_{sp,1}");
    if (ring) sketch.add(rp, figures::solid(red), "δ_{rp,1}");
    finish(sketch, std::string(time_label), "Deflection  δ / b_c", x, y);
  }

  void phase_portrait() {
    if (!has_column(h_, "delta_sp_1") || !has_column(h_, "delta_sp_1_rate")) return;
    const Window w = portrait_window();
    const Curve curve = portrait(w);
    const Curve points = section(w.first);
    const figures::FigureRange x = y_range(range_of(curve, 0));
    const figures::FigureRange y = y_range(range_of(curve, 1));
    figures::Sketch sketch("phase_portrait");
    add_flanks(sketch, x, y);
    sketch.add(curve, periodic() ? figures::solid(blue) : figures::solid("#7f8db5", 0.7),
               mesh_periods(periodic() ? result_.point.period : static_cast<int>(w.periods)));
    sketch.add(points, figures::dots(red, periodic() ? 1.3 : 0.7), "at whole mesh periods");
    finish(sketch, delta_label, rate_label, x, y);
  }

  /// Begin and end of contact, as vertical lines.
  void add_flanks(figures::Sketch& sketch, const figures::FigureRange& x, const figures::FigureRange& y) const {
    bool seen = false;
    for (const double flank : {output_.half_gap_sp, -output_.half_gap_sp}) {
      if (flank < x.low || flank > x.high) continue;
      sketch.add(Curve{{flank, y.low}, {flank, y.high}}, figures::dashed(dark_grey, 1.2, fine_dash));
      seen = true;
    }
    if (seen) sketch.entry(figures::dashed(dark_grey, 1.2, fine_dash), "flanks  ±b_{sp}");
  }

  void poincare_section() {
    if (!has_column(h_, "delta_sp_1") || !has_column(h_, "delta_sp_1_rate")) return;
    const bool recorded = !periodic() && !result_.section_deflection.empty();
    const Curve points = recorded ? pairs(result_.section_deflection, result_.section_rate, 0) : section(0);
    if (points.empty()) return;
    figures::Sketch sketch("poincare_section");
    figures::FigureRange x = range_of(points, 0);
    figures::FigureRange y = range_of(points, 1);
    const Window w = portrait_window();
    const Curve orbit = portrait(w);
    const figures::FigureRange wide_x = range_of(orbit, 0);
    const figures::FigureRange wide_y = range_of(orbit, 1);
    if (periodic()) {
      // A few points have no extent of their own: they are drawn at their places on the orbit.
      x = wide_x;
      y = wide_y;
      sketch.add(orbit, figures::solid(light_grey, 1.5), "the orbit");
      sketch.add(points, figures::dots(blue, 2.0), "at whole mesh periods");
    } else {
      constexpr double part = 0.05;  // of the portrait's extent
      x = no_narrower(x, part * (wide_x.high - wide_x.low));
      y = no_narrower(y, part * (wide_y.high - wide_y.low));
      sketch.add(points, figures::dots(blue, points.size() > 2000 ? 0.3 : 0.6));
    }
    finish(sketch, fmt::format("{}  at whole mesh periods", delta_label), rate_label, y_range(x), y_range(y));
  }

  void poincare_crossing() {
    Curve points;
    for (std::size_t k = 0; k < result_.crossing_phase.size(); ++k)
      points.push_back({result_.crossing_phase[k] / (2.0 * std::numbers::pi), result_.crossing_rate[k]});
    figures::Sketch sketch("poincare_crossing");
    sketch.add(points, figures::dots(blue, periodic() ? 2.0 : points.size() > 2000 ? 0.3 : 0.6));
    // From zero, the rate of a contact without impact.
    figures::FigureRange y{0.0, 0.0};
    for (const Row2& point : points) y.include(point[1]);
    finish(sketch, "Phase at which contact is made  s / 2π", "Rate on contact  dδ_{sp,1}/dτ / b_c", {0.0, 1.0},
           {0.0, y.high * (1.0 + figures::figure_margin)});
  }

  void spectrum(const SignalSpectrum& s, std::string_view stem, const std::string& label) {
    constexpr double highest = 6.25;
    constexpr double deepest = 1e-6;  // of the largest line
    Curve mesh;
    Curve between;
    double largest = 0.0;
    double smallest = std::numeric_limits<double>::infinity();
    const bool lines = s.exact && !s.lines.empty();
    const auto add = [&](Curve& curve, double frequency, double amplitude) {
      if (frequency > highest) return;
      curve.push_back({frequency, amplitude});
      largest = std::max(largest, amplitude);
    };
    if (lines) {
      for (const analysis::Harmonic& h : s.lines)
        if (h.order > 0)
          add(h.of_forcing() ? mesh : between, static_cast<double>(h.order) / static_cast<double>(h.period),
              h.amplitude);
    } else {
      for (std::size_t k = mean_bins; k < s.spectrum.amplitude.size(); ++k)
        add(mesh, s.spectrum.frequency(k), s.spectrum.amplitude[k]);
    }
    if (!(largest > 0.0)) return;
    const auto too_small = [&](const Row2& row) { return !(row[1] > deepest * largest); };
    // Lines of rounding would only clutter; a continuous spectrum is cut off by the frame.
    if (lines) {
      std::erase_if(mesh, too_small);
      std::erase_if(between, too_small);
    }
    for (const Curve* curve : {&mesh, &between})
      for (const Row2& row : *curve) smallest = std::min(smallest, std::max(row[1], deepest * largest));
    const figures::FigureRange y{std::pow(10.0, std::floor(std::log10(smallest) - 0.1)),
                                 std::pow(10.0, std::log10(largest) + 0.09 * std::log10(largest / smallest) + 0.2)};
    figures::Sketch sketch(stem);
    sketch.command(figures::logarithmic_axis("y", y) + "set xtics 1");
    if (lines) {
      const auto impulses = [](std::string_view colour) {
        return fmt::format("impulses linewidth 4 linecolor '{}'", colour);
      };
      const bool both = !between.empty();
      sketch.add(mesh, impulses(blue), both ? "mesh harmonics" : "");
      sketch.add(between, impulses(red), both ? "between them" : "");
      label_lines(sketch, s, highest);
    } else {
      sketch.add(mesh, figures::solid(blue, 1.2));
    }
    finish(sketch, "Frequency  f / f_m", label, {0.0, highest}, y);
  }

  /// Ratios over the strongest lines, if there is room beside a stronger one's.
  static void label_lines(figures::Sketch& sketch, const SignalSpectrum& s, double highest) {
    constexpr std::size_t most = 8;
    constexpr double room = 0.25;  // mesh frequencies
    std::vector<double> taken;
    for (const SpectralLine& line : strongest_lines(s, most)) {
      const bool crowded =
          std::any_of(taken.begin(), taken.end(), [&](double f) { return std::abs(f - line.frequency) < room; });
      if (crowded || line.frequency > highest - 0.5 * room) continue;
      taken.push_back(line.frequency);
      sketch.command(
          fmt::format("set label {} at first {}, first {} center offset character 0,0.7 font ',20' "
                      "textcolor '{}'",
                      figures::gnuplot_quoted(line.label), figures::figure_number(line.frequency),
                      figures::figure_number(line.amplitude), line.of_mesh ? blue : red));
    }
  }

  void exponents() {
    const analysis::LyapunovSpectrum& e = result_.exponents;
    constexpr std::size_t most = 4;
    const double interval = e.interval / (2.0 * std::numbers::pi);
    figures::Sketch sketch("exponents");
    figures::FigureRange x{0.0, static_cast<double>(e.growth.size() / e.exponents) * interval};
    figures::FigureRange y;
    const analysis::Estimate& first = e.per_s.front();
    const double low = first.low() * result_.omega;
    const double high = first.high() * result_.omega;
    const bool band = std::isfinite(high - low) && high > low;
    if (band) {
      y.include(low);
      y.include(high);
      sketch.add(std::vector<std::array<double, 3>>{{x.low, low, high}, {x.high, low, high}},
                 fmt::format("filledcurves fillstyle solid 1.0 noborder fillcolor '{}'", "#d5dbec"),
                 "95 % interval of λ_1");
    }
    const std::size_t shown = std::min(most, e.exponents);
    for (std::size_t i = shown; i-- > 0;) {
      const std::vector<double> mean = e.history(i);
      Curve curve;
      for (std::size_t k = 0; k < mean.size(); ++k) {
        curve.push_back({static_cast<double>(k + 1) * interval, mean[k] * result_.omega});
        // The first means vary widely and would hide the later ones.
        if (4 * k >= mean.size()) y.include(curve.back()[1]);
      }
      sketch.add(curve, figures::solid(planet_colours[i], i == 0 ? 2.5 : 1.8));
    }
    // Zero, which divides, is shown unless that would leave more of the figure empty than there is in it.
    figures::FigureRange with_zero = y;
    with_zero.include(0.0);
    if (with_zero.high - with_zero.low <= 2.0 * (y.high - y.low)) y = with_zero;
    if (y.low <= 0.0 && y.high >= 0.0) sketch.add(Curve{{x.low, 0.0}, {x.high, 0.0}}, figures::solid(light_grey, 1));
    for (std::size_t i = 0; i < shown; ++i)
      sketch.entry(figures::solid(planet_colours[i], i == 0 ? 2.5 : 1.8), fmt::format("λ_{}", i + 1));
    finish(sketch, "Mesh periods counted", "Running mean of the exponents  λ_i  [1/τ]", x, y_range(y));
  }

  void multipliers() {
    const analysis::FloquetMultipliers& m = *result_.multipliers;
    double reach = 1.15;
    for (const std::complex<double>& z : m.values) reach = std::max(reach, 1.1 * std::abs(z));
    Curve circle;
    constexpr int corners = 360;
    for (int k = 0; k <= corners; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / corners;
      circle.push_back({std::cos(angle), std::sin(angle)});
    }
    Curve inside;
    for (const std::complex<double>& z : m.values) inside.push_back({z.real(), z.imag()});
    Curve critical{inside[m.critical]};
    // Its conjugate is as near to the circle.
    if (critical[0][1] != 0.0) critical.push_back({critical[0][0], -critical[0][1]});
    figures::Sketch sketch("multipliers");
    sketch.command("set size ratio -1");
    sketch.add(Curve{{-reach, 0.0}, {reach, 0.0}}, figures::solid(light_grey, 1));
    sketch.add(Curve{{0.0, -reach}, {0.0, reach}}, figures::solid(light_grey, 1));
    sketch.add(circle, figures::solid(dark_grey, 1.5));
    sketch.add(inside, figures::dots(blue, 1.2));
    sketch.add(critical, figures::dots(red, 1.7),
               fmt::format("nearest to the circle:  |μ| = {:.4f}", std::abs(m.values[m.critical])));
    finish(sketch, "Re μ", "Im μ", {-reach, reach}, {-reach, reach}, figures::square_canvas);
  }

  void contact() {
    const Window w = last_periods(h_, output_.options.shown_periods);
    const std::size_t n = planets();
    if (n == 0) return;
    // In the order of model::Contact: drive, loss, back.
    std::array<std::vector<std::array<double, 6>>, 3> boxes;
    std::string tics;
    const double half = 0.5 / static_cast<double>(h_.phases);
    constexpr double half_height = 0.36;
    const std::size_t meshes = has_column(h_, "delta_rp_1") ? 2 * n : n;
    for (std::size_t row = 0; row < meshes; ++row) {
      const bool sun = row < n;
      const std::size_t planet = sun ? row : row - n;
      const std::vector<double> delta = h_.column(fmt::format("delta_{}_{}", sun ? "sp" : "rp", planet + 1));
      const double gap = sun ? output_.half_gap_sp : output_.half_gap_rp;
      const double y = static_cast<double>(meshes - 1 - row);
      tics +=
          fmt::format("{}'{}_{}' {}", row > 0 ? ", " : "", sun ? "sp" : "rp", planet + 1, figures::figure_number(y));
      const auto side = [&](std::size_t k) { return model::DynamicModel::contact(delta[k], gap); };
      for (std::size_t k = w.first; k < w.rows;) {
        std::size_t end = k;
        while (end < w.rows && side(end) == side(k)) ++end;
        const double from = std::max(0.0, time_of(h_, w, k) - half);
        const double to = std::min(w.periods, time_of(h_, w, end - 1) + half);
        boxes[static_cast<std::size_t>(side(k))].push_back(
            {0.5 * (from + to), y, from, to, y - half_height, y + half_height});
        k = end;
      }
    }
    constexpr std::array<std::string_view, 3> colours{drive_colour, loss_colour, back_colour};
    constexpr std::array<std::string_view, 3> names{"drive flank", "contact lost", "back flank"};
    figures::Sketch sketch("contact");
    sketch.command(fmt::format("set ytics ({}) scale 0\nset mytics 1", tics));
    for (std::size_t k = 0; k < 3; ++k) {
      sketch.add(boxes[k], fmt::format("boxxyerror fillstyle solid 1.0 noborder linecolor '{}'", colours[k]));
      sketch.entry(fmt::format("filledcurves fillstyle solid 1.0 noborder fillcolor '{}'", colours[k]), names[k]);
    }
    finish(sketch, std::string(time_label), "Mesh", {0.0, w.periods}, {-0.7, static_cast<double>(meshes) - 0.3});
  }

  /// Do two planets have one curve, as far as a picture shows?
  [[nodiscard]] bool coincide(const std::string& name, std::size_t i, std::size_t j, const Window& w) const {
    const std::vector<double> one = h_.column(fmt::format("{}_{}", name, i));
    const std::vector<double> other = h_.column(fmt::format("{}_{}", name, j));
    double size = 0.0;
    double difference = 0.0;
    for (std::size_t k = w.first; k < w.rows; ++k) {
      size = std::max(size, std::abs(one[k]));
      difference = std::max(difference, std::abs(one[k] - other[k]));
    }
    return difference <= coincident * size;
  }

  /// Whether the columns NAME_1 .. NAME_n are the same in the rows shown.
  [[nodiscard]] bool planets_coincide(const std::string& name, std::size_t n, const Window& w) const {
    for (std::size_t i = 2; i <= n; ++i)
      if (!coincide(name, 1, i, w)) return false;
    return true;
  }

  /// If the curve of a planet lies on that of an earlier one, dashes show both.
  [[nodiscard]] std::string style_of(const std::string& name, std::size_t i, const Window& w) const {
    const std::string_view colour = planet_colours[(i - 1) % planet_colours.size()];
    for (std::size_t j = 1; j < i; ++j)
      if (coincide(name, j, i, w)) return figures::dashed(colour, 2.0, "(10,10)");
    return figures::solid(colour);
  }

  void mesh_force() {
    const std::size_t n = planets();
    if (n == 0 || !(result_.static_force > 0.0) || !has_column(h_, "force_sp_1")) return;
    const bool ring = has_column(h_, "force_rp_1");
    const Window w = last_periods(h_, output_.options.shown_periods);
    figures::Sketch sketch("mesh_force");
    // Synchronous planets are one curve for each mesh; others have a frame for each mesh.
    const bool one = !ring || (planets_coincide("force_sp", n, w) && planets_coincide("force_rp", n, w));
    figures::FigureRange both;
    for (const char* mesh : {"sp", "rp"}) {
      const bool sun = mesh[0] == 's';
      if (!sun && !ring) continue;
      std::vector<Curve> curves;
      figures::FigureRange y;
      for (std::size_t i = 0; i < (one ? 1 : n); ++i) {
        std::vector<double> force = h_.column(fmt::format("force_{}_{}", mesh, i + 1));
        for (double& f : force) f /= result_.static_force;
        include(y, force, w.first);
        curves.push_back(over_time(h_, w, force));
      }
      both.include(y.low);
      both.include(y.high);
      if (!one) sketch.panel(fmt::format("F_{{{}}} / F_0", mesh), y_range(y));
      for (std::size_t i = 0; i < curves.size(); ++i)
        sketch.add(
            curves[i],
            one ? figures::solid(sun ? planet_colours[0] : red) : style_of(fmt::format("force_{}", mesh), i + 1, w),
            !ring ? std::string("F_{sp}")
            : one ? fmt::format("F_{{{}}}, all planets", mesh)
            : sun ? fmt::format("planet {}", i + 1)
                  : std::string());
    }
    finish(sketch, std::string(time_label), "Mesh force  F / F_0", {0.0, w.periods}, y_range(both));
  }

  static constexpr const char* delta_label = "Deflection  δ_{sp,1} / b_c";
  static constexpr const char* rate_label = "Rate  dδ_{sp,1}/dτ / b_c";

  fs::path folder_;
  const RunOutput& output_;
  const RunResult& result_;
  const History& h_;
  std::string title_;
  std::vector<DrawnFigure> figures_;
};

}  // namespace

std::vector<DrawnFigure> draw_run_figures(const fs::path& figures_folder, const RunOutput& output,
                                          const RunResult& result) {
  return RunFigures(figures_folder, output, result).draw();
}

}  // namespace epicyclic::kinds
