#include "studies/speed_note.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <system_error>
#include <utility>

namespace epicyclic::studies {

namespace {

constexpr std::string_view equals = " = ";

}  // namespace

std::optional<SpeedNote> find_speed_note(std::string_view origin) {
  const std::size_t sign = origin.rfind(equals);
  if (sign == std::string_view::npos) return std::nullopt;
  const std::size_t space = origin.substr(0, sign).rfind(' ');
  const std::size_t start = space == std::string_view::npos ? 0 : space + 1;
  const std::string_view key = origin.substr(start, sign - start);
  // Of speeds alone: words of the user's own may have the sign, too.
  if (std::ranges::find(speed_keys, key) == speed_keys.end()) return std::nullopt;
  const std::string_view number = origin.substr(sign + equals.size());
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size()) return std::nullopt;
  std::string before(origin.substr(0, start));
  before.erase(before.find_last_not_of(":, ") + 1);
  return SpeedNote{std::string(key), value, std::string(origin.substr(start)), std::move(before)};
}

std::string with_speed_note(std::string origin, std::string_view key, std::string_view number) {
  origin += origin.find(": ") == std::string::npos ? ": " : ", ";
  origin += key;
  origin += equals;
  origin += number;
  return origin;
}

}  // namespace epicyclic::studies
