// One command at work in one folder: what they all do before they compute and when they are through.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "commands.hpp"
#include "input/study_input.hpp"
#include "store/output_folder.hpp"
#include "store/provenance.hpp"
#include "watch.hpp"

namespace epicyclic::app {

/// SHA-256 of the study that a command makes of an input.
/// @param judging  version of how its records were judged, if that is what they keep
[[nodiscard]] std::string identity_of(const input::LoadedInput& input, std::string_view command,
                                      std::optional<int> judging = {});

/// Says on stderr what is allowed in the input, but rarely meant.
void print_warnings(const input::LoadedInput& input);

/// Holds the folder while the object lives, and checks that the folder still exists.
class Session {
 public:
  /// Opens the folder; if the study may be computed in it, writes the inputs and run.json, else says why not.
  /// @param threads, ranks  for run.json
  /// @param again           a complete study is no reason to end: its files are made again, and others beside them
  /// @throws OutputError
  Session(const Arguments& arguments, const input::LoadedInput& input, std::string identity, int threads, int ranks = 1,
          bool again = false);

  /// Set where nothing is to be computed: the study is complete, or the folder is not for it.
  [[nodiscard]] std::optional<int> exit_code() const { return exit_code_; }

  [[nodiscard]] store::OutputFolder& folder() { return folder_; }
  [[nodiscard]] const std::string& identity() const { return identity_; }
  /// Text of input.resolved.json.
  [[nodiscard]] const std::string& resolved() const { return resolved_; }

  /// Writes run.json as it stays: when it ended, and the counts.
  /// @param occupancy  of lanes, if there were any
  /// @throws OutputError
  void end(store::RunState state, std::map<std::string, std::int64_t> counts, std::optional<double> occupancy = {});

 private:
  std::string identity_;
  store::OutputFolder folder_;
  std::optional<int> exit_code_;
  store::Provenance facts_;
  std::string resolved_;
  std::unique_ptr<FolderWatch> watch_;
};

}  // namespace epicyclic::app
