#include "store/manifest.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "core/atomic_file.hpp"
#include "store/digest.hpp"

namespace epicyclic::store {

namespace {

namespace fs = std::filesystem;

/// A file below the folder, by the name alone.
bool is_below(const fs::path& relative) {
  return !relative.empty() && relative.is_relative() && relative == relative.lexically_normal() &&
         relative.has_filename() && *relative.begin() != ".." && *relative.begin() != ".";
}

bool is_bookkeeping(const std::string& name) {
  return name == "run.json" || name == ".lock" || (name.starts_with("journal.") && name.ends_with(".bin"));
}

/// @returns the bytes of the file, without a check of its contents; nothing if there is no file
FileDescriptor open_regular(const fs::path& file, std::uintmax_t& bytes) {
  FileDescriptor descriptor = open_descriptor(file, O_RDONLY | O_NONBLOCK);
  if (!descriptor.is_open()) {
    // A pipe or socket of that name, a link to nowhere.
    if (errno != ENOENT && errno != ENOTDIR && errno != ELOOP && errno != ENXIO)
      throw_output_error(file, "open the file", errno);
    return {};
  }
  struct stat status {};
  if (::fstat(descriptor.get(), &status) != 0) throw_output_error(file, "measure the file", errno);
  if (!S_ISREG(status.st_mode)) return {};
  bytes = static_cast<std::uintmax_t>(status.st_size);
  return descriptor;
}

std::string digest_of(const FileDescriptor& descriptor, const fs::path& file) {
  Sha256 sha;
  std::vector<char> block(std::size_t{1} << 18);
  for (;;) {
    const ssize_t count = ::read(descriptor.get(), block.data(), block.size());
    if (count == 0) return sha.hex();
    if (count > 0) {
      sha.add({block.data(), static_cast<std::size_t>(count)});
    } else if (errno != EINTR) {
      throw_output_error(file, "read", errno);
    }
  }
}

}  // namespace

nlohmann::json to_json(const Manifest& manifest) {
  nlohmann::json value = nlohmann::json::object();
  for (const auto& [name, facts] : manifest) {
    if (facts)
      value[name] = {{"bytes", facts->bytes}, {"sha256", facts->sha256}};
    else
      value[name] = nullptr;
  }
  return value;
}

std::optional<Manifest> manifest_from(const nlohmann::json& value) {
  if (!value.is_object()) return std::nullopt;
  Manifest manifest;
  for (const auto& [name, facts] : value.items()) {
    if (!is_below(name) || is_bookkeeping(name)) return std::nullopt;
    auto& known = manifest[name];
    if (facts.is_null()) continue;
    if (!facts.is_object() || !facts.contains("bytes") || !facts["bytes"].is_number_unsigned() ||
        !facts.contains("sha256") || !facts["sha256"].is_string())
      return std::nullopt;
    known = {facts["bytes"].get<std::uintmax_t>(), facts["sha256"].get<std::string>()};
  }
  return manifest;
}

std::optional<FileFacts> facts_of(const fs::path& file) {
  FileFacts facts;
  const FileDescriptor descriptor = open_regular(file, facts.bytes);
  if (!descriptor.is_open()) return std::nullopt;
  facts.sha256 = digest_of(descriptor, file);
  return facts;
}

std::vector<ChangedFile> changed_files(const fs::path& folder, const Manifest& manifest) {
  std::vector<ChangedFile> changed;
  for (const auto& [name, expected] : manifest) {
    std::uintmax_t bytes = 0;
    const FileDescriptor descriptor = open_regular(folder / name, bytes);
    if (!descriptor.is_open()) {
      changed.push_back({name, expected, std::nullopt});
    } else if (expected && (bytes != expected->bytes || digest_of(descriptor, folder / name) != expected->sha256)) {
      changed.push_back({name, expected, bytes});
    }
  }
  return changed;
}

FileRecorder::FileRecorder(fs::path folder)
    : folder_(std::move(folder)), placed_([this](const fs::path& path, Placed how) { note(path, how); }) {}

Manifest FileRecorder::files() const {
  const std::scoped_lock lock(mutex_);
  return files_;
}

void FileRecorder::add(const Manifest& files) {
  const std::scoped_lock lock(mutex_);
  for (const auto& [name, facts] : files) files_.insert_or_assign(name, facts);
}

void FileRecorder::note(const fs::path& path, Placed how) {
  const fs::path name = path.lexically_relative(folder_);
  // Of a study in a folder below this one, too.
  if (!is_below(name) || is_bookkeeping(name.filename().string())) return;
  std::optional<FileFacts> facts;
  if (how == Placed::there) {
    facts = facts_of(path);
    if (!facts) throw_output_error(path, "find what was just written", ENOENT);
  }
  add({{name.string(), facts}});
}

}  // namespace epicyclic::store
