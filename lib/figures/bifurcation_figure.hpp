// Bifurcation diagrams: over each value of a parameter, the values that the Poincare section shows.
//
// Chaotic reaches hold far more points than a figure can show. Points that fall into the same cell of a grid finer than
// the picture (4000 x 3000) are drawn once; the first in the order of the data stays, so that the same data give the
// same files. Values that are not finite are left out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "figures/gnuplot.hpp"

namespace epicyclic::figures {

/// One value of the parameter with the section's values over it.
struct SectionPoint {
  double x = 0;
  std::vector<double> section;  ///< empty where there are none
  bool apart = false;           ///< its values differ in kind from the others, and have another style
};

/// The points of one sweep, in one direction, in any order.
struct BifurcationSeries {
  std::string label;  ///< for the legend, as "increasing {/Symbol W}"
  std::size_t count = 0;
  /// The i-th, nothing if it is not to be drawn. Called twice for each: not all need fit into memory.
  std::function<std::optional<SectionPoint>(std::size_t i)> at;
};

/// Draws one or two series (the first, dark blue, over the second, muted red) to `folder`/STEM.png and .svg, from
/// STEM.dat with the script STEM.gp. A legend appears when there are two. The abscissa spans exactly the parameter's
/// range; the ordinate has a margin of 4 %.
/// @param which  pictures; none: data and script are written, and draw_pictures follows
/// @param apart  what points that are drawn apart are, for the legend
/// @returns what became of the figure; not drawn, too, when there is no finite point
/// @throws OutputError           when data or script cannot be written
/// @throws std::invalid_argument when there is no series or more than two, or when the stem is not a plain file name
FigureOutcome bifurcation_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                                 const std::vector<BifurcationSeries>& series,
                                 const std::vector<FigureMarker>& markers = {}, Pictures which = Pictures::both,
                                 const std::string& apart = {});

/// The class of a point, with its place in the legend.
struct PointClass {
  std::string label;
  std::string colour;           ///< as "#12285c"
  bool interval_counts = true;  ///< whether intervals of its values widen the ordinate
};

/// One value of the parameter, its class, and a number that is known to within an interval.
struct ClassPoint : SectionPoint {
  std::size_t of_class = 0;  ///< index
  double value = 0;          ///< drawn if finite
  double half_width = 0;     ///< of its interval
};

/// The bifurcation diagram coloured by class, and under it on the same axis the value with its interval. Files, ranges
/// and outcome as of bifurcation_figure(). Classes without a point are not in the legend, which counts the points of
/// the others.
/// @param value        name of the value, for readers of the data
/// @param value_label  of the lower ordinate
/// @param at           as in BifurcationSeries
/// @throws OutputError, std::invalid_argument for a stem that is not a plain file name
FigureOutcome class_bifurcation_figure(const std::filesystem::path& folder, std::string_view stem,
                                       const FigureText& text, std::string_view value, const std::string& value_label,
                                       const std::vector<PointClass>& classes, std::size_t count,
                                       const std::function<std::optional<ClassPoint>(std::size_t i)>& at,
                                       Pictures which = Pictures::both);

}  // namespace epicyclic::figures
