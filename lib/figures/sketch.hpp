// A figure from single parts: data sets, the style of each one, commands between; in the style of figures/gnuplot.hpp.
// For figures that figures/line_figure.hpp and figures/bifurcation_figure.hpp cannot draw.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/csv.hpp"
#include "figures/gnuplot.hpp"

namespace epicyclic::figures {

/// The colours of line_figure.cpp, distinct for colour-blind eyes.
namespace ink {
inline constexpr std::string_view blue = "#12285c";
inline constexpr std::string_view light_blue = "#9db4dc";
inline constexpr std::string_view red = "#c8553d";
inline constexpr std::string_view green = "#1b8a6b";
inline constexpr std::string_view ochre = "#b07a00";
inline constexpr std::string_view purple = "#7a4a8c";
inline constexpr std::string_view dark_grey = "#4a4a4a";
inline constexpr std::string_view light_grey = "#b0b0b0";
}  // namespace ink

/// The shortest text of a number that reads back as the same number.
[[nodiscard]] std::string figure_number(double value);

/// Styles, as text after "with" in a plot command.
[[nodiscard]] std::string solid(std::string_view colour, double width = 2);
[[nodiscard]] std::string dashed(std::string_view colour, double width, std::string_view dash);
[[nodiscard]] std::string dots(std::string_view colour, double size, int type = 7);

/// For values that differ in kind from the other values of a figure.
[[nodiscard]] inline std::string apart_dots(double size) { return dots(ink::ochre, 2.0 * size, 2); }

/// The data sets of one figure, and the plot command that shows them in the order in which they were added.
class Sketch {
 public:
  explicit Sketch(std::string_view stem) : stem_(stem) {}

  [[nodiscard]] const std::string& stem() const { return stem_; }

  /// @param rows  of equal length; a row of NaN interrupts a line
  /// @param style  text after "with"
  template <class Rows>
  void add(const Rows& rows, std::string_view style, std::string_view title = {}) {
    std::size_t columns = 0;
    bool gap = true;
    for (const auto& row : rows) {
      // Two blank lines would end the set.
      if (gap && has_gap(row)) continue;
      const std::size_t written = write(row);
      gap = written == 0;
      columns = std::max(columns, written);
    }
    if (columns > 0) end_set(gap, columns, style, title);
  }

  /// A text at each of the places.
  /// @param rows  x and y
  /// @param style  text after "with labels"
  template <class Rows>
  void letters(const Rows& rows, std::string_view text, std::string_view style = {}) {
    if (rows.empty()) return;
    for (const auto& row : rows) write(row);
    end_letters(text, style);
  }

  /// An entry of the legend without data.
  void entry(std::string_view style, std::string_view title) { clause("keyentry", style, title); }

  /// Later data are in a frame of their own, below the earlier ones. Only the first frame has a legend.
  void panel(std::string y_label, const FigureRange& y) { panel(FigurePanel{std::move(y_label), y, {}}); }
  void panel(FigurePanel panel) { panels_.push_back(std::move(panel)); }

  /// Commands that stand before the plot command.
  void command(std::string_view line) { (commands_ += line) += '\n'; }

  /// Writes the figure's files to `folder` and draws it. With panels, y and the label of the ordinate are theirs.
  /// @param which  none: draw_pictures follows
  /// @throws OutputError when data or script cannot be written
  [[nodiscard]] FigureOutcome draw(const std::filesystem::path& folder, const FigureText& text, const FigureRange& x,
                                   const FigureRange& y, const std::vector<FigureMarker>& markers = {},
                                   const FigureCanvas& canvas = {}, Pictures which = Pictures::both) const;

 private:
  template <class Row>
  static bool has_gap(const Row& row) {
    return std::any_of(std::begin(row), std::end(row), [](double value) { return !std::isfinite(value); });
  }

  /// @returns the number of columns, 0 for a gap
  template <class Row>
  std::size_t write(const Row& row) {
    if (has_gap(row)) {
      data_ += '\n';
      return 0;
    }
    std::size_t columns = 0;
    for (const double value : row) {
      if (columns++ > 0) data_ += ' ';
      append_number(data_, value);
    }
    data_ += '\n';
    return columns;
  }

  void end_letters(std::string_view text, std::string_view style);
  void end_set(bool gap, std::size_t columns, std::string_view style, std::string_view title);
  void clause(std::string_view source, std::string_view style, std::string_view title);

  std::string stem_, data_, plot_, commands_;
  std::size_t sets_ = 0;
  std::vector<std::string> legend_;
  std::vector<FigurePanel> panels_;
};

}  // namespace epicyclic::figures
