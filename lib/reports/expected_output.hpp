// Files of expected special points, and the report of `epicyclic assert` on a comparison with them.
//
//   { "format": "epicyclic expected points 1",
//     "study":  the resolved input of the study whose points they are,
//     "points": [ { "kind": "fold", "period": 1, "value": 1.3567019, "bound": 2.8e-9 }, ... ] }
//
// A point also has "contact" and "broken_symmetry" if it has them in special.csv. The study may differ from the file's
// in its integration, its tolerances and how it follows branches. It may not differ in what it computes: stage,
// operating point, model, width of the smooth clearance, parameter and range.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "input/study_input.hpp"
#include "studies/branches_options.hpp"
#include "studies/expected_points.hpp"

namespace epicyclic::reports {

struct ExpectedPoints {
  nlohmann::json study;  ///< a resolved input
  std::vector<studies::LocatedPoint> points;

  /// Points farther apart do not correspond: a thousandth of the range.
  [[nodiscard]] double reach() const;
};

/// @throws InputError with all errors
[[nodiscard]] ExpectedPoints read_expected(const std::filesystem::path& file);

/// Found points as expected ones: those of a kind, with a value and a bound. The bound is twice their own, so that
/// another computation of the same accuracy agrees. It is at least 1e-9 of the range.
[[nodiscard]] std::vector<studies::LocatedPoint> expected_of(const std::vector<studies::LocatedPoint>& found,
                                                             const studies::BranchesOptions& study);

/// Text of such a file.
[[nodiscard]] std::string expected_text(const input::LoadedInput& study,
                                        const std::vector<studies::LocatedPoint>& points);

/// Differences between a study and the one of the expected points, a line each.
[[nodiscard]] std::vector<std::string> unlike(const ExpectedPoints& expected, const input::LoadedInput& study);

/// A line for each point, in words.
[[nodiscard]] std::string compared_table(const std::vector<studies::PointComparison>& compared);

[[nodiscard]] nlohmann::json compared_json(const std::vector<studies::PointComparison>& compared);

/// A JUnit test suite, a test case for each point.
/// @param name  of the suite
[[nodiscard]] std::string junit_text(const std::string& name, const std::vector<studies::PointComparison>& compared);

/// A JUnit test suite of one error: nothing was compared.
/// @param message  why, in a line
/// @param text     more of it
[[nodiscard]] std::string error_junit_text(const std::string& name, const std::string& message,
                                           const std::string& text);

}  // namespace epicyclic::reports
