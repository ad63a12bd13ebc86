// A VectorField with its tangents from one text of the right-hand side.
#pragma once

#include <cstddef>
#include <utility>

#include "core/push_forward.hpp"
#include "integrate/flow.hpp"

namespace epicyclic::integrate {

/// @param period  of f in s; 0 if f does not depend on s
/// @param f       f(segment, s, const T* y, T* dyds) for T = double and dual numbers; comparisons by
///                epicyclic::select, functions as in core/scalar.hpp
template <class F>
[[nodiscard]] VectorField make_field(std::size_t dimension, double period, F f) {
  VectorField field;
  field.dimension = dimension;
  field.period = period;
  field.right_hand_side = f;
  field.tangents = [dimension, f = std::move(f)](std::size_t segment, double s, const double* y,
                                                 const Columns<const double>& v, double* dyds,
                                                 const Columns<double>& dvds) {
    push_forward(
        dimension, [&](const auto* state, auto* slope) { f(segment, s, state, slope); }, y, v, dyds, dvds);
  };
  return field;
}

}  // namespace epicyclic::integrate
