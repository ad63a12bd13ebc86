#include "watch.hpp"

#include <chrono>
#include <system_error>

#include "commands.hpp"
#include "stop.hpp"

namespace epicyclic::app {

FolderWatch::FolderWatch(const store::OutputFolder& folder) : folder_(folder) {
  try {
    watcher_ = std::thread([this] { recording(); });
  } catch (const std::system_error&) {
    // The system gives no more threads: then the end of the study finds it out.
  }
}

FolderWatch::~FolderWatch() {
  {
    const std::scoped_lock lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  if (watcher_.joinable()) watcher_.join();
}

void FolderWatch::recording() {
  const HostScope scope(host_);
  constexpr std::chrono::seconds interval{1};
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, interval, [this] { return over_; })) {
    if (folder_.is_there()) continue;
    stop_soon(output_failed, "ended early: the folder was removed or moved while the study ran\n");
    return;
  }
}

}  // namespace epicyclic::app
