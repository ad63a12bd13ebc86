// Options of the kind of study "run".
#pragma once

#include "studies/look_options.hpp"
#include "studies/run_options.hpp"

namespace epicyclic::kinds {

struct RunPlan {
  studies::LookOptions look;
  studies::RunOptions run;
};

}  // namespace epicyclic::kinds
