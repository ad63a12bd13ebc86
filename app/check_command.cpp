// epicyclic check: validates, prints the resolved input on stdout and its cost on stderr; writes nothing. How long it
// takes on this machine is measured: points spread over its ranges are computed as the study would compute them.

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "claims.hpp"
#include "commands.hpp"
#include "core/text.hpp"
#include "input/study_model.hpp"
#include "progress.hpp"
#include "reports/speed_words.hpp"
#include "session.hpp"
#include "streams.hpp"
#include "studies/calibration.hpp"
#include "studies/crosscheck.hpp"
#include "studies/probes.hpp"
#include "studies/run.hpp"
#include "studies/tolerance.hpp"

namespace epicyclic::app {

namespace {

/// Time that is spent on measuring, of each thread, if points are not slower than that.
constexpr double measured_for = 4.0;
/// Of a sweep's cross-check: two of each of two regimes.
constexpr int compared_at_most = 4;

/// Threads that have anything to do.
double busy(std::size_t units, int threads) {
  return static_cast<double>(std::min(units, static_cast<std::size_t>(threads)));
}

/// Of each method alone; what explaining differences takes is not known before.
double seconds_of_crosscheck(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                             std::size_t& measured) {
  const auto& asked = std::get<input::CrosscheckPlan>(input.study.plan);
  const studies::SweepOptions& sweep = asked.sweep;
  const auto& options = asked.crosscheck;
  const double width = input.study.model.clearance_smoothing;
  const auto variants = studies::crosscheck_variants(options, input.study.integrator, width);
  const auto model_at = input::smoothed_model_at(input);
  studies::SweepRun run;
  run.threads = threads;
  const auto m = studies::measure_miniatures(
      plan, 1, measured_for, threads, [&](const studies::SweepPlan& miniature, studies::LaneUse& /*lanes*/) {
        for (const studies::Variant& v : variants)
          (void)studies::run_sweep_in_memory(
              miniature, sweep.look, v.integrator, [&](double value) { return model_at(value, v.clearance_smoothing); },
              run);
      });
  measured = m.points;
  return studies::processor_seconds_of(plan, m, threads) / busy(plan.points.size(), threads);
}

/// Of a sweep's check of itself.
double seconds_of_check(const input::LoadedInput& input, const studies::SweepPlan& miniature,
                        const std::vector<studies::PointResult>& points, int threads) {
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
  const double begun = studies::processor_seconds();
  (void)studies::run_check_of_sweep(sweep, source, input.study.integrator, input.study.model.clearance_smoothing,
                                    input::smoothed_model_at(input), run);
  const double spent = studies::processor_seconds() - begun;
  // Motions that are rare, and so not among these, are those whose differences have to be explained: measured, as much
  // again.
  constexpr double explaining = 2.0;
  return explaining * spent * static_cast<double>(all) / static_cast<double>(chosen) /
         busy(all * sweep.check.methods.size(), threads);
}

double seconds_of_points(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                         std::size_t& measured) {
  const studies::ModelAtPoint model_at = input::model_at_point(input);
  std::vector<studies::PointResult> points;
  std::optional<studies::SweepPlan> last;
  studies::SweepRun run;
  run.threads = threads;
  const auto m = studies::measure_miniatures(
      plan, studies::smallest_miniature(input.study.integrator, threads), measured_for, threads,
      [&](const studies::SweepPlan& miniature, studies::LaneUse& lanes) {
        last = miniature;
        run.lane_use = &lanes;
        points = studies::run_sweep_in_memory(miniature, input.study.look(), input.study.integrator, model_at, run);
      });
  measured = m.points;
  double seconds = studies::processor_seconds_of(plan, m, threads) / busy(plan.chains.size(), threads);
  if (input.study.kind() == "sweep") seconds += seconds_of_check(input, *last, points, threads);
  return seconds;
}

/// Of one operating point: computed with its exponents over few mesh periods, twice, whose difference is what a period
/// of exponents takes. Tables and figures are not measured.
double seconds_of_run(const input::LoadedInput& input) {
  const auto& [look, options] = std::get<input::RunPlan>(input.study.plan);
  const model::DynamicModel model = input::model_at(input)(input.study.mesh_frequency_ratio);
  const auto seconds_with = [&, &look = look, &options = options](int exponent_periods) {
    studies::RunOptions fewer = options;
    fewer.exponent_periods = exponent_periods;
    const double begun = studies::processor_seconds();
    (void)studies::run_operating_point(model, look, fewer, input.study.integrator);
    return studies::processor_seconds() - begun;
  };
  constexpr int few = 40;
  constexpr int more = 160;
  const int all = options.exponent_periods;
  if (all <= more) return seconds_with(all);
  const double with_more = seconds_with(more);
  const double per_period = std::max(0.0, with_more - seconds_with(few)) / (more - few);
  return with_more + per_period * (all - more);
}

/// Of a ladder at each point: points spread over the study, in full where they are periodic; where they are not, the
/// statistics over fewer periods.
double seconds_of_tolerance(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                            std::size_t& measured) {
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
  double own = 0.0;     // of the study's points, in chains
  double ladder = 0.0;  // of what is measured on them, a point after the other
  const auto m = studies::measure_miniatures(
      plan, 2, measured_for, threads, [&](const studies::SweepPlan& miniature, studies::LaneUse& /*lanes*/) {
        double begun = studies::processor_seconds();
        const auto spent = [&begun] {
          const double before = begun;
          begun = studies::processor_seconds();
          return begun - before;
        };
        const auto points = studies::run_sweep_in_memory(
            miniature, sweep.look, input.study.integrator, [&](double value) { return model_at(value, width); }, run);
        own = spent();
        ladder = 0.0;
        for (const studies::PointResult& point : points) {
          const studies::TolerancePoint t = studies::compute_tolerance_point(
              point, sweep.look, fewer, input.study.integrator, width, model_at, threads, nullptr);
          ladder += (t.statistics.empty() ? 1.0 : longer) * spent();
        }
      });
  measured = m.points;
  const double all = static_cast<double>(plan.points.size()) / static_cast<double>(m.points);
  return all * (own / busy(plan.chains.size(), threads) + ladder / threads);
}

/// How long it takes, in words.
std::string time_of(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads) {
  const std::string_view kind = input.study.kind();
  if (kind == "run")
    return fmt::format("about {} on 1 thread of this machine, and its figures", duration_text(seconds_of_run(input)));
  std::size_t measured = 0;
  const double seconds = kind == "crosscheck"  ? seconds_of_crosscheck(input, plan, threads, measured)
                         : kind == "tolerance" ? seconds_of_tolerance(input, plan, threads, measured)
                                               : seconds_of_points(input, plan, threads, measured);
  return fmt::format("about {} on {} of this machine, by what {} of its points took", duration_text(seconds),
                     threads == 1 ? "1 thread" : fmt::format("{} threads", threads), measured);
}

/// The speeds of the study's points as people know them.
void tell_speeds(const input::LoadedInput& input) {
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
  if (const auto* claims = std::get_if<studies::ClaimsOptions>(&input.study.plan)) {
    require_models(*claims, input::claim_models(input));
    if (claims->space.dimension() > 0)
      examine_candidates(*claims,
                         input::candidate_models(arguments.input, input::parse_assignments(arguments.sets), *claims));
    print("{}\n", input.resolved.dump(2));
    tell("{}: valid\ncost: {} claims on {} sweeps; a search tries up to {} candidates\n", arguments.input.string(),
         claims->claims.size(), claims->sweeps.size(), studies::most_evaluations(*claims));
    return done;
  }
  if (!input.study.has_points()) {
    print("{}\n", input.resolved.dump(2));
    tell("{}: valid\ncost: that of branches is not known before they are followed; `orbits` and `branches` bound it\n",
         arguments.input.string());
    return done;
  }
  const studies::SweepPlan plan = input::plan_of(input.study);
  const studies::Cost cost =
      studies::estimate_cost(plan, input.study.look(), input.study.integrator, input::model_at_point(input));
  print("{}\n", input.resolved.dump(2));
  tell(
      "{}: valid\n"
      "cost: {} points in {} chains, {} mesh periods, {} state variables, about {:.2g} right-hand sides{}\n",
      arguments.input.string(), cost.points, cost.chains, cost.mesh_periods, cost.dimension, cost.rhs_evaluations(),
      input.study.look().classification_periods > 0 ? " and what it takes to tell the regimes" : "");
  tell_speeds(input);
  if (!arguments.no_time) tell("time: {}\n", time_of(input, plan, arguments.threads));
  return done;
}

}  // namespace epicyclic::app
