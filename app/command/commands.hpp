// What the command line gives to commands, and the commands that are no kind of study. Each returns an ExitCode.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "store/part.hpp"

namespace epicyclic::input {
struct Drawing;
}

namespace epicyclic::app {

class Ranks;

enum ExitCode : int {
  done = 0,
  done_with_failures = 1,
  bad_input = 2,
  other_study = 3,
  folder_in_use = 4,
  output_failed = 5,
  damaged_data = 7,
  bug = 70,
  stopped_early = 75,
};

/// What the command line gives to `plot`.
struct PlotArguments {
  std::vector<std::filesystem::path> folders;
  std::vector<std::string> quantities, labels, formats;
  std::string abscissa, x_range, y_range, size, title;
  double font = 24;
  bool micrometres = false;
  bool logarithmic = false;
};

/// What the command line gives to `init`, of a drawing.
struct InitArguments {
  bool pair = false;                      ///< a lone pair of gears
  std::vector<int> teeth;                 ///< sun, planet, ring; of a pair: gear 1, gear 2
  std::vector<double> profile_shifts;     ///< likewise
  std::optional<double> helix_angle_deg;  ///< refused, with the reason
  std::optional<double> module_mm{}, pressure_angle_deg{}, width_mm{};
  std::optional<int> planets{};
  std::vector<double> angles_deg{};
  std::optional<double> torque_Nm{}, speed_rpm{};
};

/// What the command line gives to a subcommand.
struct Arguments {
  std::string called = "epicyclic";  ///< the program, as it was called: "epicyclic", "app/run"
  std::filesystem::path input;
  std::filesystem::path output;
  std::vector<std::string> sets;
  int threads = 1;
  bool json = false;
  store::Part part{};                         ///< the share to compute
  std::size_t chains_before = 0;              ///< of a sweep of reproduce: those of earlier sweeps, dealt to parts, too
  std::vector<std::filesystem::path> merged;  ///< of merge: folders with points of this study
  bool report = false;                        ///< write the page of `report` too
  std::vector<std::string> from;              ///< points to start from, of finished studies [finished_study.hpp]
  std::filesystem::path grow;      ///< of sweep, map and basins: a finished study whose points are taken; empty: none
  std::filesystem::path against;   ///< of continue: a sweep's folder; empty: none. Of assert: the expected points' file
  int unexplained = 0;             ///< of continue: changes that may stay so
  std::filesystem::path expected;  ///< of reproduce: file of the verdicts that are expected; empty: beside the input
  std::filesystem::path junit;     ///< of assert: file of the verdicts; empty: none
  bool record = false;             ///< of assert and reproduce: what was found becomes what is expected
  bool no_time = false;            ///< of check: time is not measured
  bool quiet = false;              ///< part of another command: nothing on stdout
  bool figures = true;             ///< of sweep: PNG, SVG and their data are written
  int port = 0;                    ///< of serve; 0: any that is free
  std::vector<std::string> words;  ///< of keys: what the user searches for
  std::vector<std::filesystem::path> report_folders{};  ///< of report and serve
  PlotArguments plot{};
  InitArguments init{};
  Ranks* ranks = nullptr;
};

int assert_command(const Arguments& arguments);
int plot_command(const Arguments& arguments);
int report_command(const Arguments& arguments);

/// Writes the page of studies.
/// @param output  file; empty: report.html in the first folder
/// @returns the file
/// @throws InputError
std::filesystem::path write_report(const std::vector<std::filesystem::path>& folders,
                                   const std::filesystem::path& output, int threads);
int merge_command(const Arguments& arguments);
int serve_command(const Arguments& arguments);
int keys_command(const Arguments& arguments);
int init_command(const Arguments& arguments);
/// What the command line gives to `init`; the name is that of its folder.
[[nodiscard]] input::Drawing drawing_of(const Arguments& arguments);
int gear_command(const Arguments& arguments);
int check_command(const Arguments& arguments);
int inputs_command(const Arguments& arguments);
int doctor_command(const Arguments& arguments);

/// version, commit, dependencies, SIMD in use
[[nodiscard]] std::string version_text();

}  // namespace epicyclic::app
