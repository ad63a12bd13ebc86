// Tangent vectors pushed forward through a function that is written for any scalar: f(y) and (df/dy) v_1 ... v_m.
//
//   y + sum_j v_j eps_j  ->  f(y) + sum_j (df/dy) v_j eps_j        (core/dual.hpp)
//
// Exact to rounding. The directions are taken in chunks of 8, 4 and 1, whose dual numbers the compiler has unrolled; a
// direction's derivatives do not depend on the chunk it is in. Smoothness: at a kink the derivative is that of the side
// which select() takes.
#pragma once

#include <cstddef>
#include <vector>

#include "core/dual.hpp"

namespace epicyclic {

/// Tangent vectors in memory: vector j begins at data + j * stride.
template <class Number>
struct Columns {
  Number* data = nullptr;
  std::size_t count = 0;
  std::size_t stride = 0;

  [[nodiscard]] Number* column(std::size_t j) const { return data + j * stride; }
};

namespace detail {

template <std::size_t M, class F>
void push_chunk(std::size_t n, const F& f, const double* y, const Columns<const double>& v, std::size_t first,
                double* value, const Columns<double>& out) {
  thread_local std::vector<Dual<M>> memory;
  memory.resize(2 * n);
  Dual<M>* const y_dual = memory.data();
  Dual<M>* const f_dual = y_dual + n;
  for (std::size_t i = 0; i < n; ++i) {
    y_dual[i].value = y[i];
    for (std::size_t j = 0; j < M; ++j) y_dual[i].derivative[j] = v.column(first + j)[i];
  }
  f(static_cast<const Dual<M>*>(y_dual), f_dual);
  for (std::size_t i = 0; i < n; ++i) {
    value[i] = f_dual[i].value;
    for (std::size_t j = 0; j < M; ++j) out.column(first + j)[i] = f_dual[i].derivative[j];
  }
}

}  // namespace detail

/// @param n      length of y, of f(y) and of each tangent vector
/// @param f      f(const T* y, T* value) for T = Dual<8>, Dual<4>, Dual<1>
/// @param v      at least one vector
/// @param value  f(y)
/// @param out    (df/dy) v_j, as many as v has
template <class F>
void push_forward(std::size_t n, const F& f, const double* y, const Columns<const double>& v, double* value,
                  const Columns<double>& out) {
  std::size_t j = 0;
  for (; j + 8 <= v.count; j += 8) detail::push_chunk<8>(n, f, y, v, j, value, out);
  for (; j + 4 <= v.count; j += 4) detail::push_chunk<4>(n, f, y, v, j, value, out);
  for (; j < v.count; ++j) detail::push_chunk<1>(n, f, y, v, j, value, out);
}

}  // namespace epicyclic
