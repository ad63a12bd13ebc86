#include "analysis/poincare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace epicyclic::analysis {

Strobe strobe(integrate::Flow& flow, std::span<double> state, const StrobeOptions& options,
              const integrate::Observer& observer, const std::function<bool()>& go_on) {
  const double period = flow.field().period;
  Strobe result;
  result.section.dimension = flow.field().dimension;
  for (int k = 0; k < options.transient_periods; ++k) {
    if (!go_on()) return result;
    result.evolution = flow.evolve(state, 0.0, period);
    if (!result.evolution.reached()) return result;
  }
  std::vector<double> samples;
  for (int j = 1; j < options.phases; ++j) samples.push_back(period * j / options.phases);
  samples.push_back(period);
  result.section.states.reserve(static_cast<std::size_t>(options.recorded_periods) * result.section.dimension);
  for (int k = 0; k < options.recorded_periods; ++k) {
    if (!go_on()) return result;
    const std::size_t first = static_cast<std::size_t>(k) * samples.size();
    result.evolution =
        flow.evolve(state, 0.0, period, samples,
                    [&](std::size_t j, double s, std::span<const double> y) { observer(first + j, s, y); });
    if (!result.evolution.reached()) return result;
    result.section.states.insert(result.section.states.end(), state.begin(), state.end());
  }
  return result;
}

Recurrence recurrence(const PoincareSection& section, int longest, double tolerance) {
  const std::size_t size = section.size();
  const std::size_t most = std::min(static_cast<std::size_t>(longest), size / 2);
  Recurrence best;
  best.error = std::numeric_limits<double>::infinity();
  for (std::size_t n = 1; n <= most; ++n) {
    double error = 0.0;
    for (std::size_t k = 0; k + n < size && error < best.error; ++k) {
      const auto a = section.point(k);
      const auto b = section.point(k + n);
      for (std::size_t j = 0; j < section.dimension; ++j) error = std::max(error, std::abs(b[j] - a[j]));
    }
    if (error < best.error) {
      best.error = error;
      best.best_period = static_cast<int>(n);
    }
    if (error <= tolerance) {
      best.period = static_cast<int>(n);
      return best;
    }
  }
  return best;
}

}  // namespace epicyclic::analysis
