#include "integrate/checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "core/errors.hpp"

namespace epicyclic::integrate {

void check_field(const VectorField& field) {
  if (field.dimension == 0) throw InputError("a field has dimension = 0, must be >= 1");
  if (!field.right_hand_side) throw InputError("a field has no right_hand_side; set it");
  if (!(field.period >= 0.0) || !std::isfinite(field.period))
    throw InputError("a field has period = " + std::to_string(field.period) + ", must be a number >= 0");
  double before = 0.0;
  for (const double b : field.breakpoints) {
    if (!(b >= before) || !(b < field.period))
      throw InputError("a field has a breakpoint at " + std::to_string(b) + "; breakpoints must rise in [0, period)");
    before = b;
  }
  const std::size_t segments = std::max<std::size_t>(1, field.breakpoints.size());
  if (!field.sampling_interval.empty() && field.sampling_interval.size() != segments)
    throw InputError("a field has " + std::to_string(field.sampling_interval.size()) + " sampling intervals for " +
                     std::to_string(segments) + " segments; give one for each, or none");
  for (const double d : field.sampling_interval)
    if (!(d > 0.0)) throw InputError("a field has a sampling_interval of " + std::to_string(d) + ", must be > 0");
}

void check_samples(double from, std::span<const double> samples) {
  double before = from;
  for (const double s : samples) {
    if (!(s >= before))
      throw InputError("a sample at s = " + std::to_string(s) + " follows s = " + std::to_string(before) +
                       "; samples must rise from the initial time");
    before = s;
  }
}

}  // namespace epicyclic::integrate
