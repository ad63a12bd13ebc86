#include "studies/expected_points.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <tuple>

namespace epicyclic::studies {

namespace {

/// "symmetry index 1 of 3". The function also accepts the text of older files.
std::string symmetry_of(const LocatedPoint& p) {
  constexpr std::string_view old = "wave";
  return p.broken_symmetry.starts_with(old) ? "symmetry index" + p.broken_symmetry.substr(old.size())
                                            : p.broken_symmetry;
}

bool alike(const LocatedPoint& a, const LocatedPoint& b) {
  return std::tie(a.kind, a.period, a.contact) == std::tie(b.kind, b.period, b.contact) &&
         symmetry_of(a) == symmetry_of(b);
}

PointVerdict verdict_of(const LocatedPoint& expected, const LocatedPoint& found) {
  if (!(found.bound <= uncertain_from * expected.bound)) return PointVerdict::too_uncertain;
  return std::abs(found.value - expected.value) <= expected.bound ? PointVerdict::agrees : PointVerdict::differs;
}

/// Two that may be one.
struct Pair {
  double apart;
  std::size_t expected, found;
};

}  // namespace

std::string to_string(PointVerdict verdict) {
  switch (verdict) {
    case PointVerdict::agrees:
      return "agrees";
    case PointVerdict::differs:
      return "differs";
    case PointVerdict::too_uncertain:
      return "too uncertain";
    case PointVerdict::missing:
      return "missing";
    case PointVerdict::additional:
      break;
  }
  return "additional";
}

std::vector<PointComparison> compare_points(std::span<const LocatedPoint> expected, std::span<const LocatedPoint> found,
                                            double reach) {
  std::vector<Pair> pairs;
  for (std::size_t e = 0; e < expected.size(); ++e)
    for (std::size_t f = 0; f < found.size(); ++f) {
      const double apart = std::abs(expected[e].value - found[f].value);
      if (alike(expected[e], found[f]) && apart <= std::max(reach, expected[e].bound)) pairs.push_back({apart, e, f});
    }
  std::ranges::sort(pairs, {}, [](const Pair& p) { return std::tie(p.apart, p.expected, p.found); });
  std::vector<bool> of_expected(expected.size()), of_found(found.size());
  std::vector<PointComparison> all;
  for (const auto& [apart, e, f] : pairs) {
    if (of_expected[e] || of_found[f]) continue;
    of_expected[e] = of_found[f] = true;
    all.push_back({expected[e], found[f], verdict_of(expected[e], found[f])});
  }
  for (std::size_t e = 0; e < expected.size(); ++e)
    if (!of_expected[e]) all.push_back({expected[e], std::nullopt, PointVerdict::missing});
  for (std::size_t f = 0; f < found.size(); ++f)
    if (!of_found[f]) all.push_back({std::nullopt, found[f], PointVerdict::additional});
  std::ranges::stable_sort(all, {}, &PointComparison::value);
  return all;
}

}  // namespace epicyclic::studies
