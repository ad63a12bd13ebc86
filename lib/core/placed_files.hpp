// Who keeps account of a folder hears of each file that is put there, wherever in the program that happens: whoever
// writes a file need not know of it.
#pragma once

#include <filesystem>
#include <functional>

namespace epicyclic {

/// What became of a file: it is in place and whole, or it is a picture that could not be drawn.
enum class Placed { there, undrawn };

/// Hears of all files of this process while it lives, from the thread that places them, and from several at once.
class PlacedFiles {
 public:
  using Listener = std::function<void(const std::filesystem::path&, Placed)>;

  explicit PlacedFiles(Listener listener);
  PlacedFiles(const PlacedFiles&) = delete;
  PlacedFiles& operator=(const PlacedFiles&) = delete;
  /// Waits for running calls.
  ~PlacedFiles();

 private:
  friend void report_placed(const std::filesystem::path& path, Placed how);
  Listener listener_;
};

/// For those who put files in place.
/// @throws what a listener throws
void report_placed(const std::filesystem::path& path, Placed how = Placed::there);

}  // namespace epicyclic
