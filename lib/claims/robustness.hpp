// How robust is what is claimed to what is not said: completions drawn from the ranges, each judged by a glance, and
// per claim the part of them for which it holds and the parameters that decide it.
//
// Draw d has u_k = uniform number d n + k + 1 of the seed's sequence [C-rand], n the dimension: any draw without those
// before it, and of more draws the first ones.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "analysis/statistics.hpp"
#include "claims/calibration.hpp"

namespace epicyclic::claims {

/// A draw's place in the unit cube.
[[nodiscard]] std::vector<double> draw(const ParameterSpace& space, int seed, std::size_t index);

/// All draws, those that were kept as they are, key {0, draw}; then the first valid ones by whole sweeps, as many as
/// are to be confirmed, key {1, draw}.
/// @returns by key; fewer than asked for only if stopped, and survey_is_complete() tells
/// @throws InputError when kept evaluations are not of these draws
[[nodiscard]] KnownEvaluations survey(const ClaimsOptions& options, const Evaluator& evaluate, CalibrationRun run);

[[nodiscard]] bool survey_is_complete(const ClaimsOptions& options, const KnownEvaluations& evaluations);

/// Of the draws alone, without those by whole sweeps.
[[nodiscard]] std::vector<const EvaluatedCandidate*> surveyed_draws(const KnownEvaluations& evaluations);

/// How far glances at the draws that were confirmed say of a claim what whole sweeps say.
struct ClaimAgreement {
  std::size_t both = 0;         ///< draws for which it holds either way
  std::size_t neither = 0;      ///< and for which it fails either way
  std::size_t glance_only = 0;  ///< and for which it holds by the glance alone
  std::size_t whole_only = 0;
};

/// Of each claim.
[[nodiscard]] std::vector<ClaimAgreement> agreement(const ClaimsOptions& options, const KnownEvaluations& evaluations);

/// Of one claim.
struct ClaimRobustness {
  std::size_t draws = 0;  ///< of valid stages
  std::size_t holds = 0;
  analysis::Interval fraction;                 ///< that it holds for, at 95 %
  std::vector<analysis::Interval> influences;  ///< of each of factors(): its rank correlation with 1 - cost
};

/// Of the draws with one option of one choice.
struct OptionRobustness {
  std::size_t choice = 0;
  std::size_t option = 0;
  std::size_t draws = 0;                     ///< of valid stages
  std::vector<std::size_t> holds;            ///< of each claim
  std::vector<analysis::Interval> fraction;  ///< of each claim, at 95 %
};

/// What may decide a claim: the value of a parameter, or whether a choice takes an option.
struct Factor {
  std::size_t variable = 0;  ///< of the space
  std::optional<std::size_t> option;
};

/// All parameters, then the choices: of two options whether it is the second, of more each by itself, since options
/// have no order.
[[nodiscard]] std::vector<Factor> factors(const ParameterSpace& space);

/// Choice by choice, option by option.
[[nodiscard]] std::vector<OptionRobustness> robustness_by_option(const ClaimsOptions& options,
                                                                 const KnownEvaluations& evaluations);

/// @param evaluations  of survey()
[[nodiscard]] std::vector<ClaimRobustness> robustness(const ClaimsOptions& options,
                                                      const KnownEvaluations& evaluations);

}  // namespace epicyclic::claims
