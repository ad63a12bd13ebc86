#include "claims/robustness.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <mutex>
#include <numeric>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/random_numbers.hpp"
#include "studies/parallel_for.hpp"

namespace epicyclic::claims {

using namespace studies;

std::vector<double> draw(const ParameterSpace& space, int seed, std::size_t index) {
  std::vector<double> u(space.dimension());
  for (std::size_t k = 0; k < u.size(); ++k)
    u[k] = random_uniform(static_cast<std::uint64_t>(seed), index * u.size() + k + 1);
  return u;
}

namespace {

constexpr std::size_t by_glance = 0;
constexpr std::size_t by_whole_sweeps = 1;

/// The draws that are to be confirmed, as far as they are known: whether one is depends on all draws before it.
std::vector<std::size_t> to_confirm(const ClaimsOptions& options, const KnownEvaluations& evaluations) {
  std::vector<std::size_t> numbers;
  std::size_t next = 0;
  for (const EvaluatedCandidate* c : surveyed_draws(evaluations)) {
    if (c->key.number != next++ || numbers.size() >= static_cast<std::size_t>(options.survey.confirmed)) break;
    if (c->evaluation.refused.empty()) numbers.push_back(c->key.number);
  }
  return numbers;
}

std::vector<std::size_t> first_numbers(int count) {
  std::vector<std::size_t> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

/// What a part computes of a list.
std::vector<std::size_t> dealt(std::vector<std::size_t> all, const store::Part& part) {
  if (part.of == 0) return all;
  std::vector<std::size_t> share;
  for (std::size_t k = store::first_of(part); k < all.size(); k += part.of) share.push_back(all[k]);
  return share;
}

std::size_t known_of(const KnownEvaluations& evaluations, std::size_t phase, const std::vector<std::size_t>& numbers) {
  return static_cast<std::size_t>(std::ranges::count_if(numbers, [&](std::size_t d) {
    return evaluations.contains({phase, d});
  }));
}

/// Evaluates draws that are not kept, by the screening or by whole sweeps.
void evaluate_draws(const ClaimsOptions& options, std::size_t phase, const std::vector<std::size_t>& numbers,
                    const Evaluator& evaluate, const CalibrationRun& run, KnownEvaluations& all) {
  std::vector<std::size_t> missing;
  for (const std::size_t d : numbers) {
    const auto kept = all.find({phase, d});
    if (kept == all.end())
      missing.push_back(d);
    else if (kept->second.u != draw(options.space, options.survey.seed, d))
      throw InputError("the evaluations that were kept are not of these draws: number " + std::to_string(d) +
                       " is another one");
  }
  std::mutex mutex;
  (void)parallel_for(missing.size(), run.threads, run.stop, [&](std::size_t k) {
    EvaluatedCandidate c{{phase, missing[k]}, draw(options.space, options.survey.seed, missing[k]), {}};
    c.evaluation = evaluate({c.u, std::numeric_limits<double>::infinity(), k, phase == by_whole_sweeps});
    const std::scoped_lock lock(mutex);
    if (run.evaluated) run.evaluated(c);
    all.emplace(c.key, std::move(c));
  });
}

}  // namespace

std::vector<const EvaluatedCandidate*> surveyed_draws(const KnownEvaluations& evaluations) {
  std::vector<const EvaluatedCandidate*> draws;
  for (const auto& [key, c] : evaluations)
    if (key.phase == by_glance) draws.push_back(&c);
  return draws;
}

bool survey_is_complete(const ClaimsOptions& options, const KnownEvaluations& evaluations) {
  return surveyed_draws(evaluations).size() >= static_cast<std::size_t>(options.survey.draws) &&
         std::ranges::all_of(to_confirm(options, evaluations), [&](std::size_t d) {
           return evaluations.contains({by_whole_sweeps, d});
         });
}

SurveyShare share_of(const ClaimsOptions& options, const KnownEvaluations& evaluations, const store::Part& part) {
  const std::vector<std::size_t> draws = dealt(first_numbers(options.survey.draws), part);
  const std::vector<std::size_t> confirmed = dealt(to_confirm(options, evaluations), part);
  return {draws.size(), known_of(evaluations, by_glance, draws), confirmed.size(),
          known_of(evaluations, by_whole_sweeps, confirmed),
          dealt(first_numbers(std::min(options.survey.confirmed, options.survey.draws)), part).size()};
}

KnownEvaluations survey(const ClaimsOptions& options, const Evaluator& evaluate, CalibrationRun run,
                        const store::Part& part) {
  KnownEvaluations all = std::exchange(run.known, {});
  const std::vector<std::size_t> draws = dealt(first_numbers(options.survey.draws), part);
  try {
    evaluate_draws(options, by_glance, draws, evaluate, run, all);
    if (known_of(all, by_glance, draws) == draws.size())
      evaluate_draws(options, by_whole_sweeps, dealt(to_confirm(options, all), part), evaluate, run, all);
  } catch (const EvaluationStopped&) {
    // The available part is returned.
  }
  return all;
}

std::vector<ClaimAgreement> agreement(const ClaimsOptions& options, const KnownEvaluations& evaluations) {
  std::vector<ClaimAgreement> all(options.claims.size());
  for (const auto& [key, whole] : evaluations) {
    if (key.phase != by_whole_sweeps) continue;
    if (!whole.evaluation.refused.empty()) continue;  // a value that the screening omits has no valid stage: no verdict
    const Evaluation& glance = evaluations.at({by_glance, key.number}).evaluation;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const bool at_a_glance = glance.holds[k] == 1;
      const bool in_full = whole.evaluation.holds[k] == 1;
      ClaimAgreement& a = all[k];
      ++(at_a_glance ? (in_full ? a.both : a.glance_only) : (in_full ? a.whole_only : a.neither));
    }
  }
  return all;
}

namespace {

std::vector<const EvaluatedCandidate*> valid_draws(const KnownEvaluations& evaluations) {
  std::vector<const EvaluatedCandidate*> valid = surveyed_draws(evaluations);
  std::erase_if(valid, [](const EvaluatedCandidate* c) { return !c->evaluation.refused.empty(); });
  return valid;
}

std::size_t meeting(const std::vector<const EvaluatedCandidate*>& draws, std::size_t claim) {
  return static_cast<std::size_t>(
      std::ranges::count_if(draws, [&](const auto* c) { return c->evaluation.holds[claim] == 1; }));
}

}  // namespace

std::vector<Factor> factors(const ParameterSpace& space) {
  std::vector<Factor> all;
  for (std::size_t k = 0; k < space.parameters.size(); ++k) all.push_back({k, {}});
  for (std::size_t k = 0; k < space.choices.size(); ++k) {
    const std::size_t options = space.choices[k].options.size();
    for (std::size_t o = options == 2 ? 1 : 0; o < options; ++o) all.push_back({space.parameters.size() + k, o});
  }
  return all;
}

std::vector<OptionRobustness> robustness_by_option(const ClaimsOptions& options, const KnownEvaluations& evaluations) {
  const std::vector<const EvaluatedCandidate*> valid = valid_draws(evaluations);
  std::vector<OptionRobustness> all;
  for (std::size_t choice = 0; choice < options.space.choices.size(); ++choice)
    for (std::size_t option = 0; option < options.space.choices[choice].options.size(); ++option) {
      std::vector<const EvaluatedCandidate*> draws;
      std::ranges::copy_if(valid, std::back_inserter(draws),
                           [&](const auto* c) { return options.space.options_at(c->u)[choice] == option; });
      OptionRobustness of{choice, option, draws.size(), {}, {}};
      for (std::size_t claim = 0; claim < options.claims.size(); ++claim) {
        of.holds.push_back(meeting(draws, claim));
        of.fraction.push_back(analysis::fraction(of.holds.back(), draws.size()));
      }
      all.push_back(std::move(of));
    }
  return all;
}

std::vector<ClaimRobustness> robustness(const ClaimsOptions& options, const KnownEvaluations& evaluations) {
  const ParameterSpace& space = options.space;
  const std::vector<const EvaluatedCandidate*> valid = valid_draws(evaluations);
  std::vector<ClaimRobustness> all(options.claims.size());
  for (std::size_t claim = 0; claim < all.size(); ++claim) {
    all[claim].draws = valid.size();
    all[claim].holds = meeting(valid, claim);
    all[claim].fraction = analysis::fraction(all[claim].holds, valid.size());
  }
  for (const Factor& factor : factors(space)) {
    // Its values, of the draws that it counts in.
    std::vector<double> values;
    std::vector<const EvaluatedCandidate*> counted;
    for (const EvaluatedCandidate* c : valid) {
      const std::vector<std::size_t> chosen = space.options_at(c->u);
      if (!factor.option && !space.counts(space.parameters[factor.variable], chosen)) continue;
      values.push_back(!factor.option                                                        ? c->u[factor.variable]
                       : chosen[factor.variable - space.parameters.size()] == *factor.option ? 1.0
                                                                                             : 0.0);
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

}  // namespace epicyclic::claims
