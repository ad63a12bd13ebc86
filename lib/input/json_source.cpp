#include "input/json_source.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

#include <fcntl.h>

#include "core/atomic_file.hpp"

namespace epicyclic::input {

namespace {

using nlohmann::json;

/// Integers up to here are exact in a double: 2^53.
constexpr std::int64_t exact_integer_max = std::int64_t{1} << 53;

/// Number of places of a text that are replaced by blanks before reading ends.
constexpr int repairs_max = 20;

/// Feeds characters to the lexer and counts them.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, std::size_t* count) : at_(at), count_(count) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    ++at_;
    ++*count_;
    return *this;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  std::size_t* count_;
};

class LineIndex {
 public:
  explicit LineIndex(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') ends_.push_back(i);
  }
  /// Line, from 1, of the character at `offset`; a newline belongs to the line that it ends.
  [[nodiscard]] int at(std::size_t offset) const {
    return static_cast<int>(std::lower_bound(ends_.begin(), ends_.end(), offset) - ends_.begin()) + 1;
  }

 private:
  std::vector<std::size_t> ends_;
};

bool is_number_character(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E';
}

bool is_word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.' || c == '_';
}

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// An error of the grammar.
struct Stumble {
  std::size_t consumed = 0;  ///< characters read, the offending one included
  std::string detail;        ///< the library's words
  std::string pointer;       ///< the element that was being read
  std::string last;          ///< the last number read before
  std::size_t last_end = 0;  ///< end of the text of that number
  std::string container;     ///< the innermost open object or array
  int container_line = 0;    ///< 0: none is open
  bool after_end = false;    ///< the document was complete already
};

class Handler final : public nlohmann::json_sax<json> {
 public:
  Handler(std::string_view text, const LineIndex& lines, const std::size_t& consumed, JsonSource& source)
      : text_(text), lines_(lines), consumed_(consumed), source_(source) {}

  std::optional<Stumble> stumble;
  bool too_deep = false;

  bool null() override { return place(nullptr, here()); }
  bool boolean(bool value) override { return place(value, here()); }
  bool string(string_t& value) override { return place(value, here()); }
  bool binary(binary_t& /*value*/) override { return false; }

  bool number_integer(number_integer_t value) override {
    const int line = note_number();
    if (value < -exact_integer_max || value > exact_integer_max) report_inexact(line, std::to_string(value));
    return place(value, line);
  }

  bool number_unsigned(number_unsigned_t value) override {
    const int line = note_number();
    if (value > static_cast<std::uint64_t>(exact_integer_max)) report_inexact(line, std::to_string(value));
    return place(value, line);
  }

  bool number_float(number_float_t value, const string_t& raw) override {
    const int line = note_number();
    if (raw.find_first_of(".eE") == std::string::npos) {
      report_inexact(line, raw);
    } else if (value == 0.0 && raw.substr(0, raw.find_first_of("eE")).find_first_of("123456789") != std::string::npos) {
      report(line, element(), "the number " + raw + " is too small for a double and would silently become 0");
      source_.unreadable.insert(element());
    }
    return place(value, line);
  }

  bool start_object(std::size_t /*elements*/) override { return open(json::object()); }
  bool start_array(std::size_t /*elements*/) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& key) override {
    Frame& frame = frames_.back();
    frame.key = key;
    frame.key_line = here();
    const auto [first, fresh] = frame.seen.emplace(key, frame.key_line);
    if (!fresh) {
      report(frame.key_line, element(),
             "duplicate key '" + key + "': it stands on line " + std::to_string(first->second) + " already");
    }
    return true;
  }

  bool parse_error(std::size_t /*position*/, const std::string& /*last_token*/,
                   const nlohmann::detail::exception& error) override {
    std::string detail = error.what();
    if (const auto end = detail.find("] "); end != std::string::npos) detail.erase(0, end + 2);
    if (detail.rfind("parse error", 0) == 0) {
      if (const auto colon = detail.find(": "); colon != std::string::npos) detail.erase(0, colon + 2);
    }
    stumble = Stumble{consumed_,
                      detail,
                      frames_.empty() ? std::string() : element(),
                      last_,
                      last_end_,
                      frames_.empty() ? std::string() : frames_.back().pointer,
                      frames_.empty() ? 0 : frames_.back().line,
                      rooted_ && frames_.empty()};
    return false;
  }

 private:
  struct Frame {
    json* container;
    std::string pointer;
    int line;
    std::string key;
    int key_line = 0;
    std::map<std::string, int> seen;
  };

  [[nodiscard]] int here() const { return lines_.at(consumed_ == 0 ? 0 : consumed_ - 1); }

  /// Records the index of this number, its end and its line. The lexer has read one character beyond it, unless the
  /// text ended.
  [[nodiscard]] int note_number() {
    last_ = element();
    last_end_ = consumed_ - 1;
    std::size_t last = consumed_ - 1;
    while (last > 0 && !is_number_character(text_[last])) --last;
    return lines_.at(last);
  }

  /// Pointer of the element that is read, or of the next one.
  [[nodiscard]] std::string element() const {
    if (frames_.empty()) return {};
    const Frame& frame = frames_.back();
    return frame.pointer +
           (frame.container->is_array() ? "/" + std::to_string(frame.container->size()) : pointer_step(frame.key));
  }

  void report(int line, const std::string& pointer, std::string message) {
    source_.problems.push_back({source_.name, line, pointer, std::move(message)});
  }

  void report_inexact(int line, const std::string& raw) {
    report(line, element(), "the integer " + raw + " is beyond 2^53 = 9007199254740992 and not exact in a double");
    source_.unreadable.insert(element());
  }

  json* insert(json value, int line) {
    const std::string pointer = element();
    rooted_ = true;
    if (frames_.empty()) {
      source_.line[pointer] = line;
      source_.value = std::move(value);
      return &source_.value;
    }
    Frame& frame = frames_.back();
    if (frame.container->is_array()) {
      source_.line[pointer] = line;
      frame.container->push_back(std::move(value));
      return &frame.container->back();
    }
    source_.line[pointer] = frame.key_line;
    json& slot = (*frame.container)[frame.key];
    slot = std::move(value);
    return &slot;
  }

  bool place(json value, int line) {
    insert(std::move(value), line);
    return true;
  }

  bool open(json empty) {
    const std::string pointer = element();
    const int line = here();
    if (frames_.size() >= json_depth_max) {
      report(line, pointer, "nested deeper than " + std::to_string(json_depth_max) + " levels");
      too_deep = true;
      return false;
    }
    json* container = insert(std::move(empty), line);
    frames_.push_back({container, pointer, line, {}, 0, {}});
    return true;
  }

  bool close() {
    frames_.pop_back();
    return true;
  }

  std::string_view text_;
  const LineIndex& lines_;
  const std::size_t& consumed_;
  JsonSource& source_;
  std::vector<Frame> frames_;
  bool rooted_ = false;
  std::string last_;
  std::size_t last_end_ = 0;
};

/// Offset of the first byte that is not UTF-8 (RFC 3629), or npos.
std::size_t first_bad_utf8(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  for (std::size_t i = 0; i < text.size();) {
    const unsigned char lead = byte(i);
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xC2 && lead < 0xE0 ? 2
                               : lead >= 0xE0 && lead < 0xF0 ? 3
                               : lead >= 0xF0 && lead < 0xF5 ? 4
                                                             : 0;
    if (length == 0 || i + length > text.size()) return i;
    for (std::size_t k = 1; k < length; ++k)
      if ((byte(i + k) & 0xC0) != 0x80) return i;
    if ((lead == 0xE0 && byte(i + 1) < 0xA0) || (lead == 0xED && byte(i + 1) > 0x9F) ||
        (lead == 0xF0 && byte(i + 1) < 0x90) || (lead == 0xF4 && byte(i + 1) > 0x8F))
      return i;
    i += length;
  }
  return std::string_view::npos;
}

std::string hex_byte(unsigned char byte) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  return {'0', 'x', digits[byte >> 4U], digits[byte & 0xFU]};
}

std::size_t first_not_text(std::string_view text) { return std::min(first_bad_utf8(text), text.find('\0')); }

/// A place that can be replaced by blanks, so that reading continues.
struct Repair {
  std::size_t begin = 0, end = 0;
  std::string by;  ///< put at begin; the rest becomes spaces
  std::string message;
  bool is_value = false;  ///< a value was replaced, the element is unreadable
  bool of_last = false;   ///< namely the number before the place
};

void apply(const Repair& repair, std::string& text) {
  for (std::size_t i = repair.begin; i < repair.end; ++i)
    if (text[i] != '\n') text[i] = ' ';
  text.replace(repair.begin, repair.by.size(), repair.by);
}

std::optional<Repair> comment_at(std::string_view text, std::size_t at) {
  if (text[at] == '#' || text.substr(at, 2) == "//") {
    return Repair{at, std::min(text.find('\n', at), text.size()), "", "a comment is not JSON: use a \"note\" key"};
  }
  if (text.substr(at, 2) == "/*") {
    const auto close = text.find("*/", at + 2);
    return Repair{at, close == std::string_view::npos ? text.size() : close + 2, "",
                  "a comment is not JSON: use a \"note\" key"};
  }
  return std::nullopt;
}

constexpr const char* unit_message = "a number stands alone; its unit stands in the key";
constexpr const char* decimal_message = "a point stands before decimals, no comma, and nothing between thousands";

std::string word_message(std::string_view word, bool overflow) {
  const std::string shown = "'" + std::string(word.substr(0, 40)) + "'";
  if (overflow) return "number overflow: " + std::string(word) + " is beyond what a double holds (about 1.8e308)";
  std::string bare = lower_case(word);
  if (!bare.empty() && (bare[0] == '-' || bare[0] == '+')) bare.erase(0, 1);
  if (bare == "nan" || bare == "inf" || bare == "infinity")
    return shown + " is not a number in JSON: give a finite number";
  if (bare == "true" || bare == "false" || bare == "null") return shown + " is not JSON: write " + bare;
  if (const std::string hint = misspelt_number(word); !hint.empty()) return shown + " is not a number in JSON: " + hint;
  if (is_number_character(word[0]) && word[0] != 'e' && word[0] != 'E')
    return shown + " is not a number in JSON: no sign +, leading zeros, bare point, digit groups or hexadecimals";
  return shown + " is not JSON: a string stands in double quotes";
}

/// A bare word or a malformed number around `at`.
std::optional<Repair> word_at(std::string_view text, std::size_t at, bool overflow) {
  if (!is_word_character(text[at]) && at > 0) --at;
  while (overflow && at > 0 && !is_number_character(text[at])) --at;
  if (!is_word_character(text[at])) return std::nullopt;
  std::size_t begin = at, end = at + 1;
  while (begin > 0 && is_word_character(text[begin - 1])) --begin;
  while (end < text.size() && is_word_character(text[end])) ++end;
  const auto word = text.substr(begin, end - begin);
  if (!overflow && json::accept(word)) return std::nullopt;
  if (end == text.size()) {
    if (json::accept(std::string(word) + "0")) return std::nullopt;  // a number broken off
    for (const std::string_view as_printed : {"true", "false", "null"})
      if (as_printed.substr(0, word.size()) == word) return std::nullopt;  // broken off, not misspelt
  }
  return Repair{begin, end, "0", word_message(word, overflow), true};
}

/// A unit behind a number, which the lexer stumbled over at its first character.
std::optional<Repair> unit_at(std::string_view text, std::size_t at) {
  std::size_t before = at;
  while (before > 0 && (text[before - 1] == ' ' || text[before - 1] == '\t')) --before;
  if (before == 0 || std::isdigit(static_cast<unsigned char>(text[before - 1])) == 0) return std::nullopt;
  const bool word =
      before < at && std::isalpha(static_cast<unsigned char>(text[at])) != 0;  // else word_at() reports it
  if (!word && text[at] != '%' && static_cast<unsigned char>(text[at]) < 0x80) return std::nullopt;
  const std::size_t end = std::min(text.find_first_of(",]}\n\"", at), text.size());
  return Repair{at, end, "", unit_message, true, true};
}

/// A comma before the decimals of a number, where the grammar expects a key.
std::optional<Repair> decimals_at(std::string_view text, std::size_t at) {
  while (at > 0 && !is_number_character(text[at])) --at;
  const std::size_t end = at + 1;
  while (at > 0 && is_number_character(text[at - 1])) --at;
  const bool comma = at > 1 && text[at - 1] == ',' && std::isdigit(static_cast<unsigned char>(text[at - 2])) != 0;
  return comma ? std::optional(Repair{at - 1, end, "", decimal_message, true, true}) : std::nullopt;
}

std::optional<Repair> repair_for(std::string_view text, const Stumble& stumble) {
  if (stumble.consumed == 0 || text.empty()) return std::nullopt;
  const std::size_t at = std::min(stumble.consumed, text.size()) - 1;
  const auto says = [&](std::string_view words) { return stumble.detail.find(words) != std::string::npos; };
  if (says("number overflow")) return word_at(text, at, true);
  if (auto comment = comment_at(text, at); comment && says("invalid literal")) return comment;
  if (stumble.after_end) return std::nullopt;
  if (text[at] == '}' || text[at] == ']') {
    std::size_t before = at;
    while (before > 0 && is_space(text[before - 1])) --before;
    if (before > 0 && text[before - 1] == ',')
      return Repair{before - 1, before, "", std::string("a comma before '") + text[at] + "' is not JSON"};
  }
  if (says("while parsing object key")) return says("unexpected number literal") ? decimals_at(text, at) : std::nullopt;
  if (says("invalid literal"))
    if (auto unit = unit_at(text, at)) return unit;
  if (says("invalid literal") || says("invalid number") || says("unexpected number literal"))
    return word_at(text, at, false);
  return std::nullopt;
}

std::string stumble_message(std::string_view text, const Stumble& stumble) {
  const auto says = [&](std::string_view words) { return stumble.detail.find(words) != std::string::npos; };
  if (stumble.after_end) return "text after the end of the JSON document";
  if (stumble.consumed >= text.size() && (says("end of input") || says("closing quote") || says("invalid literal") ||
                                          says("invalid number") || says("\\u"))) {
    return "the file breaks off here" +
           (stumble.container_line == 0
                ? std::string()
                : ", inside the object or array that opens on line " + std::to_string(stumble.container_line));
  }
  const std::size_t at = stumble.consumed == 0 ? 0 : stumble.consumed - 1;
  if (at < text.size() && text[at] == '\'')
    return "not valid JSON: strings and keys stand in double quotes, not single";
  if (says("while parsing object key"))
    return "not valid JSON: a key in double quotes is expected (" + stumble.detail + ")";
  if (says("expected ',' or") || says("expected '}'") || says("expected ']'"))
    return "not valid JSON: is a comma missing before this? (" + stumble.detail + ")";
  return "not valid JSON: " + stumble.detail;
}

}  // namespace

std::string not_text(std::string_view text) {
  const std::size_t bad = first_not_text(text);
  if (bad == std::string_view::npos) return {};
  return "byte " + hex_byte(static_cast<unsigned char>(text[bad])) + " at offset " + std::to_string(bad) +
         " is not UTF-8 text";
}

std::string Problem::text() const {
  std::string result = file;
  if (line > 0) result += ":" + std::to_string(line);
  result += ": ";
  if (!pointer.empty()) result += pointer + ": ";
  return result + message;
}

namespace {
std::string joined(const std::vector<Problem>& problems) {
  std::string all;
  for (const auto& problem : problems) all += (all.empty() ? "" : "\n") + problem.text();
  return all;
}
}  // namespace

InputProblems::InputProblems(std::vector<Problem> problems)
    : InputError(joined(problems)), problems_(std::move(problems)) {}

int JsonSource::line_of(std::string_view pointer) const {
  for (;;) {
    if (const auto it = line.find(pointer); it != line.end()) return it->second;
    if (pointer.empty()) return 0;
    pointer = pointer_parent(pointer);
  }
}

void JsonSource::move(const std::string& from, const std::string& to) {
  std::vector<std::pair<std::string, int>> lines;
  for (auto it = line.lower_bound(from); it != line.end() && it->first.starts_with(from);)
    if (pointer_within(it->first, from)) {
      lines.emplace_back(to + it->first.substr(from.size()), it->second);
      it = line.erase(it);
    } else {
      ++it;
    }
  line.insert(lines.begin(), lines.end());
  std::vector<std::string> places;
  for (const std::string& place : unreadable)
    if (pointer_within(place, from)) places.push_back(place);
  for (const std::string& place : places) {
    unreadable.erase(place);
    unreadable.insert(to + place.substr(from.size()));
  }
}

namespace {
/// Why bytes are no text that could be JSON, and in which line (0: in none); empty if they may be.
std::pair<int, std::string> no_json_text(const std::string& bytes, const LineIndex& lines) {
  if (bytes.rfind("\xFF\xFE", 0) == 0 || bytes.rfind("\xFE\xFF", 0) == 0)
    return {1, "the file is UTF-16: JSON is read as UTF-8"};
  if (const auto bad = first_not_text(bytes); bad != std::string::npos)
    return {lines.at(bad), not_text(bytes) + ": is this a JSON file?"};
  if (std::all_of(bytes.begin(), bytes.end(), is_space)) return {0, "the file is empty"};
  return {};
}
}  // namespace

JsonSource parse_json(std::string bytes, std::string name) {
  JsonSource source;
  source.name = std::move(name);
  source.bytes = std::move(bytes);
  const auto fatal = [&](int line, const std::string& pointer, std::string message) {
    source.problems.push_back({source.name, line, pointer, std::move(message)});
  };

  if (source.bytes.size() > json_bytes_max) {
    fatal(0, "", "the file is larger than " + std::to_string(json_bytes_max >> 20U) + " MiB");
    return source;
  }
  const LineIndex lines(source.bytes);
  if (auto [line, message] = no_json_text(source.bytes, lines); !message.empty()) {
    fatal(line, "", std::move(message));
    return source;
  }

  std::string text = source.bytes;
  std::vector<Problem> repaired;
  std::set<std::string, std::less<>> unreadable;
  for (int pass = 0;; ++pass) {
    source.problems.clear();
    source.unreadable.clear();
    source.line.clear();
    source.value = nullptr;
    std::size_t consumed = 0;
    Handler handler(text, lines, consumed, source);
    const char* begin = text.data();
    source.complete =
        json::sax_parse(CountingIterator(begin, &consumed), CountingIterator(begin + text.size(), &consumed), &handler);
    if (source.complete || handler.too_deep || !handler.stumble) break;
    const Stumble& stumble = *handler.stumble;
    const auto repair = pass < repairs_max ? repair_for(text, stumble) : std::nullopt;
    if (!repair) {
      const std::size_t at = std::min(stumble.consumed, text.size());
      fatal(lines.at(at == 0 ? 0 : at - 1), stumble.after_end ? "" : stumble.pointer, stumble_message(text, stumble));
      break;
    }
    // A malformed number may have been read in part: 1e-1x is first the number 0.1, then a word.
    const bool of_last = repair->of_last || repair->begin < stumble.last_end;
    const std::string& pointer = of_last ? stumble.last : stumble.pointer;
    repaired.push_back(
        {source.name, lines.at(repair->begin), repair->is_value ? pointer : stumble.container, repair->message});
    if (repair->is_value) unreadable.insert(pointer);
    apply(*repair, text);
  }
  source.problems.insert(source.problems.end(), repaired.begin(), repaired.end());
  source.unreadable.merge(unreadable);
  std::stable_sort(source.problems.begin(), source.problems.end(),
                   [](const Problem& a, const Problem& b) { return a.line < b.line; });
  return source;
}

TextFile read_text_file(const std::filesystem::path& path, const std::string& kind) {
  const auto refuse = [&](std::string message) { return TextFile{{}, std::move(message)}; };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    return refuse(status.type() == std::filesystem::file_type::not_found ? "no such file"
                                                                         : "cannot be read: " + error.message());
  }
  if (std::filesystem::is_directory(status)) return refuse("is a directory, not a " + kind + " file");
  if (!std::filesystem::is_regular_file(status)) return refuse("is not a regular file");
  const FileDescriptor file = open_descriptor(path, O_RDONLY);
  if (!file.is_open()) {
    if (errno != EACCES && errno != EPERM && errno != ENOENT) throw_output_error(path, "open the file", errno);
    return refuse("cannot be opened for reading");
  }
  std::string bytes;
  std::vector<char> block(std::size_t{1} << 16);
  for (std::size_t count = block.size(); count == block.size() && bytes.size() <= json_bytes_max;) {
    count = read_at(file.get(), path, bytes.size(), block.data(), block.size());
    bytes.append(block.data(), count);
  }
  return {std::move(bytes), {}};
}

JsonSource read_json_file(const std::filesystem::path& path, std::string name) {
  if (name.empty()) name = path.string();
  TextFile text = read_text_file(path, "JSON");
  if (text.problem.empty()) return parse_json(std::move(text.bytes), std::move(name));
  JsonSource source;
  source.name = name;
  source.problems.push_back({std::move(name), 0, "", std::move(text.problem)});
  return source;
}

void JsonFiles::add(const std::filesystem::path& path, std::string text) {
  const std::scoped_lock lock(mutex_);
  files_.insert_or_assign(path, parse_json(std::move(text), path.string()));
}

const JsonSource& JsonFiles::read(const std::filesystem::path& path) {
  const std::scoped_lock lock(mutex_);
  if (const auto known = files_.find(path); known != files_.end()) return known->second;
  return files_.emplace(path, read_json_file(path)).first->second;
}

const TextFile& JsonFiles::read_text(const std::filesystem::path& path, const std::string& kind) {
  const std::scoped_lock lock(mutex_);
  if (const auto known = texts_.find(path); known != texts_.end()) return known->second;
  return texts_.emplace(path, read_text_file(path, kind)).first->second;
}

std::string misspelt_number(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  if (text.empty() || text.size() > 100) return {};
  if (json::accept(text)) {
    const json value = json::parse(text);
    return value.is_number() ? "write " + std::string(text) + " without quotes" : std::string();
  }
  if (text.front() == '+') text.remove_prefix(1);
  const std::string copy(text);
  char* end = nullptr;
  const double number = std::strtod(copy.c_str(), &end);
  const std::string_view rest = std::string_view(copy).substr(static_cast<std::size_t>(end - copy.c_str()));
  const bool decimal = copy.find_first_not_of("0123456789.eE+-") == std::string::npos;
  if (rest.size() == copy.size() || !std::isfinite(number)) return {};
  if (rest.empty()) return decimal ? "write " + json(number).dump() : std::string();
  const bool digits = rest.size() > 1 && std::isdigit(static_cast<unsigned char>(rest[1])) != 0;
  if (rest[0] == ',' && digits) return decimal_message;
  if (std::string_view("/*^").find(rest[0]) != std::string_view::npos && digits)
    return "nothing is calculated here: write the number itself";
  std::size_t unit = 0;
  while (unit < rest.size() && is_space(rest[unit])) ++unit;
  constexpr std::string_view of_units = "/%^*-()0123456789.\xC2\xB5\xCE\xBC\xB0\xB7\xB2\xB3 ";
  const auto in_unit = [&](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || of_units.find(c) != std::string_view::npos;
  };
  const bool begins = std::isalpha(static_cast<unsigned char>(rest[unit])) != 0 || rest[unit] == '%' ||
                      static_cast<unsigned char>(rest[unit]) >= 0x80;
  if (begins && lower_case(rest) != "e" && std::all_of(rest.begin(), rest.end(), in_unit) &&
      lower_case(copy.substr(0, 2)) != "0x")
    return unit_message;
  return {};
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::string pointer_step(std::string_view key) {
  std::string step = "/";
  for (const char c : key) {
    if (c == '~')
      step += "~0";
    else if (c == '/')
      step += "~1";
    else
      step += c;
  }
  return step;
}

std::string_view pointer_parent(std::string_view pointer) {
  const auto slash = pointer.rfind('/');
  return slash == std::string_view::npos ? std::string_view() : pointer.substr(0, slash);
}

std::string pointer_leaf(std::string_view pointer) {
  const auto slash = pointer.rfind('/');
  const auto step = slash == std::string_view::npos ? pointer : pointer.substr(slash + 1);
  std::string leaf;
  for (std::size_t i = 0; i < step.size(); ++i) {
    if (step[i] == '~' && i + 1 < step.size() && (step[i + 1] == '0' || step[i + 1] == '1')) {
      leaf += step[i + 1] == '0' ? '~' : '/';
      ++i;
    } else {
      leaf += step[i];
    }
  }
  return leaf;
}

std::vector<std::string> pointer_steps(std::string_view pointer) {
  std::vector<std::string> steps;
  while (!pointer.empty()) {
    const auto slash = pointer.find('/', 1);
    steps.push_back(pointer_leaf(pointer.substr(0, slash)));
    pointer = slash == std::string_view::npos ? std::string_view() : pointer.substr(slash);
  }
  return steps;
}

}  // namespace epicyclic::input
