// A periodic orbit from a state near it: Newton's method on the exact monodromy.
//
//   F(y) = phi_n(y) - y = 0 ,   y <- y - (M - I)^-1 F(y) ,   M = d phi_n / dy                             [A-orbit]
//
// phi_n carries a state over n periods of the forcing. M comes from tangent vectors through the integrator itself, so
// convergence is quadratic down to the integrator's tolerance. Its eigenvalues are the Floquet multipliers.
//
// Limits: single shooting; an orbit whose tangents grow beyond 1e8 over n periods needs more pieces. A neutral
// direction of the system (a free rigid rotation) makes M - I singular: the step of least norm is taken.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "integrate/flow.hpp"

namespace epicyclic::analysis {

struct OrbitOptions {
  int iterations = 12;
  double residual = 1e-11;  ///< max |F| that ends the iteration, in the units of the state
};

/// What the iteration came to.
enum class OrbitOutcome {
  converged,  ///< state and monodromy are those of the orbit
  stalled,    ///< the residual no longer falls, but is small (below the square root of what was asked for): likewise,
              ///< to that residual
  not_converged,  ///< state is the best one seen
  not_reached,    ///< an evolution failed: state is the best one seen
};

struct PeriodicOrbit {
  OrbitOutcome outcome = OrbitOutcome::not_converged;
  std::vector<double> state;
  Eigen::MatrixXd monodromy;      ///< M at `state`
  std::vector<double> residuals;  ///< max |F|, one per iteration
  std::string message;            ///< empty if converged

  [[nodiscard]] bool found() const { return outcome == OrbitOutcome::converged || outcome == OrbitOutcome::stalled; }
};

/// @param start  near the orbit
/// @param n      its period in periods of the forcing
[[nodiscard]] PeriodicOrbit find_periodic_orbit(integrate::Flow& flow, std::span<const double> start, int n,
                                                const OrbitOptions& options = {});

/// Largest modulus of the orbit's Floquet multipliers, the eigenvalues of its monodromy.
[[nodiscard]] double largest_multiplier(const PeriodicOrbit& orbit);

/// The orbit of a slightly different map phi' near one that is known: y' = y + (I - M)^-1 (phi'_n(y') - y'), iterated
/// with the M of the known one. For the orbit that a coarser integrator sees.
///
/// @param iterations  2 are enough for differences of 1e-3
/// @returns the state, or an empty vector when an evolution failed
[[nodiscard]] std::vector<double> displaced_orbit(integrate::Flow& flow, const PeriodicOrbit& known, int n,
                                                  int iterations);

}  // namespace epicyclic::analysis
