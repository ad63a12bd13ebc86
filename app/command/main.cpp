// The command line: arguments, exit codes, nothing else.

#include <algorithm>
#include <exception>
#include <functional>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <sched.h>

#include "claims/claims_commands.hpp"
#include "commands.hpp"
#include "completion.hpp"
#include "core/errors.hpp"
#include "core/instruction_set.hpp"
#include "core/version.hpp"
#include "examples.hpp"
#include "failure.hpp"
#include "input/field_table.hpp"
#include "input/study_input.hpp"
#include "installed_files.hpp"
#include "kind_commands.hpp"
#include "man_pages.hpp"
#include "ranks/ranks.hpp"
#include "stop.hpp"
#include "store/versions.hpp"
#include "streams.hpp"

namespace epicyclic::app {

std::string version_text() {
  std::string text =
      fmt::format("epicyclic {}\ncommit {}\nSIMD {}\n", EPICYCLIC_VERSION, EPICYCLIC_COMMIT, store::simd_level());
  if (const std::string mpi = mpi_version(); !mpi.empty()) text += fmt::format("MPI {}\n", mpi);
  for (const auto& [name, version] : store::dependency_versions()) text += fmt::format("{} {}\n", name, version);
  return text;
}

namespace {

/// Runs a subcommand; every exception becomes an exit code and one message, for any number of ranks.
int guarded(const Ranks& ranks, const std::function<int()>& command) {
  try {
    return command();
  } catch (...) {
    const Failure failure = failure_of(std::current_exception());
    if (ranks.rank() == 0) print_message("{}\n", failure.what());
    return failure.exit_code();
  }
}

/// Cores that this process may run on: a launcher may have bound each rank to some.
int own_cores() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  return ::sched_getaffinity(0, sizeof cores, &cores) == 0 ? std::max(1, CPU_COUNT(&cores)) : 1;
}

/// The command or option that was probably meant by an unknown one; empty if all are known.
std::string probably_meant(const CLI::App& cli, const CLI::ParseError& error) {
  // The remaining words: of the command if one is known, else the first is its name.
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr &&
      dynamic_cast<const CLI::RequiredError*>(&error) == nullptr)
    return {};
  const std::vector<CLI::App*> parsed = cli.get_subcommands();
  const CLI::App& of = parsed.empty() ? cli : *parsed.front();
  std::vector<std::string> names, options;
  if (parsed.empty())
    for (const CLI::App* sub : cli.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(sub->get_name());
  for (const CLI::Option* option : of.get_options())
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  std::string text;
  for (const std::string& word : of.remaining()) {
    const bool is_option = word.starts_with('-');
    const std::string name = is_option ? word.substr(0, word.find('=')) : word;
    if (!is_option && (names.empty() || !text.empty())) continue;
    text += fmt::format("unknown {} '{}'{}\n", is_option ? "option" : "command", name,
                        input::suggestion(name, is_option ? options : names));
  }
  return text;
}

/// --help, --version and errors of the command line; once, for any number of ranks.
int answer(const CLI::App& cli, const CLI::ParseError& error, const Ranks& ranks) {
  std::ostringstream data, words;
  const int code = cli.exit(error, data, words) == 0 ? done : bad_input;
  if (ranks.rank() == 0) {
    const std::string meant = probably_meant(cli, error);
    // For an unknown subcommand, the message that one is required would mislead.
    const bool known = meant.empty() || !cli.get_subcommands().empty();
    write_words(meant + (known ? words.str() : "Run with --help for more information.\n"));
    write_data(data.str());
  }
  return code;
}

int print_schema(const Arguments& /*arguments*/) {
  print("{}\n", input::schema_text());
  return done;
}

void add_threads(CLI::App& command, Arguments& arguments, const char* meaning) {
  command.add_option("--threads", arguments.threads, meaning)->check(CLI::Range(1, 4096))->capture_default_str();
}

void add_check_options(CLI::App& command, Arguments& arguments) {
  command.add_flag("--no-time", arguments.no_time, "do not estimate the time on this machine");
  command.add_flag("--json", arguments.json, "print the resolved input: all keys with their values");
  add_threads(command, arguments, "number of threads to estimate the time for");
}

void add_assert_options(CLI::App& command, Arguments& arguments) {
  command.add_option("FOLDER", arguments.input, "folder of a finished `continue`")->required();
  command.add_option("EXPECTED", arguments.against, "file of its expected points (JSON)")->required();
  command.add_option("--junit", arguments.junit, "write the verdicts to this file as JUnit XML");
  command.add_flag("--json", arguments.json, "print the verdicts as JSON");
  command.add_flag("--record", arguments.record,
                   "write the points of FOLDER to EXPECTED, with twice their error bounds");
}

void add_init_options(CLI::App& command, Arguments& arguments) {
  InitArguments& init = arguments.init;
  command.add_option("FOLDER", arguments.output, "folder for stage.json, speed.json and point.json")->required();
  command.add_flag("--pair", init.pair,
                   "a lone pair of gears: gear 1 is in the place of the sun, gear 2 in that of the planet");
  command
      .add_option("--teeth", init.teeth,
                  "teeth: Z_SUN,Z_PLANET[,Z_RING]; default 21,28,77; default Z_RING = Z_SUN + 2 Z_PLANET")
      ->delimiter(',')
      ->expected(2, 3);
  command.add_option("--module", init.module_mm, "module [mm]; default 3");
  command.add_option("--pressure-angle", init.pressure_angle_deg, "pressure angle [deg]; default 20");
  command
      .add_option("--shifts", init.profile_shifts,
                  "profile shifts X_SUN,X_PLANET,X_RING [-]; default 0,0,0. Both meshes have the same centre distance "
                  "if X_RING = X_SUN + 2 X_PLANET. Of a pair: X_1,X_2")
      ->delimiter(',')
      ->expected(2, 3);
  command.add_option("--helix-angle", init.helix_angle_deg)->group("");  // refused, with the reason
  command.add_option("--width", init.width_mm, "face width [mm]; default 30");
  command.add_option("--planets", init.planets, "number of planets; default 3, or the number of --angles");
  command
      .add_option("--angles", init.angles_deg,
                  "angles of the planets [deg], such as 0,71.25,146.25; default: as equally spaced as assembly allows")
      ->delimiter(',');
  command.add_option("--torque", init.torque_Nm,
                     "torque on the sun [N m]; without it an estimate from module and face width");
  command.add_option("--speed", init.speed_rpm,
                     "rated speed of the sun [rpm]; the sweep is over 0.2 to 1.5 of it. Without it the sweep is over "
                     "mesh frequency ratios from 0.2 to 2");
}

void add_plot_options(CLI::App& command, Arguments& arguments) {
  PlotArguments& plot = arguments.plot;
  command
      .add_option("FOLDER", plot.folders,
                  "folders of finished sweeps, branches, maps or runs, to be drawn in one figure")
      ->required();
  command.add_option("-o,--output", arguments.output, "folder for the figures")->required();
  const auto several = [&](const char* name, std::vector<std::string>& values, const char* meaning) {
    return command.add_option(name, values, meaning)->take_all()->expected(1)->allow_extra_args(false);
  };
  several("--quantity", plot.quantities,
          "column of points.csv, poincare.csv, branch.csv or history.csv; can be repeated");
  several("--label", plot.labels, "label of a folder in the legend, in their order; can be repeated");
  several("--format", plot.formats, "png, svg or pdf; default png and svg; can be repeated")
      ->check(CLI::IsMember({"png", "svg", "pdf"}));
  command.add_option("--x", plot.abscissa, "column of the abscissa, such as sun_speed_rpm; default: the parameter");
  command.add_option("--x-range", plot.x_range, "range of the abscissa, FROM:TO");
  command.add_option("--y-range", plot.y_range, "range of the ordinate, FROM:TO");
  command.add_option("--size", plot.size, "WIDTHxHEIGHT in pixels; default 1800x1100");
  command.add_option("--font", plot.font, "size of the texts; lines and points scale with it")
      ->check(CLI::Range(6.0, 96.0))
      ->capture_default_str();
  command.add_option("--title", plot.title, "title of the figure");
  command.add_flag("--um", plot.micrometres, "draw lengths in micrometres instead of b_c");
  command.add_flag("--log", plot.logarithmic, "draw a logarithmic ordinate");
  command.add_flag("--json", arguments.json, "print the names of the figures as JSON");
}

void add_report_options(CLI::App& command, Arguments& arguments) {
  command.add_option("FOLDER", arguments.report_folders, "folders of studies, to be shown on one page")->required();
  command.add_option("-o,--output", arguments.output,
                     "file for the page (.html); default: report.html in the first FOLDER");
  command.add_flag("--json", arguments.json, "print the name of the page as JSON");
}

void add_merge_options(CLI::App& command, Arguments& arguments) {
  command.add_option("FOLDER", arguments.merged, "folders with parts of the same study")->required();
  command.add_option("-o,--output", arguments.output, "folder for the results")->required();
  command.add_flag("--json", arguments.json, "print the summary as JSON");
  add_threads(command, arguments, "number of threads; the results do not depend on it");
}

void add_serve_options(CLI::App& command, Arguments& arguments) {
  command.add_option("FOLDER", arguments.report_folders, "folders of studies, to be shown on one page")->required();
  command.add_option("--port", arguments.port, "port of 127.0.0.1; default: any that is free")
      ->check(CLI::Range(1, 65535));
  add_threads(command, arguments, "number of threads of a computation; the results do not depend on it");
}

void add_reproduce_options(CLI::App& command, Arguments& arguments) {
  command.get_option("INPUT")->description(
      "claims of a publication: a name in validation/, a folder, or a file (JSON)");
  CLI::Option* record = command.add_flag("--record", arguments.record, "record these verdicts as the expected ones");
  command.add_option(
      "--expected", arguments.expected,
      "file of the expected verdicts, for example of another stage; default: NAME.scorecard.json beside the input");
  add_part_option(command, arguments)->excludes(record);
}

void add_calibrate_options(CLI::App& command, Arguments& /*arguments*/) {
  add_part_refusal(command,
                   "a search has no parts: each generation depends on the one before it, and the islands exchange "
                   "candidates; several processes share a search by MPI");
}

void add_robustness_options(CLI::App& command, Arguments& arguments) { add_part_option(command, arguments); }

void add_word_option(CLI::App& command, Arguments& arguments) {
  command.add_option("WORD", arguments.words,
                     "word in the name or the meaning of a key; with several words: all of them");
}

void add_help_argument(CLI::App& command, Arguments& arguments) {
  command.add_option("COMMAND", arguments.words, "name of a command; none: the list of all");
}

/// Of `help`, which becomes --help.
int no_command(const Arguments& /*arguments*/) { return bug; }

/// All commands, in the order of --help.
std::vector<Command> all_commands() {
  std::vector<Command> all = {
      {"init", "write a stage and two studies from the numbers of a drawing", init_command, Takes::finished,
       add_init_options},
      {"gear", "compute teeth, contact, stiffness, friction, bearings and modes of a stage", gear_command,
       Takes::output},
  };
  std::ranges::transform(kind_commands(), std::back_inserter(all), [](const Command* command) { return *command; });
  const std::vector<Command> others = {
      {"reproduce", "compare the claims of a publication with a stage, and draw its figures", reproduce_command,
       Takes::output, add_reproduce_options},
      {"calibrate", "search for unpublished parameters of a stage that meet the published claims", calibrate_command,
       Takes::output, add_calibrate_options, true},
      {"robustness", "compute for which part of the unpublished parameters each claim holds", robustness_command,
       Takes::output, add_robustness_options, true},
      {"merge", "put parts of a study together, from folders of their own, and compute what is missing", merge_command,
       Takes::finished, add_merge_options},
      {"assert", "compare special points of finished branches with expected ones", assert_command, Takes::finished,
       add_assert_options},
      {"plot", "draw figures of finished studies, several studies in one figure; compute nothing", plot_command,
       Takes::finished, add_plot_options},
      {"report", "write a page of studies for a browser, with diagrams to zoom and points to click; needs no network",
       report_command, Takes::finished, add_report_options},
      {"serve", "show studies in a browser on this machine, while they grow, and compute regions of them finer",
       serve_command, Takes::finished, add_serve_options},
      {"check", "validate an input; state its cost and an estimate of the time; write nothing", check_command,
       Takes::input, add_check_options},
      {"keys", "print the keys of the input with unit, default, bounds and meaning; with WORD only those that have it",
       keys_command, Takes::nothing, add_word_option},
      {"inputs", "list the inputs that come with the program, which INPUT takes by name", inputs_command,
       Takes::nothing},
      {"schema", "print the JSON Schema of the input", print_schema, Takes::nothing},
      {"doctor", "state what is missing on this machine and what that means", doctor_command, Takes::nothing},
      {"help", "print the options of a command, with examples", no_command, Takes::nothing, add_help_argument},
  };
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

/// @param arguments  takes what is parsed; must live longer
/// @returns the command on the command line
CLI::App* add_to(CLI::App& cli, const Command& command, Arguments& arguments) {
  CLI::App* sub = cli.add_subcommand(command.name, command.meaning);
  if (command.takes >= Takes::input) {
    sub->add_option("INPUT", arguments.input, "study or stage file (JSON), or the name of an installed input")
        ->required();
    sub->add_option("--set", arguments.sets, "override one value: /json/pointer=value; can be repeated")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
  }
  if (command.takes >= Takes::output) {
    sub->add_option("-o,--output", arguments.output, "folder for the results; default of an installed input: out/NAME");
    sub->add_flag("--json", arguments.json, "print the summary as JSON");
    add_threads(*sub, arguments, "number of threads; the results do not depend on it");
    sub->add_flag("--report", arguments.report, "also write FOLDER/report.html, as `report` does");
  }
  command.options(*sub, arguments);
  if (command.takes >= Takes::output && sub->get_option_no_throw("--part") == nullptr) add_part_refusal(*sub);
  sub->footer(examples_text(command.name));
  return sub;
}

/// Replaces the name of an installed input by its file, whose results are in out/NAME if no folder is given.
void find_input(const Command& command, Arguments& arguments, bool speaks) {
  if (command.takes != Takes::input && command.takes != Takes::output) return;
  const bool by_name = command.run != reproduce_command;  // which has names of its own
  if (const std::filesystem::path file = by_name ? input_file(arguments.input) : arguments.input;
      file != arguments.input) {
    if (speaks) print_message("input: {}\n", file.string());
    arguments.input = file;
    if (command.takes == Takes::output && arguments.output.empty()) {
      arguments.output = std::filesystem::path("out") / file.stem();
      if (speaks) print_message("results: {}\n", arguments.output.string());
    }
  }
  if (command.takes == Takes::output && arguments.output.empty())
    throw InputError("--output is required: the folder for the results");
}

/// The words of the command line; `help COMMAND` becomes `COMMAND --help`.
std::vector<std::string> words_of(int argc, char** argv, const std::vector<Command>& commands) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty() || words.front() != "help" || words.back() == "--help" || words.back() == "-h") return words;
  words.erase(words.begin());
  // An unknown one is refused as a command.
  if (words.empty() || std::ranges::find(commands, words.front(), &Command::name) != commands.end())
    words.emplace_back("--help");
  return words;
}

int run(int argc, char** argv) {
  Ranks ranks;
  CLI::App cli("Nonlinear dynamics of planetary gear trains, with evidence for each result.", "epicyclic");
  cli.set_version_flag("--version", version_text);
  cli.require_subcommand(1);
  add_claims_kind();
  Arguments arguments;
  if (argc > 0) arguments.called = argv[0];
  arguments.threads = own_cores();
  arguments.ranks = &ranks;

  const std::vector<Command> commands = all_commands();
  std::vector<CLI::App*> parsers;
  for (const Command& command : commands) parsers.push_back(add_to(cli, command, arguments));
  std::vector<std::string> words = words_of(argc, argv, commands);
  if (!words.empty() && words.front() == "__complete") {
    complete(cli, {words.begin() + 1, words.end()});
    return done;
  }
  const int code = guarded(ranks, [&] {
    if (words.size() == 2 && words.front() == "__man") {
      write_man_pages(cli, words.back());
      return int{done};
    }
    try {
      std::ranges::reverse(words);  // as CLI11 takes them
      cli.parse(words);
    } catch (const CLI::ParseError& e) {
      return answer(cli, e, ranks);
    }
    check_instruction_set_limit();
    if (ranks.size() > 1 && !ranks.connected())
      throw InputError("several processes cannot share the work: this program was built without MPI");
    const auto parsed = std::ranges::find_if(parsers, &CLI::App::parsed) - parsers.begin();
    const Command& command = commands.at(static_cast<std::size_t>(parsed));
    if (ranks.size() > 1 && !command.shares_work)
      throw InputError("only sweep, map, basins, calibrate and robustness run on several processes");
    if (ranks.size() > 1 && arguments.part.of > 0) throw InputError("--part: a part is computed by one process");
    find_input(command, arguments, ranks.rank() == 0);
    if (command.writes()) stop_on_signals(ranks.size() > 1 ? patience_of_ranks : patience);
    const int result = command.run(arguments);
    const bool is_complete = result == done || result == done_with_failures;
    if (!arguments.report || !is_complete || ranks.rank() > 0) return result;
    arguments.report_folders = {arguments.output};
    const std::string page = write_report(arguments.report_folders, {}, arguments.threads).string();
    if (arguments.json)
      print_message("open {}\n", page);
    else
      print("open {}\n", page);
    return result;
  });
  if (ranks.size() > 1) leave_ranks(code);
  return code;
}

}  // namespace

}  // namespace epicyclic::app

int main(int argc, char** argv) {
  std::set_terminate(epicyclic::app::end_uncaught);
  epicyclic::app::secure_streams();
  return epicyclic::app::run(argc, argv);
}
