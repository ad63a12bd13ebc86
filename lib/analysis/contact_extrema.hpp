// How near an orbit comes to the surfaces where its vector field is not smooth, and how far beyond it goes.
//
// Of each surface h(s, y) = 0 the least and the greatest value along the orbit. An orbit grazes the surface where one
// of them is 0: there a contact is first made or first lost. Looked for between 128 looks a period, where dh/ds changes
// its sign; the place is then the root of dh/ds along the motion itself.
//
// Limits: an extremum and the next one between two looks are not seen.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/orbit_family.hpp"

namespace epicyclic::analysis {

struct ContactExtrema {
  std::vector<double> least, greatest;  ///< of each surface, between looks by the cubic through both
};

/// @returns nothing if the orbit could not be carried; empty lists if the field has no surfaces
[[nodiscard]] std::optional<ContactExtrema> contact_extrema(const OrbitFamily& family, const CurvePoint& orbit);

/// That of one surface to the integrator's accuracy.
[[nodiscard]] std::optional<double> contact_extremum(const OrbitFamily& family, const CurvePoint& orbit,
                                                     std::size_t surface, bool least);

}  // namespace epicyclic::analysis
