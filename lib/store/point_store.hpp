// The points of a sweep in the journals of its folder. Memory has 8 bytes for each.
//
// journal.bin belongs to this process; journal.rank-1.bin and journal.part-1-of-3.bin and so on belong to other
// processes that took part, now or earlier. A process that computes a part has such a journal as its own. A point does
// not depend on the process that computed it: two records of one point are the same bytes, or one of them is damaged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "store/journal.hpp"
#include "store/part.hpp"
#include "studies/point_source.hpp"

namespace epicyclic::store {

/// Name of the journal of another process than the first.
[[nodiscard]] std::string rank_journal_name(int rank);

/// Name of the journal of a process that computes a part.
[[nodiscard]] std::string part_journal_name(const Part& part);

/// The parts that have a journal in a folder.
/// @throws OutputError if it cannot be listed
[[nodiscard]] std::set<Part> parts_in(const std::filesystem::path& folder);

/// append() and reading may be called from several threads.
class PointStore {
 public:
  /// Opens all journals of the folder; its own is created if need be, the others may be written to by other processes
  /// afterwards.
  /// @param points  of the study
  /// @param use     `read`: of all of them, journal.bin included, nothing is changed
  /// @throws as Journal, and DamagedData when two records of a point differ or one is of a point that the study has not
  PointStore(std::filesystem::path folder, std::string identity, std::size_t points,
             Journal::Use use = Journal::Use::append);

  /// To compute a part: its journal is the process's own; the others are read, while other processes write to them.
  /// @throws as the other, and JournalInUse when another process computes this part
  PointStore(std::filesystem::path folder, std::string identity, std::size_t points, const Part& part);

  /// @throws OutputError when it cannot be written
  void append(const studies::PointResult& result);

  /// Flushes to the disk.
  /// @throws OutputError
  void sync() { journals_.front()->sync(); }

  /// Reads the journals of other processes once more, when these have closed them.
  /// @throws as the constructor
  void read_others();

  /// Bytes of a torn tail that were cut from each journal at its opening; only those that had one.
  [[nodiscard]] const std::map<std::filesystem::path, std::size_t>& cut_tails() const { return cut_tails_; }

  /// The parts that have a journal here, with the number of points that come from it.
  [[nodiscard]] std::map<Part, std::size_t> parts() const;

  [[nodiscard]] std::size_t size() const;  ///< points that are there
  [[nodiscard]] bool holds(std::size_t point) const;

  /// @throws DamagedData when the record is damaged; OutputError when reading fails
  [[nodiscard]] studies::PointResult read(std::size_t point) const;

  /// @throws as read()
  [[nodiscard]] studies::PointSummary read_summary(std::size_t point) const;

  /// For the writers, when all points are there.
  [[nodiscard]] studies::PointSource source() const;

 private:
  /// The place of a record. One machine has fewer processes and bytes than these types hold.
  struct Place {
    std::uint64_t journal : 16 = 0;
    std::uint64_t offset : 48 = absent;
  };
  static constexpr std::size_t journals_max = std::size_t{1} << 16;
  static constexpr std::uint64_t absent = (std::uint64_t{1} << 48) - 1;

  Journal& open(const std::filesystem::path& file, Journal::Use use);
  void take(std::size_t journal, const JournalEntry& entry);
  [[nodiscard]] Place place(std::size_t point) const;

  std::filesystem::path folder_;
  std::string identity_;
  std::string own_ = "journal.bin";
  Journal::Use use_;                                ///< of the journals of others
  std::vector<std::unique_ptr<Journal>> journals_;  ///< the first is our own
  std::map<Part, std::size_t> parts_;               ///< with their journal
  std::vector<Place> places_;                       ///< by point
  std::map<std::filesystem::path, std::size_t> cut_tails_;
  std::size_t size_ = 0;
  mutable std::mutex mutex_;
};

}  // namespace epicyclic::store
