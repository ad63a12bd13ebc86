#include "studies/classification.hpp"

#include <algorithm>
#include <utility>

#include "analysis/regime_flows.hpp"
#include "integrate/methods.hpp"
#include "model/layout.hpp"

namespace epicyclic::studies {

bool has_classification(const VectorField& field) { return field.tangents && !field.jumps_at_surfaces; }

std::unique_ptr<integrate::Flow> make_flow_of_one_trajectory(VectorField field,
                                                             const integrate::IntegratorOptions& integrator) {
  integrate::IntegratorOptions own = integrator;
  own.method = integrate::arkode_twin(own.method);
  return integrate::make_flow(std::move(field), own);
}

double map_error(const integrate::IntegratorOptions& integrator) {
  return std::max(analysis::RegimeOptions{}.residual, 3.0 * integrator.relative_tolerance);
}

ClassifiedState classify_state(const VectorField& field, std::vector<double>& state, const RecordingOptions& recording,
                               const integrate::IntegratorOptions& integrator, const std::function<bool()>& go_on,
                               const analysis::PoincareSection* seen, const integrate::FlowMaker& make_flow) {
  const analysis::RegimeFlows flows = analysis::make_regime_flows(field, integrator, make_flow);
  analysis::RegimeOptions options = flows.options();
  options.budget = std::max(options.window, recording.classification_periods);
  options.lasting = options.budget / 4;
  options.longest_period = recording.period_max;
  options.residual = map_error(integrator);
  options.observable = std::min(model::Slots::w_s, field.dimension - 1);
  ClassifiedState classified;
  classified.classification = analysis::classify(*flows.windows, state, options, go_on, seen);
  classified.right_hand_sides = flows.right_hand_side_calls();
  return classified;
}

}  // namespace epicyclic::studies
