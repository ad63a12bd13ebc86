// Parameters that a sweep can vary by a name of their own; all others are numbers of the input, by JSON pointers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/dynamic_model.hpp"

namespace epicyclic::studies {

struct NamedParameter {
  std::string name;
  std::string description;            ///< of its values, in messages
  std::string words, symbol, unit;    ///< of axes: "Mesh damping ratio", "ζ", ""
  double least = 0, most = 0;         ///< of its values
  std::vector<std::string> pointers;  ///< numbers of the input that it stands for
  void (*set)(model::OperatingPoint&, double value) = nullptr;
  double (*get)(const model::OperatingPoint&) = nullptr;  ///< of several numbers the first
};

[[nodiscard]] const std::vector<NamedParameter>& named_parameters();

/// @returns nullptr if there is none of that name
[[nodiscard]] const NamedParameter* find_parameter(std::string_view name);

}  // namespace epicyclic::studies
