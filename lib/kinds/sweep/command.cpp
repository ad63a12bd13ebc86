// epicyclic sweep: bifurcation diagram along one parameter.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "core/counted.hpp"
#include "expected_time.hpp"
#include "input/study_model.hpp"
#include "kind_commands.hpp"
#include "kinds/crosscheck/output.hpp"
#include "kinds/sweep/summary.hpp"
#include "points.hpp"
#include "progress.hpp"
#include "reports/sweep_output.hpp"
#include "stop.hpp"
#include "studies/cost_estimate.hpp"
#include "studies/crosscheck.hpp"

namespace epicyclic::app {

namespace {

reports::SweepOutput output_of(const ComputedPoints& all) {
  return {all.input.study.sweep(), studies::poincare_columns(all.first_model), all.resolved,
          reports::figure_title(all.input.study), all.input.study.axis_speed};
}

WrittenPoints write_section(const ComputedPoints& all) {
  reports::write_poincare_csv(all.folder / "poincare.csv", output_of(all), all.points);
  return {};
}

WrittenPoints write_h5(const ComputedPoints& all) {
  reports::write_results_h5(all.folder / "results.h5", output_of(all), all.points);
  return {};
}

WrittenPoints write_figure(const ComputedPoints& all, reports::SweepFigure figure) {
  WrittenPoints written;
  if (auto none = reports::write_sweep_figure(all.folder / "figures", output_of(all), all.points, figure))
    written.figures.push_back(std::move(*none));
  return written;
}

WrittenPoints draw_picture(const ComputedPoints& all, reports::SweepFigure figure, figures::Pictures picture) {
  WrittenPoints written;
  auto drawn = reports::draw_sweep_picture(all.folder / "figures", output_of(all), figure, picture);
  // A figure is called by its PNG picture.
  if (drawn && (picture == figures::Pictures::png || !drawn->outcome.drawn()))
    written.figures.push_back(std::move(*drawn));
  return written;
}

WrittenPoints write_points(const ComputedPoints& all) {
  reports::write_points_csv(all.folder / "points.csv", all.points);
  std::size_t converging = 0;
  for (std::size_t i = 0; i < all.points.count; ++i)
    converging += studies::still_converging(all.points.read_summary(i), all.input.study.recording()) ? 1 : 0;
  WrittenPoints written;
  if (converging > 0)
    written.notes.push_back(
        fmt::format("{} not reached their attractor (recurrence_error_late below recurrence_error): "
                    "/study/classification_periods > 0 or a larger /study/transient_periods decides them",
                    counted(converging, "undecided points had", "undecided point had")));
  return written;
}

WrittenPoints write_summary(const ComputedPoints& all) {
  kinds::SweepSummary summary = kinds::sweep_summary(output_of(all), all.points);
  write_file_atomically(all.folder / "sweep.md", summary.text);
  WrittenPoints written;
  written.lines = std::move(summary.lines);
  written.summary = std::move(summary.numbers);
  return written;
}

/// In the order in which they are handed out: the longest first, but for figures' data, which their pictures wait for.
std::vector<ResultsPart> parts_of_sweep(bool figures) {
  std::vector<ResultsPart> parts = {{write_h5}};
  std::map<reports::SweepFigure, std::size_t> written_by;
  for (const reports::SweepFigure figure : reports::all_sweep_figures) {
    if (!figures) break;
    written_by[figure] = parts.size();
    parts.push_back({[figure](const ComputedPoints& all) { return write_figure(all, figure); }});
  }
  parts.push_back({write_section});
  for (const figures::Pictures picture : {figures::Pictures::png, figures::Pictures::svg})
    for (const auto& [figure, part] : written_by)
      parts.push_back(
          {[figure = figure, picture](const ComputedPoints& all) { return draw_picture(all, figure, picture); }, part});
  parts.push_back({write_points});
  parts.push_back({write_summary});
  return parts;
}

/// Computes some points of each regime by other methods, if the study requests it: crosscheck.csv and crosscheck.md.
std::optional<WrittenPoints> cross_check(const Arguments& arguments, const ComputedPoints& all) {
  const studies::SweepOptions& sweep = all.input.study.sweep();
  WrittenPoints written;
  if (sweep.check.points == 0) return written;
  const std::size_t points = studies::points_of_each_regime(sweep, all.points).size();
  if (points == 0) {
    written.notes.push_back("no point is cross-checked: no point has a known regime and a known initial state");
    return written;
  }
  studies::CrosscheckRun run;
  run.threads = arguments.threads;
  run.stop = &stop_requested();
  Progress progress("crosscheck", points * sweep.check.methods.size(), 0);
  std::size_t finished = 0;
  run.point_finished = [&](std::size_t /*variant*/, const studies::PointResult&) { progress.update(++finished, 0); };
  const input::Study& study = all.input.study;
  const studies::Crosscheck checked = studies::run_check_of_sweep(
      sweep, all.points, study.integrator, study.model.clearance_smoothing, input::smoothed_model_at(all.input), run);
  progress.finish();
  if (!checked.complete(points)) return std::nullopt;
  kinds::write_crosscheck_csv(all.folder / "crosscheck.csv", checked);
  const std::string summary = kinds::crosscheck_summary(
      reports::axis_words(all.input.study.sweep().axis.name, all.input.study.axis_speed), checked);
  write_file_atomically(all.folder / "crosscheck.md", summary);
  written.unexplained = kinds::unexplained(checked);
  written.summary["crosscheck"] = {{"points", points},
                                   {"comparisons", checked.comparisons.size()},
                                   {"differences", kinds::differences(checked)},
                                   {"unexplained", written.unexplained}};
  written.lines.push_back(
      fmt::format("cross-check by other methods: {} of {} comparisons differ, {} unexplained (crosscheck.md)",
                  kinds::differences(checked), checked.comparisons.size(), written.unexplained));
  return written;
}

/// Of a sweep's cross-check: two of each of two regimes.
constexpr int compared_at_most = 4;

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
  // Rare regimes are not in this sample, and their differences have to be explained. By measurement, that takes as much
  // time again.
  constexpr double explaining = 2.0;
  return explaining * spent * static_cast<double>(all) / static_cast<double>(chosen) /
         busy(all * sweep.check.methods.size(), threads);
}

Expected time_of_sweep(const input::LoadedInput& input, const studies::SweepPlan& plan, int threads,
                       const TimeLimit& limit) {
  return time_with_checks(
      input, plan, threads, limit,
      [&](const studies::SweepPlan& miniature, const std::vector<studies::PointResult>& points) {
        return seconds_of_check(input, miniature, points, threads, limit);
      },
      "its cross-check");
}

int run_sweep(const Arguments& arguments) {
  return points_command(arguments, "sweep", "points", parts_of_sweep(arguments.figures), cross_check);
}

}  // namespace

const Command& sweep_command() {
  static const Command command = {
      .name = "sweep",
      .meaning = "compute a bifurcation diagram along one parameter, up, down or both",
      .run = &run_sweep,
      .takes = Takes::output,
      .options = &add_points_options,
      .shares_work = true,
      .expected = &time_of_sweep,
  };
  return command;
}

}  // namespace epicyclic::app
