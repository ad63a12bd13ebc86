// epicyclic tolerance: the points of a study, then each one's answer against tolerance, method and smoothing.

#include <algorithm>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "expected_time.hpp"
#include "finished_study.hpp"
#include "folder.hpp"
#include "input/study_model.hpp"
#include "kind_commands.hpp"
#include "kinds/tolerance/output.hpp"
#include "kinds/tolerance/plan.hpp"
#include "progress.hpp"
#include "session.hpp"
#include "stop.hpp"
#include "store/journal.hpp"
#include "store/point_record.hpp"
#include "streams.hpp"
#include "studies/cost_estimate.hpp"

namespace epicyclic::app {

namespace {

/// Of earlier sessions: the study's own points, and the measurements on them.
struct Known {
  std::map<std::size_t, studies::PointResult> points;
  std::map<std::size_t, studies::TolerancePoint> measured;
};

/// Record k < n is the study's own point k, record n + k the measurement on it.
Known known_results(const store::Journal& journal, const studies::SweepPlan& plan) {
  const std::size_t n = plan.points.size();
  std::vector<store::JournalEntry> entries = journal.entries();
  const auto measurements = std::stable_partition(entries.begin(), entries.end(),
                                                  [&](const store::JournalEntry& entry) { return entry.point < n; });
  Known known;
  for (auto entry = measurements; entry != entries.end(); ++entry) {
    studies::TolerancePoint point = store::decode_tolerance_point(journal.read(*entry));
    const std::size_t index = point.point.index;
    if (index >= n || entry->point != n + index)
      throw store::DamagedData("the journal holds measurement " + std::to_string(entry->point) +
                               ", which the study has not");
    known.measured.insert_or_assign(index, std::move(point));
  }
  known.points = known_points(journal, {entries.begin(), measurements}, plan);
  return known;
}

/// Measurements on the study's points, until a stop is requested. Those of earlier sessions are kept, the rest are
/// made.
/// @param measure   one point
/// @param finished  called for each new measurement
std::vector<studies::TolerancePoint> measured_points(
    const std::vector<studies::PointResult>& studied, std::map<std::size_t, studies::TolerancePoint> earlier,
    const std::function<studies::TolerancePoint(const studies::PointResult&)>& measure,
    const std::function<void(const studies::TolerancePoint&)>& finished) {
  std::vector<studies::TolerancePoint> points;
  for (const studies::PointResult& result : studied) {
    if (stop_requested()) break;
    if (const auto known = earlier.find(result.point.index); known != earlier.end()) {
      points.push_back(std::move(known->second));
      continue;
    }
    studies::TolerancePoint point = measure(result);
    if (stop_requested()) break;  // parts of it may be missing
    finished(point);
    points.push_back(std::move(point));
  }
  return points;
}

/// Results of a session and of those before it.
struct Measured {
  std::vector<studies::PointResult> studied;    ///< the study's own points
  std::vector<studies::TolerancePoint> points;  ///< the measurements on them; fewer if a stop was requested
  std::size_t failed = 0;
};

/// Computes the records that the journal does not have, and keeps them there.
Measured measure_missing(const Arguments& arguments, Session& session, const input::LoadedInput& input,
                         const kinds::TolerancePlan& tolerance, const studies::SweepPlan& plan,
                         const studies::SmoothedModelAt& model_at) {
  const double width = input.study.model.clearance_smoothing;
  store::Journal journal(session.folder().file("journal.bin"), session.identity());
  report_cut_tail(session.folder().file("journal.bin"), journal.cut_bytes());
  Known earlier = known_results(journal, plan);
  studies::SweepRun run;
  run.threads = arguments.threads;
  run.stop = &stop_requested();
  std::size_t finished = earlier.points.size() + earlier.measured.size();
  Measured all;
  const auto count_failure = [&](const studies::PointResult& r) {
    all.failed += r.outcome == integrate::Outcome::reached ? 0 : 1;
  };
  for (const auto& [index, result] : earlier.points) count_failure(result);
  const std::size_t total = 2 * plan.points.size();
  Progress progress("tolerance", total, finished);
  progress.update(finished, all.failed);
  run.point_finished = [&](const studies::PointResult& result) {
    journal.append(result.point.index, store::encode_point(result));
    count_failure(result);
    progress.update(++finished, all.failed);
  };
  all.studied = studies::run_sweep_in_memory(
      plan, tolerance.sweep.recording, input.study.integrator, [&](double value) { return model_at(value, width); },
      std::move(run), std::move(earlier.points));
  const auto measure = [&](const studies::PointResult& result) {
    return studies::compute_tolerance_point(result, tolerance.sweep.recording, tolerance.tolerance,
                                            input.study.integrator, width, model_at, arguments.threads,
                                            &stop_requested());
  };
  all.points =
      measured_points(all.studied, std::move(earlier.measured), measure, [&](const studies::TolerancePoint& point) {
        journal.append(plan.points.size() + point.point.index, store::encode_tolerance_point(point));
        progress.update(++finished, all.failed);
      });
  journal.close();
  progress.finish();
  return all;
}

/// On stdout.
void print_result(const Arguments& arguments, const store::OutputFolder& folder, double target_error,
                  std::size_t studied, std::size_t failed, const std::vector<studies::TolerancePoint>& points,
                  std::size_t dimension, const std::string& summary, const std::vector<reports::DrawnFigure>& figures) {
  nlohmann::json result = {{"folder", folder.path().string()},
                           {"points", studied},
                           {"failed", failed},
                           {"figures", nlohmann::json::array()}};
  for (const reports::DrawnFigure& figure : figures)
    if (figure.outcome.drawn()) result["figures"].push_back(figure.file.string());
  if (const auto best = studies::recommend(points, dimension, target_error))
    result["recommendation"] = {{"method", best->method}, {"relative_tolerance", best->tolerance}};
  if (arguments.json) {
    print("{}\n", result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print("{}\n", summary);
    for (const auto& figure : result["figures"]) print("figure: {}\n", figure.get<std::string>());
  }
}

/// Time of all methods and tolerances at each point, from points spread over the study. Periodic points are measured in
/// full, other points by the statistics over fewer periods.
Expected time_of_tolerance(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                           const TimeLimit& limit) {
  const auto& study_plan = input.study.plan.as<kinds::TolerancePlan>();
  const studies::SweepOptions& sweep = study_plan.sweep;
  const auto& options = study_plan.tolerance;
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
  double ladder = 0.0;  // of the measurements on them, one point after the other
  const auto m = studies::measure_miniatures(plan, 2, seconds_of(measured_for), threads,
                                             [&](const studies::SweepPlan& miniature, studies::LaneUse& /*lanes*/) {
                                               double begun = studies::processor_seconds();
                                               const auto spent = [&begun] {
                                                 const double before = begun;
                                                 begun = studies::processor_seconds();
                                                 return begun - before;
                                               };
                                               const auto points = studies::run_sweep_in_memory(
                                                   miniature, sweep.recording, input.study.integrator,
                                                   [&](double value) { return model_at(value, width); }, run);
                                               const double of_points = spent();
                                               double of_ladder = 0.0;
                                               std::size_t finished = 0;
                                               for (const studies::PointResult& point : points) {
                                                 const studies::TolerancePoint t = studies::compute_tolerance_point(
                                                     point, sweep.recording, fewer, input.study.integrator, width,
                                                     model_at, threads, &limit.over());
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

int run_tolerance(const Arguments& arguments) {
  const input::LoadedInput input = with_start(arguments, "tolerance");
  const auto tolerance = plan_with_points<kinds::TolerancePlan>(input, arguments, "tolerance");
  const auto& [sweep, options] = tolerance;
  const studies::SweepPlan plan = studies::plan_sweep(sweep);
  const auto model_at = input::smoothed_model_at(input);
  const double width = input.study.model.clearance_smoothing;
  const model::DynamicModel first_model = model_at(plan.points.front().value, width);
  print_warnings(input);

  Session session(arguments, input, identity_of(input, "tolerance"), arguments.threads);
  if (const auto code = session.exit_code()) return *code;
  const store::OutputFolder& folder = session.folder();

  const Measured measured = measure_missing(arguments, session, input, tolerance, plan, model_at);
  const auto& [studied, points, failed] = measured;
  std::int64_t undrawn = 0;
  const auto close_run = [&](store::RunState state) {
    session.end(state, {{"points", static_cast<std::int64_t>(plan.points.size())},
                        {"failed", static_cast<std::int64_t>(measured.failed)},
                        {"undrawn", undrawn}});
  };
  if (stop_requested()) {
    close_run(store::RunState::stopped);
    print_message("stopped after {} of {} points; re-run the same command to resume\n", points.size(),
                  plan.points.size());
    return stopped_early;
  }

  folder.require_there();
  const kinds::ToleranceOutput output{{sweep, studies::poincare_columns(first_model), session.resolved(),
                                       reports::figure_title(input.study), input.study.axis_speed},
                                      options,
                                      input.study.integrator,
                                      first_model.dimension};
  reports::write_points_csv(folder.file("points.csv"), studies::points_in_memory(studied));
  const std::string summary = kinds::write_tolerance_tables(folder.path(), output, points);
  const auto figures = kinds::draw_tolerance_figures(folder.file("figures"), output, points);
  undrawn = report_undrawn(figures);
  close_run(store::RunState::complete);

  print_result(arguments, folder, options.target_error, plan.points.size(), failed, points, first_model.dimension,
               summary, figures);
  return failed == 0 && undrawn == 0 ? done : done_with_failures;
}

}  // namespace

const Command& tolerance_command() {
  static const Command command = {
      .name = "tolerance",
      .meaning = "compare results over tolerance, clearance smoothing and method, with error bars",
      .run = &run_tolerance,
      .takes = Takes::output,
      .options = &add_start_option,
      .expected = &time_of_tolerance,
  };
  return command;
}

}  // namespace epicyclic::app
