#include "claims/calibrate_output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "claims/variable_words.hpp"
#include "core/csv.hpp"
#include "core/text.hpp"
#include "figures/sketch.hpp"
#include "reports/markdown.hpp"

namespace epicyclic::claims {

using reports::DrawnFigure;
using reports::markdown_cell;

namespace {

/// "island 2", "refinement", "profile".
std::string phase_name(const ClaimsOptions& options, std::size_t phase) {
  const auto islands = static_cast<std::size_t>(options.search.islands);
  if (phase < islands) return fmt::format("island {}", phase + 1);
  if (phase == islands) return "refinement";
  return phase == islands + 1 ? "profile" : "whole sweeps";
}

std::size_t claims_met(const Evaluation& evaluation) {
  return static_cast<std::size_t>(std::ranges::count(evaluation.holds, 1));
}

}  // namespace

void write_candidates_csv(const std::filesystem::path& file, const CalibrateOutput& output,
                          const KnownEvaluations& evaluations) {
  const ClaimsOptions& options = output.options;
  std::vector<std::string> columns = {"phase", "number", "cost", "stopped_early", "claims_met"};
  const auto more = candidate_columns(options);
  columns.insert(columns.end(), more.begin(), more.end());
  CsvWriter csv(file, columns);
  for (const auto& [key, c] : evaluations) {
    csv.cell(phase_name(options, key.phase)).cell(key.number).cell(c.evaluation.cost);
    csv.cell(c.evaluation.stopped_early ? 1 : 0).cell(claims_met(c.evaluation));
    add_candidate_cells(csv, options, c.u, c.evaluation.claim_costs);
    csv.end_row();
  }
  csv.commit();
}

void write_profile_csv(const std::filesystem::path& file, const CalibrateOutput& output,
                       const Calibration& calibration) {
  const ClaimsOptions& options = output.options;
  std::vector<std::string> columns = {"variable", "value", "cost", "claims_met"};
  for (const Claim& claim : options.claims) columns.push_back("cost_" + claim.name);
  CsvWriter csv(file, columns);
  for (const ProfilePoint& p : calibration.profile) {
    csv.cell(variable_name(options.space, p.variable)).cell(variable_text(options.space, p.variable, p.u, 17));
    csv.cell(p.evaluation.cost).cell(claims_met(p.evaluation));
    for (const double cost : p.evaluation.claim_costs) csv.cell(cost);
    csv.end_row();
  }
  csv.commit();
}

namespace {

/// Is a candidate of the profile as good as the result, in one sense?
using AsGood = std::function<bool(const Evaluation&)>;

/// It meets what the result meets.
AsGood no_claim_is_lost(const Calibration& calibration) {
  return [&holds = calibration.best->evaluation.holds](const Evaluation& evaluation) {
    if (!evaluation.refused.empty()) return false;
    for (std::size_t k = 0; k < holds.size(); ++k)
      if (holds[k] == 1 && evaluation.holds[k] != 1) return false;
    return true;
  };
}

/// Its cost is above the result's by less than half of that of the claim that weighs least.
AsGood costs_little_more(const CalibrateOutput& output, const Calibration& calibration) {
  double least_weight = std::numeric_limits<double>::infinity();
  for (const Claim& claim : output.options.claims)
    if (claim.weight > 0.0) least_weight = std::min(least_weight, claim.weight);
  // Costs are sums; one that is half a claim more by rounding alone is not less.
  constexpr double rounding = 1e-9;
  const double bound = calibration.best->evaluation.cost + (0.5 - rounding) * least_weight;
  return [bound](const Evaluation& evaluation) { return evaluation.refused.empty() && evaluation.cost < bound; };
}

/// Where candidates are as good as the result along one variable through it.
struct Determination {
  std::vector<const ProfilePoint*> points;  ///< of the variable
  std::vector<bool> good;
  double low = 0, high = 0;  ///< of a parameter: the stretch about the result, in its range

  [[nodiscard]] bool any() const {
    return std::ranges::all_of(good, [](bool is) { return is; });
  }
};

Determination determination(const Calibration& calibration, std::size_t variable, const AsGood& as_good) {
  Determination d;
  for (const ProfilePoint& p : calibration.profile)
    if (p.variable == variable) {
      d.points.push_back(&p);
      d.good.push_back(as_good(p.evaluation));
    }
  const double u = calibration.best->u[variable];
  d.low = u;
  d.high = u;
  for (std::size_t k = d.points.size(); k-- > 0;)
    if (d.points[k]->u <= u) {
      if (!d.good[k]) break;
      d.low = d.points[k]->u;
    }
  for (std::size_t k = 0; k < d.points.size(); ++k)
    if (d.points[k]->u >= u) {
      if (!d.good[k]) break;
      d.high = d.points[k]->u;
    }
  return d;
}

/// Of a parameter the stretch about the result, of a choice its options.
std::string determined_text(const CalibrateOutput& output, const Calibration& calibration, std::size_t variable,
                            const AsGood& as_good) {
  const ParameterSpace& space = output.options.space;
  const Determination d = determination(calibration, variable, as_good);
  if (d.points.empty()) return "";
  if (variable < space.parameters.size() &&
      !space.counts(space.parameters[variable], space.options_at(calibration.best->u)))
    return "does not count";
  if (variable >= space.parameters.size()) {
    if (d.any()) return "any";
    std::string options;
    for (std::size_t k = 0; k < d.points.size(); ++k)
      if (d.good[k]) options += (options.empty() ? "" : ", ") + variable_text(space, variable, d.points[k]->u, 0);
    return options;
  }
  if (d.low == 0.0 && d.high == 1.0) return "any";
  if (d.low == d.high) return "nearer than the profile's values";
  return variable_text(space, variable, d.low, 4) + " to " + variable_text(space, variable, d.high, 4);
}

}  // namespace

DrawnFigure draw_determination(const std::filesystem::path& folder, const CalibrateOutput& output,
                               const Calibration& calibration) {
  const ParameterSpace& space = output.options.space;
  const std::size_t rows = space.parameters.size();
  figures::Sketch sketch("determination");
  figures::FigurePanel panel{"", {0.4, static_cast<double>(rows) + 0.6}, {}};
  std::vector<std::array<double, 2>> ranges;
  std::vector<std::array<double, 2>> met;   // no claim is lost
  std::vector<std::array<double, 2>> near;  // little more of a cost
  std::vector<std::array<double, 2>> results;
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::size_t> options = space.options_at(calibration.best->u);
  for (std::size_t k = 0; k < rows; ++k) {
    const auto row = static_cast<double>(rows - k);
    const FreeParameter& p = space.parameters[k];
    constexpr std::size_t longest = 46;
    const std::string range = fmt::format(": {} to {}", short_text(p.from, 3), short_text(p.to, 3));
    panel.names.emplace_back(row,
                             row_text(p.description.empty() ? p.name : p.description, longest - range.size()) + range);
    if (!space.counts(p, options)) continue;
    ranges.insert(ranges.end(), {{0.0, row}, {1.0, row}, {gap, gap}});
    for (const auto& [as_good, stretches] :
         {std::pair(no_claim_is_lost(calibration), &met), std::pair(costs_little_more(output, calibration), &near)}) {
      const Determination d = determination(calibration, k, as_good);
      stretches->insert(stretches->end(), {{d.low, row}, {d.high, row}, {gap, gap}});
    }
    results.push_back({calibration.best->u[k], row});
  }
  sketch.panel(panel);
  sketch.add(ranges, figures::solid(figures::ink::light_grey, 1));
  sketch.add(near, figures::solid(figures::ink::light_blue, 7), "cost rises by less than half a claim");
  sketch.add(met, figures::solid(figures::ink::blue, 7), "no claim is lost");
  sketch.add(results, figures::dots(figures::ink::red, 1.2), "result");
  constexpr double margin = 0.02;  // so that marks at both ends are whole
  return {folder / "determination.png",
          sketch.draw(folder, {"", "Place in the range", ""}, {-margin, 1.0 + margin}, {}, {}, canvas_of_rows(rows))};
}

namespace {

/// Says so where the profile came upon a candidate that is better than the result through which it goes; not where
/// whole sweeps chose the result, and not its cost.
std::string better_text(const CalibrateOutput& output, const Calibration& calibration) {
  if (calibration.whole() != nullptr) return "";
  const ProfilePoint* better = nullptr;
  double least = calibration.best->evaluation.cost;
  for (const ProfilePoint& p : calibration.profile)
    if (p.evaluation.refused.empty() && p.evaluation.cost < least) {
      least = p.evaluation.cost;
      better = &p;
    }
  if (better == nullptr) return "";
  return fmt::format(
      "\n**Not the least cost yet**: with {} = {} and all other values unchanged the profile has cost {}, and {} "
      "claims by the screening. A search that begins there may find less.\n",
      variable_name(output.options.space, better->variable),
      variable_text(output.options.space, better->variable, better->u, 4), short_text(least, 5),
      claims_met(better->evaluation));
}

}  // namespace

std::string calibrate_summary(const CalibrateOutput& output, const Calibration& calibration) {
  const ClaimsOptions& options = output.options;
  const EvaluatedCandidate& best = calibration.best.value();
  std::size_t stopped_early = 0;
  std::size_t refused = 0;
  for (const auto& [key, c] : calibration.evaluations) {
    stopped_early += c.evaluation.stopped_early ? 1 : 0;
    refused += c.evaluation.refused.empty() ? 0 : 1;
  }
  std::string text = fmt::format("# Search for what is not published: {}\n\n", output.name);
  text += fmt::format(
      "{} candidates, {} of them given up early, {} refused as no valid stage; seed {}, {} islands of {}.\n\n",
      calibration.evaluations.size(), stopped_early, refused, options.search.seed, options.search.islands,
      options.search.population);
  if (!calibration.complete) text += "Stopped before its end.\n\n";
  const Evaluation* whole_of_best = calibration.whole();
  const std::string whole =
      whole_of_best == nullptr ? "" : fmt::format("{} by whole sweeps, ", claims_met(*whole_of_best));
  text += fmt::format("Best: {}{} of {} claims by the screening, cost {}; found by {}, candidate {}.\n\n", whole,
                      claims_met(best.evaluation), options.claims.size(), short_text(best.evaluation.cost, 5),
                      phase_name(options, best.key.phase), best.key.number);
  const auto told = [&](const Evaluation& e, std::size_t k) {
    return e.holds[k] == 1 ? std::string("holds") : short_text(e.claim_costs[k], 3);
  };
  text += whole_of_best == nullptr ? "| claim | what | cost |\n|---|---|---|\n"
                                   : "| claim | what | cost | by whole sweeps |\n|---|---|---|---|\n";
  for (std::size_t k = 0; k < options.claims.size(); ++k) {
    text += fmt::format("| {} | {} | {} |", markdown_cell(options.claims[k].name),
                        markdown_cell(options.claims[k].text), told(best.evaluation, k));
    if (whole_of_best != nullptr) text += " " + told(*whole_of_best, k) + " |";
    text += "\n";
  }
  if (!calibration.confirmed.empty()) {
    text +=
        "\nThe best candidates that differ, compared with whole sweeps:\n\n| candidate | cost | claims by the "
        "screening | by whole sweeps | which |\n|---|---|---|---|---|\n";
    for (const Confirmed& c : calibration.confirmed) {
      std::string which;
      for (std::size_t k = 0; k < options.claims.size(); ++k)
        if (c.whole.holds[k] == 1) which += (which.empty() ? "" : ", ") + options.claims[k].name;
      if (!c.whole.refused.empty()) which = markdown_cell("no valid stage all along: " + c.whole.refused);
      text += fmt::format("| {}, {} | {} | {} | {} | {} |\n", phase_name(options, c.candidate.key.phase),
                          c.candidate.key.number, short_text(c.candidate.evaluation.cost, 5),
                          claims_met(c.candidate.evaluation), claims_met(c.whole), which);
    }
  }
  text += better_text(output, calibration);
  text +=
      "\nEach parameter alone, all others as in the result. The ranges about the result are those of the profile's "
      "values. In the first, the cost rises by less than half of a claim; a claim that just fails costs a tenth. In "
      "the second, no claim that the result meets by the screening is lost.\n\n"
      "| parameter | range | result | cost rises little | no claim is lost |\n|---|---|---|---|---|\n";
  for (std::size_t k = 0; k < options.space.dimension(); ++k) {
    std::string range;
    std::string words = variable_name(options.space, k);
    if (k < options.space.parameters.size()) {
      const FreeParameter& p = options.space.parameters[k];
      range = short_text(p.from, 4) + " to " + short_text(p.to, 4);
      if (!p.description.empty()) words += ", " + p.description;
    }
    text += fmt::format("| {} | {} | {} | {} | {} |\n", markdown_cell(words), range,
                        markdown_cell(variable_text(options.space, k, best.u[k], 4)),
                        determined_text(output, calibration, k, costs_little_more(output, calibration)),
                        determined_text(output, calibration, k, no_claim_is_lost(calibration)));
  }
  return text;
}

}  // namespace epicyclic::claims
