// The files that a session has written to its folder, so that a later one can check that all are still there and whole.
//
// A file is unchanged if its size and its SHA-256 are; times and names of owners do not count. A FileRecorder is
// notified of each file that is put in place while it lives [core/placed_files.hpp]. It keeps size and SHA-256 of those
// in its folder. Journals and run.json are no results and are left out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/placed_files.hpp"

namespace epicyclic::store {

struct FileFacts {
  std::uintmax_t bytes = 0;
  std::string sha256;  ///< 64 hexadecimal digits
  bool operator==(const FileFacts&) const = default;
};

/// By name relative to the folder; nothing of a picture that could not be drawn.
using Manifest = std::map<std::string, std::optional<FileFacts>>;

/// As it is in run.json.
[[nodiscard]] nlohmann::json to_json(const Manifest& manifest);

/// Nothing if it is no manifest, or names a place that is not below the folder.
[[nodiscard]] std::optional<Manifest> manifest_from(const nlohmann::json& value);

/// Of a file as it is now; nothing if there is no such file, or if it is no plain file.
/// @throws OutputError if it cannot be read
[[nodiscard]] std::optional<FileFacts> facts_of(const std::filesystem::path& file);

/// A file that has changed.
struct ChangedFile {
  std::string name;
  std::optional<FileFacts> expected{};    ///< nothing: a picture that was not drawn
  std::optional<std::uintmax_t> bytes{};  ///< that it has now; nothing: it is missing
};

/// Reads all files of the manifest.
/// @throws OutputError when one cannot be read
[[nodiscard]] std::vector<ChangedFile> changed_files(const std::filesystem::path& folder, const Manifest& manifest);

/// Records the files that are put below a folder while it lives.
class FileRecorder {
 public:
  explicit FileRecorder(std::filesystem::path folder);
  FileRecorder(const FileRecorder&) = delete;
  FileRecorder& operator=(const FileRecorder&) = delete;
  ~FileRecorder() = default;

  [[nodiscard]] Manifest files() const;

  /// Files that another process has put in place.
  void add(const Manifest& files);

 private:
  void note(const std::filesystem::path& path, Placed how);

  std::filesystem::path folder_;
  Manifest files_;
  mutable std::mutex mutex_;
  PlacedFiles placed_;  ///< last, so that it is notified of nothing before the other members exist
};

}  // namespace epicyclic::store
