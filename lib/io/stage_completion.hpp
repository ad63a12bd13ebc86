// Lumped values from catalogue data: what a stage file does not give in "planets" and "lumped" is computed.
//
// Works on the JSON of a stage, before the tables read it. A computed value carries the origin "computed: ..." with the
// tag of its formula; values with that origin are dropped first and computed anew, so that a resolved input follows a
// change of its catalogue data, while a value with any other origin stands.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "io/field_table.hpp"

namespace epicyclic::io {

/// First word of the origin of values that the program computes.
inline constexpr std::string_view computed_word = "computed";

/// Removes the values whose origin says that they were computed, with their origins.
void drop_computed(nlohmann::json& object);

/// @param stage  a stage, origins spread to maps
/// @param root   pointer of the stage, for findings
/// @returns false when catalogue data are there but nothing could be computed: the reasons are among the findings, or
///          will be when the tables read the stage
bool complete_stage(nlohmann::json& stage, const std::string& root, ReadContext& context);

}  // namespace epicyclic::io
