// Options of the kind of study "crosscheck".
#pragma once

#include "studies/crosscheck_options.hpp"
#include "studies/sweep_options.hpp"

namespace epicyclic::kinds {

struct CrosscheckPlan {
  studies::SweepOptions sweep;
  studies::CrosscheckOptions crosscheck;
};

}  // namespace epicyclic::kinds
