// The source of each value of an input: the "origin" beside it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "input/field_table.hpp"

namespace epicyclic::input {

/// First words of an "origin", optionally followed by ": " and a text.
inline constexpr std::array<std::string_view, 11> origin_words = {"source",   "table",       "standard", "catalogue",
                                                                  "estimate", "calibrated",  "choice",   "default",
                                                                  "set",      "stage_patch", "computed"};

/// Is this key one about other keys: "origin", "note"?
[[nodiscard]] bool is_bookkeeping(const std::string& key);

/// Checks each "origin" of a text as written: its keys must exist beside it.
void check_origins(const nlohmann::json& value, const std::string& pointer, ReadContext& context);

/// Writes each origin as a map from the keys of its own object, and removes invalid ones (reported already).
void spread_origins(nlohmann::json& object, const nlohmann::json& inherited = nlohmann::json());

/// JSON merge patch that keeps the origins: values of the patch have the patch as their origin.
void apply_patch(nlohmann::json& target, nlohmann::json patch);

/// Gives each value of `resolved` the origin that it has in `given`, or "default" if it is not in `given`.
void fill_origins(nlohmann::json& resolved, const nlohmann::json& given);

/// A value that is set is no longer computed. Its origin says so, since otherwise it would be computed again.
void keep_from_computing(nlohmann::json& root, const std::string& pointer);

/// Notes values with the origin "computed" that no formula computes: in one line, or none.
void note_uncomputed(const nlohmann::json& resolved, const nlohmann::json& computed, std::vector<std::string>& notes);

}  // namespace epicyclic::input
