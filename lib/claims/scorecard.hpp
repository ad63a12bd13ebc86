// The files of a comparison of claims with sweeps: the scorecard, and the figures as they are published.
//
//   scorecard.csv   a row per claim: its verdict for each start, whether it holds for any stage, the measured numbers
//   scorecard.md    the same in words
//   figures/        bifurcation diagrams, in panels
//
// All of it follows from the sweeps' points alone and is the same, byte for byte, for the same study.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "claims/judging.hpp"
#include "reports/sweep_output.hpp"
#include "studies/point_source.hpp"

namespace epicyclic::claims {

/// The outcomes of the claims with one kind of start, in one reading.
struct ScoredStart {
  studies::Start start = studies::Start::continued;
  Reading reading = Reading::evidence;
  std::vector<ClaimOutcome> outcomes;  ///< of each claim, in order
};

/// The verdicts as printed with dots of another size, for the first of the starts.
struct ScoredDots {
  double dot = 0;
  std::vector<char> holds;  ///< of each claim
};

struct Scorecard {
  std::string name;  ///< of the study
  ClaimsOptions options;
  std::vector<ScoredStart> scored;  ///< in the order of the options' readings, and of their starts
  std::vector<ScoredDots> other_dots;

  /// Claims that hold with the start and in the reading that the claims state first, and how many of them hold for any
  /// stage.
  [[nodiscard]] std::size_t holding() const;
  [[nodiscard]] std::size_t holding_inert() const;
};

/// Judges all claims in all readings.
/// @param records  by evidence, one for each of the starts
[[nodiscard]] Scorecard score(std::string name, const ClaimsOptions& options, const std::vector<ClaimRecord>& records);

[[nodiscard]] std::string scorecard_csv(const Scorecard& card);
[[nodiscard]] std::string scorecard_summary(const Scorecard& card);

/// Verdicts that were recorded of a study:
///
///   { "format": "epicyclic scorecard 1", "verdicts": [ { "claim": "C01", "continued": "holds", ... }, ... ],
///     "study": the resolved input }
[[nodiscard]] std::string recorded_text(const Scorecard& card, const input::LoadedInput& study);

struct RecordedDifference {
  std::vector<std::string> study;     ///< in what the study is not the recorded one; how it is integrated may differ
  std::vector<std::string> verdicts;  ///< that are not the recorded ones, of the same study
};

/// @throws InputError if the file is not one of recorded_text()
[[nodiscard]] nlohmann::json read_recorded(const std::filesystem::path& file);

/// @param recorded  of read_recorded()
[[nodiscard]] RecordedDifference unlike_recorded(const Scorecard& card, const input::LoadedInput& study,
                                                 const nlohmann::json& recorded);

/// The points of a sweep by its name.
using SweepPoints = std::function<studies::PointSource(const std::string& sweep)>;

/// @param record  with the first of the starts, by evidence
/// @throws OutputError, and what reading points throws
[[nodiscard]] std::vector<reports::DrawnFigure> draw_claim_figures(const std::filesystem::path& folder,
                                                                   const Scorecard& card, const ClaimRecord& record,
                                                                   const std::string& title, const SweepPoints& points);

}  // namespace epicyclic::claims
