// SUNDIALS CVODE as a Flow: Adams-Moulton and BDF of variable step and order, the cross-checks of another kind.
//
// Restarted at each breakpoint and each evolution, from order 1 with a step that CVODE chooses itself, so that an
// evolution depends on its arguments alone. Adams solves its equations by functional iteration, BDF by modified Newton
// with the dense Jacobian from dual numbers. Dense output: the method's own polynomial.
//
// Source: SUNDIALS 6.4 user guide, CVODE. Limits: BDF damps what oscillates near the step's own frequency; its answers
// converge to the same limit, but from the side of too much damping.
#pragma once

#include <memory>

#include "integrate/flow.hpp"
#include "integrate/options.hpp"

namespace epicyclic::integrate {

/// @throws InputError for options out of range, a method that is not CVODE's, or BDF for a field without tangents;
/// SolverError if CVODE cannot be set up
[[nodiscard]] std::unique_ptr<Flow> make_cvode_flow(VectorField field, const IntegratorOptions& options);

}  // namespace epicyclic::integrate
