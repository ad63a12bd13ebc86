// Kinds of study that components above this layer add to those of study_input.hpp: all that is asked of one.
#pragma once

#include <any>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "gear/warnings.hpp"
#include "input/plan_checks.hpp"
#include "input/study_input.hpp"

namespace epicyclic::input {

struct AddedKind {
  std::string_view name;       ///< the value of "kind"
  std::string_view commands;   ///< that compute it, in words
  std::string_view missing{};  ///< why this program cannot compute it; the members below are then not used

  const Table<Study>& (*table)() = nullptr;
  std::any defaults{};  ///< its options, of a type that can be copied
  studies::LookOptions& (*look)(std::any& options) = nullptr;

  /// Gives parameters that are the pointer of a speed its name [given_speeds.hpp].
  void (*name_speeds)(Study& study) = nullptr;
  /// Rules of the options that span keys.
  void (*check)(const Study& study, const IsBad& is_bad, ReadContext& context) = nullptr;
  /// Values that its options put into the input, once nothing else is wrong.
  /// @param refuse  takes what is wrong at a pointer of the input
  void (*check_values)(const LoadedInput& input,
                       const std::function<void(const std::string& pointer, std::string message)>& refuse) = nullptr;
  /// What is allowed but rarely meant, besides what is so of the stage.
  void (*warn)(std::vector<gear::Warning>& out, const LoadedInput& input) = nullptr;
  /// Asks for its models, and says in words what it takes to compute it.
  /// @throws InputError for what does not fit together
  std::string (*cost)(const LoadedInput& input) = nullptr;
};

/// Adds a kind, before the first input is read. It has to live as long as the program.
void add_kind(const AddedKind& kind);

/// In the order in which they were added.
[[nodiscard]] const std::vector<const AddedKind*>& added_kinds();

}  // namespace epicyclic::input
