// What a periodic orbit of a sweep does between two neighbouring values of the parameter: which multiplier leaves the
// unit circle there.
//
// Newton's method finds the orbit of the first value again, and follows it to the second value, by shorter steps if it
// is lost. If a multiplier leaves the unit circle between the values or at the second one, it names the bifurcation. If
// the orbit is stable at the second value, the sweep changed to another attractor, or its other point has no regime. If
// the orbit is lost and its largest multiplier nears + 1 there as before a fold, (1 - mu)^2 falling linearly to 0, the
// change is a fold, at which a sweep jumps. An orbit that is lost without this proves nothing: a grazing of a contact
// and steps too large for Newton's method are possible.
#pragma once

#include <complex>
#include <optional>
#include <span>

#include "core/vector_field.hpp"
#include "integrate/options.hpp"

namespace epicyclic::studies {

struct OrbitAcross {
  std::complex<double> here;   ///< multiplier of largest modulus at the first value
  bool found = false;          ///< the orbit at the second value, or before it with a multiplier beyond the unit circle
  bool fold = false;           ///< not found beyond a fold
  int unstable = 0;            ///< multipliers beyond the unit circle, where the orbit was last found
  bool one_kind = false;       ///< all of them are complex, or real of one sign
  std::complex<double> there;  ///< multiplier of largest modulus where the orbit was last found
  double part = 0;             ///< of the distance from the first value (0) to the second one (1): where that is
};

/// @param field_at  the field at a part of the distance of the two values, with a period and tangents
/// @param orbit     a state on the orbit at the mesh phase 0, or near it
/// @param n         its period in mesh periods
/// @returns nothing if the orbit of the first value is not found again
/// @throws as Flow::evolve()
[[nodiscard]] std::optional<OrbitAcross> orbit_across(const FieldFamily& field_at, std::span<const double> orbit, int n,
                                                      const integrate::IntegratorOptions& integrator);

}  // namespace epicyclic::studies
