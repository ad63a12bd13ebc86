#include "claims/scorecard.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/csv.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "figures/sketch.hpp"
#include "input/aliases.hpp"
#include "input/recorded_study.hpp"
#include "input/stage_completion.hpp"
#include "reports/markdown.hpp"
#include "reports/plot_output.hpp"
#include "store/identity.hpp"

namespace epicyclic::claims {

using reports::DrawnFigure;
using reports::markdown_cell;
using reports::parameter_label;

namespace {

/// "continued", "cold_printed": a column of verdicts.
std::string column_name(const ScoredStart& scored) {
  return std::string(scored.start == studies::Start::cold ? "cold" : "continued") +
         (scored.reading == Reading::printed ? "_printed" : "");
}

/// "continued", "cold, as printed".
std::string column_title(const ScoredStart& scored) {
  return std::string(scored.start == studies::Start::cold ? "cold" : "continued") +
         (scored.reading == Reading::printed ? ", as printed" : "");
}

std::string verdict(const ClaimOutcome& outcome) { return outcome.holds ? "holds" : "fails"; }

/// All conditions' texts in a row.
std::string measured_text(const ClaimOutcome& outcome) {
  std::string text;
  for (const ConditionOutcome& c : outcome.conditions) {
    if (!text.empty()) text += "; ";
    text += c.text;
    if (c.error > 0.0 && std::isfinite(c.measured))
      text += c.part_of_one ? " (± " + short_text(100.0 * c.error, 2) + " %)" : " (± " + short_text(c.error, 2) + ")";
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

namespace {

ClaimRecord read_all(Reading reading, const ClaimRecord& record, const ClaimsOptions& options) {
  ClaimRecord all;
  for (const auto& [name, series] : record) all[name] = read_as(reading, series, options);
  return all;
}

}  // namespace

Scorecard score(std::string name, const ClaimsOptions& options, const std::vector<ClaimRecord>& records) {
  Scorecard card{std::move(name), options, {}, {}};
  for (const Reading reading : options.readings)
    for (std::size_t k = 0; k < records.size(); ++k) {
      const ClaimRecord record = read_all(reading, records[k], options);
      ScoredStart scored{options.starts[k], reading, {}};
      for (const Claim& claim : options.claims) scored.outcomes.push_back(judge(claim, record, reading));
      card.scored.push_back(std::move(scored));
    }
  if (!options.is_scored(Reading::printed)) return card;
  ClaimsOptions other = options;
  for (const double dot : options.printed.other_dots) {
    other.printed.dot = dot;
    const ClaimRecord record = read_all(Reading::printed, records.front(), other);
    ScoredDots& scored = card.other_dots.emplace_back(ScoredDots{dot, {}});
    for (const Claim& claim : options.claims)
      scored.holds.push_back(judge(claim, record, Reading::printed).holds ? 1 : 0);
  }
  return card;
}

std::string scorecard_csv(const Scorecard& card) {
  std::vector<std::string> columns = {"claim"};
  for (const ScoredStart& s : card.scored) columns.push_back(column_name(s));
  columns.emplace_back("nothing_changes");
  for (const ScoredStart& s : card.scored) columns.push_back("measured_" + column_name(s));
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

namespace {

/// How verdicts as printed change with the size of the dots; empty if no other sizes are given.
std::string dots_text(const Scorecard& card) {
  if (card.other_dots.empty()) return {};
  const auto printed = std::ranges::find(card.scored, Reading::printed, &ScoredStart::reading);
  std::string text = fmt::format(
      "\nAs printed, with dots of another size than {} of the axis ({}):\n\n"
      "| dot | claims that hold | gained | lost |\n|---|---|---|---|\n",
      short_text(card.options.printed.dot, 6), column_title(*printed));
  for (const ScoredDots& other : card.other_dots) {
    std::vector<std::string> gained;
    std::vector<std::string> lost;
    for (std::size_t k = 0; k < other.holds.size(); ++k)
      if ((other.holds[k] == 1) != printed->outcomes[k].holds)
        (other.holds[k] == 1 ? gained : lost).push_back(markdown_cell(card.options.claims[k].name));
    text += fmt::format("| {} | {} | {} | {} |\n", short_text(other.dot, 6), std::ranges::count(other.holds, 1),
                        fmt::join(gained, ", "), fmt::join(lost, ", "));
  }
  return text;
}

/// Which claims hold in which reading, with the first of the starts; empty if there is one reading.
std::string senses_text(const Scorecard& card) {
  const auto of = [&](Reading reading) {
    return std::ranges::find_if(card.scored, [&](const ScoredStart& s) {
      return s.reading == reading && s.start == card.scored.front().start;
    });
  };
  const auto evidence = of(Reading::evidence);
  const auto printed = of(Reading::printed);
  if (evidence == card.scored.end() || printed == card.scored.end()) return {};
  std::array<std::vector<std::string>, 4> lists;  // neither, evidence, printed, both
  for (std::size_t k = 0; k < card.options.claims.size(); ++k)
    lists[(evidence->outcomes[k].holds ? 1U : 0U) + (printed->outcomes[k].holds ? 2U : 0U)].push_back(
        markdown_cell(card.options.claims[k].name));
  constexpr std::array<const char*, 4> titles = {"in neither reading", "by evidence only", "as printed only",
                                                 "in both readings"};
  std::string text = "| claims that hold | number | which |\n|---|---|---|\n";
  for (const std::size_t k : {3U, 1U, 2U, 0U})
    text += fmt::format("| {} | {} | {} |\n", titles[k], lists[k].size(), fmt::join(lists[k], ", "));
  return text + "\n";
}

}  // namespace

std::string scorecard_summary(const Scorecard& card) {
  std::string text = fmt::format("# Claims compared with {}\n\n", card.name);
  text += fmt::format("{} of {} claims hold", card.holding(), card.options.claims.size());
  if (card.holding_inert() > 0)
    text += fmt::format(", {} of them on sweeps along which no quantity of the claim changes, by symmetry for example",
                        card.holding_inert());
  if (card.options.sweeps.empty())
    text += ".\n\n";
  else
    text += fmt::format(
        " ({}points {}).\n\n",
        card.scored.front().reading == Reading::printed ? "regimes as a printed diagram shows them, " : "",
        card.scored.front().start == studies::Start::cold ? "that start cold"
                                                          : "whose initial state continues from the previous point");
  text += senses_text(card);
  text += "| claim | where | what | published |";
  std::string line = "|---|---|---|---|";
  for (const ScoredStart& s : card.scored) {
    text += fmt::format(" {} |", column_title(s));
    line += "---|";
  }
  text += " measured |\n" + line + "---|\n";
  for (std::size_t k = 0; k < card.options.claims.size(); ++k) {
    const Claim& claim = card.options.claims[k];
    text += fmt::format("| {} | {} | {} | {} |", markdown_cell(claim.name), markdown_cell(claim.where),
                        markdown_cell(claim.text), markdown_cell(claim.published));
    for (const ScoredStart& s : card.scored)
      text += fmt::format(" {}{} |", verdict(s.outcomes[k]), s.outcomes[k].inert ? ", nothing changes" : "");
    text += fmt::format(" {} |\n", markdown_cell(measured_text(card.scored.front().outcomes[k])));
  }
  if (text.find(not_converged) != std::string::npos)
    text += fmt::format(
        "\nPoints that are {}: the orbit is periodic, but the record has not converged to it. Their values are not "
        "those of the orbit; a larger transient_periods helps.\n",
        not_converged);
  for (std::size_t s = 1; s < card.scored.size(); ++s) {
    std::string other;
    for (std::size_t k = 0; k < card.options.claims.size(); ++k)
      if (card.scored[s].outcomes[k].holds != card.scored.front().outcomes[k].holds)
        other += fmt::format("- {}: {}\n", card.options.claims[k].name, measured_text(card.scored[s].outcomes[k]));
    if (!other.empty()) text += fmt::format("\nOther verdicts ({}):\n\n{}", column_title(card.scored[s]), other);
  }
  return text + dots_text(card);
}

namespace {

using nlohmann::json;

constexpr const char* recorded_format = "epicyclic scorecard 1";

json verdicts_of(const Scorecard& card) {
  json list = json::array();
  for (std::size_t k = 0; k < card.options.claims.size(); ++k) {
    json one = {{"claim", card.options.claims[k].name}};
    for (const ScoredStart& s : card.scored) one[column_name(s)] = verdict(s.outcomes[k]);
    list.push_back(std::move(one));
  }
  return list;
}

/// The options of integration and of a search are no part of the claims.
bool is_beside_the_claims(const std::string& line) {
  for (const char* pointer : {"/name:", "/integrator/", "/study/screening/", "/study/search/", "/study/survey/",
                              "/study/parameters", "/study/choices", "/study/figures"})
    if (line.starts_with(pointer) && !line.starts_with("/integrator/clearance_smoothing")) return true;
  const std::string_view pointer = std::string_view(line).substr(0, line.find(": "));
  const auto ends_with_one_of = [&](std::initializer_list<const char*> keys) {
    return std::ranges::any_of(keys, [&](const char* key) { return pointer.ends_with(key); });
  };
  return (line.starts_with("/study/claims/") && ends_with_one_of({"/weight", "/where", "/text", "/published"})) ||
         (line.starts_with("/study/sweeps/") &&
          ends_with_one_of({"/screening_points", "/survey_points", "/screening_round"}));
}

}  // namespace

std::string recorded_text(const Scorecard& card, const input::LoadedInput& study) {
  std::string text = fmt::format("{{\n\"format\": \"{}\",\n\"verdicts\": [", recorded_format);
  const json verdicts = verdicts_of(card);
  for (std::size_t k = 0; k < verdicts.size(); ++k) text += (k == 0 ? "\n" : ",\n") + verdicts[k].dump();
  return text + "\n],\n\"study\": " + study.resolved.dump() + "\n}\n";
}

json read_recorded(const std::filesystem::path& file) {
  const input::JsonSource source = input::read_json_file(file);
  if (!source.problems.empty()) throw input::InputProblems(source.problems);
  const json& recorded = source.value;
  const auto is_list_of_objects = [](const json& list) {
    return list.is_array() && std::ranges::all_of(list, [](const json& one) {
             return one.is_object() && one.contains("claim") && one["claim"].is_string();
           });
  };
  if (!recorded.is_object() || recorded.value("format", json()) != recorded_format ||
      !is_list_of_objects(recorded.value("verdicts", json())) || !recorded.value("study", json()).is_object())
    throw InputError(file.string() + ": holds no recorded verdicts");
  return recorded;
}

RecordedDifference unlike_recorded(const Scorecard& card, const input::LoadedInput& study, const json& recorded) {
  RecordedDifference difference;
  json there = recorded["study"];
  input::add_later_keys(there);
  const json computed = input::computed_values(there);
  difference.study = store::differences({there, computed}, {study.resolved, study.computed});
  std::erase_if(difference.study, is_beside_the_claims);
  if (!difference.study.empty()) return difference;
  // Claim and start by verdict; of a claim that is recorded twice all that is recorded.
  using Verdicts = std::map<std::pair<std::string, std::string>, std::set<std::string>>;
  const auto by_place = [](const json& list) {
    Verdicts verdicts;
    for (const json& one : list)
      for (const auto& [start, verdict] : one.items())
        if (start != "claim")
          verdicts[{one["claim"].get<std::string>(), input::new_value("/study/starts/N", start)}].insert(
              verdict.is_string() ? verdict.get<std::string>() : verdict.dump());
    return verdicts;
  };
  const Verdicts was = by_place(recorded["verdicts"]);
  const Verdicts now = by_place(verdicts_of(card));
  const auto verdict_text = [](const Verdicts& verdicts, const Verdicts::key_type& place) {
    const auto found = verdicts.find(place);
    return found == verdicts.end() ? std::string("nothing") : fmt::format("{}", fmt::join(found->second, " and "));
  };
  Verdicts all = now;
  all.insert(was.begin(), was.end());
  for (const auto& [place, unused] : all)
    if (const std::string is = verdict_text(now, place), before = verdict_text(was, place); is != before)
      difference.verdicts.push_back(
          fmt::format("{} ({}): {}, was recorded: {}", place.first, place.second, is, before));
  return difference;
}

namespace {

/// Poincare points of planet 1's mesh over the parameter, of the direction that verdicts are on.
std::vector<std::array<double, 2>> section_dots(const studies::PointSource& points, MeshSide mesh) {
  std::vector<std::array<double, 2>> dots;
  const studies::Direction judged = judged_direction(points);
  for (std::size_t k = 0; k < points.count; ++k) {
    const studies::PointResult r = points.read(k);
    if (r.point.direction != judged || r.outcome != integrate::Outcome::reached) continue;
    const std::size_t planets = r.meshes.sun_planet.size();
    const std::size_t column = r.poincare_columns - (mesh == MeshSide::sun_planet ? 2 : 1) * planets;
    for (std::size_t row = 0; row < r.poincare_rows(); ++row)
      dots.push_back({r.point.value, r.poincare[row * r.poincare_columns + column]});
  }
  return dots;
}

/// Poincare points of planet 1's mesh.
figures::FigureRange add_diagram(figures::Sketch& sketch, const ClaimPanel& panel, const Scorecard& card,
                                 const SweepPoints& points) {
  const auto dots = section_dots(points(panel.sweep), panel.mesh);
  figures::FigureRange x;
  figures::FigureRange y;
  for (const auto& [value, delta] : dots) {
    x.include(value);
    y.include(delta);
  }
  const std::string symbol = panel.mesh == MeshSide::sun_planet ? "δ_{sp,1} / b_c" : "δ_{rp,1} / b_c";
  const std::string words = panel.title.empty() ? symbol : figures::verbatim_text(panel.title) + "    " + symbol;
  // The axis spans at least ten recurrence tolerances, so that smaller widths appear as a point.
  const double middle = 0.5 * (y.low + y.high);
  const double axis = axis_length(y.low, y.high, card.options.recording.recurrence_tolerance);
  if (y.high - y.low < axis)
    for (const double side : {-0.5, 0.5}) y.include(middle + side * axis);
  sketch.panel(words, y.widened(figures::figure_margin));
  constexpr double dot = 0.25;
  sketch.add(dots, figures::dots(figures::ink::blue, dot));
  return x;
}

/// Conditions of all claims.
std::vector<const Condition*> conditions_of(const Scorecard& card) {
  std::vector<const Condition*> all;
  for (const Claim& claim : card.options.claims)
    for (const Condition& c : claim.conditions) all.push_back(&c);
  return all;
}

std::string style_of_data() { return figures::dots(figures::ink::red, 1.4, 6); }

using Places = std::vector<std::array<double, 2>>;

/// A panel over an ordinate, with its title inside at the top.
/// @returns the axis
figures::FigureRange add_panel(figures::Sketch& sketch, const ClaimPanel& panel, const std::string& symbol,
                               figures::FigureRange y, const figures::FigureRange& x) {
  // What differs by rounding alone appears as one value.
  constexpr double rounding = 1e-6;
  constexpr double around_one = 0.01;
  const double middle = 0.5 * (y.low + y.high);
  if (!y.empty() && y.high - y.low < rounding * std::abs(middle))
    for (const double side : {-around_one, around_one}) y.include(middle * (1.0 + side));
  const figures::FigureRange axis = y.widened(figures::figure_margin);
  sketch.panel(symbol, axis);
  if (!panel.title.empty())
    sketch.letters(Places{{0.5 * (x.low + x.high), axis.high}}, figures::verbatim_text(panel.title),
                   "center offset character 0,-0.9 boxed");
  return axis;
}

/// A quantity of a sweep's points.
Places rows_of(const std::vector<ClaimPoint>& points, const std::string& quantity) {
  Places rows;
  for (const ClaimPoint& p : points)
    rows.push_back({p.value, p.reached ? p.quantity(quantity) : std::numeric_limits<double>::quiet_NaN()});
  return rows;
}

/// Published values of a quantity along a sweep.
Places data_of(const ClaimPanel& panel, const Scorecard& card) {
  Places data;
  for (const Condition* c : conditions_of(card))
    if (c->kind == ConditionKind::curve && c->sweep == panel.sweep && c->quantity == panel.quantity)
      for (std::size_t k = 0; k < c->data.size(); ++k) data.push_back({c->data_at[k], c->data[k]});
  return data;
}

/// Of all panels of a figure with this quantity.
figures::FigureRange ordinate_of(const ClaimFigure& figure, const std::string& quantity, const Scorecard& card,
                                 const ClaimRecord& record) {
  figures::FigureRange y;
  for (const ClaimPanel& panel : figure.panels) {
    if (panel.quantity != quantity) continue;
    const ClaimSeries& series = record.at(panel.sweep);
    for (const Places& places :
         {rows_of(series.points, quantity), rows_of(series.other, quantity), data_of(panel, card)})
      for (const auto& place : places) y.include(place[1]);
  }
  return y;
}

/// A quantity along a sweep, in all its directions, with what is published of it: values, and bounds of changes.
figures::FigureRange add_curve(figures::Sketch& sketch, const ClaimPanel& panel, const Scorecard& card,
                               const ClaimSeries& series, const figures::FigureRange& ordinate,
                               const std::string& word_of_data) {
  const Places data = data_of(panel, card);
  const Places rows = rows_of(series.points, panel.quantity);
  const Places other = rows_of(series.other, panel.quantity);
  figures::FigureRange x;
  for (const auto& row : rows) x.include(row[0]);
  // Panels are low: the words would leave them.
  std::string label = reports::quantity_label(panel.quantity, false);
  constexpr std::string_view words = "the transmission error";
  if (const auto at = label.find(words); at != std::string::npos) label.replace(at, words.size(), "TE");
  const figures::FigureRange y = add_panel(sketch, panel, label, ordinate, x);
  const bool both = !other.empty();
  const auto word = [&](studies::Direction d) {
    return both ? (d == studies::Direction::up ? "up" : "down") : "computed";
  };
  sketch.add(rows, figures::solid(figures::ink::blue), word(series.direction));
  if (both) sketch.add(other, figures::dashed(figures::ink::green, 2, "(10,7)"), word(studies::Direction::down));
  sketch.add(data, style_of_data(), data.empty() ? "" : word_of_data);
  Places bounds;
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  for (const Condition* c : conditions_of(card))
    if (c->kind == ConditionKind::change && c->sweep == panel.sweep)
      for (const double bound : c->within)
        for (const auto& [value, height] : {std::pair(bound, y.low), {bound, y.high}, {gap, gap}})
          bounds.push_back({value, height});
  sketch.add(bounds, figures::dashed(figures::ink::red, 1.2, "(10,7)"), bounds.empty() ? "" : "bounds of a change");
  return x;
}

/// Natural frequencies of a stage by their number, with the published ones.
figures::FigureRange add_modes(figures::Sketch& sketch, const ClaimPanel& panel, const Scorecard& card,
                               const std::vector<ClaimMode>& modes, const std::string& word_of_data) {
  Places computed;
  for (std::size_t k = 0; k < modes.size(); ++k)
    computed.push_back({static_cast<double>(k + 1), modes[k].frequency_Hz});
  Places data;
  for (const Condition* c : conditions_of(card)) {
    if (c->kind != ConditionKind::frequencies || c->stage != panel.stage) continue;
    const ModeMatch match = matched_modes(*c, modes);
    for (std::size_t k = 0; k < std::min(match.modes.size(), match.published.size()); ++k)
      data.push_back({static_cast<double>(match.modes[k] + 1), match.published[k]});
  }
  figures::FigureRange x;
  x.include(0.5);
  x.include(static_cast<double>(modes.size()) + 0.5);
  figures::FigureRange y;
  for (const Places& places : {computed, data})
    for (const auto& place : places) y.include(place[1]);
  (void)add_panel(sketch, panel, "f / Hz", y, x);
  sketch.add(computed, figures::dots(figures::ink::blue, 0.8), "computed");
  sketch.add(data, style_of_data(), data.empty() ? "" : word_of_data);
  return x;
}

}  // namespace

std::vector<DrawnFigure> draw_claim_figures(const std::filesystem::path& folder, const Scorecard& card,
                                            const ClaimRecord& record, const std::string& title,
                                            const SweepPoints& points) {
  std::vector<DrawnFigure> drawn;
  for (const ClaimFigure& figure : card.options.figures) {
    figures::Sketch sketch(figure.name);
    const auto is_diagram = [](const ClaimPanel& panel) { return panel.stage.empty() && panel.quantity.empty(); };
    if (!std::ranges::all_of(figure.panels, is_diagram))
      sketch.command("set style textbox opaque noborder fillcolor '#ffffff' margins 0.4,0.4");
    figures::FigureRange x;
    std::string abscissa;
    for (const ClaimPanel& panel : figure.panels) {
      figures::FigureRange of;
      if (!panel.stage.empty()) {
        of = add_modes(sketch, panel, card, record.at(panel.stage).modes, figure.data);
        abscissa = "number of the natural frequency";
      } else {
        of = panel.quantity.empty() ? add_diagram(sketch, panel, card, points)
                                    : add_curve(sketch, panel, card, record.at(panel.sweep),
                                                ordinate_of(figure, panel.quantity, card, record), figure.data);
        abscissa = parameter_label(std::ranges::find(card.options.sweeps, panel.sweep, &ClaimSweep::name)->axis.name);
      }
      x.include(of.low);
      x.include(of.high);
    }
    constexpr double edge = 0.01;  // the frame would hide half of the first dots and of the last
    constexpr int height_alone = 1100;
    constexpr int height_each = 620;
    const figures::FigureCanvas canvas{
        1800, figure.panels.size() == 1 ? height_alone : height_each * static_cast<int>(figure.panels.size())};
    const std::string words = figures::verbatim_text(figure.title.empty() ? title : figure.title + ": " + title);
    drawn.push_back(
        {folder / (figure.name + ".png"), sketch.draw(folder, {words, abscissa, ""}, x.widened(edge), {}, {}, canvas)});
  }
  return drawn;
}

}  // namespace epicyclic::claims
