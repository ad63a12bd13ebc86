// A search for the unstated parameters of a stage. The global search uses islands of a self-adapting differential
// evolution (pagmo's de1220: Storn and Price 1997; self-adaptation by Brest et al. 2006, Elsayed et al. 2011). The
// local search is a compass search from the best candidate. Some of the best candidates are then compared with whole
// sweeps. The profile of the cost is computed along each parameter through the result.
//
// Everything is a function of the options. An island draws its random numbers from its own seed and evaluates its
// candidates one after another. Islands exchange their best candidates after fixed numbers of generations. A candidate
// is abandoned only by results of its own island. The refinement and the whole sweeps begin with the results of earlier
// phases, and with nothing else. So the number of threads has no effect. A search that was stopped is run again, and
// reads the kept evaluations instead of computing them.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "claims/candidates.hpp"
#include "claims/options.hpp"

namespace epicyclic::claims {

/// Identifies an evaluation: its island, or the phase after the islands, and its number there.
struct EvaluationKey {
  std::size_t phase = 0;   ///< 0 ... islands - 1, then the refinement, the profile, and candidates by whole sweeps
  std::size_t number = 0;  ///< in the order of the requests

  friend auto operator<=>(const EvaluationKey&, const EvaluationKey&) = default;
};

struct EvaluatedCandidate {
  EvaluationKey key;
  std::vector<double> u;
  Evaluation evaluation;
};

using KnownEvaluations = std::map<EvaluationKey, EvaluatedCandidate>;

struct CalibrationRun {
  int threads = 1;
  const std::atomic<bool>* stop = nullptr;
  KnownEvaluations known;  ///< of earlier sessions
  /// Called for each new one, one at a time.
  std::function<void(const EvaluatedCandidate&)> evaluated;
};

/// A value of a parameter or an option of a choice, with all others as in the result.
struct ProfilePoint {
  std::size_t variable = 0;  ///< of the unit cube
  double u = 0;
  Evaluation evaluation;
};

/// A candidate that was compared with whole sweeps.
struct Confirmed {
  EvaluatedCandidate candidate;  ///< by the screening
  Evaluation whole;
};

/// Least distance between two candidates for whole sweeps, in each variable that counts. Candidates are taken by rising
/// cost. A nearer one gives almost the same sweeps.
inline constexpr double least_distance = 0.01;

struct Calibration {
  bool complete = false;                   ///< not stopped
  KnownEvaluations evaluations;            ///< all of them
  std::optional<EvaluatedCandidate> best;  ///< so far, if it was stopped; nothing before the first
  std::vector<ProfilePoint> profile;       ///< by variable, then u; of a complete search
  std::vector<Confirmed> confirmed;        ///< the first is the result, unless none is a valid stage all along

  /// Of the result by whole sweeps. It is null if none were requested, or if no candidate is a valid stage along all
  /// sweeps.
  [[nodiscard]] const Evaluation* whole() const {
    return confirmed.empty() || !confirmed.front().whole.refused.empty() ? nullptr : &confirmed.front().whole;
  }
};

/// Largest possible number of evaluations.
[[nodiscard]] std::size_t most_evaluations(const ClaimsOptions& options);

/// @param first  candidates that the first island begins with, as points of the unit cube
/// @throws InputError if kept evaluations are not those that this search requests, or if no candidate is valid
[[nodiscard]] Calibration calibrate(const ClaimsOptions& options, const Evaluator& evaluate,
                                    const std::vector<std::vector<double>>& first, CalibrationRun run);

}  // namespace epicyclic::claims
