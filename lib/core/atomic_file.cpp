#include "core/atomic_file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include "core/errors.hpp"
#include "core/placed_files.hpp"

namespace epicyclic {

namespace {

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

/// @returns true when it takes bytes, or would say why not
bool wait_until_writable(int descriptor, int milliseconds) {
  pollfd state{descriptor, POLLOUT, 0};
  int count = 0;
  do {
    count = ::poll(&state, 1, milliseconds);
  } while (count < 0 && errno == EINTR);
  return count > 0;
}

}  // namespace

FileDescriptor& FileDescriptor::operator=(FileDescriptor&& other) noexcept {
  if (this != &other) {
    if (is_open()) ::close(descriptor_);
    descriptor_ = other.release();
  }
  return *this;
}

FileDescriptor::~FileDescriptor() {
  if (is_open()) ::close(descriptor_);
}

int FileDescriptor::release() noexcept { return std::exchange(descriptor_, -1); }

void FileDescriptor::close(const std::filesystem::path& path) {
  if (!is_open()) return;
  // On Linux the descriptor is gone even when close() is interrupted, so that a repetition could hit another file.
  if (::close(release()) != 0 && errno != EINTR) throw_output_error(path, "close the file", errno);
}

std::string_view advice_on(int error) {
  const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  return full ? "; what was written before is kept: make room and repeat the command" : "";
}

void throw_output_error(const std::filesystem::path& path, std::string_view action, int error) {
  throw OutputError(fmt::format("{}: cannot {}: {}{}", path.string(), action, std::generic_category().message(error),
                                advice_on(error)));
}

FileDescriptor open_descriptor(const std::filesystem::path& path, int flags) {
  int descriptor = -1;
  do {
    descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EINTR);
  return FileDescriptor(descriptor);
}

void write_all(int descriptor, std::string_view bytes, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (written == 0) {
      throw_output_error(path, "write", ENOSPC);  // else it would be tried for ever
    } else if (errno == EAGAIN) {
      wait_until_writable(descriptor, /*forever=*/-1);
    } else if (errno != EINTR) {
      throw_output_error(path, "write", errno);
    }
  }
}

void write_at(int descriptor, std::string_view bytes, std::size_t offset, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written > 0) {
      offset += static_cast<std::size_t>(written);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (written == 0 || errno != EINTR) {
      throw_output_error(path, "write", written == 0 ? ENOSPC : errno);
    }
  }
}

std::size_t read_at(int descriptor, const std::filesystem::path& path, std::size_t offset, char* bytes,
                    std::size_t length) {
  std::size_t done = 0;
  while (done < length) {
    const ssize_t got = ::pread(descriptor, bytes + done, length - done, static_cast<off_t>(offset + done));
    if (got == 0) break;
    if (got > 0) {
      done += static_cast<std::size_t>(got);
    } else if (errno != EINTR) {
      throw_output_error(path, "read", errno);
    }
  }
  return done;
}

void write_without_waiting(int descriptor, std::string_view bytes) noexcept {
  while (!bytes.empty() && wait_until_writable(descriptor, /*milliseconds=*/0)) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written == 0 || (written < 0 && errno != EINTR)) return;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string read_all(int descriptor, const std::filesystem::path& path) {
  constexpr std::size_t block = std::size_t{1} << 20;
  std::string text;
  std::size_t size = 0;
  for (;;) {
    // Doubling keeps the number of copies logarithmic for files whose size is not known beforehand.
    if (text.size() - size < block) text.resize(2 * text.size() + block);
    const ssize_t count = ::read(descriptor, text.data() + size, text.size() - size);
    if (count == 0) break;
    if (count > 0) {
      size += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      throw_output_error(path, "read", errno);
    }
  }
  text.resize(size);
  return text;
}

void sync_descriptor(int descriptor, const std::filesystem::path& path) {
  while (::fsync(descriptor) != 0) {
    if (errno != EINTR) throw_output_error(path, "flush to the disk", errno);
  }
}

void rename_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  while (::rename(from.c_str(), to.c_str()) != 0) {
    if (errno != EINTR) throw_output_error(to, "rename a file to this name", errno);
  }
}

void sync_folder(const std::filesystem::path& folder) {
  const FileDescriptor descriptor = open_descriptor(folder, O_RDONLY | O_DIRECTORY);
  if (!descriptor.is_open()) throw_output_error(folder, "open the folder", errno);
  while (::fsync(descriptor.get()) != 0) {
    // Some network and FUSE file systems know no fsync of folders and say EINVAL: nothing more can be done there.
    if (errno == EINVAL) return;
    if (errno != EINTR) throw_output_error(folder, "flush the folder to the disk", errno);
  }
}

void create_folder(const std::filesystem::path& folder, bool parents) {
  std::error_code error;
  do {
    if (parents) {
      std::filesystem::create_directories(folder, error);
    } else {
      std::filesystem::create_directory(folder, error);
    }
  } while (error == std::errc::interrupted);
  if (error) throw_output_error(folder, "create the folder", error.value());
}

bool is_temporary_name(std::string_view file_name) { return file_name.starts_with('.') && file_name.ends_with(".tmp"); }

namespace {

/// Names of temporary files, where a signal handler can read them at any moment: a place is never freed, and changes
/// only while it is neither taken nor being removed.
struct ListPlace {
  enum State : int { free, written, taken, removed };
  std::atomic<int> state{free};
  std::array<char, PATH_MAX> name{};

  bool change(int from, int to) noexcept { return state.compare_exchange_strong(from, to); }
};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

/// Enough for all threads that write at a time. Beyond, a file is not listed and would stay after a signal.
std::array<ListPlace, 64> unfinished;

}  // namespace

void remove_unfinished_files() noexcept {
  for (ListPlace& place : unfinished)
    if (place.change(ListPlace::taken, ListPlace::removed)) ::unlink(place.name.data());
}

AtomicFile::Listed::Listed(const std::filesystem::path& file) noexcept {
  const std::string& name = file.native();
  if (name.size() >= PATH_MAX) return;
  for (std::size_t k = 0; k < unfinished.size() && place_ < 0; ++k)
    if (unfinished[k].change(ListPlace::free, ListPlace::written)) place_ = static_cast<int>(k);
  if (place_ < 0) return;
  ListPlace& place = unfinished[static_cast<std::size_t>(place_)];
  std::memcpy(place.name.data(), name.c_str(), name.size() + 1);
  place.state = ListPlace::taken;
}

AtomicFile::Listed::Listed(Listed&& other) noexcept : place_(std::exchange(other.place_, -1)) {}

AtomicFile::Listed& AtomicFile::Listed::operator=(Listed&& other) noexcept {
  std::swap(place_, other.place_);
  return *this;
}

AtomicFile::Listed::~Listed() {
  if (place_ >= 0) unfinished[static_cast<std::size_t>(place_)].change(ListPlace::taken, ListPlace::free);
}

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  // The process number alone would not do: threads share it, and on a shared disk so may two hosts; O_EXCL decides.
  static std::atomic<unsigned> counter{0};
  do {
    temporary_ =
        folder_of(path_) / fmt::format(".{}.{}.{}.tmp", path_.filename().string(), ::getpid(), counter.fetch_add(1));
    descriptor_ = open_descriptor(temporary_, O_WRONLY | O_CREAT | O_EXCL);
  } while (!descriptor_.is_open() && errno == EEXIST);
  if (!descriptor_.is_open()) throw_output_error(path_, "create the file", errno);
  listed_ = Listed(temporary_);
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::write(std::string_view bytes) {
  if (!descriptor_.is_open()) throw std::logic_error("AtomicFile: write after commit or failure");
  try {
    write_all(descriptor_.get(), bytes, path_);
  } catch (...) {
    discard();
    throw;
  }
}

void AtomicFile::commit() {
  if (!descriptor_.is_open()) throw std::logic_error("AtomicFile: commit after commit or failure");
  try {
    sync_descriptor(descriptor_.get(), path_);
    descriptor_.close(path_);
    rename_file(temporary_, path_);
  } catch (...) {
    discard();
    throw;
  }
  temporary_.clear();
  listed_ = Listed();
  sync_folder(folder_of(path_));
  report_placed(path_);
}

void AtomicFile::discard() noexcept {
  descriptor_ = FileDescriptor();
  // A moved-from or committed file has no temporary name left.
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
  listed_ = Listed();
}

std::filesystem::path linked_file(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path file = path;
  constexpr int most = 40;  // links after one another, as of open(2)
  for (int k = 0; std::filesystem::is_symlink(file, error); ++k) {
    if (k == most) throw_output_error(path, "follow the link", ELOOP);
    const std::filesystem::path target = std::filesystem::read_symlink(file, error);
    if (error) throw_output_error(path, "follow the link", error.value());
    file = folder_of(file) / target;
  }
  const std::filesystem::file_status there = std::filesystem::status(file, error);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
    throw OutputError(path.string() + ": is there and is no file that could be replaced");
  return file;
}

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace epicyclic
