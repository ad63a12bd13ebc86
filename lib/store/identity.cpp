#include "store/identity.hpp"

#include <cstddef>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "store/digest.hpp"
#include "store/journal.hpp"
#include "studies/claims.hpp"
#include "studies/speed_note.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::store {

namespace {

nlohmann::json identifying_values(nlohmann::json value, const nlohmann::json& computed) {
  if (!value.is_object()) return !computed.is_null() && value == computed ? nlohmann::json("computed") : value;
  value.erase("origin");
  value.erase("note");
  static const nlohmann::json nothing;
  for (auto& [key, child] : value.items()) {
    const bool known = computed.is_object() && computed.contains(key);
    child = identifying_values(std::move(child), known ? computed.at(key) : nothing);
  }
  return value;
}

/// A speed that is noted in the origin of the number at a place.
std::optional<studies::SpeedNote> speed_noted_at(const nlohmann::json& resolved,
                                                 const nlohmann::json::json_pointer& at) {
  if (at.empty()) return std::nullopt;
  const nlohmann::json::json_pointer origin = at.parent_pointer() / "origin" / at.back();
  if (!resolved.contains(origin) || !resolved.at(origin).is_string()) return std::nullopt;
  return studies::find_speed_note(resolved.at(origin).get_ref<const std::string&>());
}

/// What decides in a study: its values, and of claims, which keep a speed as it was given where a sweep or a candidate
/// changes the stage, that speed.
nlohmann::json identifying_study(const ResolvedValues& input) {
  nlohmann::json values = identifying_values(input.resolved, input.computed);
  static const nlohmann::json::json_pointer kind("/study/kind");
  static const nlohmann::json::json_pointer operation("/operation");
  if (!values.contains(kind) || values.at(kind) != "claims") return values;
  if (const auto noted = speed_noted_at(input.resolved, operation / studies::speed_parameter))
    values[operation / noted->key] = noted->value;
  return values;
}

}  // namespace

std::string identity(const ResolvedValues& input, std::string_view command) {
  nlohmann::json what = {{"command", command},
                         {"input", identifying_study(input)},
                         {"journal_format", journal_format_version},
                         {"numerics", studies::numerics_version}};
  // What these keep of a candidate is how it was judged.
  if (command == "calibrate" || command == "robustness") what["judging"] = studies::judging_version;
  return sha256_hex(canonical_json(what));
}

std::string given_as(const nlohmann::json& resolved, const std::string& pointer) {
  const auto noted = speed_noted_at(resolved, nlohmann::json::json_pointer(pointer));
  return noted ? fmt::format(" ({})", noted->text) : std::string();
}

std::vector<Difference> differing_values(const ResolvedValues& there, const ResolvedValues& here) {
  const nlohmann::json from = identifying_study(there);
  const nlohmann::json to = identifying_study(here);
  const auto text = [](const nlohmann::json& values, const nlohmann::json& resolved,
                       const nlohmann::json::json_pointer& at) {
    constexpr std::size_t longest = 60;
    const nlohmann::json* value = resolved.contains(at) ? &resolved.at(at)
                                  : values.contains(at) ? &values.at(at)
                                                        : nullptr;
    if (value == nullptr) return std::string("nothing");
    std::string shown = value->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return shown.size() <= longest ? shown + given_as(resolved, at.to_string()) : std::string("another value");
  };
  std::vector<Difference> all;
  for (const nlohmann::json& change : nlohmann::json::diff(from, to)) {
    const std::string pointer = change.at("path");
    const nlohmann::json::json_pointer at(pointer);
    // A number that only one of the catalogues gives, and the other input as well: it is what gives it that differs.
    if (there.resolved.contains(at) && here.resolved.contains(at) && there.resolved.at(at) == here.resolved.at(at))
      continue;
    all.push_back({pointer, fmt::format("{}: {} there, {} here", pointer, text(from, there.resolved, at),
                                        text(to, here.resolved, at))});
  }
  return all;
}

std::vector<std::string> differences(const ResolvedValues& there, const ResolvedValues& here) {
  std::vector<std::string> lines;
  for (Difference& d : differing_values(there, here)) lines.push_back(std::move(d.text));
  return lines;
}

}  // namespace epicyclic::store
