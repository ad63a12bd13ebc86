// Line figures: several curves over one abscissa (histories, spectra, stiffness over a mesh period, phase portraits),
// in the style of figures/gnuplot.hpp.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "figures/gnuplot.hpp"

namespace epicyclic::figures {

/// One curve. A pair in which a number is not finite interrupts it.
struct FigureCurve {
  std::string label;      ///< for the legend; no entry if empty
  std::vector<double> x;  ///< in the order of drawing; need not ascend
  std::vector<double> y;  ///< as many
  bool points = false;    ///< points instead of a line
  bool marked = false;    ///< points besides the line
};

/// Scales of the axes. On a logarithmic one, values that are not positive interrupt the curve.
struct FigureAxes {
  bool log_x = false;
  bool log_y = false;
};

/// Draws the curves to `folder`/STEM.png and .svg, from STEM.dat with the script STEM.gp. The legend has the labels
/// that are not empty. The ordinate has a margin of 4 %; the abscissa spans exactly the range of the
/// data, but for a margin where there are points, which the frame would hide.
/// @returns what became of the figure; not drawn, too, when there is no finite point
/// @throws OutputError           when data or script cannot be written
/// @throws std::invalid_argument when there is no curve, when x and y of one differ in length, or when the stem is not
/// a
///                               plain file name
FigureOutcome line_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                          const std::vector<FigureCurve>& curves, const FigureAxes& axes = {},
                          const std::vector<FigureMarker>& markers = {});

}  // namespace epicyclic::figures
