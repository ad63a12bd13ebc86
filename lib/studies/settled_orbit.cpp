#include "studies/settled_orbit.hpp"

#include "core/largest_difference.hpp"
#include "core/text.hpp"

namespace epicyclic::studies {

namespace {

/// A motion whose recurrence error is larger than this is not tried, and an orbit farther away than this is another one
/// [b_c, b_c per tau].
constexpr double near = 1.0;
/// Longest period that a motion which does not recur is tried with.
constexpr int longest_tried = 12;

/// The least divisor d of n with phi_d(y) = y: an orbit of period 1 recurs after 10 periods, too, and noise may make
/// that the better one.
int least_period(integrate::Flow& flow, const std::vector<double>& orbit, int n) {
  constexpr double closed = 1e-6;
  std::vector<double> y = orbit;
  flow.forget();
  for (int d = 1; d < n; ++d) {
    if (!flow.evolve(y, 0.0, flow.field().period).reached()) break;
    if (n % d == 0 && largest_difference(y, orbit) < closed) return d;
  }
  return n;
}

}  // namespace

SettledOrbit settled_orbit(integrate::Flow& flow, const PointResult& motion) {
  SettledOrbit found;
  if (motion.outcome != integrate::Outcome::reached) {
    found.note = "there is no motion: " + motion.message;
    return found;
  }
  const analysis::Recurrence& r = motion.recurrence;
  const bool recurs = r.period > 0;
  int n = recurs ? r.period : r.error < near && r.best_period <= longest_tried ? r.best_period : 0;
  if (n == 0) {
    found.note = "the motion does not recur";
    return found;
  }
  found.orbit = analysis::find_periodic_orbit(flow, motion.end_state, n);
  if (!found.orbit.found()) {
    found.note = "no orbit of period " + std::to_string(n) + " by Newton's method: " + found.orbit.message;
    return found;
  }
  if (const int least = least_period(flow, found.orbit.state, n); least < n) {
    const analysis::PeriodicOrbit shorter = analysis::find_periodic_orbit(flow, found.orbit.state, least);
    if (shorter.found()) {
      found.orbit = shorter;
      n = least;
    }
  }
  const std::string name = "orbit of period " + std::to_string(n);
  found.distance = largest_difference(found.orbit.state, motion.end_state);
  found.largest_multiplier = largest_multiplier(found.orbit);
  if (found.distance > near) {
    found.note = "the nearest " + name + " is " + short_text(found.distance) + " away";
  } else if (!recurs && found.largest_multiplier >= 1.0) {
    found.note = "the motion does not recur, and the " + name + " near it is unstable (multiplier " +
                 short_text(found.largest_multiplier) + ")";
  } else {
    found.period = n;
    if (!recurs) found.note = "the motion was still settling; its " + name + " was found by Newton's method";
  }
  return found;
}

}  // namespace epicyclic::studies
