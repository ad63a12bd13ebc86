// Opening a study's folder and what every subcommand leaves in it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "input/study_input.hpp"
#include "reports/sweep_output.hpp"
#include "store/journal.hpp"
#include "store/output_folder.hpp"
#include "store/provenance.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::app {

/// The input is a study of this very kind.
/// @throws InputError
void require_kind(const input::LoadedInput& input, const Arguments& arguments, std::string_view kind);

/// The plan of a command that takes the points of a sweep too, then with defaults for the rest.
/// @throws InputError for a study of another kind
template <class Plan>
[[nodiscard]] Plan plan_with_points(const input::LoadedInput& input, const Arguments& arguments,
                                    std::string_view command) {
  if (const auto* sweep = input.study.plan.get_if<studies::SweepOptions>()) return {*sweep, {}};
  require_kind(input, arguments, command);
  return input.study.plan.as<Plan>();
}

/// Versions, machine and the names that the input files came by, for run.json.
[[nodiscard]] store::Provenance provenance(int threads, const input::LoadedInput& input);

/// Says on stderr that half a record was cut from the end of a journal; nothing of 0 bytes.
void report_cut_tail(const std::filesystem::path& journal, std::size_t bytes);

/// Points of earlier sessions, from records of the journal.
/// @throws DamagedData when they are of points that the study has not
[[nodiscard]] std::map<std::size_t, studies::PointResult> known_points(const store::Journal& journal,
                                                                       std::span<const store::JournalEntry> entries,
                                                                       const studies::SweepPlan& plan);

/// Says on stderr why a folder cannot be used, of another study, in which values it differs; and which files of a
/// complete study have to be made again.
/// @param quiet  that a study is complete goes without saying
/// @returns the exit code, or nothing if the study may be computed in it
[[nodiscard]] std::optional<int> refuse_or_finish(const store::OutputFolder& folder, const input::LoadedInput& input,
                                                  bool quiet = false);

/// Opens a folder that the processes of parts share; the first of them writes the inputs.
/// @returns the exit code if nothing is to be computed, and says why; as refuse_or_finish()
[[nodiscard]] std::optional<int> enter_shared(store::OutputFolder& folder, const input::LoadedInput& input, bool quiet);

/// Says on stdout that a part is complete.
/// @param already  nothing was computed
/// @param words    what the part has
/// @param facts    for --json
void print_part(const Arguments& arguments, const std::string& folder, bool already, const std::string& words,
                nlohmann::json facts);

/// Parts that have a journal in a folder.
struct PartsOfFolder {
  std::set<store::Part> present;
  std::size_t computed = 0;  ///< results from them
  std::size_t shares = 0;    ///< chains or draws that were dealt to the parts
  std::size_t before = 0;    ///< dealt before these
};

/// Says on stderr how many results parts have computed, and which parts have no journal; nothing without parts.
/// @param there, all  results of the study
void report_parts(const std::string& folder, const PartsOfFolder& parts, std::size_t there, std::size_t all,
                  std::string_view noun);

/// What input.resolved.json holds.
[[nodiscard]] std::string resolved_text(const input::LoadedInput& input);

/// Says on stderr which figures were not drawn.
/// @returns how many of them failed, for run.json: such a study does not end with `done`
[[nodiscard]] std::int64_t report_undrawn(const std::vector<reports::DrawnFigure>& figures);

/// input.json, the stage file as input.stage.json, input.resolved.json.
/// @returns text of the resolved input
/// @throws OutputError
std::string write_inputs(const store::OutputFolder& folder, const input::LoadedInput& input);

}  // namespace epicyclic::app
