#include "input/estimates.hpp"

#include <charconv>
#include <string>

namespace epicyclic::input {

namespace {

/// A number that the text begins with, which is taken off.
std::optional<double> take_number(std::string_view& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

}  // namespace

std::optional<Range> estimated_range(std::string_view origin) {
  if (!take(origin, "estimate: ")) return std::nullopt;
  const std::optional<double> from = take_number(origin);
  if (!from || !take(origin, " to ")) return std::nullopt;
  const std::optional<double> to = take_number(origin);
  if (!to || !(*from <= *to)) return std::nullopt;
  return Range{*from, *to};
}

std::vector<Estimated> estimated_values(const LoadedInput& input) {
  const std::string lumped = input.resolved.contains("stage") ? "/stage/lumped/" : "/lumped/";
  std::vector<Estimated> all;
  for (const std::string& pointer : input.number_pointers()) {
    if (!pointer.starts_with(lumped)) continue;
    const std::size_t key = pointer.rfind('/');
    const nlohmann::json* origin = input.value_at(pointer.substr(0, key) + "/origin" + pointer.substr(key));
    if (origin == nullptr || !origin->is_string()) continue;
    if (const auto range = estimated_range(origin->get_ref<const std::string&>())) all.push_back({pointer, *range});
  }
  return all;
}

}  // namespace epicyclic::input
