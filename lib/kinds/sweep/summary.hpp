// The results of a sweep in words: sweep.md. Windows of one regime, intervals where up and down differ, and the values
// with the largest vibrations and forces.
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

/// The largest values leave out points that failed and points whose record has not converged. Up and down are two
/// attractors if one is periodic and the other is not, or has another period. They are also two if the record of one is
/// farther from the other's orbit than from its own. If neither is periodic, the comparison is not possible.
[[nodiscard]] SweepSummary sweep_summary(const reports::SweepOutput& output, const studies::PointSource& points);

}  // namespace epicyclic::kinds
