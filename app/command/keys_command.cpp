// epicyclic keys: the keys of the input, a line each.

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "core/errors.hpp"
#include "input/aliases.hpp"
#include "input/field_table.hpp"
#include "input/keys.hpp"
#include "streams.hpp"

namespace epicyclic::app {

namespace {

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Is each word in its place, its unit, its kinds or its meaning?
bool speaks_of(const input::KeyLine& key, const std::vector<std::string>& words) {
  const std::string text = lower(input::key_text(key));
  return std::ranges::all_of(words,
                             [&](const std::string& word) { return text.find(lower(word)) != std::string::npos; });
}

/// Is each word the old name, or, of words that no key has, a part of it between underscores?
bool names(const input::Alias& alias, const std::vector<std::string>& words, bool known) {
  const std::string name = "_" + std::string(alias.old_name) + "_";
  const std::string pointer = std::string(alias.place) + "/" + std::string(alias.old_name);
  return !words.empty() && std::ranges::all_of(words, [&](const std::string& word) {
    const std::string part = "_" + lower(word) + "_";
    return word == pointer || (known ? name == part : name.find(part) != std::string::npos);
  });
}

/// The new names for words that are old names, a line each.
bool print_new_names(const std::vector<std::string>& words, bool known) {
  std::vector<std::string> lines;
  for (const input::Alias& alias : input::aliases())
    if (std::string line = alias.warning(); names(alias, words, known) && std::ranges::find(lines, line) == lines.end())
      lines.push_back(std::move(line));
  for (const std::string& line : lines) print("{}\n", line);
  return !lines.empty();
}

}  // namespace

int keys_command(const Arguments& arguments) {
  std::vector<std::string> known;
  bool any = false;
  for (const input::KeyLine& key : input::key_lines()) {
    // Its words: "backlash", "half".
    std::string_view name = std::string_view(key.pointer).substr(key.pointer.rfind('/') + 1);
    for (std::size_t end = 0; end != std::string_view::npos; name.remove_prefix(end + 1)) {
      end = name.find('_');
      known.emplace_back(name.substr(0, end));
      if (end == std::string_view::npos) break;
    }
    if (!speaks_of(key, arguments.words)) continue;
    any = true;
    print("{}", input::key_text(key));
  }
  if (print_new_names(arguments.words, any) || any) return done;
  std::string words;
  for (const std::string& word : arguments.words) words += (words.empty() ? "'" : " and '") + word + "'";
  // Each may be a word, and no key have them all.
  const auto unknown = [&](const std::string& word) { return std::ranges::find(known, word) == known.end(); };
  const auto wrong = std::ranges::find_if(arguments.words, unknown);
  const std::string near = wrong != arguments.words.end() ? input::suggestion(*wrong, known) : "; give one of them";
  throw InputError("no key has " + words + (near.empty() ? "; `keys` alone prints all" : near));
}

}  // namespace epicyclic::app
