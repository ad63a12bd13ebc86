#include "core/placed_files.hpp"

#include <mutex>
#include <shared_mutex>
#include <utility>
#include <vector>

namespace epicyclic {

namespace {

struct Registry {
  std::shared_mutex mutex;
  std::vector<PlacedFiles*> all;
};

Registry& registry() {
  static Registry one;
  return one;
}

}  // namespace

PlacedFiles::PlacedFiles(Listener listener) : listener_(std::move(listener)) {
  const std::unique_lock lock(registry().mutex);
  registry().all.push_back(this);
}

PlacedFiles::~PlacedFiles() {
  const std::unique_lock lock(registry().mutex);
  std::erase(registry().all, this);
}

void report_placed(const std::filesystem::path& path, Placed how) {
  // Shared: listeners read files, and those of other threads need not wait for that.
  const std::shared_lock lock(registry().mutex);
  for (const PlacedFiles* one : registry().all) one->listener_(path, how);
}

}  // namespace epicyclic
