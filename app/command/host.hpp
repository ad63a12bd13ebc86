// A process that runs commands without being the program: Python. Each of its threads may run one at a time, and
// several threads may do so at once, in different folders. What a command would write to the standard streams goes to
// its host, and a stop comes from there, not from a signal.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>

namespace epicyclic::studies {
struct PointResult;
}

namespace epicyclic::app {

struct ProgressState;

/// Its functions may be empty, and throw nothing.
struct Host {
  std::atomic<bool> stop{false};                    ///< as by a signal [stop.hpp]
  std::function<void(std::string_view)> data{};     ///< for stdout
  std::function<void(std::string_view)> words{};    ///< for stderr
  std::function<void(std::string_view)> warning{};  ///< a warning of the input
  /// Called by any thread.
  std::function<void(const std::string& label, const ProgressState& state)> progress{};
  std::function<void(const studies::PointResult& point)> point{};  ///< a new one was stored; likewise
};

/// Of the command on this thread; null: the program itself runs it.
[[nodiscard]] Host* host();

/// Commands on this thread have a host, or null, while the object lives.
class HostScope {
 public:
  explicit HostScope(Host* host);
  HostScope(const HostScope&) = delete;
  HostScope& operator=(const HostScope&) = delete;
  ~HostScope();

 private:
  Host* before_;
};

}  // namespace epicyclic::app
