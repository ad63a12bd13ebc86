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

/// "0.01230 ± 0.00042": the error to two digits, the value down to the last of them (fifteen at the most), so that
/// values which differ by more than their errors differ in print. A value without an error stands alone, what is not
/// known is called so.
[[nodiscard]] std::string with_error(double value, double error);

}  // namespace epicyclic
