// Names of the integration methods.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace epicyclic::integrate {

enum class Family {
  erk,    ///< explicit Runge-Kutta with an embedded solution (ARKODE, ERKStep)
  dirk,   ///< diagonally implicit Runge-Kutta with an embedded solution (ARKODE, ARKStep), Newton's method
  adams,  ///< Adams-Moulton of variable order (CVODE), functional iteration
  bdf,    ///< backward differentiation of variable order (CVODE), Newton's method
  lanes,  ///< explicit Runge-Kutta by the lane ensemble
};

struct Method {
  std::string_view name;  ///< as in the input: "arkode-...", "cvode-..." or "lanes-..."
  Family family;
  std::string_view table;  ///< ARKODE's name of the Butcher table; empty elsewhere
  int order;               ///< of the solution that is continued; the highest one for CVODE
  int embedded_order;      ///< of the solution that measures the error; 0 for CVODE
  int stages;              ///< 0 for CVODE

  /// The embedded solution differs from the other by a few stages at the ends of the step (or by stages in few places):
  /// where the right-hand side has a kink inside a step, the measured error is far below the true one. Such a pair is
  /// honest on smooth problems only (measured on the clearance oscillator: 1e3 to 1e5 times its tolerance).
  bool misses_kinks = false;

  [[nodiscard]] bool multistep() const { return family == Family::adams || family == Family::bdf; }
  /// True if it can end a step where a contact opens or closes.
  [[nodiscard]] bool locates_contacts() const { return family == Family::erk; }
  [[nodiscard]] bool implicit() const { return family == Family::dirk || family == Family::bdf; }
};

/// All methods: by family, within it by order.
[[nodiscard]] const std::vector<Method>& methods();

/// @returns the method of that name, or nullptr
[[nodiscard]] const Method* find_method(std::string_view name);

/// @throws InputError, naming all methods, if there is none of that name
[[nodiscard]] const Method& method_named(std::string_view name);

/// The name of ARKODE's method with the pair of a method of lanes; the name of any other method as it is.
[[nodiscard]] std::string arkode_twin(std::string_view method);

/// Names of all methods, for messages and the schema.
[[nodiscard]] std::vector<std::string> method_names();

}  // namespace epicyclic::integrate
