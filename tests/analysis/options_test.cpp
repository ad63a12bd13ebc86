// Options of analyses refuse what nothing can be told with, each member by its name, where they enter.

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/attractors.hpp"
#include "analysis/lyapunov.hpp"
#include "analysis/periodic_orbit.hpp"
#include "analysis/poincare.hpp"
#include "analysis/regime.hpp"
#include "core/errors.hpp"
#include "integrate/make_flow.hpp"
#include "problems/known_systems.hpp"
#include "wrong_options.hpp"

namespace epicyclic::analysis::options_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using test::expect_refused;

TEST(AnalysisOptions, ExponentsHaveAGrowthThatIsCounted) {
  using L = LyapunovOptions;
  expect_refused<L>(
      {}, {{"aligning_periods", [](L& o) { o.aligning_periods = -1; }}, {"periods", [](L& o) { o.periods = 0; }}});
  using S = SpectrumOptions;
  expect_refused<S>({}, {{"aligning_intervals", [](S& o) { o.aligning_intervals = -1; }},
                         {"intervals", [](S& o) { o.intervals = 0; }},
                         {"interval", [](S& o) { o.interval = -1; }},
                         {"interval", [](S& o) { o.interval = nan; }}});
}

TEST(AnalysisOptions, StrobesHaveAPhase) {
  using O = StrobeOptions;
  expect_refused<O>({}, {{"transient_periods", [](O& o) { o.transient_periods = -1; }},
                         {"recorded_periods", [](O& o) { o.recorded_periods = -1; }},
                         {"phases", [](O& o) { o.phases = 0; }}});
}

TEST(AnalysisOptions, OrbitsAreIterated) {
  using O = OrbitOptions;
  expect_refused<O>({}, {{"iterations", [](O& o) { o.iterations = 0; }},
                         {"residual", [](O& o) { o.residual = -1e-9; }},
                         {"residual", [](O& o) { o.residual = nan; }},
                         {"known", [](O& o) { o.known = nan; }},
                         {"shooting_intervals", [](O& o) { o.shooting_intervals = 0; }}});
}

TEST(AnalysisOptions, RegimesHaveALookThatTells) {
  using O = RegimeOptions;
  expect_refused<O>({}, {{"look", [](O& o) { o.window = 15; }},
                         {"budget", [](O& o) { o.budget = o.window - 1; }},
                         {"lasting", [](O& o) { o.lasting = -1; }},
                         {"longest_period", [](O& o) { o.longest_period = 0; }},
                         {"near", [](O& o) { o.near = nan; }},
                         {"residual", [](O& o) { o.residual = 0; }},
                         {"neutral", [](O& o) { o.neutral = nan; }}});
}

TEST(AnalysisOptions, AttractorsHaveALevel) {
  using O = AttractorOptions;
  expect_refused<O>({}, {{"level", [](O& o) { o.level = 0; }},
                         {"level", [](O& o) { o.level = 1; }},
                         {"level", [](O& o) { o.level = nan; }},
                         {"least", [](O& o) { o.least = -0.1; }},
                         {"least", [](O& o) { o.least = nan; }},
                         {"tolerance", [](O& o) { o.tolerance = nan; }}});
}

TEST(AnalysisOptions, NothingIsComputedWithWhatIsWrong) {
  const auto always = [] { return true; };
  const auto flow = integrate::make_flow(problems::duffing(0.3, -1.0, 0.2, 1.2), {});
  const std::vector<double> start = {1.0, 0.0};
  std::vector<double> y = start;
  EXPECT_THROW((void)largest_exponent(*flow, y, {.periods = 0}, {}, always), InputError);
  EXPECT_THROW((void)lyapunov_spectrum(*flow, y, {.intervals = 0}, always), InputError);
  EXPECT_THROW((void)strobe(
                   *flow, y, {.phases = 0}, [](auto&&...) {}, always),
               InputError);
  EXPECT_THROW((void)find_periodic_orbit(*flow, y, 1, {.shooting_intervals = 0}), InputError);
  EXPECT_THROW((void)classify(*flow, y, {.window = 8}, always), InputError);
  EXPECT_THROW((void)classify(*flow, y, {.observable = 2}, always), InputError) << "of two components";
  EXPECT_THROW((void)label_attractors({}, {.least = -1}), InputError);
  EXPECT_EQ(y, start);
}

}  // namespace
}  // namespace epicyclic::analysis::options_test
