// SIGINT and SIGTERM: stop soon, resumable.
#pragma once

#include <atomic>

namespace epicyclic::app {

/// Set by the first SIGINT or SIGTERM after stop_on_signals().
[[nodiscard]] const std::atomic<bool>& stop_requested();

void stop_on_signals();

}  // namespace epicyclic::app
