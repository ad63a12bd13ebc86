// Progress of a long computation, on stderr (stdout belongs to the data).
//
// On a terminal: one line, redrawn at most ten times a second. Elsewhere (a log file, a batch system): a plain line a
// minute and one at the end. A host [host.hpp] receives the state in place of a line. A thread writes the line when it
// is due, so that it comes also while nothing is finished: whoever reads a log sees that the program lives.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

#include "host.hpp"

namespace epicyclic::app {

/// Of a computation that does not know how much it has to do.
inline constexpr std::size_t unknown_total = static_cast<std::size_t>(-1);

/// The contents of a progress line.
struct ProgressState {
  std::size_t done = 0;    ///< units done, those of earlier sessions included
  std::size_t total = 0;   ///< units in all, or unknown_total
  std::size_t failed = 0;  ///< units done, but without a result
  double rate = 0;         ///< units of this session per second; 0 while unknown
  std::string words{};     ///< where things are, last on the line
};

/// The line as text, without line end. `bar_width` is the width of the bar in characters, 0 for none.
std::string progress_line(const std::string& label, const ProgressState& state, int bar_width);

/// A duration for people: "42 s", "3 min 20 s", "2 h 5 min", "4 d 1 h".
std::string duration_text(double seconds);

/// Thread-safe. Failures to write are ignored: nothing depends on the display.
class Progress {
 public:
  /// @param already_done   units that an earlier session has done; they do not count for the rate
  /// @param descriptor     where to write: stderr, but for tests
  /// @param plain_interval between lines where there is no terminal: a minute, but for tests
  Progress(std::string label, std::size_t total, std::size_t already_done = 0, int descriptor = 2,
           std::chrono::milliseconds plain_interval = std::chrono::minutes(1));
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// States how far things are. A call with a smaller `done` than before (threads overtake each other) is ignored.
  void update(std::size_t done, std::size_t failed);

  /// As update(), with words on where things are.
  void update(std::size_t done, std::string words);

  /// The last line, and back to the start of a new one. The destructor does the same.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void draw(Clock::time_point now, bool last);
  void draw_when_due();

  Host* host_ = host();  ///< receives the state in place of a stream
  std::string label_;
  std::size_t already_done_;
  int descriptor_;
  bool terminal_;
  bool finished_ = false;
  ProgressState state_;
  Clock::time_point start_;
  Clock::time_point last_drawn_;
  Clock::duration longest_silence_;
  std::mutex mutex_;
  std::condition_variable over_;
  std::thread drawer_;
};

}  // namespace epicyclic::app
