// The kind of study "tolerance": answers against tolerance, clearance smoothing and method.

#include "input/plan_tables.hpp"
#include "input/study_kind.hpp"
#include "kinds/list.hpp"
#include "kinds/tolerance/plan.hpp"

namespace epicyclic::kinds {

using namespace input;

namespace {

const Table<Study>& tolerance_table() {
  static const auto table = [] {
    using studies::ToleranceOptions;
    Table<Study> t("tolerance", "Results of the points over tolerance, method and clearance smoothing.");
    add_kind_key(t, "tolerance");
    add_grid(t);
    add_recording(t);
    add_classification(t);
    add_initial_state(t);
    const auto of = [](auto member) {
      return in_plan(
          [](auto& plan) -> auto& { return plan.template as<TolerancePlan>().tolerance; }, member);
    };
    t.choices("methods", of(&ToleranceOptions::methods), method_choices(), "Methods.");
    t.numbers("tolerances", of(&ToleranceOptions::tolerances), integrator_tolerance, 1, 100,
              "Relative tolerances [-]; the absolute tolerances keep the ratio of the integrator of the study.");
    t.numbers("clearance_smoothings", of(&ToleranceOptions::clearance_smoothings), between(tolerance_min, 10), 1, 100,
              "Widths of the smooth clearance, in b_c [-].");
    t.number("reference_tolerance", of(&ToleranceOptions::reference_tolerance), between(1e-15, 1e-6),
             "Relative and absolute tolerance of the reference orbits [-].");
    t.number("target_error", of(&ToleranceOptions::target_error), between(tolerance_min, 1),
             "Largest error of an orbit that the recommendation allows, in the units of the state.");
    t.integer("chaotic_periods", of(&ToleranceOptions::chaotic_periods), between(64, 1e7),
              "Mesh periods of the statistics of points that are not periodic [-].");
    return t;
  }();
  return table;
}

}  // namespace

const StudyKind& tolerance_kind() {
  static const StudyKind kind = {
      .name = "tolerance",
      .table = &tolerance_table,
      .defaults = TolerancePlan{},
      .recording = [](std::any& options) -> studies::RecordingOptions& {
        return std::any_cast<TolerancePlan&>(options).sweep.recording;
      },
      .own_sweep = [](std::any& options) -> studies::SweepOptions& {
        return std::any_cast<TolerancePlan&>(options).sweep;
      },
      .plan = &plan_of_sweep,
      .check = &check_sweep,
  };
  return kind;
}

}  // namespace epicyclic::kinds
