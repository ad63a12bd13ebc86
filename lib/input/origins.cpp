#include "input/origins.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <string_view>

#include "input/pointers.hpp"
#include "input/stage_completion.hpp"

namespace epicyclic::input {

using nlohmann::json;

bool is_bookkeeping(const std::string& key) { return key == "origin" || key == "note"; }

namespace {

bool is_leaf(const json& value) { return !value.is_object(); }

bool is_origin_text(const std::string& text) {
  return std::any_of(origin_words.begin(), origin_words.end(), [&](std::string_view word) {
    return text == word || text.rfind(std::string(word) + ": ", 0) == 0;
  });
}

void check_origin_text(const json& value, const std::string& pointer, ReadContext& context) {
  static const std::vector<std::string> words(origin_words.begin(), origin_words.end());
  if (!value.is_string()) {
    context.add(Finding::Kind::type, pointer, "is " + described(value) + ", must be a string");
    return;
  }
  const auto& text = value.get_ref<const std::string&>();
  if (is_origin_text(text)) return;
  const auto word = text.substr(0, text.find_first_of(": "));
  context.add(Finding::Kind::range, pointer,
              "is " + described(value) + ", must be, or begin with and a colon and a space, one of: " + listed(words) +
                  suggestion(word, words));
}

}  // namespace

void check_origins(const json& value, const std::string& pointer, ReadContext& context) {
  if (!value.is_object()) return;
  if (const auto origin = value.find("origin"); origin != value.end()) {
    const std::string place = pointer + "/origin";
    if (origin->is_object()) {
      std::vector<std::string> keys;
      for (const auto& [key, child] : value.items())
        if (!is_bookkeeping(key) && keys.size() < findings_max) keys.push_back(key);
      for (const auto& [key, text] : origin->items()) {
        if (is_bookkeeping(key) || !value.contains(key)) {
          const bool in_words = context.findings.size() < findings_max;
          context.add(Finding::Kind::unknown_key, place + pointer_step(key),
                      "'" + key + "' is not a key of the object that this origin belongs to" +
                          (in_words ? suggestion(key, keys) : std::string()));
        } else {
          check_origin_text(text, place + pointer_step(key), context);
        }
      }
    } else {
      check_origin_text(*origin, place, context);
    }
  }
  for (const auto& [key, child] : value.items())
    if (!is_bookkeeping(key)) check_origins(child, pointer + pointer_step(key), context);
}

void spread_origins(json& object, const json& inherited) {
  if (!object.is_object()) return;
  json given = inherited;
  json map = json::object();
  if (const auto origin = object.find("origin"); origin != object.end()) {
    if (origin->is_string()) given = *origin;
    if (origin->is_object()) map = *origin;
    object.erase(origin);
  }
  for (auto& [key, child] : object.items()) {
    if (is_bookkeeping(key)) continue;
    json of_key = given;
    if (const auto it = map.find(key); it != map.end()) of_key = *it;
    if (is_leaf(child)) {
      if (of_key.is_string())
        map[key] = of_key;
      else
        map.erase(key);
    } else {
      map.erase(key);
      spread_origins(child, of_key);
    }
  }
  for (auto it = map.begin(); it != map.end();) it = object.contains(it.key()) ? std::next(it) : map.erase(it);
  if (!map.empty()) object["origin"] = map;
}

void apply_patch(json& target, json patch) {
  if (!patch.is_object()) return;
  json origins = json::object();
  if (const auto it = patch.find("origin"); it != patch.end()) {
    origins = *it;
    patch.erase(it);
  }
  if (!target.is_object()) target = json::object();
  for (const auto& [key, value] : patch.items()) {
    if (value.is_object()) {
      if (target.contains("origin")) target["origin"].erase(key);
      apply_patch(target[key], value);
      continue;
    }
    if (value.is_null()) {
      target.erase(key);
      if (target.contains("origin")) target["origin"].erase(key);
      continue;
    }
    target[key] = value;
    if (is_bookkeeping(key)) continue;
    const auto given = origins.find(key);
    target["origin"][key] = given == origins.end() ? "stage_patch" : "stage_patch: " + given->get<std::string>();
  }
  if (target.contains("origin") && target["origin"].empty()) target.erase("origin");
}

void fill_origins(json& resolved, const json& given) {
  json map = json::object();
  for (auto& [key, value] : resolved.items()) {
    const auto there = given.find(key);
    if (!is_leaf(value)) {
      static const json nothing = json::object();
      fill_origins(value, there != given.end() && there->is_object() ? *there : nothing);
    } else if (there == given.end()) {
      map[key] = "default";
    } else if (given.contains("origin") && given["origin"].contains(key)) {
      map[key] = given["origin"][key];
    }
  }
  if (!map.empty()) resolved["origin"] = map;
  if (const auto note = given.find("note"); note != given.end()) resolved["note"] = *note;
}

void keep_from_computing(json& root, const std::string& pointer) {
  json* at = &root;
  for (const auto& step : pointer_steps(pointer)) {
    if (!at->is_object()) break;
    if (const auto origin = at->find("origin"); origin != at->end() && origin->is_object()) {
      const auto text = origin->find(step);
      if (text != origin->end() && may_be_replaced(*text)) *text = "set: parameter";
    }
    at = find_at(*at, pointer_step(step));
    if (at == nullptr) break;
  }
}

void note_uncomputed(const json& resolved, const json& computed, std::vector<std::string>& notes) {
  std::vector<std::string> found;
  const std::function<void(const json&, const json*, const std::string&)> walk = [&](const json& object,
                                                                                     const json* known,
                                                                                     const std::string& pointer) {
    const auto origin = object.find("origin");
    for (const auto& [key, value] : object.items()) {
      if (is_bookkeeping(key)) continue;
      const json* there = known != nullptr && known->is_object() && known->contains(key) ? &known->at(key) : nullptr;
      const std::string place = pointer + pointer_step(key);
      if (value.is_object()) {
        walk(value, there, place);
      } else if (origin != object.end() && origin->contains(key) && is_computed(origin->at(key)) &&
                 (there == nullptr || *there != value)) {
        found.push_back(place);
      }
    }
  };
  walk(resolved, &computed, "");
  if (found.empty()) return;
  const std::string others = found.size() == 1 ? "" : " and " + std::to_string(found.size() - 1) + " more";
  notes.push_back(found.front() + others + ": \"computed\" is the origin in the file, but nothing computes " +
                  (others.empty() ? "it here; it stands" : "them here; they stand") + " as given");
}

}  // namespace epicyclic::input
