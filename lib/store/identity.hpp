// Identity of studies: by the values that decide their results.
//
// These are the values of the resolved input without origins and notes. A value that equals the one from the catalogue
// data, to the last digit, counts as such. It follows from the other values, and its last digits depend on the
// machine's mathematical library. So two inputs are one study exactly if they have the same values, on each machine. On
// another machine an input keeps its identity, although last digits of values from catalogue data may differ.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace epicyclic::store {

/// A resolved input, and its values from catalogue data on this machine, at their places; or null.
struct ResolvedValues {
  const nlohmann::json& resolved;
  const nlohmann::json& computed;
};

/// SHA-256 (64 hexadecimal digits) of these values, with the command and the versions of journal and numerics.
/// @param judging  version of the judgement, if the journal's records are judged
[[nodiscard]] std::string identity(const ResolvedValues& input, std::string_view command,
                                   std::optional<int> judging = {});

/// The differences between the identities of two studies.
struct Difference {
  std::string pointer;
  std::string text;  ///< a line: the pointer and both values
};

/// Values that are the same in both inputs are not among them.
[[nodiscard]] std::vector<Difference> differing_values(const ResolvedValues& there, const ResolvedValues& here);

/// Their texts.
[[nodiscard]] std::vector<std::string> differences(const ResolvedValues& there, const ResolvedValues& here);

}  // namespace epicyclic::store
