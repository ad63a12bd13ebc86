// Candidates for what is not published, as cells and words.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/csv.hpp"
#include "studies/claims_options.hpp"

namespace epicyclic::reports {

/// A variable of the unit cube: a parameter, or a choice.
[[nodiscard]] std::string variable_name(const studies::ParameterSpace& space, std::size_t variable);

/// What it is at a place of the cube: a number, or an option.
[[nodiscard]] std::string variable_text(const studies::ParameterSpace& space, std::size_t variable, double u,
                                        int digits);

/// Names of the columns of add_candidate_cells().
[[nodiscard]] std::vector<std::string> candidate_columns(const studies::ClaimsOptions& options);

/// Values of all variables, then the cost of each claim.
void add_candidate_cells(CsvWriter& csv, const studies::ClaimsOptions& options, const std::vector<double>& u,
                         const std::vector<double>& claim_costs);

}  // namespace epicyclic::reports
