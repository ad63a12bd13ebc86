// The command line: arguments, exit codes, nothing else.

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>
#include <system_error>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "commands.hpp"
#include "core/errors.hpp"
#include "core/version.hpp"
#include "io/journal.hpp"
#include "io/study_input.hpp"
#include "io/versions.hpp"

namespace epicyclic::app {

std::string version_text() {
  std::string text =
      fmt::format("epicyclic {}\ncommit {}\nSIMD {}\n", EPICYCLIC_VERSION, EPICYCLIC_COMMIT, io::simd_level());
  for (const auto& [name, version] : io::dependency_versions()) text += fmt::format("{} {}\n", name, version);
  return text;
}

namespace {

/// Runs a subcommand; every exception becomes an exit code and one message.
int guarded(const std::function<int()>& command) {
  try {
    const int code = command();
    if (std::fflush(stdout) != 0) throw OutputError("standard output: cannot be written");
    return code;
  } catch (const InputError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return bad_input;
  } catch (const OutputError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return output_failed;
  } catch (const io::DamagedData& e) {
    fmt::print(stderr, "damaged data: {}\n", e.what());
    return damaged_data;
  } catch (const std::system_error& e) {
    fmt::print(stderr, "output: {}\n", e.what());
    return output_failed;
  } catch (const std::exception& e) {
    fmt::print(stderr, "internal error, please report it: {}\n", e.what());
    return bug;
  }
}

int run(int argc, char** argv) {
  CLI::App cli("Nonlinear dynamics of planetary gear trains, with proof.", "epicyclic");
  cli.set_version_flag("--version", version_text);
  cli.require_subcommand(1);
  Arguments arguments;
  arguments.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));

  const auto with_input = [&](CLI::App* command) {
    command->add_option("INPUT", arguments.input, "study or stage file (JSON)")->required();
    command->add_option("--set", arguments.sets, "/json/pointer=value, overrides one value; may be repeated")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
  };
  const auto with_output = [&](CLI::App* command) {
    command->add_option("-o,--output", arguments.output, "folder for the results")->required();
    command->add_flag("--json", arguments.json, "print the summary as JSON");
  };

  CLI::App* gear = cli.add_subcommand("gear", "teeth, contact, stiffness, friction, bearings and modes of the stage");
  with_input(gear);
  with_output(gear);
  CLI::App* run_point =
      cli.add_subcommand("run", "one operating point: regime, forces, spectra, exponents, orbit, figures");
  with_input(run_point);
  with_output(run_point);
  CLI::App* sweep = cli.add_subcommand("sweep", "bifurcation diagram along one parameter, up, down or both");
  with_input(sweep);
  with_output(sweep);
  CLI::App* map = cli.add_subcommand("map", "regimes over two parameters");
  with_input(map);
  with_output(map);
  CLI::App* basins = cli.add_subcommand("basins", "coexisting attractors over a plane of initial conditions");
  with_input(basins);
  with_output(basins);
  CLI::App* tolerance =
      cli.add_subcommand("tolerance", "answers against tolerance, clearance smoothing and method, with error bars");
  with_input(tolerance);
  with_output(tolerance);
  CLI::App* crosscheck = cli.add_subcommand("crosscheck", "the same points by several methods, compared");
  with_input(crosscheck);
  with_output(crosscheck);
  for (CLI::App* command : {sweep, map, basins, tolerance, crosscheck})
    command->add_option("--threads", arguments.threads, "threads; the results do not depend on it")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
  CLI::App* check = cli.add_subcommand("check", "validates, prints the resolved input and its cost; writes nothing");
  with_input(check);
  const CLI::App* schema = cli.add_subcommand("schema", "the JSON Schema of the input");

  try {
    cli.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return cli.exit(e) == 0 ? done : bad_input;
  }
  return guarded([&] {
    if (gear->parsed()) return gear_command(arguments);
    if (run_point->parsed()) return run_command(arguments);
    if (sweep->parsed()) return sweep_command(arguments);
    if (map->parsed()) return map_command(arguments);
    if (basins->parsed()) return basins_command(arguments);
    if (tolerance->parsed()) return tolerance_command(arguments);
    if (crosscheck->parsed()) return crosscheck_command(arguments);
    if (check->parsed()) return check_command(arguments);
    if (schema->parsed()) fmt::print("{}\n", io::schema_text());
    return static_cast<int>(done);
  });
}

}  // namespace

}  // namespace epicyclic::app

int main(int argc, char** argv) {
  // A limit on the size of files is an error of the write, like a full disk, not the end of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  return epicyclic::app::run(argc, argv);
}
