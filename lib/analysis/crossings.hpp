// What of the multipliers in an invariant block has changed between two orbits, and which one event that is.
//
// Signs of det(B - I) and det(B + I) are parities of the real multipliers beyond +1 and -1 [A-special]; with the number
// beyond the unit circle they tell one event of each kind from another, in the company of many. What goes one way
// while another comes the other way is seen by following each multiplier from one orbit to the next.
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
/// @param values  multipliers of the block, or those of them that are looked at
[[nodiscard]] Signs signs_of(const InvariantBlock& block, const Multipliers& values);

/// Which multipliers reach the unit circle.
enum class Crossing { plus, minus, pair, unresolved };

/// @returns nothing if none does; unresolved if it cannot be one alone; `plus` with or without a turn of the parameter
[[nodiscard]] std::optional<Crossing> crossing_between(const InvariantBlock& block, const Signs& a, const Signs& b);

/// Multipliers that cross the unit circle each way between two orbits, each one of `a` taken for the one of `b` that it
/// is nearest to, the nearest first.
struct Passages {
  std::size_t outwards = 0;
  std::size_t inwards = 0;
};
[[nodiscard]] Passages passages_between(const Multipliers& a, const Multipliers& b);

/// The multiplier nearest to a place.
[[nodiscard]] std::complex<double> nearest(const Multipliers& values, std::complex<double> to);

/// Of another sign on each side of the crossing, whatever else happens to the multipliers; smooth there.
/// @param inside  the lesser number beyond the unit circle of both sides
[[nodiscard]] double sign_function(const InvariantBlock& block, Crossing crossing, const Multipliers& values,
                                   std::size_t inside);

}  // namespace epicyclic::analysis
