// The files of a map: points.csv, results.h5 with a matrix for each direction, figures. There is no poincare.csv: a
// cell keeps its row alone.
//
// Cells are read from the journal one after the other; a matrix and the cells of a figure take eight bytes each.
//
// All of it follows from the points alone and is the same, byte for byte, for the same study.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/sweep_output.hpp"
#include "studies/plane_options.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::kinds {

struct MapOutput {
  studies::MapOptions map;
  std::string resolved_input;                 ///< text of input.resolved.json, kept in results.h5 too
  std::string title;                          ///< of the figures
  std::optional<studies::SpeedUnit> speed{};  ///< what the study gives speeds along an axis in; none: Omega
};

/// @throws OutputError
void write_map_csv(const std::filesystem::path& file, const studies::PointSource& points);
void write_map_h5(const std::filesystem::path& file, const MapOutput& output, const studies::PointSource& points);

/// For each direction the regimes and, if the classification uses more than recurrence, the largest exponent.
[[nodiscard]] std::vector<reports::DrawnFigure> draw_map_figures(const std::filesystem::path& folder,
                                                                 const MapOutput& output,
                                                                 const studies::PointSource& points);

}  // namespace epicyclic::kinds
