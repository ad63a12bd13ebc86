// epicyclic calibrate: what is not published of a stage, from what is claimed of it.

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "candidate_journal.hpp"
#include "commands.hpp"
#include "core/atomic_file.hpp"
#include "core/errors.hpp"
#include "folder.hpp"
#include "input/claims_input.hpp"
#include "input/study_model.hpp"
#include "ranks/ranks.hpp"
#include "ranks/shared_evaluations.hpp"
#include "reports/calibrate_output.hpp"
#include "session.hpp"
#include "stop.hpp"
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

studies::Evaluator make_evaluator(const input::LoadedInput& input, const Arguments& arguments,
                                  const std::atomic<bool>& stop) {
  const auto& options = std::get<studies::ClaimsOptions>(input.study.plan);
  const std::vector<input::Assignment> sets = input::parse_assignments(arguments.sets);
  return studies::by_glances(options, studies::search_glance(options),
                             input::candidate_models(arguments.input, sets, options), &stop);
}

int lead(const Arguments& arguments, SharedEvaluations& shared) {
  stop_on_signals(arguments.ranks->size() > 1 ? patience_of_ranks : patience);
  const std::vector<input::Assignment> sets = input::parse_assignments(arguments.sets);
  const input::LoadedInput input = input::load_input(arguments.input, sets);
  require_kind(input, arguments, "claims");
  const auto& options = std::get<studies::ClaimsOptions>(input.study.plan);
  if (options.space.dimension() == 0) throw InputError("/study/parameters: is empty; there is nothing to search for");
  require_candidates(options, input::candidate_models(arguments.input, sets, options));
  tell_warnings(input);

  const std::string identity = identity_of(input, "calibrate");
  shared.gather(identity);
  Session session(arguments, input, identity, arguments.threads, arguments.ranks->size());
  if (const auto code = session.exit_code()) return *code;
  const store::OutputFolder& folder = session.folder();

  std::vector<std::string> moved;
  const std::vector<double> given = input::given_candidate(input, options.space, &moved);
  for (const std::string& words : moved)
    tell("the stage as it is given lies outside the ranges; the first candidate has {}\n", words);
  CandidateJournal journal(session, "calibrate", studies::most_evaluations(options), options.claims.size());
  studies::Calibration found;
  shared.run(make_evaluator(input, arguments, shared.stop()), [&](const studies::Evaluator& evaluate, int threads) {
    found = studies::calibrate(options, evaluate, {given}, journal.run(threads, shared.stop()));
  });
  journal.close();
  const auto close_run = [&](store::RunState state) {
    session.end(state, {{"candidates", static_cast<std::int64_t>(journal.finished())}});
  };

  folder.require_there();
  // A search that was stopped leaves what it has found so far.
  const reports::CalibrateOutput output{options, input.study.name};
  reports::write_candidates_csv(folder.file("candidates.csv"), output, found.evaluations);
  if (found.complete) reports::write_profile_csv(folder.file("profile.csv"), output, found);
  std::string summary;
  if (found.best) {
    const std::string origin =
        fmt::format("calibrated: by claims of {}, seed {}", input.study.name, options.search.seed);
    nlohmann::json best_input = calibrated_input(arguments.input, sets, options.space, found.best->u, origin);
    write_file_atomically(folder.file("best.json"), best_input.dump(2) + "\n");
    nlohmann::json stage = best_input["stage"];
    write_file_atomically(folder.file("stage.json"), stage.dump(2) + "\n");
    summary = reports::calibrate_summary(output, found);
    write_file_atomically(folder.file("calibrate.md"), summary);
  }
  if (!found.complete) {
    close_run(store::RunState::stopped);
    tell("stopped after {} candidates; the same command goes on\n", journal.finished());
    return stopped_early;
  }
  close_run(store::RunState::complete);
  if (arguments.json) {
    nlohmann::json told = {{"folder", folder.path().string()},
                           {"candidates", found.evaluations.size()},
                           {"cost", found.best->evaluation.cost},
                           {"best", folder.file("best.json").string()}};
    print("{}\n", told.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print("{}\nbest: {}\n", summary, folder.file("best.json").string());
  }
  return done;
}

}  // namespace

int calibrate_command(const Arguments& arguments) {
  return share_evaluations(arguments, "calibrate", make_evaluator,
                           [&](SharedEvaluations& shared) { return lead(arguments, shared); });
}

}  // namespace epicyclic::app
