// The folder that a study writes to (-o DIR): whose it is, who may write to it, and how far the study has come.
//
// run.json holds the identity and the state of the study, together with all volatile facts (see store/provenance.hpp).
// DIR/.lock is locked by flock(2) while an OutputFolder lives; the kernel releases it even on kill -9. The lock file
// stays behind on purpose: removing it would let a second and a third opener lock two different files of that name.
//
// run.json of a complete study holds the manifest of its files too (see store/manifest.hpp). A folder in which one is
// missing, cut or changed is not complete any more: all are made again, from the journal or by the same computation,
// which gives the same bytes. What stood there instead may be somebody's own work and is set aside, never overwritten.
//
// Order of the judgement: a folder with files but neither lock nor run.json is foreign and is not touched; a folder
// locked by another is in use, whatever it holds; only then is run.json read.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/atomic_file.hpp"
#include "store/manifest.hpp"

namespace epicyclic::store {

/// What opening found.
enum class FolderOutcome {
  fresh,        ///< empty or new: ours now, run.json says running
  resumable,    ///< the same study, not complete: ours now, run.json unchanged so far
  complete,     ///< the same study, complete: ours now, nothing to compute
  damaged,      ///< the same study, complete, but not all files are as they were left: ours now, to be made again
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
  /// Of a complete study all files are read; what is not as it was left is set aside, as NAME.changed.
  /// @param identity   SHA-256 of the study (64 hexadecimal digits)
  /// @param can_draw   a picture that could not be drawn before is one that is missing
  /// @throws OutputError when it cannot be created, read or written, or the file system knows no locks; DamagedData
  /// when run.json is no plain file
  OutputFolder(std::filesystem::path path, std::string identity, bool can_draw = false);

  [[nodiscard]] FolderOutcome outcome() const { return outcome_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path file(std::string_view name) const { return path_ / name; }

  /// run.json as found at opening (of another study or process, too); null if there was none.
  [[nodiscard]] const nlohmann::json& previous_run() const { return previous_run_; }

  /// The files of a damaged folder that are not as they were left; none: it is not known which files there were.
  [[nodiscard]] const std::vector<ChangedFile>& changed() const { return changed_; }

  /// The manifest of what other processes have put into the folder.
  void add(const Manifest& files);

  /// Is it still what `path` leads to? A folder that was removed can be written to without an error.
  [[nodiscard]] bool is_there() const;

  /// @throws OutputError when it is not
  void require_there() const;

  /// Writes run.json: state and identity, the facts of this session, and those of the sessions before it; of a complete
  /// study the manifest of all files that were put in place since the folder was opened. What was set aside is removed
  /// then if it is only the beginning of what stands there now.
  /// @throws OutputError      when that fails, the folder is not there any more or one of the files; run.json is then
  ///                          unchanged
  /// @throws std::logic_error when the folder is not ours (outcome other_study, in_use or foreign)
  void write_run(RunState state, const nlohmann::json& facts) const;

 private:
  FolderOutcome open(bool can_draw);
  [[nodiscard]] nlohmann::json read_run() const;
  void set_changed_files_aside();
  [[nodiscard]] nlohmann::json manifest_of_session() const;
  void remove_mere_beginnings() const;

  std::filesystem::path path_;
  std::string identity_;
  FileDescriptor lock_;
  FileDescriptor place_;  ///< the folder itself; not open where that says nothing
  std::unique_ptr<FileRecorder> recorder_;
  std::vector<ChangedFile> changed_;
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> set_aside_;  ///< from, to
  nlohmann::json previous_run_;
  FolderOutcome outcome_ = FolderOutcome::foreign;
};

}  // namespace epicyclic::store
