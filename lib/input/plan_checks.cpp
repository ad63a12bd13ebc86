#include "input/plan_checks.hpp"

#include <algorithm>
#include <utility>

#include "input/pointers.hpp"
#include "input/speed_aliases.hpp"
#include "input/study_kind.hpp"
#include "model/dynamic_model.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::input {

std::string why_no_parameter(const std::string& pointer) {
  if (pointer_within(pointer, "/integrator") && pointer != "/integrator/clearance_smoothing")
    return "an option of the integrator is not a parameter of the model and cannot be swept";
  if (pointer_within(pointer, "/study/initial_state"))
    return "a component of the initial state is not a parameter of the model; `epicyclic basins` varies two of them";
  if (pointer == "/stage/planets/count") return "the number of planets changes the state itself and cannot be swept";
  return {};
}

void check_named_parameter(const studies::Axis& axis, const std::string& place, const IsBad& is_bad,
                           ReadContext& context, bool other_speeds) {
  if (axis.name.rfind('/', 0) == 0) return;
  const studies::NamedParameter* const parameter = studies::find_parameter(axis.name);
  if (parameter == nullptr) {
    std::vector<std::string> names;
    for (const auto& p : studies::named_parameters()) names.push_back(p.name);
    if (other_speeds)
      for (const SpeedAlias& alias : speed_aliases()) names.emplace_back(alias.key);
    context.add(Finding::Kind::range, place + "/parameter",
                "is \"" + axis.name + "\", must be one of: " + listed(names) +
                    ", or a JSON pointer to a number, such as /stage/lumped/planet/bearing_N_per_m" +
                    (nearest(axis.name, names).empty() ? suggested(meant_pointers(axis.name, context.places))
                                                       : suggestion(axis.name, names)));
    return;
  }
  const Bounds bounds = between(parameter->least, parameter->most);
  for (const auto& [key, value] : {std::pair("/from", axis.from), std::pair("/to", axis.to)}) {
    if (!bounds.contains(value) && !is_bad(place + key)) {
      context.add(Finding::Kind::range, place + key,
                  "is " + number_text(value) + ", must be " + bounds.text() + " for " + parameter->name + ", " +
                      parameter->description);
    }
  }
}

namespace {

/// Pointers of the input that a parameter sets.
std::vector<std::string> values_set_by(const std::string& parameter) {
  const studies::NamedParameter* named = studies::find_parameter(parameter);
  return named == nullptr ? std::vector{parameter} : named->pointers;
}

}  // namespace

void check_different(const std::string& first_name, const std::string& second_name, const std::string& place,
                     ReadContext& context) {
  const auto first = values_set_by(first_name);
  for (const auto& pointer : values_set_by(second_name))
    if (std::find(first.begin(), first.end(), pointer) != first.end()) {
      context.add(Finding::Kind::rule, place,
                  "is \"" + second_name + "\", which the first axis varies already, by \"" + first_name + "\"");
      return;
    }
}

void check_range(const studies::Axis& axis, const std::string& place, const IsBad& is_bad, const std::string& hint,
                 ReadContext& context) {
  if (is_bad(place + "/from") || is_bad(place + "/to")) return;
  if (axis.from > axis.to) {
    context.add(Finding::Kind::rule, place + "/from",
                "is " + number_text(axis.from) + ", must be <= to = " + number_text(axis.to) + hint);
  }
  if (axis.points == 1 && axis.from != axis.to) {
    context.add(Finding::Kind::rule, place + "/points",
                "is 1, must be >= 2 for the range from " + number_text(axis.from) + " to " + number_text(axis.to));
  }
}

std::vector<std::string> state_names(const gear::Stage& stage) {
  std::vector<std::string> names =
      model::coordinate_names(model::layout_of(stage, model::CoordinateChoice::relative), stage.planet_count);
  for (std::size_t k = 0, n = names.size(); k < n; ++k) names.push_back(names[k] + "_rate");
  return names;
}

std::string why_no_state(const std::vector<double>& state, const gear::Stage& stage) {
  if (state.empty() || stage.planet_count < 1 || stage.planet_count > gear::planets_max) return {};
  const std::size_t components = state_names(stage).size();
  if (state.size() == components) return {};
  return "has " + std::to_string(state.size()) + " numbers, must have " + std::to_string(components) +
         ", the state of this stage";
}

namespace {

/// Rules of a study of points that span its keys.
void check_points(const Study& study, ReadContext& context) {
  const studies::RecordingOptions& recording = study.recording();
  if (recording.transient == studies::Transient::adaptive && recording.classification_periods == 0) {
    context.add(Finding::Kind::rule, "/study/classification_periods",
                "is 0, must be >= 1 for an adaptive transient, which ends when the regime is classified; without it "
                "give \"transient\": \"fixed\"");
  }
}

}  // namespace

void check_sweep(const Study& study, const IsBad& is_bad, ReadContext& context) {
  const studies::SweepOptions sweep = study.sweep();
  check_range(sweep.axis, "/study", is_bad, "; to go downwards give \"directions\": [\"down\"]", context);
  if (!is_bad("/study/points") && sweep.segments > sweep.axis.points) {
    context.add(Finding::Kind::rule, "/study/segments",
                "is " + std::to_string(sweep.segments) + ", must be <= points = " + std::to_string(sweep.axis.points));
  }
  if (sweep.segments > 1 && sweep.start == studies::Start::cold) {
    context.add(Finding::Kind::rule, "/study/segments",
                "is " + std::to_string(sweep.segments) + ", but points that start cold are chains of their own");
  }
  if (!is_bad("/study/parameter")) check_named_parameter(sweep.axis, "/study", is_bad, context);
}

namespace {

/// Parameters of a ring, which a pair of gears does not have.
void check_of_pair(const Study& study, ReadContext& context) {
  if (!study.stage.is_pair()) return;
  for (const VariedParameter& varied : varied_parameters(study)) {
    const studies::NamedParameter* named = studies::find_parameter(varied.axis.name);
    if (named == nullptr) continue;
    if (std::ranges::all_of(named->pointers, [](const std::string& pointer) {
          return pointer_within(pointer, "/stage/lumped/ring_planet_mesh");
        }))
      context.add(Finding::Kind::rule, varied.place + "/parameter",
                  "is \"" + varied.axis.name + "\", but a pair of gears has no ring");
  }
}

}  // namespace

void check_plan(const Study& study, const IsBad& is_bad, ReadContext& context) {
  check_of_pair(study, context);
  if (study.has_points()) check_points(study, context);
  if (std::string why = why_no_state(study.initial_state, study.stage); !why.empty() && !is_bad("/study/initial_state"))
    context.add(Finding::Kind::rule, "/study/initial_state", std::move(why));
  if (const StudyKind* kind = study.plan.kind(); kind != nullptr && kind->check != nullptr)
    kind->check(study, is_bad, context);
}

}  // namespace epicyclic::input
