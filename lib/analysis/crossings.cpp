#include "analysis/crossings.hpp"

#include <algorithm>
#include <cmath>

namespace epicyclic::analysis {

Signs signs_of(const InvariantBlock& block, const Multipliers& values) {
  Signs s;
  for (const auto& x : values) {
    s.outside += std::abs(x) > 1.0 ? 1 : 0;
    if (!block.real || x.imag() != 0.0) continue;
    if (x.real() > 1.0) s.plus = !s.plus;
    if (x.real() < -1.0) s.minus = !s.minus;
  }
  return s;
}

std::optional<Crossing> crossing_between(const InvariantBlock& block, const Signs& a, const Signs& b) {
  const std::size_t crossed = std::max(a.outside, b.outside) - std::min(a.outside, b.outside);
  const bool plus = a.plus != b.plus;
  const bool minus = a.minus != b.minus;
  const bool direction_changes = a.falling != b.falling;
  if (crossed == 0 && !plus && !minus && !direction_changes) return std::nullopt;
  if (plus && !minus && crossed == 1) return Crossing::plus;
  if (direction_changes) return Crossing::unresolved;
  if (minus && !plus && crossed == 1) return Crossing::minus;
  if (!plus && !minus && crossed == (block.real ? 2U : 1U)) return Crossing::pair;
  return Crossing::unresolved;
}

Passages passages_between(const Multipliers& a, const Multipliers& b) {
  struct Pair {
    double distance;
    std::size_t of_a, of_b;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) pairs.push_back({std::abs(a[i] - b[k]), i, k});
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) { return p.distance < q.distance; });
  std::vector<bool> a_is_taken(a.size());
  std::vector<bool> b_is_taken(b.size());
  Passages passages;
  for (const Pair& p : pairs) {
    if (a_is_taken[p.of_a] || b_is_taken[p.of_b]) continue;
    a_is_taken[p.of_a] = b_is_taken[p.of_b] = true;
    const bool before = std::abs(a[p.of_a]) > 1.0;
    const bool behind = std::abs(b[p.of_b]) > 1.0;
    if (!before && behind) ++passages.outwards;
    if (before && !behind) ++passages.inwards;
  }
  return passages;
}

std::complex<double> nearest(const Multipliers& values, std::complex<double> to) {
  return *std::min_element(values.begin(), values.end(),
                           [&](const auto& p, const auto& q) { return std::abs(p - to) < std::abs(q - to); });
}

double sign_function(const InvariantBlock& block, Crossing crossing, const Multipliers& values, std::size_t inside) {
  const Signs signs = signs_of(block, values);
  if (crossing == Crossing::plus) return (signs.plus ? -1.0 : 1.0) * std::abs(nearest(values, 1.0) - 1.0);
  if (crossing == Crossing::minus) return (signs.minus ? -1.0 : 1.0) * std::abs(nearest(values, -1.0) + 1.0);
  return std::log(std::abs(values.at(inside)));
}

}  // namespace epicyclic::analysis
