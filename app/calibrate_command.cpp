// epicyclic calibrate: what is not published of a stage, from what is claimed of it.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "folder.hpp"
#include "input/claims_input.hpp"
#include "input/study_model.hpp"
#include "progress.hpp"
#include "reports/calibrate_output.hpp"
#include "session.hpp"
#include "stop.hpp"
#include "store/candidate_record.hpp"
#include "store/journal.hpp"
#include "streams.hpp"
#include "studies/calibration.hpp"

namespace epicyclic::app {

namespace {

/// The input with a candidate's values in place, each with its origin.
nlohmann::json calibrated_input(const std::filesystem::path& path, std::vector<input::Assignment> sets,
                                const studies::ParameterSpace& space, std::span<const double> u,
                                const std::string& origin) {
  const std::vector<input::Assignment> values = input::candidate_assignments(space, u);
  sets.insert(sets.end(), values.begin(), values.end());
  return input::with_origins(input::load_input(path, sets).resolved, values, origin);
}

}  // namespace

int calibrate_command(const Arguments& arguments) {
  stop_on_signals();
  const std::vector<input::Assignment> sets = input::parse_assignments(arguments.sets);
  const input::LoadedInput input = input::load_input(arguments.input, sets);
  require_kind(input, arguments, "claims");
  const auto& options = std::get<studies::ClaimsOptions>(input.study.plan);
  if (options.space.dimension() == 0) throw InputError("/study/parameters: is empty; there is nothing to search for");
  const studies::CandidateModels models = input::candidate_models(arguments.input, sets, options);
  // What does not fit shows here, before anything is written.
  const std::vector<double> middle(options.space.dimension(), 0.5);
  for (const studies::ClaimSweep& sweep : options.sweeps)
    for (const double value : {sweep.axis.from, sweep.axis.to}) (void)models(middle)(sweep, value);
  tell_warnings(input);

  Session session(arguments, input, identity_of(input, "calibrate"), arguments.threads);
  if (const auto code = session.exit_code()) return *code;
  const store::OutputFolder& folder = session.folder();

  store::Journal journal(folder.file("journal.bin"), session.identity());
  tell_cut_tail(folder.file("journal.bin"), journal.cut_bytes());
  studies::CalibrationRun run;
  run.threads = arguments.threads;
  run.stop = &stop_requested();
  double best = std::numeric_limits<double>::infinity();
  const auto see = [&](const studies::EvaluatedCandidate& c) {
    if (!c.evaluation.given_up) best = std::min(best, c.evaluation.cost);
  };
  for (const store::JournalEntry& entry : journal.entries()) {
    studies::EvaluatedCandidate c = store::decode_candidate(journal.read(entry));
    see(c);
    run.known.insert_or_assign(c.key, std::move(c));
  }
  const std::size_t earlier = run.known.size();
  std::size_t finished = earlier;
  Progress progress("calibrate", studies::most_evaluations(options), earlier);
  run.evaluated = [&](const studies::EvaluatedCandidate& c) {
    journal.append(finished, store::encode_candidate(c));
    see(c);
    progress.update(++finished, "least cost " + short_text(best, 4));
  };
  const auto found = studies::calibrate(options, studies::by_brief_looks(options, models, &stop_requested()),
                                        {input::given_candidate(input, options.space)}, std::move(run));
  progress.finish();
  journal.close();
  const auto close_run = [&](store::RunState state) {
    session.end(state, {{"candidates", static_cast<std::int64_t>(finished)}});
  };
  if (!found) {
    close_run(store::RunState::stopped);
    tell("stopped after {} candidates; the same command goes on\n", finished);
    return stopped_early;
  }

  folder.require_there();
  const reports::CalibrateOutput output{options, input.study.name, reports::figure_title(input.study)};
  reports::write_candidates_csv(folder.file("candidates.csv"), output, found->evaluations);
  reports::write_profile_csv(folder.file("profile.csv"), output, *found);
  const std::string origin = fmt::format("calibrated: by claims of {}, seed {}", input.study.name, options.search.seed);
  nlohmann::json best_input = calibrated_input(arguments.input, sets, options.space, found->best.u, origin);
  write_file_atomically(folder.file("best.json"), best_input.dump(2) + "\n");
  nlohmann::json stage = best_input["stage"];
  write_file_atomically(folder.file("stage.json"), stage.dump(2) + "\n");
  const std::string summary = reports::calibrate_summary(output, *found);
  write_file_atomically(folder.file("calibrate.md"), summary);
  close_run(store::RunState::complete);
  if (arguments.json) {
    nlohmann::json told = {{"folder", folder.path().string()},
                           {"candidates", found->evaluations.size()},
                           {"cost", found->best.evaluation.cost},
                           {"best", folder.file("best.json").string()}};
    print("{}\n", told.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print("{}\nbest: {}\n", summary, folder.file("best.json").string());
  }
  return done;
}

}  // namespace epicyclic::app
