#include "input/study_kind.hpp"

#include <algorithm>
#include <stdexcept>

#include "studies/sweep_plan.hpp"

namespace epicyclic::input {

namespace {

std::vector<const StudyKind*>& kinds() {
  static std::vector<const StudyKind*> all = own_kinds();
  return all;
}

std::logic_error lacks(const Plan& plan, const char* what) {
  return std::logic_error("a study of kind " + std::string(plan.name()) + " has no " + what);
}

}  // namespace

void add_kind(const StudyKind& kind) { kinds().push_back(&kind); }

const std::vector<const StudyKind*>& study_kinds() { return kinds(); }

const StudyKind* find_kind(std::string_view name) {
  const auto found = std::ranges::find(kinds(), name, [](const StudyKind* kind) { return kind->name; });
  return found == kinds().end() ? nullptr : *found;
}

Plan::Plan(const StudyKind& kind) : Plan(kind, kind.defaults) {}

std::string_view Plan::name() const { return kind_ == nullptr ? "stage" : kind_->name; }

studies::RecordingOptions& Plan::recording() {
  if (kind_ == nullptr || kind_->recording == nullptr) throw lacks(*this, "points");
  return kind_->recording(options_);
}

studies::SweepOptions& Plan::sweep() {
  if (kind_ == nullptr || kind_->own_sweep == nullptr) throw lacks(*this, "sweep");
  return kind_->own_sweep(options_);
}

bool Study::integrates() const {
  return has_dynamics() && (plan.kind()->moves == nullptr || plan.kind()->moves(plan.options()));
}

bool Study::has_points() const { return has_dynamics() && plan.kind()->plan != nullptr; }

studies::SweepOptions Study::sweep() const {
  if (has_dynamics() && plan.kind()->sweep != nullptr) return plan.kind()->sweep(*this);
  return plan.sweep();
}

std::vector<PlanAxis> axes_of(Plan& plan) {
  const StudyKind* kind = plan.kind();
  if (kind != nullptr && kind->axes != nullptr) return kind->axes(plan.options());
  if (kind == nullptr || kind->own_sweep == nullptr) return {};
  studies::Axis& axis = plan.sweep().axis;
  return {{&axis.name, &axis.from, &axis.to, axis.points, "/study"}};
}

studies::SweepPlan plan_of_sweep(const Study& study) { return studies::plan_sweep(study.sweep()); }

}  // namespace epicyclic::input
