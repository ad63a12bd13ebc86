#include "claims/options.hpp"

#include <algorithm>

#include "claims/option_checks.hpp"
#include "core/text.hpp"

namespace epicyclic::claims {

using namespace studies;

namespace {

/// Files and folders are called so.
bool is_file_name(const std::string& name) {
  constexpr std::size_t longest = 64;
  return !name.empty() && name.size() <= longest && name.front() != '.' && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  });
}

}  // namespace

SweepOptions ClaimsOptions::whole_sweep(const ClaimSweep& sweep, Start start) const {
  SweepOptions plan;
  plan.axis = sweep.axis;
  plan.directions = start == Start::cold ? std::vector{Direction::up} : sweep.directions;
  plan.start = start;
  plan.recording = recording;
  plan.recording.keep = Keep::section;
  plan.recording.recorded_periods = sweep.recorded_periods.value_or(recording.recorded_periods);
  plan.segments = segments_of(plan);
  return plan;
}

bool ClaimsOptions::is_scored(Reading reading) const { return std::ranges::find(readings, reading) != readings.end(); }

bool ClaimsOptions::has_reading(Reading reading) const {
  return is_scored(reading) || (space.dimension() > 0 && (search.reading == reading || survey.reading == reading));
}

std::vector<std::pair<std::string, std::string>> ClaimsOptions::problems() const {
  ProblemList problems;
  const Names names = problems.names(sweeps, "/sweeps");
  const Names stage_names = problems.names(stages, "/stages");
  if (sweeps.empty() && stages.empty())
    problems.refuse("/sweeps", "is empty, and so is /stages: there is nothing to judge claims by");
  for (std::size_t k = 0; k < stages.size(); ++k)
    if (names.contains(stages[k].name))
      problems.refuse("/stages/" + std::to_string(k) + "/name", "is \"" + stages[k].name + "\", as a sweep");
  if (sweeps.empty() && space.dimension() > 0)
    problems.refuse("/sweeps", "is empty: a search or a survey has nothing to compute");
  if (claims.empty()) problems.refuse("/claims", "is empty: there is nothing to judge");
  (void)problems.names(claims, "/claims");
  (void)problems.names(figures, "/figures");
  for (std::size_t k = 0; k < sweeps.size(); ++k)
    if (sweeps[k].name.ends_with(".json"))
      problems.refuse("/sweeps/" + std::to_string(k) + "/name", "ends with .json, as inputs do");
  if (search.candidates < search.islands * search.population)
    problems.refuse("/search/candidates",
                    "is " + std::to_string(search.candidates) +
                        ", must be >= islands x population = " + std::to_string(search.islands * search.population));
  for (std::size_t k = 0; k < sweeps.size(); ++k)
    if (!(sweeps[k].axis.from < sweeps[k].axis.to))
      problems.refuse("/sweeps/" + std::to_string(k) + "/from",
                      "is " + short_text(sweeps[k].axis.from, 17) + ", must be < to = " +
                          short_text(sweeps[k].axis.to, 17) + "; to go downwards give \"directions\": [\"down\"]");
  for (std::size_t k = 0; k < sweeps.size(); ++k)
    if (!sweeps[k].name.empty() && !is_file_name(sweeps[k].name))
      problems.refuse(
          "/sweeps/" + std::to_string(k) + "/name",
          "is \"" + sweeps[k].name + "\", must be of letters, digits, '_', '-' and '.': a folder is called so");
  // Of cold starts a sweep's folder has its name with an ending.
  for (std::size_t k = 0; k < sweeps.size(); ++k)
    if (names.contains(sweeps[k].name + "_cold"))
      problems.refuse(
          "/sweeps/" + std::to_string(k) + "/name",
          "is \"" + sweeps[k].name + "\", and another \"" + sweeps[k].name + "_cold\", as its cold starts are called");
  for (std::size_t k = 0; k < claims.size(); ++k) {
    const std::string place = "/claims/" + std::to_string(k) + "/conditions";
    if (claims[k].conditions.empty()) problems.refuse(place, "is empty: the claim would always hold");
    const auto check_at = [&](const Condition& condition, const std::string& at) {
      check_condition(problems, at, condition, names, stage_names);
      std::string parameter;
      for (std::size_t j = 0; j < condition.sweeps.size(); ++j) {
        const auto sweep = std::ranges::find(sweeps, condition.sweeps[j], &ClaimSweep::name);
        if (sweep == sweeps.end()) continue;
        if (std::ranges::count(condition.sweeps, condition.sweeps[j]) > 1)
          problems.refuse(at + "/sweeps/" + std::to_string(j),
                          "is there twice: it does not fall from itself to itself");
        if (!parameter.empty() && sweep->axis.name != parameter)
          problems.refuse(at + "/sweeps/" + std::to_string(j), "is a sweep of another parameter than the first");
        if (parameter.empty()) parameter = sweep->axis.name;
      }
      check_grids(problems, at, condition, *this);
    };
    for (std::size_t c = 0; c < claims[k].conditions.size(); ++c)
      check_at(claims[k].conditions[c], place + "/" + std::to_string(c));
    for (std::size_t c = 0; c < claims[k].as_printed.size(); ++c)
      check_at(claims[k].as_printed[c], "/claims/" + std::to_string(k) + "/as_printed/" + std::to_string(c));
  }
  for (std::size_t k = 0; k < figures.size(); ++k) {
    const std::string place = "/figures/" + std::to_string(k);
    if (!figures[k].name.empty() && !is_file_name(figures[k].name))
      problems.refuse(place + "/name", "is \"" + figures[k].name + "\", must be of letters, digits, '_', '-' and '.'");
    if (figures[k].panels.empty()) problems.refuse(place + "/panels", "is empty");
    std::string parameter;
    for (std::size_t s = 0; s < figures[k].panels.size(); ++s) {
      const ClaimPanel& panel = figures[k].panels[s];
      const std::string of = place + "/panels/" + std::to_string(s);
      const std::string at = of + "/sweep";
      const std::string& sweep = panel.sweep;
      if (panel.stage.empty() != figures[k].panels.front().stage.empty())
        problems.refuse(of,
                        "is over another axis than the panel above: frequencies of stages have figures of their own");
      if (!panel.stage.empty()) {
        check_stage_name(problems, of + "/stage", panel.stage, stage_names);
        for (const auto& [given, key] : {std::pair(!sweep.empty(), "sweep"), {!panel.quantity.empty(), "quantity"}})
          if (given) problems.refuse(of + "/" + key, "is not read by a panel of a stage");
        continue;
      }
      check_sweep_name(problems, at, sweep, names);
      const auto found = std::ranges::find(sweeps, sweep, &ClaimSweep::name);
      if (found == sweeps.end()) continue;
      if (!parameter.empty() && parameter != found->axis.name)
        problems.refuse(at, "is \"" + sweep + "\", a sweep of another parameter than that of the panel above");
      parameter = found->axis.name;
    }
  }
  if (starts.empty()) problems.refuse("/starts", "is empty");
  if (readings.empty()) problems.refuse("/readings", "is empty");
  const auto check_recorded = [&](int recorded, int classified, bool is_printed, const std::string& place) {
    if (recorded < 2 && classified == 0)
      problems.refuse(place,
                      "is 1, must be >= 2 with classification_periods = 0: of one Poincare point nothing comes back");
    if (is_printed && recorded < 2 * printed.period_max)
      problems.refuse(place, "is " + std::to_string(recorded) +
                                 ", must be >= 2 printed/period_max = " + std::to_string(2 * printed.period_max) +
                                 ": fewer dots of a chaotic response are a period to a reader");
  };
  check_recorded(recording.recorded_periods, recording.classification_periods, is_scored(Reading::printed),
                 "/recorded_periods");
  if (space.dimension() > 0) {
    check_recorded(screening.recorded_periods, screening.classification_periods, search.reading == Reading::printed,
                   "/screening/recorded_periods");
    check_recorded(survey.recording.recorded_periods, survey.recording.classification_periods,
                   survey.reading == Reading::printed, "/survey/screening/recorded_periods");
  }
  for (std::size_t k = 0; k < sweeps.size(); ++k)
    if (sweeps[k].recorded_periods)
      check_recorded(*sweeps[k].recorded_periods, recording.classification_periods, is_scored(Reading::printed),
                     "/sweeps/" + std::to_string(k) + "/recorded_periods");
  check_space(problems, space);
  return std::move(problems).found();
}

}  // namespace epicyclic::claims
