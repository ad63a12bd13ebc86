#include "progress.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/atomic_file.hpp"
#include "host.hpp"

namespace epicyclic::app {
namespace {

using std::chrono::milliseconds;

/// A pipe: what was written to its one end can be read from the other without waiting.
class Pipe {
 public:
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_NONBLOCK) != 0) throw std::runtime_error("no pipe");
    read_end_ = FileDescriptor(ends[0]);
    write_end_ = FileDescriptor(ends[1]);
  }
  [[nodiscard]] int write_end() const { return write_end_.get(); }

  std::string text() {
    std::array<char, 4096> block{};
    for (ssize_t count = 0; (count = ::read(read_end_.get(), block.data(), block.size())) > 0;)
      text_.append(block.data(), static_cast<std::size_t>(count));
    return text_;
  }
  std::ptrdiff_t lines() {
    const std::string all = text();
    return std::count(all.begin(), all.end(), '\n');
  }

 private:
  FileDescriptor read_end_;
  FileDescriptor write_end_;
  std::string text_;
};

TEST(Progress, LineTellsDoneTotalRateTimeLeftAndFailures) {
  EXPECT_EQ(progress_line("sweep", {.done = 30, .total = 90, .failed = 2, .rate = 0.5}, 0),
            "sweep 30/90 33.3 %  30/min  2 min 0 s left  2 failed");
  EXPECT_EQ(progress_line("sweep", {.done = 1999, .total = 2000, .failed = 0, .rate = 4}, 10),
            "sweep [#########.] 1999/2000 99.9 %  4/s  0 s left");
  EXPECT_EQ(progress_line("sweep", {.done = 90, .total = 90, .failed = 0, .rate = 0.01}, 0),
            "sweep 90/90 100.0 %  36/h");
  EXPECT_EQ(progress_line("sweep", {}, 0), "sweep 0/0 100.0 %");
}

TEST(Progress, DurationsAreForPeople) {
  EXPECT_EQ(duration_text(-1), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(7500), "2 h 5 min");
  EXPECT_EQ(duration_text(349200), "4 d 1 h");
}

TEST(Progress, PlainLinesComeThoughNothingIsFinished) {
  Pipe pipe;
  Progress progress("sweep", 10, 0, pipe.write_end(), milliseconds(50));
  for (int waited = 0; pipe.lines() < 4 && waited < 2000; ++waited) std::this_thread::sleep_for(milliseconds(10));
  EXPECT_GE(pipe.lines(), 4) << pipe.text();
  progress.finish();
  const auto lines = pipe.lines();
  std::this_thread::sleep_for(milliseconds(200));
  EXPECT_EQ(pipe.lines(), lines) << "none after the end";
}

TEST(Progress, PlainLinesAreAMinuteApart) {
  Pipe pipe;
  Progress progress("sweep", 1000, 3, pipe.write_end());
  EXPECT_EQ(pipe.text(), "sweep 3/1000 0.3 %\n");
  for (std::size_t done = 4; done <= 1000; ++done) progress.update(done, done / 100);
  EXPECT_EQ(pipe.lines(), 1) << pipe.text();
  progress.update(5, 0);  // overtaken
  progress.finish();
  progress.finish();
  EXPECT_EQ(pipe.lines(), 2) << pipe.text();
  EXPECT_NE(pipe.text().find("\nsweep 1000/1000 100.0 %  "), std::string::npos) << pipe.text();
  EXPECT_NE(pipe.text().find("  10 failed  in "), std::string::npos) << pipe.text();
}

TEST(Progress, AHostReceivesTheStateInPlaceOfLines) {
  Pipe pipe;
  Host host;
  std::vector<std::size_t> seen;
  host.progress = [&](const std::string& label, const ProgressState& state) {
    EXPECT_EQ(label, "sweep");
    EXPECT_EQ(state.total, 10U);
    seen.push_back(state.done);
  };
  {
    const HostScope scope(&host);
    EXPECT_EQ(epicyclic::app::host(), &host);
    std::thread([] { EXPECT_EQ(epicyclic::app::host(), nullptr) << "of one thread"; }).join();
    Progress progress("sweep", 10, 2, pipe.write_end());
    std::thread([&] { progress.update(10, 0); }).join();
  }
  EXPECT_EQ(epicyclic::app::host(), nullptr);
  ASSERT_GE(seen.size(), 2U);
  EXPECT_EQ(seen.front(), 2U);
  EXPECT_EQ(seen.back(), 10U);
  EXPECT_EQ(pipe.text(), "");
}

}  // namespace
}  // namespace epicyclic::app
