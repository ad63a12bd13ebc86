// Messages that all kinds of work on several ranks share: names of ranks, how they ended, when to poll.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "failure.hpp"
#include "ranks.hpp"

namespace epicyclic::app {

using Clock = std::chrono::steady_clock;

/// Longest time between two checks for messages: at the start, and after a long time without question or answer. Each
/// check wakes a thread on a core that computes.
inline constexpr std::chrono::milliseconds poll_interval{2};
inline constexpr std::chrono::milliseconds rare_poll_interval{20};
/// Time that ranks may take after the message to stop: all of it must fit into the 2 s of a signal.
inline constexpr std::chrono::milliseconds farewell{1500};

[[nodiscard]] std::string text_of(const nlohmann::json& message);

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

template <class T>
std::vector<T> values_of(const std::string& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

using Index = std::uint64_t;

/// When to check for messages: the sooner, the less time has passed since a question or its answer.
class Attention {
 public:
  void rouse() { roused_ = Clock::now(); }

  [[nodiscard]] std::chrono::milliseconds pause() const {
    const auto quiet = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - roused_);
    return std::clamp(quiet / 50, poll_interval, rare_poll_interval);
  }

 private:
  Clock::time_point roused_ = Clock::now();
};

/// The report of a rank that has finished, or that cannot begin.
[[nodiscard]] nlohmann::json report_of(const Ranks& ranks, const std::exception_ptr& error);
[[nodiscard]] std::optional<Failure> failure_in(const nlohmann::json& report);

/// Of a rank but the first, to the first.
/// @param error  why it cannot take part; null if it can
void say_hello(const Arguments& arguments, const std::string& identity, const std::exception_ptr& error);

/// Waits until all have said who they are.
/// @returns threads of each rank, of the first as in the arguments
/// @throws Failure when a rank cannot take part: it cannot read the input, has another one, or is another program
[[nodiscard]] std::vector<int> muster(const Arguments& arguments, const std::string& identity);

/// Lets the others go.
void let_go(Ranks& ranks, int exit_code);

/// A computation in a thread of its own, because messages belong to the thread that made it.
class Computation {
 public:
  /// @param stop  ends it, provided that `compute` checks it
  Computation(std::function<void()> compute, std::atomic<bool>& stop)
      : stop_(stop), worker_([this, compute = std::move(compute)] {
          try {
            compute();
          } catch (...) {
            error_ = std::current_exception();
          }
          const std::scoped_lock lock(mutex_);
          ended_ = true;
          wake_.notify_all();
        }) {}
  Computation(const Computation&) = delete;
  Computation& operator=(const Computation&) = delete;

  /// Left early, as by an exception of the messages, it is stopped and waited for.
  ~Computation() {
    if (!worker_.joinable()) return;
    stop_ = true;
    worker_.join();
  }

  [[nodiscard]] bool ends_within(std::chrono::milliseconds pause) {
    std::unique_lock lock(mutex_);
    return wake_.wait_for(lock, pause, [&] { return ended_; });
  }

  /// Whether it threw, once it has ended.
  [[nodiscard]] bool failed() const { return error_ != nullptr; }

  /// Waits for its end.
  /// @throws what it threw
  void join() {
    worker_.join();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::atomic<bool>& stop_;
  std::exception_ptr error_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ended_ = false;
  std::thread worker_;  // last: begins when the others stand
};

}  // namespace epicyclic::app
