// The one computation that `serve` may have at work: a command in a thread of its own, with the server as its host.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

#include <nlohmann/json.hpp>

#include "command/commands.hpp"
#include "command/host.hpp"

namespace epicyclic::app {

class ServedComputation {
 public:
  ServedComputation();
  ServedComputation(const ServedComputation&) = delete;
  ServedComputation& operator=(const ServedComputation&) = delete;
  ~ServedComputation() { (void)end(); }

  struct Job {
    std::string kind;     ///< command, which is the kind of the study
    Arguments arguments;  ///< input, output folder, assignments
    std::size_t study;    ///< its number in the page
  };

  /// @returns false if another one is at work
  [[nodiscard]] bool start(Job job);

  /// Lets what is at work stop; its folder can be resumed.
  void cancel();

  /// Stops what is at work and waits for it.
  /// @returns whether something was stopped at the end of the program
  bool end();

  /// @returns false if something is still at work at the end of the time
  [[nodiscard]] bool wait(std::chrono::milliseconds most);

  [[nodiscard]] bool busy() const;

  /// {"study", "done", "total", "seconds"} of what is at work, or null.
  [[nodiscard]] nlohmann::json current() const;

  /// {"study", "code", "message"} of what ended last, or null.
  [[nodiscard]] nlohmann::json last() const;

 private:
  void run(const Job& job);

  mutable std::mutex mutex_;
  std::condition_variable ended_;
  std::thread thread_;
  bool busy_ = false;
  std::size_t study_ = 0;
  std::chrono::steady_clock::time_point begun_;
  std::atomic<std::size_t> done_{0}, total_{0};
  Host host_;
  nlohmann::json last_;
  std::atomic<bool> server_ended_{false};
  bool stopped_at_the_end_ = false;
};

}  // namespace epicyclic::app
