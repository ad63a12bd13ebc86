// epicyclic sweep: computes what is missing, journals each point, then writes tables, HDF5 and figures.

#include <cstdio>
#include <map>
#include <mutex>
#include <string>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "failure.hpp"
#include "folder.hpp"
#include "io/point_store.hpp"
#include "io/progress.hpp"
#include "io/study_model.hpp"
#include "io/sweep_output.hpp"
#include "ranks.hpp"
#include "shared_sweep.hpp"
#include "stop.hpp"

namespace epicyclic::app {

namespace {

bool computed(const studies::PointResult& r) { return r.outcome == integrate::Outcome::reached; }

/// @param leader  of the other ranks; null: there are none
int lead_sweep(const Arguments& arguments, SweepLeader* leader) {
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

  if (leader != nullptr) leader->gather(arguments, io::identity(input, "sweep"));
  const io::OutputFolder folder(arguments.output, io::identity(input, "sweep"));
  if (const auto code = refuse_or_finish(folder)) return *code;
  io::Provenance facts = provenance(arguments.threads);
  const std::string resolved = write_inputs(folder, input);
  folder.write_run(io::RunState::running, io::run_facts(facts));

  io::PointStore store(folder.path(), io::identity(input, "sweep"), plan.points.size());
  std::size_t failed = 0;
  studies::SweepRun run;
  run.threads = arguments.threads;
  run.stop = &stop_requested();
  run.done.resize(plan.points.size());
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    run.done[i] = store.holds(i);
    if (run.done[i]) failed += computed(store.read_brief(i)) ? 0 : 1;
  }
  if (store.size() > 0)
    fmt::print(stderr, "{}: {} of {} points were there already\n", folder.path().string(), store.size(),
               plan.points.size());

  io::Progress progress("sweep", plan.points.size(), store.size());
  progress.update(store.size(), failed);
  std::mutex counting;
  std::size_t elsewhere = 0;  // points of other ranks
  run.end_state = [&](std::size_t index) { return store.read_brief(index).end_state; };
  run.point_finished = [&](const studies::PointResult& result) {
    store.append(result);
    const std::scoped_lock lock(counting);
    failed += computed(result) ? 0 : 1;
    progress.update(store.size() + elsewhere, failed);
  };
  if (leader == nullptr) {
    (void)studies::run_sweep(plan, sweep, input.study.integrator, model_at, run);
  } else {
    leader->run(plan, sweep, input.study.integrator, model_at, run, [&](std::size_t finished, std::size_t without) {
      const std::scoped_lock lock(counting);
      elsewhere += finished;
      failed += without;
      progress.update(store.size() + elsewhere, failed);
    });
    store.read_others();
  }
  progress.finish();
  store.sync();

  const auto close_run = [&](io::RunState state) {
    facts.ended = io::utc_now();
    facts.counts = {{"points", static_cast<std::int64_t>(plan.points.size())},
                    {"computed", static_cast<std::int64_t>(store.size())},
                    {"failed", static_cast<std::int64_t>(failed)}};
    folder.write_run(state, io::run_facts(facts));
  };
  if (store.size() < plan.points.size()) {
    close_run(io::RunState::stopped);
    fmt::print(stderr, "stopped after {} of {} points; the same command goes on\n", store.size(), plan.points.size());
    return stopped_early;
  }

  const io::SweepOutput output{sweep, studies::poincare_columns(first_model), resolved, io::figure_title(input.study)};
  const io::PointSource points = store.source();
  io::write_points_csv(folder.file("points.csv"), points);
  io::write_poincare_csv(folder.file("poincare.csv"), output, points);
  io::write_results_h5(folder.file("results.h5"), output, points);
  const std::vector<io::DrawnFigure> figures = io::draw_sweep_figures(folder.file("figures"), output, points);
  close_run(io::RunState::complete);

  std::map<std::string, std::size_t> regimes;
  std::size_t settling = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const studies::PointResult r = points.read_brief(i);
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

}  // namespace

int sweep_command(const Arguments& arguments) {
  Ranks& ranks = *arguments.ranks;
  if (ranks.size() == 1) return lead_sweep(arguments, nullptr);
  if (ranks.rank() > 0) return follow_sweep(arguments);
  SweepLeader leader(ranks);
  int code = bug;
  try {
    code = lead_sweep(arguments, &leader);
  } catch (...) {
    const Failure failure = failure_of(std::current_exception());
    fmt::print(stderr, "{}\n", failure.what());
    code = failure.exit_code();
  }
  leader.dismiss(code);
  return code;
}

}  // namespace epicyclic::app
