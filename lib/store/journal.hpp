// The journal: the results of a study so far, safe against kill -9 at any moment.
//
// journal.bin is append-only, little-endian:
//
//   header   "epicyclic-jn" (12 bytes) | format version u32 | identity of the study (64 hex digits) | CRC-32 u32
//   record   "EPJR" (4 bytes) | payload length u32 | point u64 | payload | CRC-32 u32
//
// Each CRC (zlib's) covers all bytes of the header or record before it. The four letters before each record let the
// reader distinguish a torn end from damage. Bytes that are no good record and have no good record after them are left
// by an append that did not finish, and are removed. If a good record follows them, data are damaged, and the journal
// is refused.
//
// A record is handed to the kernel at once, so that it survives the death of the process. A thread of the journal
// flushes new records to the disk within a second, whether more follow or not. A crash of the machine may lose them,
// and they are then computed again. Appending does not wait for the disk.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/atomic_file.hpp"

namespace epicyclic::store {

/// Version of the layout above and of the payloads [store/point_record.cpp]; part of a study's identity.
inline constexpr std::uint32_t journal_format_version = 8;

/// Largest payload of a record [bytes]; a longer length in a file is damage.
inline constexpr std::size_t journal_max_payload = std::size_t{1} << 28;

/// Data on disk that differ from what was written. The message gives the place and a remedy.
class DamagedData : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// open_descriptor() of a file that this program has written. Never waits: a FIFO of that name would do so for ever.
/// @throws DamagedData if it exists and is no plain file, with its type
[[nodiscard]] FileDescriptor open_data_file(const std::filesystem::path& path, int flags);

/// Another process writes to the journal.
class JournalInUse : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Place of a record. Records stay on the disk and are read on request: a journal may be larger than memory.
struct JournalEntry {
  std::uint64_t point = 0;
  std::uint64_t offset = 0;  ///< of the record in the file [bytes]
};

/// An open journal. append(), sync() and reading may be called from several threads. One process at a time appends: the
/// file is locked.
class Journal {
 public:
  enum class Use {
    append,  ///< opens the journal, or creates an empty one; locks it; cuts away a torn tail
    read,    ///< changes nothing, also while another process writes to it
  };

  /// Finds the good records.
  /// @param identity 64 hexadecimal digits: the study whose journal this is
  /// @throws DamagedData           when a damaged record is followed by a good one, the header is damaged, of another
  ///                               format version or of another study
  /// @throws JournalInUse          to append, when another process has it open
  /// @throws OutputError           when the file cannot be created, locked, read or cut; to read, when it is not there
  /// @throws std::invalid_argument when the identity is not of 64 digits
  Journal(std::filesystem::path path, std::string_view identity, Use use = Use::append);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  /// The records found at opening, in the order of appending.
  [[nodiscard]] const std::vector<JournalEntry>& entries() const { return entries_; }

  /// Frees their memory.
  void forget_entries() { entries_ = {}; }

  /// The payload of a record.
  /// @throws DamagedData if the record has changed
  /// @throws OutputError if reading fails, or after close()
  [[nodiscard]] std::vector<std::byte> read(const JournalEntry& entry) const;

  /// The first bytes of a payload, `most` at most, without a check of the CRC of the whole.
  /// @throws as read()
  [[nodiscard]] std::vector<std::byte> read_beginning(const JournalEntry& entry, std::size_t most) const;

  /// Lets another process write to it; after this call, this one only reads.
  void release();

  /// Bytes of a torn tail that were cut away at opening.
  [[nodiscard]] std::size_t cut_bytes() const { return cut_bytes_; }

  /// Appends a record.
  /// @returns where it stands
  /// @throws OutputError           when it cannot be written (disk full included); records appended before stay
  ///                               readable, and once there is room, append() works again. Also when a flush has
  ///                               failed: then for good
  /// @throws std::invalid_argument when the payload is longer than journal_max_payload
  JournalEntry append(std::uint64_t point, std::span<const std::byte> payload);

  /// Flushes new data to the disk.
  /// @throws OutputError if that fails or has failed before
  void sync();

  /// Flushes and closes. The destructor does so too, but cannot report a failure.
  /// @throws OutputError when that fails, or a flush has failed before
  void close();

 private:
  void lock_file() const;
  void flush(std::unique_lock<std::mutex>& lock);
  void commit_groups();
  [[nodiscard]] DamagedData changed(const JournalEntry& entry) const;

  std::filesystem::path path_;
  FileDescriptor descriptor_;
  std::vector<JournalEntry> entries_;
  std::size_t cut_bytes_ = 0;
  std::size_t end_ = 0;     ///< of the last good record [bytes]
  std::size_t synced_ = 0;  ///< of what is on the disk [bytes]
  std::string failure_;     ///< of a flush; empty if there was none
  bool closing_ = false;
  bool released_ = false;
  std::chrono::steady_clock::time_point commit_due_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread committer_;  ///< begins with the first record
};

}  // namespace epicyclic::store
