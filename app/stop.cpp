#include "stop.hpp"

#include <csignal>

namespace epicyclic::app {

namespace {

std::atomic<bool> requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "the signal handler may only touch lock-free atomics");

void request(int /*signal*/) { requested = true; }

}  // namespace

const std::atomic<bool>& stop_requested() { return requested; }

void stop_on_signals() {
  std::signal(SIGINT, request);
  std::signal(SIGTERM, request);
}

}  // namespace epicyclic::app
