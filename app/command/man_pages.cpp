#include "man_pages.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/atomic_file.hpp"
#include "core/version.hpp"
#include "examples.hpp"

namespace epicyclic::app {

namespace {

/// Text in which roff sees no request and no hyphen of its own.
std::string roff(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\')
      safe += "\\e";
    else if (c == '-')
      safe += "\\-";
    else
      safe += c;
  }
  return safe.starts_with('.') || safe.starts_with('\'') ? "\\&" + safe : safe;
}

std::string sentence(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text.ends_with('.') ? text : text + ".";
}

/// "-o, --output TEXT"
std::string signature(const CLI::Option& option) {
  std::string names;
  if (option.get_positional()) {
    names = "\\fI" + roff(option.get_single_name()) + "\\fR";
  } else {
    for (const std::string& name : option.get_snames()) names += "\\fB\\-" + roff(name) + "\\fR";
    for (const std::string& name : option.get_lnames())
      names += (names.empty() ? "" : ", ") + ("\\fB\\-\\-" + roff(name) + "\\fR");
    // "INT:INT in [1 - 4096]": the range is of no use here, names are: "TEXT:{png,svg,pdf}".
    std::string type = option.get_type_name();
    const std::size_t colon = std::min(type.find(':'), type.size());
    type = type.find('{', colon) == std::string::npos ? type.substr(0, colon) : type.substr(colon + 1);
    if (option.get_items_expected_max() > 0 && !type.empty()) names += " \\fI" + roff(type) + "\\fR";
  }
  return names + (option.get_required() ? " (required)" : "");
}

void add_options(std::string& page, const CLI::App& of, bool positional, const char* title) {
  std::string text;
  for (const CLI::Option* option : of.get_options())
    if (option->get_positional() == positional)
      text += fmt::format(".TP\n{}\n{}\n", signature(*option), roff(sentence(option->get_description())));
  if (!text.empty()) page += fmt::format(".SH {}\n{}", title, text);
}

std::string page_of(const std::string& name, std::string_view meaning, std::string_view synopsis) {
  std::string title = name;
  for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return fmt::format(".TH {} 1 \"\" \"epicyclic {}\" \"epicyclic\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}\n",
                     roff(title), EPICYCLIC_VERSION, roff(name), roff(meaning), synopsis);
}

constexpr const char* exit_codes = R"(.SH EXIT STATUS
0 done; 1 done, but something failed or differs; 2 bad input or command line, nothing written;
3 the folder belongs to another study; 4 the folder is in use; 5 a file could not be written or read;
7 damaged data; 70 an error of the program; 75 stopped by a signal, the same command resumes.
)";

std::string page_of_command(const CLI::App& command) {
  const std::string name = command.get_name();
  std::string synopsis = "\\fBepicyclic " + roff(name) + "\\fR [\\fIOPTIONS\\fR]";
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional()) {
      const std::string word =
          "\\fI" + roff(option->get_single_name()) + "\\fR" + (option->get_items_expected_max() > 1 ? "..." : "");
      synopsis += option->get_required() ? " " + word : " [" + word + "]";
    }
  std::string page = page_of("epicyclic-" + name, command.get_description(), synopsis);
  page += ".SH DESCRIPTION\n" + roff(sentence(command.get_description())) + "\n";
  add_options(page, command, true, "ARGUMENTS");
  add_options(page, command, false, "OPTIONS");
  std::string examples;
  for (const Example& example : examples_of(name))
    examples += fmt::format(".PP\n{}:\n.PP\n.EX\n    {}\n.EE\n", roff(example.purpose), roff(example.line));
  if (!examples.empty()) page += ".SH EXAMPLES\n" + examples;
  return page + exit_codes + ".SH SEE ALSO\n\\fBepicyclic\\fR(1)\n";
}

}  // namespace

void write_man_pages(const CLI::App& cli, const std::filesystem::path& folder) {
  std::string page = page_of("epicyclic", "nonlinear dynamics of planetary gear trains",
                             "\\fBepicyclic\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR] ...");
  page += ".SH DESCRIPTION\n" + roff(cli.get_description()) + "\n.SH COMMANDS\n";
  std::string also;
  for (const CLI::App* command : cli.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string name = "epicyclic-" + command->get_name();
    page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(command->get_name()), roff(sentence(command->get_description())));
    also += fmt::format("{}\\fB{}\\fR(1)", also.empty() ? "" : ",\n", roff(name));
    write_file_atomically(folder / (name + ".1"), page_of_command(*command));
  }
  add_options(page, cli, false, "OPTIONS");
  page += exit_codes;
  page += ".SH FILES\nINPUT can be the name of an installed input; \\fBepicyclic inputs\\fR lists them.\n";
  write_file_atomically(folder / "epicyclic.1", page + ".SH SEE ALSO\n" + also + "\n");
}

}  // namespace epicyclic::app
