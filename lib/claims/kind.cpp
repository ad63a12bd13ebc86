#include "claims/kind.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "claims/inputs.hpp"
#include "core/errors.hpp"
#include "core/json_pointer.hpp"
#include "input/given_speeds.hpp"
#include "input/pointers.hpp"
#include "input/study_model.hpp"
#include "store/stage_columns.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::claims {

using input::LoadedInput;

const ClaimsOptions& claims_in(const input::Study& study) { return study.plan.as<ClaimsOptions>(); }

ClaimsOptions& claims_in(input::Study& study) { return study.plan.as<ClaimsOptions>(); }

namespace {

void name_speeds(input::Study& study) {
  for (ClaimSweep& sweep : claims_in(study).sweeps) input::name_speed(sweep.axis.name);
}

/// A pair of gears has no ring's mesh and no shares of planets.
void check_of_pair(const ClaimsOptions& claims, input::ReadContext& context) {
  const auto refuse = [&](const std::string& place, const std::string& what) {
    context.add(input::Finding::Kind::rule, "/study" + place,
                "is \"" + what + "\", which a pair of gears does not have");
  };
  for (std::size_t k = 0; k < claims.claims.size(); ++k)
    for (const auto& [conditions, key] : {std::pair(&claims.claims[k].conditions, "/conditions/"),
                                          std::pair(&claims.claims[k].as_printed, "/as_printed/")})
      for (std::size_t j = 0; j < conditions->size(); ++j) {
        const Condition& c = (*conditions)[j];
        const std::string place = "/claims/" + std::to_string(k) + key + std::to_string(j);
        if (!store::is_of_pair(c.quantity)) refuse(place + "/quantity", c.quantity);
        if (c.kind == ConditionKind::agreement) refuse(place + "/kind", "agreement");
      }
  for (std::size_t k = 0; k < claims.figures.size(); ++k)
    for (std::size_t j = 0; j < claims.figures[k].panels.size(); ++j) {
      const ClaimPanel& panel = claims.figures[k].panels[j];
      const std::string place = "/figures/" + std::to_string(k) + "/panels/" + std::to_string(j);
      if (panel.mesh == MeshSide::ring_planet) refuse(place + "/mesh", "ring_planet");
      if (!store::is_of_pair(panel.quantity)) refuse(place + "/quantity", panel.quantity);
    }
}

/// Rules of the options themselves, and names of parameters.
void check(const input::Study& study, const input::IsBad& is_bad, input::ReadContext& context) {
  using input::Finding;
  if (is_bad("/study")) return;
  const ClaimsOptions& claims = claims_in(study);
  for (auto& [place, message] : claims.problems())
    if (!is_bad("/study" + place)) context.add(Finding::Kind::rule, "/study" + place, std::move(message));
  const studies::RecordingOptions& recording = claims.recording;
  if (recording.transient == studies::Transient::adaptive && recording.classification_periods == 0)
    context.add(Finding::Kind::rule, "/study/classification_periods", "is 0, must be >= 1 for an adaptive transient");
  const auto check_set = [&](const SetValue& set, const std::string& at) {
    if (set.value.has_value() != set.same_as.empty())
      context.add(Finding::Kind::rule, at, "must have \"value\" or \"same_as\", and not both");
    if (std::string why = input::why_no_parameter(set.parameter); !why.empty())
      context.add(Finding::Kind::rule, at + "/parameter", std::move(why));
  };
  for (std::size_t k = 0; k < claims.stages.size(); ++k)
    for (std::size_t j = 0; j < claims.stages[k].at.size(); ++j) {
      const std::string at = "/study/stages/" + std::to_string(k) + "/at/" + std::to_string(j);
      const std::string& parameter = claims.stages[k].at[j].parameter;
      check_set(claims.stages[k].at[j], at);
      if (!is_bad(at + "/parameter") && !parameter.starts_with("/stage/"))
        context.add(Finding::Kind::rule, at + "/parameter",
                    "is \"" + parameter + "\", must be a JSON pointer to a number of the stage: \"/stage/...\"");
    }
  if (study.stage.is_pair()) check_of_pair(claims, context);
  for (std::size_t k = 0; k < claims.sweeps.size(); ++k) {
    const ClaimSweep& sweep = claims.sweeps[k];
    const std::string place = "/study/sweeps/" + std::to_string(k);
    if (!is_bad(place + "/parameter")) input::check_named_parameter(sweep.axis, place, is_bad, context, false);
    if (std::string why = input::why_no_parameter(sweep.axis.name); !why.empty())
      context.add(Finding::Kind::rule, place + "/parameter", std::move(why));
    for (std::size_t j = 0; j < sweep.at.size(); ++j) {
      const SetValue& set = sweep.at[j];
      const std::string at = place + "/at/" + std::to_string(j);
      if (!is_bad(at + "/parameter") && set.value)
        input::check_named_parameter(studies::Axis{set.parameter, *set.value, *set.value, 1}, at, is_bad, context,
                                     false);
      check_set(set, at);
      input::check_different(sweep.axis.name, set.parameter, at + "/parameter", context);
      for (std::size_t before = 0; before < j; ++before)
        input::check_different(sweep.at[before].parameter, set.parameter, at + "/parameter", context);
    }
  }
}

/// Numbers that sweeps and parameters of claims write at pointers, each alone with the rest of the input.
void check_values(const LoadedInput& input, const std::function<void(const std::string&, std::string)>& refuse) {
  const ClaimsOptions& claims = claims_in(input.study);
  const auto check = [&](const std::string& pointer, double value, const std::string& place) {
    if (pointer.empty() || pointer.front() != '/') return;
    try {
      (void)input.with_value(pointer, value);
    } catch (const input::InputProblems& wrong) {
      for (const input::Problem& problem : wrong.problems())
        refuse(place, "takes the value " + input::number_text(value) + " at " + pointer + ", with which " +
                          problem.pointer + " " + problem.message);
    }
  };
  for (std::size_t k = 0; k < claims.sweeps.size(); ++k) {
    const ClaimSweep& sweep = claims.sweeps[k];
    if (!sweep.sets.empty()) continue;  // of another input: checked when its models are made
    const std::string place = "/study/sweeps/" + std::to_string(k);
    check(sweep.axis.name, sweep.axis.from, place + "/from");
    check(sweep.axis.name, sweep.axis.to, place + "/to");
    for (std::size_t j = 0; j < sweep.at.size(); ++j) {
      const SetValue& set = sweep.at[j];
      const std::string at = place + "/at/" + std::to_string(j);
      // It is taken of the input as it is given, once for the whole sweep.
      const auto is_of = [&set](const std::string& parameter) {
        const studies::NamedParameter* named = studies::find_parameter(parameter);
        const std::vector<std::string> pointers = named != nullptr ? named->pointers : std::vector{parameter};
        return !set.same_as.empty() && std::ranges::any_of(pointers, [&set](const std::string& pointer) {
          return pointer_within(set.same_as, pointer) || pointer_within(pointer, set.same_as);
        });
      };
      if (is_of(sweep.axis.name))
        refuse(at + "/same_as", "is \"" + set.same_as + "\", which the sweep varies: it is not followed along it");
      for (std::size_t other = 0; other < sweep.at.size(); ++other)
        if (other != j && is_of(sweep.at[other].parameter))
          refuse(at + "/same_as", "is \"" + set.same_as + "\", which /at/" + std::to_string(other) +
                                      " sets: it would be as it is in the input; set it to that value, too");
      // A candidate would have another number than the given stage.
      if (!set.same_as.empty() && input::find_at(input.computed, set.same_as) != nullptr)
        refuse(at + "/same_as",
               "is \"" + set.same_as + "\", which is computed from other numbers: it cannot be followed");
      else if (const auto value = number_to_set(input, {}, set))
        check(set.parameter, *value, at + (set.value ? "/value" : "/same_as"));
      else
        refuse(at + "/same_as", "is \"" + set.same_as + "\", which is no number of the resolved input");
    }
  }
  for (std::size_t k = 0; k < claims.stages.size(); ++k) {
    if (!claims.stages[k].sets.empty()) continue;  // likewise
    const std::string place = "/study/stages/" + std::to_string(k) + "/at";
    try {
      (void)modes_of(input, claims.stages[k]);
    } catch (const input::InputProblems& wrong) {
      for (const input::Problem& problem : wrong.problems())
        refuse(place, "makes a stage with which " + problem.pointer + " " + problem.message);
    } catch (const InputError& wrong) {
      refuse(place, wrong.what());
    }
  }
  for (std::size_t k = 0; k < claims.space.parameters.size(); ++k) {
    const FreeParameter& p = claims.space.parameters[k];
    if (!p.choice.empty()) continue;  // with that option in place: checked when candidates are made
    for (std::size_t t = 0; t < p.targets.size(); ++t) {
      const ParameterTarget& target = p.targets[t];
      const std::string place = "/study/parameters/" + std::to_string(k) + "/targets/" + std::to_string(t);
      if (!target.times.empty()) continue;
      for (const double x : {p.from, p.to})
        check(target.pointer, target.factor * std::pow(x, target.power), place + "/pointer");
    }
  }
}

/// Do candidates have a width of the clearance of their own?
bool smoothed_by_a_parameter(const ParameterSpace& space) {
  return std::ranges::any_of(space.parameters, [](const FreeParameter& p) {
    return p.choice.empty() && std::ranges::any_of(p.targets, [](const ParameterTarget& target) {
             return target.pointer == "/integrator/clearance_smoothing";
           });
  });
}

/// For options of choices that make damping jump while the input's does not: no such candidate can be classified as
/// chaotic.
void warn_of_options(std::vector<gear::Warning>& out, const LoadedInput& input, const ParameterSpace& space) {
  for (std::size_t c = 0; c < space.choices.size(); ++c)
    for (std::size_t o = 0; o < space.choices[c].options.size(); ++o) {
      nlohmann::json changed = {{"model", input.resolved.at("model")}, {"integrator", input.resolved.at("integrator")}};
      for (const OptionSet& set : space.choices[c].options[o].sets)
        (void)input::assign(changed, set.pointer,
                            nlohmann::json::parse(set.value));  // what is wrong is refused elsewhere
      if (input::damping_jumps(changed))
        out.push_back(input::without_tangents("/study/choices/" + std::to_string(c) + "/options/" + std::to_string(o)));
    }
}

void warn(std::vector<gear::Warning>& out, const LoadedInput& input) {
  const ParameterSpace& space = claims_in(input.study).space;
  if (smoothed_by_a_parameter(space)) return;
  if (input::damping_jumps(input.resolved))
    out.push_back(input::without_tangents("/model/gap_damping"));
  else
    warn_of_options(out, input, space);
}

}  // namespace

const input::StudyKind& claims_kind() {
  static const input::StudyKind kind = {
      .name = "claims",
      .commands = "`epicyclic reproduce`, `calibrate` or `robustness`",
      .table = &claims_table,
      .defaults = ClaimsOptions{},
      .recording = [](std::any& options) -> studies::RecordingOptions& {
        return std::any_cast<ClaimsOptions&>(options).recording;
      },
      .name_speeds = &name_speeds,
      .at_given_speed = false,
      .moves = [](const std::any& options) { return !std::any_cast<const ClaimsOptions&>(options).sweeps.empty(); },
      .check = &check,
      .check_values = &check_values,
      .warn = &warn,
  };
  return kind;
}

}  // namespace epicyclic::claims
