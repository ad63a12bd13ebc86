#include "analysis/regime_flows.hpp"

#include <algorithm>

namespace epicyclic::analysis {

RegimeOptions RegimeFlows::options(RegimeOptions o) const {
  o.exact = exact.get();
  o.coarser = coarser.get();
  return o;
}

long RegimeFlows::right_hand_side_calls() const {
  long calls = 0;
  for (const auto* flow : {&looks, &exact, &coarser}) calls += (*flow)->right_hand_side_calls();
  return calls;
}

RegimeFlows make_regime_flows(const VectorField& field, const integrate::IntegratorOptions& integrator,
                              const integrate::FlowMaker& make_flow) {
  const auto with = [&](double factor, bool controlled) {
    integrate::IntegratorOptions o = integrator;
    o.relative_tolerance *= factor;
    o.absolute_tolerance *= factor;
    o.tangent_error_control = controlled;
    return make_flow(field, o);
  };
  const double of_looks = std::min(statistical_tolerance / integrator.relative_tolerance, 100.0);
  return {with(of_looks, integrator.tangent_error_control), with(1.0, true), with(10.0, true)};
}

}  // namespace epicyclic::analysis
