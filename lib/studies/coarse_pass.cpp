#include "studies/coarse_pass.hpp"

#include <algorithm>

namespace epicyclic::studies {

std::vector<double> CoarsePass::start_of(std::size_t first, const std::function<bool()>& go_on,
                                         const integrate::FlowMaker& make_flow,
                                         const std::function<void(const std::function<bool()>& over)>& wait) {
  const std::size_t count = plan_.grid.columns();
  if (plan_.grid.coarse_periods == 0 || first % count == 0) return {};
  const std::size_t first_of_direction = first - first % count;
  std::unique_lock lock(mutex_);
  DirectionPass& pass = passes_[first / count];
  const auto known = [&] { return pass.next >= first % count; };
  while (!known() && pass.in_progress) {
    lock.unlock();
    wait([&] {
      const std::scoped_lock own(mutex_);
      return known() || !pass.in_progress || !go_on();
    });
    if (!go_on()) return {};
    lock.lock();
  }
  if (known()) return pass.starts.at(first);  // another thread may still advance it: this thread leaves it so
  pass.in_progress = true;
  while (pass.in_progress) {
    lock.unlock();
    bool done = false;
    try {
      done = advance(pass, first_of_direction + pass.next, go_on, make_flow);
    } catch (...) {
      lock.lock();
      pass.in_progress = false;
      throw;
    }
    lock.lock();
    if (done) keep(pass, first_of_direction);
    pass.in_progress = done && !known();
    if (!done) return {};
  }
  return pass.starts.at(first);
}

bool CoarsePass::advance(DirectionPass& pass, std::size_t point, const std::function<bool()>& go_on,
                         const integrate::FlowMaker& make_flow) {
  integrate::IntegratorOptions options = integrator_;
  // The pass only decides which branch the state is on.
  constexpr double enough = 1e-5;
  const double factor = std::clamp(enough / options.relative_tolerance, 1.0, 100.0);
  options.relative_tolerance *= factor;
  options.absolute_tolerance *= factor;
  const model::DynamicModel model = model_at_(plan_.points[point]);
  std::vector<double> state = pass.state.empty() ? model.default_start : pass.state;
  const auto flow = make_flow(model, options);
  for (int k = 0; k < plan_.grid.coarse_periods && !state.empty(); ++k) {
    if (!go_on()) return false;
    if (!flow->evolve(state, 0.0, flow->field().period).reached()) state.clear();
  }
  pass.state = std::move(state);
  return true;
}

void CoarsePass::keep(DirectionPass& pass, std::size_t first_of_direction) {
  ++pass.next;
  const std::size_t count = plan_.grid.columns();
  const std::size_t segments = plan_.grid.chains_per_line;
  // Is it the first point of a segment? They start at c count / segments, rounded down.
  const std::size_t c = (pass.next * segments + count - 1) / count;
  if (c * count / segments == pass.next) pass.starts[first_of_direction + pass.next] = pass.state;
}

}  // namespace epicyclic::studies
