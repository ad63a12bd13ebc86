#include "claims/kind.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "claims/inputs.hpp"
#include "core/json_pointer.hpp"
#include "input/given_speeds.hpp"
#include "input/pointers.hpp"
#include "input/study_model.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::claims {

using input::LoadedInput;

const ClaimsOptions& claims_in(const input::Study& study) { return study.plan.as<ClaimsOptions>(); }

ClaimsOptions& claims_in(input::Study& study) { return study.plan.as<ClaimsOptions>(); }

namespace {

void name_speeds(input::Study& study) {
  for (ClaimSweep& sweep : claims_in(study).sweeps) input::name_speed(sweep.axis.name);
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
      if (set.value.has_value() != set.same_as.empty())
        context.add(Finding::Kind::rule, at, "must have \"value\" or \"same_as\", and not both");
      input::check_different(sweep.axis.name, set.parameter, at + "/parameter", context);
      for (std::size_t before = 0; before < j; ++before)
        input::check_different(sweep.at[before].parameter, set.parameter, at + "/parameter", context);
      if (std::string why = input::why_no_parameter(set.parameter); !why.empty())
        context.add(Finding::Kind::rule, at + "/parameter", std::move(why));
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
      // Of a candidate it would be another number than that of the stage as it is given.
      if (!set.same_as.empty() && input::find_at(input.computed, set.same_as) != nullptr)
        refuse(at + "/same_as",
               "is \"" + set.same_as + "\", which is computed from other numbers: it cannot be followed");
      else if (const auto value = number_to_set(input, {}, set))
        check(set.parameter, *value, at + (set.value ? "/value" : "/same_as"));
      else
        refuse(at + "/same_as", "is \"" + set.same_as + "\", which is no number of the resolved input");
    }
  }
  for (std::size_t k = 0; k < claims.space.parameters.size(); ++k) {
    const FreeParameter& p = claims.space.parameters[k];
    if (!p.choice.empty()) continue;  // with that option in place: looked at when candidates are made
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

/// On options of choices that make damping jump where the input does not: no candidate with one can be told chaotic.
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
      .check = &check,
      .check_values = &check_values,
      .warn = &warn,
  };
  return kind;
}

}  // namespace epicyclic::claims
