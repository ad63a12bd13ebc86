// epicyclic crosscheck: the points of a study by several methods, compared, differences explained.

#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/errors.hpp"
#include "expected_time.hpp"
#include "finished_study.hpp"
#include "folder.hpp"
#include "input/study_model.hpp"
#include "kind_commands.hpp"
#include "kinds/crosscheck/output.hpp"
#include "kinds/crosscheck/plan.hpp"
#include "progress.hpp"
#include "session.hpp"
#include "stop.hpp"
#include "store/journal.hpp"
#include "store/point_record.hpp"
#include "streams.hpp"
#include "studies/cost_estimate.hpp"

namespace epicyclic::app {

namespace {

/// Of earlier sessions: results by variant and point. Record v n + k is point k < n by variant v.
std::map<std::pair<std::size_t, std::size_t>, studies::PointResult> known_results(const store::Journal& journal,
                                                                                  std::size_t points,
                                                                                  std::size_t variants) {
  std::map<std::pair<std::size_t, std::size_t>, studies::PointResult> known;
  for (const store::JournalEntry& entry : journal.entries()) {
    studies::PointResult result = store::decode_point(journal.read(entry));
    const std::size_t variant = entry.point / points;
    if (variant >= variants || result.point.index != entry.point % points)
      throw store::DamagedData("the journal holds result " + std::to_string(entry.point) + ", which the study has not");
    known.insert_or_assign({variant, result.point.index}, std::move(result));
  }
  return known;
}

/// Files for readers of the folder.
struct Written {
  std::string summary;
  reports::DrawnFigure figure;
};

Written write_results(const store::OutputFolder& folder, const reports::SweepOutput& output,
                      const studies::Crosscheck& all, double orbit_tolerance) {
  const studies::PointSource reference = studies::points_in_memory(all.reference);
  reports::write_points_csv(folder.file("points.csv"), reference);
  reports::write_poincare_csv(folder.file("poincare.csv"), output, reference);
  kinds::write_crosscheck_csv(folder.file("crosscheck.csv"), all);
  std::string summary = kinds::crosscheck_summary(reports::axis_words(output.sweep.axis.name, output.speed), all);
  write_file_atomically(folder.file("crosscheck.md"), summary);
  return {std::move(summary), kinds::draw_crosscheck_figure(folder.file("figures"), output, all, orbit_tolerance)};
}

/// On stdout.
void print_result(const Arguments& arguments, const store::OutputFolder& folder, std::size_t points, std::size_t failed,
                  const studies::Crosscheck& all, const Written& written) {
  if (arguments.json) {
    print("{}\n", nlohmann::json{{"folder", folder.path().string()},
                                 {"points", points},
                                 {"comparisons", all.comparisons.size()},
                                 {"differences", kinds::differences(all)},
                                 {"failed", failed}}
                      .dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print("{}", written.summary);
    if (written.figure.outcome.drawn()) print("\nfigure: {}\n", written.figure.file.string());
  }
}

/// Of each method alone; the time to explain differences is not known before.
Expected time_of_crosscheck(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                            const TimeLimit& limit) {
  const auto& study_plan = input.study.plan.as<kinds::CrosscheckPlan>();
  const studies::SweepOptions& sweep = study_plan.sweep;
  const auto& options = study_plan.crosscheck;
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
                                            miniature, sweep.recording, v.integrator,
                                            [&](double value) { return model_at(value, v.clearance_smoothing); }, run)
                                            .size());
        return finished;
      });
  return expected_of(studies::processor_seconds_of(plan, m, threads) / busy(plan.points.size(), threads), m);
}

int run_crosscheck(const Arguments& arguments) {
  const input::LoadedInput input = with_start(arguments, "crosscheck");
  const auto [sweep, options] = plan_with_points<kinds::CrosscheckPlan>(input, arguments, "crosscheck");
  const studies::SweepPlan plan = studies::plan_sweep(sweep);
  const auto model_at = input::smoothed_model_at(input);
  const double width = input.study.model.clearance_smoothing;
  const model::DynamicModel first_model = model_at(plan.points.front().value, width);
  const std::vector<studies::Variant> variants = studies::crosscheck_variants(options, input.study.integrator, width);
  print_warnings(input);

  Session session(arguments, input, identity_of(input, "crosscheck"), arguments.threads);
  if (const auto code = session.exit_code()) return *code;
  const store::OutputFolder& folder = session.folder();

  const std::size_t points = plan.points.size();
  store::Journal journal(folder.file("journal.bin"), session.identity());
  report_cut_tail(folder.file("journal.bin"), journal.cut_bytes());
  studies::CrosscheckRun run;
  run.threads = arguments.threads;
  run.stop = &stop_requested();
  run.done = known_results(journal, points, variants.size());
  std::size_t finished = run.done.size();
  std::size_t failed = 0;
  for (const auto& [key, result] : run.done) failed += result.outcome == integrate::Outcome::reached ? 0 : 1;
  Progress progress("crosscheck", points * variants.size(), finished);
  progress.update(finished, failed);
  run.point_finished = [&](std::size_t variant, const studies::PointResult& result) {
    journal.append(variant * points + result.point.index, store::encode_point(result));
    failed += result.outcome == integrate::Outcome::reached ? 0 : 1;
    progress.update(++finished, failed);
  };
  const studies::Crosscheck all =
      studies::run_crosscheck(plan, sweep.recording, options, input.study.integrator, width, model_at, run);
  progress.finish();
  journal.close();
  std::int64_t undrawn = 0;
  const auto close_run = [&](store::RunState state) {
    session.end(state, {{"points", static_cast<std::int64_t>(points)},
                        {"comparisons", static_cast<std::int64_t>(all.comparisons.size())},
                        {"failed", static_cast<std::int64_t>(failed)},
                        {"undrawn", undrawn},
                        {"differences", static_cast<std::int64_t>(kinds::differences(all))}});
  };
  if (!all.complete(points)) {
    close_run(store::RunState::stopped);
    print_message("stopped after {} of {} results; re-run the same command to resume\n", finished,
                  points * variants.size());
    return stopped_early;
  }

  folder.require_there();
  const reports::SweepOutput output{sweep, studies::poincare_columns(first_model), session.resolved(),
                                    reports::figure_title(input.study), input.study.axis_speed};
  const Written written = write_results(folder, output, all, options.orbit_tolerance);
  undrawn = report_undrawn({written.figure});
  close_run(store::RunState::complete);

  print_result(arguments, folder, points, failed, all, written);
  return kinds::differences(all) == 0 && failed == 0 && undrawn == 0 ? done : done_with_failures;
}

}  // namespace

const Command& crosscheck_command() {
  static const Command command = {
      .name = "crosscheck",
      .meaning = "compute the same points by several methods and compare them",
      .run = &run_crosscheck,
      .takes = Takes::output,
      .options = &add_start_option,
      .expected = &time_of_crosscheck,
  };
  return command;
}

}  // namespace epicyclic::app
