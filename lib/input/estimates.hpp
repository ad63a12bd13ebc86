// Ranges of estimated values, which their origins state: "estimate: 1e7 to 4e8, shaft and bearings".
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "input/study_input.hpp"

namespace epicyclic::input {

/// Least and greatest values of typical machines, if nothing was measured.
struct Range {
  double from, to;
};

/// The range after "estimate: " at the beginning of an origin, in the unit of its key; nothing if it has none.
[[nodiscard]] std::optional<Range> estimated_range(std::string_view origin);

/// A number of the resolved input whose origin states a range.
struct Estimated {
  std::string pointer;
  Range range;
};

/// All of the lumped stage.
[[nodiscard]] std::vector<Estimated> estimated_values(const LoadedInput& input);

}  // namespace epicyclic::input
