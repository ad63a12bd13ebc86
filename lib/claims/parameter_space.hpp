// Parameters that a publication leaves unsaid, each with a range, and choices between readings of it.
//
// A candidate is a point u of the unit cube: first its parameters, then its choices.
//   linear       x = from + u (to - from)
//   logarithmic  x = from (to / from)^u
//   choice       the option in whose part of [0, 1) u lies; parts are in the ratio of the options' odds
// What a parameter writes into the input is factor x^power, times another parameter if it says so.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace epicyclic::claims {

enum class ParameterScale { linear, logarithmic };

/// Where a parameter stands in the input.
struct ParameterTarget {
  std::string pointer;  ///< to a number of the input
  double factor = 1;
  double power = 1;
  std::string times;  ///< the name of a parameter that multiplies it, if given
};

struct FreeParameter {
  std::string name;
  std::string description;  ///< for figures and tables: what it is, with its unit
  std::string reason;       ///< of its range
  double from = 0, to = 1;
  ParameterScale scale = ParameterScale::logarithmic;
  std::vector<ParameterTarget> targets;
  std::string choice, option;  ///< it counts only where this choice takes this option, if given

  [[nodiscard]] double at(double u) const;        ///< x, at most `to`
  [[nodiscard]] double place_of(double x) const;  ///< u
};

/// What an option replaces in the input.
struct OptionSet {
  std::string pointer;
  std::string value;  ///< JSON
};

struct ChoiceOption {
  std::string name;
  double odds = 1;
  std::vector<OptionSet> sets;
};

struct Choice {
  std::string name;
  std::string reason;
  std::vector<ChoiceOption> options;

  [[nodiscard]] std::size_t at(double u) const;             ///< the option
  [[nodiscard]] double place_of(std::size_t option) const;  ///< the middle of its part
};

/// A number at its place.
struct TargetValue {
  std::string pointer;
  double value = 0;
};

struct ParameterSpace {
  std::vector<FreeParameter> parameters;
  std::vector<Choice> choices;

  [[nodiscard]] std::size_t dimension() const { return parameters.size() + choices.size(); }
  /// The option of each choice.
  [[nodiscard]] std::vector<std::size_t> options_at(std::span<const double> u) const;
  /// Does the parameter count with these options?
  [[nodiscard]] bool counts(const FreeParameter& parameter, const std::vector<std::size_t>& options) const;
  /// x of each parameter.
  [[nodiscard]] std::vector<double> values_at(std::span<const double> u) const;
  /// Numbers that a candidate writes, in the order of parameters that count.
  [[nodiscard]] std::vector<TargetValue> targets_at(std::span<const double> u) const;
};

}  // namespace epicyclic::claims
