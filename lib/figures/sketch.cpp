#include "figures/sketch.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace epicyclic::figures {

std::string figure_number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string solid(std::string_view colour, double width) {
  return fmt::format("lines linewidth {} linecolor '{}'", figure_number(width), colour);
}

std::string dashed(std::string_view colour, double width, std::string_view dash) {
  return fmt::format("{} dashtype {}", solid(colour, width), dash);
}

std::string dots(std::string_view colour, double size, int type) {
  return fmt::format("points pointtype {} pointsize {}*mark linecolor '{}'", type, figure_number(size), colour);
}

FigureOutcome Sketch::draw(const std::filesystem::path& folder, const FigureText& text, const FigureRange& x,
                           const FigureRange& y, const std::vector<FigureMarker>& markers, const FigureCanvas& canvas,
                           Pictures which) const {
  if (!panels_.empty()) {
    std::vector<FigurePanel> panels = panels_;
    std::erase_if(panels, [](const FigurePanel& panel) { return panel.plot.empty(); });
    if (panels.empty()) return nothing_to_draw("there is nothing to draw");
    return draw_figure(folder, stem_, data_, panel_script(stem_, text, x, panels, legend_, commands_, canvas), which);
  }
  return draw_figure(folder, stem_, data_, figure_script(stem_, text, x, y, legend_, markers, commands_, plot_, canvas),
                     which);
}

void Sketch::end_set(bool gap, std::size_t columns, std::string_view style, std::string_view title) {
  data_ += gap ? "\n" : "\n\n";
  std::string using_columns = "1";
  for (std::size_t k = 2; k <= std::max<std::size_t>(2, columns); ++k) using_columns += fmt::format(":{}", k);
  clause(fmt::format("'{}.dat' index {} using {}", stem_, sets_++, using_columns), style, title);
}

void Sketch::end_letters(std::string_view text, std::string_view style) {
  data_ += "\n\n";
  clause(fmt::format("'{}.dat' index {} using 1:2:({})", stem_, sets_++, gnuplot_quoted(text)),
         fmt::format("labels {}", style), {});
}

void Sketch::clause(std::string_view source, std::string_view style, std::string_view title) {
  std::string& plot = panels_.empty() ? plot_ : panels_.back().plot;
  if (!plot.empty()) plot += ", \\\n  ";
  plot += fmt::format("{} with {} {}", source, style,
                      title.empty() ? "notitle" : "title " + gnuplot_quoted(portable_text(title)));
  if (!title.empty()) legend_.emplace_back(title);
}

}  // namespace epicyclic::figures
