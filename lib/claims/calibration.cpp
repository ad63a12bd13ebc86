#include "claims/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <tuple>

#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/compass_search.hpp>
#include <pagmo/algorithms/de1220.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "core/errors.hpp"
#include "core/random_numbers.hpp"
#include "studies/parallel_for.hpp"

namespace epicyclic::claims {

using namespace studies;

namespace {

/// Everything that phases of a search share.
class Search {
 public:
  Search(const ClaimsOptions& options, Evaluator evaluator, CalibrationRun run)
      : options_(options), evaluator_(std::move(evaluator)), run_(std::move(run)) {}

  [[nodiscard]] const ClaimsOptions& options() const { return options_; }
  [[nodiscard]] const CalibrationRun& run() const { return run_; }
  [[nodiscard]] std::size_t dimension() const { return options_.space.dimension(); }

  /// The evaluation of a key: the one that is kept, or a new one.
  const EvaluatedCandidate& evaluate(EvaluationKey key, const std::vector<double>& u, Question question) {
    if (const EvaluatedCandidate* kept = find(key)) {
      if (kept->u != u)
        throw InputError("the evaluations that were kept are not those of this search: candidate " +
                         std::to_string(key.number) + " of phase " + std::to_string(key.phase) + " is another one");
      return *kept;
    }
    question.u = u;
    EvaluatedCandidate fresh{key, u, evaluator_(question)};
    const std::scoped_lock lock(mutex_);
    if (run_.evaluated) run_.evaluated(fresh);
    return run_.known.insert_or_assign(key, std::move(fresh)).first->second;
  }

  /// Candidates of the phases before `phase` that were evaluated in full, by rising cost, then in the order of keys. A
  /// resumed search knows evaluations of its later phases, too; a phase that used them would ask for others than
  /// before.
  [[nodiscard]] std::vector<const EvaluatedCandidate*> ranked_before(std::size_t phase) const {
    std::vector<const EvaluatedCandidate*> all;
    for (const auto& [key, candidate] : run_.known)
      if (key.phase < phase && !candidate.evaluation.stopped_early && candidate.evaluation.refused.empty())
        all.push_back(&candidate);
    std::ranges::stable_sort(all, {}, [](const EvaluatedCandidate* c) { return c->evaluation.cost; });
    return all;
  }

  [[nodiscard]] const EvaluatedCandidate* best_before(std::size_t phase) const {
    const auto all = ranked_before(phase);
    return all.empty() ? nullptr : all.front();
  }

  [[nodiscard]] std::size_t refinement_phase() const { return static_cast<std::size_t>(options_.search.islands); }
  [[nodiscard]] std::size_t profile_phase() const { return refinement_phase() + 1; }
  [[nodiscard]] std::size_t whole_phase() const { return refinement_phase() + 2; }

  [[nodiscard]] KnownEvaluations take_all() { return std::move(run_.known); }

 private:
  const EvaluatedCandidate* find(EvaluationKey key) {
    const std::scoped_lock lock(mutex_);
    const auto found = run_.known.find(key);
    return found == run_.known.end() ? nullptr : &found->second;
  }

  const ClaimsOptions& options_;
  Evaluator evaluator_;
  CalibrationRun run_;
  std::mutex mutex_;
};

/// A phase that asks for one evaluation after another.
struct Phase {
  Search* search = nullptr;
  std::size_t index = 0;
  std::size_t thread = 0;
  std::size_t asked = 0;
  double give_up_at = std::numeric_limits<double>::infinity();

  double cost(const std::vector<double>& u) {
    const Evaluation& e = search->evaluate({index, asked++}, u, {{}, give_up_at, thread}).evaluation;
    return e.stopped_early ? std::numeric_limits<double>::infinity() : e.cost;
  }
};

/// What pagmo sees of it; it copies its problems.
struct CostProblem {
  Phase* phase = nullptr;
  std::size_t dimension = 1;

  [[nodiscard]] pagmo::vector_double fitness(const pagmo::vector_double& u) const { return {phase->cost(u)}; }
  [[nodiscard]] std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(dimension, 0.0), pagmo::vector_double(dimension, 1.0)};
  }
};

/// Of an island, for one of two uses.
unsigned seed_of(int seed, std::size_t island, unsigned use) {
  return static_cast<unsigned>(random_bits(static_cast<std::uint64_t>(seed), 2 * island + use) & 0xFFFFFFFFU);
}

int generations_of(const SearchOptions& s) { return std::max(1, s.candidates / (s.islands * s.population) - 1); }

class Island {
 public:
  Island(Search& search, std::size_t index)
      : phase_{&search, index}, problem_(CostProblem{&phase_, search.dimension()}), population_(problem_, 0) {
    const SearchOptions& options = search.options().search;
    // One generation at a time, its adaptation kept; it never ends by itself.
    const unsigned seed = seed_of(options.seed, index, 1);
    replaces_ = options.method == SearchMethod::differential_evolution;
    if (replaces_)
      algorithm_ =
          pagmo::algorithm(pagmo::de1220(1, pagmo::de1220_statics<void>::allowed_variants, 1, 0.0, 0.0, true, seed));
    else
      algorithm_ =
          pagmo::algorithm(pagmo::cmaes(1, -1.0, -1.0, -1.0, -1.0, options.spread, 0.0, 0.0, true, true, seed));
  }
  Island(const Island&) = delete;  // its problem knows where its phase is
  Island& operator=(const Island&) = delete;

  void begin(const std::vector<std::vector<double>>& first, std::size_t thread) {
    phase_.thread = thread;
    const SearchOptions& options = phase_.search->options().search;
    const auto size = static_cast<std::size_t>(options.population);
    population_ = pagmo::population(problem_, 0, seed_of(options.seed, phase_.index, 0));
    if (!replaces_ && !first.empty()) {
      // It begins about the best of its population; of that the rest is not asked for.
      population_.push_back(first.front());
      const pagmo::vector_double cost = population_.get_f().front();
      for (std::size_t k = 1; k < size; ++k) population_.push_back(first.front(), cost);
      return;
    }
    for (std::size_t k = 0; k < size; ++k)
      population_.push_back(k < first.size() ? first[k] : population_.random_decision_vector());
  }

  void evolve(int generations, std::size_t thread) {
    phase_.thread = thread;
    for (int g = 0; g < generations; ++g) {
      // Of a differential evolution what costs more than every candidate of the generation before replaces none of
      // them. A covariance adaptation goes by the ranks of all.
      if (replaces_) phase_.give_up_at = population_.get_f()[population_.worst_idx()][0];
      population_ = algorithm_.evolve(population_);
    }
  }

  [[nodiscard]] std::pair<std::vector<double>, double> best() const {
    const auto k = population_.best_idx();
    return {population_.get_x()[k], population_.get_f()[k][0]};
  }

  /// A candidate from elsewhere in place of the worst here, if it is better.
  void take(const std::pair<std::vector<double>, double>& from) {
    const auto k = population_.worst_idx();
    if (from.second < population_.get_f()[k][0]) population_.set_xf(k, from.first, {from.second});
  }

 private:
  Phase phase_;
  pagmo::problem problem_;
  pagmo::population population_;
  pagmo::algorithm algorithm_;
  bool replaces_ = true;  ///< candidates by better ones, one by one
};

bool run_islands(Search& search, const std::vector<std::vector<double>>& first) {
  const SearchOptions& options = search.options().search;
  const CalibrationRun& run = search.run();
  std::vector<std::unique_ptr<Island>> islands;
  for (int k = 0; k < options.islands; ++k)
    islands.push_back(std::make_unique<Island>(search, static_cast<std::size_t>(k)));
  const auto each = [&](const std::function<void(std::size_t)>& f) {
    return parallel_for(islands.size(), run.threads, run.stop, f);
  };
  const std::vector<std::vector<double>> nothing;
  // One island of a differential evolution knows the stage as it is given, and tells the others if it is good. A
  // covariance adaptation has its state beside its population, and takes nothing from elsewhere.
  const bool alone = options.method == SearchMethod::covariance_adaptation;
  if (!each([&](std::size_t k) { islands[k]->begin(k == 0 || alone ? first : nothing, k); })) return false;
  const int generations = generations_of(options);
  for (int done = 0; done < generations; done += options.migration_interval) {
    const int now = std::min(options.migration_interval, generations - done);
    if (!each([&](std::size_t k) { islands[k]->evolve(now, k); })) return false;
    std::vector<std::pair<std::vector<double>, double>> best;
    for (const auto& island : islands) best.push_back(island->best());
    for (std::size_t k = 0; k < islands.size() && !alone; ++k) islands[(k + 1) % islands.size()]->take(best[k]);
  }
  return true;
}

void refine(Search& search) {
  const SearchOptions& options = search.options().search;
  const EvaluatedCandidate* best = search.best_before(search.refinement_phase());
  if (options.refinement == 0 || best == nullptr) return;
  constexpr double first_step = 0.05;  // of a range
  constexpr double last_step = 0.002;
  Phase phase{&search, search.refinement_phase()};
  const pagmo::problem problem(CostProblem{&phase, search.dimension()});
  pagmo::population population(problem, 0, 0);
  population.push_back(best->u, {best->evaluation.cost});
  // Only what is better than the best counts.
  phase.give_up_at = best->evaluation.cost;
  pagmo::compass_search compass(static_cast<unsigned>(options.refinement), first_step, last_step, 0.5);
  (void)pagmo::algorithm(compass).evolve(population);
}

/// The best candidates that differ, held against whole sweeps: those that meet most claims first, then the less cost.
/// @returns nothing if stopped
std::optional<std::vector<Confirmed>> confirm(Search& search) {
  const auto wanted = static_cast<std::size_t>(search.options().search.confirmed);
  const ParameterSpace& space = search.options().space;
  std::vector<const EvaluatedCandidate*> chosen;
  for (const EvaluatedCandidate* c : search.ranked_before(search.profile_phase())) {
    if (chosen.size() == wanted) break;
    const std::vector<std::size_t> options = space.options_at(c->u);
    const auto is_near = [&](const EvaluatedCandidate* other) {
      if (space.options_at(other->u) != options) return false;
      for (std::size_t k = 0; k < space.parameters.size(); ++k)
        if (space.counts(space.parameters[k], options) && std::abs(c->u[k] - other->u[k]) >= least_distance)
          return false;
      return true;
    };
    if (std::ranges::none_of(chosen, is_near)) chosen.push_back(c);
  }
  std::vector<Confirmed> confirmed(chosen.size());
  const bool all = parallel_for(chosen.size(), search.run().threads, search.run().stop, [&](std::size_t k) {
    const Question whole{{}, std::numeric_limits<double>::infinity(), k, true};
    confirmed[k] = {*chosen[k], search.evaluate({search.whole_phase(), k}, chosen[k]->u, whole).evaluation};
  });
  if (!all) return std::nullopt;
  // One that is no valid stage at a value of a whole sweep has no verdicts, and comes last.
  const auto rank = [](const Confirmed& c) {
    return std::tuple(!c.whole.refused.empty(), -std::ranges::count(c.whole.holds, 1), c.candidate.evaluation.cost);
  };
  std::ranges::stable_sort(confirmed, {}, rank);
  return confirmed;
}

/// Places in the unit cube that the profile asks for.
std::vector<std::pair<std::size_t, double>> profile_places(const ClaimsOptions& options) {
  std::vector<std::pair<std::size_t, double>> places;
  const ParameterSpace& space = options.space;
  const int n = options.search.profile;
  for (std::size_t k = 0; n > 0 && k < space.dimension(); ++k) {
    if (k < space.parameters.size()) {
      for (int j = 0; j < n; ++j) places.emplace_back(k, n == 1 ? 0.5 : static_cast<double>(j) / (n - 1));
    } else {
      const Choice& choice = space.choices[k - space.parameters.size()];
      for (std::size_t option = 0; option < choice.options.size(); ++option)
        places.emplace_back(k, choice.place_of(option));
    }
  }
  return places;
}

}  // namespace

std::size_t most_evaluations(const ClaimsOptions& options) {
  const SearchOptions& s = options.search;
  std::size_t most = static_cast<std::size_t>(s.islands) * static_cast<std::size_t>(s.population) *
                     static_cast<std::size_t>(generations_of(s) + 1);
  // A compass ends a round that it has begun.
  if (s.refinement > 0) most += static_cast<std::size_t>(s.refinement) + 2 * options.space.dimension();
  return most + profile_places(options).size() + static_cast<std::size_t>(s.confirmed);
}

Calibration calibrate(const ClaimsOptions& options, const Evaluator& evaluate,
                      const std::vector<std::vector<double>>& first, CalibrationRun run) {
  Search search(options, evaluate, std::move(run));
  Calibration result;
  const auto keep_best = [&] {
    if (result.whole() != nullptr)
      result.best = result.confirmed.front().candidate;
    else if (const EvaluatedCandidate* best = search.best_before(search.profile_phase()))
      result.best = *best;
  };
  const auto run_all = [&] {
    if (!run_islands(search, first)) return false;
    refine(search);
    if (search.best_before(search.profile_phase()) == nullptr) throw InputError("no candidate is a valid stage");
    auto confirmed = confirm(search);
    if (!confirmed) return false;
    result.confirmed = *std::move(confirmed);
    keep_best();
    const auto places = profile_places(options);
    result.profile.resize(places.size());
    return parallel_for(places.size(), search.run().threads, search.run().stop, [&](std::size_t k) {
      std::vector<double> u = result.best->u;
      u[places[k].first] = places[k].second;
      const EvaluatedCandidate& c =
          search.evaluate({search.profile_phase(), k}, u, {{}, std::numeric_limits<double>::infinity(), k});
      result.profile[k] = {places[k].first, places[k].second, c.evaluation};
    });
  };
  try {
    result.complete = run_all();
  } catch (const EvaluationStopped&) {
    result.complete = false;
  }
  if (!result.complete) {
    keep_best();
    result.profile.clear();
  }
  result.evaluations = search.take_all();
  return result;
}

}  // namespace epicyclic::claims
