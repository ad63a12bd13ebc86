// The kind of study "sweep": points along one parameter, up, down or both.

#include "input/plan_tables.hpp"
#include "input/study_kind.hpp"
#include "input/study_model.hpp"
#include "kinds/list.hpp"

namespace epicyclic::kinds {

using namespace input;
using studies::SweepOptions;

namespace {

const Table<studies::SweepCheck>& check_table() {
  static const auto table = [] {
    using studies::SweepCheck;
    Table<SweepCheck> t("sweep_check", "Points of the finished sweep by other methods, compared.");
    t.integer("points", &SweepCheck::points, between(0, 10000),
              "Points at most [-], shared out among the regimes; 0: none.");
    t.choices("methods", &SweepCheck::methods, method_choices(), "Methods that the sweep's own is compared with.");
    t.number("orbit_tolerance", &SweepCheck::orbit_tolerance, between(tolerance_min, 1),
             "Two orbits are the same if no component differs by more, in the units of the state.");
    return t;
  }();
  return table;
}

const Table<Study>& sweep_table() {
  static const auto table = [] {
    Table<Study> t("sweep", "A sweep along one parameter.");
    add_kind_key(t, "sweep");
    add_grid(t);
    add_recording(t);
    add_classification(t);
    add_initial_state(t);
    t.object("crosscheck", in_plan(whole_plan<SweepOptions>, &SweepOptions::check), check_table());
    return t;
  }();
  return table;
}

}  // namespace

const StudyKind& sweep_kind() {
  static const StudyKind kind = {
      .name = "sweep",
      .table = &sweep_table,
      .defaults = SweepOptions{},
      .recording = [](std::any& options) -> studies::RecordingOptions& {
        return std::any_cast<SweepOptions&>(options).recording;
      },
      .own_sweep = [](std::any& options) -> SweepOptions& { return std::any_cast<SweepOptions&>(options); },
      .plan = &plan_of_sweep,
      .complete =
          [](std::any& options) {
            auto& sweep = std::any_cast<SweepOptions&>(options);
            sweep.segments = segments_of(sweep);
          },
      .check = &check_sweep,
      .warn = &warn_without_tangents,
      .points_kept = PointsKept::journal,
      .plot = {PlotForm::points, {"points.csv", "poincare.csv"}, "delta_sp_1"},
  };
  return kind;
}

}  // namespace epicyclic::kinds
