#include "claims/inputs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "claims/kind.hpp"
#include "core/errors.hpp"
#include "input/derived_study.hpp"
#include "input/given_speeds.hpp"
#include "input/study_model.hpp"
#include "kinds/list.hpp"
#include "model/modes.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::claims {

using input::Assignment;
using input::LoadedInput;
using input::PointerValue;
using nlohmann::json;

namespace {

/// The number at a pointer, if there is one.
std::optional<double> number_at(const LoadedInput& input, const std::string& pointer) {
  if (pointer == input::speed_pointer) return input.study.mesh_frequency_ratio;  // of another speed, if one is given
  const json* there = input.value_at(pointer);
  return there != nullptr && there->is_number() ? std::optional(there->get<double>()) : std::nullopt;
}

enum class Numbers { the_same, any };

/// Has the input the value that an option sets? For an object: the same keys.
/// @param numbers  of an object: those that the option has, or any
bool is_set(const LoadedInput& input, const OptionSet& set, Numbers numbers) {
  const json* at = input.value_at(set.pointer);
  const json value = json::parse(set.value);
  if (at == nullptr) return value.is_null();
  if (!value.is_object()) return *at == value;
  if (!at->is_object()) return false;
  return std::ranges::all_of(value.items(), [&](const auto& item) {
    const auto there = at->find(item.key());
    return there != at->end() &&
           (item.value() == *there || (numbers == Numbers::any && item.value().is_number() && there->is_number()));
  });
}

/// The option that the input has: one with its numbers, or else one whose numbers alone are others.
std::optional<std::size_t> option_of(const LoadedInput& input, const Choice& choice) {
  for (const Numbers numbers : {Numbers::the_same, Numbers::any})
    for (std::size_t k = 0; k < choice.options.size(); ++k)
      if (std::ranges::all_of(choice.options[k].sets,
                              [&](const OptionSet& set) { return is_set(input, set, numbers); }))
        return k;
  return std::nullopt;
}

std::vector<Assignment> assignments_of(const std::vector<OptionSet>& sets) {
  std::vector<Assignment> all;
  for (const OptionSet& set : sets) all.push_back({set.pointer, json::parse(set.value), set.pointer + "=" + set.value});
  return all;
}

/// Values that options of choices put into the input, one option of each choice.
std::vector<Assignment> option_assignments(const ParameterSpace& space, const std::vector<std::size_t>& options) {
  std::vector<Assignment> sets;
  for (std::size_t k = 0; k < options.size(); ++k)
    std::ranges::move(assignments_of(space.choices[k].options[options[k]].sets), std::back_inserter(sets));
  return sets;
}

/// A candidate as values of the input, in place of those there.
std::vector<Assignment> candidate_assignments(const ParameterSpace& space, std::span<const double> u) {
  std::vector<Assignment> sets = option_assignments(space, space.options_at(u));
  for (const auto& [pointer, value] : space.targets_at(u))
    sets.push_back({pointer, value, pointer + "=" + input::number_text(value)});
  return sets;
}

/// The value of a parameter in the input: from its first target without a multiplier. Else it is from its first target,
/// divided by the value of the multiplying parameter. A parameter without targets is found from the first parameter
/// that it multiplies, if that one also has a target without a multiplier, else it is 1. Nothing if the input has no
/// such number.
std::optional<double> given_parameter(const LoadedInput& input, const ParameterSpace& space, const FreeParameter& p) {
  const auto plain_target = [](const FreeParameter& of) {
    return std::ranges::find_if(of.targets, [](const auto& t) { return t.times.empty(); });
  };
  if (p.targets.empty()) {
    for (const FreeParameter& q : space.parameters)
      for (const ParameterTarget& target : q.targets) {
        if (target.times != p.name || plain_target(q) == q.targets.end()) continue;
        const std::optional<double> multiplied = given_parameter(input, space, q);
        const std::optional<double> there = number_at(input, target.pointer);
        if (!there || !multiplied) return std::nullopt;
        const double x = *there / (target.factor * std::pow(*multiplied, target.power));
        return std::isfinite(x) ? std::optional(x) : std::nullopt;
      }
    return 1.0;
  }
  const auto plain = plain_target(p);
  const ParameterTarget& target = plain == p.targets.end() ? p.targets.front() : *plain;
  const std::optional<double> there = number_at(input, target.pointer);
  if (!there) return std::nullopt;
  double product = 1.0;
  if (plain == p.targets.end()) {
    const auto other = std::ranges::find(space.parameters, target.times, &FreeParameter::name);
    // If the multiplying parameter is itself given by a product, it counts as 1.
    const bool is_plain =
        other != space.parameters.end() && !other->targets.empty() && plain_target(*other) != other->targets.end();
    if (is_plain) product = given_parameter(input, space, *other).value_or(1.0);
  }
  const double x = std::pow(*there / (target.factor * product), 1.0 / target.power);
  return std::isfinite(x) ? std::optional(x) : std::nullopt;
}

/// Numbers of the input that differ from the candidate's: three errors that one amplitude sets, say, or values of an
/// option.
/// @param outside  parameters that count and whose targets differ anyway
std::vector<std::string> other_targets(const LoadedInput& input, const ParameterSpace& space, std::span<const double> u,
                                       const std::set<std::string>& outside) {
  constexpr double rounding = 1e-9;
  std::vector<std::string> moved;
  std::set<std::string> known;
  const auto add_moved = [&](const std::string& pointer, double value) {
    const std::optional<double> there = number_at(input, pointer);
    if (there && known.insert(pointer).second && std::abs(value - *there) > rounding * std::abs(*there))
      moved.push_back(pointer + " = " + input::number_text(value) + " in place of " + input::number_text(*there));
  };
  const std::vector<std::size_t> options = space.options_at(u);
  for (const FreeParameter& p : space.parameters)
    for (const ParameterTarget& t : p.targets)
      if (space.counts(p, options) && (outside.contains(p.name) || outside.contains(t.times))) known.insert(t.pointer);
  for (const auto& [pointer, value] : space.targets_at(u)) add_moved(pointer, value);
  // Numbers of an option that no parameter sets.
  for (std::size_t k = 0; k < options.size(); ++k)
    for (const OptionSet& set : space.choices[k].options[options[k]].sets)
      if (const json value = json::parse(set.value); value.is_object())
        for (const auto& [key, item] : value.items())
          if (item.is_number()) add_moved(set.pointer + "/" + key, item.get<double>());
  return moved;
}

}  // namespace

GivenCandidate given_candidate(const LoadedInput& input, const ParameterSpace& space) {
  GivenCandidate given;
  std::vector<std::optional<double>> values;
  for (const FreeParameter& p : space.parameters) {
    const std::optional<double> x = values.emplace_back(given_parameter(input, space, p));
    given.u.push_back(x ? p.place_of(*x) : 0.5);
  }
  for (const Choice& choice : space.choices) {
    const std::optional<std::size_t> chosen = option_of(input, choice);
    given.u.push_back(choice.place_of(chosen.value_or(0)));
    if (!chosen)
      given.moved.push_back(choice.name + " = \"" + choice.options.front().name + "\", of whose options it has none");
  }
  std::set<std::string> outside;  // parameters that count, and that the input has beyond their ranges
  const std::vector<std::size_t> options = space.options_at(given.u);
  for (std::size_t k = 0; k < space.parameters.size(); ++k) {
    const FreeParameter& p = space.parameters[k];
    const std::optional<double>& x = values[k];
    if (!space.counts(p, options) || !x || (*x >= p.from && *x <= p.to)) continue;
    outside.insert(p.name);
    given.moved.push_back(p.name + " = " + input::number_text(p.at(given.u[k])) + " in place of " +
                          input::number_text(*x));
  }
  std::ranges::move(other_targets(input, space, given.u, outside), std::back_inserter(given.moved));
  return given;
}

namespace {

/// A resolved input with an origin for each of these values.
json with_origins(json resolved, std::span<const Assignment> values, const std::string& origin) {
  // Of an element of an array the whole array has one origin.
  const auto place_of = [&](const Assignment& value) {
    std::string place = value.pointer;
    while (resolved.contains(json::json_pointer(std::string(input::pointer_parent(place)))) &&
           resolved[json::json_pointer(std::string(input::pointer_parent(place)))].is_array())
      place = input::pointer_parent(place);
    return place;
  };
  for (const Assignment& value : values) {
    const std::string place = place_of(value);
    json& object = resolved[json::json_pointer(std::string(input::pointer_parent(place)))];
    if (value.value.is_object()) {
      for (const auto& [key, unused] : value.value.items()) resolved[json::json_pointer(place)]["origin"][key] = origin;
      continue;
    }
    object["origin"][input::pointer_leaf(place)] = origin;
  }
  return resolved;
}

}  // namespace

std::optional<double> number_to_set(const LoadedInput& input, std::span<const PointerValue> values,
                                    const SetValue& set) {
  if (set.value) return set.value;
  for (const PointerValue& v : values)
    if (v.pointer == set.same_as) return v.value;
  return number_at(input, set.same_as);
}

std::vector<ClaimMode> modes_of(const LoadedInput& given, const ClaimStage& stage) {
  const LoadedInput input = stage.sets.empty() ? given : given.with_further(assignments_of(stage.sets));
  std::vector<PointerValue> values;
  for (const SetValue& set : stage.at) {
    const std::optional<double> value = number_to_set(input, {}, set);
    if (!value) throw InputError("\"" + set.same_as + "\" is no number of the resolved input");
    values.push_back({set.parameter, *value});
  }
  const gear::Stage made = input.with_values(values).stage;
  const model::Scales scales = model::scales_of(made);
  std::vector<ClaimMode> modes;
  for (const model::Mode& mode : model::modes(made, scales))
    modes.push_back({mode.frequency_ratio * scales.omega_sn / (2.0 * std::numbers::pi), model::to_string(mode.type),
                     mode.multiplicity});
  return modes;
}

namespace {

/// Values that differ along a sweep of the claims: those of its `at`. Also Omega, if they change the stage and a speed
/// in rpm or Hz has to stay constant, with the candidate's `values`.
std::vector<PointerValue> set_along(const LoadedInput& input, std::span<const PointerValue> values,
                                    const ClaimSweep& sweep) {
  std::vector<PointerValue> set;
  for (const SetValue& s : sweep.at) set.push_back({s.parameter, number_to_set(input, values, s).value()});
  // A parameter with a name changes no time scale.
  const bool by_pointer = std::ranges::any_of(set, [](const PointerValue& v) { return v.pointer.starts_with('/'); });
  if (!by_pointer || sweep.axis.name == studies::speed_parameter) return set;
  std::vector<PointerValue> all(values.begin(), values.end());
  all.insert(all.end(), set.begin(), set.end());
  if (const auto ratio = input::ratio_at_given_speed(input, all)) set.push_back({studies::speed_parameter, *ratio});
  return set;
}

}  // namespace

json sweep_input(const LoadedInput& given, const ClaimSweep& sweep, studies::Start start) {
  const LoadedInput input = sweep.sets.empty() ? given : given.with_further(assignments_of(sweep.sets));
  const auto& options = claims_in(given.study);
  input::Study study = input.study;
  study.plan = input::Plan(kinds::sweep_kind(), options.whole_sweep(sweep, start));
  const std::vector<PointerValue> set = set_along(input, {}, sweep);
  const std::vector<Assignment> values = input::written_values(study, set);
  json changed = input.resolved;
  for (const Assignment& value : values) {
    if (value.pointer == input::speed_pointer) input::drop_other_speeds(changed, studies::speed_parameter);
    changed[json::json_pointer(value.pointer)] = value.value;
  }
  changed["name"] = (study.name.empty() ? std::string() : study.name + "_") + sweep.name;
  changed["study"] = input::study_table().write(study).at("study");
  return with_origins(std::move(changed), values, "set: by the sweep " + sweep.name);
}

namespace {

/// An input, with values in place of its numbers.
struct GivenPoint {
  std::shared_ptr<const LoadedInput> input;
  std::vector<PointerValue> fixed;
  model::OperatingPoint point;

  GivenPoint(std::shared_ptr<const LoadedInput> of, const std::vector<PointerValue>& values)
      : input(std::move(of)),
        fixed(values.empty() ? values : input::at_given_speed(*input, values)),
        point(input::point_at(*input, fixed)) {}
};

/// Inputs with the sets of sweeps in place, each made at its first request.
class SweepInputs {
 public:
  SweepInputs(std::shared_ptr<const LoadedInput> input, std::vector<PointerValue> values)
      : values_(std::move(values)), given_(std::move(input), values_) {}

  const GivenPoint& of(const ClaimSweep& sweep) {
    if (sweep.sets.empty()) return given_;
    const std::scoped_lock lock(mutex_);
    auto& made = made_[sweep.name];
    if (made == nullptr)
      made = std::make_unique<GivenPoint>(
          std::make_shared<const LoadedInput>(given_.input->with_further(assignments_of(sweep.sets))), values_);
    return *made;
  }
  [[nodiscard]] const std::vector<PointerValue>& values() const { return values_; }

 private:
  std::vector<PointerValue> values_;
  GivenPoint given_;
  std::mutex mutex_;
  std::map<std::string, std::unique_ptr<const GivenPoint>, std::less<>> made_;
};

/// The models of a study for the sweeps of claims, each sweep as the study of its own that sweep_input() makes of it:
/// with the scales of the stage that its `sets` and `at` make.
SweepModels sweep_models(std::shared_ptr<const LoadedInput> input, std::vector<PointerValue> values) {
  auto inputs = std::make_shared<SweepInputs>(std::move(input), std::move(values));
  return [inputs](const ClaimSweep& sweep, double value) {
    const GivenPoint& given = inputs->of(sweep);
    const auto with = [&](const std::vector<PointerValue>& set) {
      if (std::ranges::any_of(set, [](const PointerValue& v) { return v.pointer.starts_with('/'); })) {
        std::vector<PointerValue> all = given.fixed;
        all.insert(all.end(), set.begin(), set.end());
        return input::point_at(*given.input, all);
      }
      model::OperatingPoint point = given.point;
      input::set_named(point, set);
      return point;
    };
    std::vector<PointerValue> set = set_along(*given.input, inputs->values(), sweep);
    const model::Scales scales = model::scales_of(with(set).stage);
    set.push_back({sweep.axis.name, value});
    return input::model_of(with(set), scales);
  };
}

/// Inputs with the options of choices in place, each made at its first request.
class OptionInputs {
 public:
  explicit OptionInputs(LoadedInput given) : given_(std::move(given)) {}

  std::shared_ptr<const LoadedInput> of(const ParameterSpace& space, const std::vector<std::size_t>& options) {
    const std::scoped_lock lock(mutex_);
    std::shared_ptr<const LoadedInput>& input = made_[options];
    if (input == nullptr)
      input = std::make_shared<const LoadedInput>(given_.with_further(option_assignments(space, options)));
    return input;
  }

 private:
  LoadedInput given_;  ///< without an option
  std::mutex mutex_;
  std::map<std::vector<std::size_t>, std::shared_ptr<const LoadedInput>> made_;
};

/// Values of a candidate in place of the input's numbers.
std::vector<PointerValue> candidate_values(const ParameterSpace& space, std::span<const double> u) {
  std::vector<PointerValue> values;
  for (const auto& [pointer, value] : space.targets_at(u)) values.push_back({pointer, value});
  return values;
}

}  // namespace

json candidate_input(const LoadedInput& given, const ParameterSpace& space, std::span<const double> u,
                     const std::string& origin) {
  OptionInputs inputs(given);
  const std::shared_ptr<const LoadedInput> input = inputs.of(space, space.options_at(u));
  return with_origins(input->resolved_with(candidate_values(space, u)), candidate_assignments(space, u), origin);
}

CandidateModels candidate_models(const LoadedInput& given) {
  auto inputs = std::make_shared<OptionInputs>(given);
  return [inputs, space = claims_in(given.study).space](std::span<const double> u) {
    return sweep_models(inputs->of(space, space.options_at(u)), candidate_values(space, u));
  };
}

SweepModels claim_models(const LoadedInput& input) {
  // Not owned: the caller's.
  return sweep_models(std::shared_ptr<const LoadedInput>(&input, [](const LoadedInput*) {}), {});
}

}  // namespace epicyclic::claims
