#include "store/identity.hpp"

#include <cstddef>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "store/digest.hpp"
#include "store/journal.hpp"
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

}  // namespace

std::string identity(const ResolvedValues& input, std::string_view command, std::optional<int> judging) {
  nlohmann::json what = {{"command", command},
                         {"input", identifying_values(input.resolved, input.computed)},
                         {"journal_format", journal_format_version},
                         {"numerics", studies::numerics_version}};
  if (judging) what["judging"] = *judging;
  return sha256_hex(canonical_json(what));
}

std::vector<Difference> differing_values(const ResolvedValues& there, const ResolvedValues& here) {
  const nlohmann::json from = identifying_values(there.resolved, there.computed);
  const nlohmann::json to = identifying_values(here.resolved, here.computed);
  const auto text = [](const nlohmann::json& values, const nlohmann::json& resolved,
                       const nlohmann::json::json_pointer& at) {
    constexpr std::size_t longest = 60;
    const nlohmann::json* value = resolved.contains(at) ? &resolved.at(at)
                                  : values.contains(at) ? &values.at(at)
                                                        : nullptr;
    if (value == nullptr) return std::string("absent");
    std::string shown = value->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return shown.size() <= longest ? shown : std::string("another value");
  };
  // A list that is absent is read as an empty one.
  const auto is_empty = [](const nlohmann::json& values, const nlohmann::json::json_pointer& at) {
    return !values.contains(at) || (values.at(at).is_array() && values.at(at).empty());
  };
  std::vector<Difference> all;
  std::vector<Difference> empty;
  for (const nlohmann::json& change : nlohmann::json::diff(from, to)) {
    const std::string pointer = change.at("path");
    const nlohmann::json::json_pointer at(pointer);
    // A number that is equal in both inputs is no difference, although only one of the catalogues gives it.
    if (there.resolved.contains(at) && here.resolved.contains(at) && there.resolved.at(at) == here.resolved.at(at))
      continue;
    (is_empty(from, at) && is_empty(to, at) ? empty : all)
        .push_back({pointer, fmt::format("{}: {} there, {} here", pointer, text(from, there.resolved, at),
                                         text(to, here.resolved, at))});
  }
  return all.empty() ? empty : all;
}

std::vector<std::string> differences(const ResolvedValues& there, const ResolvedValues& here) {
  std::vector<std::string> lines;
  for (Difference& d : differing_values(there, here)) lines.push_back(std::move(d.text));
  return lines;
}

}  // namespace epicyclic::store
