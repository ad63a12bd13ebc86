#include "studies/motion.hpp"

#include <algorithm>

#include "integrate/make_flow.hpp"
#include "integrate/methods.hpp"
#include "model/layout.hpp"

namespace epicyclic::studies {

bool has_classification(const integrate::VectorField& field) { return field.tangents && !field.jumps_at_surfaces; }

integrate::IntegratorOptions of_one_trajectory(integrate::IntegratorOptions integrator) {
  integrator.method = integrate::arkode_twin(integrator.method);
  return integrator;
}

double map_error(const integrate::IntegratorOptions& integrator) {
  return std::max(analysis::RegimeOptions{}.residual, 3.0 * integrator.relative_tolerance);
}

ToldMotion tell_motion(const integrate::VectorField& field, std::vector<double>& state, const SweepOptions& sweep,
                       const integrate::IntegratorOptions& integrator, const std::function<bool()>& go_on,
                       const analysis::PoincareSection* seen) {
  const auto with = [&](double factor, bool controlled) {
    integrate::IntegratorOptions o = of_one_trajectory(integrator);
    o.relative_tolerance *= factor;
    o.absolute_tolerance *= factor;
    o.tangent_error_control = controlled;
    return integrate::make_flow(field, o);
  };
  // Growth is a statistical matter, for which a looser tolerance is as good; orbits are sought at the study's own.
  constexpr double statistical = 1e-6;
  const auto looks =
      with(std::clamp(statistical / integrator.relative_tolerance, 1.0, 100.0), integrator.tangent_error_control);
  const auto exact = with(1.0, true);
  const auto coarser = with(10.0, true);
  analysis::RegimeOptions options;
  options.budget = std::max(options.look, sweep.classification_periods);
  options.lasting = options.budget / 4;
  options.longest_period = sweep.period_max;
  options.residual = map_error(integrator);
  options.observable = std::min(model::Slots::w_s, field.dimension - 1);
  options.exact = exact.get();
  options.coarser = coarser.get();
  ToldMotion motion;
  motion.told = analysis::classify(*looks, state, options, go_on, seen);
  for (const auto* flow : {&looks, &exact, &coarser}) motion.right_hand_sides += (*flow)->right_hand_side_calls();
  return motion;
}

}  // namespace epicyclic::studies
