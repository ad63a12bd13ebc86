// The folder of a study's files (-o DIR): the study that it belongs to, the process that may write to it, and the state
// of the computation.
//
// run.json contains the identity and the state of the study, together with all volatile facts (see
// store/provenance.hpp). DIR/.lock is locked by flock(2) while an OutputFolder lives; the kernel releases it even on
// kill -9. Processes that compute parts of the study share the lock. The lock file is not removed on purpose: else a
// second and a third process could lock two different files of that name.
//
// run.json of a complete study also contains the manifest of its files (see store/manifest.hpp). If a file is missing,
// cut or changed, the folder is no longer complete. All files are then made again, from the journal or by the same
// computation, which gives the same bytes. A changed file may be the user's own work: it is set aside, never
// overwritten.
//
// Order of the checks: a folder with files but neither lock nor run.json is foreign and is not touched. A folder locked
// by another process is in use, whatever it contains. Only then is run.json read.
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

/// Result of opening.
enum class FolderOutcome {
  fresh,        ///< empty or new: ours now, run.json says running
  resumable,    ///< the same study, not complete: ours now, run.json unchanged so far
  complete,     ///< the same study, complete: ours now, nothing to compute
  damaged,      ///< the same study, complete, but not all files are as they were left: ours now, to be made again
  other_study,  ///< another study; nothing was touched
  in_use,       ///< another process has it; nothing was touched
  in_parts,     ///< processes that share it compute in it; nothing was touched
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

/// Who may use a folder at the same time.
enum class FolderUse {
  alone,   ///< nobody else
  shared,  ///< others that share it, too: each writes to a journal of its own, and nothing else
};

class OutputFolder {
 public:
  /// Opens the folder; creates it, parents included, if it is not there; locks it. Unfinished temporary files of a
  /// killed session are removed.
  /// Of a complete study all files are read; what is not as it was left is set aside, as NAME.changed.
  /// @param identity   SHA-256 of the study (64 hexadecimal digits)
  /// @param can_draw   a picture that could not be drawn before is one that is missing
  /// @throws OutputError when it cannot be created, read or written, or the file system knows no locks; DamagedData
  /// when run.json is no plain file
  OutputFolder(std::filesystem::path path, std::string identity, bool can_draw = false,
               FolderUse use = FolderUse::alone);

  [[nodiscard]] FolderOutcome outcome() const { return outcome_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path file(std::string_view name) const { return path_ / name; }

  /// run.json as found at opening (of another study or process, too); null if there was none.
  [[nodiscard]] const nlohmann::json& previous_run() const { return previous_run_; }

  /// The changed files of a damaged folder; none: it is not known which files there were.
  [[nodiscard]] const std::vector<ChangedFile>& changed() const { return changed_; }

  /// Opened to be shared, and nobody else had it: the inputs have to be written, then share() is called.
  [[nodiscard]] bool is_first() const { return use_ == FolderUse::shared && alone_; }

  /// Lets others share it.
  /// @returns false if another process has it for itself by now
  /// @throws OutputError
  [[nodiscard]] bool share();

  /// The manifest of the files that other processes have put into the folder.
  void add(const Manifest& files);

  /// Does `path` still lead to it? A folder that was removed can be written to without an error.
  [[nodiscard]] bool is_there() const;

  /// @throws OutputError when it is not
  void require_there() const;

  /// Writes run.json: state and identity, the facts of this session, and those of earlier sessions. For a complete
  /// study, it adds the manifest of all files that were put in place since the folder was opened. A file that was set
  /// aside is then removed if it is only the beginning of the new one.
  /// @throws OutputError      if that fails, or if the folder or one of the files no longer exists; run.json is then
  /// unchanged
  /// @throws std::logic_error if the folder is not ours (outcome other_study, in_use or foreign)
  void write_run(RunState state, const nlohmann::json& facts) const;

 private:
  FolderOutcome open(bool can_draw);
  [[nodiscard]] FolderOutcome lock(FileDescriptor& descriptor);
  [[nodiscard]] nlohmann::json read_run() const;
  void set_changed_files_aside();
  [[nodiscard]] nlohmann::json manifest_of_session() const;
  void remove_mere_beginnings() const;

  std::filesystem::path path_;
  std::string identity_;
  FolderUse use_;
  bool alone_ = true;
  FileDescriptor lock_;
  FileDescriptor place_;  ///< the folder itself; not open where that says nothing
  std::unique_ptr<FileRecorder> recorder_;
  std::vector<ChangedFile> changed_;
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> set_aside_;  ///< from, to
  nlohmann::json previous_run_;
  FolderOutcome outcome_ = FolderOutcome::foreign;
};

}  // namespace epicyclic::store
