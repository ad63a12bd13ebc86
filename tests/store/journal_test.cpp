#include "store/journal.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/errors.hpp"
#include "temporary_folder.hpp"

namespace {

std::atomic<int> flushes{0};
std::atomic<std::thread::id> last_flusher;
std::atomic<bool> disk_fails{false};

}  // namespace

/// In place of the C library's in this program: counts, and fails on request.
extern "C" int fsync(int descriptor) {
  if (disk_fails) {
    errno = EIO;
    return -1;
  }
  const auto result = static_cast<int>(::syscall(SYS_fsync, descriptor));
  last_flusher = std::this_thread::get_id();
  ++flushes;
  return result;
}

namespace epicyclic::store::journal_test {
namespace {

using test::contents;
using test::message_of;
using test::put_file;
using test::TemporaryFolder;

const std::string identity(64, 'a');
const std::string other_identity(64, 'b');
constexpr std::size_t header_size = 84;
constexpr std::size_t overhead = 20;  // of a record: letters, length, point, CRC

/// CRC-32 (ISO-HDLC) bit by bit, as an oracle independent of zlib.
std::uint32_t crc_of(std::string_view bytes) {
  std::uint32_t crc = ~0U;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
  }
  return ~crc;
}

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

std::string text_of(const Journal& journal, const JournalEntry& entry) {
  const std::vector<std::byte> payload = journal.read(entry);
  return {reinterpret_cast<const char*>(payload.data()), payload.size()};
}

const std::vector<std::string> payloads{"first", "", std::string("\0\xff binary", 9), std::string(300, 'z')};

/// A journal of the payloads above, with points 100, 101, ...
void write_example(const std::filesystem::path& path) {
  Journal journal(path, identity);
  for (std::size_t i = 0; i < payloads.size(); ++i) journal.append(100 + i, bytes_of(payloads[i]));
  journal.close();
}

void expect_first_records(const Journal& journal, std::size_t count) {
  ASSERT_EQ(journal.entries().size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(journal.entries()[i].point, 100 + i);
    EXPECT_EQ(text_of(journal, journal.entries()[i]), payloads[i]);
  }
}

TEST(Journal, GivesBackWhatWasAppended) {
  const TemporaryFolder folder;
  write_example(folder / "journal.bin");
  Journal journal(folder / "journal.bin", identity);
  EXPECT_EQ(journal.cut_bytes(), 0U);
  expect_first_records(journal, payloads.size());
}

TEST(Journal, GrowsOverSeveralSessions) {
  const TemporaryFolder folder;
  for (std::uint64_t session = 0; session < 5; ++session) {
    Journal journal(folder / "journal.bin", identity);
    EXPECT_EQ(journal.entries().size(), session);
    journal.append(std::uint64_t{1} << (8 * session), bytes_of("x"));
  }
  EXPECT_EQ(Journal(folder / "journal.bin", identity).entries().back().point, std::uint64_t{1} << 32);
}

TEST(Journal, LayoutIsTheOneDocumented) {
  const TemporaryFolder folder;
  {
    Journal journal(folder / "journal.bin", identity);
    journal.append(0x0102030405060708U, bytes_of("ab"));
  }
  const std::string file = contents(folder / "journal.bin");
  ASSERT_EQ(file.size(), header_size + overhead + 2);
  EXPECT_EQ(file.substr(0, 80), std::string("epicyclic-jn\x08\0\0\0", 16) + identity);
  const std::string record = file.substr(header_size);
  const std::string covered = std::string("EPJR\x02\0\0\0\x08\x07\x06\x05\x04\x03\x02\x01", 16) + "ab";
  EXPECT_EQ(record.substr(0, 18), covered);
  const std::uint32_t crc = crc_of(covered);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(static_cast<unsigned char>(record[18 + i]), (crc >> (8 * i)) & 0xffU);
}

TEST(Journal, TornTailIsCutAtEveryByte) {
  const TemporaryFolder folder;
  const auto path = folder / "journal.bin";
  write_example(path);
  const std::string whole = contents(path);
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    put_file(path, std::string_view(whole).substr(0, length));
    std::size_t good = 0;
    std::size_t end = header_size;
    while (good < payloads.size() && end + overhead + payloads[good].size() <= length) {
      end += overhead + payloads[good++].size();
    }
    {
      Journal journal(path, identity);
      expect_first_records(journal, good);
      EXPECT_EQ(journal.cut_bytes(), length < header_size ? length : length - end) << length;
      EXPECT_EQ(contents(path), whole.substr(0, end)) << length;
      // And life goes on.
      journal.append(7, bytes_of("next"));
    }
    const Journal again(path, identity);
    ASSERT_EQ(again.entries().size(), good + 1) << length;
    EXPECT_EQ(text_of(again, again.entries().back()), "next");
  }
}

TEST(Journal, ZerosOrNoiseAtTheEndAreCut) {
  const TemporaryFolder folder;
  const auto path = folder / "journal.bin";
  write_example(path);
  const std::string whole = contents(path);
  // After a power cut a file system may show the length of an append without its bytes; the letters of a record with a
  // length beyond the file, or beyond all bounds, must not be believed.
  for (const std::string& tail : {std::string(5000, '\0'), std::string("EPJREPJREPJR"),
                                  std::string("EPJR\xff\xff\xff\xff") + std::string(100, 'q'),
                                  std::string("EPJR\x40\0\0\0", 8) + std::string(40, 'q')}) {
    put_file(path, whole + tail);
    const Journal journal(path, identity);
    expect_first_records(journal, payloads.size());
    EXPECT_EQ(journal.cut_bytes(), tail.size());
    EXPECT_EQ(contents(path), whole);
  }
}

TEST(Journal, DamagedLastRecordIsCutAtEveryByte) {
  const TemporaryFolder folder;
  const auto path = folder / "journal.bin";
  write_example(path);
  const std::string whole = contents(path);
  for (std::size_t i = whole.size() - overhead - payloads.back().size(); i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    put_file(path, damaged);
    const Journal journal(path, identity);
    expect_first_records(journal, payloads.size() - 1);
  }
}

TEST(Journal, DamageBeforeGoodRecordsIsRefused) {
  const TemporaryFolder folder;
  const auto path = folder / "journal.bin";
  write_example(path);
  const std::string whole = contents(path);
  const std::size_t last_record = whole.size() - overhead - payloads.back().size();
  for (std::size_t i = 0; i < last_record; ++i) {
    for (const int mask : {0x01, 0x80}) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ mask);
      put_file(path, damaged);
      EXPECT_THROW(Journal(path, identity), DamagedData) << i;
      EXPECT_EQ(contents(path), damaged) << "a refused journal must stay as it is";
    }
  }
}

TEST(Journal, JournalOfAnotherStudyOrFormatIsRefused) {
  const TemporaryFolder folder;
  const auto path = folder / "journal.bin";
  write_example(path);
  std::string message = message_of<DamagedData>([&] { Journal(path, other_identity); });
  EXPECT_NE(message.find("another study"), std::string::npos) << message;

  ASSERT_EQ(crc_of("123456789"), 0xcbf43926U);
  std::string newer = contents(path);
  newer[12] = 9;
  const std::uint32_t crc = crc_of(std::string_view(newer).substr(0, 80));
  for (std::size_t i = 0; i < 4; ++i) newer[80 + i] = static_cast<char>((crc >> (8 * i)) & 0xffU);
  put_file(path, newer);
  message = message_of<DamagedData>([&] { Journal(path, identity); });
  EXPECT_NE(message.find("version 9"), std::string::npos) << message;

  put_file(path, "something else");
  EXPECT_THROW(Journal(path, identity), DamagedData);
  EXPECT_THROW(Journal(path, "short"), std::invalid_argument);
}

TEST(Journal, FullDiskKeepsWhatWasAppendedBefore) {
  const TemporaryFolder folder;
  const auto path = folder / "journal.bin";
  const std::string payload(100, 'p');
  Journal journal(path, identity);
  std::size_t appended = 0;
  {
    const test::FileSizeLimit limit(1000);
    const std::string message = message_of<OutputError>([&] {
      for (;;) {
        journal.append(appended, bytes_of(payload));
        ++appended;
      }
    });
    EXPECT_NE(message.find(path.string()), std::string::npos) << message;
    EXPECT_EQ(appended, (1000 - header_size) / (overhead + payload.size()));
    // A smaller one may still fit.
    journal.append(appended++, bytes_of("s"));
  }
  // Once there is room again, the same journal goes on.
  journal.append(appended++, bytes_of(payload));
  journal.close();
  const Journal again(path, identity);
  EXPECT_EQ(again.cut_bytes(), 0U);
  ASSERT_EQ(again.entries().size(), appended);
  for (std::size_t i = 0; i < appended; ++i) EXPECT_EQ(again.entries()[i].point, i);
}

TEST(Journal, SurvivesKillMinus9) {
  const TemporaryFolder folder;
  const auto path = folder / "journal.bin";
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    Journal journal(path, identity);
    for (std::uint64_t i = 0; i < 50; ++i) journal.append(i, bytes_of("payload"));
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(Journal(path, identity).entries().size(), 50U);
}

TEST(Journal, TakesRecordsFromSeveralThreads) {
  const TemporaryFolder folder;
  const auto path = folder / "journal.bin";
  {
    Journal journal(path, identity);
    std::vector<std::thread> threads;
    for (std::uint64_t t = 0; t < 4; ++t) {
      threads.emplace_back([&journal, t] {
        for (std::uint64_t i = 0; i < 200; ++i) {
          journal.append(1000 * t + i, bytes_of(std::string(static_cast<std::size_t>(i), 'x')));
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  const Journal journal(path, identity);
  ASSERT_EQ(journal.entries().size(), 800U);
  for (const JournalEntry& entry : journal.entries()) EXPECT_EQ(journal.read(entry).size(), entry.point % 1000);
}

TEST(Journal, ReadsWhatWasJustAppendedAndBeginnings) {
  const TemporaryFolder folder;
  Journal journal(folder / "journal.bin", identity);
  std::vector<JournalEntry> entries;
  for (std::size_t i = 0; i < payloads.size(); ++i) entries.push_back(journal.append(i, bytes_of(payloads[i])));
  for (std::size_t i = 0; i < payloads.size(); ++i) {
    EXPECT_EQ(entries[i].point, i);
    EXPECT_EQ(text_of(journal, entries[i]), payloads[i]);
    EXPECT_EQ(journal.read_beginning(entries[i], 3).size(), std::min<std::size_t>(3, payloads[i].size()));
  }
}

TEST(Journal, RecordChangedBehindItsBackIsDamage) {
  const TemporaryFolder folder;
  const auto path = folder / "journal.bin";
  write_example(path);
  const Journal journal(path, identity);
  const JournalEntry& last = journal.entries().back();
  const std::string whole = contents(path);
  for (std::size_t i = last.offset; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    put_file(path, changed);
    EXPECT_THROW((void)journal.read(last), DamagedData) << i;
  }
  put_file(path, std::string_view(whole).substr(0, whole.size() - 1));
  EXPECT_THROW((void)journal.read(last), DamagedData);
}

TEST(Journal, RecordsAndDamageAcrossTheReadersWindow) {
  // Larger than the window that a journal is read through, with the letters of a record everywhere.
  const TemporaryFolder folder;
  const auto path = folder / "journal.bin";
  std::string large;
  while (large.size() < 700'001) large += "EPJREPJ";
  {
    Journal journal(path, identity);
    for (std::uint64_t i = 0; i < 3; ++i) journal.append(i, bytes_of(large));
  }
  const std::string whole = contents(path);
  {
    const Journal journal(path, identity);
    ASSERT_EQ(journal.entries().size(), 3U);
    for (const JournalEntry& entry : journal.entries()) EXPECT_EQ(text_of(journal, entry), large);
  }
  const std::size_t record = overhead + large.size();
  std::string damaged = whole;
  damaged[header_size + record + 300'000] ^= 1;
  put_file(path, damaged);
  EXPECT_THROW(Journal(path, identity), DamagedData);
  damaged = whole;
  damaged[header_size + 2 * record + 300'000] ^= 1;
  put_file(path, damaged);
  EXPECT_EQ(Journal(path, identity).entries().size(), 2U);
}

TEST(Journal, HasOneWriterAtATime) {
  const TemporaryFolder folder;
  const auto path = folder / "journal.bin";
  Journal first(path, identity);
  const JournalEntry entry = first.append(1, bytes_of("x"));
  EXPECT_THROW(Journal(path, identity), JournalInUse);
  first.release();
  EXPECT_THROW(first.append(2, bytes_of("y")), std::logic_error);
  Journal second(path, identity);
  second.append(2, bytes_of("y"));
  EXPECT_EQ(text_of(first, entry), "x");
}

/// What takes this long does not happen, however busy the machine is [s].
constexpr double never = 300.0;

/// Until `condition` holds.
template <typename Condition>
double seconds_until(Condition condition) {
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  while (!condition() && elapsed() < never) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return elapsed();
}

TEST(Journal, LastRecordReachesTheDiskThoughNoneFollowsAndAppendDoesNotWaitForIt) {
  const TemporaryFolder folder;
  Journal journal(folder / "journal.bin", identity);
  for (std::uint64_t group = 0; group < 2; ++group) {
    const int before = flushes;
    journal.append(group, bytes_of("x"));
    EXPECT_LT(seconds_until([&] { return flushes > before; }), never);
    EXPECT_NE(last_flusher.load(), std::this_thread::get_id());
  }
  const int before = flushes;
  journal.close();
  EXPECT_EQ(flushes, before) << "nothing was left to flush";
}

TEST(Journal, RecordsAreFlushedInGroups) {
  const TemporaryFolder folder;
  Journal journal(folder / "journal.bin", identity);
  const int before = flushes;
  std::uint64_t appended = 0;
  const double elapsed = seconds_until([&] {
    journal.append(appended++, bytes_of("x"));
    return flushes >= before + 2;
  });
  EXPECT_LT(elapsed, never);
  EXPECT_GT(elapsed, 1.9) << "two groups, each a second long";
  EXPECT_GT(appended, 2U);
}

/// What a busy machine adds it does not add to each of several tries.
TEST(JournalLong, RecordReachesTheDiskWithinASecond) {
  const TemporaryFolder folder;
  Journal journal(folder / "journal.bin", identity);
  double quickest = never;
  for (std::uint64_t group = 0; group < 10 && quickest > 1.2; ++group) {
    const int before = flushes;
    journal.append(group, bytes_of("x"));
    quickest = std::min(quickest, seconds_until([&] { return flushes > before; }));
  }
  EXPECT_LT(quickest, 1.2);
}

TEST(Journal, FailedFlushIsReportedByAppendSyncAndCloseForGood) {
  const TemporaryFolder folder;
  Journal journal(folder / "journal.bin", identity);
  disk_fails = true;
  journal.append(1, bytes_of("x"));
  EXPECT_THROW(journal.sync(), OutputError);
  disk_fails = false;
  const std::string message = message_of<OutputError>([&] { journal.append(2, bytes_of("y")); });
  EXPECT_NE(message.find("flush to the disk"), std::string::npos) << message;
  EXPECT_THROW(journal.sync(), OutputError);
  EXPECT_THROW(journal.close(), OutputError);
}

TEST(Journal, FlushThatFailsBetweenRecordsStopsTheNextOne) {
  const TemporaryFolder folder;
  Journal journal(folder / "journal.bin", identity);
  disk_fails = true;
  journal.append(1, bytes_of("x"));
  bool refused = false;
  const double elapsed = seconds_until([&] {
    try {
      journal.append(2, bytes_of("y"));
    } catch (const OutputError&) {
      refused = true;
    }
    return refused;
  });
  disk_fails = false;
  EXPECT_TRUE(refused);
  EXPECT_LT(elapsed, never);
}

TEST(Journal, IsReadBesideItsWriterAndChangedByNoReader) {
  const TemporaryFolder folder;
  const auto path = folder / "journal.bin";
  EXPECT_THROW(Journal(path, identity, Journal::Use::read), OutputError);
  EXPECT_FALSE(std::filesystem::exists(path));
  Journal writer(path, identity);
  for (std::size_t i = 0; i < payloads.size(); ++i) writer.append(100 + i, bytes_of(payloads[i]));
  const std::string torn = contents(path) + "EPJR";
  put_file(path, torn);
  Journal first(path, identity, Journal::Use::read);
  const Journal second(path, identity, Journal::Use::read);
  expect_first_records(first, payloads.size());
  expect_first_records(second, payloads.size());
  EXPECT_THROW(first.append(7, bytes_of("more")), std::logic_error);
  EXPECT_EQ(contents(path), torn);
  EXPECT_THROW(Journal(path, other_identity, Journal::Use::read), DamagedData);
}

TEST(Journal, UnusablePathIsAnOutputError) {
  const TemporaryFolder folder;
  EXPECT_THROW(Journal(folder / "no/such/journal.bin", identity), OutputError);
}

TEST(Journal, WhatIsNoFileIsRefusedWithoutWaitingAndLeftThere) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  const auto words = [](const std::filesystem::path& path, Journal::Use use) {
    return test::message_of<DamagedData>([&] { Journal(path, identity, use); });
  };
  for (const Journal::Use use : {Journal::Use::append, Journal::Use::read}) {
    EXPECT_NE(words(folder / "fifo", use).find("is a FIFO"), std::string::npos);
    EXPECT_NE(words(folder.path(), use).find("is a folder"), std::string::npos);
  }
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "fifo"));
}

TEST(Journal, AppendAfterCloseIsALogicError) {
  const TemporaryFolder folder;
  Journal journal(folder / "journal.bin", identity);
  journal.close();
  journal.close();
  EXPECT_THROW(journal.append(1, bytes_of("x")), std::logic_error);
}

}  // namespace
}  // namespace epicyclic::store::journal_test
