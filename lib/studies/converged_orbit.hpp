// The periodic orbit to which a trajectory converges, by another flow than the one that classified it.
//
// A point has an orbit if it is periodic, as all studies classify it [studies/classification.hpp]. If the study used
// recurrence alone, it has an orbit if its record recurs. Newton's method starts from the point of that orbit that is
// nearest to the last state.
#pragma once

#include <string>

#include "analysis/periodic_orbit.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies {

struct ConvergedOrbit {
  int period = 0;  ///< n [mesh periods]; 0 if there is no such orbit
  analysis::PeriodicOrbit orbit{};
  double distance = 0;            ///< of the point's last state from the orbit [b_c, b_c per tau]
  double largest_multiplier = 0;  ///< modulus
  std::string note{};             ///< the regime, if there is no orbit or the trajectory had not converged to it
};

/// @param flow  of the point's model, at the tolerance of the orbit
[[nodiscard]] ConvergedOrbit converged_orbit(integrate::Flow& flow, const PointSummary& point);

}  // namespace epicyclic::studies
