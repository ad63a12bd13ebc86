// Studies that were recorded by an earlier program: expected points, scorecards.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace epicyclic::input {

/// Gives a recorded study the new names of its keys and values, and the keys that came after it, at what was done
/// before they were there, so that it is still the study that it was. A key that is added to an input where records
/// exist stands in the list of recorded_study.cpp.
/// @param resolved  as of an input.resolved.json; of a stage alone it stays as it is
void add_later_keys(nlohmann::json& resolved);

}  // namespace epicyclic::input
