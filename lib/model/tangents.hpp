// The right-hand side's derivatives at one operating point: along tangent vectors, and with respect to a parameter.
//
//   (dg/dy) v_j            the kernel on dual numbers
//   dg/dp                  the kernel on dual numbers whose constants have their own derivatives          [M-dp]
//
// The state enters the kernel by dual numbers only, so both are exact where the kernel is. A folded constant's
// derivative dP/dp is a difference of the fourth order over +-2 steps: the constants are smooth in p, so its error is
// some 1e-11 of the constant; a kink of the trajectory is not differenced.
#pragma once

#include <array>
#include <cstddef>

#include "core/vector_field.hpp"
#include "model/layout.hpp"
#include "model/parameters.hpp"

namespace epicyclic::model {

template <std::size_t N>
[[nodiscard]] TangentFunction make_tangents(Layout layout, const Parameters<double, N>& p);

/// @param p     at the value
/// @param near  at value - 2 h, - h, + h, + 2 h
/// @param h     the step
/// @throws InputError when the parameter moves a breakpoint in the mesh phase: dg/dp would be infinite there
template <std::size_t N>
[[nodiscard]] ParameterFunction make_parameter_derivative(Layout layout, const Parameters<double, N>& p,
                                                          const std::array<Parameters<double, N>, 4>& near, double h);

}  // namespace epicyclic::model
