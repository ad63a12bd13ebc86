// How long the response at a point is recorded, and what is kept of it.
#pragma once

namespace epicyclic::studies {

enum class Transient {
  fixed,     ///< transient_periods
  adaptive,  ///< until the regime is told; a periodic motion is then put onto its orbit
};

/// What is kept of a point besides its row of points.csv.
enum class Keep {
  section,    ///< its Poincare points
  row,        ///< nothing
  attractor,  ///< what its attractor is told from
};

struct RecordingOptions {
  Transient transient = Transient::fixed;
  int transient_periods = 300;  ///< mesh periods before the record, if fixed
  int recorded_periods = 128;   ///< mesh periods recorded, one Poincare point each
  int output_phases = 64;       ///< dense output points per recorded period, for extrema and contact
  int period_max = 32;          ///< longest period of the motion looked for [mesh periods]

  /// Two states recur if no component differs by more [b_c, b_c per tau]. A finer one takes the last traces of the
  /// softest support mode, which at high speed decays by half a percent a mesh period, for a change of the motion.
  double recurrence_tolerance = 1e-3;

  /// Mesh periods that the regime may be looked for beyond the record; 0: it is told from recurrence alone. Chaos has
  /// to last for a quarter of them, for all where an orbit attracts near by or the 0-1 test says regular.
  int classification_periods = 3584;

  /// Where the regime is told from recurrence alone and there is none: mesh periods in which one tangent vector tells
  /// growth, that is chaos, from none; 0: nothing is told. By the kind of study, not by the input.
  int growth_periods = 0;

  Keep keep = Keep::section;  ///< by the kind of study, not by the input

  /// @throws InputError for counts below what there has to be, or a tolerance that is not positive
  void validate() const;
};

}  // namespace epicyclic::studies
