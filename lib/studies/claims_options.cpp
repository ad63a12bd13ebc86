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
  const bool bounded = of({share, count, value, variation});
  wants(c.at_least.has_value(), of({falls, jump, alike}), bounded || of({falls, jump, alike}), "at_least");
  wants(c.at_most.has_value(), false, bounded, "at_most");
  if (bounded && !c.at_least && !c.at_most)
    checks.refuse(place, "needs \"at_least\" or \"at_most\": it bounds nothing");
  if (c.at_least && c.at_most && !(*c.at_least <= *c.at_most))
    checks.refuse(place + "/at_least", "is " + short_text(*c.at_least, 17) + ", must be <= at_most");
  if (c.kind == falls && c.at_least && !(*c.at_least > 1.0)) checks.refuse(place + "/at_least", "must be > 1");
  if (c.kind == jump && c.at_least && !(*c.at_least > 0.0)) checks.refuse(place + "/at_least", "must be > 0");
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

void check_space(Checks& checks, const ParameterSpace& space) {
  const Names parameters = checks.names(space.parameters, "/parameters");
  (void)checks.names(space.choices, "/choices");
  for (std::size_t k = 0; k < space.choices.size(); ++k) {
    const Choice& choice = space.choices[k];
    const std::string place = "/choices/" + std::to_string(k);
    (void)checks.names(choice.options, place + "/options");
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

std::vector<std::pair<std::string, std::string>> ClaimsOptions::problems() const {
  Checks checks;
  const Names names = checks.names(sweeps, "/sweeps");
  if (sweeps.empty()) checks.refuse("/sweeps", "is empty: there is nothing to judge claims by");
  if (claims.empty()) checks.refuse("/claims", "is empty: there is nothing to judge");
  (void)checks.names(claims, "/claims");
  (void)checks.names(figures, "/figures");
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
    for (std::size_t c = 0; c < claims[k].conditions.size(); ++c)
      check_condition(checks, place + "/" + std::to_string(c), claims[k].conditions[c], names);
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
