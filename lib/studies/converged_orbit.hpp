// The periodic orbit that a motion is on, or is settling to, by another flow than the one that told it.
//
// A motion has an orbit where it is periodic, as all studies tell it [studies/motion.hpp]; where nothing but recurrence
// was asked, where it recurs. Newton's method starts from that orbit's point that is nearest to the motion's last one.
#pragma once

#include <string>

#include "analysis/periodic_orbit.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies {

struct ConvergedOrbit {
  int period = 0;  ///< n [mesh periods]; 0 if there is no such orbit
  analysis::PeriodicOrbit orbit{};
  double distance = 0;            ///< of the motion's last state from the orbit [b_c, b_c per tau]
  double largest_multiplier = 0;  ///< modulus
  std::string note{};             ///< what the motion is, where there is no orbit or it was still settling to it
};

/// @param flow  of the motion's model, at the tolerance that the orbit is wanted to
[[nodiscard]] ConvergedOrbit converged_orbit(integrate::Flow& flow, const PointSummary& point);

}  // namespace epicyclic::studies
