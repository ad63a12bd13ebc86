// What a run computes besides the points of its sweep (studies/run.hpp).
#pragma once

namespace epicyclic::studies {

/// With errors of shafts the section is taken once per common period. If that has more mesh periods than this, a run
/// states no regime, multipliers and exponents.
inline constexpr int section_periods_max = 128;

struct RunOptions {
  int exponent_periods = 500;  ///< mesh periods that Lyapunov exponents are counted over; 0: none are computed
  int dense_phases = 128;      ///< samples per mesh period of histories and spectra
  int history_periods = 64;    ///< mesh periods that are kept of histories, and that summaries are taken over
  int spectrum_periods = 256;  ///< mesh periods of the samples of spectra; a whole number of the response's own period
  int shown_periods = 8;       ///< mesh periods in history.csv and in the figures of histories
  double check_tolerance = 1e-10;  ///< relative and absolute, of the orbit's multipliers and of the exponents' checks

  /// @throws InputError for counts below what there has to be and a tolerance that is not positive
  void validate() const;
};

}  // namespace epicyclic::studies
