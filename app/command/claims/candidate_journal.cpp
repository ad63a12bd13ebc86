#include "candidate_journal.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "claims/candidate_record.hpp"
#include "core/text.hpp"
#include "folder.hpp"

namespace epicyclic::app {

namespace {

/// @param finished  set to the number of records
claims::KnownEvaluations read_known(const store::Journal& journal, std::size_t& finished) {
  claims::KnownEvaluations known;
  for (const store::JournalEntry& entry : journal.entries()) {
    claims::EvaluatedCandidate c = claims::decode_candidate(journal.read(entry));
    known.insert_or_assign(c.key, std::move(c));
    ++finished;
  }
  return known;
}

}  // namespace

CandidateJournal::CandidateJournal(Session& session, const std::string& command, std::size_t total, std::size_t whole,
                                   std::size_t claims)
    : journal_(session.folder().file("journal.bin"), session.identity()),
      known_(read_known(journal_, finished_)),
      claims_(claims),
      command_(command),
      total_(total),
      whole_(whole) {
  report_cut_tail(session.folder().file("journal.bin"), journal_.cut_bytes());
  for (const auto& [key, candidate] : known_) see(candidate);
  if (finished_ < total_) progress_.emplace(command_, total_, finished_);
  report_progress();
}

void CandidateJournal::report_progress() {
  if (finished_ >= total_ && whole_ > 0 && !of_whole_) {
    of_whole_ = true;
    if (progress_) progress_->update(finished_, words());
    progress_.emplace(command_ + ", whole sweeps", whole_, finished_ - total_);
  }
  if (progress_) progress_->update(of_whole_ ? finished_ - total_ : finished_, words());
}

claims::CalibrationRun CandidateJournal::run(int threads, const std::atomic<bool>& stop) {
  claims::CalibrationRun run;
  run.threads = threads;
  run.stop = &stop;
  run.known = std::move(known_);
  run.evaluated = [this](const claims::EvaluatedCandidate& candidate) {
    journal_.append(finished_, claims::encode_candidate(candidate));
    see(candidate);
    ++finished_;
    report_progress();
  };
  return run;
}

void CandidateJournal::see(const claims::EvaluatedCandidate& candidate) {
  const claims::Evaluation& e = candidate.evaluation;
  if (e.stopped_early) return;
  least_ = std::min(least_, e.cost);
  most_ = std::max(most_, static_cast<std::size_t>(std::ranges::count(e.holds, 1)));
}

std::string CandidateJournal::words() const {
  return fmt::format("least cost {}, at most {} of {} claims", short_text(least_, 4), most_, claims_);
}

void CandidateJournal::close() {
  if (progress_) progress_->finish();
  journal_.close();
}

}  // namespace epicyclic::app
