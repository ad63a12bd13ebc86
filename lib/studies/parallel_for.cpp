#include "studies/parallel_for.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace epicyclic::studies {

bool parallel_for(std::size_t count, int threads, const std::atomic<bool>* stop,
                  const std::function<void(std::size_t)>& f) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  std::mutex mutex;
  std::exception_ptr first;
  std::atomic<bool> stopped{false};
  const auto work = [&] {
    for (;;) {
      if (failed) return;
      if (stop != nullptr && stop->load()) {
        stopped = true;
        return;
      }
      const std::size_t unit = next++;
      if (unit >= count) return;
      try {
        f(unit);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!first) first = std::current_exception();
        failed = true;
      }
    }
  };
  std::vector<std::thread> others;
  try {
    const int most = std::clamp(threads, 1, static_cast<int>(std::clamp<std::size_t>(count, 1, 4096)));
    for (int k = 1; k < most; ++k) others.emplace_back(work);
  } catch (const std::system_error&) {
    // The system gives no more threads: those there are do the work.
  }
  work();
  for (std::thread& t : others) t.join();
  if (first) std::rethrow_exception(first);
  return !stopped || next >= count;
}

}  // namespace epicyclic::studies
