// Texts of an input in Markdown.
#pragma once

#include <string>
#include <string_view>

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

}  // namespace epicyclic::reports
