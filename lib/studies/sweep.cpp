#include "studies/sweep.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>

#include "core/errors.hpp"
#include "integrate/make_flow.hpp"
#include "studies/operating_point.hpp"
#include "studies/units.hpp"

namespace epicyclic::studies {

namespace {

/// Extrema, contact and differences between planets, gathered over the dense output.
class Watch {
 public:
  Watch(const model::DynamicModel& model, PointResult& result) : model_(model), result_(result) {
    MeshRecord empty;
    empty.delta_min = std::numeric_limits<double>::infinity();
    empty.delta_max = -empty.delta_min;
    result_.sun_planet.assign(static_cast<std::size_t>(model.planets), empty);
    result_.ring_planet = result_.sun_planet;
  }

  void see(double s, std::span<const double> y) {
    model_.deflections(s, y.data(), now_);
    see_meshes(now_.sun_planet, model_.sun_planet_half_gap, result_.sun_planet);
    see_meshes(now_.ring_planet, model_.ring_planet_half_gap, result_.ring_planet);
  }

 private:
  void see_meshes(const std::vector<double>& delta, double half_gap, std::vector<MeshRecord>& records) {
    double least = delta[0];
    double most = delta[0];
    for (std::size_t i = 0; i < delta.size(); ++i) {
      MeshRecord& r = records[i];
      least = std::min(least, delta[i]);
      most = std::max(most, delta[i]);
      r.delta_min = std::min(r.delta_min, delta[i]);
      r.delta_max = std::max(r.delta_max, delta[i]);
      switch (model::DynamicModel::contact(delta[i], half_gap)) {
        case model::Contact::drive:
          r.drive = true;
          break;
        case model::Contact::loss:
          r.loss = true;
          break;
        case model::Contact::back:
          r.back = true;
          break;
      }
    }
    result_.planet_spread = std::max(result_.planet_spread, most - least);
  }

  const model::DynamicModel& model_;
  PointResult& result_;
  model::MeshDeflections now_;
};

/// Runs a chain from its first point that is not done. Returns false if stopped.
class ChainRunner {
 public:
  ChainRunner(const SweepPlan& plan, const SweepOptions& sweep, const integrate::IntegratorOptions& integrator,
              const ModelAt& model_at, SweepRun& run)
      : plan_(plan), sweep_(sweep), integrator_(integrator), model_at_(model_at), run_(run) {
    for (auto& [index, result] : run.done) results_.emplace(index, std::move(result));
  }

  void run_chain(std::size_t chain) {
    try {
      follow(plan_.chains[chain]);
    } catch (...) {
      failed_ = true;  // the other chains' points under way are given up
      throw;
    }
  }

  std::vector<PointResult> take() {
    std::vector<PointResult> ordered;
    for (auto& [index, result] : results_) ordered.push_back(std::move(result));
    return ordered;
  }

 private:
  [[nodiscard]] bool stopped() const { return failed_ || (run_.stop != nullptr && run_.stop->load()); }

  void follow(const std::vector<std::size_t>& chain) {
    std::vector<double> start;
    for (const std::size_t index : chain) {
      if (stopped()) return;
      if (const auto known = find(index)) {
        start = *known;
        continue;
      }
      const model::DynamicModel model = model_at_(plan_.points[index].value);
      PointResult result =
          compute_point(plan_.points[index], model, start, sweep_, integrator_, [this] { return !stopped(); });
      if (stopped()) return;
      start = result.end_state;
      const std::scoped_lock lock(mutex_);
      if (run_.point_finished) run_.point_finished(result);
      results_.emplace(index, std::move(result));
    }
  }

  std::optional<std::vector<double>> find(std::size_t index) {
    const std::scoped_lock lock(mutex_);
    const auto it = results_.find(index);
    if (it == results_.end()) return std::nullopt;
    return it->second.end_state;
  }

  const SweepPlan& plan_;
  const SweepOptions& sweep_;
  const integrate::IntegratorOptions& integrator_;
  const ModelAt& model_at_;
  SweepRun& run_;
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::map<std::size_t, PointResult> results_;
};

/// The value at a share of the way; both ends exactly as given, between them rounded to 12 digits, so that 1.1 is 1.1
/// and a value typed from a table is the value that was computed.
double grid_value(const SweepOptions& options, double share) {
  if (share == 0.0) return options.from;
  if (share == 1.0) return options.to;
  constexpr int digits = 12;
  std::array<char, 64> text;
  const double value = (1.0 - share) * options.from + share * options.to;
  const auto written =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, digits - 1);
  double rounded = value;
  std::from_chars(text.data(), written.ptr, rounded);
  return rounded;
}

}  // namespace

SweepOptions by_recurrence_alone(SweepOptions options) {
  options.classification_periods = 0;
  options.transient = Transient::fixed;
  return options;
}

SweepPlan plan_sweep(const SweepOptions& options) {
  SweepPlan plan;
  const auto count = static_cast<std::size_t>(options.points);
  for (const Direction direction : options.directions) {
    const std::size_t first = plan.points.size();
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t step = direction == Direction::up ? k : count - 1 - k;
      const double share = count == 1 ? 0.0 : static_cast<double>(step) / static_cast<double>(count - 1);
      plan.points.push_back({first + k, direction, grid_value(options, share)});
    }
    const std::size_t chains = options.start == Start::cold ? count : static_cast<std::size_t>(options.segments);
    for (std::size_t c = 0; c < chains; ++c) {
      std::vector<std::size_t> chain;
      for (std::size_t k = c * count / chains; k < (c + 1) * count / chains; ++k) chain.push_back(first + k);
      plan.chains.push_back(std::move(chain));
    }
  }
  return plan;
}

std::string MeshRecord::contact() const {
  std::string text;
  const auto add = [&](bool seen, const char* word) {
    if (!seen) return;
    if (!text.empty()) text += '+';
    text += word;
  };
  add(drive, "drive");
  add(loss, "loss");
  add(back, "back");
  return text;
}

std::vector<std::string> poincare_columns(const model::DynamicModel& model) {
  std::vector<std::string> names = model.state_names;
  for (const char* mesh : {"delta_sp_", "delta_rp_"})
    for (int i = 1; i <= model.planets; ++i) names.push_back(mesh + std::to_string(i));
  return names;
}

PointResult compute_point(const GridPoint& point, const model::DynamicModel& model, const std::vector<double>& start,
                          const SweepOptions& sweep, const integrate::IntegratorOptions& integrator,
                          const std::function<bool()>& go_on) {
  PointResult result;
  result.point = point;
  const auto flow = integrate::make_flow(vector_field(model), integrator);
  std::vector<double> state = start.empty() ? model.default_start : start;
  if (state.size() != model.dimension)
    throw InputError("a start of " + std::to_string(state.size()) + " numbers for a state of " +
                     std::to_string(model.dimension));
  result.omega = model.omega;
  // Without tangents there is nothing but recurrence, and no end of a transient.
  const bool classifies = sweep.classification_periods > 0 && model.tangents && !model.jumps_at_contact;
  const bool adaptive = classifies && sweep.transient == Transient::adaptive;
  long classification_work = 0;
  const auto tell = [&](std::vector<double>& from, const analysis::PoincareSection* seen) {
    analysis::RegimeOptions options;
    options.budget = std::max(options.look, sweep.classification_periods);
    options.longest_period = sweep.period_max;
    // Kinks make an integrator's own map rough to some of its tolerances.
    options.residual = std::max(options.residual, 3.0 * integrator.relative_tolerance);
    options.observable = std::min(model::Slots::w_s, model.dimension - 1);
    // Growth is a statistical matter, for which a looser tolerance is as good; orbits are sought at the study's own.
    constexpr double statistical = 1e-6;
    const auto loosened = [&](double factor) {
      integrate::IntegratorOptions o = integrator;
      o.relative_tolerance *= factor;
      o.absolute_tolerance *= factor;
      return o;
    };
    const auto looks = integrate::make_flow(
        vector_field(model), loosened(std::clamp(statistical / integrator.relative_tolerance, 10.0, 100.0)));
    integrate::IntegratorOptions controlled = integrator;
    controlled.tangent_error_control = true;
    const auto exact = integrate::make_flow(vector_field(model), controlled);
    integrate::IntegratorOptions loose = loosened(10.0);
    loose.tangent_error_control = true;
    const auto coarser = integrate::make_flow(vector_field(model), loose);
    options.exact = exact.get();
    options.coarser = coarser.get();
    analysis::Classification told = analysis::classify(*looks, from, options, go_on, seen);
    for (const auto* each : {&looks, &exact, &coarser}) classification_work += (*each)->right_hand_side_calls();
    result.classified = told.evolution.reached();
    result.regime = told.regime;
    result.period = told.period;
    result.evidence = told.evidence;
    return told;
  };
  Watch watch(model, result);
  if (adaptive) {
    const analysis::Classification told = tell(state, nullptr);
    if (!told.evolution.reached()) {
      result.outcome = told.evolution.outcome;
      result.message = told.evolution.message;
      result.rhs_evaluations = flow->right_hand_side_calls() + classification_work;
      return result;
    }
    if (told.orbit) state = told.orbit->state;
  }
  const analysis::Strobe strobe = analysis::strobe(
      *flow, state, {adaptive ? 0 : sweep.transient_periods, sweep.recorded_periods, sweep.output_phases},
      [&](std::size_t, double s, std::span<const double> y) { watch.see(s, y); }, go_on);
  result.outcome = strobe.evolution.outcome;
  result.message = strobe.evolution.message;

  model::MeshDeflections d;
  result.poincare_columns = model.dimension + 2 * static_cast<std::size_t>(model.planets);
  for (std::size_t k = 0; k < strobe.section.size(); ++k) {
    const auto y = strobe.section.point(k);
    model.deflections(0.0, y.data(), d);
    result.poincare.insert(result.poincare.end(), y.begin(), y.end());
    result.poincare.insert(result.poincare.end(), d.sun_planet.begin(), d.sun_planet.end());
    result.poincare.insert(result.poincare.end(), d.ring_planet.begin(), d.ring_planet.end());
  }
  if (strobe.evolution.reached()) {
    result.recurrence = analysis::recurrence(strobe.section, sweep.period_max, sweep.recurrence_tolerance);
    if (!classifies) {
      result.period = result.recurrence.period;
      result.regime = result.period > 0 ? analysis::Regime::periodic : analysis::Regime::undecided;
    } else if (!adaptive) {
      std::vector<double> onwards = state;  // the next point of a chain starts where the record ends
      (void)tell(onwards, &strobe.section);
    }
    result.end_state = std::move(state);
  }
  result.rhs_evaluations = flow->right_hand_side_calls() + classification_work;
  return result;
}

analysis::Estimate PointResult::lyapunov_max() const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!classified || outcome != integrate::Outcome::reached) return {none, none};
  return evidence.exponent * omega;
}

std::vector<PointResult> run_sweep(const SweepPlan& plan, const SweepOptions& sweep,
                                   const integrate::IntegratorOptions& integrator, const ModelAt& model_at,
                                   SweepRun run) {
  ChainRunner runner(plan, sweep, integrator, model_at, run);
  for_units(plan.chains.size(), run.threads, run.stop, [&](std::size_t chain) { runner.run_chain(chain); });
  return runner.take();
}

}  // namespace epicyclic::studies
