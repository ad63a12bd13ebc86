// The journal: what a study has computed so far, safe against kill -9 at any moment.
//
// journal.bin is append-only, little-endian:
//
//   header   "epicyclic-jn" (12 bytes) | format version u32 | identity of the study (64 hex digits) | CRC-32 u32
//   record   "EPJR" (4 bytes) | payload length u32 | point u64 | payload | CRC-32 u32
//
// Each CRC (zlib's) covers all bytes of the header or record before it. The four letters before each record let the
// reader tell a torn tail from damage: bytes that are no good record and have no good record after them are the trace
// of an append that did not finish, and are cut away; with a good record after them something that once was good has
// been damaged, and the journal is refused.
//
// A record is handed to the kernel at once (it survives the death of the process) and flushed to the disk at most once
// a second and on close (so much may be lost with the machine, and is then computed again).
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.hpp"

namespace epicyclic::io {

/// Version of the layout above and of the payloads [io/point_record.cpp]; part of a study's identity.
inline constexpr std::uint32_t journal_format_version = 2;

/// Largest payload of a record [bytes]; a longer length in a file is damage.
inline constexpr std::size_t journal_max_payload = std::size_t{1} << 28;

/// Data on disk that are not what was written. The message says where, and what can be done.
class DamagedData : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One record as read back.
struct JournalRecord {
  std::uint64_t point = 0;
  std::vector<std::byte> payload;
};

/// An open journal. append() and sync() may be called from several threads. One process at a time: the folder's lock
/// sees to that.
class Journal {
 public:
  /// Opens the journal, or creates an empty one; reads the good records; cuts away a torn tail.
  /// @param identity 64 hexadecimal digits: the study whose journal this is
  /// @throws DamagedData           when a damaged record is followed by a good one, the header is damaged, of another
  ///                               format version or of another study
  /// @throws OutputError           when the file cannot be created, read or cut
  /// @throws std::invalid_argument when the identity is not of 64 digits
  Journal(std::filesystem::path path, std::string_view identity);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  /// The records found at opening, in the order of appending.
  [[nodiscard]] const std::vector<JournalRecord>& records() const { return records_; }

  /// The same, handed over, so that the memory can be released.
  std::vector<JournalRecord> take_records() { return std::move(records_); }

  /// Bytes of a torn tail that were cut away at opening.
  [[nodiscard]] std::size_t cut_bytes() const { return cut_bytes_; }

  /// Appends a record.
  /// @throws OutputError           when it cannot be written or flushed (disk full included); records appended before
  ///                               stay readable, and after a failed write, once there is room, append() works again
  /// @throws std::invalid_argument when the payload is longer than journal_max_payload
  void append(std::uint64_t point, std::span<const std::byte> payload);

  /// Flushes to the disk what is not yet there.
  /// @throws OutputError when that fails
  void sync();

  /// Flushes and closes. The destructor does so too, but cannot report a failure.
  /// @throws OutputError when that fails
  void close();

 private:
  void sync_unlocked();

  std::filesystem::path path_;
  FileDescriptor descriptor_;
  std::vector<JournalRecord> records_;
  std::size_t cut_bytes_ = 0;
  std::size_t end_ = 0;
  bool unsynced_ = false;
  bool broken_ = false;
  std::chrono::steady_clock::time_point last_sync_;
  std::mutex mutex_;
};

}  // namespace epicyclic::io
