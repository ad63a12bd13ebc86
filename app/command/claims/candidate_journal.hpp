// Evaluated candidates of a search or a survey: those of earlier sessions, and new ones kept as they come.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "claims/calibration.hpp"
#include "folder.hpp"
#include "progress.hpp"
#include "store/journal.hpp"
#include "store/output_folder.hpp"
#include "store/part.hpp"

namespace epicyclic::app {

class CandidateJournal {
 public:
  /// Opens the journal of this process and reads those of parts.
  /// @param part  that this process computes; without one it has the folder for itself
  /// @throws as Journal, and DamagedData if two records of a candidate differ
  CandidateJournal(const store::OutputFolder& folder, const std::string& identity, const store::Part& part = {});
  CandidateJournal(const CandidateJournal&) = delete;
  CandidateJournal& operator=(const CandidateJournal&) = delete;

  /// Shows progress from here on.
  /// @param command   for the progress line
  /// @param total     evaluations at the most
  /// @param whole     by whole sweeps, after all of those: they take longer, and have a progress line of their own
  /// @param finished  of both
  void show_progress(const std::string& command, std::size_t total, std::size_t whole, std::size_t finished,
                     std::size_t claims);

  /// What a search or a survey is run with. This has to outlive it.
  [[nodiscard]] claims::CalibrationRun run(int threads, const std::atomic<bool>& stop);

  [[nodiscard]] std::size_t records() const { return records_; }  ///< of the journal of this process

  /// Evaluations of all journals, as they were read.
  [[nodiscard]] const claims::KnownEvaluations& known() const { return known_; }

  /// Reads the journals of other processes once more.
  /// @throws as the constructor
  void read_others();

  /// The parts that have a journal here, and the evaluations in their journals.
  [[nodiscard]] const PartsOfFolder& parts() const { return parts_; }

  void close();

 private:
  std::size_t read(const store::Journal& journal);
  void see(const claims::EvaluatedCandidate& candidate);
  [[nodiscard]] std::string words() const;
  void report_progress();

  std::filesystem::path folder_;
  std::string identity_, own_;
  store::Journal journal_;
  claims::KnownEvaluations known_;
  std::size_t records_ = 0;  ///< of the own journal
  PartsOfFolder parts_;
  std::size_t finished_ = 0;
  std::size_t claims_ = 0;
  std::size_t most_ = 0;  ///< claims that one candidate meets
  double least_ = std::numeric_limits<double>::infinity();
  std::string command_;
  std::size_t total_ = 0, whole_ = 0;
  std::optional<Progress> progress_;
  bool of_whole_ = false;  ///< what the line is of
};

}  // namespace epicyclic::app
