// The kind of study "basins": the attractors of initial conditions in a plane.

#include <algorithm>

#include "input/plan_tables.hpp"
#include "input/pointers.hpp"
#include "input/study_kind.hpp"
#include "input/study_model.hpp"
#include "kinds/list.hpp"
#include "studies/plane.hpp"

namespace epicyclic::kinds {

using namespace input;
using nlohmann::json;
using nlohmann::ordered_json;
using studies::BasinsOptions;

namespace {

const Table<studies::Axis>& component_axis_table() {
  static const auto table = [] {
    Table<studies::Axis> t("component_axis", "A component of the state and its values at the start.");
    t.text("component", &studies::Axis::name,
           "Name of the component, as in poincare.csv: x_s, ... [b_c], x_s_rate, ... [b_c per tau].")
        .required();
    add_axis_range(t);
    return t;
  }();
  return table;
}

/// Values by the names of the state's components, which the stage decides: names are checked when it is known.
Field<Study> base_field() {
  Field<Study> components;
  components.key = "other_components";
  components.description = "Initial values of components that are on no axis, if not those of the default start.";
  const Bounds bounds = component_value;
  components.read = [bounds](const json& value, const std::string& pointer, Study& study, ReadContext& context) {
    if (!table_detail::check_object(value, pointer, context)) return;
    table_detail::check_note(value, pointer, context);
    for (const auto& [key, number] : value.items()) {
      if (key == "origin" || key == "note") continue;
      const auto read =
          table_detail::read_number(number, pointer + pointer_step(key), "other_components", bounds, context);
      // Kept if it is none, for its name to be checked.
      study.plan.as<BasinsOptions>().other_components[key] = read.value_or(0.0);
    }
  };
  components.write = [](const Study& study) {
    json object;
    for (const auto& [name, value] : study.plan.as<BasinsOptions>().other_components) object[name] = value;
    return object;
  };
  components.schema = [bounds] {
    return ordered_json{{"type", "object"}, {"additionalProperties", table_detail::number_schema(bounds)}};
  };
  return components;
}

const Table<Study>& basins_table() {
  static const auto table = [] {
    using studies::Plane;
    Table<Study> t("basins", "Attractors reached from a plane of initial states, at one operating point.");
    add_kind_key(t, "basins");
    t.object("first", in_plan(whole_plan<BasinsOptions>, &BasinsOptions::plane, &Plane::first), component_axis_table())
        .required();
    t.object("second", in_plan(whole_plan<BasinsOptions>, &BasinsOptions::plane, &Plane::second),
             component_axis_table())
        .required();
    t.custom(base_field());
    add_recording(t);
    add_classification(t);
    return t;
  }();
  return table;
}

/// Rules of the components that basins start from.
void check_basins(const Study& study, const IsBad& is_bad, ReadContext& context) {
  const auto& basins = study.plan.as<BasinsOptions>();
  const gear::Stage& stage = study.stage;
  if (stage.planet_count < 1 || stage.planet_count > gear::planets_max) return;
  const studies::Plane& plane = basins.plane;
  const std::vector<std::string> names = state_names(stage);
  const auto known = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const auto named = [&](const std::string& place) { return !is_bad(place) && !is_bad(place + "/component"); };
  const std::string those = ", which is no component of the state of this stage: " + listed(names);
  for (const auto& [axis, at] : {std::pair(&plane.first, "/study/first"), {&plane.second, "/study/second"}}) {
    const std::string place = at;
    check_range(*axis, place, is_bad, "", context);
    if (named(place) && !known(axis->name))
      context.add(Finding::Kind::range, place + "/component",
                  "is \"" + axis->name + "\"" + those + suggestion(axis->name, names));
  }
  if (plane.first.name == plane.second.name && named("/study/first") && named("/study/second"))
    context.add(Finding::Kind::rule, "/study/second/component",
                "is \"" + plane.second.name + "\", which the first axis varies already");
  for (const auto& [name, value] : basins.other_components) {
    const std::string place = "/study/other_components" + pointer_step(name);
    if (!known(name)) {
      const bool in_words = context.findings.size() < findings_max;
      context.add(Finding::Kind::unknown_key, place,
                  "unknown key '" + name + "'" + (in_words ? those + suggestion(name, names) : std::string()));
    } else if (name == plane.first.name || name == plane.second.name) {
      context.add(Finding::Kind::rule, place, "is given, but an axis varies this component");
    }
  }
}

/// The model of the operating point with the start of each cell.
studies::ModelAtPoint model_at_start(const LoadedInput& input) {
  return [basins = &input.study.plan.as<BasinsOptions>(),
          model = model_at(input)(input.study.mesh_frequency_ratio)](const studies::GridPoint& p) {
    model::DynamicModel at_cell = model;
    at_cell.default_start = studies::start_in_plane(model, *basins, p);
    return at_cell;
  };
}

}  // namespace

const StudyKind& basins_kind() {
  static const StudyKind kind = {
      .name = "basins",
      .table = &basins_table,
      .defaults = BasinsOptions{},
      .recording = [](std::any& options) -> studies::RecordingOptions& {
        return std::any_cast<BasinsOptions&>(options).recording;
      },
      .plan = [](const Study& study) { return studies::plan_basins(study.plan.as<BasinsOptions>()); },
      .model_at_point = &model_at_start,
      .check = &check_basins,
      .warn = &warn_without_tangents,
      .points_kept = PointsKept::journal,
  };
  return kind;
}

}  // namespace epicyclic::kinds
