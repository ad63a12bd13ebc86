// What a report has of one study: its tables, the section and the spectra of a sweep, its input and where it came from.
// Nothing is computed but rates of deflections, short histories, and multipliers beside changes of the regime.
#pragma once

#include <filesystem>
#include <functional>

#include <nlohmann/json.hpp>

#include "report_data.hpp"

namespace epicyclic::app {

/// b_c [um]
[[nodiscard]] double micrometres_per_length_scale();

/// run.json of a study, with its "identity", a text.
/// @throws InputError if there is no study in the folder
[[nodiscard]] nlohmann::json run_of(const std::filesystem::path& folder);

/// Changes nothing in the folder. A study of points that is not complete is reported as far as it has come.
/// @param data       takes the columns
/// @param stop_here  called between points, on each thread; may throw
/// @param threads    no effect on the result
/// @returns the study for the header
/// @throws InputError when there is no study in it, or nothing of it can be shown yet; DamagedData when its files are
/// not what they were
[[nodiscard]] nlohmann::json study_report(const std::filesystem::path& folder, ReportData& data,
                                          const std::function<void()>& stop_here, int threads = 1);

}  // namespace epicyclic::app
