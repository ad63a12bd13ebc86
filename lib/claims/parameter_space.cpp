#include "claims/parameter_space.hpp"

#include <algorithm>
#include <cmath>

namespace epicyclic::claims {

double FreeParameter::at(double u) const {
  const double x = scale == ParameterScale::linear ? from + u * (to - from) : from * std::pow(to / from, u);
  return std::clamp(x, from, to);
}

double FreeParameter::place_of(double x) const {
  const double u =
      scale == ParameterScale::linear ? (x - from) / (to - from) : std::log(x / from) / std::log(to / from);
  return std::clamp(u, 0.0, 1.0);
}

std::size_t Choice::at(double u) const {
  double all = 0.0;
  for (const ChoiceOption& option : options) all += option.odds;
  double below = 0.0;
  for (std::size_t k = 0; k + 1 < options.size(); ++k) {
    below += options[k].odds / all;
    if (u < below) return k;
  }
  return options.size() - 1;
}

double Choice::place_of(std::size_t option) const {
  double all = 0.0;
  double below = 0.0;
  for (std::size_t k = 0; k < options.size(); ++k) {
    if (k < option) below += options[k].odds;
    all += options[k].odds;
  }
  return (below + 0.5 * options[option].odds) / all;
}

std::vector<std::size_t> ParameterSpace::options_at(std::span<const double> u) const {
  std::vector<std::size_t> options;
  for (std::size_t k = 0; k < choices.size(); ++k) options.push_back(choices[k].at(u[parameters.size() + k]));
  return options;
}

bool ParameterSpace::counts(const FreeParameter& parameter, const std::vector<std::size_t>& options) const {
  if (parameter.choice.empty()) return true;
  for (std::size_t k = 0; k < choices.size(); ++k)
    if (choices[k].name == parameter.choice) return choices[k].options[options[k]].name == parameter.option;
  return false;
}

std::vector<double> ParameterSpace::values_at(std::span<const double> u) const {
  std::vector<double> values;
  for (std::size_t k = 0; k < parameters.size(); ++k) values.push_back(parameters[k].at(u[k]));
  return values;
}

std::vector<TargetValue> ParameterSpace::targets_at(std::span<const double> u) const {
  const std::vector<std::size_t> options = options_at(u);
  const std::vector<double> values = values_at(u);
  std::vector<TargetValue> targets;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (!counts(parameters[k], options)) continue;
    for (const ParameterTarget& target : parameters[k].targets) {
      double value = target.factor * std::pow(values[k], target.power);
      for (std::size_t other = 0; other < parameters.size(); ++other)
        if (parameters[other].name == target.times) value *= values[other];
      targets.push_back({target.pointer, value});
    }
  }
  return targets;
}

}  // namespace epicyclic::claims
