// The kind of study "crosscheck": the same points by several methods, compared.

#include "input/plan_tables.hpp"
#include "input/study_kind.hpp"
#include "kinds/crosscheck/plan.hpp"
#include "kinds/list.hpp"

namespace epicyclic::kinds {

using namespace input;

namespace {

const Table<Study>& crosscheck_table() {
  static const auto table = [] {
    using studies::CrosscheckOptions;
    Table<Study> t("crosscheck", "The same points by several methods, compared.");
    add_kind_key(t, "crosscheck");
    add_grid(t);
    add_recording(t);
    add_classification(t);
    add_initial_state(t);
    const auto of = [](auto member) {
      return in_plan(
          [](auto& plan) -> auto& { return plan.template as<CrosscheckPlan>().crosscheck; }, member);
    };
    t.choices("methods", of(&CrosscheckOptions::methods), method_choices(),
              "Methods; the first is the reference of the others.");
    t.numbers("clearance_smoothings", of(&CrosscheckOptions::clearance_smoothings), smoothing_width, 1, 100,
              "Widths of the smooth clearance that the reference method is repeated with, in b_c [-].");
    t.number("orbit_tolerance", of(&CrosscheckOptions::orbit_tolerance), between(tolerance_min, 1),
             "Two orbits are the same if no component differs by more, in the units of the state.");
    t.integer("continued_periods", of(&CrosscheckOptions::continued_periods), between(1, 1e6),
              "Mesh periods that one answer is continued with the other method to explain a difference [-].");
    return t;
  }();
  return table;
}

}  // namespace

const StudyKind& crosscheck_kind() {
  static const StudyKind kind = {
      .name = "crosscheck",
      .table = &crosscheck_table,
      .defaults = CrosscheckPlan{},
      .recording = [](std::any& options) -> studies::RecordingOptions& {
        return std::any_cast<CrosscheckPlan&>(options).sweep.recording;
      },
      .own_sweep = [](std::any& options) -> studies::SweepOptions& {
        return std::any_cast<CrosscheckPlan&>(options).sweep;
      },
      .plan = &plan_of_sweep,
      .check = &check_sweep,
  };
  return kind;
}

}  // namespace epicyclic::kinds
