// epicyclic reproduce: compares the claims of a publication with a stage. Each sweep of the claims is a study of its
// own in a folder of its own. The results are the scorecard and the figures as they are published.

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "claims/inputs.hpp"
#include "claims/kind.hpp"
#include "claims/scorecard.hpp"
#include "claims_commands.hpp"
#include "core/atomic_file.hpp"
#include "core/counted.hpp"
#include "core/errors.hpp"
#include "finished_study.hpp"
#include "folder.hpp"
#include "installed_files.hpp"
#include "kind_commands.hpp"
#include "preparation.hpp"
#include "progress.hpp"
#include "session.hpp"
#include "stop.hpp"
#include "streams.hpp"

namespace epicyclic::app {

namespace {

/// The claims of a name are in validation/NAME: here, beside the program, or in its installation.
std::filesystem::path claims_file(const std::filesystem::path& named) {
  std::error_code none;
  if (std::filesystem::is_directory(named, none)) return named / "claims.json";
  if (std::filesystem::exists(named, none) || named.has_parent_path() || named.has_extension()) return named;
  const std::filesystem::path below = std::filesystem::path("validation") / named / "claims.json";
  if (std::filesystem::exists("." / below, none)) return "." / below;
  if (const auto file = installed_file(below)) return *file;
  throw InputError(named.string() + ": neither a file, nor a folder of validation/ here or above the program");
}

std::string folder_name(const claims::ClaimSweep& sweep, studies::Start start) {
  return start == studies::Start::cold ? sweep.name + "_cold" : sweep.name;
}

/// A command of its own in a folder of its own.
/// @param input  its text, which is put beside the folder
int run_study(const Arguments& arguments, const std::filesystem::path& folder, const std::string& name,
              const std::string& input, int (*command)(const Arguments&), std::size_t chains_before = 0) {
  Arguments of = arguments;
  of.input = folder / (name + ".json");
  of.output = folder / name;
  of.sets.clear();
  of.quiet = true;
  of.chains_before = chains_before;
  write_file_atomically(of.input, input);
  return command(of);
}

/// A sweep of the claims.
struct SweepStudy {
  const claims::ClaimSweep* sweep;
  studies::Start start;
  std::size_t chains, chains_before;  ///< its own, and those of the studies before it

  [[nodiscard]] std::string name() const { return folder_name(*sweep, start); }
};

std::vector<SweepStudy> sweep_studies(const claims::ClaimsOptions& options) {
  std::vector<SweepStudy> all;
  std::size_t before = 0;
  for (const studies::Start start : options.starts)
    for (const claims::ClaimSweep& sweep : options.sweeps) {
      const studies::SweepPlan plan = studies::plan_sweep(options.whole_sweep(sweep, start));
      all.push_back({&sweep, start, plan.chains.size(), before});
      before += plan.chains.size();
    }
  return all;
}

/// Computes a part of all sweeps into the folder, beside other parts, and writes no results. The chains of all sweeps
/// are dealt to the parts as those of one study.
int compute_part(const Arguments& arguments, const input::LoadedInput& input, const std::string& identity) {
  const store::Part& part = arguments.part;
  store::OutputFolder folder(arguments.output, identity, false, store::FolderUse::shared);
  if (const auto code = enter_shared(folder, input, arguments.quiet)) return *code;
  const std::filesystem::path sweeps = folder.file("sweeps");
  create_folder(sweeps, /*parents=*/false);
  std::size_t with_share = 0, count = 0;
  for (const SweepStudy& of : sweep_studies(claims::claims_in(input.study))) {
    ++count;
    if (store::first_of(part, of.chains_before) >= of.chains) continue;
    ++with_share;
    const int code =
        run_study(arguments, sweeps, of.name(), claims::sweep_input(input, *of.sweep, of.start).dump(2) + "\n",
                  sweep_command().run, of.chains_before);
    if (code != done && code != done_with_failures) return code;
  }
  folder.require_there();
  print_part(arguments, folder.path().string(), false, fmt::format("its share of {} of {} sweeps", with_share, count),
             {{"sweeps", with_share}});
  return done;
}

/// Where each sweep was computed.
using Finished = std::map<std::string, std::unique_ptr<FinishedStudy>, std::less<>>;

/// One record for each of the starts.
std::vector<claims::ClaimRecord> records_of(const input::LoadedInput& input, const claims::ClaimsOptions& options,
                                            const Finished& finished) {
  std::vector<claims::ClaimRecord> records;
  for (const studies::Start start : options.starts) {
    claims::ClaimRecord& record = records.emplace_back();
    for (const claims::ClaimSweep& sweep : options.sweeps)
      record[sweep.name] =
          claims::claim_series(finished.find(folder_name(sweep, start))->second->points(), options.recording);
    for (const claims::ClaimStage& stage : options.stages) record[stage.name].modes = claims::modes_of(input, stage);
  }
  return records;
}

std::filesystem::path recorded_verdicts(const Arguments& arguments) {
  if (!arguments.expected.empty()) return arguments.expected;
  std::filesystem::path beside = arguments.input;
  return beside.replace_extension(".scorecard.json");
}

}  // namespace

int reproduce_command(const Arguments& given) {
  Arguments arguments = given;
  arguments.input = claims_file(given.input);
  const input::LoadedInput input = input::load_input(arguments.input, input::parse_assignments(arguments.sets));
  require_kind(input, arguments, "claims");
  const auto& options = claims::claims_in(input.study);
  require_models(input);
  const std::filesystem::path recorded = recorded_verdicts(arguments);
  std::error_code none;
  std::optional<nlohmann::json> expected;
  // A file that is named has to be there, and only recorded verdicts are written over.
  const bool is_named = !arguments.expected.empty();
  if ((is_named && !arguments.record) || std::filesystem::exists(recorded, none))
    expected = claims::read_recorded(recorded);
  print_warnings(input);

  const std::string identity = identity_of(input, "reproduce");
  if (arguments.part.of > 0) return compute_part(arguments, input, identity);
  Session session(arguments, input, identity, arguments.threads, 1, true);
  if (const auto code = session.exit_code()) return *code;
  const store::OutputFolder& folder = session.folder();

  int worst = done;
  const std::filesystem::path sweeps = folder.file("sweeps");
  create_folder(sweeps, /*parents=*/false);
  const auto compute = [&](const std::filesystem::path& place, const std::string& name, const nlohmann::json& text,
                           int (*command)(const Arguments&), std::size_t chains_before = 0) {
    const int code = run_study(arguments, place, name, text.dump(2) + "\n", command, chains_before);
    if (code != done && code != done_with_failures) return code;
    worst = std::max(worst, code);
    return static_cast<int>(done);
  };
  int code = compute(folder.path(), "gear", input.resolved["stage"], gear_command);
  const auto begun = std::chrono::steady_clock::now();
  for (const SweepStudy& of : sweep_studies(options))
    if (code == done)
      code = compute(sweeps, of.name(), claims::sweep_input(input, *of.sweep, of.start), sweep_command().run,
                     of.chains_before);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begun;
  if (code != done) {
    session.end(store::RunState::stopped, {});
    return code;
  }

  Finished finished;
  for (const studies::Start start : options.starts)
    for (const claims::ClaimSweep& sweep : options.sweeps) {
      const std::string name = folder_name(sweep, start);
      finished[name] = std::make_unique<FinishedStudy>(sweeps / name);
    }
  const std::vector<claims::ClaimRecord> records = records_of(input, options, finished);
  const claims::Scorecard card = claims::score(input.study.name, options, records);
  const std::string summary = claims::scorecard_summary(card);
  write_file_atomically(folder.file("scorecard.csv"), claims::scorecard_csv(card));
  write_file_atomically(folder.file("scorecard.md"), summary);
  const auto figures = claims::draw_claim_figures(
      folder.file("figures"), card, records.front(), reports::figure_title(input.study), [&](const std::string& sweep) {
        return finished
            .find(folder_name(*std::ranges::find(options.sweeps, sweep, &claims::ClaimSweep::name),
                              options.starts.front()))
            ->second->points();
      });
  const std::int64_t undrawn = report_undrawn(figures);

  std::vector<std::string> unlike;
  std::vector<std::string> another_study;  // in what the recorded verdicts are of one
  if (arguments.record) {
    write_file_atomically(linked_file(recorded), claims::recorded_text(card, input));
    print_message("recorded: {}\n", recorded.string());
  } else if (expected) {
    claims::RecordedDifference difference = claims::unlike_recorded(card, input, *expected);
    another_study = std::move(difference.study);
    if (!another_study.empty())
      print_message("the verdicts in {} are of another study and are not compared: {}\n", recorded.string(),
                    another_study.front());
    unlike = std::move(difference.verdicts);
    for (const std::string& line : unlike) print_message("other than recorded in {}: {}\n", recorded.string(), line);
  }
  session.end(store::RunState::complete, {{"claims", static_cast<std::int64_t>(options.claims.size())},
                                          {"holding", static_cast<std::int64_t>(card.holding())},
                                          {"unlike", static_cast<std::int64_t>(unlike.size())},
                                          {"undrawn", undrawn}});
  print_message("{} together: {} in this session\n", counted(options.starts.size() * options.sweeps.size(), "sweeps"),
                duration_text(spent.count()));
  if (arguments.json) {
    nlohmann::json summary_json = {
        {"folder", folder.path().string()}, {"claims", options.claims.size()},
        {"holding", card.holding()},        {"holding_where_nothing_changes", card.holding_inert()},
        {"unlike_recorded", unlike},        {"figures", nlohmann::json::array()}};
    if (!another_study.empty()) summary_json["another_study"] = another_study;
    for (const auto& figure : figures)
      if (figure.outcome.drawn()) summary_json["figures"].push_back(figure.file.string());
    print("{}\n", summary_json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print("{}\n", summary);
    for (const auto& figure : figures)
      if (figure.outcome.drawn()) print("figure: {}\n", figure.file.string());
  }
  if (is_named && !another_study.empty()) return other_study;
  return unlike.empty() && undrawn == 0 ? worst : static_cast<int>(done_with_failures);
}

}  // namespace epicyclic::app
