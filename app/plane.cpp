#include "plane.hpp"

#include <cstdint>
#include <cstdio>
#include <map>
#include <utility>

#include <fmt/core.h>

#include "folder.hpp"
#include "io/journal.hpp"
#include "io/point_record.hpp"
#include "io/progress.hpp"
#include "io/study_model.hpp"
#include "stop.hpp"

namespace epicyclic::app {

namespace {

bool computed(const studies::PointResult& r) { return r.outcome == integrate::Outcome::reached; }

}  // namespace

int plane_command(const Arguments& arguments, std::string_view kind,
                  const std::function<WrittenPlane(const ComputedPlane&)>& write) {
  const io::LoadedInput input = io::load_input(arguments.input, io::parse_assignments(arguments.sets));
  require_kind(input, arguments, kind);
  const studies::SweepPlan plan = io::plan_of(input.study);
  const studies::ModelAtPoint model_at = io::model_at_point(input);
  // Options that do not fit show here, before anything is written.
  const model::DynamicModel first_model = model_at(plan.points.front());
  for (const std::string& warning : io::warnings(input)) fmt::print(stderr, "{}\n", warning);

  const std::string identity = io::identity(input, kind);
  const io::OutputFolder folder(arguments.output, identity);
  if (const auto code = refuse_or_finish(folder)) return *code;
  io::Provenance facts = provenance(arguments.threads);
  stop_on_signals();
  const std::string resolved = write_inputs(folder, input);
  folder.write_run(io::RunState::running, io::run_facts(facts));

  io::Journal journal(folder.file("journal.bin"), identity);
  studies::SweepRun run;
  run.threads = arguments.threads;
  run.stop = &stop_requested();
  run.done = known_points(journal.take_records(), plan);
  std::size_t finished = run.done.size();
  std::size_t failed = 0;
  for (const auto& [index, result] : run.done) failed += computed(result) ? 0 : 1;
  if (finished > 0)
    fmt::print(stderr, "{}: {} of {} cells were there already\n", folder.path().string(), finished, plan.points.size());

  io::Progress progress(std::string(kind), plan.points.size(), finished);
  run.point_finished = [&](const studies::PointResult& result) {
    journal.append(result.point.index, io::encode_point(result));
    failed += computed(result) ? 0 : 1;
    progress.update(++finished, failed);
  };
  std::vector<studies::PointResult> results =
      studies::run_sweep(plan, *input.study.sweep, input.study.integrator, model_at, std::move(run));
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
    fmt::print(stderr, "stopped after {} of {} cells; the same command goes on\n", results.size(), plan.points.size());
    return stopped_early;
  }

  const WrittenPlane written = write({folder, input, first_model, resolved, results});
  close_run(io::RunState::complete);

  std::map<std::string, std::size_t> regimes;
  for (const studies::PointResult& r : results)
    if (computed(r)) ++regimes[to_string(r.regime)];
  nlohmann::json summary = {{"folder", folder.path().string()},
                            {"points", plan.points.size()},
                            {"failed", failed},
                            {"regimes", regimes},
                            {"figures", nlohmann::json::array()}};
  summary.update(written.summary);
  for (const io::DrawnFigure& figure : written.figures) {
    if (figure.outcome.drawn())
      summary["figures"].push_back(figure.png.string());
    else
      fmt::print(stderr, "{} was not drawn: {}\n", figure.png.string(), figure.outcome.message);
  }
  if (arguments.json) {
    fmt::print("{}\n", summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    fmt::print("{} cells, {} failed, in {}\n", plan.points.size(), failed, folder.path().string());
    for (const auto& [regime, count] : regimes) fmt::print("{}: {}\n", regime, count);
    for (const std::string& line : written.lines) fmt::print("{}\n", line);
    for (const auto& figure : summary["figures"]) fmt::print("figure: {}\n", figure.get<std::string>());
  }
  return failed == 0 ? done : done_with_failures;
}

}  // namespace epicyclic::app
