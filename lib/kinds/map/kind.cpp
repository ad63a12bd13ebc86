// The kind of study "map": regimes over two parameters.

#include <array>

#include "input/derived_study.hpp"
#include "input/plan_tables.hpp"
#include "input/study_kind.hpp"
#include "input/study_model.hpp"
#include "kinds/list.hpp"
#include "studies/plane.hpp"

namespace epicyclic::kinds {

using namespace input;
using studies::MapOptions;

namespace {

const Table<studies::Axis>& parameter_axis_table() {
  static const auto table = [] {
    Table<studies::Axis> t("parameter_axis", "A parameter and its values.");
    t.text("parameter", &studies::Axis::name, parameter_words).required();
    add_axis_range(t);
    return t;
  }();
  return table;
}

const Table<Study>& map_table() {
  static const auto table = [] {
    using studies::Plane;
    Table<Study> t("map", "Regimes over two parameters.");
    add_kind_key(t, "map");
    t.object("first", in_plan(whole_plan<MapOptions>, &MapOptions::plane, &Plane::first), parameter_axis_table())
        .required();
    t.object("second", in_plan(whole_plan<MapOptions>, &MapOptions::plane, &Plane::second), parameter_axis_table())
        .required();
    add_course(t, whole_plan<MapOptions>, &MapOptions::directions, &MapOptions::start);
    add_recording(t);
    add_classification(t);
    add_initial_state(t);
    return t;
  }();
  return table;
}

/// Rules of the two parameters of a map.
void check_map(const Study& study, const IsBad& is_bad, ReadContext& context) {
  const studies::Plane& plane = study.plan.as<MapOptions>().plane;
  const auto named = [&](const std::string& place) { return !is_bad(place) && !is_bad(place + "/parameter"); };
  for (const auto& [axis, place] : {std::pair(&plane.first, "/study/first"), {&plane.second, "/study/second"}}) {
    check_range(*axis, place, is_bad, "", context);
    if (named(place)) check_named_parameter(*axis, place, is_bad, context);
  }
  if (!named("/study/first") || !named("/study/second")) return;
  check_different(plane.first.name, plane.second.name, "/study/second/parameter", context);
}

/// The model at the values of both parameters.
studies::ModelAtPoint model_in_plane(const LoadedInput& input) {
  return [&input, &plane = input.study.plan.as<MapOptions>().plane,
          scales = model::scales_of(input.study.stage)](const studies::GridPoint& p) {
    return started(model_of(point_at(input, std::array{PointerValue{plane.first.name, p.value},
                                                       PointerValue{plane.second.name, p.second_value}}),
                            scales),
                   input.study);
  };
}

}  // namespace

const StudyKind& map_kind() {
  static const StudyKind kind = {
      .name = "map",
      .table = &map_table,
      .defaults = MapOptions{},
      .recording = [](std::any& options) -> studies::RecordingOptions& {
        return std::any_cast<MapOptions&>(options).recording;
      },
      .plan = [](const Study& study) { return studies::plan_map(study.plan.as<MapOptions>()); },
      .model_at_point = &model_in_plane,
      .axes =
          [](std::any& options) {
            studies::Plane& plane = std::any_cast<MapOptions&>(options).plane;
            std::vector<PlanAxis> axes;
            for (const auto& [axis, place] :
                 {std::pair(&plane.first, "/study/first"), {&plane.second, "/study/second"}})
              axes.push_back({&axis->name, &axis->from, &axis->to, axis->points, place});
            return axes;
          },
      .check = &check_map,
      .warn = &warn_without_tangents,
      .points_kept = PointsKept::journal,
      .plot = {PlotForm::cells, {"points.csv"}, "delta_sp_rms"},
  };
  return kind;
}

}  // namespace epicyclic::kinds
