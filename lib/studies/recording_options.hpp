// How long the response at a point is recorded, and what is kept of it.
#pragma once

namespace epicyclic::studies {

enum class Transient {
  fixed,     ///< transient_periods
  adaptive,  ///< until the regime is classified; a periodic point is then put onto its orbit
};

/// What is kept of a point besides its row of points.csv.
enum class Keep {
  section,    ///< its Poincare points
  row,        ///< nothing
  attractor,  ///< the record that determines its attractor
};

struct RecordingOptions {
  Transient transient = Transient::fixed;
  int transient_periods = 300;  ///< mesh periods before the record, if fixed
  int recorded_periods = 128;   ///< mesh periods recorded, one Poincare point each
  int output_phases = 64;       ///< dense output points per recorded period, for extrema and contact
  int period_max = 32;          ///< longest period that is searched [mesh periods]

  /// Two states recur if no component differs by more [b_c, b_c per tau]. With a smaller value, the remainder of the
  /// softest support mode would count as a change. That mode decays by half a percent a mesh period at high speed.
  double recurrence_tolerance = 1e-3;

  /// Most mesh periods beyond the record for the classification of the regime; 0: by recurrence alone. Chaos has to
  /// last for a quarter of them. It has to last for all of them if an orbit attracts near by or the 0-1 test says
  /// regular.
  int classification_periods = 3584;

  /// If the regime is decided by recurrence alone and there is none: mesh periods in which one tangent vector
  /// distinguishes growth, that is chaos, from no growth. 0: the regime stays undecided. Set by the kind of study, not
  /// by the input.
  int growth_periods = 0;

  Keep keep = Keep::section;  ///< by the kind of study, not by the input
  bool quasi_static = true;   ///< forces of the quasi-static solution: by the kind of study, not by the input

  /// @throws InputError for counts below what there has to be, or a tolerance that is not positive
  void validate() const;
};

}  // namespace epicyclic::studies
