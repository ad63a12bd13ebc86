#include "progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "core/atomic_file.hpp"

namespace epicyclic::app {

namespace {

/// Shortest time between two lines on a terminal, and the longest, after which the remaining time is counted down.
constexpr std::chrono::milliseconds terminal_interval{100};
constexpr std::chrono::seconds terminal_silence{1};
constexpr int widest_bar = 30;
constexpr int default_terminal_width = 80;

bool is_terminal(int descriptor) {
  const char* kind = std::getenv("TERM");
  return ::isatty(descriptor) == 1 && (kind == nullptr || std::string_view(kind) != "dumb");
}

int terminal_width(int descriptor) {
  winsize size{};
  return ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : default_terminal_width;
}

std::string rate_text(double rate) {
  if (rate >= 1) return fmt::format("{:.3g}/s", rate);
  if (rate * 60 >= 1) return fmt::format("{:.3g}/min", rate * 60);
  return fmt::format("{:.3g}/h", rate * 3600);
}

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::llround(std::max(0.0, seconds)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  if (whole < 86400) return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
  return fmt::format("{} d {} h", whole / 86400, whole / 3600 % 24);
}

std::string progress_line(const std::string& label, const ProgressState& state, int bar_width) {
  const double share =
      state.total > 0 ? std::min(1.0, static_cast<double>(state.done) / static_cast<double>(state.total)) : 1.0;
  std::string line = label;
  if (state.total == unknown_total) {
    line += fmt::format(" {}", state.done);
    if (state.rate > 0) line += "  " + rate_text(state.rate);
    return state.words.empty() ? line : line + "  " + state.words;
  }
  if (bar_width > 0) {
    const auto filled = static_cast<std::size_t>(share * bar_width);
    line += fmt::format(" [{}{}]", std::string(filled, '#'),
                        std::string(static_cast<std::size_t>(bar_width) - filled, '.'));
  }
  // Rounded down, so that 100 % means all.
  line += fmt::format(" {}/{} {:.1f} %", state.done, state.total, std::floor(share * 1000) / 10);
  if (state.rate > 0) line += "  " + rate_text(state.rate);
  if (state.rate > 0 && state.done < state.total) {
    line += fmt::format("  {} left", duration_text(static_cast<double>(state.total - state.done) / state.rate));
  }
  if (state.failed > 0) line += fmt::format("  {} failed", state.failed);
  if (!state.words.empty()) line += "  " + state.words;
  return line;
}

Progress::Progress(std::string label, std::size_t total, std::size_t already_done, int descriptor,
                   std::chrono::milliseconds plain_interval)
    : label_(std::move(label)),
      already_done_(already_done),
      descriptor_(descriptor),
      terminal_(host_ != nullptr || is_terminal(descriptor)),
      start_(Clock::now()),
      last_drawn_(start_),
      longest_silence_(terminal_ ? Clock::duration(terminal_silence) : Clock::duration(plain_interval)) {
  state_.done = already_done;
  state_.total = total;
  draw(start_, /*last=*/false);
  try {
    drawer_ = std::thread([this] { draw_when_due(); });
  } catch (const std::system_error&) {
    // The system gives no more threads: then lines come from update() alone.
  }
}

Progress::~Progress() { finish(); }

void Progress::update(std::size_t done, std::size_t failed) {
  const std::lock_guard lock(mutex_);
  if (finished_ || done < state_.done) return;
  state_.done = done;
  state_.failed = failed;
  const Clock::time_point now = Clock::now();
  if (now - last_drawn_ >= (terminal_ ? Clock::duration(terminal_interval) : longest_silence_)) {
    draw(now, /*last=*/false);
  }
}

void Progress::draw_when_due() {
  std::unique_lock lock(mutex_);
  while (!over_.wait_until(lock, last_drawn_ + longest_silence_, [this] { return finished_; })) {
    const Clock::time_point now = Clock::now();
    // update() may have drawn meanwhile.
    if (now - last_drawn_ >= longest_silence_) draw(now, /*last=*/false);
  }
}

void Progress::finish() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(finished_, true)) return;
    draw(Clock::now(), /*last=*/true);
  }
  over_.notify_all();
  if (drawer_.joinable()) drawer_.join();
}

void Progress::update(std::size_t done, std::string words) {
  {
    const std::lock_guard lock(mutex_);
    if (finished_ || done < state_.done) return;
    state_.words = std::move(words);
  }
  update(done, state_.failed);
}

void Progress::draw(Clock::time_point now, bool last) {
  last_drawn_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  state_.rate = elapsed > 0 ? static_cast<double>(state_.done - already_done_) / elapsed : 0;
  if (host_ != nullptr) {
    if (host_->progress) host_->progress(label_, state_);
    return;
  }
  std::string line;
  if (terminal_) {
    const int width = terminal_width(descriptor_) - 1;
    line = progress_line(label_, state_, 0);
    // The bar takes the remaining width; " []" is three characters.
    const int bar = std::min(widest_bar, width - static_cast<int>(line.size()) - 3);
    if (bar >= 5) line = progress_line(label_, state_, bar);
    // A line that wraps could not be redrawn.
    line.resize(std::min(line.size(), static_cast<std::size_t>(std::max(width, 0))));
    line = "\r" + line + "\x1b[K" + (last ? "\n" : "");
  } else {
    line = progress_line(label_, state_, 0) + (last ? fmt::format("  in {}\n", duration_text(elapsed)) : "\n");
  }
  // A reader that does not read (a pager, a terminal after Ctrl-S) must not stop the computation.
  write_without_waiting(descriptor_, line);
}

}  // namespace epicyclic::app
