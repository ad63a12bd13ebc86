#include "studies/claims_options.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "core/text.hpp"
#include "studies/claims.hpp"

namespace epicyclic::studies {

namespace {

/// Collects what is wrong.
class Checks {
 public:
  void refuse(const std::string& place, std::string message) { found_.emplace_back(place, std::move(message)); }

  /// Names of a list: there, and each once.
  template <class List>
  std::set<std::string, std::less<>> names(const List& list, const std::string& place) {
    std::set<std::string, std::less<>> all;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const std::string at = place + "/" + std::to_string(k) + "/name";
      if (list[k].name.empty())
        refuse(at, "is empty, must be a name");
      else if (!all.insert(list[k].name).second)
        refuse(at, "is \"" + list[k].name + "\", as one before it; names must differ");
    }
    return all;
  }

  [[nodiscard]] std::vector<std::pair<std::string, std::string>> found() && { return std::move(found_); }

 private:
  std::vector<std::pair<std::string, std::string>> found_;
};

using Names = std::set<std::string, std::less<>>;

std::string kind_name(ConditionKind kind) {
  for (const auto& [name, one] : condition_kinds)
    if (one == kind) return std::string(name);
  return {};
}

/// Files and folders are called so.
bool is_file_name(const std::string& name) {
  constexpr std::size_t longest = 64;
  return !name.empty() && name.size() <= longest && name.front() != '.' && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  });
}

void check_sweep_name(Checks& checks, const std::string& place, const std::string& name, const Names& sweeps) {
  if (!sweeps.contains(name)) checks.refuse(place, "is \"" + name + "\", which is no sweep of the study");
}

void check_condition(Checks& checks, const std::string& place, const Condition& c, const Names& sweeps) {
  using enum ConditionKind;
  const std::string kind = kind_name(c.kind);
  const auto of = [&](std::initializer_list<ConditionKind> kinds) {
    return std::ranges::find(kinds, c.kind) != kinds.end();
  };
  // A key that the kind does not read would be a condition that its writer believes in and nobody judges.
  const auto wants = [&](bool given, bool needed, bool allowed, const char* key) {
    if (needed && !given) checks.refuse(place + "/" + key, "is missing; a condition of kind \"" + kind + "\" needs it");
    if (given && !allowed) checks.refuse(place + "/" + key, "is not read by a condition of kind \"" + kind + "\"");
  };
  if (c.kind == decreasing) {
    wants(!c.sweep.empty(), false, false, "sweep");
    if (c.sweeps.size() < 2) checks.refuse(place + "/sweeps", "must name two sweeps at least");
    for (std::size_t k = 0; k < c.sweeps.size(); ++k)
      check_sweep_name(checks, place + "/sweeps/" + std::to_string(k), c.sweeps[k], sweeps);
  } else {
    wants(!c.sweeps.empty(), false, false, "sweeps");
    check_sweep_name(checks, place + "/sweep", c.sweep, sweeps);
  }
  wants(!c.motion.empty(), of({share, count, change}), of({share, count, change, value, jump, decreasing}), "motion");
  wants(!c.after.empty(), c.kind == change, c.kind == change, "after");
  wants(!c.leads_to.empty(), false, c.kind == change, "leads_to");
  wants(!c.motions.empty(), c.kind == sequence, c.kind == sequence, "motions");
  wants(!c.within.empty(), c.kind == change, c.kind == change, "within");
  wants(!c.quantity.empty(), of({value, falls, peaks, jump, decreasing}), of({value, falls, peaks, jump, decreasing}),
        "quantity");
  wants(!c.places.empty(), c.kind == peaks, c.kind == peaks, "places");
  wants(c.correlation.has_value(), false, c.kind == alike, "correlation");
  wants(c.which.has_value(), false, c.kind == change, "which");
  wants(c.statistic.has_value(), false, c.kind == value, "statistic");
  wants(c.place_tolerance.has_value(), false, c.kind == peaks, "place_tolerance");
  wants(c.prominence.has_value(), false, c.kind == peaks, "prominence");
  const bool bounded = of({share, count, value, variation});
  wants(c.at_least.has_value(), of({falls, jump, alike}), bounded || of({falls, jump, alike}), "at_least");
  wants(c.at_most.has_value(), false, bounded, "at_most");
  if (bounded && !c.at_least && !c.at_most)
    checks.refuse(place, "needs \"at_least\" or \"at_most\": it bounds nothing");
  if (c.at_least && c.at_most && !(*c.at_least <= *c.at_most))
    checks.refuse(place + "/at_least", "is " + short_text(*c.at_least, 17) + ", must be <= at_most");
  // Parts of 1; beyond them a condition would never hold, or always.
  if (of({share, alike, variation, jump})) {
    if (c.at_least && !(*c.at_least > 0.0 && *c.at_least <= 1.0))
      checks.refuse(place + "/at_least", "is " + short_text(*c.at_least, 17) + ", must be > 0 and <= 1: a part of 1");
    if (c.at_most && !(*c.at_most >= 0.0 && *c.at_most < 1.0))
      checks.refuse(place + "/at_most", "is " + short_text(*c.at_most, 17) + ", must be >= 0 and < 1: a part of 1");
  }
  if (c.kind == count) {
    if (c.at_least && !(*c.at_least > 0.0))
      checks.refuse(place + "/at_least", "is " + short_text(*c.at_least, 17) + ", must be > 0");
    if (c.at_most && !(*c.at_most >= 0.0))
      checks.refuse(place + "/at_most", "is " + short_text(*c.at_most, 17) + ", must be >= 0");
  }
  if (c.prominence && !(*c.prominence > 0.0))
    checks.refuse(place + "/prominence", "is 0, must be > 0: any point has it");
  if (!c.leads_to.empty() && c.leads_to == c.motion)
    checks.refuse(place + "/leads_to", "is the motion that is left, which is not met before it comes back");
  if (c.kind == falls && c.at_least && !(*c.at_least > 1.0)) checks.refuse(place + "/at_least", "must be > 1");
  if (c.from && c.to && !(*c.from <= *c.to))
    checks.refuse(place + "/from", "is " + short_text(*c.from, 17) + ", must be <= to = " + short_text(*c.to, 17));
  if (!c.within.empty() && (c.within.size() != 2 || !(c.within[0] < c.within[1])))
    checks.refuse(place + "/within", "must be two values, the first below the second");
  const auto word = [&](const std::string& text, const std::string& key) {
    if (!text.empty() && !is_motion_word(text))
      checks.refuse(place + "/" + key, "is \"" + text +
                                           "\", must be \"period N\", periodic, multi-period, quasiperiodic, chaotic, "
                                           "aperiodic, or \"not \" and one of these");
  };
  word(c.motion, "motion");
  word(c.after, "after");
  word(c.leads_to, "leads_to");
  for (std::size_t k = 0; k < c.motions.size(); ++k) word(c.motions[k], "motions/" + std::to_string(k));
}

/// What a condition wants of its sweep's grids: values in its part, and places and bounds among them.
void check_grids(Checks& checks, const std::string& place, const Condition& c, const ClaimSweep& sweep,
                 const ClaimsOptions& options) {
  using enum ConditionKind;
  const Axis& axis = sweep.axis;
  if (!(axis.from < axis.to)) return;
  const double from = std::max(axis.from, c.from.value_or(axis.from));
  const double to = std::min(axis.to, c.to.value_or(axis.to));
  const std::string range = short_text(from, 6) + " to " + short_text(to, 6);
  std::size_t needed = 1;
  if (c.kind == change || c.kind == jump || c.kind == variation) needed = 2;
  if (c.kind == peaks) needed = 3;
  if (c.kind == sequence) needed = c.motions.size();
  if (c.kind == count && c.at_least) needed = static_cast<std::size_t>(std::max(1.0, std::ceil(*c.at_least)));
  for (const auto& [points, key] : {std::pair(axis.points, "points"), std::pair(sweep.brief_points, "brief_points"),
                                    std::pair(sweep.survey_points, "survey_points")}) {
    Axis grid = axis;
    grid.points = std::min(points, axis.points);
    const std::vector<double> values = axis_values(grid);
    const auto there =
        static_cast<std::size_t>(std::ranges::count_if(values, [&](double v) { return v >= from && v <= to; }));
    if (there < needed)
      checks.refuse(place, "needs " + std::to_string(needed) + " points of \"" + sweep.name + "\" within " + range +
                               "; its grid of " + std::to_string(grid.points) + " (" + key + ") has " +
                               std::to_string(there));
  }
  if (c.within.size() == 2 && (c.within[1] < from || c.within[0] > to))
    checks.refuse(place + "/within", "lies outside the part that is looked at, " + range);
  for (std::size_t k = 0; k < c.places.size(); ++k)
    if (!(c.places[k] >= from && c.places[k] <= to && c.places[k] > 0.0))
      checks.refuse(place + "/places/" + std::to_string(k),
                    "is " + short_text(c.places[k], 17) + ", must be > 0 and within " + range);
  const auto check_period = [&](const std::string& word, const std::string& key) {
    const int period = motion_period(word);
    if (period > options.look.period_max)
      checks.refuse(place + "/" + key, "is \"" + word + "\", longer than period_max = " +
                                           std::to_string(options.look.period_max) + ": it is not looked for");
    else if (2 * period > options.brief.recorded_periods || 2 * period > options.survey.look.recorded_periods)
      checks.refuse(place + "/" + key, "is \"" + word + "\", which takes twice as many recorded_periods to be seen; " +
                                           "brief or survey look at fewer");
  };
  check_period(c.motion, "motion");
  check_period(c.after, "after");
  check_period(c.leads_to, "leads_to");
  for (std::size_t k = 0; k < c.motions.size(); ++k) check_period(c.motions[k], "motions/" + std::to_string(k));
  if (c.quantity == "lyapunov_max" && options.look.classification_periods == 0)
    checks.refuse(place + "/quantity", "is \"lyapunov_max\", which nobody computes with classification_periods = 0");
}

/// Numbers of the study that are no part of the stage and its motion cannot be set.
bool can_be_set(const std::string& pointer) {
  for (const char* root : {"/stage/", "/model/", "/operation/", "/integrator/clearance_smoothing"})
    if (pointer.starts_with(root)) return true;
  return pointer == "/stage" || pointer == "/model" || pointer == "/operation";
}

const char* const what_can_be_set = "must begin with /stage, /model or /operation: the rest is no matter of the stage";

void check_space(Checks& checks, const ParameterSpace& space) {
  const Names parameters = checks.names(space.parameters, "/parameters");
  const Names choices = checks.names(space.choices, "/choices");
  for (std::size_t k = 0; k < space.choices.size(); ++k)
    if (parameters.contains(space.choices[k].name))
      checks.refuse("/choices/" + std::to_string(k) + "/name", "is \"" + space.choices[k].name + "\", as a parameter");
  // Names head columns beside others.
  const auto is_taken = [](const std::string& name) {
    for (const char* taken :
         {"phase", "number", "cost", "given_up", "claims_met", "draw", "valid", "variable", "value"})
      if (name == taken) return true;
    return name.starts_with("cost_") || name.starts_with("holds_");
  };
  for (const auto& [list, place] : {std::pair(&parameters, "/parameters"), std::pair(&choices, "/choices")})
    for (const std::string& name : *list)
      if (is_taken(name)) checks.refuse(place, "have one called \"" + name + "\", as a column of their tables is");
  for (std::size_t k = 0; k < space.choices.size(); ++k) {
    const Choice& choice = space.choices[k];
    const std::string place = "/choices/" + std::to_string(k);
    (void)checks.names(choice.options, place + "/options");
    for (std::size_t o = 0; o < choice.options.size(); ++o)
      for (std::size_t t = 0; t < choice.options[o].sets.size(); ++t)
        if (!can_be_set(choice.options[o].sets[t].pointer))
          checks.refuse(place + "/options/" + std::to_string(o) + "/sets/" + std::to_string(t) + "/pointer",
                        "is \"" + choice.options[o].sets[t].pointer + "\", " + what_can_be_set);
    if (choice.options.size() < 2) checks.refuse(place + "/options", "must be two at least");
  }
  for (std::size_t k = 0; k < space.parameters.size(); ++k) {
    const FreeParameter& p = space.parameters[k];
    const std::string place = "/parameters/" + std::to_string(k);
    if (!(p.from < p.to))
      checks.refuse(place + "/from", "is " + short_text(p.from, 17) + ", must be < to = " + short_text(p.to, 17));
    if (p.spread == Spread::logarithmic && !(p.from > 0.0))
      checks.refuse(place + "/from", "is " + short_text(p.from, 17) + ", must be > 0 on a logarithmic scale");
    const auto multiplies = [&](const FreeParameter& other) {
      return std::ranges::any_of(other.targets, [&](const ParameterTarget& t) { return t.times == p.name; });
    };
    if (p.targets.empty() && std::ranges::none_of(space.parameters, multiplies))
      checks.refuse(place + "/targets",
                    "is empty, and no other parameter is multiplied by it: it would change nothing");
    for (std::size_t t = 0; t < p.targets.size(); ++t)
      if (!p.targets[t].times.empty() && !parameters.contains(p.targets[t].times))
        checks.refuse(place + "/targets/" + std::to_string(t) + "/times",
                      "is \"" + p.targets[t].times + "\", which is no parameter of the study");
    for (std::size_t t = 0; t < p.targets.size(); ++t) {
      const ParameterTarget& target = p.targets[t];
      const std::string at = place + "/targets/" + std::to_string(t);
      if (!can_be_set(target.pointer))
        checks.refuse(at + "/pointer", "is \"" + target.pointer + "\", " + what_can_be_set);
      if (target.power == 0.0) checks.refuse(at + "/power", "is 0: the parameter would change nothing");
      if (target.factor == 0.0) checks.refuse(at + "/factor", "is 0: the parameter would change nothing");
      for (std::size_t other = 0; other <= k; ++other) {
        const FreeParameter& q = space.parameters[other];
        const bool never_together = !p.choice.empty() && p.choice == q.choice && p.option != q.option;
        for (std::size_t u = 0; u < (other == k ? t : q.targets.size()); ++u)
          if (!never_together && q.targets[u].pointer == target.pointer)
            checks.refuse(at + "/pointer", "is \"" + target.pointer + "\", which \"" + q.name + "\" gives already");
      }
    }
    if (p.choice.empty() != p.option.empty()) checks.refuse(place + "/choice", "and \"option\" stand together");
    if (p.choice.empty()) continue;
    const auto choice = std::ranges::find(space.choices, p.choice, &Choice::name);
    if (choice == space.choices.end())
      checks.refuse(place + "/choice", "is \"" + p.choice + "\", which is no choice of the study");
    else if (std::ranges::find(choice->options, p.option, &ChoiceOption::name) == choice->options.end())
      checks.refuse(place + "/option", "is \"" + p.option + "\", which is no option of that choice");
  }
}

}  // namespace

SweepOptions ClaimsOptions::whole_sweep(const ClaimSweep& sweep, Start start) const {
  SweepOptions plan;
  plan.axis = sweep.axis;
  plan.directions = start == Start::cold ? std::vector{Direction::up} : sweep.directions;
  plan.start = start;
  plan.look = look;
  plan.look.keep = Keep::section;
  plan.look.recorded_periods = sweep.recorded_periods.value_or(look.recorded_periods);
  plan.segments = segments_of(plan);
  return plan;
}

std::vector<std::pair<std::string, std::string>> ClaimsOptions::problems() const {
  Checks checks;
  const Names names = checks.names(sweeps, "/sweeps");
  if (sweeps.empty()) checks.refuse("/sweeps", "is empty: there is nothing to judge claims by");
  if (claims.empty()) checks.refuse("/claims", "is empty: there is nothing to judge");
  (void)checks.names(claims, "/claims");
  (void)checks.names(figures, "/figures");
  for (std::size_t k = 0; k < sweeps.size(); ++k)
    if (sweeps[k].name.ends_with(".json"))
      checks.refuse("/sweeps/" + std::to_string(k) + "/name", "ends with .json, as inputs do");
  if (search.candidates < search.islands * search.population)
    checks.refuse("/search/candidates",
                  "is " + std::to_string(search.candidates) +
                      ", must be >= islands x population = " + std::to_string(search.islands * search.population));
  for (std::size_t k = 0; k < sweeps.size(); ++k)
    if (!(sweeps[k].axis.from < sweeps[k].axis.to))
      checks.refuse("/sweeps/" + std::to_string(k) + "/from",
                    "is " + short_text(sweeps[k].axis.from, 17) + ", must be < to = " +
                        short_text(sweeps[k].axis.to, 17) + "; to go downwards give \"directions\": [\"down\"]");
  for (std::size_t k = 0; k < sweeps.size(); ++k)
    if (!sweeps[k].name.empty() && !is_file_name(sweeps[k].name))
      checks.refuse(
          "/sweeps/" + std::to_string(k) + "/name",
          "is \"" + sweeps[k].name + "\", must be of letters, digits, '_', '-' and '.': a folder is called so");
  // Of cold starts a sweep's folder has its name with an ending.
  for (std::size_t k = 0; k < sweeps.size(); ++k)
    if (names.contains(sweeps[k].name + "_cold"))
      checks.refuse(
          "/sweeps/" + std::to_string(k) + "/name",
          "is \"" + sweeps[k].name + "\", and another \"" + sweeps[k].name + "_cold\", as its cold starts are called");
  for (std::size_t k = 0; k < claims.size(); ++k) {
    const std::string place = "/claims/" + std::to_string(k) + "/conditions";
    if (claims[k].conditions.empty()) checks.refuse(place, "is empty: the claim would always hold");
    for (std::size_t c = 0; c < claims[k].conditions.size(); ++c) {
      const Condition& condition = claims[k].conditions[c];
      const std::string at = place + "/" + std::to_string(c);
      check_condition(checks, at, condition, names);
      std::string parameter;
      for (std::size_t j = 0; j < condition.sweeps.size(); ++j) {
        const auto sweep = std::ranges::find(sweeps, condition.sweeps[j], &ClaimSweep::name);
        if (sweep == sweeps.end()) continue;
        if (std::ranges::count(condition.sweeps, condition.sweeps[j]) > 1)
          checks.refuse(at + "/sweeps/" + std::to_string(j), "is there twice: it does not fall from itself to itself");
        if (!parameter.empty() && sweep->axis.name != parameter)
          checks.refuse(at + "/sweeps/" + std::to_string(j), "is a sweep of another parameter than the first");
        if (parameter.empty()) parameter = sweep->axis.name;
      }
      const auto sweep = std::ranges::find(sweeps, condition.sweep, &ClaimSweep::name);
      if (sweep != sweeps.end() && condition.kind != ConditionKind::decreasing)
        check_grids(checks, at, condition, *sweep, *this);
    }
  }
  for (std::size_t k = 0; k < figures.size(); ++k) {
    const std::string place = "/figures/" + std::to_string(k);
    if (!figures[k].name.empty() && !is_file_name(figures[k].name))
      checks.refuse(place + "/name", "is \"" + figures[k].name + "\", must be of letters, digits, '_', '-' and '.'");
    if (figures[k].panels.empty()) checks.refuse(place + "/panels", "is empty");
    std::string parameter;
    for (std::size_t s = 0; s < figures[k].panels.size(); ++s) {
      const std::string at = place + "/panels/" + std::to_string(s) + "/sweep";
      const std::string& sweep = figures[k].panels[s].sweep;
      check_sweep_name(checks, at, sweep, names);
      const auto found = std::ranges::find(sweeps, sweep, &ClaimSweep::name);
      if (found == sweeps.end()) continue;
      if (!parameter.empty() && parameter != found->axis.name)
        checks.refuse(at, "is \"" + sweep + "\", a sweep of another parameter than that of the panel above");
      parameter = found->axis.name;
    }
  }
  if (starts.empty()) checks.refuse("/starts", "is empty");
  check_space(checks, space);
  return std::move(checks).found();
}

}  // namespace epicyclic::studies
