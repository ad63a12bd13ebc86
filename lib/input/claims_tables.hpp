// The tables of the parts of a study of claims (studies/claims_options.hpp): keys, units, bounds, meaning.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "input/field_table.hpp"
#include "studies/claims_options.hpp"

namespace epicyclic::input {

/// By their names in the input.
[[nodiscard]] const std::vector<std::pair<std::string, studies::Direction>>& direction_choices();

[[nodiscard]] const Table<studies::ClaimSweep>& claim_sweep_table();
[[nodiscard]] const Table<studies::Claim>& claim_table();
[[nodiscard]] const Table<studies::ClaimFigure>& claim_figure_table();
[[nodiscard]] const Table<studies::BriefLook>& brief_look_table();
[[nodiscard]] const Table<studies::FreeParameter>& free_parameter_table();
[[nodiscard]] const Table<studies::Choice>& choice_table();
[[nodiscard]] const Table<studies::SurveyOptions>& survey_options_table();
[[nodiscard]] const Table<studies::SearchOptions>& search_options_table();

}  // namespace epicyclic::input
