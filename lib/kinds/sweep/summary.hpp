// What a sweep shows, in words: sweep.md. Windows of one motion, where up and down part, and where the largest
// vibrations and forces are.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "reports/sweep_output.hpp"

namespace epicyclic::kinds {

struct SweepSummary {
  std::string text;                                   ///< of sweep.md
  std::vector<std::string> lines;                     ///< the same in short
  nlohmann::json numbers = nlohmann::json::object();  ///< of the lines
};

/// Points that failed, or whose record is still on its way to its orbit, are left out of what is largest. Up and down
/// are two motions where one is periodic and the other is not or has another period, or where the record of one is
/// farther from the other's orbit than from its own; where neither is periodic, nothing tells.
[[nodiscard]] SweepSummary sweep_summary(const reports::SweepOutput& output, const studies::PointSource& points);

}  // namespace epicyclic::kinds
