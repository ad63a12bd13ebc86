// JSON pointers of an input: the value at a pointer, and the pointer that was probably meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "input/field_table.hpp"
#include "input/json_source.hpp"

namespace epicyclic::input {

inline constexpr std::string_view stage_root = "/stage";
inline constexpr std::string_view patch_root = "/stage_patch";
inline constexpr std::string_view operation_root = "/operation";

/// The value at a pointer, or a null pointer.
[[nodiscard]] const nlohmann::json* find_at(const nlohmann::json& root, std::string_view pointer);
[[nodiscard]] nlohmann::json* find_at(nlohmann::json& root, std::string_view pointer);

/// Appends the pointers of all numbers below a value.
void collect_numbers(const nlohmann::json& value, const std::string& pointer, std::vector<std::string>& pointers);

/// The steps of a mistyped pointer, with any separators; without the index of an element.
[[nodiscard]] std::vector<std::string> loose_steps(std::string_view text);

/// Pointers of keys that end in the last of the steps and have the others before it: what was probably meant. Of
/// these the one that is the same, or those that have nothing between the steps, if there are any.
[[nodiscard]] std::vector<std::string> meant_pointers(std::string_view text, const std::vector<KeyPlace>& places);

/// "; did you mean 'x'?" of some pointers, or nothing.
[[nodiscard]] std::string suggested(const std::vector<std::string>& meant);

/// Keys of a study with its stage, and their places.
[[nodiscard]] const std::vector<KeyPlace>& all_places();

}  // namespace epicyclic::input
