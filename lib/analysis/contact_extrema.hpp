// How near an orbit comes to the surfaces where its vector field is not smooth, and how far beyond it goes.
//
// The results are the least and the greatest value of each surface h(s, y) = 0 along the orbit. An orbit grazes the
// surface where one of them is 0: there a contact is first made or first lost. The search takes 128 samples a period.
// Between two samples with different signs of dh/ds, the place is the root of dh/ds along the trajectory.
//
// Limits: two extrema between two neighbouring samples are not seen.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/orbit_family.hpp"

namespace epicyclic::analysis {

struct ContactExtrema {
  std::vector<double> least, greatest;  ///< of each surface; between samples by the cubic through both
};

/// @returns nothing if the integration of the orbit failed; empty lists if the field has no surfaces
[[nodiscard]] std::optional<ContactExtrema> contact_extrema(const OrbitFamily& family, const CurvePoint& orbit);

/// That of one surface to the integrator's accuracy.
[[nodiscard]] std::optional<double> contact_extremum(const OrbitFamily& family, const CurvePoint& orbit,
                                                     std::size_t surface, bool least);

}  // namespace epicyclic::analysis
