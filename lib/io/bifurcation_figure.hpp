// Bifurcation diagrams: over each value of a parameter, the values that the Poincare section shows.
//
// Chaotic reaches hold far more points than a figure can show. Points that fall into the same cell of a grid finer than
// the picture (4000 x 3000) are drawn once; the first in the order of the data stays, so that the same data give the
// same files. Values that are not finite are left out.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/regime.hpp"
#include "io/gnuplot.hpp"

namespace epicyclic::io {

/// The points of one sweep, in one direction.
struct BifurcationSeries {
  std::string label;                   ///< for the legend, as "increasing {/Symbol W}"
  std::vector<double> x;               ///< the parameter, in any order
  std::vector<std::vector<double>> y;  ///< y[i]: the section's values at x[i]; empty where there are none
};

/// Draws one or two series (the first, dark blue, over the second, muted red) to `folder`/STEM.png and .svg, from
/// STEM.dat with the script STEM.gp. A legend appears when there are two. The abscissa spans exactly the parameter's
/// range; the ordinate has a margin of 4 %.
/// @returns what became of the figure; not drawn, too, when there is no finite point
/// @throws OutputError           when data or script cannot be written
/// @throws std::invalid_argument when there is no series or more than two, when x and y of one differ in length, or
///                               when the stem is not a plain file name
FigureOutcome bifurcation_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                                 const std::vector<BifurcationSeries>& series,
                                 const std::vector<FigureMarker>& markers = {});

/// One value of the parameter with what its motion is.
struct RegimePoint {
  double x = 0;
  std::vector<double> section;  ///< as BifurcationSeries::y
  analysis::Regime regime = analysis::Regime::undecided;
  int period = 0;               ///< n, if periodic
  analysis::Estimate exponent;  ///< largest, per tau; drawn if finite
};

/// The bifurcation diagram coloured by regime, and under it on the same axis the largest Lyapunov exponent with its
/// interval. Files, ranges and outcome as above; the points may be in any order.
/// @throws OutputError, std::invalid_argument for a stem that is not a plain file name
FigureOutcome regime_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                            const std::vector<RegimePoint>& points);

}  // namespace epicyclic::io
