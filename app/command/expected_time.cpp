#include "expected_time.hpp"

#include <fmt/format.h>

#include "input/study_model.hpp"

namespace epicyclic::app {

Expected expected_of(double seconds, const studies::Measured& m) {
  if (m.finished == m.points) return {seconds, 0.0, fmt::format("by what {} of its points took", m.points)};
  const double by_finished =
      m.finished == 0 ? 0.0 : seconds * static_cast<double>(m.points) / static_cast<double>(m.finished);
  return {by_finished, seconds,
          fmt::format("by what {} of {} points took that were tried for {:g} s", m.finished, m.points,
                      seconds_of(measured_for))};
}

Expected time_with_checks(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                          const TimeLimit& limit, const TimeAfterPoints& after, const char* without) {
  const studies::ModelAtPoint model_at = input::model_at_point(input);
  std::vector<studies::PointResult> points;
  std::optional<studies::SweepPlan> last;
  studies::SweepRun run;
  run.threads = threads;
  run.stop = &limit.over();
  // Half of the time for points; the rest is for the results after them.
  const auto m = studies::measure_miniatures(
      plan, studies::smallest_miniature(input.study.integrator, threads), seconds_of(measured_for) / 2.0, threads,
      [&](const studies::SweepPlan& miniature, studies::LaneUse& lanes) {
        run.lane_use = &lanes;
        auto computed =
            studies::run_sweep_in_memory(miniature, input.study.recording(), input.study.integrator, model_at, run);
        const std::size_t finished = computed.size();
        if (finished == miniature.points.size()) {
          last = miniature;
          points = std::move(computed);
        }
        return finished;
      });
  Expected expected =
      expected_of(studies::processor_seconds_of(plan, m, threads) / busy(plan.chains.size(), threads), m);
  if (!after || !last) return expected;
  if (const auto seconds = after(*last, points))
    expected.seconds += *seconds;
  else
    expected.measured += std::string(", without ") + without;
  return expected;
}

Expected time_of_points(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                        const TimeLimit& limit) {
  return time_with_checks(input, plan, threads, limit, {}, "");
}

}  // namespace epicyclic::app
