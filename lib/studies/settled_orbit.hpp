// The periodic orbit that a motion is on, or is still settling to.
//
// A weakly damped mode may leave a motion unsettled after some hundred mesh periods. If Newton's method from its last
// state finds an orbit close by, and that orbit attracts (all multipliers inside the unit circle), that is what the
// motion is settling to; chaotic and quasiperiodic motions have no such orbit beside them.
#pragma once

#include <string>

#include "analysis/periodic_orbit.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies {

struct SettledOrbit {
  int period = 0;  ///< n [mesh periods]; 0 if there is no such orbit
  analysis::PeriodicOrbit orbit{};
  double distance = 0;            ///< of the motion's last state from the orbit [b_c, b_c per tau]
  double largest_multiplier = 0;  ///< modulus
  std::string note{};             ///< how it was found, or why not; empty for a motion that recurs
};

/// @param flow  of the motion's model, at the tolerance that the orbit is wanted to
[[nodiscard]] SettledOrbit settled_orbit(integrate::Flow& flow, const PointResult& motion);

}  // namespace epicyclic::studies
