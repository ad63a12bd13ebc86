#include "input/derived_study.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "input/given_speeds.hpp"
#include "input/pointers.hpp"
#include "input/study_model.hpp"
#include "model/scales.hpp"
#include "studies/cost_estimate.hpp"
#include "studies/named_parameters.hpp"

namespace epicyclic::input {

using nlohmann::json;

std::vector<Assignment> written_values(Study& study, std::span<const PointerValue> values) {
  std::vector<Assignment> written;
  for (const PointerValue& v : values) {
    const studies::NamedParameter* named = studies::find_parameter(v.pointer);
    if (named == nullptr) {
      written.push_back({v.pointer, v.value, {}});
      continue;
    }
    model::OperatingPoint point{study.stage, study.mesh_frequency_ratio, study.model};
    named->set(point, v.value);
    study.stage = point.stage;
    study.mesh_frequency_ratio = point.mesh_frequency_ratio;
    for (const std::string& pointer : named->pointers) written.push_back({pointer, {}, {}});
  }
  const json as_written = study_table().write(study);
  // Of a parameter that sets both meshes, a pair of gears has one.
  std::erase_if(written, [&](const Assignment& w) {
    return w.value.is_null() && !as_written.contains(json::json_pointer(w.pointer));
  });
  for (Assignment& w : written)
    if (w.value.is_null()) w.value = as_written.at(json::json_pointer(w.pointer));
  return written;
}

void set_named(model::OperatingPoint& point, std::span<const PointerValue> values) {
  for (const PointerValue& v : values)
    if (!v.pointer.starts_with('/')) {
      const studies::NamedParameter* parameter = studies::find_parameter(v.pointer);
      if (parameter == nullptr) throw InputError("/study/parameter: no sweep parameter '" + v.pointer + "'");
      parameter->set(point, v.value);
    }
}

model::OperatingPoint point_at(const LoadedInput& input, std::span<const PointerValue> values) {
  std::vector<PointerValue> pointers;
  for (const PointerValue& v : values)
    if (v.pointer.starts_with('/')) pointers.push_back(v);
  const Study study = pointers.empty() ? input.study : input.with_values(pointers);
  model::OperatingPoint point{study.stage, study.mesh_frequency_ratio, study.model};
  set_named(point, values);
  return point;
}

std::optional<double> ratio_at_given_speed(const LoadedInput& input, std::span<const PointerValue> values) {
  const studies::NamedParameter& speed = *studies::find_parameter(studies::speed_parameter);
  if (std::ranges::any_of(values, [&](const PointerValue& v) {
        return v.pointer == speed.name || v.pointer == speed.pointers.front();
      }))
    return std::nullopt;
  for (const SpeedAlias& alias : speed_aliases()) {
    std::optional<double> given = input.given_speed.*alias.given;
    for (const PointerValue& v : values)
      if (v.pointer == std::string(operation_root) + "/" + std::string(alias.key)) given = v.value;
    if (!given) continue;
    if (const auto ratio = ratio_per_unit(alias, point_at(input, values).stage)) return *given * *ratio;
  }
  return std::nullopt;
}

std::vector<PointerValue> at_given_speed(const LoadedInput& input, std::vector<PointerValue> values) {
  if (const auto ratio = ratio_at_given_speed(input, values))
    values.push_back({studies::find_parameter(studies::speed_parameter)->pointers.front(), *ratio});
  return values;
}

namespace {

/// The unit of a speed in the study, of its axis or of its operating point; null: Omega.
const SpeedAlias* speed_given_in(const LoadedInput& input) {
  if (input.study.axis_speed) return find_speed_alias(input.study.axis_speed->key);
  for (const SpeedAlias& alias : speed_aliases())
    if (input.given_speed.*alias.given) return &alias;
  return nullptr;
}

}  // namespace

std::vector<Assignment> point_as_study(const LoadedInput& input, const studies::GridPoint& point, std::string_view kind,
                                       bool stage_changes) {
  Study study = input.study;
  const std::vector<VariedParameter> varied = varied_parameters(study);
  std::vector<PointerValue> values;
  for (std::size_t k = 0; k < varied.size(); ++k)
    values.push_back({varied[k].axis.name, k == 0 ? point.value : point.second_value});
  std::vector<Assignment> sets = written_values(study, values);
  std::vector<PointerValue> pointers;
  for (const PointerValue& v : values)
    if (v.pointer.starts_with('/')) pointers.push_back(v);
  if (!pointers.empty()) {
    // The speed stays constant, in rad/s.
    const Study changed = input.with_values(pointers);
    study.mesh_frequency_ratio *= time_scale(input) / model::scales_of(changed.stage).omega_sn;
    study.stage = changed.stage;
    sets.push_back({speed_pointer, study.mesh_frequency_ratio, {}});
  }
  if (const SpeedAlias* alias = stage_changes ? speed_given_in(input) : nullptr) {
    // With the time scale of another stage Omega would be another speed.
    const double speed = study.mesh_frequency_ratio / ratio_per_unit(*alias, study.stage).value();
    sets.push_back({std::string(operation_root) + "/" + std::string(alias->key), speed, {}});
  }
  json plan = {{"kind", kind}};
  for (const char* key : {"transient", "transient_periods", "recorded_periods", "output_phases", "period_max",
                          "recurrence_tolerance", "classification_periods"})
    if (const json* there = input.value_at(std::string("/study/") + key)) plan[key] = *there;
  if (kind != "run") {
    plan["parameter"] = studies::speed_parameter;
    plan["from"] = plan["to"] = study.mesh_frequency_ratio;
    plan["points"] = 1;
  }
  sets.push_back({"/study", std::move(plan), {}});
  return sets;
}

double time_scale(const LoadedInput& input) { return model::scales_of(input.study.stage).omega_sn; }

bool moves_like(const LoadedInput& input, const LoadedInput& other, const model::DynamicModel& model) {
  const double first = plan_of(input.study).points[0].value;
  const std::vector<VariedParameter> varied = varied_parameters(input.study);
  Study study = input.study;
  if (!varied.empty()) {
    const std::string& name = varied.front().axis.name;
    if (name.starts_with('/')) study = input.with_value(name, first);
    model::OperatingPoint named{study.stage, study.mesh_frequency_ratio, study.model};
    if (const studies::NamedParameter* parameter = studies::find_parameter(name)) parameter->set(named, first);
    study.stage = named.stage;
    study.mesh_frequency_ratio = named.mesh_frequency_ratio;
  }
  // In the scale of time of the other study. A speed that came by it and back is the same.
  constexpr double rounding = 1e-12;
  double ratio = study.mesh_frequency_ratio * time_scale(input) / time_scale(other);
  if (std::abs(ratio / model.omega - 1.0) < rounding) ratio = model.omega;
  const model::DynamicModel here =
      model::make_dynamic_model(study.stage, model::scales_of(other.study.stage), ratio, study.model);
  return studies::same_equations(here, model);
}

}  // namespace epicyclic::input
