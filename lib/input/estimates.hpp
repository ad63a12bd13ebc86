// Ranges of estimated values, which their origins state: "estimate: 1e7 to 4e8, shaft and bearings".
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "input/study_input.hpp"

namespace epicyclic::input {

/// What machines have where nothing was measured, least and most.
struct Range {
  double from, to;
};

/// The range that an origin begins with behind "estimate: ", in the unit of its key; nothing where it has none.
[[nodiscard]] std::optional<Range> estimated_range(std::string_view origin);

/// A number of the resolved input whose origin states a range.
struct Estimated {
  std::string pointer;
  Range range;
};

/// All of the lumped stage.
[[nodiscard]] std::vector<Estimated> estimated_values(const LoadedInput& input);

}  // namespace epicyclic::input
