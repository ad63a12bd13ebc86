#include "reports/claims_output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "figures/sketch.hpp"

namespace epicyclic::reports {

using studies::ClaimOutcome;
using studies::ConditionOutcome;

namespace {

std::string start_name(studies::Start start) { return start == studies::Start::cold ? "cold" : "carried"; }

std::string verdict(const ClaimOutcome& outcome) { return outcome.holds ? "holds" : "fails"; }

/// All conditions' texts in a row.
std::string measured_text(const ClaimOutcome& outcome) {
  std::string text;
  for (const ConditionOutcome& c : outcome.conditions) {
    if (!text.empty()) text += "; ";
    text += c.text;
    if (c.error > 0.0 && std::isfinite(c.measured)) text += " (± " + short_text(c.error, 2) + ")";
    if (!c.holds) text += " [fails]";
  }
  return text;
}

}  // namespace

std::size_t Scorecard::holding() const {
  return static_cast<std::size_t>(std::ranges::count_if(scored.front().outcomes, &ClaimOutcome::holds));
}

std::size_t Scorecard::holding_inert() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(scored.front().outcomes, [](const ClaimOutcome& o) { return o.holds && o.inert; }));
}

studies::ClaimSeries claim_series(const studies::PointSource& points, const studies::LookOptions& look) {
  studies::ClaimSeries series;
  for (std::size_t k = 0; k < points.count; ++k) {
    const studies::PointResult result = points.read(k);
    auto& list = result.point.direction == studies::Direction::up ? series.points : series.other;
    list.push_back(claim_point(result, look));
  }
  std::ranges::sort(series.points, {}, &studies::ClaimPoint::value);
  std::ranges::sort(series.other, {}, &studies::ClaimPoint::value);
  if (series.points.empty()) std::swap(series.points, series.other);
  return series;
}

std::string scorecard_csv(const Scorecard& card) {
  std::vector<std::string> columns = {"claim"};
  for (const ScoredStart& s : card.scored) columns.push_back(start_name(s.start));
  columns.emplace_back("whatever_the_stage");
  for (const ScoredStart& s : card.scored) columns.push_back("measured_" + start_name(s.start));
  CsvWriter csv(columns);
  for (std::size_t k = 0; k < card.options.claims.size(); ++k) {
    csv.cell(card.options.claims[k].name);
    for (const ScoredStart& s : card.scored) csv.cell(verdict(s.outcomes[k]));
    csv.cell(card.scored.front().outcomes[k].inert ? 1 : 0);
    for (const ScoredStart& s : card.scored) csv.cell(measured_text(s.outcomes[k]));
    csv.end_row();
  }
  return csv.text();
}

std::string scorecard_summary(const Scorecard& card) {
  std::string text = fmt::format("# Claims held against {}\n\n", card.name);
  text += fmt::format("{} of {} claims hold", card.holding(), card.options.claims.size());
  if (card.holding_inert() > 0)
    text += fmt::format(", {} of them whatever the stage: nothing that they speak of changes anything",
                        card.holding_inert());
  text += fmt::format(" (points {}).\n\n", card.scored.front().start == studies::Start::cold
                                               ? "that start cold"
                                               : "carried from one to the next");
  text += "| claim | where | what | printed |";
  std::string line = "|---|---|---|---|";
  for (const ScoredStart& s : card.scored) {
    text += fmt::format(" {} |", start_name(s.start));
    line += "---|";
  }
  text += " measured |\n" + line + "---|\n";
  for (std::size_t k = 0; k < card.options.claims.size(); ++k) {
    const studies::Claim& claim = card.options.claims[k];
    text += fmt::format("| {} | {} | {} | {} |", claim.name, claim.where, claim.text, claim.printed);
    for (const ScoredStart& s : card.scored)
      text += fmt::format(" {}{} |", verdict(s.outcomes[k]), s.outcomes[k].inert ? ", whatever the stage" : "");
    text += fmt::format(" {} |\n", measured_text(card.scored.front().outcomes[k]));
  }
  for (std::size_t s = 1; s < card.scored.size(); ++s) {
    std::string other;
    for (std::size_t k = 0; k < card.options.claims.size(); ++k)
      if (card.scored[s].outcomes[k].holds != card.scored.front().outcomes[k].holds)
        other += fmt::format("- {}, {}: {}\n", card.options.claims[k].name, start_name(card.scored[s].start),
                             measured_text(card.scored[s].outcomes[k]));
    if (!other.empty()) text += "\nWhere another start gives another verdict:\n\n" + other;
  }
  return text;
}

std::vector<std::string> unlike_recorded(const Scorecard& card, const std::filesystem::path& recorded) {
  std::ifstream stream(recorded, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const auto table = parse_csv(text);
  if (!table || table->index_of("claim") == table->columns.size())
    throw InputError(recorded.string() + ": is no scorecard that this program writes");
  const auto now = parse_csv(scorecard_csv(card));
  std::vector<std::string> lines;
  const auto row_of = [](const CsvTable& of, const std::string& claim) -> const std::vector<std::string>* {
    const std::size_t column = of.index_of("claim");
    for (const auto& row : of.rows)
      if (row[column] == claim) return &row;
    return nullptr;
  };
  for (const auto& row : now->rows) {
    const std::string& claim = row[now->index_of("claim")];
    const auto* was = row_of(*table, claim);
    if (was == nullptr) {
      lines.push_back(claim + ": is not recorded");
      continue;
    }
    for (const ScoredStart& s : card.scored) {
      const std::string column = start_name(s.start);
      if (table->index_of(column) == table->columns.size()) {
        lines.push_back(fmt::format("{}: nothing is recorded of points that are {}", claim, column));
        continue;
      }
      const std::string& before = (*was)[table->index_of(column)];
      const std::string& is = row[now->index_of(column)];
      if (before != is) lines.push_back(fmt::format("{} ({}): {}, was recorded: {}", claim, column, is, before));
    }
  }
  for (const auto& row : table->rows) {
    const std::string& claim = row[table->index_of("claim")];
    if (row_of(*now, claim) == nullptr) lines.push_back(claim + ": is recorded, and no claim of the study");
  }
  return lines;
}

namespace {

/// Poincare points of planet 1's mesh over the parameter, of the first direction.
std::vector<std::array<double, 2>> section_dots(const studies::PointSource& points, studies::MeshSide mesh) {
  std::vector<std::array<double, 2>> dots;
  for (std::size_t k = 0; k < points.count; ++k) {
    const studies::PointResult r = points.read(k);
    if (r.point.direction != studies::Direction::up || r.outcome != integrate::Outcome::reached) continue;
    const std::size_t planets = r.sun_planet.size();
    const std::size_t column = r.poincare_columns - (mesh == studies::MeshSide::sun_planet ? 2 : 1) * planets;
    for (std::size_t row = 0; row < r.poincare_rows(); ++row)
      dots.push_back({r.point.value, r.poincare[row * r.poincare_columns + column]});
  }
  return dots;
}

}  // namespace

std::vector<DrawnFigure> draw_claim_figures(const std::filesystem::path& folder, const Scorecard& card,
                                            const std::string& title, const SweepPoints& points) {
  std::vector<DrawnFigure> drawn;
  for (const studies::ClaimFigure& figure : card.options.figures) {
    figures::Sketch sketch(figure.name);
    figures::FigureRange x;
    std::string parameter;
    for (const studies::ClaimPanel& panel : figure.panels) {
      const auto dots = section_dots(points(panel.sweep), panel.mesh);
      figures::FigureRange y;
      for (const auto& [value, delta] : dots) {
        x.include(value);
        y.include(delta);
      }
      for (const studies::ClaimSweep& sweep : card.options.sweeps)
        if (sweep.name == panel.sweep) parameter = sweep.axis.name;
      const std::string symbol = panel.mesh == studies::MeshSide::sun_planet ? "δ_{sp1} / b_c" : "δ_{rp1} / b_c";
      const std::string words = panel.title.empty() ? symbol : figures::literal_text(panel.title) + "    " + symbol;
      sketch.panel(words, y.widened(figures::figure_margin));
      constexpr double dot = 0.25;
      sketch.add(dots, figures::dots(figures::ink::blue, dot));
    }
    constexpr int height_alone = 1100;
    constexpr int height_each = 620;
    const figures::FigureCanvas canvas{
        1800, figure.panels.size() == 1 ? height_alone : height_each * static_cast<int>(figure.panels.size())};
    const std::string words = figure.title.empty() ? title : figures::literal_text(figure.title) + ": " + title;
    drawn.push_back({folder / (figure.name + ".png"),
                     sketch.draw(folder, {words, parameter_label(parameter), ""}, x, {}, {}, canvas)});
  }
  return drawn;
}

}  // namespace epicyclic::reports
