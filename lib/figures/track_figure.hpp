// Numbers along a parameter, in frames over each other: response curves and the like, up and down.
//
// Each value is a dot; a thin line joins neighbours that are said to belong together. Data need not fit into memory.
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

/// All numbers at one value of the parameter.
struct TrackRow {
  double x = 0;
  bool joined = true;     ///< lines go through its dots
  std::vector<double> y;  ///< one that is not finite is not drawn, and interrupts
  bool apart =
      false;  ///< its dots differ in kind from the others: no line goes through them, and they have another style
};

/// Rows in the order of the parameter, up or down.
struct TrackSeries {
  std::string label;  ///< for the legend, where there are two
  std::size_t count = 0;
  std::function<std::optional<TrackRow>(std::size_t i)> at;  ///< nothing: not drawn; called twice for each
};

/// A frame and which of the numbers it shows.
struct TrackPanel {
  std::string y_label;
  std::vector<std::size_t> columns;
};

/// Draws to `folder`/STEM.png and .svg, from STEM.dat with the script STEM.gp. Frames of one number each are coloured
/// by series (dark blue over muted red); of several, by number, the second series dashed.
/// @param series  one or two
/// @param names   of the numbers of a frame, for the legend; empty: each frame has one
/// @param apart   what rows that are drawn apart are, for the legend
/// @param which   none: draw_pictures follows
/// @returns what became of the figure; not drawn, too, when there is no finite point
/// @throws OutputError when data or script cannot be written
FigureOutcome track_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                           const std::vector<TrackSeries>& series, const std::vector<TrackPanel>& panels,
                           const std::vector<std::string>& names = {}, Pictures which = Pictures::both,
                           const std::string& apart = {});

}  // namespace epicyclic::figures
