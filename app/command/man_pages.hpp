// epicyclic __man FOLDER: manual pages from the tree of commands and options, written at the installation.
#pragma once

#include <filesystem>

namespace CLI {
class App;
}

namespace epicyclic::app {

/// Writes epicyclic.1 and epicyclic-COMMAND.1 for each command to the folder.
/// @throws OutputError
void write_man_pages(const CLI::App& cli, const std::filesystem::path& folder);

}  // namespace epicyclic::app
