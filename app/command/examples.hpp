// Examples of command lines, written once: for --help, the man pages and the reference of the commands.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace epicyclic::app {

struct Example {
  std::string_view purpose;  ///< what it is for
  std::string_view line;     ///< as a shell takes it
};

/// Of a command; none: it has none.
[[nodiscard]] std::vector<Example> examples_of(std::string_view command);

/// "Examples:" and two lines for each, as --help ends; empty if there are none.
[[nodiscard]] std::string examples_text(std::string_view command);

}  // namespace epicyclic::app
