// A study from one JSON value, completed from catalogue data: the tables of keys, then the rules of gear.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "input/study_input.hpp"

namespace epicyclic::input {

/// Is this a value of the stage from which others are computed [stage_completion.hpp]?
[[nodiscard]] bool feeds_completion(std::string_view pointer, bool bare, const gear::Stage& stage);

/// Reads the whole input from one JSON value, which is completed from catalogue data first: the tables, then the rules
/// that combine objects.
/// @param computed  receives the values from catalogue data, at their places; null: the input has been completed
/// already, from these very catalogue data
/// @returns false beside the study if values of the stage could not be read or computed
[[nodiscard]] std::pair<Study, bool> read_study(nlohmann::json& whole, bool bare, ReadContext& context,
                                                nlohmann::json* computed);

/// A study that was read without a finding, with other numbers in it that nothing is computed from.
/// @returns nothing if one of them is not a number of the study's tables
[[nodiscard]] std::optional<Study> change_study(const Study& sound, bool bare, std::span<const PointerValue> values,
                                                ReadContext& context);

}  // namespace epicyclic::input
