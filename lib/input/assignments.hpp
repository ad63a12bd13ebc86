// Values that the command line sets in an input: --set /json/pointer=value.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace epicyclic::input {

/// "--set /json/pointer=value": pointers address the study as written, and /stage/... the resolved stage.
struct Assignment {
  std::string pointer;
  nlohmann::json value;
  std::string text;                     ///< as given
  std::vector<std::string> problems{};  ///< what is wrong with it as such; load_input() reports it with all else
  std::vector<std::string> notes{};     ///< warnings of old names in it, once load_input() has renamed them

  [[nodiscard]] std::string shown() const { return "--set " + text; }
};

/// The value is JSON, or a bare word that stands for a string.
[[nodiscard]] std::vector<Assignment> parse_assignments(std::span<const std::string> texts);

/// Writes the value at its pointer, as `--set` does: objects are made on the way, null removes, origins say where from.
/// @returns what is wrong, or nothing
[[nodiscard]] std::string assign(nlohmann::json& root, std::string_view pointer, const nlohmann::json& value);

}  // namespace epicyclic::input
