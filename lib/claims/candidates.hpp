// Candidates for the unstated parameters of a stage. Each is judged by a screening of the claims' sweeps: cold starts
// on coarse grids, side by side in lanes. Or it is judged by the whole sweeps, as `reproduce` computes them.
//
// The cost of a candidate is the sum over claims of weight times cost. Costs are not negative, so that the sum over the
// claims of the known sweeps is a lower bound. Once this bound reaches `give_up_at`, the rest is not computed.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "claims/judging.hpp"
#include "integrate/options.hpp"
#include "model/dynamic_model.hpp"

namespace epicyclic::claims {

/// The model of a candidate at a value of a sweep.
using SweepModels = std::function<model::DynamicModel(const ClaimSweep& sweep, double value)>;

/// The models of a candidate; called from several threads at once.
/// @throws InputError if the numbers contradict each other
using CandidateModels = std::function<SweepModels(std::span<const double> u)>;

struct Evaluation {
  double cost = std::numeric_limits<double>::infinity();  ///< a lower bound where given up
  bool stopped_early = false;
  std::string refused;              ///< why there are no models: it is no valid candidate
  std::vector<double> claim_costs;  ///< of each claim; not a number if it was not judged
  std::vector<char> holds;          ///< of each claim: 1 if it holds, 0 if not, or not known
};

/// How candidates are screened: with which records, and at how many points of each sweep.
struct Glance {
  Screening recording;
  int ClaimSweep::*points = &ClaimSweep::screening_points;
  SearchLead regime_cost = SearchLead::regimes;
  Reading reading = Reading::evidence;
};

/// The screening of a search, and that of a survey.
[[nodiscard]] Glance search_glance(const ClaimsOptions& options);
[[nodiscard]] Glance survey_glance(const ClaimsOptions& options);

/// Stopped from outside before it was finished: there is no result.
class EvaluationStopped {};

/// @param thread  index of the calling thread
/// @param stop    may be null
/// @throws EvaluationStopped
[[nodiscard]] Evaluation evaluate(const ClaimsOptions& options, const Glance& glance, const SweepModels& models,
                                  double give_up_at, std::size_t thread, const std::atomic<bool>* stop);

/// Evaluates by the whole sweeps, from the first of the study's starts, in one thread: the verdicts of `reproduce`.
/// @param stop  may be null
/// @throws EvaluationStopped
[[nodiscard]] Evaluation evaluate_whole(const ClaimsOptions& options, const integrate::IntegratorOptions& integrator,
                                        Reading reading, const SweepModels& models, const std::atomic<bool>* stop);

/// What is requested of a candidate.
struct Question {
  std::span<const double> u;
  double give_up_at = std::numeric_limits<double>::infinity();  ///< of a screening
  std::size_t thread = 0;                                       ///< index of the calling thread
  bool whole = false;                                           ///< by whole sweeps, not by a screening
};

/// Evaluates a candidate; called from several threads at once.
/// @throws EvaluationStopped
using Evaluator = std::function<Evaluation(const Question& question)>;

/// By the models of candidates; one whose models are refused costs more than any other. `options` must outlive the
/// result.
/// @param integrator  of whole sweeps
/// @param stop        may be null
[[nodiscard]] Evaluator evaluator_of(const ClaimsOptions& options, const Glance& glance,
                                     const integrate::IntegratorOptions& integrator, CandidateModels models,
                                     const std::atomic<bool>* stop);

/// The record of some sweeps by a screening, in its reading.
/// @throws EvaluationStopped
void screen(const ClaimsOptions& options, const Glance& glance, const SweepModels& models,
            const std::vector<const ClaimSweep*>& sweeps, std::size_t thread, const std::atomic<bool>* stop,
            ClaimRecord& record);

}  // namespace epicyclic::claims
