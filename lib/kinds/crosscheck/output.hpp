// The files of a cross-check: crosscheck.csv, the reference's points.csv and poincare.csv, crosscheck.md, a figure. All
// of it follows from the points alone and is the same, byte for byte, for the same study.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/axis_words.hpp"
#include "reports/sweep_output.hpp"
#include "studies/crosscheck.hpp"

namespace epicyclic::kinds {

/// One row per point and compared variant.
/// @throws OutputError
void write_crosscheck_csv(const std::filesystem::path& file, const studies::Crosscheck& all);

/// Per variant: points, agreements, largest distance of two orbits, differences by explanation. Plain text table.
[[nodiscard]] std::string crosscheck_summary(const reports::AxisWords& words, const studies::Crosscheck& all);

/// Distance of the orbits over the parameter, one colour per variant.
[[nodiscard]] reports::DrawnFigure draw_crosscheck_figure(const std::filesystem::path& folder,
                                                          const reports::SweepOutput& output,
                                                          const studies::Crosscheck& all, double orbit_tolerance);

/// Points that differ, explained or not.
[[nodiscard]] std::size_t differences(const studies::Crosscheck& all);

/// Those of them that no computation explains, or at which one method has no result.
[[nodiscard]] std::size_t unexplained(const studies::Crosscheck& all);

}  // namespace epicyclic::kinds
