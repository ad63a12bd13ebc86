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

std::string words_of(const claims::SurveyShare& share, std::size_t draws) {
  return fmt::format("{} of {} draws, {} of them compared with whole sweeps", share.draws_known, draws,
                     share.confirmed_known);
}

/// Computes a part of the draws into the folder, beside other parts, and writes no results.
int survey_part(const Arguments& arguments, const input::LoadedInput& input, const std::string& identity) {
  const auto& options = claims::claims_in(input.study);
  const store::Part& part = arguments.part;
  const std::string name = fmt::format("part {}/{}", part.number, part.of);
  store::OutputFolder folder(arguments.output, identity, false, store::FolderUse::shared);
  const std::string where = folder.path().string();
  if (const auto code = enter_shared(folder, input, arguments.quiet)) return *code;
  try {
    CandidateJournal journal(folder, identity, part);
    claims::KnownEvaluations evaluations = journal.known();
    claims::SurveyShare share = claims::share_of(options, evaluations, part);
    const bool nothing_to_do = share.complete();
    if (!nothing_to_do) {
      journal.show_progress("robustness, " + name, share.draws, share.confirmed_most, share.known(),
                            options.claims.size());
      const claims::Evaluator evaluate = evaluator_by(claims::survey_glance)(input, stop_requested());
      // The first pass leaves draws to be confirmed that only the draws of other parts determine.
      for (int pass = 0; pass < 2 && !stop_requested(); ++pass) {
        if (pass > 0) journal.read_others();
        claims::CalibrationRun run = journal.run(arguments.threads, stop_requested());
        run.known.merge(evaluations);
        evaluations = claims::survey(options, evaluate, std::move(run), part);
      }
      folder.require_there();
      share = claims::share_of(options, evaluations, part);
    }
    journal.close();
    const std::string words = words_of(share, static_cast<std::size_t>(options.survey.draws));
    if (!share.complete()) {
      print_message("{}: {} stopped after {}; re-run the same command to resume\n", where, name, words);
      return stopped_early;
    }
    print_part(arguments, where, nothing_to_do, words, {{"draws", share.draws}, {"confirmed", share.confirmed}});
    return done;
  } catch (const store::JournalInUse&) {
    print_message("{}: another process computes {}\n", where, name);
    return stopped_early;
  }
}

int survey(const Arguments& arguments, SharedEvaluations& shared) {
  const input::LoadedInput input = load_open_claims(arguments);
  const auto& options = claims::claims_in(input.study);

  const std::string identity = identity_of(input, "robustness", claims::judging_version);
  if (arguments.part.of > 0) return survey_part(arguments, input, identity);
  shared.gather(identity);
  Session session(arguments, input, identity, arguments.threads, arguments.ranks->size());
  if (const auto code = session.exit_code()) return *code;
  const store::OutputFolder& folder = session.folder();
  const auto draws = static_cast<std::size_t>(options.survey.draws);
  CandidateJournal journal(folder, identity);
  const auto to_confirm = static_cast<std::size_t>(options.survey.confirmed);
  const std::size_t known = journal.known().size();
  PartsOfFolder parts = journal.parts();
  parts.shares = draws;
  report_parts(folder.path().string(), parts, known, draws + to_confirm, "evaluations");
  journal.show_progress("robustness", draws, to_confirm, known, options.claims.size());
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
