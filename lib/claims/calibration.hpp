// A search for the unstated parameters of a stage: global, by islands of a self-adapting differential evolution
// (pagmo's de1220: Storn and Price 1997; self-adaptation by Brest et al. 2006, Elsayed et al. 2011), then local, by a
// compass search from the best; then some of the best are held against whole sweeps, and the profile of the cost is
// taken along each parameter through the result.
//
// Everything is a function of the options: an island draws its random numbers from its own seed and evaluates its
// candidates one after another, islands exchange their best after fixed numbers of generations, and a candidate is
// given up only by what is known on its own island. The refinement and the whole sweeps begin with what the phases
// before them found, and with nothing else. So threads do not count, and a search that was stopped goes on from
// the evaluations that were kept: it is run again, and asks for those instead of computing them.
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

/// Which evaluation it is: of an island, or of the phases after the islands, in its order there.
struct EvaluationKey {
  std::size_t phase = 0;   ///< 0 ... islands - 1, then the refinement, the profile, and candidates by whole sweeps
  std::size_t number = 0;  ///< in the order in which they are asked for

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
  /// Told of each new one, one at a time.
  std::function<void(const EvaluatedCandidate&)> evaluated;
};

/// A value of a parameter or an option of a choice, with all others as in the result.
struct ProfilePoint {
  std::size_t variable = 0;  ///< of the unit cube
  double u = 0;
  Evaluation evaluation;
};

/// A candidate that was held against whole sweeps.
struct Confirmed {
  EvaluatedCandidate candidate;  ///< by its glance
  Evaluation whole;
};

/// Candidates for whole sweeps: by rising cost, none nearer to an earlier one than this in each variable that counts.
/// What lies nearer looks the same.
inline constexpr double least_distance = 0.01;

struct Calibration {
  bool complete = false;                   ///< not stopped
  KnownEvaluations evaluations;            ///< all of them
  std::optional<EvaluatedCandidate> best;  ///< so far, if it was stopped; nothing before the first
  std::vector<ProfilePoint> profile;       ///< by variable, then u; of a complete search
  std::vector<Confirmed> confirmed;        ///< the first is the result, unless none is a valid stage all along

  /// Of the result by whole sweeps; null where none were asked for, or none of them is a valid stage all along.
  [[nodiscard]] const Evaluation* whole() const {
    return confirmed.empty() || !confirmed.front().whole.refused.empty() ? nullptr : &confirmed.front().whole;
  }
};

/// How many evaluations there are at the most.
[[nodiscard]] std::size_t most_evaluations(const ClaimsOptions& options);

/// @param first  candidates that the first island begins with, as points of the unit cube
/// @throws InputError when kept evaluations are not those that this search asks for, or none is of a valid candidate
[[nodiscard]] Calibration calibrate(const ClaimsOptions& options, const Evaluator& evaluate,
                                    const std::vector<std::vector<double>>& first, CalibrationRun run);

}  // namespace epicyclic::claims
