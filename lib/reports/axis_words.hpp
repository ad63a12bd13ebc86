// Names and values of a study's parameter in texts: as the study gives them.
#pragma once

#include <optional>
#include <string>

#include "core/text.hpp"
#include "studies/speed_unit.hpp"
#include "studies/sweep_options.hpp"

namespace epicyclic::reports {

/// A parameter in words. Tables of numbers have the parameter itself.
struct AxisWords {
  std::string name;
  double factor = 1;  ///< of the parameter's values

  [[nodiscard]] std::string text(double value, int digits) const { return short_text(factor * value, digits); }
  [[nodiscard]] std::string with_error(double value, double error) const {
    return epicyclic::with_error(factor * value, factor * error);
  }
};

/// @param speed  what the study gives speeds along its axis in; none: Omega
[[nodiscard]] inline AxisWords axis_words(const std::string& parameter,
                                          const std::optional<studies::SpeedUnit>& speed) {
  if (!speed || parameter != studies::speed_parameter) return {parameter};
  return {speed->key, speed->per_ratio};
}

}  // namespace epicyclic::reports
