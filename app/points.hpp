// The points of a sweep, a map or basins: what is missing is computed, journalled and counted, on one process or on
// several ranks.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "io/point_store.hpp"
#include "io/study_input.hpp"
#include "io/sweep_output.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::app {

/// What the results are written with, once all points are there.
struct ComputedPoints {
  const std::filesystem::path& folder;
  const io::LoadedInput& input;
  const model::DynamicModel& first_model;
  const std::string& resolved;
  const io::PointSource points;
};

/// What was written.
struct WrittenPoints {
  std::vector<io::DrawnFigure> figures{};
  nlohmann::json summary = nlohmann::json::object();  ///< joins that of --json
  std::vector<std::string> lines{};                   ///< for stdout
  std::vector<std::string> notes{};                   ///< for stderr
};

/// Writes files of its own, on any rank and beside the other parts.
using ResultsPart = std::function<WrittenPoints(const ComputedPoints&)>;

/// The life of a study of points: input, folder, journal, points, results, summary.
/// @param command  its name, which is the kind of its study
/// @param noun     what a point is called: "points", "cells"
/// @param parts    write tables and figures, the longest first
/// @returns exit code
int points_command(const Arguments& arguments, std::string_view command, std::string_view noun,
                   const std::vector<ResultsPart>& parts);

}  // namespace epicyclic::app
