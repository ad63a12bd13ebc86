#include "kinds/tolerance/output.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/atomic_file.hpp"
#include "core/csv.hpp"
#include "core/text.hpp"
#include "figures/line_figure.hpp"
#include "reports/axis_words.hpp"

namespace epicyclic::kinds {

using namespace reports;

namespace {

using studies::LadderStep;
using studies::quantity_names;
using studies::SmoothingStep;
using studies::StatisticsStep;
using studies::TolerancePoint;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> with_quantities(std::vector<std::string> columns) {
  columns.insert(columns.end(), quantity_names.begin(), quantity_names.end());
  return columns;
}

void start_row(CsvWriter& csv, const TolerancePoint& p) {
  csv.cell(p.point.index).cell(store::direction_word(p.point.direction)).cell(p.point.value);
}

/// The step of the ladder that is the study's own method and tolerance, if there is one.
const LadderStep* study_step(const TolerancePoint& p, const integrate::IntegratorOptions& integrator) {
  for (const LadderStep& s : p.ladder)
    if (s.method == integrator.method && s.tolerance == integrator.relative_tolerance) return &s;
  return nullptr;
}

studies::Quantities study_quantities(const TolerancePoint& p) {
  const studies::MeshRecord& sp = p.study.meshes.sun_planet.front();
  const studies::MeshRecord& rp = p.study.meshes.ring_planet.front();
  return {sp.delta.least, sp.delta.largest, rp.delta.least, rp.delta.largest};
}

/// Of quantity k: the study's difference, the reference's own, and the effect of interpolation in tables.
double error_bar(const TolerancePoint& p, std::size_t k) {
  return std::abs(study_quantities(p)[k] - p.reference[k]) + p.reference_error[k] + p.table_error[k];
}

/// Geometric mean over the points of one method and tolerance.
struct Mean {
  double log_error = 0, log_cost = 0, log_seconds = 0;
  int count = 0;
};

using Key = std::pair<std::string, double>;

std::map<Key, Mean> means(const ToleranceOutput& output, const std::vector<TolerancePoint>& points) {
  std::map<Key, Mean> all;
  for (const TolerancePoint& p : points)
    for (const LadderStep& s : p.ladder) {
      if (!(s.error > 0.0)) continue;
      Mean& m = all[{s.method, s.tolerance}];
      m.log_error += std::log(s.error);
      m.log_cost += std::log(studies::cost(s.work, output.dimension) / p.period);
      m.log_seconds += std::log(s.seconds / p.period);
      ++m.count;
    }
  return all;
}

template <class X>
std::vector<figures::FigureCurve> ladder_curves(const ToleranceOutput& output,
                                                const std::vector<TolerancePoint>& points, const X& abscissa) {
  const std::map<Key, Mean> all = means(output, points);
  std::vector<figures::FigureCurve> curves;
  for (const std::string& method : output.options.methods) {
    figures::FigureCurve curve{figures::verbatim_text(method), {}, {}, false, true};
    for (const double tolerance : output.options.tolerances) {
      const auto m = all.find({method, tolerance});
      if (m == all.end()) continue;
      curve.x.push_back(abscissa(m->second, tolerance));
      curve.y.push_back(std::exp(m->second.log_error / m->second.count));
    }
    if (!curve.x.empty()) curves.push_back(std::move(curve));
  }
  return curves;
}

void write_tolerance_table(const std::filesystem::path& folder, const std::vector<TolerancePoint>& points) {
  CsvWriter csv(folder / "tolerance.csv",
                with_quantities({"point", "direction", "value", "period", "method", "relative_tolerance", "status",
                                 "flow_error", "orbit_error", "rhs_evaluations", "jacobians", "steps"}));
  for (const TolerancePoint& p : points)
    for (const LadderStep& s : p.ladder) {
      start_row(csv, p);
      csv.cell(p.period).cell(s.method).cell(s.tolerance).cell(store::status_word(s.outcome)).cell(s.error);
      csv.cell(s.orbit_error).cell(s.work.right_hand_sides).cell(s.work.jacobians).cell(s.work.steps);
      for (const double q : s.quantities) csv.cell(q);
      csv.end_row();
    }
  csv.commit();
}

void write_smoothing_table(const std::filesystem::path& folder, const std::vector<TolerancePoint>& points) {
  CsvWriter csv(folder / "smoothing.csv",
                with_quantities({"point", "direction", "value", "period", "clearance_smoothing", "orbit_distance",
                                 "rhs_evaluations"}));
  for (const TolerancePoint& p : points)
    for (const SmoothingStep& s : p.smoothing) {
      start_row(csv, p);
      csv.cell(p.period).cell(s.width).cell(s.distance).cell(s.work.right_hand_sides);
      for (const double q : s.quantities) csv.cell(q);
      csv.end_row();
    }
  csv.commit();
}

void write_quantities_table(const std::filesystem::path& folder, const std::vector<TolerancePoint>& points) {
  CsvWriter csv(folder / "quantities.csv",
                {"point", "direction", "value", "period", "quantity", "study", "reference", "reference_error",
                 "table_error", "error_bar", "between_phases", "smoothing_extrapolated", "smoothing_exponent"});
  for (const TolerancePoint& p : points) {
    if (p.period == 0) continue;
    const studies::Quantities study = study_quantities(p);
    for (std::size_t k = 0; k < quantity_names.size(); ++k) {
      start_row(csv, p);
      csv.cell(p.period).cell(quantity_names[k]).cell(study[k]).cell(p.reference[k]).cell(p.reference_error[k]);
      csv.cell(p.table_error[k]).cell(error_bar(p, k)).cell(p.between_phases[k]);
      csv.cell(p.extrapolated[k]).cell(p.exponent[k]);
      csv.end_row();
    }
  }
  csv.commit();
}

void write_statistics_table(const std::filesystem::path& folder, const std::vector<TolerancePoint>& points) {
  CsvWriter csv(folder / "statistics.csv",
                {"point", "direction", "value", "method", "relative_tolerance", "clearance_smoothing", "status",
                 "lyapunov_max", "lyapunov_max_half_width", "mean_delta_sp", "mean_delta_sp_half_width",
                 "mean_delta_rp", "mean_delta_rp_half_width", "deviation_delta_sp", "deviation_delta_sp_half_width",
                 "deviation_delta_rp", "deviation_delta_rp_half_width", "agrees", "rhs_evaluations"});
  for (const TolerancePoint& p : points)
    for (const StatisticsStep& s : p.statistics) {
      const bool ok = s.outcome == integrate::Outcome::reached;
      const auto number = [&](double x) { return ok ? x : nan; };
      start_row(csv, p);
      csv.cell(s.method).cell(s.tolerance).cell(s.width).cell(store::status_word(s.outcome));
      csv.cell(number(s.exponent.value)).cell(number(s.exponent.half_width));
      for (const auto* moment : {&s.mean, &s.deviation})
        for (const auto& e : *moment) csv.cell(number(e.value)).cell(number(e.half_width));
      csv.cell(static_cast<int>(studies::statistics_agree(p.statistics.front(), s))).cell(s.right_hand_sides);
      csv.end_row();
    }
  csv.commit();
}

/// Slopes of the ladder, and the method and tolerance that it speaks for.
std::string ladder_text(const ToleranceOutput& output, const std::vector<TolerancePoint>& points) {
  std::string text;
  const double floor = 100.0 * output.options.reference_tolerance;
  const auto slopes = studies::slopes(points, output.dimension, floor);
  text += "Error of the flow over one orbit: slopes (least squares of logarithms; error ~ tolerance^a ~ cost^-b)\n\n";
  text += "| method | a | b | steps |\n|---|---|---|---|\n";
  const auto slope = [](double x) {
    return std::isfinite(x) ? fmt::format("{:.2f}", x) : std::string("too few steps");
  };
  for (const auto& s : slopes)
    text += fmt::format("| {} | {} | {} | {} |\n", s.method, slope(s.over_tolerance), slope(-s.over_cost), s.steps);
  const auto best = studies::recommend(points, output.dimension, output.options.target_error);
  if (best) {
    text += fmt::format(
        "\nRecommendation for orbit errors below {:g}: {} at relative tolerance {:g}: {:.0f} right-hand sides per "
        "mesh period (a Jacobian counted as {}), largest orbit error {:.2g}; ",
        output.options.target_error, best->method, best->tolerance, best->cost_per_period, output.dimension,
        best->largest_error);
    text +=
        best->smoothing_pays
            ? fmt::format(
                  "a clearance smoothed by {:g} b_c has a bias below that and saves {:.0f} % of the right-hand sides\n",
                  best->width, 100.0 * best->saved)
            : std::string("use the exact clearance: no width has a bias below that and saves right-hand sides\n");
  } else {
    text += fmt::format("\nNo method and tolerance of the study has an orbit error below {:g} at every point.\n",
                        output.options.target_error);
  }
  return text;
}

/// The reported quantities of each orbit, with their error bars.
std::string quantities_text(const ToleranceOutput& output, const std::vector<TolerancePoint>& points) {
  std::string text;
  text += fmt::format(
      "\nReported quantities by {} at relative tolerance {:g}, with error bars [b_c]. They are extrema at the "
      "phases that the study records: both sides of each jump of the stiffness, and others (/study/output_phases). In "
      "brackets: by how much they are greater at {} times as many phases. The bars do not include this.\n\n",
      output.integrator.method, output.integrator.relative_tolerance, studies::finer_phases);
  const AxisWords words = axis_words(output.sweep.sweep.axis.name, output.sweep.speed);
  text += "| point | value | period |";
  for (const char* name : quantity_names) text += fmt::format(" {} |", name);
  text +=
      " orbit error | last state from its orbit | largest multiplier | residual of the reference | tables half as "
      "fine "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const TolerancePoint& p : points) {
    if (p.period == 0) continue;
    const studies::Quantities study = study_quantities(p);
    text += fmt::format("| {} | {} | {} |", p.point.index, words.text(p.point.value, 12), p.period);
    for (std::size_t k = 0; k < quantity_names.size(); ++k)
      text += fmt::format(" {} ({:+.1e}) |", with_error(study[k], error_bar(p, k)), p.between_phases[k]);
    const LadderStep* own = study_step(p, output.integrator);
    text += fmt::format(" {} | {:.1g} | {:.6g} | {:.1g} | {:.1g} |\n",
                        own == nullptr ? "" : fmt::format("{:.1g}", own->orbit_error), p.distance_from_orbit,
                        p.largest_multiplier, p.reference_residual, p.table_displacement);
  }
  return text;
}

/// Exponent and moments of a response without a periodic orbit, one line a step.
std::string statistics_text(const TolerancePoint& p) {
  std::string text;
  text += "\n| method | tolerance | width | agrees |";
  for (const char* name : studies::statistics_names) text += fmt::format(" {} |", name);
  text += "\n|---|---|---|---|";
  for (std::size_t k = 0; k < studies::statistics_names.size(); ++k) text += "---|";
  text += '\n';
  for (const StatisticsStep& s : p.statistics) {
    const bool ok = s.outcome == integrate::Outcome::reached;
    std::string differ;
    for (const std::size_t k : studies::differing_statistics(p.statistics.front(), s))
      differ += fmt::format("{}{}", differ.empty() ? "no: " : ", ", studies::statistics_names[k]);
    text += fmt::format("| {} | {:g} | {:g} | {} |", s.method, s.tolerance, s.width,
                        !ok              ? store::status_word(s.outcome)
                        : differ.empty() ? "yes"
                                         : differ);
    for (const analysis::Estimate& e : studies::statistics_of(s))
      text += ok ? fmt::format(" {} |", with_error(e.value, e.half_width)) : " |";
    text += '\n';
  }
  return text;
}

/// Distance of each point's orbit over the width of its smoothed clearance, if that changes the orbit.
std::vector<figures::FigureCurve> bias_curves(const ToleranceOutput& output,
                                              const std::vector<TolerancePoint>& points) {
  std::vector<figures::FigureCurve> bias;
  for (const TolerancePoint& p : points) {
    figures::FigureCurve curve{fmt::format("{} = {}, period {}", parameter_symbol(output.sweep.sweep.axis.name),
                                           short_text(p.point.value, 6), p.period),
                               {},
                               {},
                               false,
                               true};
    for (const SmoothingStep& s : p.smoothing) {
      if (!s.found || !(s.distance > 0.0)) continue;  // without contact loss a smooth clearance changes nothing
      curve.x.push_back(s.width);
      curve.y.push_back(s.distance);
    }
    if (!curve.x.empty()) bias.push_back(std::move(curve));
  }
  return bias;
}

/// Exponent over tolerance by the study's own method and width, its intervals below it; empty for less than two.
std::vector<figures::FigureCurve> exponent_curves(const ToleranceOutput& output, const TolerancePoint& p) {
  figures::FigureCurve value{"largest exponent", {}, {}, true};
  figures::FigureCurve interval{"95 % interval", {}, {}, false};
  for (const StatisticsStep& s : p.statistics) {
    if (s.method != output.integrator.method || s.width != p.statistics.front().width ||
        s.outcome != integrate::Outcome::reached)
      continue;
    value.x.push_back(s.tolerance);
    value.y.push_back(s.exponent.value);
    // A bar of its own for each: a number that is not one interrupts the curve.
    for (const double end : {s.exponent.low(), s.exponent.high(), nan}) {
      interval.x.push_back(s.tolerance);
      interval.y.push_back(end);
    }
  }
  if (value.x.size() < 2) return {};
  return {interval, value};
}

}  // namespace

std::string write_tolerance_tables(const std::filesystem::path& folder, const ToleranceOutput& output,
                                   const std::vector<TolerancePoint>& points) {
  write_tolerance_table(folder, points);
  write_smoothing_table(folder, points);
  write_quantities_table(folder, points);
  write_statistics_table(folder, points);

  std::string text;
  if (std::any_of(points.begin(), points.end(), [](const TolerancePoint& p) { return p.period > 0; }))
    text += ladder_text(output, points) + quantities_text(output, points);
  for (const TolerancePoint& p : points) {
    if (!p.note.empty())
      text += fmt::format("\nPoint {} ({}): {}\n", p.point.index,
                          axis_words(output.sweep.sweep.axis.name, output.sweep.speed).text(p.point.value, 12), p.note);
    if (!p.statistics.empty()) text += statistics_text(p);
  }
  if (std::any_of(points.begin(), points.end(), [](const TolerancePoint& p) { return !p.statistics.empty(); }))
    text +=
        "\nExponents per tau; means and deviations over the Poincare points [b_c]; 95 % intervals. A row agrees if all "
        "its intervals overlap those of the first row; of equal values one in 200 does not.\n";
  write_file_atomically(folder / "tolerance.md", text);
  return text;
}

std::vector<DrawnFigure> draw_tolerance_figures(const std::filesystem::path& folder, const ToleranceOutput& output,
                                                const std::vector<TolerancePoint>& points) {
  std::vector<DrawnFigure> figures;
  const std::string title = figures::verbatim_text(output.sweep.title);
  const figures::FigureAxes logarithmic{.log_x = true, .log_y = true};
  const std::string error_label = "Error of the flow over one orbit  [b_c, b_c/τ]";
  const auto draw = [&](const std::string& stem, const std::string& x, const std::string& y,
                        const std::vector<figures::FigureCurve>& curves) {
    if (curves.empty()) return;
    figures.push_back(
        {folder / (stem + ".png"), figures::line_figure(folder, stem, {title, x, y}, curves, logarithmic)});
  };
  draw("work_precision", "Right-hand sides per mesh period", error_label,
       ladder_curves(output, points, [](const Mean& m, double) { return std::exp(m.log_cost / m.count); }));
  draw("work_precision_time", "Time per mesh period  [s]", error_label,
       ladder_curves(output, points, [](const Mean& m, double) { return std::exp(m.log_seconds / m.count); }));
  draw("error_over_tolerance", "Relative tolerance", error_label,
       ladder_curves(output, points, [](const Mean&, double tolerance) { return tolerance; }));

  draw("smoothing_bias", "Width of the smooth clearance  w / b_c", "Distance of the smoothed orbit  [b_c, b_c/τ]",
       bias_curves(output, points));

  for (const TolerancePoint& p : points) {
    const std::vector<figures::FigureCurve> curves = exponent_curves(output, p);
    if (curves.empty()) continue;
    const std::string stem = fmt::format("exponent_{}", p.point.index);
    figures.push_back(
        {folder / (stem + ".png"),
         figures::line_figure(folder, stem, {title, "Relative tolerance", "Largest Lyapunov exponent  λ [1/τ]"}, curves,
                              {.log_x = true, .log_y = false})});
  }
  return figures;
}

}  // namespace epicyclic::kinds
