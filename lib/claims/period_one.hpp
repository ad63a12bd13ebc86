// The orbit of period 1 along a sweep, stable or not, and its distance from the regimes that claims name.
//
// A screening returns a word for the regime, and a word does not change until a threshold is passed. The orbit
// continues where it has lost its stability, and its Floquet multipliers mu change smoothly with every parameter:
//
//   g = ln max |mu|         growth over a mesh period: negative if period 1 is stable
//   h = ln (- min mu)       of real multipliers: positive beyond a period doubling
//   r = ln max |mu|         of all but the one of h
//   d = min |mu + 1|        the distance from a period doubling
//
// The lack of a regime at a point is 0 if its orbit is well beyond the threshold. It is less than 1/2 if the orbit is
// beyond the threshold. On the other side it rises up to 1 with the distance:
//
//   period 1       x(g) ,   x(g) = k max(0, g) / (1 + k max(0, g)) ,   k = 20                               [P-lack]
//   period 2       1/2 (b(h, w) + x(r)) ,   w = 0.05
//   chaos          b(g, 0.3)
//   not period 1, not periodic, several periods, a torus    b(g, w)
//   b(g, w) = 1/2 max(0, 1 - g / w)  for g > 0 ,  1/2 + 1/2 d / (d + d_0)  else ,   d_0 = 0.4
//
// Chaos follows a cascade of period doublings, so that it requires an orbit that is well unstable. None of this is a
// verdict: it leads a search where the words do not change. Limits: attractors other than the orbit of period 1 are not
// seen. If the orbit is not found, a point lacks half of any regime.
#pragma once

#include <atomic>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "studies/sweep.hpp"

namespace epicyclic::claims {

/// Reason if there are no multipliers.
inline constexpr const char* no_multipliers = "forces jump at contact, where an orbit has no tangents";

/// Of one point.
struct PeriodOne {
  bool found = false;
  double growth = 0;       ///< g
  double doubling = 0;     ///< h; very negative where no real multiplier is negative
  double rest = 0;         ///< r
  double to_doubling = 0;  ///< d
  double fold = 0;         ///< largest real multiplier; a fold is where it reaches 1

  /// [P-lack]
  /// @param word  of is_regime_word()
  /// @returns nothing for words that the orbit does not determine: "period 3", "not chaotic"
  [[nodiscard]] std::optional<double> lacks(std::string_view word) const;
};

/// The orbit at each value. The guess comes from the orbits before it, or from the nearest return of the trajectory
/// from the default start.
/// @param values  along the sweep
/// @param stop    may be null; the rest is then not found
/// @throws InputError for models without tangents
[[nodiscard]] std::vector<PeriodOne> follow_period_one(std::span<const double> values, const studies::ModelAt& model_at,
                                                       const integrate::IntegratorOptions& integrator,
                                                       const std::atomic<bool>* stop = nullptr);

}  // namespace epicyclic::claims
