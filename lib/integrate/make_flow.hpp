// A Flow by the name of its method.
#pragma once

#include <functional>
#include <memory>

#include "integrate/flow.hpp"
#include "integrate/options.hpp"

namespace epicyclic::integrate {

/// @throws InputError for options out of range, or a method that the field does not fit; SolverError if the solver
/// cannot be set up
[[nodiscard]] std::unique_ptr<Flow> make_flow(VectorField field, const IntegratorOptions& options);

/// Makes flows: make_flow(), or lanes that many trajectories share.
using FlowMaker = std::function<std::unique_ptr<Flow>(VectorField field, const IntegratorOptions& options)>;

/// Flows of systems that differ by a parameter. If fields have their parameter derivative, so do the flows
/// (LastTangent::parameter).
using FlowFamily = std::function<std::unique_ptr<Flow>(double value)>;

/// @throws InputError for options out of range; a call of the result throws what `fields` and make_flow() throw
[[nodiscard]] FlowFamily make_flow_family(FieldFamily fields, const IntegratorOptions& options);

}  // namespace epicyclic::integrate
