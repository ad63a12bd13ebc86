// Figures of stored results: any column of the tables of finished studies, of one study or of several in one figure.
//
//   sweep        a column of points.csv over its parameter or another column, up and down; or of poincare.csv
//   map          a column of points.csv over the plane
//   continue     a column of branch.csv, stable orbits solid, unstable ones dashed; over sweeps, too
//   run          a column of history.csv over the time
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "figures/gnuplot.hpp"
#include "input/study_input.hpp"
#include "reports/sweep_output.hpp"

namespace epicyclic::reports {

/// A finished study with unchanged tables.
struct PlottedStudy {
  std::filesystem::path folder;
  const input::Study* study = nullptr;
  std::string label;  ///< for the legend
};

struct PlotOptions {
  std::string quantity;  ///< column; empty: the default of its kind
  std::string abscissa;  ///< column; empty: the parameter, of a run the time
  std::optional<figures::FigureRange> x{}, y{};
  bool micrometres = false;  ///< lengths in micrometres instead of b_c
  bool logarithmic = false;  ///< ordinate
  std::string title;         ///< empty: that of the study, if there is one
  figures::FigureCanvas canvas{};
  std::vector<figures::Pictures> pictures = {figures::Pictures::png, figures::Pictures::svg};
};

/// The files of a study that plots read.
/// @throws InputError for a kind that is not drawn
[[nodiscard]] std::vector<std::string> plotted_tables(const input::Study& study);

/// A column as the label of an axis: "RMS of δ_{sp,1} / b_c".
[[nodiscard]] std::string quantity_label(const std::string& column, bool micrometres);

/// The options with the default quantity in place.
/// @throws InputError for studies that have no such column, or that do not fit into one figure
[[nodiscard]] PlotOptions sound_options(const std::vector<PlottedStudy>& studies, PlotOptions options);

/// Draws STEM.png and the others to `folder`, STEM from quantity and abscissa.
/// @param options  valid ones
/// @param notes    receives what a figure leaves out
/// @throws InputError for invalid tables; OutputError
[[nodiscard]] std::vector<DrawnFigure> draw_plot(const std::filesystem::path& folder,
                                                 const std::vector<PlottedStudy>& studies, const PlotOptions& options,
                                                 std::vector<std::string>& notes);

}  // namespace epicyclic::reports
