// Commands: what the command line knows of each, and those of the kinds of study.
#pragma once

#include <string_view>
#include <vector>

#include "commands.hpp"
#include "expected_time.hpp"
#include "kinds/list.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace epicyclic::app {

/// What a command takes: each includes those before it but `finished`.
enum class Takes { nothing, finished, input, output };

inline void no_options(CLI::App& /*command*/, Arguments& /*arguments*/) {}

struct Command {
  const char* name;
  const char* meaning;
  int (*run)(const Arguments&);  ///< returns an ExitCode
  Takes takes;                   ///< a stage or study file and what follows, or a finished folder
  void (*options)(CLI::App&, Arguments&) = no_options;  ///< adds those of its own
  bool shares_work = false;                             ///< runs on several processes
  TimeOfStudy expected = nullptr;                       ///< of a kind with a plan; null: not measured

  /// Leaves files behind.
  [[nodiscard]] bool writes() const { return takes != Takes::nothing && takes != Takes::input; }
};

#define EPICYCLIC_KIND(name) const Command& name##_command();
EPICYCLIC_KINDS(EPICYCLIC_KIND)
#undef EPICYCLIC_KIND

/// Those of the library's kinds of study.
[[nodiscard]] std::vector<const Command*> kind_commands();

/// @throws std::out_of_range if no kind of that name has a command
[[nodiscard]] const Command& command_of(std::string_view kind);

/// --grow and --part, for studies of points: a smaller one may be part of them, and each point can be computed alone.
void add_points_options(CLI::App& command, Arguments& arguments);

/// --part, for studies whose results are independent of each other; --report excludes it.
/// @returns the option, for further exclusions
CLI::Option* add_part_option(CLI::App& command, Arguments& arguments);

/// Refuses --part.
void add_part_refusal(CLI::App& command,
                      const char* why = "only sweep, map, basins, robustness and reproduce have parts");

/// --from, for studies that may start from a point of a finished one; INPUT is then optional.
void add_start_option(CLI::App& command, Arguments& arguments);

}  // namespace epicyclic::app
