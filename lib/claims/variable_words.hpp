// Unstated parameters of candidates, as cells and words, and figures with a row for each.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "claims/options.hpp"
#include "claims/robustness.hpp"
#include "core/csv.hpp"
#include "figures/gnuplot.hpp"

namespace epicyclic::claims {

/// A variable of the unit cube: a parameter, or a choice.
[[nodiscard]] std::string variable_name(const ParameterSpace& space, std::size_t variable);

/// Its value at a place of the cube: a number, or an option.
[[nodiscard]] std::string variable_text(const ParameterSpace& space, std::size_t variable, double u, int digits);

/// Its description in words, without its unit.
[[nodiscard]] std::string words_without_unit(const ParameterSpace& space, const Factor& factor);

/// A factor that may decide a claim: a parameter, or whether a choice takes an option.
[[nodiscard]] std::string factor_name(const ParameterSpace& space, const Factor& factor);

/// A text beside a row of a figure. A longer text is cut after so many bytes, at a blank if there is one.
[[nodiscard]] std::string row_text(const std::string& words, std::size_t longest);

inline constexpr int row_height = 42;  ///< [pixels]

/// A canvas as high as its rows need.
[[nodiscard]] figures::FigureCanvas canvas_of_rows(std::size_t rows);

/// Names of the columns of add_candidate_cells().
[[nodiscard]] std::vector<std::string> candidate_columns(const ClaimsOptions& options);

/// Values of all variables, then the cost of each claim.
void add_candidate_cells(CsvWriter& csv, const ClaimsOptions& options, const std::vector<double>& u,
                         const std::vector<double>& claim_costs);

}  // namespace epicyclic::claims
