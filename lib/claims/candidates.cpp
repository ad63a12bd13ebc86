#include "claims/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "core/errors.hpp"
#include "studies/sweep_plan.hpp"

namespace epicyclic::claims {

using namespace studies;

namespace {

/// Does a condition read forces of the quasi-static solution?
bool reads_quasi_static(const ClaimsOptions& options) {
  const auto reads = [](const Condition& c) {
    return c.quantity.starts_with("kv_") || c.quantity.starts_with("k_gamma_");
  };
  return std::ranges::any_of(options.claims, [&](const Claim& c) {
    return std::ranges::any_of(c.conditions, reads) || std::ranges::any_of(c.as_printed, reads);
  });
}

integrate::IntegratorOptions integrator_of(const Screening& screening) {
  integrate::IntegratorOptions integrator;
  integrator.method = "lanes-cash-karp";
  integrator.relative_tolerance = screening.relative_tolerance;
  integrator.absolute_tolerance = screening.relative_tolerance;
  return integrator;
}

RecordingOptions screening_recording(const ClaimsOptions& options, const Screening& screening) {
  RecordingOptions recording = options.recording;
  recording.transient = Transient::fixed;
  recording.transient_periods = screening.transient_periods;
  recording.recorded_periods = screening.recorded_periods;
  recording.classification_periods = screening.classification_periods;
  recording.growth_periods = screening.growth_periods;
  recording.period_max = std::min(recording.period_max, screening.recorded_periods / 2);
  recording.keep = Keep::section;
  recording.quasi_static = reads_quasi_static(options);
  return recording;
}

/// Does a condition read the largest Lyapunov exponent?
bool needs_exponents(const ClaimsOptions& options) {
  const auto any = [](const std::vector<Condition>& conditions) {
    return std::ranges::find(conditions, "lyapunov_max", &Condition::quantity) != conditions.end();
  };
  return std::ranges::any_of(options.claims, [&](const Claim& c) { return any(c.conditions) || any(c.as_printed); });
}

/// Is there a condition on the sweep that multipliers can lead to?
bool needs_multipliers(const ClaimsOptions& options, const ClaimSweep& sweep) {
  constexpr std::array<ConditionKind, 5> kinds = {ConditionKind::share, ConditionKind::count, ConditionKind::change,
                                                  ConditionKind::sequence, ConditionKind::jump};
  return std::ranges::any_of(options.claims, [&](const Claim& claim) {
    return std::ranges::any_of(claim.conditions, [&](const Condition& c) {
      return c.sweep == sweep.name && std::ranges::find(kinds, c.kind) != kinds.end();
    });
  });
}

}  // namespace

Glance search_glance(const ClaimsOptions& options) {
  return {options.screening, &ClaimSweep::screening_points, options.search.regime_cost, options.search.reading};
}

Glance survey_glance(const ClaimsOptions& options) {
  return {options.survey.recording, &ClaimSweep::survey_points, SearchLead::regimes, options.survey.reading};
}

void screen(const ClaimsOptions& options, const Glance& glance, const SweepModels& models,
            const std::vector<const ClaimSweep*>& sweeps, std::size_t thread, const std::atomic<bool>* stop,
            ClaimRecord& record) {
  // All points of all sweeps are cells of one plan, so that they share the lanes.
  std::vector<std::pair<const ClaimSweep*, double>> cells;
  for (const ClaimSweep* sweep : sweeps) {
    Axis axis = sweep->axis;
    axis.points = std::min(axis.points, sweep->*glance.points);
    for (const double value : axis_values(axis)) cells.emplace_back(sweep, value);
  }
  PlanGrid grid;
  grid.first = {"cell", 0.0, static_cast<double>(cells.size() - 1), static_cast<int>(cells.size())};
  grid.directions = {Direction::up};
  grid.chains_per_line = cells.size();
  const RecordingOptions recording = screening_recording(options, glance.recording);
  SweepRun run;
  run.stop = stop;
  run.process = thread;
  const ModelAtPoint model_at = [&](const GridPoint& point) {
    const auto& [sweep, value] = cells[point.index];
    return models(*sweep, value);
  };
  std::vector<PointResult> results =
      run_sweep_in_memory(SweepPlan(grid), recording, integrator_of(glance.recording), model_at, std::move(run));
  if (results.size() < cells.size()) throw EvaluationStopped();
  for (std::size_t k = 0; k < cells.size(); ++k) {
    results[k].point.value = cells[k].second;
    record[cells[k].first->name].points.push_back(claim_point(results[k], recording, Depth::screening));
  }
  for (const ClaimSweep* sweep : sweeps) {
    ClaimSeries& series = record[sweep->name];
    if (glance.regime_cost == SearchLead::dots) add_dots(series, options.printed, recording.recurrence_tolerance);
    series = read_as(glance.reading, std::move(series), options);
  }
  if (glance.regime_cost != SearchLead::multipliers) return;
  for (const ClaimSweep* sweep : sweeps) {
    if (!needs_multipliers(options, *sweep)) continue;
    std::vector<ClaimPoint>& points = record[sweep->name].points;
    std::vector<double> values;
    for (const ClaimPoint& p : points) values.push_back(p.value);
    const ModelAt along = [&](double value) { return models(*sweep, value); };
    const std::vector<PeriodOne> orbits = follow_period_one(values, along, integrator_of(glance.recording), stop);
    if (stop != nullptr && stop->load()) throw EvaluationStopped();
    for (std::size_t k = 0; k < points.size(); ++k) points[k].period_one = orbits[k];
  }
}

namespace {

/// Nothing is known yet.
Evaluation unknown(const ClaimsOptions& options) {
  Evaluation evaluation;
  evaluation.cost = 0.0;
  evaluation.claim_costs.assign(options.claims.size(), std::numeric_limits<double>::quiet_NaN());
  evaluation.holds.assign(options.claims.size(), 0);
  return evaluation;
}

/// Sweeps that serve a figure alone do not count for a candidate.
std::vector<const ClaimSweep*> sweeps_spoken_of(const ClaimsOptions& options) {
  std::set<std::string> names;
  for (const Claim& claim : options.claims)
    for (const std::string& name : sweeps_of(claim)) names.insert(name);
  std::vector<const ClaimSweep*> sweeps;
  for (const ClaimSweep& sweep : options.sweeps)
    if (names.contains(sweep.name)) sweeps.push_back(&sweep);
  return sweeps;
}

/// Judges the claims whose sweeps are all there and that have not been judged.
void judge_known(const ClaimsOptions& options, const ClaimRecord& record, Reading reading, Evaluation& evaluation) {
  for (std::size_t k = 0; k < options.claims.size(); ++k) {
    const Claim& claim = options.claims[k];
    const auto is_there = [&](const std::string& name) { return record.contains(name); };
    if (!std::isnan(evaluation.claim_costs[k]) || !std::ranges::all_of(sweeps_of(claim), is_there)) continue;
    const ClaimOutcome outcome = judge(claim, record, reading);
    evaluation.claim_costs[k] = outcome.cost;
    evaluation.holds[k] = outcome.holds ? 1 : 0;
    evaluation.cost += claim.weight * outcome.cost;
  }
}

}  // namespace

Evaluation evaluate(const ClaimsOptions& options, const Glance& glance, const SweepModels& models, double give_up_at,
                    std::size_t thread, const std::atomic<bool>* stop) {
  Evaluation evaluation = unknown(options);
  const std::vector<const ClaimSweep*> spoken_of = sweeps_spoken_of(options);
  std::set<int> rounds;
  for (const ClaimSweep* sweep : spoken_of) rounds.insert(sweep->screening_round);
  ClaimRecord record;
  for (const int round : rounds) {
    if (evaluation.cost >= give_up_at) {
      evaluation.stopped_early = true;
      return evaluation;
    }
    std::vector<const ClaimSweep*> sweeps;
    std::ranges::copy_if(spoken_of, std::back_inserter(sweeps),
                         [&](const auto* s) { return s->screening_round == round; });
    screen(options, glance, models, sweeps, thread, stop, record);
    judge_known(options, record, glance.reading, evaluation);
  }
  return evaluation;
}

Evaluation evaluate_whole(const ClaimsOptions& options, const integrate::IntegratorOptions& integrator, Reading reading,
                          const SweepModels& models, const std::atomic<bool>* stop) {
  ClaimRecord record;
  for (const ClaimSweep* sweep : sweeps_spoken_of(options)) {
    SweepOptions whole = options.whole_sweep(*sweep, options.starts.front());
    // Evidence beyond the record changes no dot.
    if (reading == Reading::printed && whole.recording.transient == Transient::fixed && !needs_exponents(options))
      whole.recording.classification_periods = 0;
    whole.recording.quasi_static = reads_quasi_static(options);
    const SweepPlan plan = plan_sweep(whole);
    SweepRun run;
    run.stop = stop;
    const ModelAt model_at = [&](double value) { return models(*sweep, value); };
    const std::vector<PointResult> points =
        run_sweep_in_memory(plan, whole.recording, integrator, model_at, std::move(run));
    if (points.size() < plan.points.size()) throw EvaluationStopped();
    record[sweep->name] = read_as(reading, claim_series(points_in_memory(points), options.recording), options);
  }
  Evaluation evaluation = unknown(options);
  judge_known(options, record, reading, evaluation);
  return evaluation;
}

Evaluator evaluator_of(const ClaimsOptions& options, const Glance& glance,
                       const integrate::IntegratorOptions& integrator, CandidateModels models,
                       const std::atomic<bool>* stop) {
  return [&options, glance, integrator, models = std::move(models), stop](const Question& q) {
    const auto refused = [&](const std::string& why) {
      Evaluation evaluation;
      evaluation.cost = 1.0;
      for (const Claim& claim : options.claims) evaluation.cost += claim.weight;
      evaluation.claim_costs.assign(options.claims.size(), 1.0);
      evaluation.holds.assign(options.claims.size(), 0);
      evaluation.refused = why;
      return evaluation;
    };
    try {
      const SweepModels of_candidate = models(q.u);
      return q.whole ? evaluate_whole(options, integrator, glance.reading, of_candidate, stop)
                     : evaluate(options, glance, of_candidate, q.give_up_at, q.thread, stop);
    } catch (const InputError& error) {
      return refused(error.what());
    } catch (const DomainError& error) {
      return refused(error.what());
    }
  };
}

}  // namespace epicyclic::claims
