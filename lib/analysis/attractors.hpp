// Which attractor a motion ended on: records of motions that are told apart, and counted.
//
// All records are of one system, strobed at the same phase of its forcing. What is compared does not depend on where
// along its orbit a motion was when the record began.
//
// - Periodic: the n points y_0 ... y_n-1 of the orbit in the section. Two are one attractor if they have one n and
//
//     min_r max_k max_j | y'_{k+r,j} - y_k,j | <= 10 (e + e')                                             [A-same]
//
//   with e how far the points may be from the orbit: of one found by Newton's method e = | (M - I)^-1 | rho, rho the
//   residual, or what the integrator leaves of one if that is more; of one told by recurrence alone, what is left to
//   settle, e = l / (1 - (l / r)^(2n/K)), r and l the recurrence errors over the K points and over their second half.
// - Quasiperiodic and chaotic: mean and standard deviation of each component over the section, and the largest
//   exponent. Two of one regime are one attractor unless one of these differs by more than Student's t at `level`
//   (divided by their number) times the errors of both, and by more than `least` of the standard deviation, of the
//   exponent, or `tolerance`. A record is compared with the mean of the records that are on an attractor already.
//   The errors are those of [A-mean], from the section's K/16 slowest waves, 4 to 32.
// - Undecided motions are on none.
//
// Limits: a difference that the records do not prove is none, so that attractors as alike as two short records of one
// are left together; longer records part them. A torus whose slowest wave is longer than the record may be counted more
// than once. Regimes are taken as told: a motion of a torus that is taken for chaos is on an attractor of its own.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "analysis/periodic_orbit.hpp"
#include "analysis/poincare.hpp"
#include "analysis/regime.hpp"
#include "analysis/statistics.hpp"
#include "integrate/flow.hpp"

namespace epicyclic::analysis {

/// What is kept of a motion to tell its attractor.
struct AttractorRecord {
  Regime regime = Regime::undecided;
  std::size_t dimension = 0;
  std::vector<double> orbit;                ///< if periodic: n rows of the state
  double orbit_error = 0;                   ///< e of [A-same]
  int frequencies = 0;                      ///< of the estimates below; 0 if there are none
  std::vector<Estimate> means, deviations;  ///< else: one per component
  Estimate exponent;                        ///< largest, if not periodic; not a number where there is none

  /// n, if periodic.
  [[nodiscard]] std::size_t period() const { return dimension == 0 ? 0 : orbit.size() / dimension; }
};

/// Of an orbit of period n.
/// @param flow       carries its state on to the other points
/// @param map_error  what the flow leaves of an orbit, in parts of its largest component [-]
/// @returns a record of an undecided motion if it could not be carried
[[nodiscard]] AttractorRecord record_of_orbit(integrate::Flow& flow, const PeriodicOrbit& orbit, int n,
                                              double map_error);

/// Of a section whose regime was told.
/// @param recurrence  of the section; read if periodic
/// @param exponent    largest; read if not periodic
/// @param map_error   what the flow leaves of an orbit, in parts of its largest component [-]; read if periodic
[[nodiscard]] AttractorRecord record_of_section(const PoincareSection& section, Regime regime,
                                                const Recurrence& recurrence, const Estimate& exponent,
                                                double map_error);

struct AttractorOptions {
  double level = 1e-6;      ///< chance that two records of one attractor are told apart [-]
  double least = 0.1;       ///< of a standard deviation or an exponent: a smaller difference is none [-]
  double tolerance = 1e-3;  ///< a smaller difference of means or deviations is none, in the units of the state

  /// @throws InputError for a level outside (0, 1), or a difference or tolerance out of range
  void validate() const;
};

struct Attractor {
  AttractorRecord record;            ///< if periodic: that of the smallest error; else the mean of all
  std::vector<std::size_t> members;  ///< indices of records, ascending
  std::size_t image_of = 0;          ///< number of the attractor that it is an image of; 0 if of none before it
  std::size_t image_by = 0;          ///< index of the symmetry, with image_of
};

struct Attractors {
  std::vector<Attractor> all;       ///< in the order of their first members; attractor k has the number k + 1
  std::vector<std::size_t> number;  ///< of each record's attractor, from 1; 0: on none
};

/// A symmetry of the system: maps solutions to solutions, strobed at the same phase.
using Symmetry = std::function<std::vector<double>(std::span<const double> state)>;

/// @param symmetries  images are told of periodic attractors only
/// @throws InputError for options out of range
[[nodiscard]] Attractors label_attractors(std::span<const AttractorRecord> records,
                                          const AttractorOptions& options = {},
                                          std::span<const Symmetry> symmetries = {});

}  // namespace epicyclic::analysis
