#include "io/output_folder.hpp"

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>

namespace epicyclic::io {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view program_name = "epicyclic";
constexpr std::string_view lock_name = ".lock";
constexpr std::string_view run_name = "run.json";
constexpr int indent = 2;

/// Does the folder hold anything but what opening it may have left there?
bool holds_files(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name != lock_name && !is_temporary_name(name)) return true;
  }
  if (error) throw_output_error(folder, "list the folder", error.value());
  return false;
}

/// Whoever holds the lock knows that no writer of these is alive any more. A failure costs disk space only.
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
bool try_lock(const FileDescriptor& descriptor, const fs::path& path) {
  while (::flock(descriptor.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return false;
    if (errno != EINTR) throw_output_error(path, "lock the folder", errno);
  }
  return true;
}

}  // namespace

std::string_view to_string(FolderOutcome outcome) {
  constexpr std::array<std::string_view, 6> names{"fresh", "resumable", "complete", "other_study", "in_use", "foreign"};
  return names.at(static_cast<std::size_t>(outcome));
}

std::string_view to_string(RunState state) {
  constexpr std::array<std::string_view, 4> names{"running", "stopped", "complete", "failed"};
  return names.at(static_cast<std::size_t>(state));
}

OutputFolder::OutputFolder(fs::path path, std::string identity)
    : path_(std::move(path)), identity_(std::move(identity)) {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw_output_error(path_, "create the folder", error.value());
  outcome_ = open();
  if (outcome_ == FolderOutcome::fresh || outcome_ == FolderOutcome::resumable) remove_temporary_files(path_);
  // At once, so that the study's identity stands before its first file.
  if (outcome_ == FolderOutcome::fresh) write_run(RunState::running, nlohmann::json::object());
}

FolderOutcome OutputFolder::open() {
  // The lock file is looked for last: another process may just be making the folder, and then the lock file is there
  // before any file that is seen here.
  std::error_code ignored;
  if (!is_ours(read_run()) && holds_files(path_) && !fs::exists(file(lock_name), ignored))
    return FolderOutcome::foreign;

  FileDescriptor lock = open_lock_file(file(lock_name));
  const bool locked = try_lock(lock, path_);
  // Under the lock only: before it, the other process may just be writing.
  previous_run_ = read_run();
  if (!locked) return FolderOutcome::in_use;
  if (previous_run_.is_null() && !holds_files(path_)) {
    lock_ = std::move(lock);
    return FolderOutcome::fresh;
  }
  if (!is_ours(previous_run_)) return FolderOutcome::foreign;
  if (previous_run_["identity"] != identity_) return FolderOutcome::other_study;
  lock_ = std::move(lock);
  const bool complete = previous_run_.value("state", nlohmann::json()) == to_string(RunState::complete);
  return complete ? FolderOutcome::complete : FolderOutcome::resumable;
}

/// run.json as it is; null if there is none or it is not JSON (then it is not ours: ours is written atomically).
nlohmann::json OutputFolder::read_run() const {
  const FileDescriptor descriptor = open_descriptor(file(run_name), O_RDONLY);
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
  if (previous_run_.is_object()) {
    nlohmann::json last = previous_run_;
    nlohmann::json sessions = last.value("earlier_sessions", nlohmann::json::array());
    for (const char* key : {"program", "identity", "earlier_sessions"}) last.erase(key);
    sessions.push_back(std::move(last));
    run["earlier_sessions"] = std::move(sessions);
  }
  // The name of an input file need not be UTF-8.
  write_file_atomically(file(run_name), run.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace epicyclic::io
