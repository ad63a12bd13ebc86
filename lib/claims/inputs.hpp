// Studies of claims, and the inputs and models that follow from them: candidates, and each sweep as a study of its own.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "claims/candidates.hpp"
#include "claims/judging.hpp"
#include "claims/options.hpp"
#include "input/study_input.hpp"

namespace epicyclic::claims {

/// The candidate that corresponds to the input.
struct GivenCandidate {
  std::vector<double> u;
  /// Parameters outside their ranges, which are moved to the nearest end, and choices without an option that the input
  /// has.
  std::vector<std::string> moved;
};

/// The candidate of the input. Each parameter comes from the numbers that it sets or multiplies. It is the middle of
/// its range if the input has none. Each choice takes the option that the input has, or the first.
[[nodiscard]] GivenCandidate given_candidate(const input::LoadedInput& input, const ParameterSpace& space);

/// The number that a sweep sets: its value, or with `same_as` the number of the input, with `values` in place.
/// @returns nothing if the resolved input has no such number
[[nodiscard]] std::optional<double> number_to_set(const input::LoadedInput& input,
                                                  std::span<const input::PointerValue> values, const SetValue& set);

/// The natural frequencies of a stage of the claims.
/// @throws InputProblems if it is no valid stage, InputError if a value that it is to have is no number
[[nodiscard]] std::vector<ClaimMode> modes_of(const input::LoadedInput& input, const ClaimStage& stage);

/// A sweep of the claims as a study of its own: the resolved input with the sweep's values in place.
[[nodiscard]] nlohmann::json sweep_input(const input::LoadedInput& input, const ClaimSweep& sweep,
                                         studies::Start start);

/// The models of candidates for the open parameters of a study of claims. An input is made once for each requested set
/// of options, from the files as they were read for the given one. Each candidate has scales of its own, as a stage of
/// its own would have. It runs at the speed that the input gives, be it Omega, rpm or Hz.
/// @param given  a study of claims
[[nodiscard]] CandidateModels candidate_models(const input::LoadedInput& given);

/// The input of a candidate as candidate_models() uses it, resolved. Each of the candidate's values has that origin.
/// @throws InputProblems if the numbers contradict each other
[[nodiscard]] nlohmann::json candidate_input(const input::LoadedInput& given, const ParameterSpace& space,
                                             std::span<const double> u, const std::string& origin);

/// The models of the given stage, for the claims' sweeps. `input` must outlive the result.
[[nodiscard]] SweepModels claim_models(const input::LoadedInput& input);
SweepModels claim_models(input::LoadedInput&& input) = delete;

}  // namespace epicyclic::claims
