// Options of the integrators: method by name, tolerances, caps.
//
// A step of length h from y is accepted when  sqrt( mean_i [ e_i / (rtol |y_i| + atol) ]^2 ) <= 1,  e the difference of
// the embedded pair, or a multistep method's estimate of its local error (the weighted root mean square of SUNDIALS).
//
// The estimate knows g only where the method evaluates it. A feature of g that lies between two evaluations is stepped
// over at every tolerance. So a step has a greatest length [I-sample]:
//
//   h <= h_max ,   g h <= d     d the field's sampling interval, g the method's widest gap between nodes, in steps
#pragma once

#include <string>

namespace epicyclic::integrate {

struct IntegratorOptions {
  std::string method = "arkode-dopri5";  ///< one of method_names()
  double relative_tolerance = 1e-8;      ///< rtol [-], 1e-100 to 1
  double absolute_tolerance = 1e-10;     ///< atol, in the units of the state [b_c, b_c per tau], 1e-100 to 1e100
  long max_steps_per_period = 20000;     ///< attempted steps in one mesh period; more is the outcome step_limit
  double max_step_periods = 0;           ///< longest step, in periods of the field (units of s without one); 0: none
  double escape_bound = 1e6;             ///< |y_i| beyond this is the outcome diverged [b_c, b_c per tau]

  int max_order = 0;  ///< highest order of a multistep method [-]; 0: the method's own. Others have one order

  /// Crossings of the switching surfaces are located and stepped onto (explicit Runge-Kutta only). For reference: the
  /// answer then has the order of the method, at several times the cost.
  bool locate_contacts = false;

  /// Tangent vectors count in the error of a step. If not, the steps are those of the state alone, to the last bit; in
  /// lanes but for those over kinks [I-hop].
  bool tangent_error_control = false;

  /// @throws InputError for a method without that name, a tolerance or cap out of range, or located contacts with a
  /// method that cannot
  void validate() const;
};

}  // namespace epicyclic::integrate
