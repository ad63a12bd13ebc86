// The orbit of period 1 along a sweep, stable or not, and how far it is from the motions that claims speak of.
//
// What a look tells of a motion is a word, and a word does not change until a threshold is passed. The orbit goes on
// where it has lost its stability, and its Floquet multipliers mu change smoothly with every parameter:
//
//   g = ln max |mu|         growth over a mesh period: negative where period 1 is stable
//   h = ln (- min mu)       of real multipliers: positive beyond a flip
//   r = ln max |mu|         of all but the one of h
//   d = min |mu + 1|        the distance from a flip
//
// What a point lacks of a motion is 0 where its orbit is well beyond the threshold, less than 1/2 where it is beyond
// it, and up to 1 the farther it is on the other side:
//
//   period 1       x(g) ,   x(g) = k max(0, g) / (1 + k max(0, g)) ,   k = 20                               [P-lack]
//   period 2       1/2 (b(h, w) + x(r)) ,   w = 0.05
//   chaos          b(g, 0.3)
//   not period 1, not periodic, several periods, a torus    b(g, w)
//   b(g, w) = 1/2 max(0, 1 - g / w)  for g > 0 ,  1/2 + 1/2 d / (d + d_0)  else ,   d_0 = 0.4
//
// Chaos is a cascade beyond the flip, so it takes an orbit that is well unstable. None of this is a verdict: it leads a
// search where the words are flat. Limits: other motions beside the orbit of period 1 are not seen; where it is not
// found a point lacks half of anything.
#pragma once

#include <atomic>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "studies/sweep.hpp"

namespace epicyclic::claims {

/// Why there are none.
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
  /// @param word  of is_motion_word()
  /// @returns nothing for words of which the orbit tells nothing: "period 3", "not chaotic"
  [[nodiscard]] std::optional<double> lacks(std::string_view word) const;
};

/// The orbit at each value, from those before it, or from where the model's default start comes nearest to itself.
/// @param values  along the sweep
/// @param stop    may be null; the rest is then not found
/// @throws InputError for models without tangents
[[nodiscard]] std::vector<PeriodOne> follow_period_one(std::span<const double> values, const studies::ModelAt& model_at,
                                                       const integrate::IntegratorOptions& integrator,
                                                       const std::atomic<bool>* stop = nullptr);

}  // namespace epicyclic::claims
