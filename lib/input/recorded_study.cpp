#include "input/recorded_study.hpp"

#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "input/aliases.hpp"

namespace epicyclic::input {

namespace {

/// Pointer of a key, and the value of the behaviour before the key existed, as JSON.
constexpr std::array<std::pair<const char*, const char*>, 4> later_keys = {
    {{"/model/centrifugal", "\"left_out\""},
     {"/integrator/max_step_periods", "0.0"},
     {"/stage/catalogue/error_amplitude", "\"single_pitch\""},
     {"/stage/driver", "\"sun\""}}};

}  // namespace

void add_later_keys(nlohmann::json& resolved) {
  use_new_names(resolved);
  for (const auto& [pointer, value] : later_keys) {
    const nlohmann::json::json_pointer place(pointer);
    const nlohmann::json::json_pointer table = place.parent_pointer();
    if (resolved.contains(table) && resolved.at(table).is_object() && !resolved.contains(place))
      resolved[place] = nlohmann::json::parse(value);
  }
}

}  // namespace epicyclic::input
