// What a sweep leaves in its folder: points.csv, poincare.csv, results.h5, figures.
//
// All of it follows from the points alone and is the same, byte for byte, for the same study (architecture section 7).
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "figures/gnuplot.hpp"
#include "io/hdf5_file.hpp"
#include "io/study_input.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::io {

/// Status of a point in points.csv: ok, diverged, step_limit, failed.
[[nodiscard]] std::string status_word(integrate::Outcome outcome);

/// "up" or "down".
[[nodiscard]] std::string direction_word(studies::Direction direction);

/// Regime of a point in points.csv: periodic, undecided; empty unless ok.
[[nodiscard]] std::string regime_word(const studies::PointResult& result);

/// Axis label of a sweep parameter, and the symbol in it.
[[nodiscard]] std::string parameter_label(const std::string& parameter);
[[nodiscard]] std::string parameter_symbol(const std::string& parameter);

/// Name of study or stage with the boundary and, unless it is swept, the speed: for figures.
[[nodiscard]] std::string figure_title(const Study& study);

/// What a sweep is written with besides its points.
struct SweepOutput {
  studies::SweepOptions sweep;
  std::vector<std::string> poincare_columns;
  std::string resolved_input;  ///< text of input.resolved.json, kept in results.h5 too
  std::string title;           ///< of the figures
};

/// Points that writers read one by one, as often as they need: a study may be larger than memory.
struct PointSource {
  std::size_t count = 0;
  std::function<studies::PointResult(std::size_t point)> read;
  std::function<studies::PointResult(std::size_t point)> read_brief;  ///< without the Poincare section
};

/// Those of a study of few points; `results` must live longer.
[[nodiscard]] PointSource points_in_memory(std::span<const studies::PointResult> results);

/// All of them without their Poincare sections, for studies whose points are small: some 1 KB each.
[[nodiscard]] std::vector<studies::PointResult> all_brief(const PointSource& points);

/// A column of numbers that a kind of study adds, behind `value`.
struct PointColumn {
  std::string name;
  std::function<double(const studies::PointResult&)> value;
};

/// @throws OutputError, and what reading points throws
void write_points_csv(const std::filesystem::path& file, const PointSource& points,
                      const std::vector<PointColumn>& more = {});
void write_poincare_csv(const std::filesystem::path& file, const SweepOutput& output, const PointSource& points);
void write_results_h5(const std::filesystem::path& file, const SweepOutput& output, const PointSource& points);

/// The group /points of results.h5, one dataset a column.
void write_point_columns(Hdf5File& h5, const PointSource& points);

struct DrawnFigure {
  std::filesystem::path file;  ///< the PNG picture, as a rule
  figures::FigureOutcome outcome;
};

/// The figures of a sweep: bifurcation diagrams of the meshes of planet 1, and of its sun mesh coloured by regime, one
/// for each direction, because the colours are needed for the regimes.
enum class SweepFigure { delta_sp, delta_rp, regimes_first, regimes_second };

/// Data and script of a figure in `folder`, for draw_sweep_picture.
/// @returns nothing, or why there is nothing to draw; that the study has no such figure (one direction, regimes not
/// told) is no reason
/// @throws OutputError, and what reading points throws
[[nodiscard]] std::optional<DrawnFigure> write_sweep_figure(const std::filesystem::path& folder,
                                                            const SweepOutput& output, const PointSource& points,
                                                            SweepFigure figure);

/// Draws one of its pictures from them.
/// @returns nothing if there is nothing to draw
/// @throws OutputError
[[nodiscard]] std::optional<DrawnFigure> draw_sweep_picture(const std::filesystem::path& folder,
                                                            const SweepOutput& output, SweepFigure figure,
                                                            figures::Pictures picture);

}  // namespace epicyclic::io
