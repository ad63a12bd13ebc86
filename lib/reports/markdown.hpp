// Markdown: texts of an input in it, and paragraphs and tables that are readable as plain text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace epicyclic::reports {

/// A cell of a table: nothing in it may end the cell or the line, or become HTML.
[[nodiscard]] inline std::string markdown_cell(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '|')
      safe += "\\|";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '\n' || c == '\r')
      safe += ' ';
    else
      safe += c;
  }
  return safe;
}

/// The text in lines of at most 98 columns; those after the first begin with `indent`.
[[nodiscard]] std::string wrapped(std::string_view text, std::string_view indent = "");

/// A table that is readable as text: cells padded, the first column to the left, numbers to the right.
/// @param rows  the first has the names of the columns; all are equally long
[[nodiscard]] std::string aligned(const std::vector<std::vector<std::string>>& rows);

}  // namespace epicyclic::reports
