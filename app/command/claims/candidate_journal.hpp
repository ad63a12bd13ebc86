// Evaluated candidates of a search or a survey: those of earlier sessions, and new ones kept as they come.
#pragma once

#include <atomic>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "claims/calibration.hpp"
#include "progress.hpp"
#include "session.hpp"
#include "store/journal.hpp"

namespace epicyclic::app {

class CandidateJournal {
 public:
  /// @param command  for the progress line
  /// @param total    evaluations at the most
  /// @param whole    by whole sweeps, after all of those: they take longer, and have a progress line of their own
  CandidateJournal(Session& session, const std::string& command, std::size_t total, std::size_t whole,
                   std::size_t claims);
  CandidateJournal(const CandidateJournal&) = delete;
  CandidateJournal& operator=(const CandidateJournal&) = delete;

  /// What a search or a survey is run with. This has to outlive it.
  [[nodiscard]] claims::CalibrationRun run(int threads, const std::atomic<bool>& stop);

  [[nodiscard]] std::size_t finished() const { return finished_; }
  void close();

 private:
  void see(const claims::EvaluatedCandidate& candidate);
  [[nodiscard]] std::string words() const;
  void report_progress();

  store::Journal journal_;
  std::size_t finished_ = 0;  ///< records; before what counts them
  claims::KnownEvaluations known_;
  std::size_t claims_ = 0;
  std::size_t most_ = 0;  ///< claims that one candidate meets
  double least_ = std::numeric_limits<double>::infinity();
  std::string command_;
  std::size_t total_, whole_;
  std::optional<Progress> progress_;
  bool of_whole_ = false;  ///< what the line is of
};

}  // namespace epicyclic::app
