// "1 point", "2 points".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace epicyclic {

/// @param many  what stands behind the number, of several
/// @param one   of one; empty: `many` without its last letter
[[nodiscard]] inline std::string counted(std::size_t count, std::string_view many, std::string_view one = {}) {
  if (one.empty()) one = many.substr(0, many.size() - 1);
  return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

}  // namespace epicyclic
