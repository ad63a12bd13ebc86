// Lumped values from catalogue data: values that a stage file does not give in "planets" and "lumped" are computed.
//
// Works on the JSON of a stage, before the tables read it. A computed value has the origin "computed: ..." with the tag
// of its formula. Values with that origin, and defaults, are computed anew, so that a resolved input follows a change
// of its catalogue data. A value with any other origin stays. So does one with the origin "computed" that no formula
// computes.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "input/field_table.hpp"

namespace epicyclic::input {

/// First word of the origin of values that the program computes.
inline constexpr std::string_view computed_word = "computed";

/// Is this the origin of a value that was computed?
[[nodiscard]] bool is_computed(const nlohmann::json& origin);

/// Is this the origin of a value that the user did not give: computed, or a default?
[[nodiscard]] bool may_be_replaced(const nlohmann::json& origin);

/// The result of the completion of a stage.
struct Completion {
  bool complete = true;     ///< false: there are catalogue data, but nothing could be computed; the reasons are among
                            ///< the findings, or will be when the tables read the stage
  nlohmann::json computed;  ///< all that the catalogue data give, at its places in the stage; null without such data
};

/// @param stage  a stage, origins spread to maps
/// @param root   pointer of the stage, for findings
Completion complete_stage(nlohmann::json& stage, const std::string& root, ReadContext& context);

/// The values from catalogue data of another resolved input on this machine, at their places; null without such data.
/// @param resolved  of a study or of a stage alone; values that were computed are replaced by those of this machine
[[nodiscard]] nlohmann::json computed_values(nlohmann::json& resolved);

}  // namespace epicyclic::input
