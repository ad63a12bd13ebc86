// The life of a study of a plane, a map or basins: input, folder, journal, cells, summary.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "io/output_folder.hpp"
#include "io/study_input.hpp"
#include "io/sweep_output.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::app {

/// What the results are written with.
struct ComputedPlane {
  const io::OutputFolder& folder;
  const io::LoadedInput& input;
  const model::DynamicModel& first_model;
  const std::string& resolved;
  std::vector<studies::PointResult>& results;  ///< of all cells, in order
};

/// What was written.
struct WrittenPlane {
  std::vector<io::DrawnFigure> figures{};
  nlohmann::json summary = nlohmann::json::object();  ///< joins that of --json
  std::vector<std::string> lines{};                   ///< for stdout
};

/// @param write  writes tables and figures once all cells are there
/// @returns exit code
int plane_command(const Arguments& arguments, std::string_view kind,
                  const std::function<WrittenPlane(const ComputedPlane&)>& write);

}  // namespace epicyclic::app
