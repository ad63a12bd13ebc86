// epicyclic run: one operating point with all results of the analysis.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "expected_time.hpp"
#include "finished_study.hpp"
#include "folder.hpp"
#include "host.hpp"
#include "input/study_model.hpp"
#include "kind_commands.hpp"
#include "kinds/run/output.hpp"
#include "kinds/run/plan.hpp"
#include "progress.hpp"
#include "reports/sweep_output.hpp"
#include "session.hpp"
#include "stop.hpp"
#include "store/journal.hpp"
#include "store/point_record.hpp"
#include "streams.hpp"
#include "studies/cost_estimate.hpp"
#include "studies/run.hpp"

namespace epicyclic::app {

namespace {

/// Results of a run in the order of the computation: the point, then results of the flows of exponents. They are used
/// until the run is complete.
class RunJournal {
 public:
  RunJournal(Session& session) : file_(session.folder().file("journal.bin")), journal_(file_, session.identity()) {
    report_cut_tail(file_, journal_.cut_bytes());
    for (const store::JournalEntry& entry : journal_.entries()) {
      if (entry.point == of_point)
        point_ = store::decode_point(journal_.read(entry));
      else
        known_[entry.point].push_back(entry);
    }
  }

  [[nodiscard]] studies::RunMemory memory() {
    return {point_,
            [this](const studies::PointResult& point) { journal_.append(of_point, store::encode_point(point)); },
            [this](studies::RunPart part) { return memory_of(static_cast<std::uint64_t>(part)); }};
  }

  /// Mesh periods of exponents that are known.
  [[nodiscard]] std::size_t exponent_intervals() const {
    const auto of = known_.find(static_cast<std::uint64_t>(studies::RunPart::exponents));
    return of == known_.end() ? 0 : of->second.size();
  }
  [[nodiscard]] bool knows_point() const { return point_.has_value(); }

  void close() { journal_.close(); }

  /// Of a complete run: its tables hold all that follows from it.
  void remove() {
    std::error_code error;
    std::filesystem::remove(file_, error);
  }

 private:
  static constexpr std::uint64_t of_point = 0;

  [[nodiscard]] studies::FlowMemory memory_of(std::uint64_t part) {
    const auto known = known_.find(part);
    std::vector<store::JournalEntry> entries =
        known == known_.end() ? std::vector<store::JournalEntry>() : known->second;
    return {[this, entries = std::move(entries),
             next = std::size_t{0}](std::size_t numbers) mutable -> std::optional<std::vector<double>> {
              if (next == entries.size()) return std::nullopt;
              return store::decode_numbers(journal_.read(entries[next++]), numbers);
            },
            [this, part](std::span<const double> result) { journal_.append(part, store::encode_numbers(result)); }};
  }

  std::filesystem::path file_;
  store::Journal journal_;
  std::optional<studies::PointResult> point_;
  std::map<std::uint64_t, std::vector<store::JournalEntry>> known_;
};

/// Shows the progress of a run. The time of its exponents is estimated as soon as some of them exist.
class RunProgress {
 public:
  RunProgress(const studies::RunOptions& options, std::size_t known)
      : total_(static_cast<std::size_t>(exponent_intervals(options))),
        known_(known),
        progress_("run", total_ > 0 ? total_ : unknown_total, known) {}

  /// By any thread.
  void see(const char* what, std::size_t interval) {
    const HostScope scope(host_);
    progress_.update(interval, what);
    const std::scoped_lock lock(mutex_);
    if (said_ || interval < known_ || total_ == 0 || interval == 0) return;
    const auto now = std::chrono::steady_clock::now();
    if (interval <= std::max<std::size_t>(known_, 1)) {
      begun_ = now;
      first_ = interval;
      return;
    }
    const std::chrono::duration<double> spent = now - begun_;
    if (spent < measured_for) return;
    said_ = true;
    const double left = spent.count() / static_cast<double>(interval - first_) * static_cast<double>(total_ - interval);
    print_message(
        "Lyapunov exponents over {} mesh periods (/study/exponent_periods) take about {} more; a stopped run can be "
        "resumed\n",
        total_, duration_text(left));
  }

 private:
  static constexpr std::chrono::seconds measured_for{2};
  std::size_t total_, known_;
  Progress progress_;
  Host* host_ = host();
  std::mutex mutex_;
  bool said_ = false;
  std::size_t first_ = 0;
  std::chrono::steady_clock::time_point begun_;
};

std::optional<studies::RunResult> compute(int threads, const model::DynamicModel& model, const input::Study& study,
                                          RunJournal& journal) {
  const auto& [recording, options] = study.plan.as<kinds::RunPlan>();
  RunProgress progress(options, journal.exponent_intervals());
  return studies::run_operating_point(
      model, recording, options, study.integrator,
      {threads, [&stop = stop_requested()] { return !stop.load(); },
       [&](const char* what, int interval) { progress.see(what, static_cast<std::size_t>(interval)); },
       journal.memory()});
}

/// Of one operating point, by as many mesh periods of its exponents as there is time for. Figures are not measured.
Expected time_of_run(const input::LoadedInput& input, const studies::SweepPlan& /*plan*/, int /*threads*/,
                     const TimeLimit& limit) {
  const auto& [recording, options] = input.study.plan.as<kinds::RunPlan>();
  const model::DynamicModel model = input::model_at(input)(input.study.mesh_frequency_ratio);
  constexpr const char* figures = ", and its figures";
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
  const bool whole =
      studies::run_operating_point(model, recording, options, input.study.integrator, control).has_value();
  const double spent = studies::processor_seconds() - begun;
  if (whole) return {spent, 0.0, "by computing it", true, figures};
  if (intervals < 2) return {0.0, spent, "which did not reach its exponents", true, figures};
  const double each = (now - exponents_begun) / (intervals - 1);
  return {exponents_begun - begun + each * all, 0.0,
          fmt::format("by {} of {} mesh periods of its exponents", intervals, all), true, figures};
}

int run_run(const Arguments& arguments) {
  StartFacts start;
  const input::LoadedInput input = with_start(arguments, "run", &start);
  require_kind(input, arguments, "run");
  const input::Study& study = input.study;
  const studies::RunOptions& options = study.plan.as<kinds::RunPlan>().run;
  const model::DynamicModel model = input::model_at(input)(study.mesh_frequency_ratio);
  print_warnings(input);

  Session session(arguments, input, identity_of(input, "run"), arguments.threads);
  if (const auto code = session.exit_code()) return *code;
  const store::OutputFolder& folder = session.folder();

  RunJournal journal(session);
  if (journal.knows_point())
    print_message("{}: the point and {} of {} mesh periods of exponents exist already\n", folder.path().string(),
                  journal.exponent_intervals(), exponent_intervals(options));
  const auto result = compute(arguments.threads, model, study, journal);
  journal.close();
  if (!result) {
    session.end(store::RunState::stopped, {});
    print_message("stopped; re-run the same command to resume\n");
    return stopped_early;
  }

  folder.require_there();
  const reports::SweepOutput points{study.sweep(), studies::poincare_columns(model), session.resolved(),
                                    reports::figure_title(study)};
  const kinds::RunOutput output{
      points,      options,         model.sun_planet_half_gap, model.ring_planet_half_gap, study.model.gap_damping,
      start.lines, start.is_chaotic};
  const bool computed = result->point.outcome == integrate::Outcome::reached;
  const std::string summary = kinds::run_summary(output, *result);
  const studies::PointSource point = studies::points_in_memory({&result->point, 1});
  reports::write_points_csv(folder.file("points.csv"), point);
  reports::write_poincare_csv(folder.file("poincare.csv"), points, point);
  kinds::write_run_tables(folder.path(), output, *result);
  kinds::write_run_h5(folder.file("results.h5"), output, *result);
  write_file_atomically(folder.file("summary.md"), summary);
  const auto figures = kinds::draw_run_figures(folder.file("figures"), output, *result);
  const std::int64_t undrawn = report_undrawn(figures);
  session.end(store::RunState::complete, {{"points", 1}, {"failed", computed ? 0 : 1}, {"undrawn", undrawn}});
  journal.remove();

  nlohmann::json summary_json = {{"folder", folder.path().string()},
                                 {"status", store::status_word(result->point.outcome)},
                                 {"regime", store::regime_word(result->point)},
                                 {"period", result->point.period},
                                 {"figures", nlohmann::json::array()}};
  for (const reports::DrawnFigure& figure : figures)
    if (figure.outcome.drawn()) summary_json["figures"].push_back(figure.file.string());
  if (arguments.json) {
    print("{}\n", summary_json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print("{}\n", summary);
    for (const auto& figure : summary_json["figures"]) print("figure: {}\n", figure.get<std::string>());
  }
  return computed && undrawn == 0 ? done : done_with_failures;
}

}  // namespace

const Command& run_command() {
  static const Command command = {
      .name = "run",
      .meaning = "compute one operating point: regime, forces, spectra, exponents, orbit, figures",
      .run = &run_run,
      .takes = Takes::output,
      .options = &add_start_option,
      .expected = &time_of_run,
  };
  return command;
}

}  // namespace epicyclic::app
