#include "store/point_store.hpp"

#include <charconv>
#include <filesystem>
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

constexpr std::string_view rank_start = "journal.rank-";
constexpr std::string_view part_start = "journal.part-";
constexpr std::string_view part_middle = "-of-";
constexpr std::string_view journal_end = ".bin";

/// Journals of other processes in a folder, in order.
struct OtherJournals {
  std::set<int> ranks{};
  std::set<Part> parts{};
};

Part part_of(std::string_view name) {
  Part part;
  const char* const end = name.data() + name.size();
  const char* at = std::from_chars(name.data() + part_start.size(), end, part.number).ptr;
  if (std::string_view(at, end).starts_with(part_middle)) std::from_chars(at + part_middle.size(), end, part.of);
  return part;
}

OtherJournals journals_in(const std::filesystem::path& folder) {
  OtherJournals found;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with(rank_start)) {
      int rank = 0;
      std::from_chars(name.data() + rank_start.size(), name.data() + name.size(), rank);
      if (rank > 0 && name == rank_journal_name(rank)) found.ranks.insert(rank);
    } else if (name.starts_with(part_start)) {
      const Part part = part_of(name);
      if (part.of > 0 && name == part_journal_name(part)) found.parts.insert(part);
    }
  }
  if (error) throw_output_error(folder, "list the folder", error.value());
  return found;
}

}  // namespace

std::string rank_journal_name(int rank) { return fmt::format("{}{}{}", rank_start, rank, journal_end); }

std::string part_journal_name(const Part& part) {
  return fmt::format("{}{}{}{}{}", part_start, part.number, part_middle, part.of, journal_end);
}

std::set<Part> parts_in(const std::filesystem::path& folder) { return journals_in(folder).parts; }

PointStore::PointStore(std::filesystem::path folder, std::string identity, std::size_t points, Journal::Use use)
    : folder_(std::move(folder)), identity_(std::move(identity)), use_(use), places_(points) {
  // A folder of parts may have journals of parts alone.
  std::error_code error;
  const OtherJournals others = use_ == Journal::Use::read ? journals_in(folder_) : OtherJournals{};
  if (others.parts.empty() || std::filesystem::exists(folder_ / own_, error)) open(folder_ / own_, use_);
  read_others();
}

PointStore::PointStore(std::filesystem::path folder, std::string identity, std::size_t points, const Part& part)
    : folder_(std::move(folder)),
      identity_(std::move(identity)),
      own_(part_journal_name(part)),
      use_(Journal::Use::read),
      places_(points) {
  open(folder_ / own_, Journal::Use::append);
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
  parts_.clear();
  const auto read = [this](const std::string& name) {
    if (name == own_) return;
    Journal& journal = open(folder_ / name, use_);
    if (use_ == Journal::Use::append) journal.release();
  };
  if (std::error_code error; own_ != "journal.bin" && std::filesystem::exists(folder_ / "journal.bin", error))
    read("journal.bin");
  const OtherJournals others = journals_in(folder_);
  for (const int rank : others.ranks) read(rank_journal_name(rank));
  for (const Part& part : others.parts) {
    const std::string name = part_journal_name(part);
    parts_[part] = name == own_ ? 0 : journals_.size();
    read(name);
  }
}

std::map<Part, std::size_t> PointStore::parts() const {
  std::map<Part, std::size_t> points;
  const std::scoped_lock lock(mutex_);
  std::vector<std::size_t> held(journals_.size());
  for (const Place& place : places_)
    if (place.offset != absent) ++held[place.journal];
  for (const auto& [part, journal] : parts_) points[part] = held.at(journal);
  return points;
}

Journal& PointStore::open(const std::filesystem::path& file, Journal::Use use) {
  if (journals_.size() == journals_max) throw OutputError(folder_.string() + ": holds too many journals");
  journals_.push_back(std::make_unique<Journal>(file, identity_, use));
  Journal& journal = *journals_.back();
  for (const JournalEntry& entry : journal.entries()) take(journals_.size() - 1, entry);
  journal.forget_entries();
  if (use == Journal::Use::append && journal.cut_bytes() > 0) cut_tails_[file] = journal.cut_bytes();
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
