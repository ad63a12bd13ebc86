#include "input/csv_columns.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/csv.hpp"
#include "core/errors.hpp"
#include "input/field_table.hpp"

namespace epicyclic::input {

namespace {

/// The whole text as a number.
std::optional<double> number_of(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || end.ec != std::errc() || end.ptr != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

}  // namespace

std::vector<std::vector<double>> csv_columns(const TextFile& file, const std::vector<std::string>& names) {
  if (!file.problem.empty()) throw InputError(file.problem);
  if (file.bytes.size() > json_bytes_max) throw InputError("is longer than 16 MiB");
  std::string text = file.bytes;
  std::erase(text, '\r');
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  const auto table = parse_csv(text);
  if (!table) throw InputError("is no table: each line needs as many cells as the first one, which names the columns");
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    places.push_back(table->index_of(name));
    if (places.back() == table->columns.size())
      throw InputError("has no column '" + name + "', but " + listed(table->columns));
  }
  std::vector<std::vector<double>> all(names.size());
  for (std::size_t row = 0; row < table->rows.size(); ++row)
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string& cell = table->rows[row][places[k]];
      const auto number = number_of(cell);
      if (!number)
        throw InputError("row " + std::to_string(row + 1) + ": '" + cell + "' in the column '" + names[k] +
                         "' is no number");
      all[k].push_back(*number);
    }
  return all;
}

}  // namespace epicyclic::input
