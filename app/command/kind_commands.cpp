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
  command.add_option("--grow", arguments.grow,
                     "folder of a finished smaller study: its points are taken where a fresh computation would "
                     "give the same bytes");
}

void add_start_option(CLI::App& command, Arguments& arguments) {
  command.get_option("INPUT")->required(false)->description(
      "study or stage file (JSON); with --from, without it, the point itself");
  command
      .add_option("--from", arguments.from,
                  "FOLDER:INDEX or FOLDER:up=VALUE (down=VALUE), a point of a finished study: motions start from its "
                  "state")
      ->expected(1);
}

}  // namespace epicyclic::app
