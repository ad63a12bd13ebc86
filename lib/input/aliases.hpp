// Old names of keys, values of keys and columns, and the names that replace them: one table for all that reads a name.
//
// An input is renamed text by text, before the tables of keys read it, so that a file, a `stage_patch` and `--set` may
// each have old names. A finished folder and a recorded study are renamed as they are read.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace epicyclic::input {

/// The release that has no old names any more.
inline constexpr std::string_view aliases_end = "0.4.0";

struct Alias {
  enum class Kind { key, value, column };
  Kind kind;
  /// key: pointer of its object; value: pointer of its key; column: name of the table. By new names. A step "N" is the
  /// index of any element, "*" any key.
  std::string_view place;
  std::string_view old_name, new_name;
  std::string_view study = {};  ///< the one kind of studies that has it; empty: any kind

  /// "'/study/largest_step' is now '/study/max_step'; the old name works until 0.4.0".
  [[nodiscard]] std::string warning() const;
};

/// All of them: keys, then values, then columns.
[[nodiscard]] std::span<const Alias> aliases();

/// What was renamed in a text.
struct Renaming {
  std::vector<std::string> warnings;                         ///< one for each old name
  std::vector<std::pair<std::string, std::string>> clashes;  ///< pointer and message where both names are given
  /// Pointers in the text that have changed, each with the new names of what is above it.
  std::vector<std::pair<std::string, std::string>> moved;

  void warn(std::string text);
};

/// Gives a value of an input the new names.
/// @param place  pointer of the value in the whole input: "" of a study, "/stage" of a stage
/// @param study  kind of the study; empty: not known
/// @param at     pointer of the value in its text
void use_new_names(nlohmann::json& value, const std::string& place, std::string_view study, Renaming& renaming,
                   const std::string& at = {});

/// The same of a resolved input, whatever it is of, without a word on it.
void use_new_names(nlohmann::json& resolved);

/// Kind of the study of an input; empty if it is not given.
[[nodiscard]] std::string study_of(const nlohmann::json& input);

/// A pointer to a key of the input, by new names.
[[nodiscard]] std::string new_pointer(const std::string& pointer, std::string_view study, Renaming& renaming);

/// The new name of a value at the pointer of its key; the name itself if it has no other one.
[[nodiscard]] std::string new_value(std::string_view place, const std::string& name);

/// The new name of a table's column; the name itself if it has no other one.
[[nodiscard]] std::string new_column(std::string_view table, const std::string& name);

/// The alias of an old column of any table.
[[nodiscard]] const Alias* find_column_alias(std::string_view old_name);

}  // namespace epicyclic::input
