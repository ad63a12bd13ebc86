// SUNDIALS ARKODE as a Flow: embedded explicit Runge-Kutta pairs (ERKStep), the reference, and diagonally implicit ones
// (ARKStep), a cross-check.
//
// Step control: an I-controller without a limit on the first growth, so that a run split by a restart takes the same
// steps; the step that was cut short at a breakpoint or at the end is taken up again at its full length. Dense output:
// cubic Hermite between accepted steps, which needs no further right-hand side; ends of evolutions are stepped onto,
// never interpolated. Implicit stages: modified Newton's method with the dense Jacobian from dual numbers.
//
// Source: SUNDIALS 6.4 user guide, ERKStep and ARKStep. Limits: explicit, hence steps <= about 3 / (largest natural
// frequency); implicit, the same where the answer has to be accurate, since gear trains are stiff in no other sense.
#pragma once

#include <memory>
#include <string>

#include "integrate/flow.hpp"
#include "integrate/options.hpp"

namespace epicyclic::integrate {

/// @throws InputError for options out of range, a method that is not ARKODE's, or an implicit one for a field without
/// tangents; SolverError if ARKODE cannot be set up
[[nodiscard]] std::unique_ptr<Flow> make_arkode_flow(VectorField field, const IntegratorOptions& options);

/// A fixed-step flow of the same pair, for tests of the order of convergence.
/// @param step  length of the step in s, > 0
/// @throws as make_arkode_flow()
[[nodiscard]] std::unique_ptr<Flow> make_arkode_fixed_step_flow(VectorField field, const IntegratorOptions& options,
                                                                double step);

/// Version of SUNDIALS, e.g. "6.4.1".
[[nodiscard]] std::string arkode_version();

}  // namespace epicyclic::integrate
