#include "core/text.hpp"

#include <algorithm>
#include <cmath>

namespace epicyclic {

namespace {

std::string text_of(double x, std::chars_format format, int decimals) {
  char buffer[400];  // the longest double has 309 digits before the point
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, x, format, decimals);
  return {buffer, end.ptr};
}

/// The power of ten of the first digit, once rounded to so many: 0.0996 to two digits is 0.10.
int decade(double x, int digits) {
  const std::string text = text_of(x, std::chars_format::scientific, digits - 1);
  return std::stoi(text.substr(text.find('e') + 1));
}

}  // namespace

std::string with_error(double value, double error) {
  constexpr int digits_of_error = 2;
  constexpr int most = 15;
  constexpr int most_decimals = 7;  // of small numbers, before they are written with an exponent
  constexpr int least_decade = -4;
  if (!std::isfinite(value)) return "unknown";
  if (!std::isfinite(error)) return short_text(value, 4) + " (no interval)";
  error = std::abs(error);
  if (error == 0.0) return short_text(value, 6);
  const int last = decade(error, digits_of_error) - digits_of_error + 1;  // power of ten of the last digit that counts
  const int first = value == 0.0 ? last : std::max(last, decade(value, 1));
  const bool plain = std::max(first, last) < most;
  if (plain && last >= -most_decimals) {
    const int decimals = std::max(0, -last);
    return text_of(value, std::chars_format::fixed, decimals) + " ± " +
           text_of(error, std::chars_format::fixed, decimals);
  }
  const int digits = std::min(most, first - last + 1);
  const std::string number = plain && first >= least_decade
                                 ? text_of(value, std::chars_format::fixed, digits - 1 - first)
                                 : text_of(value, std::chars_format::scientific, digits - 1);
  return number + " ± " + text_of(error, std::chars_format::scientific, digits_of_error - 1);
}

}  // namespace epicyclic
