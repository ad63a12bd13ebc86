#include "store/journal.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include "core/errors.hpp"

namespace epicyclic::store {

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

/// @param before  CRC of the bytes before these
std::uint32_t crc_of(std::string_view bytes, std::uint32_t before = 0) {
  if (bytes.data() == nullptr) return before;  // which zlib takes for a new start
  return static_cast<std::uint32_t>(::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void put_head(std::string& bytes, std::uint64_t point, std::size_t length) {
  bytes += record_magic;
  put(bytes, static_cast<std::uint32_t>(length));
  put(bytes, point);
}

std::string header_bytes(std::string_view identity) {
  std::string bytes(file_magic);
  put(bytes, journal_format_version);
  bytes += identity;
  put(bytes, crc_of(bytes));
  return bytes;
}

/// A file seen through a window that follows the reader: a journal may be larger than memory.
class FileWindow {
 public:
  FileWindow(int descriptor, const std::filesystem::path& path) : descriptor_(descriptor), path_(path) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) throw_output_error(path, "measure the journal", errno);
    size_ = static_cast<std::size_t>(status.st_size);
  }

  [[nodiscard]] std::size_t size() const { return size_; }

  /// At most `length` bytes, window_size of them, those of the file; valid until the next call.
  std::string_view at(std::size_t offset, std::size_t length) {
    length = std::min({length, window_size, size_ - std::min(offset, size_)});
    if (offset < start_ || offset + length > start_ + bytes_.size()) {
      bytes_.resize(std::min(window_size, size_ - offset));
      bytes_.resize(read_at(descriptor_, path_, offset, bytes_.data(), bytes_.size()));
      start_ = offset;
    }
    return std::string_view(bytes_).substr(offset - start_, length);
  }

  static constexpr std::size_t window_size = std::size_t{1} << 18;

 private:
  int descriptor_;
  const std::filesystem::path& path_;
  std::size_t size_ = 0;
  std::size_t start_ = 0;
  std::string bytes_;
};

/// Size of the good record that starts at `offset`, if there is one.
std::optional<std::size_t> good_record_at(FileWindow& file, std::size_t offset) {
  const std::string_view head = file.at(offset, record_head_size);
  if (head.size() < record_head_size || !head.starts_with(record_magic)) return std::nullopt;
  const std::size_t length = get<std::uint32_t>(head.substr(record_magic.size()));
  const std::size_t rest = file.size() - offset - record_head_size;
  if (length > journal_max_payload || rest < crc_size || length > rest - crc_size) return std::nullopt;
  const std::size_t covered = record_head_size + length;
  std::uint32_t crc = crc_of({});
  for (std::size_t done = 0; done < covered;) {
    const std::string_view part = file.at(offset + done, covered - done);
    if (part.empty()) return std::nullopt;
    crc = crc_of(part, crc);
    done += part.size();
  }
  const std::string_view written = file.at(offset + covered, crc_size);
  if (written.size() < crc_size || get<std::uint32_t>(written) != crc) return std::nullopt;
  return covered + crc_size;
}

bool good_record_after(FileWindow& file, std::size_t offset) {
  for (++offset; offset < file.size();) {
    const std::string_view part = file.at(offset, FileWindow::window_size);
    const std::size_t found = part.find(record_magic);
    if (found != std::string_view::npos) {
      offset += found;
      if (good_record_at(file, offset)) return true;
      ++offset;
    } else {
      // The letters may cross the window's end.
      offset += std::max<std::size_t>(part.size(), record_magic.size()) - (record_magic.size() - 1);
    }
  }
  return false;
}

void check_header(std::string_view header, std::string_view expected, const std::filesystem::path& path) {
  constexpr std::string_view advice = "restore the file from a copy, or remove it to compute the study anew";
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

std::string_view words_of(std::filesystem::file_type type) {
  switch (type) {
    case std::filesystem::file_type::directory:
      return "a folder";
    case std::filesystem::file_type::fifo:
      return "a FIFO (named pipe)";
    case std::filesystem::file_type::socket:
      return "a socket";
    case std::filesystem::file_type::block:
    case std::filesystem::file_type::character:
      return "a device";
    default:
      return "of an unknown kind";
  }
}

}  // namespace

FileDescriptor open_data_file(const std::filesystem::path& path, int flags) {
  std::error_code error;
  const std::filesystem::file_status there = std::filesystem::status(path, error);
  if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
    throw DamagedData(fmt::format("{}: is {}, not a file; remove it, or restore the file from a copy", path.string(),
                                  words_of(there.type())));
  return open_descriptor(path, flags | O_NONBLOCK);
}

Journal::Journal(std::filesystem::path path, std::string_view identity, Use use)
    : path_(std::move(path)), released_(use == Use::read) {
  if (identity.size() != identity_size) {
    throw std::invalid_argument(fmt::format("Journal: an identity of {} characters, not 64", identity.size()));
  }
  const std::string header = header_bytes(identity);
  descriptor_ = open_data_file(path_, released_ ? O_RDONLY : O_RDWR | O_CREAT);
  if (!descriptor_.is_open()) throw_output_error(path_, "open the journal", errno);
  if (!released_) lock_file();
  FileWindow file(descriptor_.get(), path_);
  const std::string start(file.at(0, header_size));
  if (start.size() < header_size && header.starts_with(start)) {
    synced_ = end_ = header_size;
    if (released_) return;  // its writer has just begun
    // New, or torn before the first record could be there. Written whole at once, so that a header, once there, is
    // good.
    cut_bytes_ = start.size();
    write_file_atomically(path_, header);
    descriptor_ = open_descriptor(path_, O_RDWR);
    if (!descriptor_.is_open()) throw_output_error(path_, "open the journal", errno);
    lock_file();
    return;
  }

  check_header(start, header, path_);
  end_ = header_size;
  while (const auto size = good_record_at(file, end_)) {
    const std::string_view head = file.at(end_, record_head_size);
    entries_.push_back({get<std::uint64_t>(head.substr(record_magic.size() + 4)), end_});
    end_ += *size;
  }
  // Data of an earlier session are on the disk by now, or are flushed with the first group.
  synced_ = end_;
  if (end_ == file.size()) return;
  if (good_record_after(file, end_)) {
    throw DamagedData(
        fmt::format("{}: the record after byte {} ({} good records before it) is damaged, but good ones "
                    "follow; restore the file from a copy, or remove it to compute the study anew",
                    path_.string(), end_, entries_.size()));
  }
  if (released_) return;
  cut_bytes_ = file.size() - end_;
  while (::ftruncate(descriptor_.get(), static_cast<off_t>(end_)) != 0) {
    if (errno != EINTR) throw_output_error(path_, "cut the torn tail of the journal", errno);
  }
  sync_descriptor(descriptor_.get(), path_);
}

void Journal::lock_file() const {
  while (::flock(descriptor_.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) throw JournalInUse(fmt::format("{}: is in use by another process", path_.string()));
    if (errno != EINTR) throw_output_error(path_, "lock the journal", errno);
  }
  // Another process may have put its header in place since the file was opened.
  struct stat here {};
  struct stat there {};
  if (::fstat(descriptor_.get(), &here) != 0 || ::stat(path_.c_str(), &there) != 0 || here.st_dev != there.st_dev ||
      here.st_ino != there.st_ino)
    throw JournalInUse(fmt::format("{}: is in use by another process", path_.string()));
}

void Journal::release() {
  const std::lock_guard lock(mutex_);
  released_ = true;
  if (::flock(descriptor_.get(), LOCK_UN) != 0) throw_output_error(path_, "unlock the journal", errno);
}

Journal::~Journal() {
  try {
    close();
  } catch (...) {
    // A failed flush costs a repetition of the last second's points; close() is there for who wants to know.
  }
}

std::vector<std::byte> Journal::read(const JournalEntry& entry) const {
  std::vector<std::byte> payload = read_beginning(entry, journal_max_payload);
  std::string head;
  put_head(head, entry.point, payload.size());
  const std::uint32_t crc = crc_of({reinterpret_cast<const char*>(payload.data()), payload.size()}, crc_of(head));
  std::array<char, crc_size> written{};
  const std::size_t end = static_cast<std::size_t>(entry.offset) + record_head_size + payload.size();
  if (read_at(descriptor_.get(), path_, end, written.data(), crc_size) != crc_size ||
      get<std::uint32_t>({written.data(), crc_size}) != crc)
    throw changed(entry);
  return payload;
}

std::vector<std::byte> Journal::read_beginning(const JournalEntry& entry, std::size_t most) const {
  const auto offset = static_cast<std::size_t>(entry.offset);
  std::array<char, record_head_size> bytes{};
  if (read_at(descriptor_.get(), path_, offset, bytes.data(), bytes.size()) != bytes.size()) throw changed(entry);
  const std::string_view head(bytes.data(), bytes.size());
  const std::size_t length = get<std::uint32_t>(head.substr(record_magic.size()));
  if (!head.starts_with(record_magic) || length > journal_max_payload ||
      get<std::uint64_t>(head.substr(record_magic.size() + 4)) != entry.point)
    throw changed(entry);
  std::vector<std::byte> payload(std::min(length, most));
  if (read_at(descriptor_.get(), path_, offset + record_head_size, reinterpret_cast<char*>(payload.data()),
              payload.size()) != payload.size())
    throw changed(entry);
  return payload;
}

DamagedData Journal::changed(const JournalEntry& entry) const {
  return DamagedData(
      fmt::format("{}: the record after byte {} is not the one that was there before", path_.string(), entry.offset));
}

JournalEntry Journal::append(std::uint64_t point, std::span<const std::byte> payload) {
  if (payload.size() > journal_max_payload) {
    throw std::invalid_argument(
        fmt::format("Journal: a payload of {} bytes, more than {}", payload.size(), journal_max_payload));
  }
  std::string record;
  record.reserve(record_head_size + payload.size() + crc_size);
  put_head(record, point, payload.size());
  record.append(reinterpret_cast<const char*>(payload.data()), payload.size());
  put(record, crc_of(record));

  std::unique_lock lock(mutex_);
  if (!descriptor_.is_open()) throw std::logic_error("Journal: append after close");
  if (released_) throw std::logic_error("Journal: append after release");
  if (!failure_.empty()) throw OutputError(failure_);
  // Always at the end of the last good record, not of the file: the rest of a failed append is overwritten.
  try {
    write_at(descriptor_.get(), record, end_, path_);
  } catch (const OutputError&) {
    // Tidy, not vital: opening would cut the tail as well.
    [[maybe_unused]] const int ignored = ::ftruncate(descriptor_.get(), static_cast<off_t>(end_));
    throw;
  }
  const JournalEntry entry{point, end_};
  const bool first_of_group = synced_ == end_;
  end_ += record.size();
  if (!first_of_group) return entry;
  commit_due_ = std::chrono::steady_clock::now() + commit_interval;
  try {
    if (!committer_.joinable()) committer_ = std::thread([this] { commit_groups(); });
  } catch (const std::system_error&) {
    flush(lock);  // The system gives no more threads: each record is a group of its own.
  }
  changed_.notify_all();
  return entry;
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
  // Records that came meanwhile are the next group.
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

}  // namespace epicyclic::store
