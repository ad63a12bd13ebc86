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

#include "analysis/regime.hpp"
#include "io/gnuplot.hpp"

namespace epicyclic::io {

/// One value of the parameter with the section's values over it.
struct SectionPoint {
  double x = 0;
  std::vector<double> section;  ///< empty where there are none
};

/// The points of one sweep, in one direction, in any order.
struct BifurcationSeries {
  std::string label;  ///< for the legend, as "increasing {/Symbol W}"
  std::size_t count = 0;
  /// The i-th, nothing if it is not to be drawn. Asked twice for each: not all need fit into memory.
  std::function<std::optional<SectionPoint>(std::size_t i)> at;
};

/// Draws one or two series (the first, dark blue, over the second, muted red) to `folder`/STEM.png and .svg, from
/// STEM.dat with the script STEM.gp. A legend appears when there are two. The abscissa spans exactly the parameter's
/// range; the ordinate has a margin of 4 %.
/// @param which  pictures; none: data and script are written, and draw_pictures follows
/// @returns what became of the figure; not drawn, too, when there is no finite point
/// @throws OutputError           when data or script cannot be written
/// @throws std::invalid_argument when there is no series or more than two, or when the stem is not a plain file name
FigureOutcome bifurcation_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                                 const std::vector<BifurcationSeries>& series,
                                 const std::vector<FigureMarker>& markers = {}, Pictures which = Pictures::both);

/// One value of the parameter with what its motion is.
struct RegimePoint : SectionPoint {
  analysis::Regime regime = analysis::Regime::undecided;
  int period = 0;               ///< n, if periodic
  analysis::Estimate exponent;  ///< largest, per tau; drawn if finite
};

/// The bifurcation diagram coloured by regime, and under it on the same axis the largest Lyapunov exponent with its
/// interval. Files, ranges and outcome as above.
/// @param at  as in BifurcationSeries
/// @throws OutputError, std::invalid_argument for a stem that is not a plain file name
FigureOutcome regime_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                            std::size_t count, const std::function<std::optional<RegimePoint>(std::size_t i)>& at,
                            Pictures which = Pictures::both);

}  // namespace epicyclic::io
