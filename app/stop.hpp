// SIGINT and SIGTERM: stop soon, resumable.
//
// The first of them raises a flag, at which a study gives up the points under way, leaves its folder in order and ends
// with code 75, commonly within milliseconds. What does not look at the flag for a second (a mesh period that takes
// minutes, the writing of large results) is ended there with the same code: a folder is sound at any moment, as after
// kill -9, so that this costs nothing but the state "stopped" in run.json.
#pragma once

#include <atomic>

namespace epicyclic::app {

/// Set by the first SIGINT or SIGTERM after stop_on_signals().
[[nodiscard]] const std::atomic<bool>& stop_requested();

/// To be called before anything is written.
void stop_on_signals();

}  // namespace epicyclic::app
