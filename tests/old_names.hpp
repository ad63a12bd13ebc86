// Inputs with the old names of lib/input/aliases.hpp in place of the new ones, one alias at a time.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "input/aliases.hpp"
#include "input/json_source.hpp"
#include "input/study_input.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::test {

/// Calls a function with each value at a place: "N" is any index, "*" any key.
inline void at_each(nlohmann::json& value, const std::vector<std::string>& steps, std::size_t from,
                    const std::function<void(nlohmann::json&)>& visit) {
  if (from == steps.size()) return visit(value);
  for (auto& [key, child] : value.items())
    if (value.is_array() ? steps[from] == "N" : value.is_object() && (steps[from] == "*" || steps[from] == key))
      at_each(child, steps, from + 1, visit);
}

/// Puts the old name of a key or of a value wherever the new one stands.
/// @returns how often it did
inline int use_old_name(nlohmann::json& whole, const input::Alias& alias) {
  int count = 0;
  const std::string old_name(alias.old_name);
  const std::string new_name(alias.new_name);
  const auto visit = [&](nlohmann::json& there) {
    if (alias.kind == input::Alias::Kind::value) {
      if (there != new_name) return;
      there = old_name;
      ++count;
    } else if (there.is_object() && there.contains(new_name)) {
      for (nlohmann::json* object : {&there, there.contains("origin") ? &there["origin"] : nullptr}) {
        if (object == nullptr || !object->is_object() || !object->contains(new_name)) continue;
        nlohmann::json member = std::move((*object)[new_name]);
        object->erase(new_name);
        (*object)[old_name] = std::move(member);
      }
      ++count;
    }
  };
  at_each(whole, input::pointer_steps(alias.place), 0, visit);
  return count;
}

/// Loads each of some resolved inputs with each old name that has a place in it: the resolved input is the same, and
/// one warning says so.
/// @returns the old names that had a place
inline std::set<const input::Alias*> expect_old_names_to_work(const std::vector<nlohmann::json>& inputs) {
  std::set<const input::Alias*> used;
  const TemporaryFolder folder;
  for (const nlohmann::json& resolved : inputs) {
    const std::string kind = input::study_of(resolved);
    for (const input::Alias& alias : input::aliases()) {
      nlohmann::json old = resolved;
      if (alias.kind == input::Alias::Kind::column || !(alias.study.empty() || alias.study == kind) ||
          use_old_name(old, alias) == 0)
        continue;
      used.insert(&alias);
      put_file(folder / "old.json", old.dump(1));
      const input::LoadedInput loaded = input::load_input(folder / "old.json");
      EXPECT_EQ(loaded.resolved, resolved) << alias.warning();
      std::vector<std::string> about_names;
      for (const std::string& note : loaded.notes)
        if (note.find("the old name works until") != std::string::npos) about_names.push_back(note);
      EXPECT_EQ(about_names, std::vector{alias.warning()});
    }
  }
  return used;
}

}  // namespace epicyclic::test
