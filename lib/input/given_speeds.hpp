// Speeds of a study in rpm and Hz as the mesh frequency ratio [speed_aliases.hpp].
//
// A resolved input keeps each speed as it is given. Models are made at Omega, by the given stage. A study that varies a
// parameter of the stage changes neither the scale of time nor the speed.
#pragma once

#include <functional>
#include <string>

#include <nlohmann/json.hpp>

#include "input/plan_checks.hpp"
#include "input/study_input.hpp"

namespace epicyclic::input {

/// The pointer of Omega in an input.
inline const std::string speed_pointer = "/operation/mesh_frequency_ratio";

/// A speed that is set replaces one that was given in another unit.
/// @param key  of the one that is set, in "operation"; another key changes nothing
void drop_other_speeds(nlohmann::json& whole, const std::string& key);

/// A parameter that is the pointer of a speed gets the speed's name.
void name_speed(std::string& parameter);
void name_speeds(Study& study);

/// Converts the speeds of the operating point and along axes.
/// @param study   as read; has Omega alone afterwards, and the unit of its axis
/// @param whole   its text
/// @param moves   the stage is complete and can rotate; else nothing is converted, and no speed is left
/// @param refuse  receives the errors
void convert_speeds(Study& study, const nlohmann::json& whole, bool moves, const IsBad& is_bad,
                    const std::function<void(Finding::Kind, const std::string& pointer, std::string message)>& refuse);

}  // namespace epicyclic::input
