#include "studies/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>

#include "core/errors.hpp"
#include "integrate/lanes/lane_ensemble.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/methods.hpp"
#include "studies/coarse_pass.hpp"
#include "studies/motion.hpp"
#include "studies/stage_lanes.hpp"
#include "studies/units.hpp"

namespace epicyclic::studies {

namespace {

/// Are several points carried side by side?
bool in_lanes(const integrate::IntegratorOptions& o) {
  const integrate::Method* method = integrate::find_method(o.method);
  return method != nullptr && method->family == integrate::Family::lanes;
}

/// One point, in steps: a transient that ends by evidence, the periods of the strobe, which may be carried by anyone,
/// and what is told from them.
class PointRun {
 public:
  PointRun(const GridPoint& point, model::DynamicModel model, const std::vector<double>& start, const LookOptions& look,
           const integrate::IntegratorOptions& integrator, std::function<bool()> go_on)
      : model_(std::move(model)),
        look_(look),
        integrator_(of_one_trajectory(integrator)),
        go_on_(std::move(go_on)),
        state_(start.empty() ? model_.default_start : start),
        // Without tangents there is nothing but recurrence, and no end of a transient.
        classifies_(look.classification_periods > 0 && has_classification(model_)),
        adaptive_(classifies_ && look.transient == Transient::adaptive),
        watch_(model_),
        strobe_(model_.dimension, model_.period,
                {adaptive_ ? 0 : look.transient_periods, look.recorded_periods, look.output_phases},
                [this](std::size_t, double s, std::span<const double> y) { watch_.see(s, y); }) {
    if (state_.size() != model_.dimension)
      throw InputError("a start of " + std::to_string(state_.size()) + " numbers for a state of " +
                       std::to_string(model_.dimension));
    result_.point = point;
    result_.omega = model_.omega;
    if (!adaptive_) return;
    analysis::Classification told = tell(state_, nullptr);
    if (!told.evolution.reached()) {
      strobe_.take(told.evolution, state_);
    } else if (told.orbit) {
      state_ = told.orbit->state;
    }
    orbit_ = std::move(told.orbit);
  }

  [[nodiscard]] const VectorField& field() const { return model_; }
  [[nodiscard]] std::vector<double>& state() { return state_; }
  [[nodiscard]] analysis::StrobeProgress& strobe() { return strobe_; }

  /// @param right_hand_sides  that the strobe took
  [[nodiscard]] PointResult finish(long right_hand_sides) {
    const analysis::Strobe& strobe = strobe_.result();
    MeshRecords seen = watch_.finished();
    result_.sun_planet = std::move(seen.sun_planet);
    result_.ring_planet = std::move(seen.ring_planet);
    result_.planet_spread = seen.planet_spread;
    result_.outcome = strobe.evolution.outcome;
    result_.message = strobe.evolution.message;
    if (look_.keep == Keep::section) keep_section(strobe.section);
    if (strobe.evolution.reached()) {
      result_.recurrence = analysis::recurrence(strobe.section, look_.period_max, look_.recurrence_tolerance);
      if (!classifies_) {
        result_.period = result_.recurrence.period;
        result_.regime = result_.period > 0 ? analysis::Regime::periodic : analysis::Regime::undecided;
      } else if (!adaptive_) {
        std::vector<double> onwards = state_;  // the next point of a chain starts where the record ends
        orbit_ = tell(onwards, &strobe.section).orbit;
      }
      if (look_.keep == Keep::attractor) keep_attractor(strobe.section);
      if (look_.keep == Keep::section && orbit_) result_.orbit = std::move(orbit_->state);
      result_.end_state = std::move(state_);
    }
    result_.rhs_evaluations = right_hand_sides + classification_work_;
    return std::move(result_);
  }

 private:
  void keep_section(const analysis::PoincareSection& section) {
    result_.poincare_columns = model_.dimension + 2 * static_cast<std::size_t>(model_.planets);
    model::MeshDeflections d;
    for (std::size_t k = 0; k < section.size(); ++k) append_poincare_row(model_, section.point(k), d, result_.poincare);
  }

  void keep_attractor(const analysis::PoincareSection& section) {
    if (orbit_) {
      const auto flow = integrate::make_flow(model_, integrator_);
      result_.attractor = analysis::record_of_orbit(*flow, *orbit_, result_.period, map_error(integrator_));
      classification_work_ += flow->right_hand_side_calls();
    } else {
      result_.attractor = analysis::record_of_section(section, result_.regime, result_.recurrence,
                                                      result_.lyapunov_max(), map_error(integrator_));
    }
  }

  analysis::Classification tell(std::vector<double>& from, const analysis::PoincareSection* seen) {
    ToldMotion motion = tell_motion(model_, from, look_, integrator_, go_on_, seen);
    classification_work_ += motion.right_hand_sides;
    result_.classified = motion.told.evolution.reached();
    result_.regime = motion.told.regime;
    result_.period = motion.told.period;
    result_.evidence = motion.told.evidence;
    return std::move(motion.told);
  }

  model::DynamicModel model_;
  const LookOptions& look_;
  integrate::IntegratorOptions integrator_;
  std::function<bool()> go_on_;
  std::vector<double> state_;
  bool classifies_;
  bool adaptive_;
  PointResult result_;
  MeshWatch watch_;
  analysis::StrobeProgress strobe_;
  std::optional<analysis::PeriodicOrbit> orbit_;  ///< of a motion that is periodic by evidence
  long classification_work_ = 0;
};

/// The strobe of one point by a flow of its own.
/// @returns right-hand sides
long carry_alone(PointRun& run, const integrate::IntegratorOptions& integrator, const std::function<bool()>& go_on) {
  const auto flow = integrate::make_flow(run.field(), integrator);
  analysis::carry(*flow, run.state(), run.strobe(), go_on);
  return flow->right_hand_side_calls();
}

/// Runs chains, each from its first point that is not done.
class ChainRunner {
 public:
  ChainRunner(const SweepPlan& plan, const LookOptions& look, const integrate::IntegratorOptions& integrator,
              const ModelAtPoint& model_at, const SweepRun& run)
      : plan_(plan),
        look_(look),
        integrator_(integrator),
        model_at_(model_at),
        run_(run),
        coarse_(plan, integrator, model_at) {}

  /// One chain after another.
  void run_chains() {
    give_up_on_failure([this] {
      while (const auto chain = next_chain()) follow(plan_.chains[*chain]);
    });
  }

  /// Several chains at once, each in a lane of its own; a lane that is through with its chain takes the next one.
  /// @param thread  which of those side by side this is
  /// @param most    lanes that are used
  void run_chains_in_lanes(std::size_t thread, std::size_t most) {
    give_up_on_failure([&] { follow_in_lanes(thread, most); });
  }

  [[nodiscard]] std::size_t finished() const { return finished_; }

 private:
  template <class F>
  void give_up_on_failure(F&& run) {
    try {
      run();
    } catch (...) {
      failed_ = true;  // the other chains' points under way are given up
      throw;
    }
  }

  [[nodiscard]] bool stopped() const { return failed_ || (run_.stop != nullptr && run_.stop->load()); }
  [[nodiscard]] bool done(std::size_t index) const { return index < run_.done.size() && run_.done[index]; }

  std::optional<std::size_t> next_chain() {
    if (stopped()) return std::nullopt;
    if (run_.next_chain) return run_.next_chain();
    const std::size_t chain = next_chain_.fetch_add(1);
    if (chain >= plan_.chains.size()) return std::nullopt;
    return chain;
  }

  /// A chain under way.
  struct Way {
    std::size_t chain = 0;
    std::size_t next = 0;  ///< place in the chain
    std::vector<double> start;
    std::unique_ptr<PointRun> point;  ///< in the lane; null when there is none
  };

  /// Goes to the chain's next point that is not done, with its start.
  /// @returns nothing at the chain's end
  std::optional<std::size_t> advance(const Chain& chain, std::size_t& next, std::vector<double>& start) {
    const std::size_t first = next;
    while (next < chain.size() && done(chain[next])) ++next;
    if (next == chain.size()) return std::nullopt;
    if (next == 0) start = coarse_.start_of(chain.front(), [this] { return !stopped(); });
    if (next > first) start = run_.end_state(chain[next - 1]);
    return chain[next];
  }

  void follow(const Chain& chain) {
    std::vector<double> start;
    for (std::size_t next = 0; !stopped(); ++next) {
      const auto index = advance(chain, next, start);
      if (!index) return;
      const model::DynamicModel model = model_at_(plan_.points[*index]);
      PointResult result =
          compute_point(plan_.points[*index], model, start, look_, integrator_, [this] { return !stopped(); });
      if (stopped()) return;
      tell(result);
      start = std::move(result.end_state);
    }
  }

  void follow_in_lanes(std::size_t thread, std::size_t most) {
    const integrate::StepLoops& kernels = integrate::step_loops(thread);
    // The same for every thread: which points have lanes does not depend on who came first.
    const model::DynamicModel like = model_at_(plan_.points.front());
    integrate::LaneEnsemble lanes(stage_lanes(like, kernels), integrator_, kernels);
    std::vector<Way> ways(std::min(most, lanes.width()));
    for (std::size_t lane = 0; lane < ways.size(); ++lane)
      if (next_chain(ways[lane])) next_point(lanes, lane, ways[lane]);
    for (std::size_t lane = lanes.run(); lane != lanes.width(); lane = lanes.run()) {
      if (stopped()) return;
      Way& way = ways[lane];
      lanes.copy_state(lane, way.point->state());
      way.point->strobe().take(lanes.evolution(lane), way.point->state());
      if (way.point->strobe().over()) {
        finish(way, lanes.work(lane).right_hand_sides);
        next_point(lanes, lane, way);
      } else {
        begin_period(lanes, lane, *way.point);
      }
    }
  }

  bool next_chain(Way& way) {
    const auto chain = next_chain();
    if (!chain) return false;
    way = {*chain, 0, {}, nullptr};
    return true;
  }

  /// Puts the chain's next point that is not done into the lane, or that of the next chain; leaves it empty if there
  /// is none.
  void next_point(integrate::LaneEnsemble& lanes, std::size_t lane, Way& way) {
    while (!stopped()) {
      const auto index = advance(plan_.chains[way.chain], way.next, way.start);
      if (!index) {
        if (!next_chain(way)) return;
        continue;
      }
      way.point = std::make_unique<PointRun>(plan_.points[*index], model_at_(plan_.points[*index]), way.start, look_,
                                             integrator_, [this] { return !stopped(); });
      if (stopped()) return;
      if (way.point->strobe().over()) {
        finish(way, 0);
        continue;
      }
      try {
        lanes.load(lane, way.point->field());
      } catch (const InputError&) {
        // Of another structure than the first point, as where a swept value turns something off.
        finish(way, carry_alone(*way.point, integrator_, [this] { return !stopped(); }));
        continue;
      }
      begin_period(lanes, lane, *way.point);
      return;
    }
  }

  static void begin_period(integrate::LaneEnsemble& lanes, std::size_t lane, PointRun& point) {
    lanes.begin(lane, point.state(), 0.0, point.field().period, point.strobe().samples(), point.strobe().observer());
  }

  void finish(Way& way, long right_hand_sides) {
    PointResult result = way.point->finish(right_hand_sides);
    if (stopped()) return;
    tell(result);
    way.start = std::move(result.end_state);
    ++way.next;
  }

  void tell(const PointResult& result) {
    const std::scoped_lock lock(mutex_);
    if (run_.point_finished) run_.point_finished(result);
    ++finished_;
  }

  const SweepPlan& plan_;
  const LookOptions& look_;
  const integrate::IntegratorOptions& integrator_;
  const ModelAtPoint& model_at_;
  const SweepRun& run_;
  CoarsePass coarse_;
  std::atomic<bool> failed_{false};
  std::atomic<std::size_t> next_chain_{0};
  std::mutex mutex_;
  std::size_t finished_ = 0;
};

}  // namespace

LookOptions by_recurrence_alone(LookOptions look) {
  look.classification_periods = 0;
  look.transient = Transient::fixed;
  return look;
}

double PointSummary::pull(const std::vector<MeshRecord>& meshes) {
  double most = 0.0;
  for (const MeshRecord& r : meshes) most = std::max(most, r.pull);
  return most;
}

double PointSummary::pull_time(const std::vector<MeshRecord>& meshes) {
  double most = 0.0;
  for (const MeshRecord& r : meshes) most = std::max(most, r.pull_time);
  return most;
}

bool still_settling(const PointSummary& result, const LookOptions& look) {
  return result.outcome == integrate::Outcome::reached && !result.classified &&
         result.regime == analysis::Regime::undecided &&
         analysis::still_settling(result.recurrence, look.recurrence_tolerance);
}

std::string motion_name(const PointSummary& result) {
  if (result.regime != analysis::Regime::periodic) return to_string(result.regime);
  return "period " + std::to_string(result.period);
}

std::string motion_text(const PointSummary& result) {
  const std::string name = motion_name(result);
  if (!result.classified) return name + " by recurrence alone";
  return result.evidence.note.empty() ? name : name + ": " + result.evidence.note;
}

std::vector<std::string> poincare_columns(const model::DynamicModel& model) {
  std::vector<std::string> names = model.state_names;
  for (const char* mesh : {"delta_sp_", "delta_rp_"})
    for (int i = 1; i <= model.planets; ++i) names.push_back(mesh + std::to_string(i));
  return names;
}

void append_poincare_row(const model::DynamicModel& model, std::span<const double> y, model::MeshDeflections& d,
                         std::vector<double>& rows) {
  model.deflections(0.0, y.data(), d);
  rows.insert(rows.end(), y.begin(), y.end());
  rows.insert(rows.end(), d.sun_planet.begin(), d.sun_planet.end());
  rows.insert(rows.end(), d.ring_planet.begin(), d.ring_planet.end());
}

PointResult compute_point(const GridPoint& point, const model::DynamicModel& model, const std::vector<double>& start,
                          const LookOptions& look, const integrate::IntegratorOptions& integrator,
                          const std::function<bool()>& go_on) {
  look.validate();
  PointRun run(point, model, start, look, integrator, go_on);
  return run.finish(carry_alone(run, integrator, go_on));
}

analysis::Estimate PointSummary::lyapunov_max() const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!classified || outcome != integrate::Outcome::reached) return {none, none};
  return evidence.exponent * omega;
}

std::size_t run_sweep(const SweepPlan& plan, const LookOptions& look, const integrate::IntegratorOptions& integrator,
                      const ModelAtPoint& model_at, const SweepRun& run) {
  look.validate();
  if (plan.points.empty()) return 0;
  ChainRunner runner(plan, look, integrator, model_at, run);
  const auto threads_of_all = static_cast<std::size_t>(std::max({1, run.threads, run.threads_of_all}));
  const std::size_t share = (plan.chains.size() + threads_of_all - 1) / threads_of_all;
  const bool lanes = in_lanes(integrator);
  const std::size_t threads = std::min(plan.chains.size(), static_cast<std::size_t>(std::max(1, run.threads)));
  for_units(threads, run.threads, run.stop, [&](std::size_t thread) {
    if (lanes) {
      runner.run_chains_in_lanes(run.process + thread, share);
    } else {
      runner.run_chains();
    }
  });
  return runner.finished();
}

std::vector<PointResult> run_sweep_in_memory(const SweepPlan& plan, const LookOptions& look,
                                             const integrate::IntegratorOptions& integrator,
                                             const ModelAtPoint& model_at, SweepRun run,
                                             std::map<std::size_t, PointResult> done) {
  std::map<std::size_t, std::vector<double>> ends;
  run.done.assign(plan.points.size(), false);
  for (const auto& [index, result] : done) {
    run.done[index] = true;
    ends.emplace(index, result.end_state);
  }
  run.end_state = [&](std::size_t index) { return ends.at(index); };
  run.point_finished = [&, told = std::move(run.point_finished)](const PointResult& result) {
    if (told) told(result);
    done.emplace(result.point.index, result);
  };
  (void)run_sweep(plan, look, integrator, model_at, run);
  std::vector<PointResult> ordered;
  for (auto& [index, result] : done) ordered.push_back(std::move(result));
  return ordered;
}

std::vector<PointResult> run_sweep_in_memory(const SweepPlan& plan, const LookOptions& look,
                                             const integrate::IntegratorOptions& integrator, const ModelAt& model_at,
                                             SweepRun run, std::map<std::size_t, PointResult> done) {
  const ModelAtPoint at = [&model_at](const GridPoint& point) { return model_at(point.value); };
  return run_sweep_in_memory(plan, look, integrator, at, std::move(run), std::move(done));
}

}  // namespace epicyclic::studies
