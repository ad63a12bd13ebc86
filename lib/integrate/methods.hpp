// Names of the embedded Runge-Kutta pairs that the ERK integrator offers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace epicyclic::integrate {

/// One embedded explicit pair.
struct ErkMethod {
  std::string_view name;   ///< as in the input, "arkode-..."
  std::string_view table;  ///< ARKODE's name of the Butcher table
  int order;               ///< of the solution that is carried on
  int embedded_order;      ///< of the solution that measures the error
  int stages;
};

/// All pairs, cheapest first.
[[nodiscard]] const std::vector<ErkMethod>& erk_methods();

/// @returns the pair of that name, or nullptr
[[nodiscard]] const ErkMethod* find_erk_method(std::string_view name);

/// Names of all pairs, for messages and the schema.
[[nodiscard]] std::vector<std::string> arkode_method_names();

}  // namespace epicyclic::integrate
