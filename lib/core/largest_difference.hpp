// How far two vectors are apart, in the largest component.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace epicyclic {

/// max_i | a_i - b_i |; 0 for empty vectors. `b` has at least the length of `a`. Not for vectors that may hold NaN.
[[nodiscard]] inline double largest_difference(std::span<const double> a, std::span<const double> b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace epicyclic
