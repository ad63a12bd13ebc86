// Equilibria of a stage: that of the linear stage, and those of the nonlinear one at each mesh phase.
//
//   a(q, s) = 0 ,  a the accelerations of [M-17]..[M-20] without velocities, e' = 0, omega_c = 0          [S-static]
//
// The second are the quasi-static solution: that of a stage that rotates so slowly that no inertia, no damping and no
// frame term acts. Gaps, varying stiffness, errors, the sun bearing's law and the friction of the operating point stay.
// Masses divide the rows and do not move the solution. If nothing holds the output (boundary `as_printed`), the train
// accelerates as one, and the relative coordinates are at rest.
//
// Newton's method, each phase from the one before; steps are halved until the accelerations fall. With exact gaps the
// equations are linear while no contact changes. If a step fails, the gaps are smoothed and sharpened again in stages.
// Limits: one equilibrium is found where there may be several; forces are known to 1e-7 of the load. Smoothness: C0 in
// s; it jumps where k(s) does.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/layout.hpp"
#include "model/parameters.hpp"

namespace epicyclic::model {

/// Equilibrium of the linearised stage at s = 0: mean stiffness, gaps closed on the drive flank, no friction, no
/// frame terms, errors frozen. From the kernel itself: with b = 0 its accelerations are linear in the displacements.
/// @returns a state
template <std::size_t N>
[[nodiscard]] std::vector<double> linear_equilibrium(Layout layout, Parameters<double, N> p);

/// The quasi-static solution.
/// @param start  a state near the equilibrium at the first phase
/// @param phases in [0, 2 pi]
/// @returns a state for each phase; empty where an equilibrium was not found
template <std::size_t N>
[[nodiscard]] std::vector<std::vector<double>> quasi_static_states(Layout layout, Parameters<double, N> p,
                                                                   std::vector<double> start,
                                                                   std::span<const double> phases);

}  // namespace epicyclic::model
