// Files that come with the program: inputs and claims, in its sources or in its installation.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace epicyclic::app {

/// "inputs", or a file such as "validation/NAME/claims.json": in a folder above the program, or in share/epicyclic
/// below one; nothing if it is nowhere.
[[nodiscard]] std::optional<std::filesystem::path> installed_file(const std::filesystem::path& relative);

/// A study or a stage that comes with the program.
struct InstalledInput {
  std::string name;  ///< "tang2020_speed"
  std::filesystem::path file;
};

/// All of them, by name.
[[nodiscard]] std::vector<InstalledInput> installed_inputs();

/// The file that INPUT names. A file or folder of that path is taken first. A name without a slash that is none is that
/// of an installed input: NAME or NAME.json.
/// @throws InputError  for such a name that no input has; the message has names like it
[[nodiscard]] std::filesystem::path input_file(const std::filesystem::path& given);

}  // namespace epicyclic::app
