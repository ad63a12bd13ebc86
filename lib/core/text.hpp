// Numbers in messages, the same in every locale.
#pragma once

#include <charconv>
#include <string>

namespace epicyclic {

/// @param digits  significant digits
[[nodiscard]] inline std::string short_text(double x, int digits = 3) {
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, digits);
  return {buffer, end.ptr};
}

}  // namespace epicyclic
