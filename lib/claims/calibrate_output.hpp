// The files of a search for parameters.
//
//   candidates.csv   a row per candidate: phase, number, cost, its parameters, the cost of each claim
//   profile.csv      the cost along each parameter through the result, all others held
//   calibrate.md     in words: what was searched, the result, which claims it meets, how sharply it is determined
//   figures/         determination: of each parameter its place in its range, and the stretches where the cost rises
//                    little and where no claim is lost
//
// All of it follows from the evaluations alone and is the same, byte for byte, for the same study.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "claims/calibration.hpp"
#include "reports/sweep_output.hpp"

namespace epicyclic::claims {

struct CalibrateOutput {
  ClaimsOptions options;
  std::string name;  ///< of the study
};

/// @throws OutputError
void write_candidates_csv(const std::filesystem::path& file, const CalibrateOutput& output,
                          const KnownEvaluations& evaluations);

/// @throws OutputError
void write_profile_csv(const std::filesystem::path& file, const CalibrateOutput& output,
                       const Calibration& calibration);

/// Of a complete search with a profile.
/// @throws OutputError
[[nodiscard]] reports::DrawnFigure draw_determination(const std::filesystem::path& folder,
                                                      const CalibrateOutput& output, const Calibration& calibration);

/// Text of calibrate.md, of a search that has a best candidate.
[[nodiscard]] std::string calibrate_summary(const CalibrateOutput& output, const Calibration& calibration);

}  // namespace epicyclic::claims
