#include "reports/quantity_words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

#include "input/field_table.hpp"
#include "input/json_source.hpp"

namespace epicyclic::reports {

namespace {

using Words = std::pair<std::string_view, std::string_view>;

/// Keys without their units whose words are others than the key's own.
constexpr std::array<Words, 15> keys = {{{"backlash_half", "half backlash"},
                                         {"bearing", "bearing stiffness"},
                                         {"bearing_clearance_half", "half bearing clearance"},
                                         {"bore", "bore diameter"},
                                         {"inertia_over_r2", "inertia over r²"},
                                         {"poisson_ratio", "Poisson's ratio"},
                                         {"power", "sun power"},
                                         {"ring_planet_factor", "factor of the ring-planet mesh"},
                                         {"stiffness_cos", "stiffness, cosine"},
                                         {"stiffness_sin", "stiffness, sine"},
                                         {"sun_planet_factor", "factor of the sun-planet mesh"},
                                         {"support", "support stiffness"},
                                         {"torque", "sun torque"},
                                         {"torsional_support", "torsional support stiffness"},
                                         {"youngs_modulus", "Young's modulus"}}};

/// Objects that go without saying, and those with other words than their key.
constexpr std::array<Words, 8> objects = {{{"stage", ""},
                                           {"lumped", ""},
                                           {"catalogue", ""},
                                           {"load", ""},
                                           {"operation", ""},
                                           {"integrator", ""},
                                           {"sun_planet_mesh", "sun-planet mesh"},
                                           {"ring_planet_mesh", "ring-planet mesh"}}};

template <std::size_t n>
std::string words_of(std::string_view key, const std::array<Words, n>& known) {
  const auto found = std::ranges::find(known, key, &Words::first);
  std::string words(found == known.end() ? key : found->second);
  if (found == known.end()) std::ranges::replace(words, '_', ' ');
  return words;
}

/// As it is printed: "µm", "°".
std::string printed(const std::string& unit) {
  if (unit == "um") return "µm";
  if (unit == "deg") return "°";
  return unit;
}

}  // namespace

QuantityWords quantity_words(std::string_view pointer) {
  std::vector<std::string> steps = input::pointer_steps(pointer);
  std::string index;
  if (!steps.empty() && std::ranges::all_of(steps.back(), [](unsigned char c) { return std::isdigit(c) != 0; })) {
    index = std::to_string(std::stoul("0" + steps.back().substr(0, 9)) + 1);
    steps.pop_back();
  }
  if (steps.empty()) return {};
  const std::string key = std::move(steps.back());
  steps.pop_back();
  QuantityWords result;
  for (const std::string& step : steps)
    if (const std::string words = words_of(step, objects); !words.empty())
      result.words += (result.words.empty() ? "" : ", ") + words;
  if (!result.words.empty()) result.words += ": ";
  const std::string unit = input::unit_of(key);
  std::size_t end = key.size();  // end of the part before the unit
  if (!unit.empty())
    for (end = key.rfind('_'); input::unit_of("x" + key.substr(end)) != unit;) end = key.rfind('_', end - 1);
  result.words += words_of(std::string_view(key).substr(0, end), keys);
  if (!index.empty())
    result.words += (key.find("_cos") != std::string::npos || key.find("_sin") != std::string::npos ? ", harmonic "
                     : key.starts_with("error")                                                     ? ", planet "
                                                                                                    : " ") +
                    index;
  result.words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(result.words.front())));
  result.unit = key == "clearance_smoothing" ? "b_c" : printed(unit);
  return result;
}

}  // namespace epicyclic::reports
