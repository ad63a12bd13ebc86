#include "store/point_store.hpp"

#include <charconv>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/errors.hpp"
#include "store/point_record.hpp"

namespace epicyclic::store {

namespace {

/// All of a record but the Poincare section, as a rule; notes may be longer.
constexpr std::size_t summary_bytes = 2048;

constexpr std::string_view rank_journal_start = "journal.rank-";
constexpr std::string_view rank_journal_end = ".bin";

/// Ranks with a journal in the folder, in order.
std::set<int> ranks_with_journal(const std::filesystem::path& folder) {
  std::set<int> ranks;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(rank_journal_start)) continue;
    int rank = 0;
    std::from_chars(name.data() + rank_journal_start.size(), name.data() + name.size(), rank);
    if (rank > 0 && name == rank_journal_name(rank)) ranks.insert(rank);
  }
  if (error) throw_output_error(folder, "list the folder", error.value());
  return ranks;
}

}  // namespace

std::string rank_journal_name(int rank) { return fmt::format("{}{}{}", rank_journal_start, rank, rank_journal_end); }

PointStore::PointStore(std::filesystem::path folder, std::string identity, std::size_t points, Journal::Use use)
    : folder_(std::move(folder)), identity_(std::move(identity)), use_(use), places_(points) {
  open(folder_ / "journal.bin");
  read_others();
}

void PointStore::read_others() {
  const std::scoped_lock lock(mutex_);
  journals_.resize(1);
  for (Place& place : places_) {
    if (place.journal == 0) continue;
    place = {};
    --size_;
  }
  for (const int rank : ranks_with_journal(folder_)) {
    Journal& journal = open(folder_ / rank_journal_name(rank));
    if (use_ == Journal::Use::append) journal.release();
  }
}

Journal& PointStore::open(const std::filesystem::path& file) {
  if (journals_.size() == journals_max) throw OutputError(folder_.string() + ": holds too many journals");
  journals_.push_back(std::make_unique<Journal>(file, identity_, use_));
  Journal& journal = *journals_.back();
  for (const JournalEntry& entry : journal.entries()) take(journals_.size() - 1, entry);
  journal.forget_entries();
  if (use_ == Journal::Use::append && journal.cut_bytes() > 0) cut_tails_[file] = journal.cut_bytes();
  return journal;
}

void PointStore::take(std::size_t journal, const JournalEntry& entry) {
  if (entry.point >= places_.size())
    throw DamagedData(fmt::format("the journal holds point {}, which the study has not", entry.point));
  Place& known = places_[static_cast<std::size_t>(entry.point)];
  if (known.offset == absent) {
    if (entry.offset >= absent) throw OutputError(folder_.string() + ": the journal is too long");
    known = {static_cast<std::uint16_t>(journal), entry.offset & absent};
    ++size_;
  } else if (journals_[known.journal]->read({entry.point, known.offset}) != journals_[journal]->read(entry)) {
    throw DamagedData(fmt::format("{}: two records of point {} differ", folder_.string(), entry.point));
  }
}

void PointStore::append(const studies::PointResult& result) {
  const JournalEntry entry = journals_.front()->append(result.point.index, encode_point(result));
  const std::scoped_lock lock(mutex_);
  take(0, entry);
}

std::size_t PointStore::size() const {
  const std::scoped_lock lock(mutex_);
  return size_;
}

bool PointStore::holds(std::size_t point) const { return place(point).offset != absent; }

PointStore::Place PointStore::place(std::size_t point) const {
  const std::scoped_lock lock(mutex_);
  return places_.at(point);
}

studies::PointResult PointStore::read(std::size_t point) const {
  const Place at = place(point);
  studies::PointResult result = decode_point(journals_[at.journal]->read({point, at.offset}));
  if (result.point.index != point) throw DamagedData(fmt::format("the record of point {} is of another", point));
  return result;
}

studies::PointSummary PointStore::read_summary(std::size_t point) const {
  const Place at = place(point);
  auto result = decode_point_beginning(journals_[at.journal]->read_beginning({point, at.offset}, summary_bytes));
  if (!result) return read(point);
  if (result->point.index != point) throw DamagedData(fmt::format("the record of point {} is of another", point));
  return *std::move(result);
}

studies::PointSource PointStore::source() const {
  return {places_.size(), [this](std::size_t point) { return read(point); },
          [this](std::size_t point) { return read_summary(point); }};
}

}  // namespace epicyclic::store
