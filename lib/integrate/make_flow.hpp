// A Flow by the name of its method.
#pragma once

#include <memory>

#include "integrate/flow.hpp"
#include "integrate/options.hpp"

namespace epicyclic::integrate {

/// @throws InputError for an unknown method, or one that the field or the other options do not fit; SolverError if the
/// solver cannot be set up
[[nodiscard]] std::unique_ptr<Flow> make_flow(VectorField field, const IntegratorOptions& options);

}  // namespace epicyclic::integrate
