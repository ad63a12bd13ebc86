#include "claims/variable_words.hpp"

#include "core/text.hpp"

namespace epicyclic::claims {

std::string variable_name(const ParameterSpace& space, std::size_t variable) {
  if (variable < space.parameters.size()) return space.parameters[variable].name;
  return space.choices[variable - space.parameters.size()].name;
}

std::string variable_text(const ParameterSpace& space, std::size_t variable, double u, int digits) {
  if (variable < space.parameters.size()) return short_text(space.parameters[variable].at(u), digits);
  const Choice& choice = space.choices[variable - space.parameters.size()];
  return choice.options[choice.at(u)].name;
}

std::string factor_name(const ParameterSpace& space, const Factor& factor) {
  const std::string name = variable_name(space, factor.variable);
  if (!factor.option) return name;
  return name + ": " + space.choices[factor.variable - space.parameters.size()].options[*factor.option].name;
}

std::string words_without_unit(const ParameterSpace& space, const Factor& factor) {
  const bool has_words = !factor.option && !space.parameters[factor.variable].description.empty();
  const std::string words = has_words ? space.parameters[factor.variable].description : factor_name(space, factor);
  return words.substr(0, words.find(" ["));
}

std::string row_text(const std::string& words, std::size_t longest) {
  if (words.size() <= longest) return figures::verbatim_text(words);
  std::size_t cut = words.rfind(' ', longest);
  if (cut == std::string::npos) cut = longest;
  const auto continues = [&](std::size_t k) { return (static_cast<unsigned char>(words[k]) & 0xC0U) == 0x80U; };
  while (cut > 0 && continues(cut)) --cut;  // between two characters of UTF-8
  return figures::verbatim_text(words.substr(0, cut) + " ...");
}

figures::FigureCanvas canvas_of_rows(std::size_t rows) {
  constexpr int around = 260;
  return {1800, around + row_height * static_cast<int>(rows)};
}

std::vector<std::string> candidate_columns(const ClaimsOptions& options) {
  std::vector<std::string> columns;
  for (std::size_t k = 0; k < options.space.dimension(); ++k) columns.push_back(variable_name(options.space, k));
  for (const Claim& claim : options.claims) columns.push_back("cost_" + claim.name);
  return columns;
}

void add_candidate_cells(CsvWriter& csv, const ClaimsOptions& options, const std::vector<double>& u,
                         const std::vector<double>& claim_costs) {
  for (std::size_t k = 0; k < u.size(); ++k) {
    if (k < options.space.parameters.size())
      csv.cell(options.space.parameters[k].at(u[k]));
    else
      csv.cell(variable_text(options.space, k, u[k], 0));
  }
  for (const double cost : claim_costs) csv.cell(cost);
}

}  // namespace epicyclic::claims
