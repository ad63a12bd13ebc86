// Periodic orbits that exist side by side at one value of the parameter, from many starts: unstable ones too.
//
// From each start the orbits of each requested period n are sought by Newton's method in the states z = (y_0 ... y_p-1)
// of the shooting equations [A-shoot], its steps damped by the natural test of monotony,
//
//   d = -F_z(z)^-1 F(z) ,   z <- z + l d ,   |F_z(z)^-1 F(z + l d)| <= (1 - l/4) |d| ,   l = 1, 1/2, ...     [A-damped]
//
// which does not depend on the scales of F. Damped steps stop near places where F_z is singular: there the method takes
// one or two steps without damping. correct_at() computes the orbit from the last state. Then every start is tried
// again with the known orbits a_k, also those of the divisors of n, and all their images removed,
//
//   G(z) = m(y_0) F(z) ,   m(y) = prod_k (1 + 1 / |y - a_k|^2) ,   step = d / (1 - grad(log m) . d)         [A-deflate]
//
// G does not vanish at a_k, so that a start which leads to what is known may lead to another orbit yet. The step is
// Newton's for G: the matrix is that of F with one of rank one beside it. This is repeated until nothing new is found.
// Starts of a third kind are the closest returns of a trajectory from a start after n periods. If the trajectory
// converges, they lie near its attractor. If it is chaotic, they lie near unstable orbits.
//
// Orbits are compared like periodic attractors [A-same]. An orbit found at n that closes after a divisor of n is
// counted at its least period. Begun at another of its periods, or rotated by the family's symmetry, it is the same
// orbit.
//
// The orbits and their order depend on the set of the starts alone, not on the order of the starts or on threads. Each
// round of deflation removes what the rounds before have found. The least of its states found, in lexicographic order,
// represents an orbit.
//
// Limits: no number of starts proves that there are no others. Newton's steps are condensed to y_0: over n periods
// tangents may not grow beyond 1e8. Near a fold or a period doubling (flip), orbits nearer to each other than their
// errors count as one.
//
// Smoothness: as of shooting; across kinks of a continuous vector field Newton's method converges all the same.
//
// Sources: P. Deuflhard, Newton Methods for Nonlinear Problems (2004), ch. 3; P. E. Farrell, A. Birkisson, S. W. Funke,
// Deflation techniques for finding distinct solutions of nonlinear partial differential equations, SIAM J. Sci. Comput.
// 37 (2015) A2026; D. Auerbach et al., Phys. Rev. Lett. 58 (1987)
// 2387.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "analysis/orbit_family.hpp"

namespace epicyclic::analysis {

struct SearchOptions {
  int smallest_period = 1;  ///< of the n that are sought, in periods of the forcing
  int largest_period = 1;
  int return_periods = 0;       ///< periods over which a start is integrated to find close returns; 0: no such starts
  int returns = 1;              ///< how many of the states that come back nearest are tried
  int rounds = 2;               ///< of deflation at most; 0: none
  int iterations = 30;          ///< of the damped method
  double least_damping = 0.05;  ///< l
  int jumps = 3;                ///< steps without damping in one run, if no damped step reduces the residual
  double max_step = 0.5;        ///< of the damped method [A-length]
  double map_error = 1e-9;      ///< what the flows leave of an orbit, in parts of its largest component [-]
  int threads = 1;              ///< more than one: the family's flows are made and used by as many at once

  /// @throws InputError for periods, counts, steps or errors out of range
  void validate() const;
};

/// Why a run from a start ended without an orbit.
enum class SearchFailure {
  not_integrated,  ///< an evolution failed
  no_descent,      ///< no damped step falls: a place where |F| is least, or a singular one
  iterations,      ///< as many as allowed
  not_corrected,   ///< Newton's method without damping did not confirm it
};

/// "not_carried", "no_descent", "iterations", "not_corrected".
[[nodiscard]] std::string to_string(SearchFailure failure);

/// One orbit, and the images that it stands for.
struct FoundOrbit {
  OrbitFamily family;  ///< of its least period and, if it has it, its symmetry: a branch may be followed from `orbit`
  BranchOrbit orbit;
  int images = 1;                   ///< different orbits that the symmetry makes of it, itself included
  int unstable = 0;                 ///< multipliers beyond the unit circle
  double multiplier_max = 0;        ///< greatest modulus
  std::vector<std::size_t> starts;  ///< indices of those that led to it or to an image, ascending

  [[nodiscard]] bool stable() const { return multiplier_max < 1.0; }
  /// The symmetry leaves each of its states as it is.
  [[nodiscard]] bool keeps_symmetry() const { return family.kept().map.size() != 0; }
};

/// A start that led to no orbit of a period or its divisors.
struct MissedStart {
  std::size_t start = 0;
  int period = 1;
  SearchFailure why = SearchFailure::no_descent;  ///< of its run without deflation
  std::string message{};
};

struct OrbitSearch {
  std::vector<FoundOrbit> orbits;   ///< by period, then by their states in lexicographic order
  std::vector<MissedStart> missed;  ///< by period, then by start
  long evaluations = 0;             ///< of the shooting equations with their derivatives by the damped method
};

/// @param family  flows, scales, symmetry and accuracy; `pieces` for each period of the forcing, `period` is not read.
///                With keeps_symmetry orbits that keep it are sought alone
/// @throws InputError for options out of range or a start of another dimension
[[nodiscard]] OrbitSearch search_orbits(const OrbitFamily& family, double value,
                                        std::span<const std::vector<double>> starts, const SearchOptions& options = {});

/// The centre, and random states of a uniform distribution in the box about it: the same ones on every platform, and of
/// more the first ones [core/random_numbers.hpp].
/// @param half_widths  of the box, one a component
/// @throws InputError for half widths that are negative, or of another number
[[nodiscard]] std::vector<std::vector<double>> starts_in_box(std::span<const double> centre,
                                                             std::span<const double> half_widths, std::size_t count,
                                                             std::uint64_t seed = 1);

}  // namespace epicyclic::analysis
