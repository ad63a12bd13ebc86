#include "io/line_figure.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "io/csv.hpp"

namespace epicyclic::io {

namespace {

/// After Okabe and Ito, darkened for thin lines on white: distinct for colour-blind eyes.
constexpr std::array<std::string_view, 6> colours{"#12285c", "#c8553d", "#1b8a6b", "#b07a00", "#7a4a8c", "#4a4a4a"};
/// Beyond six curves the colours repeat, dashed.
constexpr std::array<std::string_view, 3> dashes{"solid", "(14,6)", "(4,5)"};

bool drawable(double value, bool logarithmic) { return std::isfinite(value) && (!logarithmic || value > 0); }

/// One axis: its range, in decades if it is logarithmic.
struct Axis {
  bool logarithmic = false;
  FigureRange range{};

  void include(double value) { range.include(logarithmic ? std::log10(value) : value); }
  [[nodiscard]] FigureRange widened(double share) const {
    const FigureRange wide = range.widened(share);
    return logarithmic ? FigureRange{std::pow(10.0, wide.low), std::pow(10.0, wide.high)} : wide;
  }
};

}  // namespace

FigureOutcome line_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                          const std::vector<FigureCurve>& curves, const FigureAxes& axes,
                          const std::vector<FigureMarker>& markers) {
  if (curves.empty()) throw std::invalid_argument("line_figure: no curve");
  std::string data;
  std::string plot;
  std::size_t legend_entries = 0;
  Axis x_axis{axes.log_x};
  Axis y_axis{axes.log_y};
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const FigureCurve& curve = curves[k];
    if (curve.x.size() != curve.y.size()) throw std::invalid_argument("line_figure: x and y differ in length");
    data += fmt::format("# {}\n", gnuplot_quoted(curve.label));
    const std::size_t size = data.size();
    bool gap = true;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (drawable(curve.x[i], axes.log_x) && drawable(curve.y[i], axes.log_y)) {
        x_axis.include(curve.x[i]);
        y_axis.include(curve.y[i]);
        append_number(data, curve.x[i]);
        data += ' ';
        append_number(data, curve.y[i]);
        data += '\n';
        gap = false;
      } else if (!gap) {
        // One blank line interrupts a line; a second would end the data set.
        data += '\n';
        gap = true;
      }
    }
    // gnuplot does not count a data set without any line.
    if (data.size() == size) data += "NaN NaN\n\n";
    data += gap ? "\n" : "\n\n";

    const std::string_view colour = colours[k % colours.size()];
    const std::string_view dash = dashes[k / colours.size() % dashes.size()];
    const std::string look = curve.points ? fmt::format("points pointtype 7 pointsize 0.6*mark linecolor '{}'", colour)
                                          : fmt::format("lines linewidth 2 dashtype {} linecolor '{}'", dash, colour);
    if (!curve.label.empty()) ++legend_entries;
    plot += fmt::format("{}'{}.dat' index {} using 1:2 with {} {}", k > 0 ? ", \\\n  " : "", stem, k, look,
                        curve.label.empty() ? "notitle" : "title " + gnuplot_quoted(portable_text(curve.label)));
  }
  if (x_axis.range.empty()) return {"there is no finite point to draw"};

  std::string extra;
  if (axes.log_x) extra += "set logscale x\nset mxtics 10\nset format x '10^{%T}'\n";
  if (axes.log_y) extra += "set logscale y\nset mytics 10\nset format y '10^{%T}'\n";
  return draw_figure(folder, stem, data,
                     figure_script(stem, text, x_axis.widened(0), y_axis.widened(figure_margin), legend_entries,
                                   markers, extra, plot));
}

}  // namespace epicyclic::io
