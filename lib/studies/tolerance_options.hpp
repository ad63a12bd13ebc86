// Options of a tolerance study (studies/tolerance.hpp).
#pragma once

#include <string>
#include <vector>

namespace epicyclic::studies {

struct ToleranceOptions {
  std::vector<std::string> methods = {"arkode-bogacki-shampine", "arkode-dopri5", "arkode-verner65",
                                      "arkode-kvaerno5",         "cvode-adams",   "cvode-bdf"};
  std::vector<double> tolerances = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};  ///< rtol
  std::vector<double> clearance_smoothings = {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};     ///< w [b_c]; falling
  double reference_tolerance = 1e-13;  ///< of the reference orbit, rtol and atol
  double target_error = 1e-6;          ///< of an orbit, that the recommendation has to meet [b_c, b_c per tau]
  int chaotic_periods = 1000;          ///< mesh periods of the statistics of a point that is not periodic

  /// @throws InputError for counts below what there has to be, numbers that are not positive, and lists without any
  void validate() const;
};

}  // namespace epicyclic::studies
