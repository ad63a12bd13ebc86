#include "input/assignments.hpp"

#include <algorithm>
#include <utility>

#include "input/origins.hpp"
#include "input/pointers.hpp"

namespace epicyclic::input {

using nlohmann::json;

std::string assign(json& root, std::string_view pointer, const json& value) {
  json* at = &root;
  json* object = nullptr;  // innermost object, and the key in it
  std::string key;
  std::string so_far;
  for (const auto& step : pointer_steps(pointer)) {
    if (at->is_null()) *at = json::object();
    if (at->is_object()) {
      object = at;
      key = step;
      at = &(*at)[step];
    } else if (at->is_array()) {
      json* element = find_at(*at, pointer_step(step));
      if (element == nullptr)
        return "there is no element " + step + " in the array " + so_far + " of " + std::to_string(at->size());
      at = element;
    } else {
      return so_far + " is " + described(*at) + ": there is nothing below it";
    }
    so_far += pointer_step(step);
  }
  // A text of origin holds for the whole object: one for each key, before one key gets its own.
  if (object != nullptr && object->contains("origin") && (*object)["origin"].is_string()) spread_origins(*object);
  *at = value;
  // Origins of the object. There are none if its "origin" is not an object, which is reported for the file.
  const auto origins = [&]() -> json* {
    const auto there = object == nullptr ? json::iterator() : object->find("origin");
    return object != nullptr && there != object->end() && there->is_object() ? &*there : nullptr;
  };
  if (!value.is_object()) {
    if (object != nullptr && !is_bookkeeping(key) && !value.is_null()) {
      if (!object->contains("origin")) (*object)["origin"] = json::object();
      if (json* map = origins()) (*map)[key] = "set: command line";
    }
  } else {
    if (json* map = origins()) map->erase(key);
    if (!at->contains("origin")) (*at)["origin"] = "set: command line";
    spread_origins(*at);
  }
  if (value.is_null() && object != nullptr) {
    object->erase(key);
    if (json* map = origins()) map->erase(key);
  }
  return {};
}

std::vector<Assignment> parse_assignments(std::span<const std::string> texts) {
  std::vector<Assignment> sets;
  for (const auto& text : texts) {
    const auto equals = text.find('=');
    Assignment& set = sets.emplace_back(Assignment{text.substr(0, equals), {}, text});
    const auto refuse = [&](std::string message) { set.problems.push_back(std::move(message)); };
    if (std::string message = not_text(text); !message.empty()) {
      refuse(std::move(message));
      continue;
    }
    if (equals == std::string::npos) {
      const auto end = text.find_last_of(": \t");
      const auto meant =
          end == std::string::npos ? std::vector<std::string>() : meant_pointers(text.substr(0, end), all_places());
      refuse("must be /json/pointer=value: there is no '='" +
             (meant.size() == 1 ? "; did you mean '" + meant.front() + "=" + text.substr(end + 1) + "'?" : ""));
      continue;
    }
    if (set.pointer.size() < 2 || set.pointer[0] != '/') {
      std::string hint = suggested(meant_pointers(set.pointer, all_places()));
      if (const auto steps = loose_steps(set.pointer); hint.empty() && !steps.empty()) {
        for (const std::string& step : steps) hint += pointer_step(step);
        hint = "; did you mean '" + hint + "'?";
      }
      refuse("must be /json/pointer=value: a pointer begins with '/'" + hint);
      continue;
    }
    if (const auto steps = pointer_steps(set.pointer); std::find(steps.begin(), steps.end(), "origin") != steps.end()) {
      refuse("write an origin in the file; values given here have the origin \"set: command line\"");
      continue;
    }
    const std::string value = text.substr(equals + 1);
    if (value.empty()) {
      refuse("must be /json/pointer=value: there is no value behind '='");
      continue;
    }
    auto parsed = parse_json(value, "--set " + text);
    ReadContext context;
    check_origins(parsed.value, "", context);
    for (auto& finding : context.findings) refuse("the value: " + finding.pointer + " " + finding.message);
    if (parsed.complete && parsed.problems.empty()) {
      set.value = std::move(parsed.value);
    } else if (const std::string hint = misspelt_number(value); !hint.empty()) {
      refuse("the value: '" + value + "' is not a number in JSON: " + hint);
    } else if (value.find_first_of("{[\"+-0123456789") == 0) {  // sets out to be more than a word
      const bool word = parsed.problems.size() == 1 && value.find_first_of("{[\"") != 0;
      for (const auto& problem : parsed.problems)
        refuse("the value: " + problem.message +
               (word ? "; a text that begins like a number stands in double quotes" : ""));
    } else {
      set.value = value;
    }
  }
  return sets;
}

}  // namespace epicyclic::input
