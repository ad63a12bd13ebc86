// Files of expected special points, and what `epicyclic assert` says of a comparison with them.
//
//   { "format": "epicyclic expected points 1",
//     "study":  the resolved input of the study whose points they are,
//     "points": [ { "kind": "flip", "period": 1, "value": 2.1489464, "bound": 9e-7 }, ... ] }
//
// with "contact" and "broken_symmetry" where a point has them, as in special.csv. How a study is integrated, how
// finely, and how its branches are followed may differ from the file's; what is computed may not: stage, operating
// point, model, width of the smooth clearance, parameter and range.
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

  /// Points farther apart are not one: a thousandth of the range.
  [[nodiscard]] double reach() const;
};

/// @throws InputError with all that is wrong
[[nodiscard]] ExpectedPoints read_expected(const std::filesystem::path& file);

/// Of points that were found: those of a kind, with a place and a bound. That is twice their own, so that another
/// computation that is as certain agrees, and not less than a part of 1e-9 of the range.
[[nodiscard]] std::vector<studies::LocatedPoint> expected_of(const std::vector<studies::LocatedPoint>& found,
                                                             const studies::BranchesOptions& study);

/// Text of such a file.
[[nodiscard]] std::string expected_text(const input::LoadedInput& study,
                                        const std::vector<studies::LocatedPoint>& points);

/// In what a study is not the one whose points are expected, a line each.
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
