// epicyclic __complete WORD...: what the shells' completion scripts call (app/packaging/completion).
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace epicyclic::app {

/// Prints the words that the last of `words` can become, a line each: the word, a tab, its meaning. One that ends with
/// '/', '=' or ':' is to be continued. Reads folders and files, writes none; whatever fails, prints less.
/// @param words  of the command line after the program's name; the last may be empty
void complete(const CLI::App& cli, const std::vector<std::string>& words) noexcept;

}  // namespace epicyclic::app
