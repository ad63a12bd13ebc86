// Figures of a plane of cells, each cell as it was computed: nothing is interpolated between them.
//
// A cell reaches to the middle between it and its neighbours; the outer ones are as wide as the others. Cells of one
// colour that stand side by side are one rectangle.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "figures/gnuplot.hpp"

namespace epicyclic::figures {

/// Centres of the cells along both axes.
struct CellGrid {
  std::vector<double> x, y;  ///< ascending
};

/// A colour and its entry in the legend beside the figure.
struct CellClass {
  std::string label;
  std::string colour;  ///< as "#12285c"
};

/// Cells in classes. Classes without a cell are not in the legend.
/// @param cells  row by row, from below: index of the class
/// @returns what became of the figure
/// @throws OutputError           when data or script cannot be written
/// @throws std::invalid_argument when there are not as many cells as the grid has, or a class does not exist
FigureOutcome class_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                           const CellGrid& grid, const std::vector<CellClass>& classes,
                           const std::vector<std::size_t>& cells);

/// Cells with a value: below zero in blues, above in reds, zero white; each side has the whole range of its colours
/// over its values, or over a tenth of the other side's, as the bar shows. Cells without a finite value are grey.
/// @param cells  row by row, from below
FigureOutcome value_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                           const CellGrid& grid, const std::string& bar_label, const std::string& grey_label,
                           const std::vector<double>& cells);

/// Cells with a positive value on a logarithmic scale, the darker the larger, in steps of a quarter of a decade. What
/// is below `floor`, or no number, is white.
/// @param cells  row by row, from below
/// @param which  none: draw_pictures follows
FigureOutcome decade_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                            const CellGrid& grid, const std::string& bar_label, const std::vector<double>& cells,
                            double floor, Pictures which = Pictures::both);

/// Cells with a value on a linear scale, the darker the larger, in twenty steps over the range of all. What is no
/// number is white.
/// @param cells  row by row, from below
/// @param which  none: draw_pictures follows
FigureOutcome scale_figure(const std::filesystem::path& folder, std::string_view stem, const FigureText& text,
                           const CellGrid& grid, const std::string& bar_label, const std::vector<double>& cells,
                           const FigureCanvas& canvas = {}, Pictures which = Pictures::both);

}  // namespace epicyclic::figures
