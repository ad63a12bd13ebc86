// Robustness of claims against unstated parameters. Completions are drawn from the ranges, and each is judged by a
// screening. The result per claim is the part of the draws for which it holds, and the parameters that decide it.
//
// Draw d has u_k = uniform number d n + k + 1 of the seed's sequence [C-rand], n the dimension. So a draw does not need
// those before it, and a longer series begins with the same draws.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "analysis/statistics.hpp"
#include "claims/calibration.hpp"
#include "store/part.hpp"

namespace epicyclic::claims {

/// A draw's place in the unit cube.
[[nodiscard]] std::vector<double> draw(const ParameterSpace& space, int seed, std::size_t index);

/// All draws, with kept ones as they are, key {0, draw}. Then the first valid draws by whole sweeps, as many as are to
/// be confirmed, key {1, draw}.
/// @param part  only its share of both; of the draws to be confirmed, only those that the kept draws determine
/// @returns by key; fewer than requested only if stopped, see survey_is_complete()
/// @throws InputError if kept evaluations are not of these draws
[[nodiscard]] KnownEvaluations survey(const ClaimsOptions& options, const Evaluator& evaluate, CalibrationRun run,
                                      const store::Part& part = {});

/// Evaluations that belong to a part, and those of them that are known.
struct SurveyShare {
  std::size_t draws = 0, draws_known = 0;
  std::size_t confirmed = 0, confirmed_known = 0;  ///< by whole sweeps, of those that the known draws determine
  std::size_t confirmed_most = 0;                  ///< if all draws are known

  [[nodiscard]] std::size_t known() const { return draws_known + confirmed_known; }
  [[nodiscard]] bool complete() const { return draws_known == draws && confirmed_known == confirmed; }
};

/// @param part  the whole survey if it has no parts
[[nodiscard]] SurveyShare share_of(const ClaimsOptions& options, const KnownEvaluations& evaluations,
                                   const store::Part& part);

[[nodiscard]] bool survey_is_complete(const ClaimsOptions& options, const KnownEvaluations& evaluations);

/// Of the draws alone, without those by whole sweeps.
[[nodiscard]] std::vector<const EvaluatedCandidate*> surveyed_draws(const KnownEvaluations& evaluations);

/// Agreement of screening and whole sweeps on a claim, over the confirmed draws.
struct ClaimAgreement {
  std::size_t both = 0;         ///< draws for which it holds in both evaluations
  std::size_t neither = 0;      ///< draws for which it fails in both
  std::size_t glance_only = 0;  ///< and for which it holds by the screening alone
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

/// All parameters, then the choices. A choice of two options is one factor: the second is taken. A choice of more has
/// one factor per option, since options have no order.
[[nodiscard]] std::vector<Factor> factors(const ParameterSpace& space);

/// Choice by choice, option by option.
[[nodiscard]] std::vector<OptionRobustness> robustness_by_option(const ClaimsOptions& options,
                                                                 const KnownEvaluations& evaluations);

/// @param evaluations  of survey()
[[nodiscard]] std::vector<ClaimRobustness> robustness(const ClaimsOptions& options,
                                                      const KnownEvaluations& evaluations);

}  // namespace epicyclic::claims
