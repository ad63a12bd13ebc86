#include "store/output_folder.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include "core/errors.hpp"
#include "store/journal.hpp"

namespace epicyclic::store {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view program_name = "epicyclic";
constexpr std::string_view lock_name = ".lock";
constexpr std::string_view run_name = "run.json";
constexpr const char* files_key = "files";
constexpr int indent = 2;
/// Longer than the first of the processes that share a folder has it for itself: 5 s.
constexpr int share_tries = 250;
constexpr std::chrono::milliseconds share_pause{20};

/// Does the folder contain anything but files that opening may have made?
bool holds_files(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name != lock_name && !is_temporary_name(name)) return true;
  }
  if (error) throw_output_error(folder, "list the folder", error.value());
  return false;
}

/// The holder of the lock knows that no writer of these is alive any more. A failure costs disk space only.
void remove_temporary_files(const fs::path& folder) {
  std::error_code error;
  for (const fs::path& place : {folder, folder / "figures"}) {
    for (fs::directory_iterator entry(place, error), end; !error && entry != end; entry.increment(error)) {
      if (is_temporary_name(entry->path().filename().string())) fs::remove(entry->path(), error);
    }
  }
}

bool is_ours(const nlohmann::json& run) {
  return run.is_object() && run.value("program", nlohmann::json()) == program_name &&
         run.value("identity", nlohmann::json()).is_string();
}

/// Reading suffices for flock on a local disk: so a complete study that we may not write to is still found complete.
FileDescriptor open_lock_file(const fs::path& path) {
  FileDescriptor descriptor = open_descriptor(path, O_RDWR | O_CREAT);
  if (descriptor.is_open()) return descriptor;
  const int error = errno;
  descriptor = open_descriptor(path, O_RDONLY);
  if (!descriptor.is_open()) throw_output_error(path, "create the lock file", error);
  return descriptor;
}

/// @returns false when another holds the lock
bool try_lock(const FileDescriptor& descriptor, const fs::path& path, int kind = LOCK_EX) {
  while (::flock(descriptor.get(), kind | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return false;
    if (errno != EINTR) throw_output_error(path, "lock the folder", errno);
  }
  return true;
}

/// Does `whole` begin with all of the file `beginning`? False if one of them cannot be read.
bool begins_with(const fs::path& whole, const fs::path& beginning) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(beginning, error))) return false;
  std::ifstream first(whole, std::ios::binary);
  std::ifstream second(beginning, std::ios::binary);
  std::vector<char> expected(std::size_t{1} << 16);
  std::vector<char> found(expected.size());
  while (second) {
    second.read(found.data(), static_cast<std::streamsize>(found.size()));
    first.read(expected.data(), second.gcount());
    if (first.gcount() != second.gcount() || !std::equal(found.data(), found.data() + second.gcount(), expected.data()))
      return false;
  }
  return second.eof() && !second.bad();
}

}  // namespace

std::string_view to_string(FolderOutcome outcome) {
  constexpr std::array<std::string_view, 8> names{"fresh",       "resumable", "complete", "damaged",
                                                  "other_study", "in_use",    "in_parts", "foreign"};
  return names.at(static_cast<std::size_t>(outcome));
}

std::string_view to_string(RunState state) {
  constexpr std::array<std::string_view, 4> names{"running", "stopped", "complete", "failed"};
  return names.at(static_cast<std::size_t>(state));
}

OutputFolder::OutputFolder(fs::path path, std::string identity, bool can_draw, FolderUse use)
    : path_(std::move(path)), identity_(std::move(identity)), use_(use) {
  create_folder(path_, /*parents=*/true);
  outcome_ = open(can_draw);
  if (!lock_.is_open()) return;
  place_ = open_descriptor(path_, O_RDONLY | O_DIRECTORY);
  if (!is_there()) place_ = FileDescriptor();  // a file system that numbers its files anew
  recorder_ = std::make_unique<FileRecorder>(path_);
  if (outcome_ == FolderOutcome::complete || !alone_) return;
  remove_temporary_files(path_);
  if (use_ == FolderUse::alone) set_changed_files_aside();
  // At once, so that the study's identity exists before its first file.
  if (outcome_ == FolderOutcome::fresh) write_run(RunState::running, nlohmann::json::object());
}

FolderOutcome OutputFolder::open(bool can_draw) {
  // The lock file is checked last. Another process may be creating the folder, and the lock file then exists before any
  // file that is seen here.
  std::error_code ignored;
  if (!is_ours(read_run()) && holds_files(path_) && !fs::exists(file(lock_name), ignored))
    return FolderOutcome::foreign;

  FileDescriptor lock = open_lock_file(file(lock_name));
  const FolderOutcome locked = this->lock(lock);
  // Under the lock only: before it, the other process may just be writing.
  previous_run_ = read_run();
  if (locked != FolderOutcome::fresh) return locked;
  if (previous_run_.is_null() && !holds_files(path_)) {
    lock_ = std::move(lock);
    return FolderOutcome::fresh;
  }
  if (!is_ours(previous_run_)) return FolderOutcome::foreign;
  if (previous_run_["identity"] != identity_) return FolderOutcome::other_study;
  lock_ = std::move(lock);
  if (previous_run_.value("state", nlohmann::json()) != to_string(RunState::complete)) return FolderOutcome::resumable;
  // Files are checked by who may write them again.
  if (use_ == FolderUse::shared) return FolderOutcome::complete;
  const auto manifest = manifest_from(previous_run_.value(files_key, nlohmann::json()));
  if (!manifest) return FolderOutcome::damaged;
  changed_ = changed_files(path_, *manifest);
  if (!can_draw) std::erase_if(changed_, [](const ChangedFile& file) { return !file.expected; });
  return changed_.empty() ? FolderOutcome::complete : FolderOutcome::damaged;
}

/// @returns in_use or in_parts if others have it, else fresh
FolderOutcome OutputFolder::lock(FileDescriptor& descriptor) {
  if (use_ == FolderUse::alone) {
    if (try_lock(descriptor, path_)) return FolderOutcome::fresh;
    if (!try_lock(descriptor, path_, LOCK_SH)) return FolderOutcome::in_use;
    return FolderOutcome::in_parts;
  }
  // The first of those that share it has it for itself while it writes run.json and the inputs.
  for (int tries = 0; tries < share_tries; ++tries) {
    alone_ = try_lock(descriptor, path_);
    if (alone_) return FolderOutcome::fresh;
    if (try_lock(descriptor, path_, LOCK_SH)) {
      if (is_ours(read_run())) return FolderOutcome::fresh;
      if (::flock(descriptor.get(), LOCK_UN) != 0) throw_output_error(path_, "unlock the folder", errno);
    }
    std::this_thread::sleep_for(share_pause);
  }
  return FolderOutcome::in_use;
}

bool OutputFolder::share() {
  for (int tries = 0; tries < share_tries; ++tries) {
    if (try_lock(lock_, path_, LOCK_SH)) return true;
    std::this_thread::sleep_for(share_pause);
  }
  return false;
}

void OutputFolder::set_changed_files_aside() {
  for (const ChangedFile& file : changed_) {
    const fs::path from = path_ / file.name;
    std::error_code error;
    // Also a link to nowhere, a folder of that name.
    if (fs::symlink_status(from, error).type() == fs::file_type::not_found) continue;
    fs::path to = from;
    to += ".changed";
    for (int number = 2; fs::symlink_status(to, error).type() != fs::file_type::not_found; ++number)
      to = fmt::format("{}.changed-{}", from.string(), number);
    rename_file(from, to);
    set_aside_.emplace_back(from, to);
  }
}

nlohmann::json OutputFolder::manifest_of_session() const {
  const Manifest files = recorder_->files();
  for (const auto& [name, facts] : files) {
    std::error_code error;
    if (facts && fs::file_size(file(name), error) != facts->bytes)
      throw OutputError(
          fmt::format("{}: was removed or changed while the study ran; repeat the command", file(name).string()));
  }
  return to_json(files);
}

void OutputFolder::remove_mere_beginnings() const {
  for (const auto& [from, to] : set_aside_) {
    std::error_code error;
    if (begins_with(from, to)) fs::remove(to, error);
  }
}

void OutputFolder::add(const Manifest& files) { recorder_->add(files); }

bool OutputFolder::is_there() const {
  struct stat here {};
  struct stat there {};
  if (!place_.is_open() || ::fstat(place_.get(), &here) != 0) return true;
  if (::stat(path_.c_str(), &there) != 0) return errno != ENOENT && errno != ENOTDIR && errno != ESTALE;
  return here.st_dev == there.st_dev && here.st_ino == there.st_ino;
}

void OutputFolder::require_there() const {
  if (!is_there())
    throw OutputError(fmt::format("{}: the folder was removed or moved while the study ran", path_.string()));
}

/// run.json as it is; null if there is none or it is not JSON (then it is not ours: ours is written atomically).
nlohmann::json OutputFolder::read_run() const {
  const FileDescriptor descriptor = open_data_file(file(run_name), O_RDONLY);
  if (!descriptor.is_open()) {
    if (errno != ENOENT) throw_output_error(file(run_name), "open", errno);
    return nullptr;
  }
  nlohmann::json run =
      nlohmann::json::parse(read_all(descriptor.get(), file(run_name)), nullptr, /*allow_exceptions=*/false);
  return run.is_discarded() ? nlohmann::json() : run;
}

void OutputFolder::write_run(RunState state, const nlohmann::json& facts) const {
  if (!lock_.is_open()) throw std::logic_error("OutputFolder: write_run to a folder that is not ours");
  nlohmann::json run = facts;
  run["program"] = program_name;
  run["identity"] = identity_;
  run["state"] = to_string(state);
  require_there();
  if (state == RunState::complete) run[files_key] = manifest_of_session();
  if (previous_run_.is_object()) {
    nlohmann::json last = previous_run_;
    nlohmann::json sessions = last.value("earlier_sessions", nlohmann::json::array());
    for (const char* key : {"program", "identity", "earlier_sessions", files_key}) last.erase(key);
    sessions.push_back(std::move(last));
    run["earlier_sessions"] = std::move(sessions);
  }
  // The name of an input file need not be UTF-8.
  write_file_atomically(file(run_name), run.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  if (state == RunState::complete) remove_mere_beginnings();
}

}  // namespace epicyclic::store
