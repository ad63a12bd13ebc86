// epicyclic run: one operating point with everything that analysis can say of it.

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "finished_study.hpp"
#include "folder.hpp"
#include "input/study_model.hpp"
#include "progress.hpp"
#include "reports/run_output.hpp"
#include "reports/sweep_output.hpp"
#include "session.hpp"
#include "stop.hpp"
#include "streams.hpp"
#include "studies/run.hpp"

namespace epicyclic::app {

namespace {

std::optional<studies::RunResult> compute(int threads, const model::DynamicModel& model, const input::Study& study) {
  const auto& [look, options] = std::get<input::RunPlan>(study.plan);
  // Exponents are most of the work.
  const int periods_of_exponents = options.exponent_periods;
  Progress progress("run", periods_of_exponents > 0 ? static_cast<std::size_t>(periods_of_exponents) : unknown_total);
  return studies::run_operating_point(
      model, look, options, study.integrator,
      {threads, [] { return !stop_requested().load(); },
       [&](const char* what, int periods) { progress.update(static_cast<std::size_t>(periods), what); }});
}

}  // namespace

int run_command(const Arguments& arguments) {
  std::vector<std::string> start;
  const input::LoadedInput input = with_start(arguments, "run", &start);
  require_kind(input, arguments, "run");
  const input::Study& study = input.study;
  const studies::RunOptions& options = std::get<input::RunPlan>(study.plan).run;
  const model::DynamicModel model = input::model_at(input)(study.mesh_frequency_ratio);
  tell_warnings(input);

  Session session(arguments, input, identity_of(input, "run"), arguments.threads);
  if (const auto code = session.exit_code()) return *code;
  const store::OutputFolder& folder = session.folder();

  // A minute at most: what is stopped begins anew.
  const auto result = compute(arguments.threads, model, study);
  if (!result) {
    session.end(store::RunState::stopped, {});
    tell("stopped; the same command begins anew\n");
    return stopped_early;
  }

  folder.require_there();
  const reports::SweepOutput points{study.sweep(), studies::poincare_columns(model), session.resolved(),
                                    reports::figure_title(study)};
  const reports::RunOutput output{
      points, options, model.sun_planet_half_gap, model.ring_planet_half_gap, study.model.gap_damping, start};
  const bool computed = result->point.outcome == integrate::Outcome::reached;
  const std::string summary = reports::run_summary(output, *result);
  const studies::PointSource point = studies::points_in_memory({&result->point, 1});
  reports::write_points_csv(folder.file("points.csv"), point);
  reports::write_poincare_csv(folder.file("poincare.csv"), points, point);
  reports::write_run_tables(folder.path(), output, *result);
  reports::write_run_h5(folder.file("results.h5"), output, *result);
  write_file_atomically(folder.file("summary.md"), summary);
  const auto figures = reports::draw_run_figures(folder.file("figures"), output, *result);
  const std::int64_t undrawn = tell_undrawn(figures);
  session.end(store::RunState::complete, {{"points", 1}, {"failed", computed ? 0 : 1}, {"undrawn", undrawn}});

  nlohmann::json told = {{"folder", folder.path().string()},
                         {"status", store::status_word(result->point.outcome)},
                         {"regime", store::regime_word(result->point)},
                         {"period", result->point.period},
                         {"figures", nlohmann::json::array()}};
  for (const reports::DrawnFigure& figure : figures)
    if (figure.outcome.drawn()) told["figures"].push_back(figure.file.string());
  if (arguments.json) {
    print("{}\n", told.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print("{}\n", summary);
    for (const auto& figure : told["figures"]) print("figure: {}\n", figure.get<std::string>());
  }
  return computed && undrawn == 0 ? done : done_with_failures;
}

}  // namespace epicyclic::app
