// Whoever computes for hours writes seldom, and what he writes into a folder that was removed raises no error.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "host.hpp"
#include "store/output_folder.hpp"

namespace epicyclic::app {

/// Checks every second that the folder still exists. If it does not, the study stops as by a signal. The code after it
/// finds the folder missing and reports this.
class FolderWatch {
 public:
  /// @param folder  must live longer
  explicit FolderWatch(const store::OutputFolder& folder);
  FolderWatch(const FolderWatch&) = delete;
  FolderWatch& operator=(const FolderWatch&) = delete;
  ~FolderWatch();

 private:
  void recording();

  const store::OutputFolder& folder_;
  Host* host_ = host();
  bool over_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread watcher_;
};

}  // namespace epicyclic::app
