#include "analysis/regime_flows.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace epicyclic::analysis {

namespace {

integrate::IntegratorOptions scaled(integrate::IntegratorOptions o, double factor, bool controlled) {
  o.relative_tolerance *= factor;
  o.absolute_tolerance *= factor;
  o.tangent_error_control = controlled;
  return o;
}

}  // namespace

/// The flow, with its intermediate results.
struct RegimeFlows::Tighter {
  integrate::IntegratorOptions integrator;  ///< of the last ones
  integrate::FlowMaker make_flow;
  std::vector<std::unique_ptr<integrate::Flow>> flows;

  /// @param field  of any of the flows
  std::optional<FlowsOfTolerance> next(const VectorField& field) {
    constexpr double by = 0.01;
    if (by * integrator.relative_tolerance < tightest) return std::nullopt;
    integrator = scaled(integrator, by, integrator.tangent_error_control);
    const auto made = [&](double factor, bool controlled) {
      return flows.emplace_back(make_flow(field, scaled(integrator, factor, controlled))).get();
    };
    return FlowsOfTolerance{made(1.0, integrator.tangent_error_control), made(1.0, true), made(10.0, true)};
  }

  static constexpr double tightest = 0.9e-12;  ///< below it rounding is as large as a step's error
};

RegimeOptions RegimeFlows::options(RegimeOptions o) const {
  o.exact = exact.get();
  o.coarser = coarser.get();
  o.tight = tight.get();
  o.tighter = [to = tighter, of = exact.get()] { return to->next(of->field()); };
  return o;
}

long RegimeFlows::right_hand_side_calls() const {
  long calls = 0;
  for (const auto* flow : {&windows, &tight, &exact, &coarser}) calls += (*flow)->right_hand_side_calls();
  for (const auto& flow : tighter->flows) calls += flow->right_hand_side_calls();
  return calls;
}

RegimeFlows make_regime_flows(const VectorField& field, const integrate::IntegratorOptions& integrator,
                              const integrate::FlowMaker& make_flow) {
  const double of_windows = std::min(statistical_tolerance / integrator.relative_tolerance, 100.0);
  const bool controlled = integrator.tangent_error_control;
  const auto made = [&](double factor, bool control) { return make_flow(field, scaled(integrator, factor, control)); };
  return {made(of_windows, controlled), made(1.0, controlled), made(1.0, true), made(10.0, true),
          std::make_shared<RegimeFlows::Tighter>(RegimeFlows::Tighter{integrator, make_flow, {}})};
}

}  // namespace epicyclic::analysis
