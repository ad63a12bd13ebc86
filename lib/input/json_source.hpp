// Strict JSON text, with the line of every key and element, and every problem found in one pass.
//
// The grammar is RFC 8259 and nothing more: no comments, no trailing comma, no NaN. Beyond the grammar this refuses
// what a JSON library accepts silently: duplicate keys, integers that a double does not represent exactly, numbers that
// overflow or underflow to zero. nlohmann-json reads the text through its SAX interface; a counting iterator gives the
// position.
//
// An error in one place only (NaN, 1e999, a comment, a trailing comma) is reported and replaced by blanks. Reading
// continues after it, so that one run shows all problems of a file.
//
// Limits: 16 MiB of text, 32 levels of nesting. Nothing in the text is executed or followed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "core/json_pointer.hpp"

namespace epicyclic::input {

inline constexpr std::size_t json_bytes_max = std::size_t{16} << 20;
inline constexpr std::size_t json_depth_max = 32;

/// An error in an input, and its place.
struct Problem {
  std::string file;     ///< as the user named it, or "--set ..."
  int line = 0;         ///< from 1; 0 if there is none
  std::string pointer;  ///< JSON pointer (RFC 6901); empty for the whole document
  std::string message;

  /// "file:line: /pointer: message", leaving out what is not there.
  [[nodiscard]] std::string text() const;
};

/// All errors of an input, thrown at once; what() has one line per problem.
class InputProblems : public InputError {
 public:
  explicit InputProblems(std::vector<Problem> problems);
  [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// A JSON text as read: its value, the lines of its keys, and its errors.
struct JsonSource {
  std::string name;   ///< of the file, as shown in messages
  std::string bytes;  ///< exactly as stored
  nlohmann::json value;
  bool complete = false;                          ///< the value stands for the whole text; false: reading broke off
  std::map<std::string, int, std::less<>> line;   ///< by pointer: line of the key, or of the element in an array
  std::set<std::string, std::less<>> unreadable;  ///< pointers whose value was reported here and replaced by 0
  std::vector<Problem> problems;

  /// The line of that pointer or of its nearest existing parent; 0 if the text does not exist.
  [[nodiscard]] int line_of(std::string_view pointer) const;

  /// Renames a pointer and all below it. An existing entry under the new name stays.
  void move(const std::string& from, const std::string& to);
};

/// Reads a text. Never throws for errors in the text: see `problems`.
[[nodiscard]] JsonSource parse_json(std::string bytes, std::string name);

/// A file as it is, or why it cannot be read.
struct TextFile {
  std::string bytes;
  std::string problem;  ///< empty: there are the bytes, of a file that is too long a part
};

/// @param kind  of the file, in messages: "JSON"
/// @throws OutputError if the machine fails
[[nodiscard]] TextFile read_text_file(const std::filesystem::path& path, const std::string& kind);

/// Reads a file. A missing file, a folder, and a file without permission are problems too. `name` is the name in
/// messages (default: the path).
/// @throws OutputError if the machine fails: no descriptor is left, or the disk has an error
[[nodiscard]] JsonSource read_json_file(const std::filesystem::path& path, std::string name = {});

/// Files of an input, each read once, so that everything is made from one state of each file. Several threads may call
/// it at once.
class JsonFiles {
 public:
  /// @throws as read_json_file()
  [[nodiscard]] const JsonSource& read(const std::filesystem::path& path);

  /// A file that is no JSON.
  /// @throws as read_text_file()
  [[nodiscard]] const TextFile& read_text(const std::filesystem::path& path, const std::string& kind);

  /// A text in place of the file that read() would read.
  void add(const std::filesystem::path& path, std::string text);

 private:
  std::mutex mutex_;
  std::map<std::filesystem::path, JsonSource> files_;
  std::map<std::filesystem::path, TextFile> texts_;
};

/// The first byte that makes a text invalid UTF-8 (RFC 3629), without NUL; empty if there is none.
[[nodiscard]] std::string not_text(std::string_view text);

/// The error in a text that is almost a number: a unit after it, a decimal comma, ...; empty if it is none.
[[nodiscard]] std::string misspelt_number(std::string_view text);

/// The text with ASCII letters in lower case.
[[nodiscard]] std::string lower_case(std::string_view text);

/// One step of a JSON pointer, with ~ and / escaped.
[[nodiscard]] std::string pointer_step(std::string_view key);

/// The pointer without its last step; empty for the root and its members.
[[nodiscard]] std::string_view pointer_parent(std::string_view pointer);

/// The last step of a pointer, unescaped.
[[nodiscard]] std::string pointer_leaf(std::string_view pointer);

/// Its keys and indices, from the root.
[[nodiscard]] std::vector<std::string> pointer_steps(std::string_view pointer);

}  // namespace epicyclic::input
