#include "studies/coarse_pass.hpp"

#include <algorithm>

#include "integrate/make_flow.hpp"
#include "studies/motion.hpp"

namespace epicyclic::studies {

std::vector<double> CoarsePass::start_of(std::size_t first, const std::function<bool()>& go_on) {
  const std::size_t count = plan_.grid.columns();
  if (plan_.grid.coarse_periods == 0 || first % count == 0) return {};
  const std::size_t direction = first / count;
  integrate::IntegratorOptions options = of_one_trajectory(integrator_);
  // Which branch it is on is all that is asked.
  constexpr double enough = 1e-5;
  const double factor = std::clamp(enough / options.relative_tolerance, 1.0, 100.0);
  options.relative_tolerance *= factor;
  options.absolute_tolerance *= factor;
  const std::scoped_lock lock(mutex_);
  Way& way = ways_[direction];
  for (; way.next < first - direction * count; keep(way, direction * count)) {
    const model::DynamicModel model = model_at_(plan_.points[direction * count + way.next]);
    std::vector<double> state = way.state.empty() ? model.default_start : way.state;
    const auto flow = integrate::make_flow(model, options);
    for (int k = 0; k < plan_.grid.coarse_periods && !state.empty(); ++k) {
      if (!go_on()) return {};
      if (!flow->evolve(state, 0.0, flow->field().period).reached()) state.clear();
    }
    way.state = std::move(state);
  }
  return way.starts.at(first);
}

void CoarsePass::keep(Way& way, std::size_t first_of_direction) {
  ++way.next;
  const std::size_t count = plan_.grid.columns();
  const std::size_t segments = plan_.grid.chains_per_line;
  // Is it the first point of a segment? They start at c count / segments, rounded down.
  const std::size_t c = (way.next * segments + count - 1) / count;
  if (c * count / segments == way.next) way.starts[first_of_direction + way.next] = way.state;
}

}  // namespace epicyclic::studies
