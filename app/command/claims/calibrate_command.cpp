// epicyclic calibrate: unpublished parameters of a stage, from the claims on it.

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "candidate_journal.hpp"
#include "claims/calibrate_output.hpp"
#include "claims/calibration.hpp"
#include "claims/inputs.hpp"
#include "claims/kind.hpp"
#include "claims/period_one.hpp"
#include "claims_commands.hpp"
#include "core/atomic_file.hpp"
#include "core/errors.hpp"
#include "folder.hpp"
#include "preparation.hpp"
#include "ranks/ranks.hpp"
#include "session.hpp"
#include "shared_evaluations.hpp"
#include "stop.hpp"
#include "streams.hpp"
#include "studies/classification.hpp"

namespace epicyclic::app {

namespace {

/// Can multipliers lead from the stage as it is given? Candidates with readings that have none are refused one by one.
void require_multipliers(const input::LoadedInput& input, const std::vector<double>& given) {
  const auto& options = claims::claims_in(input.study);
  if (options.search.regime_cost != claims::SearchLead::multipliers) return;
  const claims::CandidateModels models = claims::candidate_models(input);
  const claims::ClaimSweep& sweep = options.sweeps.front();
  if (!studies::has_classification(models(given)(sweep, sweep.axis.from)))
    throw InputError(std::string("/study/search/regime_cost: there are no multipliers: ") + claims::no_multipliers);
}

int search(const Arguments& arguments, SharedEvaluations& shared) {
  const input::LoadedInput input = load_open_claims(arguments);
  const auto& options = claims::claims_in(input.study);

  const claims::GivenCandidate given = claims::given_candidate(input, options.space);
  require_multipliers(input, given.u);

  const std::string identity = identity_of(input, "calibrate", claims::judging_version);
  shared.gather(identity);
  Session session(arguments, input, identity, arguments.threads, arguments.ranks->size());
  if (const auto code = session.exit_code()) return *code;
  const store::OutputFolder& folder = session.folder();

  for (const std::string& words : given.moved)
    print_message("the stage as it is given is no candidate; the first one has {}\n", words);
  CandidateJournal journal(folder, identity);
  journal.show_progress("calibrate", claims::most_evaluations(options), 0, journal.records(), options.claims.size());
  claims::Calibration found;
  shared.run(evaluator_by(claims::search_glance)(input, shared.stop()),
             [&](const claims::Evaluator& evaluate, int threads) {
               found = claims::calibrate(options, evaluate, {given.u}, journal.run(threads, shared.stop()));
             });
  journal.close();
  std::int64_t undrawn = 0;
  const auto close_run = [&](store::RunState state) {
    session.end(state, {{"candidates", static_cast<std::int64_t>(journal.records())}, {"undrawn", undrawn}});
  };

  folder.require_there();
  // A search that was stopped leaves its results so far.
  const claims::CalibrateOutput output{options, input.study.name};
  claims::write_candidates_csv(folder.file("candidates.csv"), output, found.evaluations);
  if (found.complete) claims::write_profile_csv(folder.file("profile.csv"), output, found);
  std::string summary;
  if (found.best) {
    const std::string origin =
        fmt::format("calibrated: by claims of {}, seed {}", input.study.name, options.search.seed);
    const nlohmann::json best_input = claims::candidate_input(input, options.space, found.best->u, origin);
    write_file_atomically(folder.file("best.json"), best_input.dump(2) + "\n");
    nlohmann::json stage = best_input["stage"];
    write_file_atomically(folder.file("stage.json"), stage.dump(2) + "\n");
    summary = claims::calibrate_summary(output, found);
    write_file_atomically(folder.file("calibrate.md"), summary);
  }
  if (!found.complete) {
    close_run(store::RunState::stopped);
    print_message("stopped after {} candidates; re-run the same command to resume\n", journal.records());
    return stopped_early;
  }
  std::vector<reports::DrawnFigure> figures;
  if (!found.profile.empty()) figures.push_back(claims::draw_determination(folder.file("figures"), output, found));
  undrawn = report_undrawn(figures);
  close_run(store::RunState::complete);
  if (arguments.json) {
    nlohmann::json summary_json = {{"folder", folder.path().string()},
                                   {"candidates", found.evaluations.size()},
                                   {"cost", found.best->evaluation.cost},
                                   {"best", folder.file("best.json").string()}};
    print("{}\n", summary_json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print("{}\nbest: {}\n", summary, folder.file("best.json").string());
    for (const auto& figure : figures)
      if (figure.outcome.drawn()) print("figure: {}\n", figure.file.string());
  }
  return undrawn == 0 ? done : done_with_failures;
}

}  // namespace

int calibrate_command(const Arguments& arguments) {
  return share_evaluations(arguments, "calibrate", evaluator_by(claims::search_glance),
                           [&](SharedEvaluations& shared) { return search(arguments, shared); });
}

}  // namespace epicyclic::app
