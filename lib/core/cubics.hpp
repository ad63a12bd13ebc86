// Cubics, K functions side by side, by the coefficients of their powers.
#pragma once

#include <array>
#include <cstddef>

#include "core/row.hpp"

namespace epicyclic {

/// Coefficients of K cubics: those of each power, from 0 on.
template <std::size_t K>
using Cubics = std::array<Row<double, K>, 4>;

/// K cubics at one place.
template <std::size_t K>
[[nodiscard]] Row<double, K> cubics_at(const Cubics<K>& c, double t) {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

}  // namespace epicyclic
