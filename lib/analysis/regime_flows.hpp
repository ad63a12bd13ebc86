// The flows that classify() wants of one system [analysis/regime.hpp].
#pragma once

#include <memory>

#include "analysis/regime.hpp"
#include "integrate/flow.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/options.hpp"

namespace epicyclic::analysis {

/// Growth is a statistical matter, for which a tolerance that is looser than a study's is as good; at looser ones than
/// this kinks pass unseen, and growth is off by more than a torus's interval.
inline constexpr double statistical_tolerance = 1e-6;

/// Flows of one classification. Windows of a growing trajectory, where growth is a matter of statistics, use the
/// tolerance above, or one up to a hundred times looser. Windows without growth use the requested tolerance. Orbits use
/// that one too, with tangents under error control, and once more ten times that tolerance, for the errors of
/// multipliers. Tighter flows, each by a factor of a hundred down to 1e-12, are made on request.
struct RegimeFlows {
  struct Tighter;

  std::unique_ptr<integrate::Flow> windows, tight, exact, coarser;
  std::shared_ptr<Tighter> tighter;

  /// Options `o` with `exact`, `coarser`, `tight` and `tighter` set to these flows, which must live longer.
  [[nodiscard]] RegimeOptions options(RegimeOptions o = {}) const;

  [[nodiscard]] long right_hand_side_calls() const;
};

/// @throws InputError for options that no flow takes
[[nodiscard]] RegimeFlows make_regime_flows(const VectorField& field, const integrate::IntegratorOptions& integrator,
                                            const integrate::FlowMaker& make_flow = integrate::make_flow);

}  // namespace epicyclic::analysis
