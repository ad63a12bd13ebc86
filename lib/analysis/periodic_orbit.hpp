// A periodic orbit from a state near it: Newton's method on the exact monodromy.
//
//   F(y) = phi_n(y) - y = 0 ,   y <- y - (M - I)^-1 F(y) ,   M = d phi_n / dy                             [A-orbit]
//
// phi_n integrates a state over n periods of the forcing. M comes from tangent vectors through the integrator itself,
// so convergence is quadratic down to the integrator's tolerance. Its eigenvalues are the Floquet multipliers.
//
// With p shooting intervals (multiple shooting [A-shoot], analysis/shooting.hpp) the states where they begin are sought
// together,
//
//   M_i d_i - d_i+1 = -F_i ,   M = M_p-1 ... M_0
//
// How far the state may be from the orbit follows from the residual rho, to first order,
//
//   e = | (M - I)^-1 | rho                                                                          [A-orbit-error]
//
// in the largest component. Near a fold, or for 2 n near a period doubling (flip), M - I is nearly singular, and a
// small residual alone proves little.
//
// Limits: tangents may not grow beyond 1e8 over a shooting interval. A neutral direction of the system (a free rigid
// rotation) makes M - I singular: the step of least norm is taken, and e leaves it out, since along it neighbours of an
// orbit are orbits, too. Source: R. Seydel, Practical Bifurcation and Stability Analysis, 3rd ed., ch. 7.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/matrix_product.hpp"
#include "integrate/flow.hpp"

namespace epicyclic::analysis {

struct OrbitOptions {
  int iterations = 12;
  double residual = 1e-11;  ///< max |F| that ends the iteration, in the units of the state
  double known = 1e-4;      ///< e [A-orbit-error] up to which a state is that of an orbit though the residual no longer
                            ///< falls, in parts of its largest component [-]
  int shooting_intervals = 1;

  /// M is kept for as long as the residual falls to a tenth: near an orbit that saves most of the tangents, which cost
  /// far more than states. The monodromy is then that of a state as far from the orbit as the last full step was long.
  /// With one shooting interval only.
  bool keep_tangents = false;

  /// @throws InputError for less than one iteration or shooting interval, or a negative residual or error
  void validate() const;
};

/// What the iteration came to.
enum class OrbitOutcome {
  converged,  ///< state and monodromy are those of the orbit
  stalled,    ///< the residual no longer falls, which an integrator's own noise ends, but the error is small: state and
              ///< monodromy are those of the orbit to that error
  not_converged,  ///< state is the best one seen
  not_reached,    ///< an evolution failed: state is the best one seen
};

struct PeriodicOrbit {
  OrbitOutcome outcome = OrbitOutcome::not_converged;
  std::vector<double> state;
  Eigen::MatrixXd monodromy;                   ///< M at `state`
  std::vector<Eigen::MatrixXd> interval_maps;  ///< M_i of the shooting intervals, in the order of s
  std::vector<double> residuals;               ///< max |F|, one per iteration
  double error = 0;     ///< e, by the least of the residuals; or the requested error if that is more
  std::string message;  ///< empty if converged

  [[nodiscard]] bool found() const { return outcome == OrbitOutcome::converged || outcome == OrbitOutcome::stalled; }
};

/// @param start  near the orbit
/// @param n      its period in periods of the forcing
/// @throws DomainError for n < 1; InputError for options out of range
[[nodiscard]] PeriodicOrbit find_periodic_orbit(integrate::Flow& flow, std::span<const double> start, int n,
                                                const OrbitOptions& options = {});

/// The point of the orbit through `on` that is nearest to a state, among its n points, one a period.
[[nodiscard]] std::vector<double> nearest_on_orbit(integrate::Flow& flow, std::span<const double> on, int n,
                                                   std::span<const double> state);

/// e of [A-orbit-error]. Singular values of M - I below 1e-8 count as those of neutral directions: errors of tangents
/// are as large.
/// @param monodromy  M at the state
[[nodiscard]] double orbit_error(const Eigen::MatrixXd& monodromy, double residual);

/// Largest modulus of the orbit's Floquet multipliers, the eigenvalues of its monodromy.
[[nodiscard]] double largest_multiplier(const PeriodicOrbit& orbit);

/// Floquet multipliers, by falling modulus, with what is known of their errors.
struct FloquetMultipliers {
  std::vector<std::complex<double>> values;
  std::vector<double> errors;     ///< distance from the nearest one of a second estimate, or what rounding leaves if
                                  ///< that is more [A-schur]; one each
  std::vector<int> multiplicity;  ///< of each: the number of multipliers within its error, itself included
  std::size_t critical = 0;       ///< the one nearest to the unit circle

  /// Is its error less than its distance from the unit circle?
  [[nodiscard]] bool side_is_known(std::size_t i) const { return errors[i] < std::abs(1.0 - std::abs(values[i])); }
  /// Of the critical one from the unit circle; positive inside.
  [[nodiscard]] double margin() const { return 1.0 - std::abs(values[critical]); }
  /// All inside the unit circle by more than their errors.
  [[nodiscard]] bool stable() const;
};

/// @param orbit, second  the same orbit twice, from two tolerances or two subdivisions
[[nodiscard]] FloquetMultipliers floquet_multipliers(const PeriodicOrbit& orbit, const PeriodicOrbit& second);

/// The orbit of a slightly different map phi' near one that is known: y' = y + (I - M)^-1 (phi'_n(y') - y'), iterated
/// with the M of the known one. For the orbit that a coarser integrator sees.
///
/// @param iterations  2 are enough for differences of 1e-3
/// @returns the state, or an empty vector when an evolution failed
[[nodiscard]] std::vector<double> displaced_orbit(integrate::Flow& flow, const PeriodicOrbit& known, int n,
                                                  int iterations);

}  // namespace epicyclic::analysis
