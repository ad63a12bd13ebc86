#include "installed_files.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "commands.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "input/field_table.hpp"
#include "input/json_source.hpp"
#include "streams.hpp"

namespace epicyclic::app {

namespace fs = std::filesystem;

std::optional<fs::path> installed_file(const fs::path& relative) {
  std::error_code none;
  fs::path at = fs::read_symlink("/proc/self/exe", none);
  while (at.has_relative_path()) {
    at = at.parent_path();
    for (const auto& root : {at / "share" / "epicyclic", at})
      if (fs::exists(root / relative, none)) return root / relative;
  }
  return std::nullopt;
}

std::vector<InstalledInput> installed_inputs() {
  std::vector<InstalledInput> inputs;
  std::error_code none;
  if (const auto folder = installed_file("inputs"))
    for (fs::directory_iterator file(*folder, none), end; file != end; file.increment(none)) {
      if (none) break;
      if (file->path().extension() == ".json") inputs.push_back({file->path().stem().string(), file->path()});
    }
  std::ranges::sort(inputs, {}, &InstalledInput::name);
  return inputs;
}

namespace {

/// Names that the user may have meant: those with the same beginning, and the nearest one.
std::string names_like(const std::string& name, const std::vector<InstalledInput>& inputs) {
  constexpr std::size_t most = 5;
  std::vector<std::string> names, alike;
  for (const InstalledInput& input : inputs) {
    names.push_back(input.name);
    if (alike.size() < most && (input.name.find(name) != std::string::npos)) alike.push_back(input.name);
  }
  if (alike.size() > 1) return "; did you mean one of " + input::listed(alike) + "?";
  return input::suggestion(name, names);
}

}  // namespace

fs::path input_file(const fs::path& given) {
  std::error_code none;
  if (given.empty() || given.has_parent_path() || fs::symlink_status(given, none).type() != fs::file_type::not_found)
    return given;
  const std::vector<InstalledInput> inputs = installed_inputs();
  const std::string name = given.extension() == ".json" ? given.stem().string() : given.string();
  const auto found = std::ranges::find(inputs, name, &InstalledInput::name);
  if (found == inputs.end())
    throw InputError(
        fmt::format("{}: no such file, and no installed input of that name (`epicyclic inputs` lists them){}",
                    given.string(), names_like(name, inputs)));
  return found->file;
}

int inputs_command(const Arguments& /*arguments*/) {
  for (const InstalledInput& input : installed_inputs()) {
    const input::JsonSource source = input::read_json_file(input.file);
    if (!source.complete || !source.value.is_object()) continue;
    const auto text = [](const nlohmann::json& object, const char* key) {
      const auto value = object.find(key);
      return value != object.end() && value->is_string() ? value->get<std::string>() : std::string();
    };
    const auto study = source.value.find("study");
    const bool is_study = study != source.value.end() && study->is_object();
    print("{}  {}  {}\n", input.name, is_study ? text(*study, "kind") : "stage", text(source.value, "note"));
  }
  return done;
}

}  // namespace epicyclic::app
