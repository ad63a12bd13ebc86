// The files of a survey of draws.
//
//   draws.csv        a row per draw: its parameters, which claims it meets, the cost of each; one more row for each
//                    further evaluation of the draw
//   robustness.csv   a row per claim: the part of the draws that it holds for, with its interval at 95 %; of the draws
//                    that were also compared with whole sweeps, how many agree
//   options.csv      a row per option of a choice and claim: the part of the draws with it that the claim holds for
//   influence.csv    a row per claim and parameter: rank correlation with the claim's score, with its interval
//   robustness.md    in words
//   figures/         robustness: the parts; influence: the correlations that are not zero
//
// All of it follows from the evaluations alone and is the same, byte for byte, for the same study.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "claims/robustness.hpp"
#include "reports/sweep_output.hpp"

namespace epicyclic::claims {

struct RobustnessOutput {
  ClaimsOptions options;
  std::string name;  ///< of the study
  std::vector<ClaimRobustness> claims;
  std::vector<ClaimAgreement> agreement;  ///< of each claim
  std::vector<OptionRobustness> by_option;
};

/// @throws OutputError
void write_draws_csv(const std::filesystem::path& file, const RobustnessOutput& output,
                     const KnownEvaluations& evaluations);

/// @throws OutputError
void write_robustness_tables(const std::filesystem::path& folder, const RobustnessOutput& output);

[[nodiscard]] std::string robustness_summary(const RobustnessOutput& output, const KnownEvaluations& evaluations);

/// @throws OutputError
[[nodiscard]] std::vector<reports::DrawnFigure> draw_robustness_figures(const std::filesystem::path& folder,
                                                                        const RobustnessOutput& output);

}  // namespace epicyclic::claims
