#include "reports/markdown.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

namespace epicyclic::reports {

namespace {

constexpr std::size_t line_width = 98;

/// Columns that a UTF-8 text takes.
std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
}

}  // namespace

std::string wrapped(std::string_view text, std::string_view indent) {
  std::string result;
  std::size_t column = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t width = columns_of(word);
    if (column > 0 && column + 1 + width > line_width) {
      (result += '\n') += indent;
      column = columns_of(indent);
    } else if (column > 0) {
      result += ' ';
      ++column;
    }
    result += word;
    column += width;
  }
  return result + "\n";
}

std::string aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> width(rows.front().size(), 3);
  for (const auto& row : rows)
    for (std::size_t j = 0; j < row.size(); ++j) width[j] = std::max(width[j], columns_of(row[j]));
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += '|';
    for (std::size_t j = 0; j < rows[i].size(); ++j) {
      const std::string space(width[j] - columns_of(rows[i][j]), ' ');
      text += j == 0 ? fmt::format(" {}{} |", rows[i][j], space) : fmt::format(" {}{} |", space, rows[i][j]);
    }
    text += '\n';
    if (i > 0) continue;
    text += '|';
    for (std::size_t j = 0; j < width.size(); ++j)
      text += j == 0 ? std::string(width[j] + 2, '-') + "|" : std::string(width[j] + 1, '-') + ":|";
    text += '\n';
  }
  return text;
}

}  // namespace epicyclic::reports
