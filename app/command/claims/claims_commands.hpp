// The commands on what is claimed of a stage in a publication, and their kind of study.
//
// Two implementations, one of which is linked: the other files of this folder, and missing.cpp in a program that was
// built without them.
#pragma once

#include "commands.hpp"

namespace epicyclic::app {

/// Before the first input is read.
void add_claims_kind();

int reproduce_command(const Arguments& arguments);
int robustness_command(const Arguments& arguments);
int calibrate_command(const Arguments& arguments);

}  // namespace epicyclic::app
