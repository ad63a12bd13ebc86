#include "io/bifurcation_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "io/csv.hpp"

namespace epicyclic::io {

namespace {

constexpr std::size_t cells_x = 4000;
constexpr std::size_t cells_y = 3000;

/// Dark blue and muted red: distinct in print, in grey and for colour-blind eyes.
constexpr std::array<std::string_view, 2> colours{"#12285c", "#c8553d"};

std::size_t cell_of(double value, const FigureRange& range, std::size_t cells) {
  const double position = (value - range.low) / (range.high - range.low) * static_cast<double>(cells);
  return std::min(cells - 1, static_cast<std::size_t>(position));
}

void append_points(std::string& data, const BifurcationSeries& series, const FigureRange& x_range,
                   const FigureRange& y_range) {
  std::vector<bool> seen(cells_x * cells_y);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!std::isfinite(series.x[i])) continue;
    const std::size_t column = cell_of(series.x[i], x_range, cells_x) * cells_y;
    for (const double y : series.y[i]) {
      if (!std::isfinite(y)) continue;
      std::vector<bool>::reference cell = seen[column + cell_of(y, y_range, cells_y)];
      if (cell) continue;
      cell = true;
      append_number(data, series.x[i]);
      data += ' ';
      append_number(data, y);
      data += '\n';
    }
  }
}

}  // namespace

FigureOutcome bifurcation_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                                 const std::vector<BifurcationSeries>& series,
                                 const std::vector<FigureMarker>& markers) {
  if (series.empty() || series.size() > colours.size()) {
    throw std::invalid_argument(fmt::format("bifurcation_figure: {} series, not 1 or 2", series.size()));
  }
  FigureRange x_range;
  FigureRange y_range;
  for (const BifurcationSeries& each : series) {
    if (each.x.size() != each.y.size()) throw std::invalid_argument("bifurcation_figure: x and y differ in length");
    for (const double x : each.x) x_range.include(x);
    for (const std::vector<double>& values : each.y) {
      for (const double y : values) y_range.include(y);
    }
  }
  if (x_range.empty() || y_range.empty()) return {"there is no finite point to draw"};
  x_range = x_range.widened(0);
  y_range = y_range.widened(figure_margin);

  std::string data;
  for (const BifurcationSeries& each : series) {
    data += fmt::format("# {}\n", gnuplot_quoted(each.label));
    const std::size_t size = data.size();
    append_points(data, each, x_range, y_range);
    // gnuplot does not count a data set without any line.
    if (data.size() == size) data += "NaN NaN\n";
    // Two blank lines end a data set of gnuplot's (index).
    data += "\n\n";
  }

  // Each dot is a line of (nearly) no length with round ends: in the SVG file that takes a third of the bytes of a
  // point symbol. Lines of no length at all are dropped, and what leaves the frame is clipped: hence towards the
  // middle.
  std::string extra = "middle = ";
  append_number(extra, 0.5 * (x_range.low + x_range.high));
  extra += "\ndot = ";
  append_number(extra, 4e-5 * (x_range.high - x_range.low));
  extra += '\n';
  std::string plot;
  for (std::size_t i = series.size(); i-- > 0;) {
    plot += fmt::format(
        "'{0}.dat' index {1} using 1:2:($1 < middle ? dot : -dot):(0) with vectors nohead linewidth 2 "
        "linecolor '{2}' notitle",
        stem, i, colours[i]);
    if (i > 0) plot += ", \\\n  ";
  }
  const std::size_t legend_entries = series.size() > 1 ? series.size() : 0;
  for (std::size_t i = 0; i < legend_entries; ++i) {
    // Dots as small as those of the diagram could not be told apart in a legend.
    plot += fmt::format(", \\\n  keyentry with points pointtype 7 pointsize mark linecolor '{}' title {}", colours[i],
                        gnuplot_quoted(portable_text(series[i].label)));
  }
  return draw_figure(folder, stem, data,
                     figure_script(stem, text, x_range, y_range, legend_entries, markers, extra, plot));
}

}  // namespace epicyclic::io
