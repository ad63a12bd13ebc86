#include "figures/cell_figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "core/csv.hpp"

namespace epicyclic::figures {

namespace {

void check(const CellGrid& grid, std::size_t cells) {
  if (grid.x.empty() || grid.y.empty() || cells != grid.x.size() * grid.y.size())
    throw std::invalid_argument(fmt::format("{} cells on a grid of {} x {}", cells, grid.x.size(), grid.y.size()));
}

/// Edges between cells, and those of the outer ones.
std::vector<double> edges_of(const std::vector<double>& centres) {
  std::vector<double> edges;
  const std::size_t n = centres.size();
  const auto outer = [&](std::size_t at, std::size_t inner) {
    if (n > 1) return centres[at] + 0.5 * (centres[at] - centres[inner]);
    const double half = std::max(1e-12, 0.05 * std::abs(centres[0]));
    return centres[0] + (edges.empty() ? -half : half);
  };
  edges.push_back(outer(0, std::min<std::size_t>(1, n - 1)));
  for (std::size_t k = 1; k < n; ++k) edges.push_back(0.5 * (centres[k - 1] + centres[k]));
  edges.push_back(outer(n - 1, n > 1 ? n - 2 : 0));
  return edges;
}

/// Writes rectangles of equal cells, one a line: x from, x to, y from, y to, and the text of `value`; none if that is
/// empty.
template <class Alike, class Value>
void write_rectangles(AtomicFile& file, const CellGrid& grid, Alike alike, Value value) {
  constexpr std::size_t block = std::size_t{1} << 20;
  const auto x = edges_of(grid.x);
  const auto y = edges_of(grid.y);
  std::string data;
  const auto number = [&](double v, char end) {
    append_number(data, v);
    data += end;
  };
  const std::size_t columns = grid.x.size();
  for (std::size_t row = 0; row < grid.y.size(); ++row)
    for (std::size_t first = 0; first < columns;) {
      std::size_t last = first;
      while (last + 1 < columns && alike(row * columns + first, row * columns + last + 1)) ++last;
      if (const std::string text = value(row * columns + first); !text.empty()) {
        number(x[first], ' ');
        number(x[last + 1], ' ');
        number(y[row], ' ');
        number(y[row + 1], ' ');
        data += text + '\n';
      }
      first = last + 1;
      if (data.size() < block) continue;
      file.write(data);
      data.clear();
    }
  file.write(data);
}

/// Neighbours overlap a little, each over the one before: else their blurred edges would let the ground through.
std::string overlap(const CellGrid& grid) {
  const auto x = edges_of(grid.x);
  const auto y = edges_of(grid.y);
  const auto part = [](const std::vector<double>& edges) {
    std::string text;
    append_number(text, 0.3 * (edges.back() - edges.front()) / static_cast<double>(edges.size() - 1));
    return text;
  };
  return fmt::format("dx = {}\ndy = {}\n", part(x), part(y));
}

/// Outline of a rectangle and its colour.
constexpr std::string_view boxes = "using 1:3:1:($2 + dx):3:($4 + dy):5 with boxxyerror fillstyle solid 1 noborder";

FigureRange span_of(const std::vector<double>& centres) {
  const auto edges = edges_of(centres);
  return {edges.front(), edges.back()};
}

/// Legend beside the figure, on the right.
constexpr std::string_view legend_place =
    "set rmargin screen 0.72\n"
    "set tics out nomirror\n"
    "set key at screen 0.735, graph 1 left top vertical maxcols 1 Left reverse samplen 0.6 spacing 1.25 width 0 "
    "font ',20'\n";

std::string legend_entry(const CellClass& c) {
  return fmt::format(", \\\n  keyentry with points pointtype 5 pointsize 1.6*mark linecolor '{}' title {}", c.colour,
                     gnuplot_quoted(portable_text(c.label)));
}

std::string number(double v) {
  std::string t;
  append_number(t, v);
  return t;
}

/// Of the finite values and zero; empty if there are none.
FigureRange value_range(const std::vector<double>& cells) {
  FigureRange range;
  for (const double v : cells) range.include(v);
  if (range.empty()) return range;
  range.include(0.0);
  // A side with values near zero must not have colours as strong as the other side.
  constexpr double least_side = 0.1;
  range.include(-least_side * range.high);
  range.include(-least_side * range.low);
  return range.widened(0);
}

/// After Brewer's RdBu, which colour-blind readers can distinguish; white is zero.
std::string palette_over(const FigureRange& range) {
  std::string palette;
  const auto colour = [&](double at, std::string_view name) {
    palette += fmt::format("{}{} '{}'", palette.empty() ? "" : ", ", number(at), name);
  };
  if (range.low < 0.0) {
    colour(range.low, "#053061");
    colour(0.6 * range.low, "#4393c3");
    colour(0.2 * range.low, "#d1e5f0");
  }
  colour(0.0, "#ffffff");
  if (range.high > 0.0) {
    colour(0.2 * range.high, "#fddbc7");
    colour(0.6 * range.high, "#d6604d");
    colour(range.high, "#67001f");
  }
  return palette;
}

}  // namespace

FigureOutcome class_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                           const CellGrid& grid, const std::vector<CellClass>& classes,
                           const std::vector<std::size_t>& cells) {
  check(grid, cells.size());
  std::vector<bool> seen(classes.size(), false);
  for (const std::size_t c : cells) {
    if (c >= classes.size()) throw std::invalid_argument(fmt::format("class_figure: there is no class {}", c));
    seen[c] = true;
  }
  const auto write_data = [&](AtomicFile& file) {
    file.write("# x from, x to, y from, y to, colour, class\n");
    write_rectangles(
        file, grid, [&](std::size_t a, std::size_t b) { return cells[a] == cells[b]; },
        [&](std::size_t cell) {
          const CellClass& c = classes[cells[cell]];
          return fmt::format("0x{} {}", c.colour.substr(1), gnuplot_quoted(c.label));
        });
  };
  std::string plot = fmt::format("'{}.dat' {} linecolor rgbcolor variable notitle", stem, boxes);
  for (std::size_t c = 0; c < classes.size(); ++c)
    if (seen[c]) plot += legend_entry(classes[c]);
  return draw_figure(folder, stem, write_data,
                     figure_script(stem, text, span_of(grid.x), span_of(grid.y), {}, {},
                                   overlap(grid) + std::string(legend_place), plot));
}

FigureOutcome value_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                           const CellGrid& grid, const std::string& bar_label, const std::string& grey_label,
                           const std::vector<double>& cells) {
  check(grid, cells.size());
  const FigureRange range = value_range(cells);
  if (range.empty()) return nothing_to_draw("there is no finite value to draw");
  const bool grey = std::any_of(cells.begin(), cells.end(), [](double v) { return !std::isfinite(v); });
  const auto alike = [&](std::size_t a, std::size_t b) {
    return cells[a] == cells[b] || (!std::isfinite(cells[a]) && !std::isfinite(cells[b]));
  };
  const auto write_data = [&](AtomicFile& file) {
    file.write("# x from, x to, y from, y to, value\n");
    write_rectangles(file, grid, alike, [&](std::size_t cell) {
      return std::isfinite(cells[cell]) ? number(cells[cell]) : std::string();
    });
    if (!grey) return;
    file.write("\n\n# without a value\n");
    write_rectangles(file, grid, alike,
                     [&](std::size_t cell) { return std::isfinite(cells[cell]) ? std::string() : std::string("NaN"); });
  };
  const std::string extra = overlap(grid) + std::string(legend_place) +
                            fmt::format(
                                "set palette defined ({})\n"
                                "set palette maxcolors 0\n"
                                "set cbrange [{}:{}]\n"
                                "set cblabel {} offset 1.5,0\n"
                                "set colorbox user origin screen 0.745, graph 0 size screen 0.03, graph {}\n"
                                "set cbtics font ',20'\n"
                                "set format cb '%h'\n",
                                palette_over(range), number(range.low), number(range.high),
                                gnuplot_quoted(portable_text(bar_label)), grey ? 0.9 : 1.0);
  // Grey lies under the coloured cells' blurred edges, and over what they overlap.
  const auto greys = [&](std::string_view outline) {
    return fmt::format(
        "'{}.dat' index 1 using 1:3:{} with boxxyerror fillstyle solid 1 noborder linecolor '#9a9a9a' notitle", stem,
        outline);
  };
  std::string plot = grey ? greys("1:($2 + dx):3:($4 + dy)") + ", \\\n  " : "";
  plot += fmt::format("'{}.dat' index 0 {} linecolor palette notitle", stem, boxes);
  if (grey) plot += ", \\\n  " + greys("1:2:3:4");
  if (grey) plot += legend_entry({grey_label, "#9a9a9a"});
  return draw_figure(folder, stem, write_data,
                     figure_script(stem, text, span_of(grid.x), span_of(grid.y), {}, {}, extra, plot));
}

namespace {

/// Cells in steps of a scale, the darker the larger.
struct Steps {
  std::vector<double> of;       ///< the step of each cell, from 0; below zero: none
  double first = 0, width = 1;  ///< where step 0 begins, and how wide each of them is
  int count = 1;
  std::string values;           ///< what is written of a cell, in words
  std::vector<double> written;  ///< and as numbers
  std::string tics;             ///< of the bar
};

FigureOutcome stepped_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                             const CellGrid& grid, const std::string& bar_label, const Steps& steps,
                             const FigureCanvas& canvas, Pictures which) {
  const auto write_data = [&](AtomicFile& file) {
    file.write("# x from, x to, y from, y to, " + steps.values + "\n");
    const auto written = [&](std::size_t cell) {
      return steps.of[cell] < 0.0 ? std::string() : number(steps.written[cell]);
    };
    write_rectangles(
        file, grid, [&](std::size_t a, std::size_t b) { return written(a) == written(b); }, written);
  };
  // After Brewer's YlGnBu, whose lightness falls monotonically: it is readable in grey, and for colour-blind readers.
  const std::string extra =
      overlap(grid) +
      fmt::format(
          "set rmargin screen 0.84\n"
          "set tics out nomirror\n"
          "set palette defined (0 '#edf8b1', 1 '#c7e9b4', 2 '#7fcdbb', 3 '#41b6c4', 4 '#1d91c0', 5 '#225ea8', 6 "
          "'#0c2c84', 7 '#041040')\n"
          "set palette maxcolors {}\n"
          "set cbrange [{}:{}]\n"
          "set cblabel {} offset 1.5,0\n"
          "set colorbox user origin screen 0.86, graph 0 size screen 0.025, graph 1\n"
          "{}",
          steps.count, number(steps.first), number(steps.first + steps.count * steps.width),
          gnuplot_quoted(portable_text(bar_label)), steps.tics);
  const std::string plot = fmt::format("'{}.dat' {} linecolor palette notitle", stem, boxes);
  return draw_figure(folder, stem, write_data,
                     figure_script(stem, text, span_of(grid.x), span_of(grid.y), {}, {}, extra, plot, canvas), which);
}

}  // namespace

FigureOutcome decade_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                            const CellGrid& grid, const std::string& bar_label, const std::vector<double>& cells,
                            double floor, Pictures which) {
  check(grid, cells.size());
  constexpr double in_a_decade = 4.0;
  const double lowest = std::floor(in_a_decade * std::log10(floor));
  double highest = -std::numeric_limits<double>::infinity();
  Steps steps{std::vector<double>(cells.size(), -1.0),
              lowest / in_a_decade,
              1.0 / in_a_decade,
              1,
              "decades",
              {},
              "set cbtics 1 font ',20'\nset format cb '10^{%.0f}'\n"};
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (!(cells[k] >= floor) || !std::isfinite(cells[k])) continue;
    steps.of[k] = std::floor(in_a_decade * std::log10(cells[k])) - lowest;
    highest = std::max(highest, steps.of[k]);
  }
  if (!std::isfinite(highest)) return nothing_to_draw("there is no value to draw above " + number(floor));
  steps.count = static_cast<int>(highest) + 1;
  for (const double step : steps.of) steps.written.push_back(steps.first + (step + 0.5) * steps.width);
  return stepped_figure(folder, stem, text, grid, bar_label, steps, {}, which);
}

FigureOutcome scale_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                           const CellGrid& grid, const std::string& bar_label, const std::vector<double>& cells,
                           const FigureCanvas& canvas, Pictures which) {
  check(grid, cells.size());
  FigureRange all;
  for (const double v : cells) all.include(v);
  if (all.empty()) return nothing_to_draw("there is no finite value to draw");
  constexpr int count = 20;
  const FigureRange range = all.low < all.high ? all : all.widened(0.0);
  Steps steps{
      std::vector<double>(cells.size(), -1.0),      range.low, (range.high - range.low) / count, count, "value", cells,
      "set cbtics font ',20'\nset format cb '%h'\n"};
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (std::isfinite(cells[k]))
      steps.of[k] = std::clamp(std::floor((cells[k] - steps.first) / steps.width), 0.0, count - 1.0);
  return stepped_figure(folder, stem, text, grid, bar_label, steps, canvas, which);
}

}  // namespace epicyclic::figures
