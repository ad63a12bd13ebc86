#include "analysis/lyapunov.hpp"

#include <cmath>

namespace epicyclic::analysis {

LargestExponent largest_exponent(integrate::Flow& flow, std::span<double> state, const LyapunovOptions& options,
                                 const integrate::Observer& observer, const std::function<bool()>& go_on) {
  LargestExponent result;
  const double period = flow.field().period;
  // A direction that no symmetry of a system singles out.
  std::vector<double> v(state.size());
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = std::sin(1.0 + static_cast<double>(i) * 1.7);
  for (int k = -options.aligning_periods; k < options.periods; ++k) {
    if (!go_on()) return result;
    double before = 0.0;
    for (const double x : v) before += x * x;
    for (double& x : v) x /= std::sqrt(before);
    result.evolution = flow.evolve_tangents(state, v, 0.0, period);
    if (!result.evolution.reached()) return result;
    if (k < 0) continue;
    double square = 0.0;
    for (const double x : v) square += x * x;
    result.growth.push_back(0.5 * std::log(square));
    if (observer) observer(static_cast<std::size_t>(k), period, state);
  }
  if (result.growth.empty()) return result;
  result.per_s = batch_mean(result.growth);
  result.per_s.value /= period;
  result.per_s.half_width /= period;
  return result;
}

}  // namespace epicyclic::analysis
