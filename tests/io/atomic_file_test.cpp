#include "io/atomic_file.hpp"

#include <cerrno>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::io {
namespace {

using test::contents;
using test::entries;
using test::message_of;
using test::TemporaryFolder;

TEST(AtomicFile, ReplacesTheOldContentsAndLeavesNothingElse) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a.txt", "old");
  write_file_atomically(folder / "a.txt", std::string_view("new\0bytes", 9));
  EXPECT_EQ(contents(folder / "a.txt"), std::string("new\0bytes", 9));
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(AtomicFile, IsInvisibleUntilCommit) {
  const TemporaryFolder folder;
  test::put_file(folder / "a.txt", "old");
  {
    AtomicFile file(folder / "a.txt");
    file.write("half of the ");
    EXPECT_EQ(contents(folder / "a.txt"), "old");
    EXPECT_EQ(entries(folder.path()), 2U);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      EXPECT_NE(is_temporary_name(entry.path().filename().string()), entry.path().filename() == "a.txt");
    }
    file.write("new");
    file.commit();
    EXPECT_EQ(contents(folder / "a.txt"), "half of the new");
  }
  EXPECT_EQ(contents(folder / "a.txt"), "half of the new");
}

TEST(AtomicFile, VanishesWithoutCommit) {
  const TemporaryFolder folder;
  {
    AtomicFile file(folder / "a.txt");
    file.write("half");
    AtomicFile moved(std::move(file));
    moved.write("more");
  }
  EXPECT_EQ(entries(folder.path()), 0U);
}

TEST(AtomicFile, FullDiskLeavesTheOldFileAndNoTemporary) {
  const TemporaryFolder folder;
  const auto path = folder / "a.txt";
  test::put_file(path, "old");
  {
    const test::FileSizeLimit limit(1000);
    const std::string message = message_of<OutputError>([&] { write_file_atomically(path, std::string(5000, 'x')); });
    EXPECT_NE(message.find(path.string()), std::string::npos) << message;
    EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  }
  EXPECT_EQ(contents(path), "old");
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(AtomicFile, NoSpaceIsReportedAsSuch) {
  const FileDescriptor full = open_descriptor("/dev/full", O_WRONLY);
  ASSERT_TRUE(full.is_open());
  const std::string message = message_of<OutputError>([&] { write_all(full.get(), "x", "/dev/full"); });
  EXPECT_EQ(message,
            "/dev/full: cannot write: No space left on device; what was written before is kept: make room and "
            "repeat the command");
}

TEST(AtomicFile, MissingFolderIsAnOutputError) {
  const TemporaryFolder folder;
  const std::string message = message_of<OutputError>([&] { write_file_atomically(folder / "no/such/a.txt", "x"); });
  EXPECT_NE(message.find("No such file or directory"), std::string::npos) << message;
}

TEST(AtomicFile, FolderOfThatNameIsAnOutputErrorAndNoTemporaryStays) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "a.txt");
  const std::string message = message_of<OutputError>([&] { write_file_atomically(folder / "a.txt", "x"); });
  EXPECT_NE(message.find("rename"), std::string::npos) << message;
  EXPECT_EQ(entries(folder.path()), 1U);
}

TEST(AtomicFile, FailedFlushIsAnOutputError) {
  // A pipe cannot be flushed: the only fsync failure that can be had without a broken disk.
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const FileDescriptor read_end(ends[0]);
  const FileDescriptor write_end(ends[1]);
  EXPECT_THROW(sync_descriptor(write_end.get(), "pipe"), OutputError);
}

TEST(AtomicFile, UseAfterCommitIsALogicError) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "a.txt");
  file.commit();
  EXPECT_THROW(file.write("x"), std::logic_error);
  EXPECT_THROW(file.commit(), std::logic_error);
}

TEST(AtomicFile, ReadAllReturnsWhatWasWritten) {
  const TemporaryFolder folder;
  // Longer than the block in which it is read, and no multiple of it.
  const std::string bytes(3'500'001, 'q');
  write_file_atomically(folder / "a.bin", bytes);
  const FileDescriptor file = open_descriptor(folder / "a.bin", O_RDONLY);
  EXPECT_EQ(read_all(file.get(), folder / "a.bin"), bytes);
}

}  // namespace
}  // namespace epicyclic::io
