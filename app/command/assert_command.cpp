// epicyclic assert: the special points of finished branches against those that are expected of them.

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "core/errors.hpp"
#include "finished_study.hpp"
#include "reports/expected_output.hpp"
#include "streams.hpp"
#include "studies/expected_points.hpp"

namespace epicyclic::app {

namespace {

using nlohmann::json;
using studies::PointVerdict;

/// Reports the differences between the study and the one of the expected points.
int report_unlike(const std::vector<std::string>& lines, const std::filesystem::path& junit,
                  const Arguments& arguments) {
  constexpr std::size_t most = 5;
  if (!junit.empty()) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    write_file_atomically(junit, reports::error_junit_text(arguments.input.string(),
                                                           "another study than the points are expected of", text));
  }
  if (arguments.json)
    print("{}\n", json({{"another_study", lines}}).dump(2, ' ', false, json::error_handler_t::replace));
  print_message("{}: the points of {} are expected of another study\n", arguments.input.string(),
                arguments.against.string());
  for (std::size_t k = 0; k < std::min(lines.size(), most); ++k) print_message("  {}\n", lines[k]);
  if (lines.size() > most) print_message("  and {} more\n", lines.size() - most);
  return other_study;
}

/// Writes the folder's points as those that are expected from now on.
int record(const Arguments& arguments, const FinishedBranches& branches) {
  if (std::filesystem::exists(arguments.against))
    throw InputError(arguments.against.string() + ": exists; remove it to record its points again");
  const std::vector<studies::LocatedPoint> points =
      reports::expected_of(branches.points, branches.input.study.plan.as<studies::BranchesOptions>());
  if (points.empty())
    throw InputError(fmt::format("{}: none of {} special points has a value and an error bound; no file is written",
                                 arguments.input.string(), branches.points.size()));
  write_file_atomically(linked_file(arguments.against), reports::expected_text(branches.input, points));
  print_message("recorded {} of {} points as the expected ones: {}\n", points.size(), branches.points.size(),
                arguments.against.string());
  return points.size() == branches.points.size() ? done : done_with_failures;
}

int compare(const Arguments& arguments, const std::filesystem::path& junit) {
  const FinishedBranches branches = finished_branches(arguments.input);
  if (arguments.record) return record(arguments, branches);
  const reports::ExpectedPoints expected = reports::read_expected(arguments.against);
  if (const auto lines = reports::unlike(expected, branches.input); !lines.empty())
    return report_unlike(lines, junit, arguments);
  const auto compared = studies::compare_points(expected.points, branches.points, expected.reach());
  const auto failed = static_cast<std::size_t>(
      std::ranges::count_if(compared, [](const auto& c) { return c.verdict != PointVerdict::agrees; }));
  if (!junit.empty()) write_file_atomically(junit, reports::junit_text(arguments.input.string(), compared));
  if (arguments.json) {
    print("{}\n", reports::compared_json(compared).dump(2, ' ', false, json::error_handler_t::replace));
  } else {
    print("{}", reports::compared_table(compared));
    print("{} points expected, {} found, {} failed\n", expected.points.size(), branches.points.size(), failed);
  }
  return failed == 0 ? done : done_with_failures;
}

}  // namespace

int assert_command(const Arguments& arguments) {
  const std::filesystem::path junit = arguments.junit.empty() ? arguments.junit : linked_file(arguments.junit);
  try {
    return compare(arguments, junit);
  } catch (const InputError& error) {
    // Files of an earlier run would pass for the verdicts of this one.
    if (!junit.empty())
      write_file_atomically(
          junit, reports::error_junit_text(arguments.input.string(), "nothing could be compared", error.what()));
    throw;
  }
}

}  // namespace epicyclic::app
