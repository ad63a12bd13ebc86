// Files that are either whole or not there.
//
// A result is written under a temporary name in the folder of its final name, flushed to the disk, renamed over the
// final name, and the folder is flushed too. A reader, a crash or a full disk at any moment sees the old file or the
// new one, never a part. The temporary name is `.NAME.PID.N.tmp`; one that a killed process left behind may be removed
// by whoever holds the folder's lock.
//
// Here also stand the few POSIX helpers on which the other writers build: each failed call becomes an OutputError that
// names path, action and reason, and interrupted calls (EINTR) are repeated.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace epicyclic {

/// Owns a POSIX file descriptor; -1 means none.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  FileDescriptor(FileDescriptor&& other) noexcept : descriptor_(other.release()) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor();

  [[nodiscard]] int get() const { return descriptor_; }
  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  int release() noexcept;

  /// Closes it. The destructor closes too, but cannot report a failure.
  /// @throws OutputError when the close fails; `path` names the file in the message
  void close(const std::filesystem::path& path);

 private:
  int descriptor_ = -1;
};

/// Advice for an errno value, as the end of its message: for a lack of space; else empty.
[[nodiscard]] std::string_view advice_on(int error);

/// @throws OutputError always: "PATH: cannot ACTION: REASON", the reason from the errno value `error`, and what to do
/// if it is a lack of room
[[noreturn]] void throw_output_error(const std::filesystem::path& path, std::string_view action, int error);

/// open(2) with O_CLOEXEC, repeated when interrupted; not open, with errno set, when it fails.
FileDescriptor open_descriptor(const std::filesystem::path& path, int flags);

/// Waits for a reader that is slow, also where writing does not wait.
/// @throws OutputError when not all bytes can be written (disk full included)
void write_all(int descriptor, std::string_view bytes, const std::filesystem::path& path);

/// Words that nothing depends on: as much of them as the descriptor takes at once. Async-signal-safe.
void write_without_waiting(int descriptor, std::string_view bytes) noexcept;

/// write_all() at an offset [bytes from the beginning], wherever the descriptor stands.
/// @throws OutputError when not all bytes can be written (disk full included)
void write_at(int descriptor, std::string_view bytes, std::size_t offset, const std::filesystem::path& path);

/// @returns bytes read: fewer than requested only at the file's end
/// @throws OutputError when reading fails
std::size_t read_at(int descriptor, const std::filesystem::path& path, std::size_t offset, char* bytes,
                    std::size_t length);

/// Everything from the current position to the end of the file.
/// @throws OutputError when reading fails
std::string read_all(int descriptor, const std::filesystem::path& path);

/// @throws OutputError when fsync fails
void sync_descriptor(int descriptor, const std::filesystem::path& path);

/// rename(2), repeated when interrupted.
/// @throws OutputError when it fails; `to` is named in the message
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Makes names created, renamed or removed in `folder` durable.
/// @throws OutputError when the folder cannot be opened or flushed
void sync_folder(const std::filesystem::path& folder);

/// Creates the folder, and its parents if they are wanted, where it is not there yet.
/// @throws OutputError when that fails
void create_folder(const std::filesystem::path& folder, bool parents);

/// True of a name that AtomicFile gives to a file in the making.
bool is_temporary_name(std::string_view file_name);

/// Removes the temporary files of all AtomicFiles of this process, for a signal handler that ends it. They are not
/// committed any more. Async-signal-safe.
void remove_unfinished_files() noexcept;

/// A file that appears under its name only when it is complete. Without commit() nothing appears.
class AtomicFile {
 public:
  /// Creates the temporary file; the folder must exist.
  /// @throws OutputError when it cannot be created
  explicit AtomicFile(std::filesystem::path path);
  AtomicFile(AtomicFile&& other) noexcept = default;
  AtomicFile& operator=(AtomicFile&&) = delete;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  /// Appends bytes, unbuffered.
  /// @throws OutputError when they cannot be written; the temporary file is then removed
  void write(std::string_view bytes);

  /// Flushes, closes, renames, flushes the folder.
  /// @throws OutputError when one of these fails; the temporary file is then removed
  void commit();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Path of the file until commit(), for a library that writes by name; empty afterwards.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

 private:
  void discard() noexcept;

  std::filesystem::path path_;
  std::filesystem::path temporary_;
  FileDescriptor descriptor_;

  /// Its place in the list for remove_unfinished_files().
  class Listed {
   public:
    Listed() = default;
    explicit Listed(const std::filesystem::path& file) noexcept;
    Listed(Listed&& other) noexcept;
    Listed& operator=(Listed&& other) noexcept;
    ~Listed();

   private:
    int place_ = -1;
  };
  Listed listed_;
};

/// The file that a name stands for, so that a link leads to what is written as it does to what is read.
/// @throws OutputError for what is there and no file: a folder, a device, a pipe
[[nodiscard]] std::filesystem::path linked_file(const std::filesystem::path& path);

/// Replaces or creates the file `path` with `bytes`, atomically and durably.
/// @throws OutputError when a step fails; what stood under the name before is then unchanged
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace epicyclic
