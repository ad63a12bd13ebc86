#include "figures/bifurcation_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "figures/sketch.hpp"

namespace epicyclic::figures {

namespace {

constexpr std::size_t cells_x = 4000;
constexpr std::size_t cells_y = 3000;

/// Dark blue and muted red: distinct in print, in grey and for colour-blind eyes.
constexpr std::array<std::string_view, 2> colours{"#12285c", "#c8553d"};

std::size_t cell_of(double value, const FigureRange& range, std::size_t cells) {
  const double position = (value - range.low) / (range.high - range.low) * static_cast<double>(cells);
  return std::min(cells - 1, static_cast<std::size_t>(position));
}

/// The text of a data file, written in blocks.
class DataWriter {
 public:
  explicit DataWriter(AtomicFile& file) : file_(file) {}

  void comment(std::string_view text) { buffer_ += fmt::format("# {}\n", text); }

  void row(std::initializer_list<double> values) {
    const char* separator = "";
    for (const double value : values) {
      buffer_ += separator;
      append_number(buffer_, value);
      separator = " ";
    }
    buffer_ += '\n';
    empty_ = false;
    constexpr std::size_t block_bytes = std::size_t{1} << 20;
    if (buffer_.size() >= block_bytes) flush();
  }

  /// Ends a data set of gnuplot's (index). It does not count one without any line.
  void end_data_set(std::string_view nothing) {
    if (empty_) buffer_ += nothing;
    buffer_ += "\n\n";
    empty_ = true;
  }

  void flush() {
    file_.write(buffer_);
    buffer_.clear();
  }

 private:
  AtomicFile& file_;
  std::string buffer_;
  bool empty_ = true;
};

/// Points on the grid, each cell once.
class CellWriter {
 public:
  CellWriter(const FigureRange& x, const FigureRange& y) : x_(x), y_(y), seen_(cells_x * cells_y) {}

  void append(DataWriter& data, double x, const std::vector<double>& values) {
    if (!std::isfinite(x)) return;
    const std::size_t column = cell_of(x, x_, cells_x) * cells_y;
    for (const double y : values) {
      if (!std::isfinite(y)) continue;
      std::vector<bool>::reference cell = seen_[column + cell_of(y, y_, cells_y)];
      if (cell) continue;
      cell = true;
      data.row({x, y});
    }
  }

 private:
  FigureRange x_, y_;
  std::vector<bool> seen_;
};

/// Each dot is a line of (nearly) no length with round ends: in the SVG file that takes a third of the bytes of a point
/// symbol. Lines of no length at all are dropped, and what leaves the frame is clipped: hence towards the middle.
std::string dot_settings(const FigureRange& x) {
  std::string text = "middle = ";
  append_number(text, 0.5 * (x.low + x.high));
  text += "\ndot = ";
  append_number(text, 4e-5 * (x.high - x.low));
  return text + '\n';
}

/// @param columns  values of the parameter: where there are few, dots may be larger
std::string plot_dots(std::string_view stem, std::size_t index, std::string_view colour, std::size_t columns) {
  constexpr double many = 661;
  const double width = std::clamp(2.0 * std::sqrt(many / static_cast<double>(columns)), 2.0, 8.0);
  return fmt::format(
      "'{0}.dat' index {1} using 1:2:($1 < middle ? dot : -dot):(0) with vectors nohead linewidth {3:.1f} "
      "linecolor '{2}' notitle",
      stem, index, colour, width);
}

/// In parts of the range: half a step of the grid on each side, so that the dots of its ends are not on the frame.
double grid_margin(std::size_t points) { return points > 1 ? 0.5 / static_cast<double>(points - 1) : 0.0; }

/// Dots as small as those of the diagram would be hard to distinguish in a legend.
std::string legend_entry(std::string_view colour, std::string_view label) {
  return fmt::format(", \\\n  keyentry with points pointtype 7 pointsize mark linecolor '{}' title {}", colour,
                     gnuplot_quoted(portable_text(label)));
}

/// gnuplot's plots of a diagram of classes.
struct ClassPlots {
  std::string dots;  ///< of the sections, with the legend's entries
  std::string bars;  ///< of the values and their intervals
  std::vector<std::string> legend;
};

/// Of the classes that have points.
/// @param counts  points of each class
/// @param count   points of the grid
ClassPlots plots_of(std::string_view stem, const std::vector<PointClass>& classes,
                    const std::vector<std::size_t>& counts, std::size_t count) {
  constexpr std::size_t few = 100;  // values of the parameter
  ClassPlots plots;
  std::string entries;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    if (counts[k] == 0) continue;
    plots.dots += (plots.dots.empty() ? "" : ", \\\n  ") + plot_dots(stem, 2 * k, classes[k].colour, count);
    plots.legend.push_back(fmt::format("{} ({})", classes[k].label, counts[k]));
    entries += legend_entry(classes[k].colour, plots.legend.back());
    plots.bars += fmt::format(
        ", \\\n  '{0}.dat' index {1} using 1:2:3 with yerrorbars pointtype 7 pointsize {3:.2f}*mark linewidth {4} "
        "linecolor '{2}' notitle",
        stem, 2 * k + 1, classes[k].colour, count > few ? 0.25 : 0.6, count > few ? 1 : 2);
  }
  plots.dots += entries;
  return plots;
}

}  // namespace

FigureOutcome bifurcation_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                                 const std::vector<BifurcationSeries>& series, const std::vector<FigureMarker>& markers,
                                 Pictures which, const std::string& apart) {
  if (series.empty() || series.size() > colours.size()) {
    throw std::invalid_argument(fmt::format("bifurcation_figure: {} series, not 1 or 2", series.size()));
  }
  FigureRange x_range;
  FigureRange y_range;
  std::size_t points_apart = 0;
  for (const BifurcationSeries& each : series) {
    for (std::size_t i = 0; i < each.count; ++i) {
      const auto point = each.at(i);
      if (!point) continue;
      x_range.include(point->x);
      points_apart += point->apart ? 1 : 0;
      for (const double y : point->section) y_range.include(y);
    }
  }
  if (x_range.empty() || y_range.empty()) return nothing_to_draw("there is no finite point to draw");
  x_range = x_range.widened(grid_margin(series.front().count));
  y_range = y_range.widened(figure_margin);

  const auto write_data = [&](AtomicFile& file) {
    DataWriter data(file);
    const auto write = [&](const BifurcationSeries& each, CellWriter& cells, bool of_apart) {
      for (std::size_t i = 0; i < each.count; ++i)
        if (const auto point = each.at(i); point && point->apart == of_apart)
          cells.append(data, point->x, point->section);
    };
    for (const BifurcationSeries& each : series) {
      data.comment(gnuplot_quoted(each.label));
      CellWriter cells(x_range, y_range);
      write(each, cells, false);
      data.end_data_set("NaN NaN\n");
    }
    if (points_apart > 0) {
      data.comment("drawn apart");
      CellWriter cells(x_range, y_range);
      for (const BifurcationSeries& each : series) write(each, cells, true);
      data.end_data_set("NaN NaN\n");
    }
    data.flush();
  };

  std::string plot;
  for (std::size_t i = series.size(); i-- > 0;) {
    plot += plot_dots(stem, i, colours[i], series.front().count);
    if (i > 0) plot += ", \\\n  ";
  }
  std::vector<std::string> legend;
  for (std::size_t i = 0; series.size() > 1 && i < series.size(); ++i) {
    plot += legend_entry(colours[i], series[i].label);
    legend.push_back(series[i].label);
  }
  if (points_apart > 0) {
    plot += ", \\\n  " + plot_dots(stem, series.size(), ink::ochre, series.front().count);
    legend.push_back(fmt::format("{} ({})", apart, points_apart));
    plot += legend_entry(ink::ochre, legend.back());
  }
  return draw_figure(folder, stem, write_data,
                     figure_script(stem, text, x_range, y_range, legend, markers, dot_settings(x_range), plot), which);
}

FigureOutcome class_bifurcation_figure(const std::filesystem::path& folder, std::string_view stem,
                                       const FigureText& text, std::string_view value, const std::string& value_label,
                                       const std::vector<PointClass>& classes, std::size_t count,
                                       const std::function<std::optional<ClassPoint>(std::size_t)>& at,
                                       Pictures which) {
  FigureRange x;
  FigureRange y;
  FigureRange value_range;
  std::vector<std::size_t> counts(classes.size());
  std::vector<std::pair<std::size_t, ClassPoint>> points;  // without their sections
  for (std::size_t i = 0; i < count; ++i) {
    auto point = at(i);
    if (!point) continue;
    ClassPoint& p = *point;
    x.include(p.x);
    for (const double v : p.section) y.include(v);
    const double half = classes.at(p.of_class).interval_counts ? p.half_width : 0.0;
    value_range.include(p.value - half);
    value_range.include(p.value + half);
    ++counts[p.of_class];
    p.section = {};
    points.emplace_back(i, std::move(p));
  }
  if (x.empty() || y.empty()) return nothing_to_draw("there is no finite point to draw");
  x = x.widened(grid_margin(count));
  y = y.widened(figure_margin);
  value_range.include(0.0);
  value_range = value_range.widened(2.0 * figure_margin);

  // A data set of dots and one of values for each class.
  const auto write_data = [&](AtomicFile& file) {
    DataWriter data(file);
    CellWriter cells(x, y);
    for (std::size_t k = 0; k < classes.size(); ++k) {
      data.comment(fmt::format("{}: section", classes[k].label));
      for (const auto& [i, p] : points)
        if (p.of_class == k) cells.append(data, p.x, at(i)->section);
      data.end_data_set("NaN NaN\n");
      data.comment(fmt::format("{}: {} and half its interval", classes[k].label, value));
      for (const auto& [i, p] : points) {
        if (p.of_class != k || !std::isfinite(p.value)) continue;
        data.row({p.x, p.value, std::isfinite(p.half_width) ? p.half_width : 0.0});
      }
      data.end_data_set("NaN NaN NaN\n");
    }
    data.flush();
  };

  const ClassPlots plots = plots_of(stem, classes, counts, count);
  const std::vector<FigurePanel> panels = {
      {text.y_label, y, plots.dots, 2.0},
      {value_label, value_range, "0 with lines linewidth 1.2 linecolor '#808080' notitle" + plots.bars, 1.0}};
  return draw_figure(folder, stem, write_data,
                     panel_script(stem, text, x, panels, plots.legend, "set errorbars 0\n" + dot_settings(x)), which);
}

}  // namespace epicyclic::figures
