// epicyclic sweep: computes what is missing, journals each point, then writes tables, HDF5 and figures.

#include <cstdio>
#include <map>
#include <string>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "folder.hpp"
#include "io/journal.hpp"
#include "io/point_record.hpp"
#include "io/progress.hpp"
#include "io/study_model.hpp"
#include "io/sweep_output.hpp"
#include "stop.hpp"

namespace epicyclic::app {

namespace {

bool computed(const studies::PointResult& r) { return r.outcome == integrate::Outcome::reached; }

}  // namespace

int sweep_command(const Arguments& arguments) {
  stop_on_signals();
  const io::LoadedInput input = io::load_input(arguments.input, io::parse_assignments(arguments.sets));
  require_points(input, arguments, "sweep");
  const studies::SweepOptions& sweep = *input.study.sweep;
  const studies::SweepPlan plan = studies::plan_sweep(sweep);
  const studies::ModelAt model_at = io::model_at(input);
  // Options that do not fit show here, before anything is written.
  const model::DynamicModel first_model = model_at(plan.points.front().value);

  for (const std::string& warning : io::warnings(input)) fmt::print(stderr, "{}\n", warning);
  if (sweep.parameter != "mesh_frequency_ratio")
    fmt::print(stderr, "operation: mesh_frequency_ratio = {}\n", input.study.mesh_frequency_ratio);

  const io::OutputFolder folder(arguments.output, io::identity(input, "sweep"));
  if (const auto code = refuse_or_finish(folder)) return *code;
  io::Provenance facts = provenance(arguments.threads);
  const std::string resolved = write_inputs(folder, input);
  folder.write_run(io::RunState::running, io::run_facts(facts));

  io::Journal journal(folder.file("journal.bin"), io::identity(input, "sweep"));
  studies::SweepRun run;
  run.threads = arguments.threads;
  run.stop = &stop_requested();
  run.done = known_points(journal.take_records(), plan);
  std::size_t finished = run.done.size();
  std::size_t failed = 0;
  for (const auto& [index, result] : run.done) failed += computed(result) ? 0 : 1;
  if (finished > 0)
    fmt::print(stderr, "{}: {} of {} points were there already\n", folder.path().string(), finished,
               plan.points.size());

  io::Progress progress("sweep", plan.points.size(), finished);
  progress.update(finished, failed);
  run.point_finished = [&](const studies::PointResult& result) {
    journal.append(result.point.index, io::encode_point(result));
    failed += computed(result) ? 0 : 1;
    progress.update(++finished, failed);
  };
  const std::vector<studies::PointResult> results =
      studies::run_sweep(plan, sweep, input.study.integrator, model_at, std::move(run));
  progress.finish();
  journal.close();

  const auto close_run = [&](io::RunState state) {
    facts.ended = io::utc_now();
    facts.counts = {{"points", static_cast<std::int64_t>(plan.points.size())},
                    {"computed", static_cast<std::int64_t>(results.size())},
                    {"failed", static_cast<std::int64_t>(failed)}};
    folder.write_run(state, io::run_facts(facts));
  };
  if (results.size() < plan.points.size()) {
    close_run(io::RunState::stopped);
    fmt::print(stderr, "stopped after {} of {} points; the same command goes on\n", results.size(), plan.points.size());
    return stopped_early;
  }

  const io::SweepOutput output{sweep, studies::poincare_columns(first_model), resolved, io::figure_title(input.study)};
  io::write_points_csv(folder.file("points.csv"), results);
  io::write_poincare_csv(folder.file("poincare.csv"), output, results);
  io::write_results_h5(folder.file("results.h5"), output, results);
  const std::vector<io::DrawnFigure> figures = io::draw_sweep_figures(folder.file("figures"), output, results);
  close_run(io::RunState::complete);

  std::map<std::string, std::size_t> regimes;
  std::size_t settling = 0;
  for (const studies::PointResult& r : results) {
    if (!computed(r)) continue;
    ++regimes[to_string(r.regime)];
    const bool recurs_late = !r.classified && r.regime == analysis::Regime::undecided &&
                             analysis::still_settling(r.recurrence, sweep.recurrence_tolerance);
    settling += recurs_late ? 1 : 0;
  }
  if (settling > 0)
    fmt::print(stderr,
               "{} undecided points were still settling (recurrence_error_late below recurrence_error): "
               "/study/classification_periods > 0, or a larger /study/transient_periods, decides them\n",
               settling);

  nlohmann::json summary = {{"folder", folder.path().string()},
                            {"points", plan.points.size()},
                            {"failed", failed},
                            {"regimes", regimes},
                            {"figures", nlohmann::json::array()}};
  for (const io::DrawnFigure& figure : figures) {
    if (figure.outcome.drawn())
      summary["figures"].push_back(figure.png.string());
    else
      fmt::print(stderr, "{} was not drawn: {}\n", figure.png.string(), figure.outcome.message);
  }
  if (arguments.json) {
    fmt::print("{}\n", summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    fmt::print("{} points, {} failed, in {}\n", plan.points.size(), failed, folder.path().string());
    for (const auto& [regime, count] : regimes) fmt::print("{}: {}\n", regime, count);
    for (const auto& figure : summary["figures"]) fmt::print("figure: {}\n", figure.get<std::string>());
  }
  return failed == 0 ? done : done_with_failures;
}

}  // namespace epicyclic::app
