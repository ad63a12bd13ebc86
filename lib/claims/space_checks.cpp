// Whether each free parameter and each choice could decide something.

#include <algorithm>
#include <string>
#include <utility>

#include "claims/option_checks.hpp"
#include "core/json_pointer.hpp"
#include "core/text.hpp"

namespace epicyclic::claims {

namespace {

/// Numbers of the study that are no part of the stage and its motion cannot be set.
bool can_be_set(const std::string& pointer) {
  for (const char* root : {"/stage/", "/model/", "/operation/", "/integrator/clearance_smoothing"})
    if (pointer.starts_with(root)) return true;
  return pointer == "/stage" || pointer == "/model" || pointer == "/operation";
}

const char* const what_can_be_set = "must begin with /stage, /model or /operation: the rest is no matter of the stage";

/// Is one of them the other, or within it?
bool overlap(const std::string& a, const std::string& b) { return pointer_within(a, b) || pointer_within(b, a); }

bool is_same_option(const ChoiceOption& a, const ChoiceOption& b) {
  return std::ranges::equal(a.sets, b.sets, [](const OptionSet& s, const OptionSet& t) {
    return s.pointer == t.pointer && s.value == t.value;
  });
}

/// Whether each choice decides something.
void check_choices(ProblemList& problems, const ParameterSpace& space) {
  for (std::size_t k = 0; k < space.choices.size(); ++k) {
    const Choice& choice = space.choices[k];
    const std::string place = "/choices/" + std::to_string(k);
    for (std::size_t o = 0; o < choice.options.size(); ++o) {
      const ChoiceOption& option = choice.options[o];
      const std::string at = place + "/options/" + std::to_string(o);
      for (std::size_t other = 0; other < o; ++other)
        if (is_same_option(choice.options[other], option))
          problems.refuse(at + "/sets", "are those of \"" + choice.options[other].name + "\": nothing is chosen");
      for (std::size_t t = 0; t < option.sets.size(); ++t) {
        const std::string& pointer = option.sets[t].pointer;
        const std::string set_at = at + "/sets/" + std::to_string(t) + "/pointer";
        for (std::size_t other = 0; other < k; ++other)
          for (const ChoiceOption& before : space.choices[other].options)
            if (std::ranges::any_of(before.sets, [&](const OptionSet& s) { return overlap(s.pointer, pointer); }))
              problems.refuse(set_at, "is \"" + pointer + "\", which \"" + before.name + "\" of \"" +
                                          space.choices[other].name + "\" sets: the one would undo the other");
        // A parameter of another option, or of this one alone, does not undo what the others set.
        for (const FreeParameter& p : space.parameters)
          if (p.choice != choice.name && std::ranges::any_of(p.targets, [&](const ParameterTarget& target) {
                return overlap(target.pointer, pointer);
              }))
            problems.refuse(set_at,
                            "is \"" + pointer + "\", which the parameter \"" + p.name + "\" gives whatever is chosen");
      }
    }
  }
}

}  // namespace

void check_space(ProblemList& problems, const ParameterSpace& space) {
  const Names parameters = problems.names(space.parameters, "/parameters");
  const Names choices = problems.names(space.choices, "/choices");
  check_choices(problems, space);
  for (std::size_t k = 0; k < space.choices.size(); ++k)
    if (parameters.contains(space.choices[k].name))
      problems.refuse("/choices/" + std::to_string(k) + "/name",
                      "is \"" + space.choices[k].name + "\", as a parameter");
  // Names head columns beside others.
  const auto is_taken = [](const std::string& name) {
    for (const char* taken :
         {"phase", "number", "cost", "stopped_early", "claims_met", "draw", "valid", "variable", "value"})
      if (name == taken) return true;
    return name.starts_with("cost_") || name.starts_with("holds_");
  };
  for (const auto& [list, place] : {std::pair(&parameters, "/parameters"), std::pair(&choices, "/choices")})
    for (const std::string& name : *list)
      if (is_taken(name)) problems.refuse(place, "have one called \"" + name + "\", as a column of their tables is");
  for (std::size_t k = 0; k < space.choices.size(); ++k) {
    const Choice& choice = space.choices[k];
    const std::string place = "/choices/" + std::to_string(k);
    (void)problems.names(choice.options, place + "/options");
    for (std::size_t o = 0; o < choice.options.size(); ++o)
      for (std::size_t t = 0; t < choice.options[o].sets.size(); ++t)
        if (!can_be_set(choice.options[o].sets[t].pointer))
          problems.refuse(place + "/options/" + std::to_string(o) + "/sets/" + std::to_string(t) + "/pointer",
                          "is \"" + choice.options[o].sets[t].pointer + "\", " + what_can_be_set);
    if (choice.options.size() < 2) problems.refuse(place + "/options", "must be two at least");
  }
  for (std::size_t k = 0; k < space.parameters.size(); ++k) {
    const FreeParameter& p = space.parameters[k];
    const std::string place = "/parameters/" + std::to_string(k);
    if (!(p.from < p.to))
      problems.refuse(place + "/from", "is " + short_text(p.from, 17) + ", must be < to = " + short_text(p.to, 17));
    if (p.scale == ParameterScale::logarithmic && !(p.from > 0.0))
      problems.refuse(place + "/from", "is " + short_text(p.from, 17) + ", must be > 0 on a logarithmic scale");
    const auto multiplies = [&](const FreeParameter& other) {
      return std::ranges::any_of(other.targets, [&](const ParameterTarget& t) { return t.times == p.name; });
    };
    if (p.targets.empty() && std::ranges::none_of(space.parameters, multiplies))
      problems.refuse(place + "/targets",
                      "is empty, and no other parameter is multiplied by it: it would change nothing");
    for (std::size_t t = 0; t < p.targets.size(); ++t) {
      const std::string& times = p.targets[t].times;
      const std::string at = place + "/targets/" + std::to_string(t) + "/times";
      if (!times.empty() && !parameters.contains(times))
        problems.refuse(at, "is \"" + times + "\", which is no parameter of the study");
      if (!times.empty() && times == p.name) problems.refuse(at, "is the parameter itself; \"power\" is for that");
      const auto factor = std::ranges::find(space.parameters, times, &FreeParameter::name);
      if (factor != space.parameters.end() && !factor->choice.empty() &&
          (factor->choice != p.choice || factor->option != p.option))
        problems.refuse(at, "is \"" + times + "\", which counts where \"" + factor->choice + "\" is \"" +
                                factor->option + "\" alone: bind \"" + p.name + "\" to that option, too");
    }
    for (std::size_t t = 0; t < p.targets.size(); ++t) {
      const ParameterTarget& target = p.targets[t];
      const std::string at = place + "/targets/" + std::to_string(t);
      if (!can_be_set(target.pointer))
        problems.refuse(at + "/pointer", "is \"" + target.pointer + "\", " + what_can_be_set);
      if (target.power == 0.0) problems.refuse(at + "/power", "is 0: the parameter would change nothing");
      if (target.factor == 0.0) problems.refuse(at + "/factor", "is 0: the parameter would change nothing");
      for (std::size_t other = 0; other <= k; ++other) {
        const FreeParameter& q = space.parameters[other];
        const bool never_together = !p.choice.empty() && p.choice == q.choice && p.option != q.option;
        for (std::size_t u = 0; u < (other == k ? t : q.targets.size()); ++u)
          if (!never_together && q.targets[u].pointer == target.pointer)
            problems.refuse(at + "/pointer", "is \"" + target.pointer + "\", which \"" + q.name + "\" gives already");
      }
    }
    if (p.choice.empty() != p.option.empty()) problems.refuse(place + "/choice", "and \"option\" stand together");
    if (p.choice.empty()) continue;
    const auto choice = std::ranges::find(space.choices, p.choice, &Choice::name);
    if (choice == space.choices.end())
      problems.refuse(place + "/choice", "is \"" + p.choice + "\", which is no choice of the study");
    else if (std::ranges::find(choice->options, p.option, &ChoiceOption::name) == choice->options.end())
      problems.refuse(place + "/option", "is \"" + p.option + "\", which is no option of that choice");
  }
}

}  // namespace epicyclic::claims
