#include "kind_commands.hpp"

#include <charconv>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

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

namespace {

constexpr std::size_t parts_max = 10000;

/// "2/3"
store::Part part_in(const std::string& text) {
  store::Part part;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, part.number);
  if (number.ec == std::errc{} && number.ptr != end && *number.ptr == '/') {
    const auto of = std::from_chars(number.ptr + 1, end, part.of);
    if (of.ec == std::errc{} && of.ptr == end && part.number >= 1 && part.number <= part.of && part.of <= parts_max)
      return part;
  }
  throw CLI::ValidationError("--part",
                             fmt::format("{} is not K/N, with whole numbers 1 <= K <= N <= {}", text, parts_max));
}

}  // namespace

void add_points_options(CLI::App& command, Arguments& arguments) {
  CLI::Option* grow = command.add_option(
      "--grow", arguments.grow,
      "reuse the points of a finished smaller study (its folder) that a new computation would repeat byte for byte");
  add_part_option(command, arguments)->excludes(grow);
}

CLI::Option* add_part_option(CLI::App& command, Arguments& arguments) {
  return command
      .add_option_function<std::string>(
          "--part", [&arguments](const std::string& text) { arguments.part = part_in(text); },
          "compute part K of N, such as 2/8, and no results; afterwards the same command without --part computes what "
          "is missing and writes the results")
      ->excludes(command.get_option("--report"));
}

void add_part_refusal(CLI::App& command, const char* why) {
  command
      .add_option_function<std::string>(
          "--part", [why](const std::string& /*text*/) { throw CLI::ValidationError("--part", why); })
      ->group("");  // not in --help
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
