#include "input/pointers.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "input/origins.hpp"
#include "input/study_input.hpp"

namespace epicyclic::input {

using nlohmann::json;

const json* find_at(const json& root, std::string_view pointer) {
  const json* at = &root;
  for (const auto& step : pointer_steps(pointer)) {
    if (at->is_object()) {
      const auto it = at->find(step);
      if (it == at->end()) return nullptr;
      at = &*it;
    } else if (at->is_array()) {
      const bool digits = !step.empty() && step.size() < 9 && step.find_first_not_of("0123456789") == std::string::npos;
      const bool plain = digits && (step.size() == 1 || step[0] != '0');
      if (!plain || std::stoul(step) >= at->size()) return nullptr;
      at = &(*at)[std::stoul(step)];
    } else {
      return nullptr;
    }
  }
  return at;
}

json* find_at(json& root, std::string_view pointer) { return const_cast<json*>(find_at(std::as_const(root), pointer)); }

void collect_numbers(const json& value, const std::string& pointer, std::vector<std::string>& pointers) {
  if (value.is_number()) pointers.push_back(pointer);
  if (value.is_object()) {
    for (const auto& [key, child] : value.items())
      if (!is_bookkeeping(key)) collect_numbers(child, pointer + pointer_step(key), pointers);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      collect_numbers(value[i], pointer + "/" + std::to_string(i), pointers);
  }
}

std::vector<std::string> loose_steps(std::string_view text) {
  std::vector<std::string> steps;
  std::string step;
  for (const char c : std::string(text) + "/") {
    if (std::string_view("/.:\\>[]\"' ").find(c) == std::string_view::npos)
      step += c;
    else if (!step.empty())
      steps.push_back(lower_case(std::exchange(step, {})));
  }
  while (!steps.empty() && steps.back().find_first_not_of("0123456789") == std::string::npos) steps.pop_back();
  if (!steps.empty()) steps.front().erase(0, steps.front().find_first_not_of("-$"));
  if (!steps.empty() && steps.front().empty()) steps.erase(steps.begin());
  return steps;
}

std::vector<std::string> meant_pointers(std::string_view text, const std::vector<KeyPlace>& places) {
  const std::vector<std::string> steps = loose_steps(text);
  std::array<std::vector<std::string>, 3> meant;  // the same, with the same end, with the same steps
  if (steps.empty()) return {};
  for (const auto& place : places) {
    const std::vector<std::string> there = loose_steps(place.pointer);
    if (there.empty() || there.back() != steps.back()) continue;
    std::size_t found = 0;
    for (const std::string& step : there)
      if (found < steps.size() && step == steps[found]) ++found;
    if (found < steps.size()) continue;
    const bool same_end = std::equal(steps.rbegin(), steps.rend(), there.rbegin());
    auto& these = meant[!same_end ? 2 : there.size() == steps.size() ? 0 : 1];
    if (std::find(these.begin(), these.end(), place.pointer) == these.end()) these.push_back(place.pointer);
  }
  const auto best = std::find_if(meant.begin(), meant.end(), [](const auto& these) { return !these.empty(); });
  return best == meant.end() ? std::vector<std::string>() : *best;
}

std::string suggested(const std::vector<std::string>& meant) {
  constexpr std::size_t most = 4;
  if (meant.empty() || meant.size() > most) return {};
  return "; did you mean " + (meant.size() == 1 ? "'" + meant.front() + "'" : "one of: " + listed(meant)) + "?";
}

const std::vector<KeyPlace>& all_places() {
  static const auto places = [] {
    std::vector<KeyPlace> all;
    study_table().collect("", all);
    return all;
  }();
  return places;
}

}  // namespace epicyclic::input
