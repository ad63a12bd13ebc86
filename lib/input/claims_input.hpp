// Studies of claims and the inputs that follow from them: candidates, and the sweeps as studies of their own.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "input/study_input.hpp"
#include "studies/claims_options.hpp"

namespace epicyclic::input {

/// Values that options of choices put into the input, one option of each choice.
[[nodiscard]] std::vector<Assignment> option_assignments(const studies::ParameterSpace& space,
                                                         const std::vector<std::size_t>& options);

/// A candidate as values of the input, in place of those there.
[[nodiscard]] std::vector<Assignment> candidate_assignments(const studies::ParameterSpace& space,
                                                            std::span<const double> u);

/// The candidate that the input is as it stands: each parameter by the numbers that it gives or multiplies, the
/// middle of its range where the input has none; of choices the option that the input has, or the first.
/// @param moved  if not null, is told which parameters lie outside their ranges and are moved to their edges, and of
/// which choices the input has no option
[[nodiscard]] std::vector<double> given_candidate(const LoadedInput& input, const studies::ParameterSpace& space,
                                                  std::vector<std::string>* moved = nullptr);

/// A resolved input with an origin for each of these values.
[[nodiscard]] nlohmann::json with_origins(nlohmann::json resolved, std::span<const Assignment> values,
                                          const std::string& origin);

/// The number that a sweep sets: its value, or what the input has where it is to be like that, `values` in place.
/// @returns nothing where that is no number of the resolved input
[[nodiscard]] std::optional<double> number_to_set(const LoadedInput& input, std::span<const PointerValue> values,
                                                  const studies::SetValue& set);

/// What differs along a sweep of the claims: what its `at` sets, and Omega where that changes the stage and a speed
/// given in rpm or Hz is to stay what it is, with the candidate's `values`.
[[nodiscard]] std::vector<PointerValue> set_along(const LoadedInput& input, std::span<const PointerValue> values,
                                                  const studies::ClaimSweep& sweep);

/// A sweep of the claims as a study of its own: the resolved input with what the sweep sets in place.
[[nodiscard]] nlohmann::json sweep_input(const LoadedInput& input, const studies::ClaimSweep& sweep,
                                         studies::Start start);

}  // namespace epicyclic::input
