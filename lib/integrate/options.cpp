#include "integrate/options.hpp"

#include "core/errors.hpp"
#include "core/require.hpp"
#include "integrate/methods.hpp"

namespace epicyclic::integrate {

void IntegratorOptions::validate() const {
  const Method& m = method_named(method);
  // The squares of errors over a tolerance have to be numbers.
  require(relative_tolerance >= 1e-100 && relative_tolerance <= 1.0, "relative_tolerance", relative_tolerance,
          ">= 1e-100 and <= 1");
  require(absolute_tolerance >= 1e-100 && absolute_tolerance <= 1e100, "absolute_tolerance", absolute_tolerance,
          ">= 1e-100 and <= 1e100");
  require(max_steps_per_period >= 1, "max_steps_per_period", static_cast<double>(max_steps_per_period), ">= 1");
  require(max_step_periods >= 0.0, "max_step_periods", max_step_periods, ">= 0");
  require(escape_bound > 0.0, "escape_bound", escape_bound, "> 0");
  require(max_order >= 0, "max_order", max_order, ">= 0");
  if (locate_contacts && !m.locates_contacts())
    throw InputError("locate_contacts = true, must be false with method = '" + method +
                     "': explicit Runge-Kutta methods of ARKODE alone locate contact changes");
}

}  // namespace epicyclic::integrate
