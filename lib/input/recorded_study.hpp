// Studies recorded by an earlier program: expected points, scorecards.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace epicyclic::input {

/// Gives a recorded study the new names of its keys and values. Keys that were added later get the value of the earlier
/// behaviour, so that the study stays the same. A key that is added to an input with existing records is in the list of
/// recorded_study.cpp.
/// @param resolved  as of an input.resolved.json; of a stage alone it stays as it is
void add_later_keys(nlohmann::json& resolved);

}  // namespace epicyclic::input
