#include "reports/variable_words.hpp"

#include "core/text.hpp"

namespace epicyclic::reports {

std::string variable_name(const studies::ParameterSpace& space, std::size_t variable) {
  if (variable < space.parameters.size()) return space.parameters[variable].name;
  return space.choices[variable - space.parameters.size()].name;
}

std::string variable_text(const studies::ParameterSpace& space, std::size_t variable, double u, int digits) {
  if (variable < space.parameters.size()) return short_text(space.parameters[variable].at(u), digits);
  const studies::Choice& choice = space.choices[variable - space.parameters.size()];
  return choice.options[choice.at(u)].name;
}

std::vector<std::string> candidate_columns(const studies::ClaimsOptions& options) {
  std::vector<std::string> columns;
  for (std::size_t k = 0; k < options.space.dimension(); ++k) columns.push_back(variable_name(options.space, k));
  for (const studies::Claim& claim : options.claims) columns.push_back("cost_" + claim.name);
  return columns;
}

void add_candidate_cells(CsvWriter& csv, const studies::ClaimsOptions& options, const std::vector<double>& u,
                         const std::vector<double>& claim_costs) {
  for (std::size_t k = 0; k < u.size(); ++k) {
    if (k < options.space.parameters.size())
      csv.cell(options.space.parameters[k].at(u[k]));
    else
      csv.cell(variable_text(options.space, k, u[k], 0));
  }
  for (const double cost : claim_costs) csv.cell(cost);
}

}  // namespace epicyclic::reports
