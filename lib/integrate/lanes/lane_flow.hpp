// One trajectory through the lane ensemble, as a Flow: what many side by side do, one at a time.
//
// Limits: no located contacts.
#pragma once

#include <memory>

#include "integrate/flow.hpp"
#include "integrate/options.hpp"

namespace epicyclic::integrate {

/// @throws InputError when the options do not fit the method
[[nodiscard]] std::unique_ptr<Flow> make_lane_flow(VectorField field, const IntegratorOptions& options);

}  // namespace epicyclic::integrate
