// The kind of study "run": one operating point in detail.

#include "input/plan_tables.hpp"
#include "input/study_kind.hpp"
#include "input/study_model.hpp"
#include "kinds/list.hpp"
#include "kinds/run/plan.hpp"

namespace epicyclic::kinds {

using namespace input;

namespace {

const Table<Study>& run_table() {
  static const auto table = [] {
    using studies::RunOptions;
    Table<Study> t("run", "One operating point, at the speed that \"operation\" gives.");
    add_kind_key(t, "run");
    add_recording(t);
    add_classification(t);
    add_initial_state(t);
    const auto of = [](auto member) {
      return in_plan(
          [](auto& plan) -> auto& { return plan.template as<RunPlan>().run; }, member);
    };
    t.integer("exponent_periods", of(&RunOptions::exponent_periods), between(0, 1e6),
              "Mesh periods that the Lyapunov exponents are counted over [-]; 0: none are computed.");
    t.integer("dense_phases", of(&RunOptions::dense_phases), between(8, 10000),
              "Samples per mesh period of histories and spectra [-].");
    t.integer("history_periods", of(&RunOptions::history_periods), between(1, 10000),
              "Mesh periods that are kept of histories, and that summaries are taken over [-].");
    t.integer("spectrum_periods", of(&RunOptions::spectrum_periods), between(1, 100000),
              "Mesh periods that spectra are taken over [-]; of a periodic orbit, its own period.");
    t.integer("shown_periods", of(&RunOptions::shown_periods), between(1, 10000),
              "Mesh periods in history.csv and in the figures of histories [-].");
    t.number("check_tolerance", of(&RunOptions::check_tolerance), between(1e-14, 1e-6),
             "Relative and absolute tolerance of the orbit's multipliers and of the exponents' checks [-].");
    return t;
  }();
  return table;
}

}  // namespace

const StudyKind& run_kind() {
  static const StudyKind kind = {
      .name = "run",
      .table = &run_table,
      .defaults = RunPlan{},
      .recording = [](std::any& options) -> studies::RecordingOptions& {
        return std::any_cast<RunPlan&>(options).recording;
      },
      .sweep = [](const Study& study) { return studies::sweep_of_one(study.mesh_frequency_ratio, study.recording()); },
      .plan = &plan_of_sweep,
      .with_shaft_errors = true,
      .warn = &warn_without_tangents,
      .points_kept = PointsKept::tables,
      .plot = {PlotForm::histories, {"history.csv"}, "delta_sp_1"},
  };
  return kind;
}

}  // namespace epicyclic::kinds
