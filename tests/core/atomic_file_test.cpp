#include "core/atomic_file.hpp"

#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/errors.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::atomic_file_test {
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

TEST(AtomicFile, UnfinishedFilesAreGoneAfterASignalHandlerHasRemovedThem) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a.txt", "old");
  AtomicFile first(folder / "a.txt");
  AtomicFile second(folder / "b.txt");
  AtomicFile moved(std::move(second));
  AtomicFile done(folder / "c.txt");
  done.commit();
  remove_unfinished_files();
  EXPECT_EQ(entries(folder.path()), 2U);
  EXPECT_EQ(contents(folder / "a.txt"), "old");
  EXPECT_THROW(first.commit(), OutputError);
  // More at a time than are listed: all are written.
  std::vector<AtomicFile> many;
  for (int k = 0; k < 200; ++k) many.emplace_back(folder / std::to_string(k));
  for (AtomicFile& file : many) file.commit();
  EXPECT_EQ(entries(folder.path()), 202U);
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

/// A pipe that takes no more; what was written to it is lost.
struct FullPipe {
  FullPipe() {
    int ends[2];
    if (::pipe2(ends, O_NONBLOCK) != 0) throw std::runtime_error("no pipe");
    read_end = FileDescriptor(ends[0]);
    write_end = FileDescriptor(ends[1]);
    const std::string block(4096, 'x');
    while (::write(write_end.get(), block.data(), block.size()) > 0) {
    }
  }
  FileDescriptor read_end;
  FileDescriptor write_end;
};

TEST(AtomicFile, ASlowReaderIsWaitedForAlsoWhereWritingDoesNotWait) {
  FullPipe pipe;
  std::string got;
  std::thread reader([&] {
    std::string block(1 << 16, '\0');
    while (!got.ends_with("the end")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const ssize_t count = ::read(pipe.read_end.get(), block.data(), block.size());
      if (count > 0) got.append(block, 0, static_cast<std::size_t>(count));
    }
  });
  std::string text(300'000, 'y');
  text += "the end";
  write_all(pipe.write_end.get(), text, "pipe");
  reader.join();
  EXPECT_TRUE(got.ends_with(text));
}

TEST(AtomicFile, WordsAreNotWaitedFor) {
  const FullPipe pipe;
  write_without_waiting(pipe.write_end.get(), "lost");
  // Also where writing would wait.
  ASSERT_EQ(::fcntl(pipe.write_end.get(), F_SETFL, 0), 0);
  write_without_waiting(pipe.write_end.get(), "lost");
  write_without_waiting(-1, "lost");
}

TEST(AtomicFile, ALinkLeadsToTheFileThatItStandsFor) {
  const TemporaryFolder folder;
  EXPECT_EQ(linked_file(folder / "new.txt"), folder / "new.txt");
  std::filesystem::create_symlink("second", folder / "first");
  std::filesystem::create_symlink("there.txt", folder / "second");
  EXPECT_EQ(linked_file(folder / "first"), folder / "there.txt");  // though nothing is there yet
  test::put_file(folder / "there.txt", "old");
  EXPECT_EQ(linked_file(folder / "first"), folder / "there.txt");
  std::filesystem::create_symlink("round", folder / "round");
  EXPECT_THROW((void)linked_file(folder / "round"), OutputError);
  EXPECT_THROW((void)linked_file(folder.path()), OutputError);
  EXPECT_THROW((void)linked_file("/dev/null"), OutputError);
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
}  // namespace epicyclic::atomic_file_test
