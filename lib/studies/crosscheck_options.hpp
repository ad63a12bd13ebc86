// Variants and bounds of a cross-check (studies/crosscheck.hpp).
#pragma once

#include <string>
#include <vector>

namespace epicyclic::studies {

struct CrosscheckOptions {
  std::vector<std::string> methods = {"arkode-dopri5", "arkode-kvaerno5", "cvode-adams",
                                      "cvode-bdf"};  ///< the first is the reference

  /// Widths of the smooth clearance that the reference method is repeated with [b_c].
  std::vector<double> clearance_smoothings{};

  double orbit_tolerance = 1e-6;  ///< eps [b_c, b_c per tau]
  int continued_periods =
      100;  ///< for which one result is continued with the other method before it is classified again

  /// @throws InputError for counts below what there has to be, numbers that are not positive, and lists without any
  void validate() const;
};

}  // namespace epicyclic::studies
