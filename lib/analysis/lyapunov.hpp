// Largest Lyapunov exponent of a periodically forced flow, from one tangent vector.
//
//   g_k = log | v(s_k + T) | / | v(s_k) | ,   v rescaled to length 1 after each period T of the forcing
//   lambda = mean(g) / T  per unit of s, with the interval of [A-batch]                                   [A-lyap]
//
// Source: Benettin et al., Meccanica 15 (1980) 9. Limits: where the two largest exponents are equal or nearly so, the
// vector turns for ever and the interval says so; an interval is no proof beyond the time it was measured over.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "analysis/statistics.hpp"
#include "integrate/flow.hpp"

namespace epicyclic::analysis {

struct LyapunovOptions {
  int aligning_periods = 50;  ///< before growth is counted, for the vector to turn to the fastest direction
  int periods = 500;          ///< counted
};

struct LargestExponent {
  integrate::Evolution evolution;  ///< how it ended; growth holds the periods until then
  Estimate per_s;                  ///< lambda [1 / unit of s]; of no meaning unless reached
  std::vector<double> growth;      ///< g_k, one per counted period
};

/// @param state     carried on, replaced by the last state
/// @param observer  sees the state after each counted period; may be empty
/// @param go_on     asked before each period; false ends it
[[nodiscard]] LargestExponent largest_exponent(integrate::Flow& flow, std::span<double> state,
                                               const LyapunovOptions& options, const integrate::Observer& observer,
                                               const std::function<bool()>& go_on);

}  // namespace epicyclic::analysis
