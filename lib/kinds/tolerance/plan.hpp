// Options of the kind of study "tolerance".
#pragma once

#include "studies/sweep_options.hpp"
#include "studies/tolerance_options.hpp"

namespace epicyclic::kinds {

struct TolerancePlan {
  studies::SweepOptions sweep;
  studies::ToleranceOptions tolerance;
};

}  // namespace epicyclic::kinds
