// The folder that a study writes to (-o DIR): whose it is, who may write to it, and how far the study has come.
//
// run.json holds the identity and the state of the study, together with all volatile facts (see io/provenance.hpp).
// DIR/.lock is locked by flock(2) while an OutputFolder lives; the kernel releases it even on kill -9. The lock file
// stays behind on purpose: removing it would let a second and a third opener lock two different files of that name.
//
// Order of the judgement: a folder with files but neither lock nor run.json is foreign and is not touched; a folder
// locked by another is in use, whatever it holds; only then is run.json read.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"

namespace epicyclic::io {

/// What opening found.
enum class FolderOutcome {
  fresh,        ///< empty or new: ours now, run.json says running
  resumable,    ///< the same study, not complete: ours now, run.json unchanged so far
  complete,     ///< the same study, complete: ours now, nothing to compute
  other_study,  ///< another study; nothing was touched
  in_use,       ///< another process has it; nothing was touched
  foreign,      ///< files that are not from this program; nothing was touched
};

/// State of a study in run.json. All but `complete` are resumable.
enum class RunState {
  running,   ///< being computed, or killed in the midst of it
  stopped,   ///< stopped early on purpose
  complete,  ///< each point has its result, be it "failed"
  failed,    ///< ended by an error
};

std::string_view to_string(FolderOutcome outcome);
std::string_view to_string(RunState state);

class OutputFolder {
 public:
  /// Opens the folder; creates it, parents included, if it is not there; locks it. Unfinished temporary files of a
  /// killed session are removed.
  /// @param identity SHA-256 of the study (64 hexadecimal digits)
  /// @throws OutputError when it cannot be created, read or written, or the file system knows no locks
  OutputFolder(std::filesystem::path path, std::string identity);

  [[nodiscard]] FolderOutcome outcome() const { return outcome_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path file(std::string_view name) const { return path_ / name; }

  /// run.json as found at opening (of another study or process, too); null if there was none.
  [[nodiscard]] const nlohmann::json& previous_run() const { return previous_run_; }

  /// Writes run.json: state and identity, the facts of this session, and those of the sessions before it.
  /// @throws OutputError      when that fails; run.json is then unchanged
  /// @throws std::logic_error when the folder is not ours (outcome other_study, in_use or foreign)
  void write_run(RunState state, const nlohmann::json& facts) const;

 private:
  FolderOutcome open();
  [[nodiscard]] nlohmann::json read_run() const;

  std::filesystem::path path_;
  std::string identity_;
  FileDescriptor lock_;
  nlohmann::json previous_run_;
  FolderOutcome outcome_ = FolderOutcome::foreign;
};

}  // namespace epicyclic::io
