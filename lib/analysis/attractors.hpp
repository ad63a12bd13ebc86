// Which attractor a trajectory reached: records are compared, grouped by attractor and counted.
//
// All records are of one system, strobed at the same phase of its forcing. The comparison does not depend on the point
// of the orbit at which a record begins.
//
// - Periodic: the n points y_0 ... y_n-1 of the orbit in the section. Two are one attractor if they have one n and
//
//     min_r max_k max_j | y'_{k+r,j} - y_k,j | <= 10 (e + e')                                             [A-same]
//
//   e bounds the distance of the points from the orbit. For an orbit found by Newton's method, e = | (M - I)^-1 | rho,
//   with rho the residual, or the integrator's error if that is larger. For an orbit known by recurrence alone,
//   e = l / (1 - (l / r)^(2n/K)) is the remaining transient. r and l are the recurrence errors over the K points and
//   over their second half.
// - Quasiperiodic and chaotic: mean and standard deviation of each component over the section, and the largest
//   exponent. Two of one regime are one attractor unless one of these differs by more than Student's t at `level`
//   (divided by their number) times the errors of both, and by more than `least` of the standard deviation, of the
//   exponent, or `tolerance`. A record is compared with the mean of the records that are on an attractor already. The
//   errors are those of [A-mean], from the K/16 lowest frequencies of the section, 4 to 32.
// - Undecided records belong to no attractor.
//
// Limits: a difference counts only if the records prove it. Two attractors that differ less than two short records of
// one attractor are counted as one; longer records separate them. A torus whose longest period exceeds the record may
// be counted more than once. Regimes are taken as given: a torus that was classified as chaotic is an attractor of its
// own.
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

/// What is kept of a trajectory to identify its attractor.
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
/// @param flow       integrates from its state to the other points
/// @param map_error  what the flow leaves of an orbit, in parts of its largest component [-]
/// @returns an undecided record if the integration failed
[[nodiscard]] AttractorRecord record_of_orbit(integrate::Flow& flow, const PeriodicOrbit& orbit, int n,
                                              double map_error);

/// Of a section with a known regime.
/// @param recurrence  of the section; read if periodic
/// @param exponent    largest; read if not periodic
/// @param map_error   what the flow leaves of an orbit, in parts of its largest component [-]; read if periodic
[[nodiscard]] AttractorRecord record_of_section(const PoincareSection& section, Regime regime,
                                                const Recurrence& recurrence, const Estimate& exponent,
                                                double map_error);

struct AttractorOptions {
  double level = 1e-6;      ///< probability that two records of one attractor are counted as two [-]
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

/// @param symmetries  images are searched among periodic attractors only
/// @throws InputError for options out of range
[[nodiscard]] Attractors label_attractors(std::span<const AttractorRecord> records,
                                          const AttractorOptions& options = {},
                                          std::span<const Symmetry> symmetries = {});

}  // namespace epicyclic::analysis
