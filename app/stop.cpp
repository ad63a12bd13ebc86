#include "stop.hpp"

#include <csignal>
#include <string_view>

#include <unistd.h>

#include "commands.hpp"

namespace epicyclic::app {

namespace {

std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "the signal handler may only touch lock-free atomics");

/// Half of the two seconds within which the program promises to end [s].
constexpr unsigned patience = 1;

// Signal handlers: async-signal-safe calls only.

void end_at_once(int /*signal*/) {
  constexpr std::string_view message = "stopped in the midst; the same command goes on\n";
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, message.data(), message.size());
  ::_exit(stopped_early);
}

void request(int /*signal*/) {
  // Repeated signals do not put the end off.
  if (!requested.exchange(true)) ::alarm(patience);
}

}  // namespace

const std::atomic<bool>& stop_requested() { return requested; }

void stop_on_signals() {
  std::signal(SIGALRM, end_at_once);
  std::signal(SIGINT, request);
  std::signal(SIGTERM, request);
}

}  // namespace epicyclic::app
