// Whoever computes for hours writes seldom, and what he writes into a folder that was removed raises no error.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "store/output_folder.hpp"

namespace epicyclic::app {

/// Looks every second whether the folder is still there. When it is not, the study is stopped as by a signal: what
/// comes next finds the folder gone and says so.
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
  bool over_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread watcher_;
};

}  // namespace epicyclic::app
