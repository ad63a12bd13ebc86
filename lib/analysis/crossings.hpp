// The change of the multipliers of an invariant block between two orbits, and the event that it stands for.
//
// Signs of det(B - I) and det(B + I) are parities of the real multipliers beyond +1 and -1 [A-special]; with the number
// beyond the unit circle they distinguish the events of different kinds, also among many multipliers. Two multipliers
// that cross in opposite directions are seen by following each multiplier from one orbit to the next.
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/invariant_blocks.hpp"

namespace epicyclic::analysis {

using Multipliers = std::vector<std::complex<double>>;

/// What of a block changes at special points.
struct Signs {
  std::size_t outside = 0;  ///< multipliers beyond the unit circle
  bool plus = false;        ///< odd number of real ones beyond +1
  bool minus = false;       ///< odd number of real ones beyond -1
  bool falling = false;     ///< the parameter falls along the branch; of the synchronous block only
};

/// All but `falling`.
/// @param values  all multipliers of the block, or some of them
[[nodiscard]] Signs signs_of(const InvariantBlock& block, const Multipliers& values);

/// Which multipliers reach the unit circle.
enum class Crossing { plus, minus, pair, unresolved };

/// @returns nothing if none does; unresolved if it cannot be one alone; `plus` with or without an extremum of the
/// parameter
[[nodiscard]] std::optional<Crossing> crossing_between(const InvariantBlock& block, const Signs& a, const Signs& b);

/// Multipliers that cross the unit circle in each direction between two orbits. Each one of `a` is paired with the
/// nearest one of `b`, the nearest pair first.
struct Passages {
  std::size_t outwards = 0;
  std::size_t inwards = 0;
};
[[nodiscard]] Passages passages_between(const Multipliers& a, const Multipliers& b);

/// The multiplier nearest to a place.
[[nodiscard]] std::complex<double> nearest(const Multipliers& values, std::complex<double> to);

/// Has opposite signs on the two sides of the crossing, whatever else happens to the multipliers; smooth there.
[[nodiscard]] double sign_function(const InvariantBlock& block, Crossing crossing, const Multipliers& values,
                                   std::size_t inside);

}  // namespace epicyclic::analysis
