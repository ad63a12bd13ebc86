// A computation that goes on from the results that were kept of it.

#include "studies/remembered_flow.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/lyapunov.hpp"
#include "integrate/make_flow.hpp"
#include "problems/known_systems.hpp"

namespace epicyclic::studies::remembered_flow_test {
namespace {

/// x'' + 0.25 x' - x + x^3 = 0.4 cos t: chaotic.
const VectorField chaotic = problems::duffing(0.25, -1.0, 0.4, 1.0);

using Results = std::vector<std::vector<double>>;

FlowMemory memory_of(Results& kept) {
  return {[known = kept, next = std::size_t{0}](std::size_t numbers) mutable -> std::optional<std::vector<double>> {
            if (next == known.size()) return std::nullopt;
            EXPECT_EQ(known[next].size(), numbers);
            return known[next++];
          },
          [&kept](std::span<const double> result) { kept.emplace_back(result.begin(), result.end()); }};
}

struct Spectrum {
  analysis::LyapunovSpectrum exponents;
  std::vector<double> state{0.1, 0.2};
  long calls = 0;  ///< of the right-hand side
};

/// @param stop_after  intervals, aligning ones included
Spectrum spectrum(FlowMemory memory, int stop_after = 1000) {
  analysis::SpectrumOptions options;
  options.aligning_intervals = 5;
  options.intervals = 40;
  Spectrum s;
  const auto flow = remembered(integrate::make_flow(chaotic, {}), std::move(memory));
  s.exponents = analysis::lyapunov_spectrum(*flow, s.state, options, [&] { return stop_after-- > 0; });
  s.calls = flow->right_hand_side_calls();
  return s;
}

TEST(RememberedFlow, GoesOnWithTheSameBitsFromWhereverItWasStopped) {
  const Spectrum whole = spectrum({});
  for (const int stopped_after : {0, 1, 7, 44}) {
    Results kept;
    (void)spectrum(memory_of(kept), stopped_after);
    EXPECT_EQ(kept.size(), static_cast<std::size_t>(stopped_after));
    const Spectrum resumed = spectrum(memory_of(kept));
    EXPECT_EQ(resumed.state, whole.state) << stopped_after;
    EXPECT_EQ(resumed.exponents.growth, whole.exponents.growth) << stopped_after;
    EXPECT_EQ(kept.size(), 45U);
    // Nothing that is known is computed again.
    if (stopped_after == 44) {
      EXPECT_LT(resumed.calls, whole.calls / 20);
    }
    EXPECT_EQ(spectrum(memory_of(kept)).calls, 0);
  }
}

}  // namespace
}  // namespace epicyclic::studies::remembered_flow_test
