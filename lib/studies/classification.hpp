// The classification of a state's regime, one procedure for all studies [analysis/regime.hpp].
//
// It uses the flows of analysis/regime_flows.hpp. The caller chooses who makes them: lanes that many trajectories
// share, or a flow of one trajectory. For lanes' methods, the second is ARKODE's twin of the lanes' pair, since
// tangents then belong to one trajectory.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "analysis/poincare.hpp"
#include "analysis/regime.hpp"
#include "integrate/flow.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/options.hpp"
#include "studies/recording_options.hpp"

namespace epicyclic::studies {

/// Has the field tangents wherever it goes? Without them there is nothing but recurrence.
[[nodiscard]] bool has_classification(const VectorField& field);

/// A flow by ARKODE's twin of a method of lanes, by the method itself otherwise.
[[nodiscard]] std::unique_ptr<integrate::Flow> make_flow_of_one_trajectory(
    VectorField field, const integrate::IntegratorOptions& integrator);

/// What an integrator leaves of an orbit, in parts of its largest component: kinks make its map rough to some of its
/// tolerances [-].
[[nodiscard]] double map_error(const integrate::IntegratorOptions& integrator);

struct ClassifiedState {
  analysis::Classification classification;
  long right_hand_sides = 0;
};

/// @param field  with has_classification()
/// @param state  replaced by the last state
/// @param recording  classification_periods and period_max are read
/// @param seen   a section of this very trajectory that ends in `state`; may be null
[[nodiscard]] ClassifiedState classify_state(const VectorField& field, std::vector<double>& state,
                                             const RecordingOptions& recording,
                                             const integrate::IntegratorOptions& integrator,
                                             const std::function<bool()>& go_on,
                                             const analysis::PoincareSection* seen = nullptr,
                                             const integrate::FlowMaker& make_flow = make_flow_of_one_trajectory);

}  // namespace epicyclic::studies
