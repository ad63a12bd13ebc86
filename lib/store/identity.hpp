// Which studies are one: by what decides their results.
//
// What decides are the values of the resolved input without origins and notes. One that is what the catalogue data
// give, to the last digit, counts as such: it follows from the rest, and its last digits from the machine's
// mathematical library. So two inputs are one study exactly where they have the same values, on each machine; on
// another machine an input keeps its identity, although last digits of what is computed from catalogue data may differ.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace epicyclic::store {

/// A resolved input, and what its catalogue data give on this machine, at its places; or null.
struct ResolvedValues {
  const nlohmann::json& resolved;
  const nlohmann::json& computed;
};

/// SHA-256 (64 hexadecimal digits) of what decides, with the command and the versions of journal and numerics.
/// @param judging  version of how the journal's records were judged, if that is what they keep
[[nodiscard]] std::string identity(const ResolvedValues& input, std::string_view command,
                                   std::optional<int> judging = {});

/// Where two studies differ in what identifies them.
struct Difference {
  std::string pointer;
  std::string text;  ///< a line: the pointer and both values
};

/// What is the same in both inputs is not among them, whatever it follows from.
[[nodiscard]] std::vector<Difference> differing_values(const ResolvedValues& there, const ResolvedValues& here);

/// Their texts.
[[nodiscard]] std::vector<std::string> differences(const ResolvedValues& there, const ResolvedValues& here);

}  // namespace epicyclic::store
