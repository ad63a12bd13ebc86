#include "candidate_journal.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "claims/candidate_record.hpp"
#include "core/text.hpp"
#include "store/point_store.hpp"

namespace epicyclic::app {

CandidateJournal::CandidateJournal(const store::OutputFolder& folder, const std::string& identity,
                                   const store::Part& part)
    : folder_(folder.path()),
      identity_(identity),
      own_(part.of > 0 ? store::part_journal_name(part) : "journal.bin"),
      journal_(folder_ / own_, identity_) {
  report_cut_tail(folder_ / own_, journal_.cut_bytes());
  records_ = read(journal_);
  read_others();
}

/// @returns the number of its records
std::size_t CandidateJournal::read(const store::Journal& journal) {
  for (const store::JournalEntry& entry : journal.entries()) {
    claims::EvaluatedCandidate c = claims::decode_candidate(journal.read(entry));
    const auto [known, is_new] = known_.try_emplace(c.key, c);
    if (!is_new && claims::encode_candidate(known->second) != claims::encode_candidate(c))
      throw store::DamagedData(fmt::format("{}: two records of candidate {} differ", folder_.string(), c.key.number));
  }
  return journal.entries().size();
}

void CandidateJournal::read_others() {
  const bool alone = own_ == "journal.bin";
  if (std::error_code error; !alone && std::filesystem::exists(folder_ / "journal.bin", error))
    (void)read(store::Journal(folder_ / "journal.bin", identity_, store::Journal::Use::read));
  parts_.present = store::parts_in(folder_);
  parts_.computed = 0;
  for (const store::Part& part : parts_.present) {
    const std::string name = store::part_journal_name(part);
    if (name == own_) continue;
    const store::Journal journal(folder_ / name, identity_,
                                 alone ? store::Journal::Use::append : store::Journal::Use::read);
    report_cut_tail(folder_ / name, journal.cut_bytes());
    parts_.computed += read(journal);
  }
}

void CandidateJournal::show_progress(const std::string& command, std::size_t total, std::size_t whole,
                                     std::size_t finished, std::size_t claims) {
  command_ = command;
  total_ = total;
  whole_ = whole;
  finished_ = finished;
  claims_ = claims;
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
  run.known = known_;
  run.evaluated = [this](const claims::EvaluatedCandidate& candidate) {
    journal_.append(records_, claims::encode_candidate(candidate));
    see(candidate);
    ++records_;
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
