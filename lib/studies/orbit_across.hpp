// What a periodic orbit of a sweep does between two neighbouring values of the parameter: which multiplier leaves the
// unit circle there.
//
// Newton's method finds the orbit of the first value again, and from it the orbit at the second value. If that one
// exists and is unstable, the multipliers outside the unit circle name the bifurcation between the two values. If it is
// stable, the sweep changed to another attractor, or its other point has no regime. If no orbit is found near the first
// one, a fold, a grazing of a contact or a step too large for Newton's method are possible: nothing is proved.
#pragma once

#include <complex>
#include <optional>
#include <span>

#include "core/vector_field.hpp"
#include "integrate/options.hpp"

namespace epicyclic::studies {

struct OrbitAcross {
  std::complex<double> here;   ///< multiplier of largest modulus at the first value
  bool found = false;          ///< the orbit at the second value; without it the members below are not known
  int unstable = 0;            ///< multipliers beyond the unit circle at the second value
  bool one_kind = false;       ///< all of them are complex, or real of one sign
  std::complex<double> there;  ///< multiplier of largest modulus at the second value
};

/// @param here, there  the fields at the two values, with a period and tangents
/// @param orbit        a state on the orbit at the mesh phase 0, or near it
/// @param n            its period in mesh periods
/// @returns nothing if the orbit of the first value is not found again
/// @throws as Flow::evolve()
[[nodiscard]] std::optional<OrbitAcross> orbit_across(const VectorField& here, const VectorField& there,
                                                      std::span<const double> orbit, int n,
                                                      const integrate::IntegratorOptions& integrator);

}  // namespace epicyclic::studies
