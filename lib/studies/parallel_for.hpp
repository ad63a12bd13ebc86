// Independent units of work on several threads, with results that do not depend on how many.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace epicyclic::studies {

/// f(0) ... f(count - 1), each once, handed out in order to free threads; f stores its result by its index.
///
/// @param stop  set to true: no further unit is begun; may be null
/// @returns false if stopped before all were begun
/// @throws the first exception of a unit, after the units in progress have ended
bool parallel_for(std::size_t count, int threads, const std::atomic<bool>* stop,
                  const std::function<void(std::size_t)>& f);

}  // namespace epicyclic::studies
