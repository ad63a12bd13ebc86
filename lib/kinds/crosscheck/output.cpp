#include "kinds/crosscheck/output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/counted.hpp"
#include "core/csv.hpp"
#include "figures/line_figure.hpp"
#include "gear/kinematics.hpp"

namespace epicyclic::kinds {

using namespace reports;

namespace {

using studies::Comparison;
using studies::Verdict;

constexpr std::array<Verdict, 8> differing = {Verdict::coexisting,  Verdict::tolerance,  Verdict::smoothing,
                                              Verdict::transient,   Verdict::torus,      Verdict::chaos,
                                              Verdict::not_reached, Verdict::unexplained};

}  // namespace

void write_crosscheck_csv(const std::filesystem::path& file, const studies::Crosscheck& all) {
  CsvWriter csv(file, {"point", "direction", "value", "variant", "method", "relative_tolerance", "clearance_smoothing",
                       "status", "regime", "period", "reference_status", "reference_regime", "reference_period",
                       "reference_orbit_period", "orbit_distance", "verdict", "detail", "rhs_evaluations"});
  for (const Comparison& c : all.comparisons) {
    const studies::PointResult& r = all.reference[c.point];
    const studies::Variant& v = all.variants[c.variant];
    csv.row(r.point.index, store::direction_word(r.point.direction), r.point.value, v.label, v.integrator.method,
            v.integrator.relative_tolerance, v.clearance_smoothing, store::status_word(c.result.outcome),
            store::regime_word(c.result), c.result.period, store::status_word(r.outcome), store::regime_word(r),
            r.period, r.period, c.distance, to_string(c.verdict), c.detail, c.result.rhs_evaluations);
  }
  csv.commit();
}

std::size_t differences(const studies::Crosscheck& all) {
  return static_cast<std::size_t>(std::count_if(all.comparisons.begin(), all.comparisons.end(),
                                                [](const Comparison& c) { return c.verdict != Verdict::agree; }));
}

std::size_t unexplained(const studies::Crosscheck& all) {
  return static_cast<std::size_t>(std::count_if(
      all.comparisons.begin(), all.comparisons.end(),
      [](const Comparison& c) { return c.verdict == Verdict::unexplained || c.verdict == Verdict::not_reached; }));
}

std::string crosscheck_summary(const AxisWords& words, const studies::Crosscheck& all) {
  std::string text =
      fmt::format("reference: {}, relative tolerance {:g}, {}\n\n", all.variants[0].label,
                  all.variants[0].integrator.relative_tolerance, counted(all.reference.size(), "points"));
  std::map<std::string, int> regimes;
  for (const auto& r : all.reference)
    ++regimes[r.outcome == integrate::Outcome::reached ? regime_name(r) : store::status_word(r.outcome)];
  std::string list;
  for (const auto& [name, count] : regimes) list += fmt::format("{}{} {}", list.empty() ? "" : ", ", count, name);
  text += fmt::format("Regimes of the reference: {}.\n\n", list);
  text += "| variant | agree | of these compared state by state | largest distance | ";
  for (const Verdict v : differing) text += to_string(v) + " | ";
  text += "right-hand sides over the reference's |\n|---|---|---|---|";
  for (std::size_t k = 0; k <= differing.size(); ++k) text += "---|";
  text += '\n';
  double reference_cost = 0.0;
  for (const auto& r : all.reference) reference_cost += static_cast<double>(r.rhs_evaluations);
  for (std::size_t v = 1; v < all.variants.size(); ++v) {
    std::map<Verdict, int> count;
    int compared = 0;
    double largest = 0.0;
    double cost = 0.0;
    for (const Comparison& c : all.comparisons) {
      if (c.variant != v) continue;
      ++count[c.verdict];
      cost += static_cast<double>(c.result.rhs_evaluations);
      // Of results that agree: others are two answers, not one with an error.
      if (c.verdict != Verdict::agree || !std::isfinite(c.distance)) continue;
      ++compared;
      largest = std::max(largest, c.distance);
    }
    text += fmt::format("| {} | {} | {} | {} | ", all.variants[v].label, count[Verdict::agree], compared,
                        compared > 0 ? fmt::format("{:.2g}", largest) : "");
    for (const Verdict d : differing) text += fmt::format("{} | ", count[d]);
    text += fmt::format("{:.2f} |\n", cost / reference_cost);
  }
  bool first = true;
  for (const Comparison& c : all.comparisons) {
    if (c.verdict == Verdict::agree) continue;
    if (first) text += "\nDifferences:\n\n";
    first = false;
    const studies::PointResult& r = all.reference[c.point];
    std::string value = words.name + " = ";
    append_number(value, words.factor * r.point.value);
    const bool in_rpm_or_hertz = words.name != studies::speed_parameter && words.factor != 1.0;
    if (const double sun = r.meshes.speeds.sun; sun != 0.0 && !in_rpm_or_hertz)
      value += fmt::format(", sun {:.6g} rpm", gear::rpm * sun);
    text += fmt::format("- {} ({}), {}: {}; {}\n", value, store::direction_word(r.point.direction),
                        all.variants[c.variant].label, to_string(c.verdict), c.detail);
  }
  return text;
}

DrawnFigure draw_crosscheck_figure(const std::filesystem::path& folder, const SweepOutput& output,
                                   const studies::Crosscheck& all, double orbit_tolerance) {
  std::vector<figures::FigureCurve> curves;
  for (std::size_t v = 1; v < all.variants.size(); ++v) {
    figures::FigureCurve curve{figures::verbatim_text(all.variants[v].label), {}, {}, true};
    for (const Comparison& c : all.comparisons) {
      if (c.variant != v || !std::isfinite(c.distance)) continue;
      curve.x.push_back(all.reference[c.point].point.value);
      // Orbits that agree to the last bit are drawn at the rounding of numbers of order 1.
      constexpr double rounding = 1e-16;
      curve.y.push_back(std::max(c.distance, rounding));
    }
    curves.push_back(std::move(curve));
  }
  if (!all.reference.empty())
    curves.push_back(
        {"orbit tolerance", {output.sweep.axis.from, output.sweep.axis.to}, {orbit_tolerance, orbit_tolerance}, false});
  const figures::FigureText text{
      figures::verbatim_text(output.title), parameter_label(output.sweep.axis.name),
      fmt::format("Distance from the orbit of {}  [b_c, b_c/τ]", figures::verbatim_text(all.variants[0].label))};
  return {folder / "crosscheck.png",
          figures::line_figure(folder, "crosscheck", text, curves, {.log_x = false, .log_y = true})};
}

}  // namespace epicyclic::kinds
