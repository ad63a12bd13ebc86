#include "studies/converged_orbit.hpp"

#include "core/largest_difference.hpp"
#include "core/text.hpp"
#include "studies/classification.hpp"

namespace epicyclic::studies {

ConvergedOrbit converged_orbit(integrate::Flow& flow, const PointSummary& point) {
  ConvergedOrbit found;
  if (point.outcome != integrate::Outcome::reached) {
    found.note = "the point was not reached: " + point.message;
    return found;
  }
  if (point.regime != analysis::Regime::periodic) {
    found.note = regime_text(point);
    return found;
  }
  const int n = point.period;
  const std::string name = "orbit of period " + std::to_string(n);
  if (!has_classification(flow.field())) {
    found.note = "an " + name + " by recurrence alone: forces jump at contact, and there are no tangents to find it by";
    return found;
  }
  // The trajectory was classified before it converged, and may have another phase now.
  const std::vector<double> start =
      point.orbit.empty() ? point.end_state : analysis::nearest_on_orbit(flow, point.orbit, n, point.end_state);
  found.orbit = analysis::find_periodic_orbit(flow, start, n);
  if (!found.orbit.found()) {
    found.note = "no " + name + " by Newton's method: " + found.orbit.message;
    return found;
  }
  found.period = n;
  found.distance = largest_difference(found.orbit.state, point.end_state);
  found.largest_multiplier = largest_multiplier(found.orbit);
  if (point.recurrence.period == 0)
    found.note =
        "the trajectory had not converged, " + short_text(found.distance) + " away from its orbit at the record's end";
  return found;
}

}  // namespace epicyclic::studies
