// The points of a sweep, a map or basins: what is missing is computed, journalled and counted, on one process or on
// several ranks.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "parts.hpp"

namespace epicyclic::app {

/// Once all points are there, before the parts: computes what needs all of them, by all threads.
/// @returns nothing if it was stopped
using AfterPoints = std::function<std::optional<WrittenPoints>(const Arguments&, const ComputedPoints&)>;

/// The life of a study of points: input, folder, journal, points, results, summary.
/// @param command  its name, which is the kind of its study
/// @param noun     what a point is called: "points", "cells"
/// @param parts    write tables and figures, the longest first, each behind what it needs
/// @param after    may be empty
/// @returns exit code
int points_command(const Arguments& arguments, std::string_view command, std::string_view noun,
                   const std::vector<ResultsPart>& parts, const AfterPoints& after = {});

}  // namespace epicyclic::app
