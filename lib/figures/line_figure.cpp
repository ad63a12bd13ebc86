#include "figures/line_figure.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "figures/sketch.hpp"

namespace epicyclic::figures {

namespace {

/// After Okabe and Ito, darkened for thin lines on white: distinct for colour-blind eyes.
constexpr std::array<std::string_view, 6> colours{"#12285c", "#c8553d", "#1b8a6b", "#b07a00", "#7a4a8c", "#4a4a4a"};
/// For points, of gnuplot's filled ones.
constexpr std::array<int, 6> marks{7, 5, 9, 13, 11, 15};
/// Beyond six curves the colours repeat, dashed.
constexpr std::array<std::string_view, 3> dashes{"solid", "(14,6)", "(4,5)"};

bool drawable(double value, bool logarithmic) { return std::isfinite(value) && (!logarithmic || value > 0); }

/// One axis: its range, in decades if it is logarithmic.
struct Axis {
  bool logarithmic = false;
  FigureRange range{};

  void include(double value) { range.include(logarithmic ? std::log10(value) : value); }
  [[nodiscard]] FigureRange widened(double share) const {
    constexpr double about_one = 0.5;  // decades
    const FigureRange wide = logarithmic && range.low == range.high
                                 ? FigureRange{range.low - about_one, range.high + about_one}
                                 : range.widened(share);
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
  std::vector<std::string> legend;
  bool points = false;
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
    const std::string line = fmt::format("linewidth 2 dashtype {} linecolor '{}'", dash, colour);
    const std::string mark = fmt::format("pointtype {} pointsize mark", marks[k % marks.size()]);
    const std::string style = curve.points   ? fmt::format("points {} linecolor '{}'", mark, colour)
                              : curve.marked ? fmt::format("linespoints {} {}", mark, line)
                                             : "lines " + line;
    points = points || curve.points || curve.marked;
    if (!curve.label.empty()) legend.push_back(curve.label);
    plot += fmt::format("{}'{}.dat' index {} using 1:2 with {} {}", k > 0 ? ", \\\n  " : "", stem, k, style,
                        curve.label.empty() ? "notitle" : "title " + gnuplot_quoted(portable_text(curve.label)));
  }
  if (x_axis.range.empty()) return nothing_to_draw("there is no finite point to draw");

  std::string extra;
  const FigureRange x = x_axis.widened(points ? figure_margin : 0.0);
  const FigureRange y = y_axis.widened(figure_margin);
  if (axes.log_x) extra += logarithmic_axis("x", x);
  if (axes.log_y) extra += logarithmic_axis("y", y);
  return draw_figure(folder, stem, data, figure_script(stem, text, x, y, legend, markers, extra, plot));
}

}  // namespace epicyclic::figures
