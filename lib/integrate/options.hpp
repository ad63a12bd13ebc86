// Options of the integrators: method by name, tolerances, caps.
//
// A step of length h from y is accepted when  sqrt( mean_i [ e_i / (rtol |y_i| + atol) ]^2 ) <= 1,  e the difference of
// the embedded pair (the weighted root mean square of SUNDIALS).
#pragma once

#include <string>

namespace epicyclic::integrate {

struct IntegratorOptions {
  std::string method = "arkode-dopri5";  ///< one of arkode_method_names()
  double relative_tolerance = 1e-8;      ///< rtol [-]
  double absolute_tolerance = 1e-10;     ///< atol, in the units of the state [b_c, b_c per tau]
  long max_steps_per_period = 20000;     ///< attempted steps in one mesh period; more is the outcome step_limit
  double escape_bound = 1e6;             ///< |y_i| beyond this is the outcome diverged [b_c, b_c per tau]
};

}  // namespace epicyclic::integrate
