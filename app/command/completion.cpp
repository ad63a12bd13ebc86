#include "completion.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>

#include "input/keys.hpp"
#include "installed_files.hpp"
#include "kind_commands.hpp"
#include "streams.hpp"

namespace epicyclic::app {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(at, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// Of files on the command line, "~/" means the home folder.
fs::path path_of(const std::string& word) {
  const char* home = std::getenv("HOME");
  return home != nullptr && word.starts_with("~/") ? home + word.substr(1) : word;
}

bool holds_study(const fs::path& folder) {
  std::error_code none;
  return fs::exists(folder / "run.json", none);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The table, if it is a file: others may wait for a writer.
std::ifstream opened(const fs::path& file) {
  std::error_code none;
  return fs::is_regular_file(file, none) ? std::ifstream(file) : std::ifstream();
}

/// The words that can stand for one that is not complete.
class Candidates {
 public:
  Candidates(const CLI::App& cli, std::vector<std::string> words) : cli_(cli), words_(std::move(words)) {
    word_ = words_.back();
    words_.pop_back();
  }

  [[nodiscard]] const std::string& find() {
    read_words();
    const std::size_t equals = word_.starts_with("--") ? word_.find('=') : std::string::npos;
    if (value_of_ != nullptr) {
      values(*value_of_);
    } else if (equals != std::string::npos) {
      if (const CLI::Option* option = option_named(word_.substr(0, equals))) {
        before_ = word_.substr(0, equals + 1);
        word_.erase(0, equals + 1);
        values(*option);
      }
    } else if (word_.starts_with('-')) {
      options();
    } else if (command_ == nullptr) {
      commands();
    } else {
      if (const CLI::Option* positional = next_positional()) values(*positional);
      if (text_.empty() && word_.empty()) options();
    }
    return text_;
  }

 private:
  enum class Wanted { all, json, study, html };

  [[nodiscard]] const CLI::Option* option_named(const std::string& name) const {
    return (command_ != nullptr ? *command_ : cli_).get_option_no_throw(name);
  }

  /// What the complete words are.
  void read_words() {
    for (const std::string& word : words_) {
      if (value_of_ != nullptr) {
        value_of_ = nullptr;
      } else if (word.starts_with('-') && word.size() > 1) {
        const CLI::Option* option = option_named(word);
        if (option != nullptr && option->get_items_expected_max() > 0) value_of_ = option;
      } else if (command_ == nullptr) {
        for (const CLI::App* sub : cli_.get_subcommands([](const CLI::App*) { return true; }))
          if (sub->get_name() == word) command_ = sub;
        if (command_ == nullptr) return;
      } else {
        positionals_.push_back(word);
      }
    }
  }

  [[nodiscard]] const CLI::Option* next_positional() const {
    std::size_t left = positionals_.size();
    for (const CLI::Option* option : command_->get_options()) {
      if (!option->get_positional()) continue;
      if (left == 0 || option->get_items_expected_max() > 1) return option;
      --left;
    }
    return nullptr;
  }

  void add(const std::string& candidate, std::string_view meaning = {}) {
    if (!candidate.starts_with(word_)) return;
    // A line each; words that the shell would have to quote differently are left out.
    if (std::ranges::any_of(candidate, [](unsigned char c) { return c < 0x20 || c == 0x7F; })) return;
    text_.append(before_).append(candidate);
    if (!meaning.empty()) text_.append("\t").append(meaning);
    text_ += '\n';
  }

  void commands() {
    for (const CLI::App* sub : cli_.get_subcommands([](const CLI::App*) { return true; }))
      add(sub->get_name(), sub->get_description());
  }

  void options() {
    for (const CLI::Option* option : (command_ != nullptr ? *command_ : cli_).get_options())
      for (const std::string& name : option->get_lnames()) add("--" + name, option->get_description());
  }

  void values(const CLI::Option& option) {
    const std::string name = option.get_single_name();
    const bool reproduces = command_ != nullptr && command_->get_name() == "reproduce";
    if (name == "set") return keys();
    if (name == "from") return points();
    if (name == "quantity" || name == "x") return columns();
    if (name == "grow" || name == "against") return files(Wanted::study);
    if (name == "output") return files(command_->get_name() == "report" ? Wanted::html : Wanted::study);
    if (name == "FOLDER") return files(Wanted::study);
    if (name == "COMMAND") return commands();
    if (name == "WORD") return words_of_keys();
    if (name == "INPUT") {
      if (reproduces)
        claims();
      else
        for (const InstalledInput& input : installed_inputs()) add(input.name, input.file.string());
      return files(Wanted::json);
    }
    if (name == "junit" || name == "expected" || name == "EXPECTED") return files(Wanted::all);
    // "TEXT:{png,svg,pdf}"
    const std::string type = option.get_type_name();
    const std::size_t begin = type.find('{'), end = type.rfind('}');
    if (begin != std::string::npos && end != std::string::npos && begin < end)
      for (const std::string& choice : split(std::string_view(type).substr(begin + 1, end - begin - 1), ','))
        add(choice);
  }

  void claims() {
    std::error_code none;
    if (const auto folder = installed_file("validation"))
      for (fs::directory_iterator entry(*folder, none), end; !none && entry != end; entry.increment(none))
        if (fs::exists(entry->path() / "claims.json", none)) add(entry->path().filename().string());
  }

  /// Files and folders whose path begins with the word.
  void files(Wanted wanted, std::string_view behind = {}) {
    const std::size_t slash = word_.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : word_.substr(0, slash + 1);
    const std::string partial = word_.substr(folder.size());
    std::set<std::string> found;
    std::error_code none;
    for (fs::directory_iterator entry(folder.empty() ? fs::path(".") : path_of(folder), none), end;
         !none && entry != end; entry.increment(none)) {
      const std::string name = entry->path().filename().string();
      if (!name.starts_with(partial) || (name.starts_with('.') && partial.empty())) continue;
      std::error_code unknown;
      if (entry->is_directory(unknown)) {
        if (wanted == Wanted::study && holds_study(entry->path())) {
          found.insert(folder + name);
          if (!behind.empty()) found.insert(folder + name + std::string(behind));
        } else {
          found.insert(folder + name + "/");
        }
      } else if (wanted == Wanted::all || (wanted == Wanted::json && name.ends_with(".json")) ||
                 (wanted == Wanted::html && name.ends_with(".html"))) {
        found.insert(folder + name);
      }
    }
    for (const std::string& candidate : found) add(candidate);
  }

  /// Of --set: the keys as `keys` prints them, one object at a time; behind '=' the names that a key can have.
  void keys() {
    const std::string command = command_->get_name();
    const auto kinds = kind_commands();
    const bool is_kind = std::ranges::any_of(kinds, [&](const Command* kind) { return kind->name == command; });
    const std::size_t equals = word_.find('=');
    const std::vector<std::string> typed = split(word_.substr(0, equals), '/');
    std::map<std::string, std::string> offered;
    for (const input::KeyLine& key : input::key_lines()) {
      if (is_kind && !key.kinds.empty()) {
        const auto own = split(key.kinds, ',');
        if (std::ranges::none_of(own, [&](const std::string& kind) { return kind.ends_with(command); })) continue;
      }
      // N stands for an index.
      std::vector<std::string> parts = split(key.pointer, '/');
      std::string pointer;
      for (std::size_t k = 1; k < parts.size(); ++k) {
        if (parts[k] == "N") parts[k] = k < typed.size() && !typed[k].empty() && is_digit(typed[k][0]) ? typed[k] : "0";
        pointer += "/" + parts[k];
      }
      if (equals != std::string::npos) {
        constexpr std::string_view names = "one of: ";
        if (pointer != word_.substr(0, equals)) continue;
        if (const std::size_t begin = key.bounds.find(names); begin != std::string::npos)
          for (const std::string& value : split(std::string_view(key.bounds).substr(begin + names.size()), ','))
            add(pointer + "=" + value.substr(std::min(value.find_first_not_of(' '), value.size())));
        continue;
      }
      if (!pointer.starts_with(word_)) continue;
      const std::size_t next = pointer.find('/', std::max(word_.size(), std::size_t{1}));
      // An object is offered by its keys.
      if (next == std::string::npos) {
        if (!offered.contains(pointer + "/")) offered.emplace(pointer + "=", key.meaning);
      } else {
        offered.emplace(pointer.substr(0, next + 1), "");
        offered.erase(pointer.substr(0, next) + "=");
      }
    }
    for (const auto& [candidate, meaning] : offered) add(candidate, meaning);
  }

  void words_of_keys() {
    std::set<std::string> names;
    for (const input::KeyLine& key : input::key_lines()) names.insert(key.pointer.substr(key.pointer.rfind('/') + 1));
    for (const std::string& name : names) add(name);
  }

  /// Of --from: FOLDER, and points of its study as FOLDER:INDEX, of a sweep also FOLDER:up=VALUE.
  void points() {
    const std::size_t colon = word_.rfind(':');
    const std::string folder = word_.substr(0, colon);
    if (colon == std::string::npos || !holds_study(path_of(folder))) return files(Wanted::study, ":");
    const std::string which = word_.substr(colon + 1);
    std::ifstream table = opened(path_of(folder) / "points.csv");
    std::string line;
    if (!std::getline(table, line)) return;
    const std::vector<std::string> columns = split(line, ',');
    const auto index_of = [&](std::string_view name) {
      return static_cast<std::size_t>(std::ranges::find(columns, name) - columns.begin());
    };
    const std::size_t point = index_of("point"), direction = index_of("direction"), value = index_of("value"),
                      second = index_of("second_value"), regime = index_of("regime");
    const std::size_t last = std::max({point, direction, value});
    if (last >= columns.size()) return;
    const bool sweep = second >= columns.size();
    const bool by_index = !which.empty() && is_digit(which[0]);
    std::set<std::string> directions;
    constexpr std::size_t most = 8'000'000;  // bytes: a few hundredths of a second
    for (std::size_t bytes = 0; bytes < most && std::getline(table, line); bytes += line.size()) {
      const std::vector<std::string> cells = split(line, ',');
      if (cells.size() <= last) continue;
      const std::string meaning =
          cells[direction] + " " + cells[value] + (regime < cells.size() ? " " + cells[regime] : "");
      if (!sweep || by_index)
        add(folder + ":" + cells[point], meaning);
      else if (which.find('=') != std::string::npos)
        add(folder + ":" + cells[direction] + "=" + cells[value], "point " + cells[point]);
      else if (directions.insert(cells[direction]).second)
        add(folder + ":" + cells[direction] + "=", "point nearest to a value");
    }
    if (sweep && which.empty()) add(folder + ":0", "point by its index");
  }

  /// Of plot: the columns of the tables in its folders.
  void columns() {
    std::set<std::string> names;
    for (const std::string& folder : positionals_)
      for (const char* table : {"points.csv", "poincare.csv", "branch.csv", "history.csv"}) {
        std::ifstream file = opened(path_of(folder) / table);
        std::string line;
        if (std::getline(file, line))
          for (std::string& name : split(line, ',')) names.insert(std::move(name));
      }
    for (const std::string& name : names) add(name);
  }

  const CLI::App& cli_;
  std::vector<std::string> words_;  ///< the complete ones
  std::string word_;                ///< the one to be completed
  std::string before_;              ///< of it: "--option="
  const CLI::App* command_ = nullptr;
  const CLI::Option* value_of_ = nullptr;  ///< the word is a value of this option
  std::vector<std::string> positionals_;
  std::string text_;
};

}  // namespace

void complete(const CLI::App& cli, const std::vector<std::string>& words) noexcept {
  try {
    write_data(Candidates(cli, words.empty() ? std::vector<std::string>{""} : words).find());
  } catch (...) {
    // A shell that completes shows no messages.
  }
}

}  // namespace epicyclic::app
