#include "io/journal.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include "core/errors.hpp"

namespace epicyclic::io {

namespace {

constexpr std::string_view file_magic = "epicyclic-jn";
constexpr std::string_view record_magic = "EPJR";
constexpr std::size_t identity_size = 64;
constexpr std::size_t crc_size = 4;
constexpr std::size_t header_size = file_magic.size() + 4 + identity_size + crc_size;
constexpr std::size_t record_head_size = record_magic.size() + 4 + 8;
constexpr std::chrono::seconds commit_interval{1};

template <typename T>
void put(std::string& bytes, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xffU);
}

template <typename T>
T get(std::string_view bytes) {
  T value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) value |= static_cast<T>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  return value;
}

std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string header_bytes(std::string_view identity) {
  std::string bytes(file_magic);
  put(bytes, journal_format_version);
  bytes += identity;
  put(bytes, crc_of(bytes));
  return bytes;
}

/// Size of the good record that starts at `offset`, if there is one.
std::optional<std::size_t> good_record_at(std::string_view bytes, std::size_t offset) {
  const std::string_view rest = bytes.substr(offset);
  if (rest.size() < record_head_size + crc_size || !rest.starts_with(record_magic)) return std::nullopt;
  const std::size_t length = get<std::uint32_t>(rest.substr(record_magic.size()));
  if (length > journal_max_payload || length > rest.size() - record_head_size - crc_size) return std::nullopt;
  const std::size_t covered = record_head_size + length;
  if (get<std::uint32_t>(rest.substr(covered)) != crc_of(rest.substr(0, covered))) return std::nullopt;
  return covered + crc_size;
}

bool good_record_after(std::string_view bytes, std::size_t offset) {
  for (;;) {
    offset = bytes.find(record_magic, offset + 1);
    if (offset == std::string_view::npos) return false;
    if (good_record_at(bytes, offset)) return true;
  }
}

void check_header(std::string_view bytes, std::string_view expected, const std::filesystem::path& path) {
  constexpr std::string_view advice = "restore the file from a copy, or remove it to compute the study anew";
  const std::string_view header = bytes.substr(0, header_size);
  if (header == expected) return;
  if (header.size() < header_size || !header.starts_with(file_magic) ||
      get<std::uint32_t>(header.substr(header_size - crc_size)) != crc_of(header.substr(0, header_size - crc_size))) {
    throw DamagedData(fmt::format("{}: the header is damaged; {}", path.string(), advice));
  }
  const auto version = get<std::uint32_t>(header.substr(file_magic.size()));
  if (version != journal_format_version) {
    throw DamagedData(fmt::format("{}: the journal's format is version {}, this program knows version {}",
                                  path.string(), version, journal_format_version));
  }
  throw DamagedData(fmt::format("{}: the journal belongs to another study ({})", path.string(),
                                header.substr(file_magic.size() + 4, identity_size)));
}

}  // namespace

Journal::Journal(std::filesystem::path path, std::string_view identity) : path_(std::move(path)) {
  if (identity.size() != identity_size) {
    throw std::invalid_argument(fmt::format("Journal: an identity of {} characters, not 64", identity.size()));
  }
  const std::string header = header_bytes(identity);
  descriptor_ = open_descriptor(path_, O_RDWR);
  if (!descriptor_.is_open() && errno != ENOENT) throw_output_error(path_, "open the journal", errno);

  std::string bytes;
  if (descriptor_.is_open()) bytes = read_all(descriptor_.get(), path_);
  if (bytes.size() < header_size && header.starts_with(bytes)) {
    // New, or torn before the first record could be there. Written whole at once, so that a header, once there, is
    // good.
    cut_bytes_ = bytes.size();
    write_file_atomically(path_, header);
    descriptor_ = open_descriptor(path_, O_RDWR);
    if (!descriptor_.is_open()) throw_output_error(path_, "open the journal", errno);
    synced_ = end_ = header_size;
    return;
  }

  check_header(bytes, header, path_);
  end_ = header_size;
  while (const auto size = good_record_at(bytes, end_)) {
    const std::string_view record = std::string_view(bytes).substr(end_, *size);
    const auto payload =
        std::as_bytes(std::span(record)).subspan(record_head_size, *size - record_head_size - crc_size);
    records_.push_back({get<std::uint64_t>(record.substr(record_magic.size() + 4)), {payload.begin(), payload.end()}});
    end_ += *size;
  }
  // What an earlier session left is on the disk by now, or is flushed with the first group.
  synced_ = end_;
  if (end_ == bytes.size()) return;
  if (good_record_after(bytes, end_)) {
    throw DamagedData(
        fmt::format("{}: the record after byte {} ({} good records before it) is damaged, but good ones "
                    "follow; restore the file from a copy, or remove it to compute the study anew",
                    path_.string(), end_, records_.size()));
  }
  cut_bytes_ = bytes.size() - end_;
  if (::ftruncate(descriptor_.get(), static_cast<off_t>(end_)) != 0) {
    throw_output_error(path_, "cut the torn tail of the journal", errno);
  }
  sync_descriptor(descriptor_.get(), path_);
}

Journal::~Journal() {
  try {
    close();
  } catch (...) {
    // A failed flush costs a repetition of the last second's points; close() is there for who wants to know.
  }
}

void Journal::append(std::uint64_t point, std::span<const std::byte> payload) {
  if (payload.size() > journal_max_payload) {
    throw std::invalid_argument(
        fmt::format("Journal: a payload of {} bytes, more than {}", payload.size(), journal_max_payload));
  }
  std::string record;
  record.reserve(record_head_size + payload.size() + crc_size);
  record += record_magic;
  put(record, static_cast<std::uint32_t>(payload.size()));
  put(record, point);
  record.append(reinterpret_cast<const char*>(payload.data()), payload.size());
  put(record, crc_of(record));

  std::unique_lock lock(mutex_);
  if (!descriptor_.is_open()) throw std::logic_error("Journal: append after close");
  if (!failure_.empty()) throw OutputError(failure_);
  std::string_view rest = record;
  // Always at the end of the last good record, not of the file: the rest of a failed append is overwritten.
  std::size_t offset = end_;
  while (!rest.empty()) {
    const ssize_t written = ::pwrite(descriptor_.get(), rest.data(), rest.size(), static_cast<off_t>(offset));
    if (written >= 0) {
      offset += static_cast<std::size_t>(written);
      rest.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      const int error = errno;
      // Tidy, not vital: opening would cut the tail as well.
      [[maybe_unused]] const int ignored = ::ftruncate(descriptor_.get(), static_cast<off_t>(end_));
      throw_output_error(path_, "append to the journal", error);
    }
  }
  const bool first_of_group = synced_ == end_;
  end_ = offset;
  if (!first_of_group) return;
  commit_due_ = std::chrono::steady_clock::now() + commit_interval;
  try {
    if (!committer_.joinable()) committer_ = std::thread([this] { commit_groups(); });
  } catch (const std::system_error&) {
    flush(lock);  // The system gives no more threads: each record is a group of its own.
  }
  changed_.notify_all();
}

void Journal::sync() {
  std::unique_lock lock(mutex_);
  if (descriptor_.is_open()) flush(lock);
}

/// Without the lock while the disk works, so that others may append.
void Journal::flush(std::unique_lock<std::mutex>& lock) {
  if (!failure_.empty()) throw OutputError(failure_);
  if (synced_ == end_) return;
  const std::size_t end = end_;
  const auto begun = std::chrono::steady_clock::now();
  lock.unlock();
  try {
    sync_descriptor(descriptor_.get(), path_);
  } catch (const OutputError& e) {
    lock.lock();
    // After a failed fsync the kernel may have dropped the pages and report success next time: trust it no more.
    failure_ = e.what();
    throw;
  }
  lock.lock();
  synced_ = std::max(synced_, end);
  // What came meanwhile is the next group.
  commit_due_ = begun + commit_interval;
}

void Journal::commit_groups() {
  std::unique_lock lock(mutex_);
  while (failure_.empty()) {
    changed_.wait(lock, [this] { return closing_ || synced_ != end_; });
    changed_.wait_until(lock, commit_due_, [this] { return closing_; });
    if (closing_) return;
    try {
      flush(lock);
    } catch (const OutputError&) {
      // The next append(), sync() or close() reports it.
    }
  }
}

void Journal::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  if (committer_.joinable()) committer_.join();
  std::unique_lock lock(mutex_);
  if (!descriptor_.is_open()) return;
  flush(lock);
  descriptor_.close(path_);
}

}  // namespace epicyclic::io
