// The files of a sweep: points.csv, poincare.csv, results.h5, figures.
//
// All of it follows from the points alone and is the same, byte for byte, for the same study.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "figures/gnuplot.hpp"
#include "input/study_input.hpp"
#include "store/hdf5_file.hpp"
#include "store/point_columns.hpp"
#include "studies/point_source.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::reports {

/// Axis label of a sweep parameter, and the symbol in it.
[[nodiscard]] std::string parameter_label(const std::string& parameter);
[[nodiscard]] std::string parameter_symbol(const std::string& parameter);

/// Text in legends for points whose record has not converged to the orbit.
inline constexpr const char* not_converged_words = "record not converged to the orbit";

/// Axis label of a speed by its key, as "sun_speed_rpm"; empty of any other.
[[nodiscard]] std::string speed_label(std::string_view key);

/// For an abscissa that is the mesh frequency ratio: the unit of the study's speeds, else the sun's speed in rpm.
/// Nothing for any other abscissa.
/// @param points  of which one was seen
[[nodiscard]] std::optional<figures::SecondAbscissa> speed_above(const std::string& parameter,
                                                                 const std::optional<studies::SpeedUnit>& given,
                                                                 const studies::PointSource& points);
[[nodiscard]] std::optional<figures::SecondAbscissa> speed_above(const std::string& parameter,
                                                                 const std::optional<studies::SpeedUnit>& given,
                                                                 double omega, const studies::StageRecord& record);

/// Name of study or stage with the boundary and, unless it is swept, the speed: for figures.
[[nodiscard]] std::string figure_title(const input::Study& study);

/// Of a pair of gears, and not of a stage.
[[nodiscard]] bool is_pair(const studies::PointSource& points);

/// Data of a sweep for its files, besides its points.
struct SweepOutput {
  studies::SweepOptions sweep;
  std::vector<std::string> poincare_columns;
  std::string resolved_input;                 ///< text of input.resolved.json, kept in results.h5 too
  std::string title;                          ///< of the figures
  std::optional<studies::SpeedUnit> speed{};  ///< what the study gives speeds along the axis in; none: Omega
};

/// @throws OutputError, and what reading points throws
void write_points_csv(const std::filesystem::path& file, const studies::PointSource& points,
                      const std::vector<store::PointColumn>& more = {});
void write_poincare_csv(const std::filesystem::path& file, const SweepOutput& output,
                        const studies::PointSource& points);
void write_results_h5(const std::filesystem::path& file, const SweepOutput& output, const studies::PointSource& points);

/// The group /points of results.h5, one dataset a column.
void write_point_columns(store::Hdf5File& h5, const studies::PointSource& points,
                         const std::vector<store::PointColumn>& more = {});

struct DrawnFigure {
  std::filesystem::path file;  ///< the PNG picture, as a rule
  figures::FigureOutcome outcome;
};

/// The figures of a sweep: bifurcation diagrams of the meshes of planet 1; that of its sun mesh coloured by regime, one
/// for each direction, because the colours are needed for the regimes; response curves of both meshes, largest force,
/// K_v, load sharing where planets differ [reports/response_output.hpp]; spectra over the parameter, one for each
/// direction.
enum class SweepFigure {
  delta_sp,
  delta_rp,
  regimes_first,
  regimes_second,
  response_sp,
  response_rp,
  dynamic_factor,
  kv,
  load_sharing,
  load_sharing_max,
  waterfall_first,
  waterfall_second,
};
inline constexpr std::array all_sweep_figures{SweepFigure::delta_sp,        SweepFigure::delta_rp,
                                              SweepFigure::regimes_first,   SweepFigure::regimes_second,
                                              SweepFigure::response_sp,     SweepFigure::response_rp,
                                              SweepFigure::dynamic_factor,  SweepFigure::kv,
                                              SweepFigure::load_sharing,    SweepFigure::load_sharing_max,
                                              SweepFigure::waterfall_first, SweepFigure::waterfall_second};

/// Data and script of a figure in `folder`, for draw_sweep_picture.
/// @returns nothing, or why there is nothing to draw. It gives no reason if the study has no such figure: one
/// direction, or no classified regimes.
/// @throws OutputError, and what reading points throws
[[nodiscard]] std::optional<DrawnFigure> write_sweep_figure(const std::filesystem::path& folder,
                                                            const SweepOutput& output,
                                                            const studies::PointSource& points, SweepFigure figure);

/// Draws one of its pictures from them.
/// @returns nothing if there is nothing to draw
/// @throws OutputError
[[nodiscard]] std::optional<DrawnFigure> draw_sweep_picture(const std::filesystem::path& folder,
                                                            const SweepOutput& output, SweepFigure figure,
                                                            figures::Pictures picture);

}  // namespace epicyclic::reports
