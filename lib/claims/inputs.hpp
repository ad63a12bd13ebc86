// Studies of claims, and the inputs and models that follow from them: candidates, and the sweeps as studies of their
// own.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "claims/candidates.hpp"
#include "claims/options.hpp"
#include "input/study_input.hpp"

namespace epicyclic::claims {

/// The candidate that an input is.
struct GivenCandidate {
  std::vector<double> u;
  /// Parameters that lie outside their ranges and are moved to their edges, choices of which the input has no option.
  std::vector<std::string> moved;
};

/// As the input stands: each parameter by the numbers that it gives or multiplies, the middle of its range where the
/// input has none; of choices the option that the input has, or the first.
[[nodiscard]] GivenCandidate given_candidate(const input::LoadedInput& input, const ParameterSpace& space);

/// The number that a sweep sets: its value, or what the input has where it is to be like that, `values` in place.
/// @returns nothing where that is no number of the resolved input
[[nodiscard]] std::optional<double> number_to_set(const input::LoadedInput& input,
                                                  std::span<const input::PointerValue> values, const SetValue& set);

/// A sweep of the claims as a study of its own: the resolved input with what the sweep sets in place.
[[nodiscard]] nlohmann::json sweep_input(const input::LoadedInput& input, const ClaimSweep& sweep,
                                         studies::Start start);

/// The models of candidates for what a study of claims leaves open. An input is made once for each set of options that
/// is asked for, of the files as they were read for the given one. Scales are each candidate's own: it stands for the
/// stage, as a stage of its own would, and runs at the speed that the input gives, be it Omega, rpm or Hz.
/// @param given  a study of claims
[[nodiscard]] CandidateModels candidate_models(const input::LoadedInput& given);

/// The input of a candidate as candidate_models() has it, resolved, each of its values with that origin.
/// @throws InputProblems when the numbers do not go together
[[nodiscard]] nlohmann::json candidate_input(const input::LoadedInput& given, const ParameterSpace& space,
                                             std::span<const double> u, const std::string& origin);

/// The models of the stage as it is given, for the claims' sweeps. `input` must outlive the result.
[[nodiscard]] SweepModels claim_models(const input::LoadedInput& input);
SweepModels claim_models(input::LoadedInput&& input) = delete;

}  // namespace epicyclic::claims
