// The kinds of study: one line for each. Kind NAME is in the folder kinds/NAME: its object NAME_kind() in kind.cpp, its
// command NAME_command() in command.cpp, which the program compiles.
#pragma once

#include "input/study_kind.hpp"

// In the order of the input's schema.
#define EPICYCLIC_KINDS(KIND) \
  KIND(sweep)                 \
  KIND(map)                   \
  KIND(basins)                \
  KIND(run)                   \
  KIND(ramp)                  \
  KIND(crosscheck)            \
  KIND(tolerance)             \
  KIND(continue)

namespace epicyclic::kinds {

using input::StudyKind;

#define EPICYCLIC_KIND(name) const StudyKind& name##_kind();
EPICYCLIC_KINDS(EPICYCLIC_KIND)
#undef EPICYCLIC_KIND

}  // namespace epicyclic::kinds
