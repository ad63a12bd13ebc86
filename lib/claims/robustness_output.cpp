#include "claims/robustness_output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "claims/variable_words.hpp"
#include "core/csv.hpp"
#include "core/text.hpp"
#include "figures/sketch.hpp"
#include "reports/markdown.hpp"

namespace epicyclic::claims {

using reports::DrawnFigure;
using reports::markdown_cell;

using analysis::Interval;

namespace {

/// Does the interval leave out zero?
bool is_told(const Interval& i) { return i.low > 0.0 || i.high < 0.0; }

std::string percent(double part) { return short_text(100.0 * part, 3); }

/// Factors by how much they decide a claim, the most first; those whose intervals hold zero are left out.
std::vector<std::size_t> deciding(const ClaimRobustness& claim) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < claim.influences.size(); ++k)
    if (is_told(claim.influences[k])) order.push_back(k);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return std::abs(claim.influences[a].value) > std::abs(claim.influences[b].value);
  });
  return order;
}

}  // namespace

void write_draws_csv(const std::filesystem::path& file, const RobustnessOutput& output,
                     const KnownEvaluations& evaluations) {
  std::vector<std::string> columns = {"draw", "judged_by", "valid"};
  for (const Claim& claim : output.options.claims) columns.push_back("holds_" + claim.name);
  const auto more = candidate_columns(output.options);
  columns.insert(columns.end(), more.begin(), more.end());
  CsvWriter csv(file, columns);
  for (const auto& [key, c] : evaluations) {
    csv.cell(key.number).cell(key.phase == 0 ? "screening" : "whole sweeps").cell(c.evaluation.refused.empty() ? 1 : 0);
    for (const char holds : c.evaluation.holds) csv.cell(static_cast<int>(holds));
    add_candidate_cells(csv, output.options, c.u, c.evaluation.claim_costs);
    csv.end_row();
  }
  csv.commit();
}

void write_robustness_tables(const std::filesystem::path& folder, const RobustnessOutput& output) {
  CsvWriter parts(folder / "robustness.csv",
                  {"claim", "draws", "holds", "fraction", "fraction_low", "fraction_high", "confirmed_both",
                   "confirmed_neither", "confirmed_screening_only", "confirmed_whole_only"});
  CsvWriter influences(folder / "influence.csv",
                       {"claim", "variable", "rank_correlation", "rank_correlation_low", "rank_correlation_high"});
  const std::vector<Factor> factors = claims::factors(output.options.space);
  for (std::size_t k = 0; k < output.claims.size(); ++k) {
    const ClaimRobustness& claim = output.claims[k];
    const std::string& name = output.options.claims[k].name;
    const ClaimAgreement& a = output.agreement[k];
    parts.row(name, claim.draws, claim.holds, claim.fraction.value, claim.fraction.low, claim.fraction.high, a.both,
              a.neither, a.glance_only, a.whole_only);
    for (std::size_t v = 0; v < claim.influences.size(); ++v) {
      const Interval& i = claim.influences[v];
      influences.row(name, factor_name(output.options.space, factors[v]), i.value, i.low, i.high);
    }
  }
  parts.commit();
  influences.commit();
  CsvWriter by_option(folder / "options.csv",
                      {"choice", "option", "claim", "draws", "holds", "fraction", "fraction_low", "fraction_high"});
  for (const OptionRobustness& of : output.by_option) {
    const Choice& choice = output.options.space.choices[of.choice];
    for (std::size_t k = 0; k < of.fraction.size(); ++k)
      by_option.row(choice.name, choice.options[of.option].name, output.options.claims[k].name, of.draws, of.holds[k],
                    of.fraction[k].value, of.fraction[k].low, of.fraction[k].high);
  }
  by_option.commit();
}

namespace {

/// A table for each choice: claims, and the part of the draws with each option that meets them.
std::string options_in_words(const RobustnessOutput& output) {
  std::string text;
  const auto& choices = output.options.space.choices;
  for (std::size_t c = 0; c < choices.size(); ++c) {
    std::vector<const OptionRobustness*> of_choice;
    for (const OptionRobustness& of : output.by_option)
      if (of.choice == c && of.draws > 0) of_choice.push_back(&of);
    if (of_choice.size() < 2) continue;
    text += fmt::format("\nBy {}, with 95 % intervals:\n\n| claim |", markdown_cell(choices[c].name));
    std::string rule = "|---|";
    for (const auto* of : of_choice) {
      text += fmt::format(" {} ({} draws) |", markdown_cell(choices[c].options[of->option].name), of->draws);
      rule += "---|";
    }
    text += "\n" + rule + "\n";
    for (std::size_t k = 0; k < output.claims.size(); ++k) {
      text += "| " + markdown_cell(output.options.claims[k].name) + " |";
      for (const auto* of : of_choice) {
        const Interval& f = of->fraction[k];
        text += fmt::format(" {} % ({} to {} %) |", percent(f.value), percent(f.low), percent(f.high));
      }
      text += "\n";
    }
  }
  return text;
}

}  // namespace

std::string robustness_summary(const RobustnessOutput& output, const KnownEvaluations& evaluations) {
  const ClaimsOptions& options = output.options;
  std::size_t refused = 0;
  std::map<std::size_t, std::size_t> met;
  const auto draws = surveyed_draws(evaluations);
  for (const auto* c : draws) {
    if (!c->evaluation.refused.empty())
      ++refused;
    else
      ++met[static_cast<std::size_t>(std::ranges::count(c->evaluation.holds, 1))];
  }
  std::string text = fmt::format("# How robust claims are to what is not published: {}\n\n", output.name);
  text += fmt::format("{} draws from the ranges, seed {}; {} of them are no valid stage and are left out.\n\n",
                      draws.size(), options.survey.seed, refused);
  text += "| claim | what | holds for | 95 % interval | decided by (rank correlation) |\n|---|---|---|---|---|\n";
  constexpr std::size_t told = 4;
  const std::vector<Factor> factors = claims::factors(options.space);
  for (std::size_t k = 0; k < output.claims.size(); ++k) {
    const ClaimRobustness& claim = output.claims[k];
    std::string words;
    const auto order = deciding(claim);
    for (std::size_t j = 0; j < std::min(told, order.size()); ++j)
      words += fmt::format("{}{} {}", j == 0 ? "" : ", ", markdown_cell(factor_name(options.space, factors[order[j]])),
                           short_text(claim.influences[order[j]].value, 2));
    text += fmt::format("| {} | {} | {} % | {} to {} % | {} |\n", markdown_cell(options.claims[k].name),
                        markdown_cell(options.claims[k].text), percent(claim.fraction.value),
                        percent(claim.fraction.low), percent(claim.fraction.high), words);
  }
  text += "\n| claims met together | draws |\n|---|---|\n";
  for (const auto& [number, of] : met) text += fmt::format("| {} | {} |\n", number, of);
  text += options_in_words(output);
  if (evaluations.size() == draws.size()) return text;
  text += fmt::format(
      "\n{} of the draws, compared with whole sweeps:\n\n"
      "| claim | holds for (of all draws) | both say it holds | both say it fails | by the screening alone | by whole "
      "sweeps "
      "alone |\n|---|---|---|---|---|---|\n",
      evaluations.size() - draws.size());
  for (std::size_t k = 0; k < output.claims.size(); ++k) {
    const ClaimAgreement& a = output.agreement[k];
    text += fmt::format("| {} | {} % | {} | {} | {} | {} |\n", markdown_cell(options.claims[k].name),
                        percent(output.claims[k].fraction.value), a.both, a.neither, a.glance_only, a.whole_only);
  }
  return text;
}

namespace {

DrawnFigure draw_parts(const std::filesystem::path& folder, const RobustnessOutput& output) {
  const std::size_t claims = output.claims.size();
  figures::Sketch sketch("robustness");
  figures::FigurePanel panel{"", {0.4, static_cast<double>(claims) + 0.6}, {}};
  std::vector<std::array<double, 4>> bars;
  for (std::size_t k = 0; k < claims; ++k) {
    const Interval& f = output.claims[k].fraction;
    const auto row = static_cast<double>(claims - k);
    bars.push_back({100.0 * f.value, row, 100.0 * f.low, 100.0 * f.high});
    constexpr std::size_t longest = 46;
    const Claim& claim = output.options.claims[k];
    panel.names.emplace_back(row, row_text(claim.name + "  " + claim.text, longest));
  }
  sketch.panel(panel);
  sketch.add(bars,
             fmt::format("xerrorbars pointtype 7 pointsize 0.8*mark linewidth 2 linecolor '{}'", figures::ink::blue));
  const std::size_t draws = output.claims.empty() ? 0 : output.claims.front().draws;
  constexpr double margin = 1.5;  // so that marks at both ends are whole
  return {folder / "robustness.png",
          sketch.draw(folder,
                      {fmt::format("{} stages drawn from the ranges, intervals at 95 %", draws),
                       "Part that meets the claim [%]", ""},
                      {-margin, 100.0 + margin}, {}, {}, canvas_of_rows(claims))};
}

DrawnFigure draw_influences(const std::filesystem::path& folder, const RobustnessOutput& output) {
  const ParameterSpace& space = output.options.space;
  const std::size_t claims = output.claims.size();
  const std::vector<Factor> factors = claims::factors(space);
  const std::size_t variables = factors.size();
  figures::Sketch sketch("influence");
  figures::FigurePanel panel{"", {0.4, static_cast<double>(variables) + 0.6}, {}};
  for (std::size_t v = 0; v < variables; ++v) {
    constexpr std::size_t longest = 34;
    panel.names.emplace_back(static_cast<double>(variables - v),
                             row_text(words_without_unit(space, factors[v]), longest));
  }
  sketch.panel(panel);
  // Columns are wide enough for a name on edge; the largest circle is as high as a row, or as wide as a column; radii
  // are in units of the abscissa.
  constexpr double frame_width_usual = 1050.0;
  constexpr double narrowest_column = 34.0;
  figures::FigureCanvas canvas = canvas_of_rows(variables);
  const double frame_width = std::max(frame_width_usual, narrowest_column * static_cast<double>(claims));
  canvas.width += static_cast<int>(frame_width - frame_width_usual);
  const double column = frame_width / static_cast<double>(claims);
  const double largest = 0.48 * std::min<double>(row_height, column) / column;
  for (const bool positive : {true, false}) {
    std::vector<std::array<double, 3>> circles;
    for (std::size_t k = 0; k < claims; ++k)
      for (std::size_t v = 0; v < output.claims[k].influences.size(); ++v) {
        const Interval& i = output.claims[k].influences[v];
        if (is_told(i) && (i.value > 0.0) == positive)
          circles.push_back(
              {static_cast<double>(k + 1), static_cast<double>(variables - v), largest * std::sqrt(std::abs(i.value))});
      }
    if (!circles.empty())
      sketch.add(circles,
                 fmt::format("circles fillstyle solid 0.8 noborder linecolor '{}'",
                             positive ? figures::ink::blue : figures::ink::red),
                 positive ? "rank correlation of parameter and score > 0" : "< 0");
  }
  const std::size_t draws = output.claims.empty() ? 0 : output.claims.front().draws;
  figures::FigureText text{"", fmt::format("Claim ({} draws)", draws), ""};
  constexpr std::size_t longest_name = 24;
  for (std::size_t k = 0; k < claims; ++k)
    text.x_names.emplace_back(static_cast<double>(k + 1), row_text(output.options.claims[k].name, longest_name));
  return {folder / "influence.png",
          sketch.draw(folder, text, {0.4, static_cast<double>(claims) + 0.6}, {}, {}, canvas)};
}

}  // namespace

std::vector<DrawnFigure> draw_robustness_figures(const std::filesystem::path& folder, const RobustnessOutput& output) {
  std::vector<DrawnFigure> drawn = {draw_parts(folder, output)};
  // Few draws tell nothing of what decides.
  if (std::ranges::any_of(output.claims, [](const auto& claim) { return !deciding(claim).empty(); }))
    drawn.push_back(draw_influences(folder, output));
  return drawn;
}

}  // namespace epicyclic::claims
