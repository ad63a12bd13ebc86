// Tangent vectors pushed forward through a function that is written for any scalar: f(y) and (df/dy) v_1 ... v_m.
//
//   y + sum_j v_j eps_j  ->  f(y) + sum_j (df/dy) v_j eps_j        (core/dual.hpp)
//
// Exact to rounding. The directions are taken in chunks of 4, whose dual numbers the compiler has unrolled; the last
// few one by one, or in a chunk that is filled up with directions of no length. A direction's derivatives do not depend
// on the chunk it is in. Smoothness: at a kink the derivative is that of the side
// which select() takes.
#pragma once

#include <algorithm>
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
  const std::size_t count = std::min(M, v.count - first);
  thread_local std::vector<Dual<M>> memory;
  memory.resize(2 * n);
  Dual<M>* const y_dual = memory.data();
  Dual<M>* const f_dual = y_dual + n;
  for (std::size_t i = 0; i < n; ++i) {
    y_dual[i].value = y[i];
    for (std::size_t j = 0; j < M; ++j) y_dual[i].derivative[j] = j < count ? v.column(first + j)[i] : 0.0;
  }
  f(static_cast<const Dual<M>*>(y_dual), f_dual);
  for (std::size_t i = 0; i < n; ++i) {
    value[i] = f_dual[i].value;
    for (std::size_t j = 0; j < count; ++j) out.column(first + j)[i] = f_dual[i].derivative[j];
  }
}

}  // namespace detail

/// @tparam chunk  most directions that are taken at once
/// @param n      length of y, of f(y) and of each tangent vector
/// @param f      f(const T* y, T* value) for T = Dual<chunk>, Dual<1>
/// @param v      at least one vector
/// @param value  f(y)
/// @param out    (df/dy) v_j, as many as v has
template <std::size_t chunk = 4, class F>
void push_forward(std::size_t n, const F& f, const double* y, const Columns<const double>& v, double* value,
                  const Columns<double>& out) {
  constexpr std::size_t few = chunk / 2;  // one by one each takes the value anew: about as much as a direction
  std::size_t j = 0;
  if constexpr (chunk > 1)
    for (; j + few < v.count; j += chunk) detail::push_chunk<chunk>(n, f, y, v, j, value, out);
  for (; j < v.count; ++j) detail::push_chunk<1>(n, f, y, v, j, value, out);
}

}  // namespace epicyclic
