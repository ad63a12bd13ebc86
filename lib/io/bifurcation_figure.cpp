#include "io/bifurcation_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <utility>

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

std::string plot_dots(std::string_view stem, std::size_t index, std::string_view colour) {
  return fmt::format(
      "'{0}.dat' index {1} using 1:2:($1 < middle ? dot : -dot):(0) with vectors nohead linewidth 2 "
      "linecolor '{2}' notitle",
      stem, index, colour);
}

/// In parts of the range: half a step of the grid on each side, so that the dots of its ends are not on the frame.
double grid_margin(std::size_t points) { return points > 1 ? 0.5 / static_cast<double>(points - 1) : 0.0; }

/// Dots as small as those of the diagram could not be told apart in a legend.
std::string legend_entry(std::string_view colour, std::string_view label) {
  return fmt::format(", \\\n  keyentry with points pointtype 7 pointsize mark linecolor '{}' title {}", colour,
                     gnuplot_quoted(portable_text(label)));
}

struct RegimeLook {
  const char* label;
  std::string_view colour;
};

/// Distinct in print, in grey and for colour-blind eyes (after Okabe and Ito).
constexpr std::array<RegimeLook, 5> looks = {{{"period 1", "#12285c"},
                                              {"period 2 and more", "#3f8fd0"},
                                              {"quasiperiodic", "#1b8a6b"},
                                              {"chaotic", "#c8553d"},
                                              {"undecided", "#8a8a8a"}}};

std::size_t look_of(const RegimePoint& p) {
  switch (p.regime) {
    case analysis::Regime::periodic:
      return p.period <= 1 ? 0 : 1;
    case analysis::Regime::quasiperiodic:
      return 2;
    case analysis::Regime::chaotic:
      return 3;
    case analysis::Regime::undecided:
      break;
  }
  return 4;
}

}  // namespace

FigureOutcome bifurcation_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                                 const std::vector<BifurcationSeries>& series, const std::vector<FigureMarker>& markers,
                                 Pictures which) {
  if (series.empty() || series.size() > colours.size()) {
    throw std::invalid_argument(fmt::format("bifurcation_figure: {} series, not 1 or 2", series.size()));
  }
  FigureRange x_range;
  FigureRange y_range;
  for (const BifurcationSeries& each : series) {
    for (std::size_t i = 0; i < each.count; ++i) {
      const auto point = each.at(i);
      if (!point) continue;
      x_range.include(point->x);
      for (const double y : point->section) y_range.include(y);
    }
  }
  if (x_range.empty() || y_range.empty()) return {"there is no finite point to draw"};
  x_range = x_range.widened(grid_margin(series.front().count));
  y_range = y_range.widened(figure_margin);

  const auto write_data = [&](AtomicFile& file) {
    DataWriter data(file);
    for (const BifurcationSeries& each : series) {
      data.comment(gnuplot_quoted(each.label));
      CellWriter cells(x_range, y_range);
      for (std::size_t i = 0; i < each.count; ++i)
        if (const auto point = each.at(i)) cells.append(data, point->x, point->section);
      data.end_data_set("NaN NaN\n");
    }
    data.flush();
  };

  std::string plot;
  for (std::size_t i = series.size(); i-- > 0;) {
    plot += plot_dots(stem, i, colours[i]);
    if (i > 0) plot += ", \\\n  ";
  }
  const std::size_t legend_entries = series.size() > 1 ? series.size() : 0;
  for (std::size_t i = 0; i < legend_entries; ++i) plot += legend_entry(colours[i], series[i].label);
  return draw_figure(folder, stem, write_data,
                     figure_script(stem, text, x_range, y_range, legend_entries, markers, dot_settings(x_range), plot),
                     which);
}

FigureOutcome regime_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                            std::size_t count, const std::function<std::optional<RegimePoint>(std::size_t)>& at,
                            Pictures which) {
  FigureRange x;
  FigureRange y;
  FigureRange exponents;
  std::array<std::size_t, looks.size()> counts{};
  std::vector<std::pair<std::size_t, RegimePoint>> points;  // without their sections
  for (std::size_t i = 0; i < count; ++i) {
    auto point = at(i);
    if (!point) continue;
    RegimePoint& p = *point;
    x.include(p.x);
    for (const double v : p.section) y.include(v);
    if (p.regime == analysis::Regime::periodic) {
      exponents.include(p.exponent.value);
    } else {
      exponents.include(p.exponent.low());
      exponents.include(p.exponent.high());
    }
    ++counts[look_of(p)];
    p.section = {};
    points.emplace_back(i, std::move(p));
  }
  if (x.empty() || y.empty()) return {"there is no finite point to draw"};
  x = x.widened(grid_margin(count));
  y = y.widened(figure_margin);
  exponents.include(0.0);
  exponents = exponents.widened(2.0 * figure_margin);

  // A data set of dots and one of exponents for each regime.
  const auto write_data = [&](AtomicFile& file) {
    DataWriter data(file);
    CellWriter cells(x, y);
    for (std::size_t k = 0; k < looks.size(); ++k) {
      data.comment(fmt::format("{}: section", looks[k].label));
      for (const auto& [i, p] : points)
        if (look_of(p) == k) cells.append(data, p.x, at(i)->section);
      data.end_data_set("NaN NaN\n");
      data.comment(fmt::format("{}: exponent and half its interval", looks[k].label));
      for (const auto& [i, p] : points) {
        if (look_of(p) != k || !std::isfinite(p.exponent.value)) continue;
        data.row({p.x, p.exponent.value, std::isfinite(p.exponent.half_width) ? p.exponent.half_width : 0.0});
      }
      data.end_data_set("NaN NaN NaN\n");
    }
    data.flush();
  };

  std::string dots;
  std::string legend;
  std::string bars;
  for (std::size_t k = 0; k < looks.size(); ++k) {
    if (counts[k] == 0) continue;
    dots += (dots.empty() ? "" : ", \\\n  ") + plot_dots(stem, 2 * k, looks[k].colour);
    legend += legend_entry(looks[k].colour, fmt::format("{} ({})", looks[k].label, counts[k]));
    bars += fmt::format(
        ", \\\n  '{0}.dat' index {1} using 1:2:3 with yerrorbars pointtype 7 pointsize 0.25*mark linewidth 1 "
        "linecolor '{2}' notitle",
        stem, 2 * k + 1, looks[k].colour);
  }
  const auto number = [](double v) {
    std::string t;
    append_number(t, v);
    return t;
  };
  const std::string panels = fmt::format(
      "set multiplot\n"
      "set lmargin screen 0.1\n"
      "set tmargin screen 0.875\n"
      "set bmargin screen 0.42\n"
      "set xrange [{0}:{1}]\n"
      "set yrange [{2}:{3}]\n"
      "set label 1 {4} at graph 0, screen 0.965 left\n"
      "set key at graph 1, screen 0.95 right top horizontal maxrows 1 Left reverse samplen 0.6 width -1 font ',19'\n"
      "set errorbars 0\n"
      "set format x ''\n"
      "unset xlabel\n"
      "set label 2 {5} at screen 0.022, graph 0.5 center rotate by 90\n"
      "plot {6}{7}\n"
      "unset label 1\n"
      "unset key\n"
      "set tmargin screen 0.4\n"
      "set bmargin screen 0.12\n"
      "set format x '%h'\n"
      "set xlabel {8}\n"
      "set label 2 {9} at screen 0.022, graph 0.5 center rotate by 90\n"
      "set yrange [{10}:{11}]\n"
      "plot 0 with lines linewidth 1.2 linecolor '#808080' notitle{12}\n"
      "unset multiplot\n",
      number(x.low), number(x.high), number(y.low), number(y.high), gnuplot_quoted(portable_text(text.title)),
      gnuplot_quoted(portable_text(text.y_label)), dots, legend, gnuplot_quoted(portable_text(text.x_label)),
      gnuplot_quoted("Exponent  λ_1 / ω_{sn}"), number(exponents.low), number(exponents.high), bars);
  return draw_figure(folder, stem, write_data, panel_script(stem, dot_settings(x), panels), which);
}

}  // namespace epicyclic::io
