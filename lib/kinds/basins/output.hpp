// The files of basins: points.csv, attractors.csv, results.h5, a figure. There is no poincare.csv. Of a cell's
// trajectory only the data that determine its attractor are kept, and those in the journal.
//
// All of it follows from the points alone and is the same, byte for byte, for the same study.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/attractors.hpp"
#include "reports/sweep_output.hpp"
#include "studies/plane.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::kinds {

struct BasinsOutput {
  studies::Plane plane;
  std::vector<std::string> state_names;
  std::vector<studies::PlanetRotation> rotations;  ///< symmetries with which images of attractors are identified
  std::string resolved_input;                      ///< text of input.resolved.json, kept in results.h5 too
  std::string title;                               ///< of the figure
};

/// "period 2", "chaotic".
[[nodiscard]] std::string attractor_word(const analysis::AttractorRecord& record);

/// Axis label of a component of the state.
[[nodiscard]] std::string component_label(const std::string& component);

/// @throws OutputError
void write_basins_csv(const std::filesystem::path& file, const std::vector<studies::PointSummary>& results,
                      const analysis::Attractors& attractors);
void write_attractors_csv(const std::filesystem::path& file, const BasinsOutput& output,
                          const std::vector<studies::PointSummary>& results, const analysis::Attractors& attractors);
void write_basins_h5(const std::filesystem::path& file, const BasinsOutput& output,
                     const std::vector<studies::PointSummary>& results, const analysis::Attractors& attractors);

/// A colour for each of the twelve largest attractors.
[[nodiscard]] std::vector<reports::DrawnFigure> draw_basins_figure(const std::filesystem::path& folder,
                                                                   const BasinsOutput& output,
                                                                   const std::vector<studies::PointSummary>& results,
                                                                   const analysis::Attractors& attractors);

}  // namespace epicyclic::kinds
