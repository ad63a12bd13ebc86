// Options refuse what no study can be computed with, each member by its name.

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "studies/crosscheck_options.hpp"
#include "studies/plane_options.hpp"
#include "studies/run_options.hpp"
#include "studies/sweep.hpp"
#include "studies/sweep_plan.hpp"
#include "studies/tolerance_options.hpp"
#include "wrong_options.hpp"

namespace epicyclic::studies::options_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

using test::expect_refused;
using test::Wrong;

Plane sound_plane() { return {{"x", 0, 1, 2}, {"y", 0, 1, 2}}; }

TEST(Options, AnAxisHasEndsThatRiseAndPointsBetweenThem) {
  using W = Wrong<Axis>;
  expect_refused<Axis>({"x", 0, 1, 2},
                       {W{"from", [](Axis& o) { o.from = nan; }}, W{"to", [](Axis& o) { o.to = infinity; }},
                        W{"to", [](Axis& o) { o.to = -1; }}, W{"points", [](Axis& o) { o.points = 0; }},
                        W{"points", [](Axis& o) { o.points = 1; }}, W{"points", [](Axis& o) { o.to = o.from; }}});
  EXPECT_NO_THROW((Axis{"x", 1, 1, 1}.validate()));
}

TEST(Options, ALookHasARecord) {
  using O = RecordingOptions;
  using W = Wrong<O>;
  expect_refused<O>(
      {},
      {W{"transient_periods", [](O& o) { o.transient_periods = -1; }},
       W{"recorded_periods", [](O& o) { o.recorded_periods = 0; }},
       W{"output_phases", [](O& o) { o.output_phases = 0; }}, W{"period_max", [](O& o) { o.period_max = 0; }},
       W{"recurrence_tolerance", [](O& o) { o.recurrence_tolerance = 0; }},
       W{"recurrence_tolerance", [](O& o) { o.recurrence_tolerance = nan; }},
       W{"classification_periods", [](O& o) { o.classification_periods = -1; }}, W{"classification_periods", [](O& o) {
                                                                                     o.transient = Transient::adaptive;
                                                                                     o.classification_periods = 0;
                                                                                   }}});
  O least = by_recurrence_alone({});
  least.transient_periods = 0;
  least.recorded_periods = least.output_phases = least.period_max = 1;
  EXPECT_NO_THROW(least.validate());
}

TEST(Options, SweepsMapsAndBasinsHaveAGrid) {
  using S = SweepOptions;
  expect_refused<S>({}, {{"points", [](S& o) { o.axis.points = 0; }},
                         {"directions", [](S& o) { o.directions.clear(); }},
                         {"segments", [](S& o) { o.segments = -1; }},
                         {"segments", [](S& o) { o.segments = o.axis.points + 1; }},
                         {"coarse_periods", [](S& o) { o.coarse_periods = 0; }},
                         {"output_phases", [](S& o) { o.recording.output_phases = 0; }}});
  using M = MapOptions;
  M map;
  map.plane = sound_plane();
  expect_refused<M>(map, {{"to", [](M& o) { o.plane.second.to = nan; }},
                          {"both axes", [](M& o) { o.plane.second.name = "x"; }},
                          {"directions", [](M& o) { o.directions.clear(); }},
                          {"period_max", [](M& o) { o.recording.period_max = -3; }}});
  using B = BasinsOptions;
  B basins;
  basins.plane = sound_plane();
  expect_refused<B>(basins, {{"points", [](B& o) { o.plane.first.points = -1; }},
                             {"recorded_periods", [](B& o) { o.recording.recorded_periods = 0; }}});
}

TEST(Options, StudiesOfAPointHaveMethodsAndTolerances) {
  using R = RunOptions;
  expect_refused<R>({}, {{"exponent_periods", [](R& o) { o.exponent_periods = -1; }},
                         {"dense_phases", [](R& o) { o.dense_phases = 0; }},
                         {"history_periods", [](R& o) { o.history_periods = 0; }},
                         {"spectrum_periods", [](R& o) { o.spectrum_periods = 0; }},
                         {"shown_periods", [](R& o) { o.shown_periods = 0; }},
                         {"check_tolerance", [](R& o) { o.check_tolerance = 0; }}});
  using C = CrosscheckOptions;
  expect_refused<C>({}, {{"methods", [](C& o) { o.methods.clear(); }},
                         {"clearance_smoothings",
                          [](C& o) {
                            o.clearance_smoothings = {0.1, -0.1};
                          }},
                         {"orbit_tolerance", [](C& o) { o.orbit_tolerance = nan; }},
                         {"continued_periods", [](C& o) { o.continued_periods = 0; }}});
  using T = ToleranceOptions;
  expect_refused<T>({}, {{"methods", [](T& o) { o.methods.clear(); }},
                         {"tolerances", [](T& o) { o.tolerances.clear(); }},
                         {"tolerances",
                          [](T& o) {
                            o.tolerances = {1e-6, 0.0};
                          }},
                         {"clearance_smoothings", [](T& o) { o.clearance_smoothings = {0.0}; }},
                         {"reference_tolerance", [](T& o) { o.reference_tolerance = -1; }},
                         {"target_error", [](T& o) { o.target_error = 0; }},
                         {"chaotic_periods", [](T& o) { o.chaotic_periods = 0; }}});
}

TEST(Options, PlansAreNotMadeOfWhatIsWrong) {
  SweepOptions sweep;
  sweep.axis.points = -5;
  EXPECT_THROW((void)plan_sweep(sweep), InputError);
  EXPECT_THROW((void)plan_map({}), InputError) << "two axes without names are one";
  EXPECT_THROW((void)plan_basins({}), InputError);
}

}  // namespace
}  // namespace epicyclic::studies::options_test
