// epicyclic check: validates, prints the resolved input on stdout and its cost on stderr; writes nothing. How long it
// takes on this machine is measured: points spread over its ranges are computed as the study would compute them.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/text.hpp"
#include "input/added_kind.hpp"
#include "input/study_model.hpp"
#include "progress.hpp"
#include "reports/gear_report.hpp"
#include "reports/speed_words.hpp"
#include "session.hpp"
#include "stop.hpp"
#include "streams.hpp"
#include "studies/crosscheck.hpp"
#include "studies/probes.hpp"
#include "studies/run.hpp"
#include "studies/tolerance.hpp"

namespace epicyclic::app {

namespace {

/// Time that is spent on measuring, whatever the points take, and until it is given up where it does not look at the
/// clock: in a mesh period that takes minutes.
constexpr std::chrono::milliseconds measured_for{4000};
constexpr std::chrono::milliseconds given_up_after{4700};

/// Of a sweep's cross-check: two of each of two regimes.
constexpr int compared_at_most = 4;

/// Threads that have anything to do.
double busy(std::size_t units, int threads) {
  return static_cast<double>(std::min(units, static_cast<std::size_t>(threads)));
}

/// The time that measuring has. Work is done in a thread of its own, and left behind if it does not end.
class TimeLimit {
 public:
  TimeLimit() : clock_([this] { wait(); }) {}
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;
  ~TimeLimit() {
    {
      const std::scoped_lock lock(mutex_);
      unneeded_ = true;
    }
    changed_.notify_all();
    clock_.join();
  }

  /// Work that looks at this returns soon once it is true.
  [[nodiscard]] const std::atomic<bool>& over() const { return over_; }

  /// @returns nothing if it was left behind: then the program has to end by leave()
  template <class Work>
  [[nodiscard]] auto in_time(Work work) -> std::optional<decltype(work())> {
    std::packaged_task<decltype(work())()> task(std::move(work));
    auto result = task.get_future();
    std::thread worker(std::move(task));
    if (result.wait_until(begun_ + given_up_after) != std::future_status::ready) {
      worker.detach();
      left_behind_ = true;
      return std::nullopt;
    }
    worker.join();
    return result.get();
  }

  /// Ends the program at once if work was left behind, which still uses what main() would destroy.
  void leave() const {
    if (left_behind_) leave_at_once(done);
  }

 private:
  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, begun_ + measured_for, [this] { return unneeded_; });
    over_ = true;
  }

  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  std::atomic<bool> over_{false};
  bool left_behind_ = false;
  bool unneeded_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread clock_;
};

double seconds_of(std::chrono::duration<double> time) { return time.count(); }

/// How long a study takes, by what was measured of it.
struct Expected {
  double seconds = 0;
  double at_least = 0;     ///< if time was over before all that was to be measured was done; else 0
  std::string measured{};  ///< in words
};

/// Of points whose miniature was measured.
/// @param seconds  of all points, if those of the miniature were all done
Expected expected_of(double seconds, const studies::Measured& m) {
  if (m.finished == m.points) return {seconds, 0.0, fmt::format("by what {} of its points took", m.points)};
  const double by_finished =
      m.finished == 0 ? 0.0 : seconds * static_cast<double>(m.points) / static_cast<double>(m.finished);
  return {by_finished, seconds,
          fmt::format("by what {} of {} points took that were tried for {:g} s", m.finished, m.points,
                      seconds_of(measured_for))};
}

/// Of each method alone; what explaining differences takes is not known before.
Expected time_of_crosscheck(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                            const TimeLimit& limit) {
  const auto& asked = std::get<input::CrosscheckPlan>(input.study.plan);
  const studies::SweepOptions& sweep = asked.sweep;
  const auto& options = asked.crosscheck;
  const double width = input.study.model.clearance_smoothing;
  const auto variants = studies::crosscheck_variants(options, input.study.integrator, width);
  const auto model_at = input::smoothed_model_at(input);
  studies::SweepRun run;
  run.threads = threads;
  run.stop = &limit.over();
  const auto m = studies::measure_miniatures(
      plan, 1, seconds_of(measured_for), threads,
      [&](const studies::SweepPlan& miniature, studies::LaneUse& /*lanes*/) {
        std::size_t finished = miniature.points.size();
        for (const studies::Variant& v : variants)
          finished = std::min(finished, studies::run_sweep_in_memory(
                                            miniature, sweep.look, v.integrator,
                                            [&](double value) { return model_at(value, v.clearance_smoothing); }, run)
                                            .size());
        return finished;
      });
  return expected_of(studies::processor_seconds_of(plan, m, threads) / busy(plan.points.size(), threads), m);
}

/// Of a sweep's check of itself; nothing if time is over.
std::optional<double> seconds_of_check(const input::LoadedInput& input, const studies::SweepPlan& miniature,
                                       const std::vector<studies::PointResult>& points, int threads,
                                       const TimeLimit& limit) {
  studies::SweepOptions sweep = input.study.sweep();
  if (sweep.check.points == 0) return 0.0;
  const auto all = static_cast<std::size_t>(sweep.check.points);
  sweep.axis = miniature.grid.first;
  sweep.start = studies::Start::cold;  // single points have no neighbours to start from
  sweep.segments = 0;
  sweep.check.points = std::min(sweep.check.points, compared_at_most);
  const studies::PointSource source = studies::points_in_memory(points);
  const std::size_t chosen = studies::points_of_each_regime(sweep, source).size();
  if (chosen == 0) return 0.0;
  studies::CrosscheckRun run;
  run.threads = threads;
  run.stop = &limit.over();
  const double begun = studies::processor_seconds();
  (void)studies::run_check_of_sweep(sweep, source, input.study.integrator, input.study.model.clearance_smoothing,
                                    input::smoothed_model_at(input), run);
  if (limit.over()) return std::nullopt;
  const double spent = studies::processor_seconds() - begun;
  // Motions that are rare, and so not among these, are those whose differences have to be explained: measured, as much
  // again.
  constexpr double explaining = 2.0;
  return explaining * spent * static_cast<double>(all) / static_cast<double>(chosen) /
         busy(all * sweep.check.methods.size(), threads);
}

Expected time_of_points(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                        const TimeLimit& limit) {
  const studies::ModelAtPoint model_at = input::model_at_point(input);
  std::vector<studies::PointResult> points;
  std::optional<studies::SweepPlan> last;
  studies::SweepRun run;
  run.threads = threads;
  run.stop = &limit.over();
  // Half of the time for points; the rest is for the check of a sweep.
  const auto m = studies::measure_miniatures(
      plan, studies::smallest_miniature(input.study.integrator, threads), seconds_of(measured_for) / 2.0, threads,
      [&](const studies::SweepPlan& miniature, studies::LaneUse& lanes) {
        run.lane_use = &lanes;
        auto computed =
            studies::run_sweep_in_memory(miniature, input.study.look(), input.study.integrator, model_at, run);
        const std::size_t finished = computed.size();
        if (finished == miniature.points.size()) {
          last = miniature;
          points = std::move(computed);
        }
        return finished;
      });
  Expected expected =
      expected_of(studies::processor_seconds_of(plan, m, threads) / busy(plan.chains.size(), threads), m);
  if (input.study.kind() != "sweep" || !last) return expected;
  if (const auto check = seconds_of_check(input, *last, points, threads, limit))
    expected.seconds += *check;
  else
    expected.measured += ", without its cross-check";
  return expected;
}

/// Of one operating point, by as many mesh periods of its exponents as there is time for. Figures are not measured.
Expected time_of_run(const input::LoadedInput& input, const TimeLimit& limit) {
  const auto& [look, options] = std::get<input::RunPlan>(input.study.plan);
  const model::DynamicModel model = input::model_at(input)(input.study.mesh_frequency_ratio);
  const int all = exponent_intervals(options);
  const double begun = studies::processor_seconds();
  double exponents_begun = begun;
  double now = begun;
  int intervals = 0;
  studies::RunControl control;
  control.go_on = [&] { return !limit.over(); };
  control.at = [&](const char* /*what*/, int interval) {
    now = studies::processor_seconds();
    if (interval == 1) exponents_begun = now;  // the first one warms caches
    intervals = interval;
  };
  const bool whole = studies::run_operating_point(model, look, options, input.study.integrator, control).has_value();
  const double spent = studies::processor_seconds() - begun;
  if (whole) return {spent, 0.0, "by computing it"};
  if (intervals < 2) return {0.0, spent, "which did not suffice for what comes before its exponents"};
  const double each = (now - exponents_begun) / (intervals - 1);
  return {exponents_begun - begun + each * all, 0.0,
          fmt::format("by {} of {} mesh periods of its exponents", intervals, all)};
}

/// Of a ladder at each point: points spread over the study, in full where they are periodic; where they are not, the
/// statistics over fewer periods.
Expected time_of_tolerance(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                           const TimeLimit& limit) {
  const auto& asked = std::get<input::TolerancePlan>(input.study.plan);
  const studies::SweepOptions& sweep = asked.sweep;
  const auto& options = asked.tolerance;
  constexpr int few = 60;
  studies::ToleranceOptions fewer = options;
  fewer.chaotic_periods = std::min(options.chaotic_periods, few);
  const double longer = static_cast<double>(studies::aligning_periods + options.chaotic_periods) /
                        (studies::aligning_periods + fewer.chaotic_periods);
  const double width = input.study.model.clearance_smoothing;
  const auto model_at = input::smoothed_model_at(input);
  studies::SweepRun run;
  run.threads = threads;
  run.stop = &limit.over();
  double own = 0.0;     // of the study's points, in chains
  double ladder = 0.0;  // of what is measured on them, a point after the other
  const auto m = studies::measure_miniatures(
      plan, 2, seconds_of(measured_for), threads,
      [&](const studies::SweepPlan& miniature, studies::LaneUse& /*lanes*/) {
        double begun = studies::processor_seconds();
        const auto spent = [&begun] {
          const double before = begun;
          begun = studies::processor_seconds();
          return begun - before;
        };
        const auto points = studies::run_sweep_in_memory(
            miniature, sweep.look, input.study.integrator, [&](double value) { return model_at(value, width); }, run);
        const double of_points = spent();
        double of_ladder = 0.0;
        std::size_t finished = 0;
        for (const studies::PointResult& point : points) {
          const studies::TolerancePoint t = studies::compute_tolerance_point(
              point, sweep.look, fewer, input.study.integrator, width, model_at, threads, &limit.over());
          of_ladder += (t.statistics.empty() ? 1.0 : longer) * spent();
          if (!limit.over()) ++finished;
        }
        if (own == 0.0 || finished == miniature.points.size()) {
          own = of_points;
          ladder = of_ladder;
        }
        return finished;
      });
  const double all = static_cast<double>(plan.points.size()) / static_cast<double>(m.points);
  return expected_of(all * (own / busy(plan.chains.size(), threads) + ladder / threads), m);
}

/// How long it takes, in words.
std::string time_of(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                    const TimeLimit& limit) {
  const std::string_view kind = input.study.kind();
  const Expected expected = kind == "run"          ? time_of_run(input, limit)
                            : kind == "crosscheck" ? time_of_crosscheck(input, plan, threads, limit)
                            : kind == "tolerance"  ? time_of_tolerance(input, plan, threads, limit)
                                                   : time_of_points(input, plan, threads, limit);
  std::string text;
  if (expected.at_least > 0.0) text = "more than " + duration_text(expected.at_least);
  if (expected.seconds > 0.0) text += (text.empty() ? "about " : ", perhaps ") + duration_text(expected.seconds);
  const int used = kind == "run" ? 1 : threads;
  return fmt::format("{} on {} of this machine{}, {}", text, used == 1 ? "1 thread" : fmt::format("{} threads", used),
                     kind == "run" ? ", and its figures" : "", expected.measured);
}

/// The speeds of the study's points as people know them, and what of the stage decides how much is excited there.
void tell_operation(const input::LoadedInput& input) {
  double from = input.study.mesh_frequency_ratio;
  double to = from;
  for (const auto& [axis, place] : input::varied_parameters(input.study))
    if (axis.name == studies::speed_parameter) {
      from = axis.from;
      to = axis.to;
    }
  const auto words = [&](double ratio) {
    return fmt::format("mesh frequency ratio {}: {}", short_text(ratio, 6),
                       reports::speed_words(input.study.stage, ratio));
  };
  tell("speed: {}\n", words(from));
  if (to != from) tell("    to {}\n", words(to));
  // The load may go with the speed.
  const std::string error = reports::error_words(input.study.stage, from);
  tell("{}\n", error);
  if (const std::string other = reports::error_words(input.study.stage, to); other != error)
    tell("    at the last speed: {}\n", other);
  for (const std::string& line : input::stiffness_notes(input)) tell("mesh stiffness: {}\n", line);
}

}  // namespace

int check_command(const Arguments& arguments) {
  const input::LoadedInput input = input::load_input(arguments.input, input::parse_assignments(arguments.sets));
  tell_warnings(input);
  if (!input.study.has_motion()) {
    print("{}\n", input.resolved.dump(2));
    tell("{}: valid; a stage alone, for `epicyclic gear`\n", arguments.input.string());
    return done;
  }
  if (const auto* added = std::get_if<input::AddedPlan>(&input.study.plan)) {
    const std::string cost = added->kind->cost(input);
    print("{}\n", input.resolved.dump(2));
    tell("{}: valid\ncost: {}\n", arguments.input.string(), cost);
    tell_operation(input);
    return done;
  }
  if (!input.study.has_points()) {
    print("{}\n", input.resolved.dump(2));
    tell("{}: valid\ncost: that of branches is not known before they are followed; `orbits` and `branches` bound it\n",
         arguments.input.string());
    tell_operation(input);
    return done;
  }
  const studies::SweepPlan plan = input::plan_of(input.study);
  print("{}\n", input.resolved.dump(2));
  tell("{}: valid\n", arguments.input.string());
  TimeLimit limit;
  const studies::LookOptions& look = input.study.look();
  const auto cost = limit.in_time([&] {
    return studies::estimate_cost(plan, look, input.study.integrator, input::model_at_point(input),
                                  [&] { return !limit.over(); });
  });
  tell("cost: {} points in {} chains, {} mesh periods{}{}\n", plan.points.size(), plan.chains.size(),
       studies::mesh_periods_of(plan, look),
       cost && !limit.over() ? fmt::format(", {} state variables, about {:.2g} right-hand sides", cost->dimension,
                                           cost->rhs_evaluations())
                             : "; few mesh periods take longer than this waits for",
       look.classification_periods > 0 ? " and what it takes to tell the regimes" : "");
  tell_operation(input);
  if (!arguments.no_time && cost) {
    const auto time = limit.in_time([&] { return time_of(input, plan, arguments.threads, limit); });
    tell("time: {}\n", time.value_or("not known: nothing that was tried came to an end in time"));
  }
  limit.leave();
  return done;
}

}  // namespace epicyclic::app
