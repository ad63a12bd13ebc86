// A VectorField with its tangents, and with the derivative by a parameter, from one text of the right-hand side.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/push_forward.hpp"
#include "core/vector_field.hpp"

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

/// A field with its tangents for each value of a parameter p, and dg/dp in parameter_derivative.
/// @param f  f(const P& p, segment, s, const T* y, T* dyds): P = double with all T of make_field(), and P = T = Dual<1>
template <class F>
[[nodiscard]] FieldFamily make_field_family(std::size_t dimension, double period, F f) {
  return [dimension, period, f = std::move(f)](double value) {
    VectorField field = make_field(
        dimension, period,
        [f, value](std::size_t segment, double s, const auto* y, auto* dyds) { f(value, segment, s, y, dyds); });
    field.parameter_derivative = [dimension, f, value](std::size_t segment, double s, const double* y, double* dgdp) {
      const std::vector<Dual<1>> state(y, y + dimension);
      std::vector<Dual<1>> slope(dimension);
      f(Dual<1>::variable(value, 0), segment, s, state.data(), slope.data());
      for (std::size_t i = 0; i < dimension; ++i) dgdp[i] = slope[i].derivative[0];
    };
    return field;
  };
}

}  // namespace epicyclic::integrate
