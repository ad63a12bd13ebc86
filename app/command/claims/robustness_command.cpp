// epicyclic robustness: robustness of claims against unpublished parameters; stages are drawn from their ranges.

#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "candidate_journal.hpp"
#include "claims/kind.hpp"
#include "claims/robustness.hpp"
#include "claims/robustness_output.hpp"
#include "claims_commands.hpp"
#include "core/atomic_file.hpp"
#include "folder.hpp"
#include "preparation.hpp"
#include "ranks/ranks.hpp"
#include "session.hpp"
#include "shared_evaluations.hpp"
#include "stop.hpp"
#include "streams.hpp"

namespace epicyclic::app {

namespace {

int survey(const Arguments& arguments, SharedEvaluations& shared) {
  const input::LoadedInput input = load_open_claims(arguments);
  const auto& options = claims::claims_in(input.study);

  const std::string identity = identity_of(input, "robustness", claims::judging_version);
  shared.gather(identity);
  Session session(arguments, input, identity, arguments.threads, arguments.ranks->size());
  if (const auto code = session.exit_code()) return *code;
  const store::OutputFolder& folder = session.folder();
  const auto draws = static_cast<std::size_t>(options.survey.draws);
  CandidateJournal journal(session, "robustness", draws, static_cast<std::size_t>(options.survey.confirmed),
                           options.claims.size());
  claims::KnownEvaluations evaluations;
  shared.run(evaluator_by(claims::survey_glance)(input, shared.stop()),
             [&](const claims::Evaluator& evaluate, int threads) {
               evaluations = claims::survey(options, evaluate, journal.run(threads, shared.stop()));
             });
  journal.close();
  std::int64_t undrawn = 0;
  const std::size_t surveyed = claims::surveyed_draws(evaluations).size();
  const std::size_t confirmed = evaluations.size() - surveyed;
  const auto close_run = [&](store::RunState state) {
    session.end(state, {{"draws", static_cast<std::int64_t>(surveyed)},
                        {"confirmed", static_cast<std::int64_t>(confirmed)},
                        {"undrawn", undrawn}});
  };
  if (!claims::survey_is_complete(options, evaluations)) {
    close_run(store::RunState::stopped);
    print_message(
        "stopped after {} of {} draws, {} of them compared with whole sweeps; re-run the same command to resume\n",
        surveyed, draws, confirmed);
    return stopped_early;
  }

  folder.require_there();
  const claims::RobustnessOutput output{options, input.study.name, claims::robustness(options, evaluations),
                                        claims::agreement(options, evaluations),
                                        claims::robustness_by_option(options, evaluations)};
  claims::write_draws_csv(folder.file("draws.csv"), output, evaluations);
  claims::write_robustness_tables(folder.path(), output);
  const std::string summary = claims::robustness_summary(output, evaluations);
  write_file_atomically(folder.file("robustness.md"), summary);
  const auto figures = claims::draw_robustness_figures(folder.file("figures"), output);
  undrawn = report_undrawn(figures);
  close_run(store::RunState::complete);
  if (arguments.json) {
    nlohmann::json summary_json = {
        {"folder", folder.path().string()}, {"draws", draws}, {"claims", nlohmann::json::array()}};
    for (std::size_t k = 0; k < options.claims.size(); ++k) {
      const analysis::Interval& f = output.claims[k].fraction;
      summary_json["claims"].push_back(
          {{"claim", options.claims[k].name}, {"fraction", f.value}, {"low", f.low}, {"high", f.high}});
    }
    print("{}\n", summary_json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    print("{}\n", summary);
    for (const auto& figure : figures)
      if (figure.outcome.drawn()) print("figure: {}\n", figure.file.string());
  }
  return undrawn == 0 ? done : done_with_failures;
}

}  // namespace

int robustness_command(const Arguments& arguments) {
  return share_evaluations(arguments, "robustness", evaluator_by(claims::survey_glance),
                           [&](SharedEvaluations& shared) { return survey(arguments, shared); });
}

}  // namespace epicyclic::app
