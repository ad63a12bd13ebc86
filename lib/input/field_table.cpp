#include "input/field_table.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <utility>

#include "input/helix.hpp"

namespace epicyclic::input {

namespace {

/// Endings of keys that are units, right or wrong; longer ones first if one ends with another.
constexpr std::array<std::string_view, 48> units = {
    "Ns_per_m", "N_per_mm", "N_per_um", "N_per_m", "Nm_per_rad", "kNm", "Nm",  "Nmm", "kW", "MW",   "mW",  "W",
    "hp",       "kg",       "mg",       "lb",      "g",          "t",   "mm",  "um",  "nm", "cm",   "km",  "in",
    "inch",     "m",        "degrees",  "degree",  "deg",        "rad", "rpm", "kHz", "Hz", "s",    "ms",  "GPa",
    "MPa",      "kPa",      "Pa",       "percent", "kN",         "MN",  "N",   "J",   "C",  "mPas", "Pas", "kg_per_m3"};

std::string_view unit_ending(std::string_view key, bool any_case) {
  std::string_view best;
  const std::string shown = any_case ? lower_case(key) : std::string(key);
  for (const auto unit : units) {
    const std::string ending = "_" + (any_case ? lower_case(unit) : std::string(unit));
    if (shown.size() > ending.size() && shown.compare(shown.size() - ending.size(), ending.size(), ending) == 0 &&
        unit.size() > best.size())
      best = key.substr(key.size() - unit.size());
  }
  return best;
}

/// The key without its unit, in lower case.
std::string stem(std::string_view key, bool any_case) {
  const auto unit = unit_ending(key, any_case);
  return lower_case(unit.empty() ? key : key.substr(0, key.size() - unit.size() - 1));
}

/// Edit distance that counts a swap of neighbours as one (optimal string alignment); letter case is ignored.
std::size_t distance(std::string_view left, std::string_view right) {
  const std::string a = lower_case(left), b = lower_case(right);
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

std::string with_unit(std::string_view key) {
  const auto unit = unit_of(key);
  return "'" + std::string(key) + "'" + (unit.empty() ? "" : " (unit " + unit + ")");
}

/// The beginning of a text of any length.
std::string cut(const std::string& text) {
  constexpr std::size_t longest = 100;
  return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

/// The message on an unknown key, and the key that was meant.
std::pair<std::string, std::string> unknown_key(const std::string& key, const std::string& pointer,
                                                const std::vector<std::string>& known, const ReadContext& context) {
  std::string message = "unknown key '" + cut(key) + "'";
  if (key.starts_with("helix_angle")) return {message + ": " + no_helix, ""};
  if (context.findings.size() >= findings_max) return {message, ""};
  std::vector<std::string> same_quantity;
  const std::string quantity = stem(key, true);
  for (const auto& candidate : known)
    if (stem(candidate, false) == quantity) same_quantity.push_back(candidate);
  if (same_quantity.size() == 1 && !unit_of(same_quantity.front()).empty()) {
    message += "; did you mean " + with_unit(same_quantity.front()) + "?";
    return {message, pointer + pointer_step(same_quantity.front())};
  }
  std::vector<std::string> elsewhere;
  bool stands_here = false;
  for (const auto& place : context.places) {
    if (place.key != key) continue;
    stands_here = stands_here || place.pointer == pointer + pointer_step(key);
    if (std::find(elsewhere.begin(), elsewhere.end(), place.pointer) == elsewhere.end())
      elsewhere.push_back(place.pointer);
  }
  if (stands_here) return {message + " in an object of this kind; known here: " + listed(known), ""};
  if (!elsewhere.empty()) {
    // The nearest branches of the tree only.
    const auto shared = [&](const std::string& other) {
      const auto [here, there] = std::mismatch(pointer.begin(), pointer.end(), other.begin(), other.end());
      return std::count(pointer.begin(), here, '/');
    };
    const auto nearest_branch = shared(*std::max_element(
        elsewhere.begin(), elsewhere.end(), [&](const auto& a, const auto& b) { return shared(a) < shared(b); }));
    std::erase_if(elsewhere, [&](const std::string& other) { return shared(other) < nearest_branch; });
    if (elsewhere.size() > 4) elsewhere.resize(4);
    return {message + "; '" + key + "' belongs in " + listed(elsewhere), ""};
  }
  if (const auto near = nearest(key, known); !near.empty())
    return {message + "; did you mean " + with_unit(near) + "?", pointer + pointer_step(near)};
  return {message + "; known here: " + listed(known), ""};
}

/// The error in a text that was meant to be a number.
std::string number_hint(const nlohmann::json& value) {
  const std::string hint = value.is_string() ? misspelt_number(value.get_ref<const std::string&>()) : std::string();
  return hint.empty() ? "" : "; " + hint;
}

std::string shown_with_unit(const std::string& bound, std::string_view key) {
  const auto unit = unit_of(key);
  return bound + (unit.empty() ? "" : " [" + unit + "]");
}

}  // namespace

bool Bounds::contains(double value) const {
  return std::isfinite(value) && (min_excluded ? value > min : value >= min) &&
         (max_excluded ? value < max : value <= max);
}

std::string Bounds::text() const {
  std::string result;
  if (std::isfinite(min)) result = (min_excluded ? "> " : ">= ") + number_text(min);
  if (std::isfinite(max)) {
    if (!result.empty()) result += " and ";
    result += (max_excluded ? "< " : "<= ") + number_text(max);
  }
  return result.empty() ? "finite" : result;
}

void Bounds::describe(nlohmann::ordered_json& schema) const {
  if (std::isfinite(min)) schema[min_excluded ? "exclusiveMinimum" : "minimum"] = min;
  if (std::isfinite(max)) schema[max_excluded ? "exclusiveMaximum" : "maximum"] = max;
}

std::string number_text(double value) {
  constexpr double plain_max = 1e7;  // integers up to here without exponent
  if (value == std::floor(value) && std::abs(value) <= plain_max) return std::to_string(std::llround(value));
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string described(const nlohmann::json& value) {
  switch (value.type()) {
    case nlohmann::json::value_t::null:
      return "null";
    case nlohmann::json::value_t::object:
      return "an object";
    case nlohmann::json::value_t::array:
      return value.empty() ? "an empty array" : "an array of " + std::to_string(value.size());
    case nlohmann::json::value_t::string: {
      const auto text = value.dump(-1, ' ', true);  // escapes: a cut never splits a character of UTF-8
      return "the string " + (text.size() > 60 ? text.substr(0, 60) + "...\"" : text);
    }
    case nlohmann::json::value_t::boolean:
      return value.get<bool>() ? "true" : "false";
    case nlohmann::json::value_t::number_float:
      return number_text(value.get<double>());
    default:
      return value.dump();
  }
}

std::string unit_of(std::string_view key) {
  std::string unit(unit_ending(key, false));
  if (unit.rfind("Ns", 0) == 0 || unit.rfind("Nm", 0) == 0) unit.insert(1, " ");
  if (unit == "mPas" || unit == "Pas") unit.insert(unit.size() - 1, " ");
  if (const auto per = unit.find("_per_"); per != std::string::npos) unit.replace(per, 5, "/");
  return unit;
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, (word.size() + 1) / 3) + 1;
  for (const auto& candidate : candidates) {
    const std::size_t longer = std::max(word.size(), candidate.size()),
                      shorter = std::min(word.size(), candidate.size());
    if (longer - shorter >= best_distance) continue;
    const auto d = distance(word, candidate);
    if (d < best_distance) {
      best = candidate;
      best_distance = d;
    }
  }
  return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  const auto near = nearest(word, candidates);
  return near.empty() ? "" : "; did you mean '" + near + "'?";
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

namespace table_detail {

void check_note(const json& object, const std::string& pointer, ReadContext& context) {
  if (const auto note = object.find("note"); note != object.end() && !note->is_string())
    context.add(Finding::Kind::type, pointer + "/note", "is " + described(*note) + ", must be a string");
}

bool check_object(const json& value, const std::string& pointer, ReadContext& context) {
  if (value.is_object()) return true;
  context.add(Finding::Kind::type, pointer, "is " + described(value) + ", must be an object");
  return false;
}

bool check_list(const json& value, const std::string& pointer, std::size_t most, ReadContext& context) {
  if (!value.is_array()) {
    context.add(Finding::Kind::type, pointer, "is " + described(value) + ", must be an array of objects");
    return false;
  }
  if (value.size() <= most) return true;
  context.add(Finding::Kind::range, pointer,
              "has " + std::to_string(value.size()) + " elements, must have at most " + std::to_string(most));
  return false;
}

void check_keys(const json& object, const std::string& pointer, const std::vector<std::string>& known,
                const std::vector<KeyRule>& rules, ReadContext& context) {
  for (const auto& [key, value] : object.items()) {
    if (key == schema_key && (pointer.empty() || pointer == "/stage")) {
      if (!value.is_string())
        context.add(Finding::Kind::type, pointer + pointer_step(key), "is " + described(value) + ", must be a string");
      continue;
    }
    if (key == "origin" || key == "note" || std::find(known.begin(), known.end(), key) != known.end()) continue;
    auto [message, meant] = unknown_key(key, pointer, known, context);
    context.findings.push_back({Finding::Kind::unknown_key, pointer + pointer_step(key), message, meant});
  }
  check_note(object, pointer, context);

  for (const auto& rule : rules) {
    std::vector<std::string> present, absent;
    for (const auto& key : rule.keys) (object.contains(key) ? present : absent).push_back(key);
    const auto quoted = [](const std::vector<std::string>& keys) {
      std::string text;
      for (const auto& key : keys) text += (text.empty() ? "'" : ", '") + key + "'";
      return text;
    };
    switch (rule.kind) {
      case KeyRule::Kind::exactly_one:
        if (present.empty())
          context.add(Finding::Kind::missing_key, pointer,
                      "exactly one of " + quoted(rule.keys) + " is needed, none is given");
        [[fallthrough]];
      case KeyRule::Kind::at_most_one:
        if (present.size() > 1)
          context.add(Finding::Kind::rule, pointer, quoted(present) + " exclude each other: give one of them");
        break;
      case KeyRule::Kind::together:
        if (!present.empty() && !absent.empty())
          context.add(Finding::Kind::rule, pointer, quoted(present) + " needs " + quoted(absent) + " beside it");
        break;
      case KeyRule::Kind::needs:
        if (object.contains(rule.keys[0]) && !object.contains(rule.keys[1]))
          context.add(Finding::Kind::rule, pointer + pointer_step(rule.keys[0]),
                      "needs '" + rule.keys[1] + "' beside it");
        break;
      case KeyRule::Kind::not_empty: {
        const auto says_something = [](const auto& item) { return item.key() != "origin" && item.key() != "note"; };
        const auto items = object.items();
        if (std::none_of(items.begin(), items.end(), says_something))
          context.add(Finding::Kind::rule, pointer,
                      "is an object with nothing in it: give one at least of " + quoted(rule.keys) +
                          ", or leave the whole of it out");
        break;
      }
    }
  }
}

std::optional<double> read_number(const json& value, const std::string& pointer, std::string_view key,
                                  const Bounds& bounds, ReadContext& context, std::string_view also) {
  if (!value.is_number()) {
    context.add(Finding::Kind::type, pointer,
                "is " + described(value) + ", must be a number" + std::string(also) + ", " +
                    shown_with_unit(bounds.text(), key) + number_hint(value));
    return std::nullopt;
  }
  const double number = value.get<double>();
  if (!bounds.contains(number))
    context.add(Finding::Kind::range, pointer,
                "is " + described(value) + ", must be " + shown_with_unit(bounds.text(), key));
  if (!std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<double> read_integer(const json& value, const std::string& pointer, const Bounds& bounds,
                                   ReadContext& context) {
  if (!value.is_number()) {
    context.add(Finding::Kind::type, pointer,
                "is " + described(value) + ", must be an integer " + bounds.text() + number_hint(value));
    return std::nullopt;
  }
  const double number = value.get<double>();
  if (!std::isfinite(number) || number != std::floor(number)) {
    context.add(Finding::Kind::type, pointer, "is " + described(value) + ", must be an integer " + bounds.text());
    return std::nullopt;
  }
  if (!bounds.contains(number))
    context.add(Finding::Kind::range, pointer, "is " + described(value) + ", must be an integer " + bounds.text());
  return number;
}

std::optional<std::vector<double>> read_numbers(const json& value, const std::string& pointer, std::string_view key,
                                                const Bounds& bounds, std::size_t size_min, std::size_t size_max,
                                                ReadContext& context) {
  if (!value.is_array()) {
    context.add(Finding::Kind::type, pointer, "is " + described(value) + ", must be an array of numbers");
    return std::nullopt;
  }
  if (value.size() < size_min || value.size() > size_max) {
    context.add(Finding::Kind::range, pointer,
                "has " + std::to_string(value.size()) + " elements, must have " + std::to_string(size_min) + " to " +
                    std::to_string(size_max));
    return std::nullopt;
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (const auto number = read_number(value[i], pointer + "/" + std::to_string(i), key, bounds, context))
      numbers.push_back(*number);
  }
  if (numbers.size() != value.size()) return std::nullopt;
  return numbers;
}

std::optional<std::size_t> read_name(const json& value, const std::string& pointer,
                                     const std::vector<std::string>& names, ReadContext& context) {
  if (value.is_string()) {
    const auto& name = value.get_ref<const std::string&>();
    if (const auto it = std::find(names.begin(), names.end(), name); it != names.end())
      return static_cast<std::size_t>(it - names.begin());
    context.add(Finding::Kind::range, pointer,
                "is \"" + name + "\", must be one of: " + listed(names) + suggestion(name, names));
  } else {
    context.add(Finding::Kind::type, pointer, "is " + described(value) + ", must be one of: " + listed(names));
  }
  return std::nullopt;
}

/// Suggestion for a value that is no boolean: "; did you mean ...?".
static std::string boolean_hint(const json& value) {
  std::string word = value.is_string() ? lower_case(value.get_ref<const std::string&>()) : value.dump();
  for (const auto& [meant, words] :
       {std::pair("true", std::array{"true", "yes", "on", "1"}), {"false", std::array{"false", "no", "off", "0"}}})
    for (const char* other : words)
      if (word == other) return std::string("; did you mean ") + meant + "?";
  return {};
}

/// Suggestion for a value that is no array of these names.
static std::string array_hint(const json& value, const std::vector<std::string>& names) {
  if (!value.is_string()) return {};
  json meant = json::array();
  std::string word;
  for (const char c : value.get_ref<const std::string&>() + ",") {
    if (c != ',' && c != ' ') {
      word += c;
    } else if (!word.empty()) {
      if (std::find(names.begin(), names.end(), word) == names.end()) return {};
      meant.push_back(std::exchange(word, {}));
    }
  }
  return meant.empty() ? "" : "; did you mean " + meant.dump() + "?";
}

ordered_json number_schema(const Bounds& bounds, bool integer) {
  ordered_json schema = {{"type", integer ? "integer" : "number"}};
  bounds.describe(schema);
  return schema;
}

ordered_json numbers_schema(const Bounds& bounds, std::size_t size_min, std::size_t size_max) {
  return {{"type", "array"}, {"items", number_schema(bounds)}, {"minItems", size_min}, {"maxItems", size_max}};
}

Format<double> number_format(std::string_view key, const Bounds& bounds) {
  Format<double> format;
  format.read = [=, key = std::string(key)](const json& value, const std::string& pointer, ReadContext& context) {
    return read_number(value, pointer, key, bounds, context);
  };
  format.schema = [=] { return number_schema(bounds); };
  return format;
}

Format<double> number_or_rigid_format(std::string_view key, const Bounds& bounds) {
  Format<double> format;
  format.read = [=, key = std::string(key)](const json& value, const std::string& pointer,
                                            ReadContext& context) -> std::optional<double> {
    if (value == "rigid") return std::numeric_limits<double>::infinity();
    return read_number(value, pointer, key, bounds, context, " or the string \"rigid\"");
  };
  format.write = [](double value) { return std::isfinite(value) ? json(value) : json("rigid"); };
  format.schema = [=] { return ordered_json{{"anyOf", {number_schema(bounds), {{"const", "rigid"}}}}}; };
  return format;
}

Format<int> integer_or_auto_format(const Bounds& bounds) {
  Format<int> format = integer_format<int>(bounds);
  format.read = [read = format.read](const json& value, const std::string& pointer,
                                     ReadContext& context) -> std::optional<int> {
    if (value == "auto") return 0;
    return read(value, pointer, context);
  };
  format.write = [](int value) { return value == 0 ? json("auto") : json(value); };
  format.schema = [=] { return ordered_json{{"anyOf", {number_schema(bounds, true), {{"const", "auto"}}}}}; };
  return format;
}

Format<bool> boolean_format() {
  Format<bool> format;
  format.read = [](const json& value, const std::string& pointer, ReadContext& context) -> std::optional<bool> {
    if (value.is_boolean()) return value.get<bool>();
    context.add(Finding::Kind::type, pointer,
                "is " + described(value) + ", must be true or false" + boolean_hint(value));
    return std::nullopt;
  };
  format.schema = [] { return ordered_json{{"type", "boolean"}}; };
  return format;
}

Format<std::string> text_format() {
  Format<std::string> format;
  format.read = [](const json& value, const std::string& pointer, ReadContext& context) -> std::optional<std::string> {
    if (value.is_string()) return value.get<std::string>();
    context.add(Finding::Kind::type, pointer, "is " + described(value) + ", must be a string");
    return std::nullopt;
  };
  format.write = [](const std::string& text) { return text.empty() ? json() : json(text); };
  format.schema = [] { return ordered_json{{"type", "string"}}; };
  return format;
}

Format<std::vector<std::string>> texts_format(std::size_t size_max) {
  using Texts = std::vector<std::string>;
  Format<Texts> format;
  format.read = [=](const json& value, const std::string& pointer, ReadContext& context) -> std::optional<Texts> {
    const bool texts =
        value.is_array() && std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_string(); });
    if (texts && value.size() <= size_max) return value.get<Texts>();
    context.add(Finding::Kind::type, pointer,
                "is " + described(value) + ", must be an array of at most " + std::to_string(size_max) + " strings");
    return std::nullopt;
  };
  format.write = [](const Texts& texts) { return texts.empty() ? json() : json(texts); };
  format.schema = [=] {
    return ordered_json{{"type", "array"}, {"maxItems", size_max}, {"items", {{"type", "string"}}}};
  };
  return format;
}

Format<std::vector<double>> numbers_format(std::string_view key, const Bounds& bounds, std::size_t size_min,
                                           std::size_t size_max) {
  Format<std::vector<double>> format;
  format.read = [=, key = std::string(key)](const json& value, const std::string& pointer, ReadContext& context) {
    return read_numbers(value, pointer, key, bounds, size_min, size_max, context);
  };
  format.write = [=](const std::vector<double>& numbers) {
    return numbers.size() >= size_min ? json(numbers) : json();
  };
  format.schema = [=] { return numbers_schema(bounds, size_min, size_max); };
  return format;
}

Format<std::vector<double>> number_or_numbers_format(std::string_view key, const Bounds& bounds, std::size_t size_max) {
  using Numbers = std::optional<std::vector<double>>;
  Format<std::vector<double>> format;
  format.read = [=, key = std::string(key)](const json& value, const std::string& pointer,
                                            ReadContext& context) -> Numbers {
    if (value.is_array()) return read_numbers(value, pointer, key, bounds, 1, size_max, context);
    const auto number = read_number(value, pointer, key, bounds, context, " or an array of numbers");
    if (!number) return std::nullopt;
    return std::vector<double>{*number};
  };
  format.write = [](const std::vector<double>& numbers) {
    return numbers.size() == 1 ? json(numbers.front()) : json(numbers);
  };
  format.schema = [=] { return ordered_json{{"anyOf", {number_schema(bounds), numbers_schema(bounds, 1, size_max)}}}; };
  return format;
}

Format<std::size_t> name_format(const std::vector<std::string>& names) {
  Format<std::size_t> format;
  format.read = [=](const json& value, const std::string& pointer, ReadContext& context) {
    return read_name(value, pointer, names, context);
  };
  format.write = [=](std::size_t place) { return place < names.size() ? json(names[place]) : json(); };
  format.schema = [=] { return ordered_json{{"enum", names}}; };
  return format;
}

Format<std::vector<std::size_t>> names_format(const std::vector<std::string>& names) {
  using Places = std::vector<std::size_t>;
  Format<Places> format;
  format.read = [=](const json& value, const std::string& pointer, ReadContext& context) -> std::optional<Places> {
    if (!value.is_array() || value.empty()) {
      context.add(Finding::Kind::type, pointer,
                  "is " + described(value) + ", must be an array of one or more of: " + listed(names) +
                      array_hint(value, names));
      return std::nullopt;
    }
    Places chosen;
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string element = pointer + "/" + std::to_string(i);
      const auto place = read_name(value[i], element, names, context);
      if (!place) continue;
      if (std::find(chosen.begin(), chosen.end(), *place) != chosen.end()) {
        context.add(Finding::Kind::rule, element, "\"" + names[*place] + "\" stands twice");
      } else {
        chosen.push_back(*place);
      }
    }
    if (chosen.empty()) return std::nullopt;
    return chosen;
  };
  format.write = [=](const Places& places) {
    json array = json::array();
    for (const std::size_t place : places) array.push_back(place < names.size() ? json(names[place]) : json());
    return array;
  };
  format.schema = [=] {
    return ordered_json{{"type", "array"}, {"items", {{"enum", names}}}, {"minItems", 1}, {"uniqueItems", true}};
  };
  return format;
}

ordered_json object_schema(const std::string& title, const std::string& description, const ordered_json& properties,
                           const std::vector<std::string>& required, const std::vector<KeyRule>& rules) {
  ordered_json schema = {
      {"type", "object"}, {"title", title}, {"description", description}, {"properties", properties}};
  schema["properties"]["origin"] = {{"$ref", "#/$defs/origin"}};
  schema["properties"]["note"] = {{"type", "string"}, {"description", "For readers; nothing depends on it."}};
  if (!required.empty()) schema["required"] = required;
  schema["additionalProperties"] = false;
  ordered_json all = ordered_json::array();
  for (const auto& rule : rules) {
    switch (rule.kind) {
      case KeyRule::Kind::exactly_one: {
        ordered_json one = ordered_json::array();
        for (const auto& key : rule.keys) one.push_back({{"required", ordered_json::array({key})}});
        all.push_back({{"oneOf", one}});
        break;
      }
      case KeyRule::Kind::at_most_one:
        for (std::size_t i = 0; i < rule.keys.size(); ++i)
          for (std::size_t k = i + 1; k < rule.keys.size(); ++k)
            all.push_back({{"not", {{"required", {rule.keys[i], rule.keys[k]}}}}});
        break;
      case KeyRule::Kind::together:
        for (const auto& key : rule.keys) schema["dependentRequired"][key] = rule.keys;
        break;
      case KeyRule::Kind::needs:
        schema["dependentRequired"][rule.keys[0]] = ordered_json::array({rule.keys[1]});
        break;
      case KeyRule::Kind::not_empty: {
        ordered_json some = ordered_json::array();
        for (const auto& key : rule.keys) some.push_back({{"required", ordered_json::array({key})}});
        all.push_back({{"anyOf", some}});
        break;
      }
    }
  }
  if (!all.empty()) schema["allOf"] = all;
  return schema;
}

}  // namespace table_detail

AnyField& AnyTable::add_leaf(std::string_view key, const table_detail::AnyAccess& at, table_detail::AnyFormat format,
                             std::string_view description) {
  AnyField& field = fields_.emplace_back();
  field.key = key;
  field.description = description;
  field.write = [find = at.find, write = std::move(format.write)](const void* object) {
    const void* found = find(object);
    return found == nullptr ? json() : write(found);
  };
  field.read = [at, read = std::move(format.read)](const json& value, const std::string& pointer, void* object,
                                                   ReadContext& context) { read(value, pointer, at, object, context); };
  field.schema = std::move(format.schema);
  return field;
}

AnyField& AnyTable::add_object(std::string_view key, const table_detail::AnyAccess& at, const AnyTable& table) {
  AnyField& field = fields_.emplace_back();
  field.key = key;
  field.description = table.description();
  field.read = [make = at.make, &table](const json& value, const std::string& pointer, void* object,
                                        ReadContext& context) {
    table.read_any(value, pointer, make(object), context);
  };
  field.write = [find = at.find, &table](const void* object) {
    const void* found = find(object);
    json written = found == nullptr ? json() : table.write_any(found);
    return written.empty() ? json() : written;
  };
  field.schema = [&table] { return table.schema_any(table.make_plain_().get()); };
  field.collect = [&table](const std::string& pointer, std::vector<KeyPlace>& places) {
    table.collect(pointer, places);
  };
  field.change = [at, &table](std::string_view rest, double number, const std::string& pointer, void* object,
                              ReadContext& context) {
    return at.find(object) != nullptr && table.change_any(rest, number, pointer, at.make(object), context);
  };
  return field;
}

AnyField& AnyTable::add_objects(std::string_view key, const table_detail::AnyAccess& at, table_detail::AnyList list,
                                const AnyTable& table, std::size_t most, std::string_view description) {
  AnyField& field = fields_.emplace_back();
  field.key = key;
  field.description = description;
  field.read = [make = at.make, list, &table, most](const json& value, const std::string& pointer, void* object,
                                                    ReadContext& context) {
    if (!table_detail::check_list(value, pointer, most, context)) return;
    void* elements = make(object);
    list.clear(elements);
    for (std::size_t k = 0; k < value.size(); ++k)
      table.read_any(value[k], pointer + "/" + std::to_string(k), list.append(elements), context);
  };
  field.write = [find = at.find, list, &table](const void* object) {
    json written = json::array();
    if (const void* found = find(object))
      for (std::size_t k = 0; k < list.size(found); ++k) written.push_back(table.write_any(list.element(found, k)));
    return written.empty() ? json() : written;
  };
  field.schema = [&table, most] {
    return ordered_json{{"type", "array"}, {"maxItems", most}, {"items", table.schema_any(table.make_plain_().get())}};
  };
  return field;
}

namespace {

/// Is there a finding of the value of this key?
bool is_refused(const std::string& key, const ReadContext& context) {
  return std::ranges::any_of(context.findings, [&](const Finding& f) {
    return (f.kind == Finding::Kind::type || f.kind == Finding::Kind::range) && f.pointer.ends_with("/" + key);
  });
}

}  // namespace

void AnyTable::read_any(const json& value, const std::string& pointer, void* object, ReadContext& context) const {
  if (!table_detail::check_object(value, pointer, context)) return;
  table_detail::check_keys(value, pointer, keys(), rules_, context);
  for (const auto& field : fields_) {
    const std::string place = pointer + pointer_step(field.key);
    if (const auto it = value.find(field.key); it != value.end()) {
      field.read(*it, place, object, context);
    } else if (field.is_required &&
               !(field.excused && (field.excused(object) || is_refused(field.excused_by, context)))) {
      context.add(Finding::Kind::missing_key, place, "is missing: " + field.description);
    }
  }
}

bool AnyTable::change_any(std::string_view rest, double number, const std::string& pointer, void* object,
                          ReadContext& context) const {
  if (rest.empty() || rest.front() != '/') return false;
  const std::string_view key = rest.substr(1, rest.find('/', 1) - 1);
  const auto field = std::find_if(fields_.begin(), fields_.end(), [&](const auto& f) { return f.key == key; });
  if (field == fields_.end()) return false;
  const std::string_view below = rest.substr(1 + key.size());
  if (field->change) return field->change(below, number, pointer, object, context);
  json value = field->write(object);
  if (below.empty()) {
    if (!value.is_number()) return false;
    field->read(number, pointer, object, context);
    return true;
  }
  const json::json_pointer element{std::string(below)};
  if (!value.is_array() || !value.contains(element) || !value[element].is_number()) return false;
  value[element] = number;
  field->read(value, pointer.substr(0, pointer.size() - below.size()), object, context);
  return true;
}

nlohmann::json AnyTable::write_any(const void* object) const {
  json written = json::object();
  for (const auto& field : fields_) {
    json value = field.write(object);
    if (!value.is_null()) written[field.key] = std::move(value);
  }
  return written;
}

nlohmann::ordered_json AnyTable::schema_any(const void* plain) const {
  const json defaults = write_any(plain);
  ordered_json properties = ordered_json::object();
  std::vector<std::string> required;
  for (const auto& field : fields_) {
    ordered_json property = field.schema();
    if (!property.contains("description")) property["description"] = field.description;
    const auto given = defaults.find(field.key);
    if (field.is_required) {
      if (!field.excused) required.push_back(field.key);
    } else if (given != defaults.end() && !given->is_object()) {
      property["default"] = *given;
    }
    properties[field.key] = std::move(property);
  }
  return table_detail::object_schema(name_, description_, properties, required, rules_);
}

std::vector<std::string> AnyTable::keys() const {
  std::vector<std::string> all;
  for (const auto& field : fields_) all.push_back(field.key);
  return all;
}

void AnyTable::collect(const std::string& pointer, std::vector<KeyPlace>& places) const {
  for (const auto& field : fields_) {
    const std::string place = pointer + pointer_step(field.key);
    places.push_back({field.key, place});
    if (field.collect) field.collect(place, places);
  }
}

}  // namespace epicyclic::input
