#include "points.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/atomic_file.hpp"
#include "core/counted.hpp"
#include "core/errors.hpp"
#include "failure.hpp"
#include "folder.hpp"
#include "grow.hpp"
#include "host.hpp"
#include "input/json_source.hpp"
#include "input/study_input.hpp"
#include "input/study_model.hpp"
#include "kind_commands.hpp"
#include "progress.hpp"
#include "ranks/ranks.hpp"
#include "ranks/shared_sweep.hpp"
#include "session.hpp"
#include "shell_word.hpp"
#include "stop.hpp"
#include "store/output_folder.hpp"
#include "store/point_record.hpp"
#include "store/point_store.hpp"
#include "streams.hpp"
#include "studies/classification.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::app {

namespace {

bool computed(const studies::PointSummary& r) { return r.outcome == integrate::Outcome::reached; }

/// The points of a part that the store does not have, and all of them. Chains are dealt to the parts by their index.
struct PartPoints {
  std::size_t missing = 0, all = 0;
};

PartPoints points_of(const Arguments& arguments, const studies::SweepPlan& plan, const store::PointStore& store) {
  PartPoints points;
  const store::Part& part = arguments.part;
  for (std::size_t chain = store::first_of(part, arguments.chains_before); chain < plan.chains.size();
       chain += part.of) {
    points.all += plan.chains[chain].size();
    for (const std::size_t point : plan.chains[chain]) points.missing += store.holds(point) ? 0 : 1;
  }
  return points;
}

/// States how many points parts have computed, and which parts have no journal.
void report_points_of_parts(const Arguments& arguments, const store::PointStore& store, const studies::SweepPlan& plan,
                            std::string_view noun) {
  PartsOfFolder parts;
  for (const auto& [part, held] : store.parts()) {
    parts.present.insert(part);
    parts.computed += held;
  }
  parts.before = arguments.chains_before;
  parts.shares = plan.chains.size();
  report_parts(arguments.output.string(), parts, store.size(), plan.points.size(), noun);
}

/// Computes the points that the store does not have; of a part, those of its chains.
/// @param leader  of the other ranks; null: there are none
/// @param lanes   use of the lanes, if there were any
/// @returns how many points of all failed
std::size_t compute_missing(const Arguments& arguments, std::string_view command, std::string_view noun,
                            const input::LoadedInput& input, const studies::SweepPlan& plan,
                            const studies::ModelAtPoint& model_at, store::PointStore& store, SweepLeader* leader,
                            studies::LaneUse& lanes) {
  const studies::RecordingOptions& recording = input.study.recording();
  const store::Part& part = arguments.part;
  std::size_t failed = 0;
  studies::SweepRun run;
  run.threads = arguments.threads;
  std::atomic<std::size_t> next{0};
  if (part.of > 0) {
    next = store::first_of(part, arguments.chains_before);
    run.next_chain = [&]() -> std::optional<std::size_t> {
      const std::size_t chain = next.fetch_add(part.of);
      return chain < plan.chains.size() ? std::optional(chain) : std::nullopt;
    };
    run.threads_of_all = arguments.threads * static_cast<int>(part.of);
    run.process = part.number - 1;
  }
  run.stop = &stop_requested();
  run.lane_use = &lanes;
  run.done.resize(plan.points.size());
  for (std::size_t i = 0; i < plan.points.size(); ++i) {
    run.done[i] = store.holds(i);
    if (run.done[i]) failed += computed(store.read_summary(i)) ? 0 : 1;
  }
  if (store.size() > 0)
    print_message("{}: {} of {} {} exist already\n", arguments.output.string(), store.size(), plan.points.size(), noun);

  // A part of another command is called by its folder.
  Progress progress(arguments.quiet ? arguments.output.filename().string() : std::string(command), plan.points.size(),
                    store.size());
  progress.update(store.size(), failed);
  std::mutex counting;
  std::size_t elsewhere = 0;  // points of other ranks
  run.end_state = [&](std::size_t index) { return store.read_summary(index).end_state; };
  run.point_finished = [&, to = host()](const studies::PointResult& result) {
    store.append(result);
    if (to != nullptr && to->point) to->point(result);
    const std::scoped_lock lock(counting);
    failed += computed(result) ? 0 : 1;
    progress.update(store.size() + elsewhere, failed);
  };
  if (leader == nullptr) {
    (void)studies::run_sweep(plan, recording, input.study.integrator, model_at, run);
  } else {
    leader->run(plan, recording, input.study.integrator, model_at, run, [&](std::size_t finished, std::size_t without) {
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

/// Points of which something is not certain.
struct Doubts {
  std::size_t undecided = 0, unconverged = 0, tensile = 0;
  std::optional<std::size_t> first_undecided{};
  double force = 0;  ///< greatest tension, over the static mesh force
  std::size_t periodic = 0;

  void see(const studies::PointSummary& r) {
    periodic += r.regime == analysis::Regime::periodic ? 1 : 0;
    if (r.regime == analysis::Regime::undecided) {
      ++undecided;
      if (!first_undecided) first_undecided = r.point.index;
    }
    if (r.is_unconverged()) ++unconverged;
    if (!r.has_tension()) return;
    ++tensile;
    for (const auto* meshes : {&r.meshes.sun_planet, &r.meshes.ring_planet})
      force = std::max(force, studies::StageRecord::tension(*meshes));
  }

  /// In one line; empty: there are none.
  /// @param noun  "points"
  [[nodiscard]] std::string text(std::string_view noun) const {
    std::vector<std::string> all;
    if (undecided > 0) all.push_back(counted(undecided, noun) + " undecided");
    if (unconverged > 0) all.push_back(counted(unconverged, noun) + " whose record has not converged to the orbit");
    if (tensile > 0)
      all.push_back(counted(tensile, noun) + fmt::format(" with a tensile mesh force (at most {:.3g} F_0)", force));
    return fmt::format("{}", fmt::join(all, ", "));
  }
};

/// A command that examines uncertain results or bifurcations further; empty: none is known.
std::string next_command(const Arguments& arguments, const ComputedPoints& all, const Doubts& doubts) {
  const std::string folder = all.folder.string();
  const std::string program = shell_word(arguments.called);
  const input::Study& study = all.input.study;
  if (doubts.first_undecided)
    return fmt::format("{} run --from {} -o {}", program,
                       shell_word(fmt::format("{}:{}", folder, *doubts.first_undecided)),
                       shell_word(fmt::format("{}_point_{}", folder, *doubts.first_undecided)));
  const auto same_study_with = [&](std::initializer_list<const char*> sets, const char* suffix) {
    std::string command = fmt::format("{} {} {}", program, study.kind(), shell_word(arguments.input.string()));
    for (const std::string& set : arguments.sets) command += " --set " + shell_word(set);
    for (const char* set : sets) command += fmt::format(" --set {}", set);
    return command + fmt::format(" -o {}", shell_word(folder + suffix));
  };
  const bool classifies = studies::has_classification(all.first_model);
  if (doubts.unconverged > 0 && classifies && study.recording().transient == studies::Transient::fixed &&
      study.recording().classification_periods > 0)
    return same_study_with({"/study/transient=adaptive"}, "_adaptive");
  // Tension comes from the damping across the open gap; without it the exact clearance has no tangents.
  if (doubts.tensile > 0 && all.input.resolved.at("model").at("gap_damping") == "always")
    return same_study_with({"/model/gap_damping=contact_slope", "/integrator/clearance_smoothing=0.01"},
                           "_contact_slope");
  if (study.kind() != "sweep" || doubts.periodic == 0 || !classifies) return {};
  const nlohmann::json& sweep = all.input.resolved.at("study");
  if (sweep.at("from") == sweep.at("to")) return {};
  const nlohmann::json branches = {
      {"kind", "continue"}, {"parameter", sweep.at("parameter")}, {"from", sweep.at("from")}, {"to", sweep.at("to")}};
  return fmt::format("{0} continue {1} --set {2} --from {3} --against {3} -o {4}", program,
                     shell_word((all.folder / "input.resolved.json").string()), shell_word("/study=" + branches.dump()),
                     shell_word(folder), shell_word(folder + "_branches"));
}

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

/// Results, uncertain results and commands that examine them, on stdout: of a sweep five lines at most.
void print_result(const Arguments& arguments, std::string_view noun, const ComputedPoints& computed_points,
                  const WrittenPoints& written, std::size_t failed) {
  const studies::PointSource& points = computed_points.points;
  std::map<std::string, std::size_t> regimes;
  Doubts doubts;
  for (std::size_t i = 0; i < points.count; ++i) {
    const studies::PointSummary r = points.read_summary(i);
    if (!computed(r)) continue;
    ++regimes[to_string(r.regime)];
    doubts.see(r);
  }
  nlohmann::json summary = {{"folder", computed_points.folder.string()},
                            {"points", points.count},
                            {"failed", failed},
                            {"regimes", regimes},
                            {"tensile_force", doubts.tensile},
                            {"not_converged", doubts.unconverged},
                            {"figures", nlohmann::json::array()}};
  summary.update(written.summary);
  for (const reports::DrawnFigure& figure : written.figures)
    if (figure.outcome.drawn()) summary["figures"].push_back(figure.file.string());
  if (arguments.json) {
    print("{}\n", summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    return;
  }
  std::string found;
  for (const auto& [regime, count] : regimes)
    found += fmt::format("{}{} {}", found.empty() ? ": " : ", ", count, regime);
  print("{}, {} failed, in {}{}\n", counted(points.count, noun), failed, computed_points.folder.string(), found);
  for (const std::string& line : written.lines) print("{}\n", line);
  const std::string doubt = doubts.text(noun);
  const std::string next = next_command(arguments, computed_points, doubts);
  if (!doubt.empty() || !next.empty())
    print("{}{}{}{}\n", doubt.empty() ? "" : "not certain: ", doubt, doubt.empty() || next.empty() ? "" : "; ",
          next.empty() ? next : "next: " + next);
}

/// The identity of the study in a folder.
/// @throws InputError if there is none
std::string identity_of_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::is_regular_file(folder / "run.json", error)) {
    const input::JsonSource run = input::read_json_file(folder / "run.json");
    if (run.complete && run.value.is_object() && run.value.contains("identity") && run.value["identity"].is_string())
      return run.value["identity"].get<std::string>();
  }
  throw InputError(folder.string() + ": contains no study");
}

/// Replaces the resolved input of a folder by the files that it was made of, for the copies in another folder.
void use_files_of(const std::filesystem::path& folder, input::LoadedInput& input) {
  const auto read = [&](const char* name) {
    const std::filesystem::path file = folder / name;
    const FileDescriptor descriptor = store::open_data_file(file, O_RDONLY);
    if (!descriptor.is_open()) throw_output_error(file, "open", errno);
    return input::RawFile{name, read_all(descriptor.get(), file)};
  };
  input.study_file = read("input.json");
  std::error_code error;
  if (std::filesystem::exists(folder / "input.stage.json", error)) input.stage_file = read("input.stage.json");
}

/// Puts the points of a folder with parts into the store.
void merge_into(store::PointStore& store, const std::filesystem::path& folder, const std::string& identity,
                std::size_t points, std::string_view noun) {
  const store::PointStore from(folder, identity, points, store::Journal::Use::read);
  for (std::size_t point = 0; point < points; ++point) {
    if (!from.holds(point)) continue;
    const studies::PointResult result = from.read(point);
    if (!store.holds(point))
      store.append(result);
    else if (store::encode_point(store.read(point)) != store::encode_point(result))
      throw store::DamagedData(fmt::format("{}: its record of point {} differs from another", folder.string(), point));
  }
  print_message("{}: has {} of {} {}\n", folder.string(), from.size(), points, noun);
}

/// Computes a part of the points into the folder, beside other parts, and writes no results.
int compute_part(const Arguments& arguments, std::string_view command, std::string_view noun,
                 const input::LoadedInput& input, const studies::SweepPlan& plan,
                 const studies::ModelAtPoint& model_at) {
  const store::Part& part = arguments.part;
  const std::string name = fmt::format("part {}/{}", part.number, part.of);
  const std::string identity = identity_of(input, command);
  store::OutputFolder folder(arguments.output, identity, false, store::FolderUse::shared);
  const std::string where = folder.path().string();
  if (const auto code = enter_shared(folder, input, arguments.quiet)) return *code;
  try {
    store::PointStore store(folder.path(), identity, plan.points.size(), part);
    for (const auto& [journal, bytes] : store.cut_tails()) report_cut_tail(journal, bytes);
    PartPoints points = points_of(arguments, plan, store);
    const bool nothing_to_do = points.missing == 0;
    if (!nothing_to_do) {
      studies::LaneUse lanes;
      (void)compute_missing(arguments, command, noun, input, plan, model_at, store, nullptr, lanes);
      folder.require_there();
      points = points_of(arguments, plan, store);
    }
    if (points.missing > 0) {
      print_message("{}: {} stopped after {} of {} {}; re-run the same command to resume\n", where, name,
                    points.all - points.missing, points.all, noun);
      return stopped_early;
    }
    if (!arguments.quiet)
      print_part(arguments, where, nothing_to_do, fmt::format("{} of {} {}", points.all, plan.points.size(), noun),
                 {{"points", points.all}});
    return done;
  } catch (const store::JournalInUse&) {
    print_message("{}: another process computes {}\n", where, name);
    return stopped_early;
  }
}

int lead(const Arguments& arguments, std::string_view command, std::string_view noun,
         const std::vector<ResultsPart>& parts, const AfterPoints& after, SweepLeader* leader) {
  input::LoadedInput input = input::load_input(arguments.input, input::parse_assignments(arguments.sets));
  if (!arguments.merged.empty()) use_files_of(arguments.merged.front(), input);
  require_kind(input, arguments, command);
  const studies::SweepPlan plan = input::plan_of(input.study);
  const studies::ModelAtPoint model_at = input::model_at_point(input);
  // Options that do not fit show here, before anything is written.
  const model::DynamicModel first_model = model_at(plan.points.front());
  if (!arguments.quiet) print_warnings(input);
  if (!arguments.quiet && command == "sweep" && input.study.sweep().axis.name != studies::speed_parameter)
    print_message("operation: mesh_frequency_ratio = {}\n", input.study.mesh_frequency_ratio);

  if (arguments.part.of > 0) return compute_part(arguments, command, noun, input, plan, model_at);

  std::unique_ptr<GrownStudy> grown;
  if (!arguments.grow.empty()) grown = std::make_unique<GrownStudy>(arguments.grow, input, plan, command);

  const std::string identity = identity_of(input, command);
  for (const std::filesystem::path& from : arguments.merged) {
    if (identity_of_folder(from) == identity) continue;
    print_message("{}: contains another study than {}, or one of another version of the numerics\n", from.string(),
                  arguments.merged.front().string());
    return other_study;
  }
  if (leader != nullptr) leader->gather(arguments, identity);
  Session session(arguments, input, identity, arguments.threads, arguments.ranks->size());
  if (const auto code = session.exit_code()) return *code;
  store::OutputFolder& folder = session.folder();

  store::PointStore store(folder.path(), identity, plan.points.size());
  for (const auto& [journal, bytes] : store.cut_tails()) report_cut_tail(journal, bytes);
  for (const std::filesystem::path& from : arguments.merged)
    merge_into(store, from, identity, plan.points.size(), noun);
  report_points_of_parts(arguments, store, plan, noun);
  std::size_t taken = 0;
  if (grown) {
    taken = grown->take_into(store);
    print_message("{}: {} of {} {} are those of {}; the others are computed\n", folder.path().string(), taken,
                  plan.points.size(), noun, arguments.grow.string());
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
    print_message("stopped after {} of {} {}; re-run the same command to resume\n", store.size(), plan.points.size(),
                  noun);
    return stopped_early;
  };
  // A host waits for the end, so that results are not begun.
  if (store.size() < plan.points.size() || (host() != nullptr && stop_requested())) return stopped();

  folder.require_there();
  const ComputedPoints computed_points{folder.path(), input, first_model, session.resolved(), store.source()};
  if (after) {
    auto first = after(arguments, computed_points);
    if (!first) return stopped();
    written = std::move(*first);
  }
  folder.require_there();
  try {
    write_results(arguments, parts, computed_points, leader, written);
  } catch (const Stopped&) {
    return stopped();
  }
  folder.add(written.files);
  undrawn = report_undrawn(written.figures);
  close_run(store::RunState::complete);
  for (const std::string& note : written.notes) print_message("{}\n", note);

  if (!arguments.quiet) print_result(arguments, noun, computed_points, written, failed);
  return failed == 0 && undrawn == 0 && written.unexplained == 0 ? done : done_with_failures;
}

}  // namespace

int merge_command(const Arguments& arguments) {
  const std::filesystem::path& first = arguments.merged.front();
  for (const std::filesystem::path& folder : arguments.merged) (void)identity_of_folder(folder);
  Arguments of = arguments;
  of.input = first / "input.resolved.json";
  const std::string kind(input::load_input(of.input).study.kind());
  if (kind != "sweep" && kind != "map" && kind != "basins")
    throw InputError(fmt::format("{}: is a study of kind {}; only folders of sweep, map and basins are merged",
                                 first.string(), kind));
  return command_of(kind).run(of);
}

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
    print_message("{}\n", failure.what());
    code = failure.exit_code();
  }
  leader.dismiss(code);
  return code;
}

}  // namespace epicyclic::app
