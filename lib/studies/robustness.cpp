#include "studies/robustness.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <string>

#include "core/errors.hpp"
#include "core/random_numbers.hpp"
#include "studies/units.hpp"

namespace epicyclic::studies {

std::vector<double> draw(const ParameterSpace& space, int seed, std::size_t index) {
  std::vector<double> u(space.dimension());
  for (std::size_t k = 0; k < u.size(); ++k)
    u[k] = random_uniform(static_cast<std::uint64_t>(seed), index * u.size() + k + 1);
  return u;
}

KnownEvaluations survey(const ClaimsOptions& options, const Evaluator& evaluate, CalibrationRun run) {
  KnownEvaluations all = std::move(run.known);
  const auto draws = static_cast<std::size_t>(options.survey.draws);
  std::vector<std::size_t> missing;
  for (std::size_t d = 0; d < draws; ++d) {
    const auto kept = all.find({0, d});
    if (kept == all.end())
      missing.push_back(d);
    else if (kept->second.u != draw(options.space, options.survey.seed, d))
      throw InputError("the evaluations that were kept are not of these draws: number " + std::to_string(d) +
                       " is another one");
  }
  std::mutex mutex;
  try {
    (void)for_units(missing.size(), run.threads, run.stop, [&](std::size_t k) {
      EvaluatedCandidate c{{0, missing[k]}, draw(options.space, options.survey.seed, missing[k]), {}};
      c.evaluation = evaluate(c.u, std::numeric_limits<double>::infinity(), k);
      const std::scoped_lock lock(mutex);
      if (run.evaluated) run.evaluated(c);
      all.emplace(c.key, std::move(c));
    });
  } catch (const EvaluationStopped&) {
    // What is there is returned.
  }
  return all;
}

std::vector<ClaimRobustness> robustness(const ClaimsOptions& options, const KnownEvaluations& evaluations) {
  const ParameterSpace& space = options.space;
  std::vector<const EvaluatedCandidate*> valid;
  for (const auto& [key, c] : evaluations)
    if (c.evaluation.refused.empty()) valid.push_back(&c);
  std::vector<ClaimRobustness> all(options.claims.size());
  for (std::size_t claim = 0; claim < all.size(); ++claim) {
    all[claim].draws = valid.size();
    all[claim].holds = static_cast<std::size_t>(
        std::ranges::count_if(valid, [&](const auto* c) { return c->evaluation.holds[claim] == 1; }));
    all[claim].fraction = analysis::fraction(all[claim].holds, valid.size());
  }
  for (std::size_t k = 0; k < space.dimension(); ++k) {
    // Its values, of the draws that it counts in.
    std::vector<double> values;
    std::vector<const EvaluatedCandidate*> counted;
    for (const EvaluatedCandidate* c : valid) {
      const std::vector<std::size_t> chosen = space.options_at(c->u);
      const bool is_parameter = k < space.parameters.size();
      if (is_parameter && !space.counts(space.parameters[k], chosen)) continue;
      values.push_back(is_parameter ? c->u[k] : static_cast<double>(chosen[k - space.parameters.size()]));
      counted.push_back(c);
    }
    for (std::size_t claim = 0; claim < all.size(); ++claim) {
      std::vector<double> scores;
      for (const EvaluatedCandidate* c : counted) scores.push_back(1.0 - c->evaluation.claim_costs[claim]);
      all[claim].influences.push_back(analysis::rank_correlation(values, scores));
    }
  }
  return all;
}

}  // namespace epicyclic::studies
