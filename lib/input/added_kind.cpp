#include "input/added_kind.hpp"

namespace epicyclic::input {

namespace {

std::vector<const AddedKind*>& kinds() {
  static std::vector<const AddedKind*> all;
  return all;
}

}  // namespace

void add_kind(const AddedKind& kind) { kinds().push_back(&kind); }

const std::vector<const AddedKind*>& added_kinds() { return kinds(); }

std::string_view AddedPlan::name() const { return kind->name; }

studies::LookOptions& AddedPlan::points_look() { return kind->look(options); }

const studies::LookOptions& AddedPlan::points_look() const { return const_cast<AddedPlan*>(this)->points_look(); }

}  // namespace epicyclic::input
