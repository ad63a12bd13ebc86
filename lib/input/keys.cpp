#include "input/keys.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/csv.hpp"
#include "input/field_table.hpp"
#include "input/study_input.hpp"

namespace epicyclic::input {

namespace {

using nlohmann::ordered_json;

std::string text_of(const ordered_json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return number_text(value.get<double>());
  return value.dump();
}

std::string range_of(const ordered_json& schema) {
  const auto low = schema.find("minimum");
  const auto high = schema.find("maximum");
  const auto above = schema.find("exclusiveMinimum");
  if (low != schema.end() && high != schema.end()) return text_of(*low) + " to " + text_of(*high);
  if (above != schema.end()) return "> " + text_of(*above) + (high == schema.end() ? "" : " to " + text_of(*high));
  return {};
}

/// What a value may be.
std::string bounds_of(const ordered_json& schema) {
  std::string all;
  const auto add = [&all](const std::string& text) {
    if (!text.empty()) all += (all.empty() ? "" : ", or ") + text;
  };
  if (const auto one = schema.find("enum"); one != schema.end()) {
    std::string names;
    for (const auto& name : *one) names += (names.empty() ? "" : ", ") + text_of(name);
    return "one of: " + names;
  }
  if (const auto only = schema.find("const"); only != schema.end()) return text_of(*only);
  if (const auto any = schema.find("anyOf"); any != schema.end()) {
    for (const auto& option : *any) add(bounds_of(option));
    return all;
  }
  if (schema.value("type", "") == "array") {
    const std::string each = schema.contains("items") ? bounds_of(schema["items"]) : std::string();
    return each.empty() ? "an array" : "an array of " + each;
  }
  if (schema.value("type", "") == "boolean") return "true or false";
  return range_of(schema);
}

class Walker {
 public:
  explicit Walker(const ordered_json& schema) : root_(schema) {}

  void walk(const ordered_json& given, const std::string& pointer, const std::string& kind) {
    const ordered_json& schema = resolved(given);
    if (const auto any = schema.find("anyOf"); any != schema.end())
      for (const auto& option : *any) {
        const ordered_json& one = resolved(option);
        walk(one, pointer, kind.empty() ? kind_of(one) : kind);
      }
    if (const auto items = schema.find("items"); items != schema.end()) walk(*items, pointer + "/N", kind);
    const auto properties = schema.find("properties");
    if (properties == schema.end()) return;
    for (const auto& [key, value] : properties->items()) {
      if (key == "origin" || key == "note" || key == schema_key) continue;
      const std::string place = pointer + pointer_step(key);
      add(place, key, value, kind);
      walk(value, place, kind);
    }
  }

  std::vector<KeyLine> take() { return std::move(lines_); }

 private:
  [[nodiscard]] const ordered_json& resolved(const ordered_json& schema) const {
    const auto ref = schema.find("$ref");
    if (ref == schema.end()) return schema;
    return root_.at(ordered_json::json_pointer(ref->get<std::string>().substr(1)));
  }

  /// Of a study: what its "kind" has to be.
  static std::string kind_of(const ordered_json& schema) {
    const auto kind = schema.find("properties");
    if (kind == schema.end() || !kind->contains("kind")) return {};
    const auto only = (*kind)["kind"].find("const");
    return only == (*kind)["kind"].end() ? std::string() : only->get<std::string>();
  }

  void add(const std::string& pointer, const std::string& key, const ordered_json& schema, const std::string& kind) {
    KeyLine line{pointer, kind, unit_of(key), {}, bounds_of(schema), schema.value("description", "")};
    if (const auto standard = schema.find("default"); standard != schema.end()) line.standard = text_of(*standard);
    if (key == "kind" && !kind.empty()) line.bounds = kind;
    const auto same = std::ranges::find_if(lines_, [&](const KeyLine& other) {
      return other.pointer == line.pointer && other.meaning == line.meaning && other.standard == line.standard &&
             (other.bounds == line.bounds || key == "kind");
    });
    if (same == lines_.end()) {
      lines_.push_back(std::move(line));
      return;
    }
    // Of a stage from drawings and a lumped one, or of several kinds of studies.
    if (!kind.empty() && (", " + same->kinds + ",").find(", " + kind + ",") == std::string::npos) {
      same->kinds += ", " + kind;
      if (key == "kind") same->bounds += ", " + kind;
    }
  }

  const ordered_json& root_;
  std::vector<KeyLine> lines_;
};

}  // namespace

std::vector<KeyLine> key_lines() {
  const ordered_json schema = ordered_json::parse(schema_text());
  Walker walker(schema);
  walker.walk(schema.at("$defs").at("study"), "", "");
  return walker.take();
}

std::string key_text(const KeyLine& key) {
  std::string text = key.pointer;
  if (!key.unit.empty()) text += " [" + key.unit + "]";
  std::string values = key.standard.empty() ? std::string() : "default " + key.standard;
  if (!key.bounds.empty()) values += (values.empty() ? "" : "; ") + key.bounds;
  if (!values.empty()) text += "  " + values;
  text += "  " + key.meaning;
  if (!key.kinds.empty()) text += " (" + key.kinds + ")";
  return text + "\n";
}

}  // namespace epicyclic::input
