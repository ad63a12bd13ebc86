#include "points.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "failure.hpp"
#include "folder.hpp"
#include "grow.hpp"
#include "input/study_input.hpp"
#include "input/study_model.hpp"
#include "progress.hpp"
#include "ranks/ranks.hpp"
#include "ranks/shared_sweep.hpp"
#include "session.hpp"
#include "stop.hpp"
#include "store/output_folder.hpp"
#include "store/point_store.hpp"
#include "streams.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::app {

namespace {

bool computed(const studies::PointSummary& r) { return r.outcome == integrate::Outcome::reached; }

/// Computes what the store does not hold.
/// @param leader  of the other ranks; null: there are none
/// @param lanes   what lanes did, if there were any
/// @returns how many points of all failed
std::size_t compute_missing(const Arguments& arguments, std::string_view command, std::string_view noun,
                            const input::LoadedInput& input, const studies::SweepPlan& plan,
                            const studies::ModelAtPoint& model_at, store::PointStore& store, SweepLeader* leader,
                            studies::LaneUse& lanes) {
  const studies::LookOptions& look = input.study.look();
  std::size_t failed = 0;
  studies::SweepRun run;
  run.threads = arguments.threads;
  run.stop = &stop_requested();
  run.lane_use = &lanes;
  run.done.resize(plan.points.size());
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    run.done[i] = store.holds(i);
    if (run.done[i]) failed += computed(store.read_brief(i)) ? 0 : 1;
  }
  if (store.size() > 0)
    tell("{}: {} of {} {} were there already\n", arguments.output.string(), store.size(), plan.points.size(), noun);

  // A part of another command is called by its folder.
  Progress progress(arguments.quiet ? arguments.output.filename().string() : std::string(command), plan.points.size(),
                    store.size());
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
    (void)studies::run_sweep(plan, look, input.study.integrator, model_at, run);
  } else {
    leader->run(plan, look, input.study.integrator, model_at, run, [&](std::size_t finished, std::size_t without) {
      const std::scoped_lock lock(counting);
      elsewhere += finished;
      failed += without;
      progress.update(store.size() + elsewhere, failed);
    });
  }
  progress.finish();
  store.sync();
  return failed;
}

/// Points that are told periodic by their orbit, while their record is still on its way to it.
struct Unsettled {
  std::size_t points = 0;

  void see(const studies::PointSummary& r) {
    if (r.on_its_way()) ++points;
  }
  [[nodiscard]] std::string note(std::string_view noun) const {
    return fmt::format(
        "at {} {} the motion is periodic, but the record does not repeat yet, or is too short to: their Poincaré "
        "points, means, "
        "RMS and extrema are not those of the orbit (recurrence_error of points.csv); a longer "
        "/study/transient_periods, or "
        "\"transient\": \"adaptive\", lets them settle",
        points, noun);
  }
};

/// Points at which teeth pull.
struct Pulls {
  std::size_t points = 0;
  double force = 0;  ///< greatest, over the static mesh force
  double time = 0;   ///< greatest part of the time

  void see(const studies::PointSummary& r) {
    if (!r.pulls()) return;
    ++points;
    for (const auto* meshes : {&r.meshes.sun_planet, &r.meshes.ring_planet}) {
      force = std::max(force, studies::StageRecord::pull(*meshes));
      time = std::max(time, studies::StageRecord::pull_time(*meshes));
    }
  }
  [[nodiscard]] std::string note(std::string_view noun) const {
    return fmt::format(
        "teeth pull at {} {}, with up to {:.3g} times the static mesh force and for up to {:.1f} % of the time "
        "(pull_sp, pull_rp, pull_time_sp and pull_time_rp of points.csv): it is the damping that pulls; "
        "docs/reference/model_options.md says what /model/gap_damping has to do with it",
        points, noun, force, 100.0 * time);
  }
};

/// All parts, side by side: each of them reads the journals and writes files of its own.
/// @param all  joined by what they wrote
void write_results(const Arguments& arguments, const std::vector<ResultsPart>& parts, const ComputedPoints& computed,
                   SweepLeader* leader, WrittenPoints& all) {
  std::vector<WrittenPoints> written(parts.size());
  if (leader == nullptr) {
    PartQueue queue(parts);
    write_parts(parts, computed, arguments.threads, queue, written);
  } else {
    written = leader->write(parts, computed, arguments.threads);
  }
  for (WrittenPoints& part : written) {
    std::ranges::move(part.figures, std::back_inserter(all.figures));
    std::ranges::move(part.lines, std::back_inserter(all.lines));
    std::ranges::move(part.notes, std::back_inserter(all.notes));
    all.summary.update(part.summary);
    all.files.merge(part.files);
    all.unexplained += part.unexplained;
  }
}

/// Regimes and pulls of all points and what was drawn, on stdout.
void tell_result(const Arguments& arguments, std::string_view noun, const ComputedPoints& computed_points,
                 const WrittenPoints& written, std::size_t failed) {
  const studies::PointSource& points = computed_points.points;
  std::map<std::string, std::size_t> regimes;
  Pulls pulls;
  Unsettled unsettled;
  for (std::size_t i = 0; i < points.count; ++i) {
    const studies::PointSummary r = points.read_brief(i);
    if (!computed(r)) continue;
    ++regimes[to_string(r.regime)];
    pulls.see(r);
    unsettled.see(r);
  }
  nlohmann::json summary = {{"folder", computed_points.folder.string()},
                            {"points", points.count},
                            {"failed", failed},
                            {"regimes", regimes},
                            {"pulling", pulls.points},
                            {"unsettled", unsettled.points},
                            {"figures", nlohmann::json::array()}};
  summary.update(written.summary);
  for (const reports::DrawnFigure& figure : written.figures)
    if (figure.outcome.drawn()) summary["figures"].push_back(figure.file.string());
  if (arguments.json) {
    print("{}\n", summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print("{} {}, {} failed, in {}\n", points.count, noun, failed, computed_points.folder.string());
    for (const auto& [regime, count] : regimes) print("{}: {}\n", regime, count);
    if (unsettled.points > 0) print("{}\n", unsettled.note(noun));
    if (pulls.points > 0) print("{}\n", pulls.note(noun));
    for (const std::string& line : written.lines) print("{}\n", line);
    for (const auto& figure : summary["figures"]) print("figure: {}\n", figure.get<std::string>());
  }
}

int lead(const Arguments& arguments, std::string_view command, std::string_view noun,
         const std::vector<ResultsPart>& parts, const AfterPoints& after, SweepLeader* leader) {
  const input::LoadedInput input = input::load_input(arguments.input, input::parse_assignments(arguments.sets));
  require_kind(input, arguments, command);
  const studies::SweepPlan plan = input::plan_of(input.study);
  const studies::ModelAtPoint model_at = input::model_at_point(input);
  // Options that do not fit show here, before anything is written.
  const model::DynamicModel first_model = model_at(plan.points.front());
  if (!arguments.quiet) tell_warnings(input);
  if (!arguments.quiet && command == "sweep" && input.study.sweep().axis.name != studies::speed_parameter)
    tell("operation: mesh_frequency_ratio = {}\n", input.study.mesh_frequency_ratio);

  std::unique_ptr<GrownStudy> grown;
  if (!arguments.grow.empty()) grown = std::make_unique<GrownStudy>(arguments.grow, input, plan, command);

  const std::string identity = identity_of(input, command);
  if (leader != nullptr) leader->gather(arguments, identity);
  Session session(arguments, input, identity, arguments.threads, arguments.ranks->size());
  if (const auto code = session.exit_code()) return *code;
  store::OutputFolder& folder = session.folder();

  store::PointStore store(folder.path(), identity, plan.points.size());
  for (const auto& [journal, bytes] : store.cut_tails()) tell_cut_tail(journal, bytes);
  std::size_t taken = 0;
  if (grown) {
    taken = grown->take_into(store);
    tell("{}: {} of {} {} are those of {}; the others are new, or have come another way\n", folder.path().string(),
         taken, plan.points.size(), noun, arguments.grow.string());
  }
  studies::LaneUse lanes;
  const std::size_t failed = compute_missing(arguments, command, noun, input, plan, model_at, store, leader, lanes);
  folder.require_there();
  if (leader != nullptr) store.read_others();
  std::int64_t undrawn = 0;
  WrittenPoints written;
  const auto close_run = [&](store::RunState state) {
    session.end(state,
                {{"points", static_cast<std::int64_t>(plan.points.size())},
                 {"computed", static_cast<std::int64_t>(store.size())},
                 {"taken", static_cast<std::int64_t>(taken)},
                 {"failed", static_cast<std::int64_t>(failed)},
                 {"undrawn", undrawn},
                 {"unexplained", static_cast<std::int64_t>(written.unexplained)}},
                lanes.occupancy());
  };
  const auto stopped = [&] {
    close_run(store::RunState::stopped);
    tell("stopped after {} of {} {}; the same command goes on\n", store.size(), plan.points.size(), noun);
    return stopped_early;
  };
  if (store.size() < plan.points.size()) return stopped();

  folder.require_there();
  const ComputedPoints computed_points{folder.path(), input, first_model, session.resolved(), store.source()};
  if (after) {
    auto first = after(arguments, computed_points);
    if (!first) return stopped();
    written = std::move(*first);
  }
  folder.require_there();
  write_results(arguments, parts, computed_points, leader, written);
  folder.add(written.files);
  undrawn = tell_undrawn(written.figures);
  close_run(store::RunState::complete);
  for (const std::string& note : written.notes) tell("{}\n", note);

  if (!arguments.quiet) tell_result(arguments, noun, computed_points, written, failed);
  return failed == 0 && undrawn == 0 && written.unexplained == 0 ? done : done_with_failures;
}

}  // namespace

int points_command(const Arguments& arguments, std::string_view command, std::string_view noun,
                   const std::vector<ResultsPart>& parts, const AfterPoints& after) {
  Ranks& ranks = *arguments.ranks;
  if (ranks.size() == 1) return lead(arguments, command, noun, parts, after, nullptr);
  if (ranks.rank() > 0) return follow(arguments, command, parts);
  SweepLeader leader(ranks);
  int code = bug;
  try {
    code = lead(arguments, command, noun, parts, after, &leader);
  } catch (...) {
    const Failure failure = failure_of(std::current_exception());
    tell("{}\n", failure.what());
    code = failure.exit_code();
  }
  leader.dismiss(code);
  return code;
}

}  // namespace epicyclic::app
