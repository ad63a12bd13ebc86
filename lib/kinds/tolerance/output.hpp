// The files of a tolerance study: tables, figures, and the recommendation in words.
//
//   tolerance.csv    point x method x tolerance: errors of flow and orbit, work of one orbit, quantities
//   smoothing.csv    point x width: distance of the smoothed orbit, work, quantities
//   quantities.csv   point x quantity: the study's value, the reference's, the error bar, the extrapolation of widths
//   statistics.csv   if the response is not periodic: exponent and moments with their intervals
//   tolerance.md     slopes, recommendation, error bars
//
// The bytes are the same for the same study, except for the figure over time (figures/work_precision_time.*): times
// depend on the machine and its load.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/sweep_output.hpp"
#include "studies/tolerance.hpp"

namespace epicyclic::kinds {

/// Data for the tables besides the points.
struct ToleranceOutput {
  reports::SweepOutput sweep;
  studies::ToleranceOptions options;
  integrate::IntegratorOptions integrator;
  std::size_t dimension = 0;
};

/// The four tables and tolerance.md.
/// @returns text of tolerance.md
/// @throws OutputError
std::string write_tolerance_tables(const std::filesystem::path& folder, const ToleranceOutput& output,
                                   const std::vector<studies::TolerancePoint>& points);

[[nodiscard]] std::vector<reports::DrawnFigure> draw_tolerance_figures(
    const std::filesystem::path& folder, const ToleranceOutput& output,
    const std::vector<studies::TolerancePoint>& points);

}  // namespace epicyclic::kinds
