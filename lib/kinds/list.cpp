#include "kinds/list.hpp"

namespace epicyclic::input {

std::vector<const StudyKind*> own_kinds() {
#define EPICYCLIC_KIND(name) &kinds::name##_kind(),
  return {EPICYCLIC_KINDS(EPICYCLIC_KIND)};
#undef EPICYCLIC_KIND
}

}  // namespace epicyclic::input
