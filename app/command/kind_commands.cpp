#include "kind_commands.hpp"

#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

namespace epicyclic::app {

std::vector<const Command*> kind_commands() {
#define EPICYCLIC_KIND(name) &name##_command(),
  return {EPICYCLIC_KINDS(EPICYCLIC_KIND)};
#undef EPICYCLIC_KIND
}

const Command& command_of(std::string_view kind) {
  for (const Command* command : kind_commands())
    if (command->name == kind) return *command;
  throw std::out_of_range("no command for studies of kind " + std::string(kind));
}

void add_grow_option(CLI::App& command, Arguments& arguments) {
  command.add_option(
      "--grow", arguments.grow,
      "reuse the points of a finished smaller study (its folder) that a new computation would repeat byte for byte");
}

void add_start_option(CLI::App& command, Arguments& arguments) {
  command.get_option("INPUT")->required(false)->description(
      "study or stage file (JSON), or the name of an installed input; not needed with --from");
  command
      .add_option(
          "--from", arguments.from,
          "start from the state of a point of a finished study: FOLDER:INDEX, FOLDER:up=VALUE or FOLDER:down=VALUE")
      ->expected(1);
}

}  // namespace epicyclic::app
