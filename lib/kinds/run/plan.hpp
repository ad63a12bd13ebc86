// Options of the kind of study "run".
#pragma once

#include "studies/recording_options.hpp"
#include "studies/run_options.hpp"

namespace epicyclic::kinds {

struct RunPlan {
  studies::RecordingOptions recording;
  studies::RunOptions run;
};

}  // namespace epicyclic::kinds
