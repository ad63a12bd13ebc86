// The command line: arguments, exit codes, nothing else.

#include <algorithm>
#include <exception>
#include <functional>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <sched.h>

#include "commands.hpp"
#include "core/errors.hpp"
#include "core/instruction_set.hpp"
#include "core/version.hpp"
#include "failure.hpp"
#include "input/study_input.hpp"
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

/// Runs a subcommand; every exception becomes an exit code and one message, whatever the number of ranks.
int guarded(const Ranks& ranks, const std::function<int()>& command) {
  try {
    return command();
  } catch (...) {
    const Failure failure = failure_of(std::current_exception());
    if (ranks.rank() == 0) tell("{}\n", failure.what());
    return failure.exit_code();
  }
}

/// Cores that this process may run on: a launcher may have bound each rank to some.
int own_cores() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  return ::sched_getaffinity(0, sizeof cores, &cores) == 0 ? std::max(1, CPU_COUNT(&cores)) : 1;
}

/// --help, --version and what is wrong with the command line; once, whatever the number of ranks.
int answer(const CLI::App& cli, const CLI::ParseError& asked, const Ranks& ranks) {
  std::ostringstream data, words;
  const int code = cli.exit(asked, data, words) == 0 ? done : bad_input;
  if (ranks.rank() == 0) {
    write_words(words.str());
    write_data(data.str());
  }
  return code;
}

/// The subcommands on the command line.
class Subcommands {
 public:
  /// @param arguments  takes what is parsed; must live longer
  Subcommands(CLI::App& cli, Arguments& arguments) {
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

    gear_ = cli.add_subcommand("gear", "teeth, contact, stiffness, friction, bearings and modes of the stage");
    with_input(gear_);
    with_output(gear_);
    run_point_ = cli.add_subcommand("run", "one operating point: regime, forces, spectra, exponents, orbit, figures");
    with_input(run_point_);
    with_output(run_point_);
    sweep_ = cli.add_subcommand("sweep", "bifurcation diagram along one parameter, up, down or both");
    with_input(sweep_);
    with_output(sweep_);
    map_ = cli.add_subcommand("map", "regimes over two parameters");
    with_input(map_);
    with_output(map_);
    basins_ = cli.add_subcommand("basins", "coexisting attractors over a plane of initial conditions");
    with_input(basins_);
    with_output(basins_);
    tolerance_ =
        cli.add_subcommand("tolerance", "answers against tolerance, clearance smoothing and method, with error bars");
    with_input(tolerance_);
    with_output(tolerance_);
    crosscheck_ = cli.add_subcommand("crosscheck", "the same points by several methods, compared");
    with_input(crosscheck_);
    with_output(crosscheck_);
    for (CLI::App* command : {sweep_, map_, basins_, tolerance_, crosscheck_})
      command->add_option("--threads", arguments.threads, "threads; the results do not depend on it")
          ->check(CLI::Range(1, 4096))
          ->capture_default_str();
    check_ = cli.add_subcommand("check", "validates, prints the resolved input and its cost; writes nothing");
    with_input(check_);
    schema_ = cli.add_subcommand("schema", "the JSON Schema of the input");
  }

  /// Whether the one that was parsed runs on several processes.
  [[nodiscard]] bool share_work() const { return sweep_->parsed() || map_->parsed() || basins_->parsed(); }

  /// Runs the one that was parsed.
  /// @returns its exit code
  [[nodiscard]] int run(const Arguments& arguments) const {
    if (gear_->parsed()) return gear_command(arguments);
    if (run_point_->parsed()) return run_command(arguments);
    if (sweep_->parsed()) return sweep_command(arguments);
    if (map_->parsed()) return map_command(arguments);
    if (basins_->parsed()) return basins_command(arguments);
    if (tolerance_->parsed()) return tolerance_command(arguments);
    if (crosscheck_->parsed()) return crosscheck_command(arguments);
    if (check_->parsed()) return check_command(arguments);
    if (schema_->parsed()) print("{}\n", input::schema_text());
    return static_cast<int>(done);
  }

 private:
  CLI::App *gear_, *run_point_, *sweep_, *map_, *basins_, *tolerance_, *crosscheck_, *check_, *schema_;
};

int run(int argc, char** argv) {
  Ranks ranks;
  CLI::App cli("Nonlinear dynamics of planetary gear trains, with proof.", "epicyclic");
  cli.set_version_flag("--version", version_text);
  cli.require_subcommand(1);
  Arguments arguments;
  arguments.threads = own_cores();
  arguments.ranks = &ranks;

  const Subcommands commands(cli, arguments);
  const int code = guarded(ranks, [&] {
    try {
      cli.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      return answer(cli, e, ranks);
    }
    check_instruction_set_limit();
    if (ranks.size() > 1 && !ranks.connected())
      throw InputError("several processes cannot share the work: this program was built without MPI");
    if (ranks.size() > 1 && !commands.share_work())
      throw InputError("only sweep, map and basins run on several processes");
    return commands.run(arguments);
  });
  if (ranks.size() > 1) leave_ranks(code);
  return code;
}

}  // namespace

}  // namespace epicyclic::app

int main(int argc, char** argv) {
  epicyclic::app::secure_streams();
  return epicyclic::app::run(argc, argv);
}
