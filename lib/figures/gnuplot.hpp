// Figures by gnuplot: the process, and the style that all figures share.
//
// A figure is three files that belong together, `STEM.dat` (data), `STEM.gp` (script) and what the script draws,
// `STEM.png` and `STEM.svg`; for another style, edit the script and run `gnuplot STEM.gp` in the folder. Figures are
// drawn after the data are safe, so that a missing gnuplot or a failing script is a result with a clear text, never an
// exception.
//
// Texts are UTF-8 in gnuplot's "enhanced" notation (x_{sp}, 10^{-3}). Greek letters and bars are best written as they
// are (Ω, δ̄); {/Symbol W} and ~{x}{.6-} are replaced by them, because gnuplot's SVG files show these wrongly.
// verbatim_text() converts a user's text to such a text.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"

namespace epicyclic::figures {

/// What became of a figure. `message` is empty if it was drawn, else it says in one line why not.
struct FigureOutcome {
  std::string message;
  bool empty = false;  ///< the data have nothing to draw, as the spectrum of a response without vibration: no failure
  [[nodiscard]] bool drawn() const { return message.empty(); }
  [[nodiscard]] bool failed() const { return !drawn() && !empty; }
};

/// @param why  "there is no finite point to draw"
[[nodiscard]] inline FigureOutcome nothing_to_draw(std::string why) { return {std::move(why), true}; }

/// An interval of values that grows with what it is shown.
struct FigureRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  /// Values that are not finite are ignored.
  void include(double value);
  [[nodiscard]] bool empty() const { return low > high; }
  /// With a margin of `share` of its width at both ends; around a single value, wide enough to be an axis.
  [[nodiscard]] FigureRange widened(double share) const;
};

/// Share of the height of the data that is left free above and below them [-].
inline constexpr double figure_margin = 0.04;

/// The abscissa in another unit, above the frame.
struct SecondAbscissa {
  std::string label;
  double factor = 1;  ///< its number over that of the abscissa
};

/// Tics and label of a second abscissa, which a canvas is higher by [pixels].
inline constexpr int second_abscissa_height = 92;

/// Title and axis labels of a figure; the title may be empty. A long title is written smaller.
struct FigureText {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::optional<SecondAbscissa> above{};
  std::vector<std::pair<double, std::string>> x_names{};  ///< on edge, for numbers on the abscissa of panels
};

/// A vertical line at an abscissa, with a label; not drawn outside the figure.
struct FigureMarker {
  double x = 0;
  std::string label;
};

/// Size of a picture as PNG; the SVG file has four fifths of it, a PDF page 1 inch for 257 pixels.
struct FigureCanvas {
  int width = 1800;   ///< [pixels], times scale
  int height = 1100;  ///< [pixels], times scale
  double scale = 1;   ///< of all that is in it: texts, lines and points
  bool pdf = false;   ///< whether the script draws STEM.pdf, too
};

/// For a square frame, with room above it for a title and a legend.
inline constexpr FigureCanvas square_canvas{1200, 1240};

/// One of several frames over each other on one abscissa.
struct FigurePanel {
  std::string y_label;
  FigureRange y;
  std::string plot;                                     ///< one plot command without the word
  double height = 1;                                    ///< in parts of the sum of all
  std::vector<std::pair<double, std::string>> names{};  ///< that stand for numbers on the ordinate
  bool logarithmic = false;                             ///< ordinate
};

/// Which of its files a script draws. Drawn apart, they can be drawn side by side.
enum class Pictures { none, png, svg, both, pdf };

/// Is there a program of that name, where run_gnuplot searches for it?
bool gnuplot_is_installed();

/// Runs gnuplot on the script, without a shell, in the script's folder, in the C locale and without the user's own
/// settings (~/.gnuplot). A gnuplot that does not come to an end is ended, with its children.
/// @param which  of the files of figure_script or panel_script; not none; pdf of a canvas that has it
/// @param limit  longest time that it may take; none: two minutes and ten seconds for each megabyte of its data,
///               some ten times what it needs; less after others that hung
FigureOutcome run_gnuplot(const std::filesystem::path& script, Pictures which = Pictures::both,
                          std::optional<std::chrono::milliseconds> limit = {});

/// The text as a gnuplot string, in which gnuplot neither expands nor executes anything.
std::string gnuplot_quoted(std::string_view text);

/// A user's text, as a text that shows it as it was typed: no character has a meaning. A character without a picture
/// (line break, control character) becomes a blank. Marks that change the direction of writing are left out. A text
/// longer than a line loses its middle.
std::string verbatim_text(std::string_view typed);

/// Estimated width of a text in "enhanced" notation, rather too large than too small, in heights of its font.
double text_width(std::string_view text);

/// {/Symbol W} and ~{x}{.6-}, which SVG files show wrongly, replaced by Greek letters and combining macrons.
std::string portable_text(std::string_view text);

/// Commands for a logarithmic axis, "x" or "y": powers of ten are named; over less than three decades twice and five
/// times each, too; over less than one all digits, and over less than a third equal steps.
std::string logarithmic_axis(std::string_view axis, const FigureRange& range);

/// The script of a figure: encoding, white ground, thin frame, tics, ranges, labels, title, legend under it (or beside
/// it, where there is room), markers; then `plot`, which is one plot command (without the word) and is drawn twice, to
/// STEM.png and to STEM.svg, or to the one that the script is called with (`gnuplot -c STEM.gp svg`). It may use the
/// variable `mark`, the size of a clearly visible dot, which differs between the two.
/// @param legend  the titles in `plot`
/// @param extra   commands before it
std::string figure_script(std::string_view stem, const FigureText& text, const FigureRange& x, const FigureRange& y,
                          const std::vector<std::string>& legend, const std::vector<FigureMarker>& markers,
                          std::string_view extra, std::string_view plot, const FigureCanvas& canvas = {});

/// The script of a figure of panels over each other that have one abscissa, otherwise as figure_script().
/// @param text    y_label is not used: each panel has its own
/// @param panels  from above; each has its plot command
/// @param legend  the titles in the plot of the first panel
/// @param extra   commands before the first plot
std::string panel_script(std::string_view stem, const FigureText& text, const FigureRange& x,
                         const std::vector<FigurePanel>& panels, const std::vector<std::string>& legend,
                         std::string_view extra, const FigureCanvas& canvas = {});

/// Draws STEM.png, STEM.svg, both, or STEM.pdf from STEM.dat with STEM.gp, which are in `folder`.
/// @throws OutputError  when gnuplot leaves a picture unfinished
FigureOutcome draw_pictures(const std::filesystem::path& folder, std::string_view stem, Pictures which);

/// Writes STEM.dat and STEM.gp to `folder`, which is created in its parent if need be, and draws.
/// @param which  none: draw_pictures follows
/// @throws OutputError           when data or script cannot be written, or gnuplot leaves a picture unfinished
/// @throws std::invalid_argument when the stem is not a plain file name (letters, digits, '_', '-', '.')
FigureOutcome draw_figure(const std::filesystem::path& folder, std::string_view stem, std::string_view data,
                          std::string_view script, Pictures which = Pictures::both);

/// Writes STEM.dat and STEM.gp to `folder`, which is created in its parent if need be, and draws. The data need not fit
/// into memory.
/// @param write_data  writes them to STEM.dat
/// @param which       none: draw_pictures follows
/// @throws OutputError           when data or script cannot be written, or gnuplot leaves a picture unfinished
/// @throws std::invalid_argument when the stem is not a plain file name (letters, digits, '_', '-', '.')
FigureOutcome draw_figure(const std::filesystem::path& folder, std::string_view stem,
                          const std::function<void(AtomicFile&)>& write_data, std::string_view script,
                          Pictures which = Pictures::both);

}  // namespace epicyclic::figures
