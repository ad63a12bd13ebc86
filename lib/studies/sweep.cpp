#include "studies/sweep.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <optional>
#include <thread>
#include <utility>

#include "analysis/lyapunov.hpp"
#include "analysis/spectrum.hpp"
#include "core/errors.hpp"
#include "integrate/lanes/lane_pool.hpp"
#include "integrate/methods.hpp"
#include "studies/classification.hpp"
#include "studies/coarse_pass.hpp"
#include "studies/parallel_for.hpp"
#include "studies/stage_lanes.hpp"

namespace epicyclic::studies {

namespace {

/// Are several points integrated side by side?
bool in_lanes(const integrate::IntegratorOptions& o) {
  const integrate::Method* method = integrate::find_method(o.method);
  return method != nullptr && method->family == integrate::Family::lanes;
}

/// The pool's lanes for all of a point.
PointFlows flows_of(integrate::LanePool& pool) {
  const integrate::FlowMaker make_flow = [&pool](VectorField field, const integrate::IntegratorOptions& options) {
    return pool.make_flow(std::move(field), options);
  };
  return {make_flow, make_flow};
}

/// One point: a transient that may end by evidence, the periods of the strobe, and the results from them.
class PointRun {
 public:
  PointRun(const GridPoint& point, model::DynamicModel model, const std::vector<double>& start,
           const RecordingOptions& recording, const integrate::IntegratorOptions& integrator,
           std::function<bool()> go_on, const PointFlows& flows)
      : model_(std::move(model)),
        recording_(recording),
        integrator_(integrator),
        go_on_(std::move(go_on)),
        flows_(flows),
        state_(start.empty() ? model_.default_start : start),
        // Without tangents there is nothing but recurrence, and no end of a transient.
        classifies_(recording.classification_periods > 0 && has_classification(model_)),
        adaptive_(classifies_ && recording.transient == Transient::adaptive),
        watch_(model_, recording.output_phases,
               {.signal = recording.keep == Keep::section, .quasi_static = recording.quasi_static}),
        strobe_(model_.dimension,
                {adaptive_ ? 0 : recording.transient_periods, recording.recorded_periods, recording.output_phases},
                watch_.phases(), [this](std::size_t, double, std::span<const double> y) { watch_.see(y); }) {
    if (state_.size() != model_.dimension)
      throw InputError("a start of " + std::to_string(state_.size()) + " numbers for a state of " +
                       std::to_string(model_.dimension));
    result_.point = point;
    result_.omega = model_.omega;
  }

  [[nodiscard]] PointResult result() {
    if (adaptive_) pass_transient();
    const auto flow = flows_.strobe(model_, integrator_);
    analysis::advance_strobe(*flow, state_, strobe_, go_on_);
    const analysis::Strobe& strobe = strobe_.result();
    result_.meshes = watch_.finish();
    result_.outcome = strobe.evolution.outcome;
    result_.message = strobe.evolution.message;
    if (recording_.keep == Keep::section) keep_section(strobe.section);
    if (strobe.evolution.reached() && !watch_.signal().empty()) keep_spectrum();
    if (strobe.evolution.reached()) {
      result_.recurrence = analysis::recurrence(strobe.section, recording_.period_max, recording_.recurrence_tolerance);
      if (!classifies_) {
        result_.period = result_.recurrence.period;
        result_.regime = result_.period > 0 ? analysis::Regime::periodic : classify_by_growth();
      } else if (!adaptive_) {
        std::vector<double> onwards = state_;  // the next point of a chain starts from the end of the record
        orbit_ = classify(onwards, &strobe.section).orbit;
      }
      if (recording_.keep == Keep::attractor) keep_attractor(strobe.section);
      if (recording_.keep == Keep::section && orbit_) result_.orbit = std::move(orbit_->state);
      result_.end_state = std::move(state_);
    }
    result_.rhs_evaluations = flow->right_hand_side_calls() + classification_work_;
    return std::move(result_);
  }

 private:
  /// The transient until the regime is classified.
  void pass_transient() {
    analysis::Classification found = classify(state_, nullptr);
    if (!found.evolution.reached()) {
      strobe_.take(found.evolution, state_);
    } else if (found.orbit) {
      state_ = found.orbit->state;
    }
    orbit_ = std::move(found.orbit);
  }

  void keep_section(const analysis::PoincareSection& section) {
    result_.poincare_columns =
        model_.dimension + (model_.has_ring() ? 2U : 1U) * static_cast<std::size_t>(model_.planets);
    model::MeshDeflections d;
    for (std::size_t k = 0; k < section.size(); ++k) append_poincare_row(model_, section.point(k), d, result_.poincare);
  }

  void keep_spectrum() {
    const int in_mesh_period = std::max(1, recording_.output_phases / model_.mesh_periods);
    const auto phases = static_cast<std::size_t>(in_mesh_period);
    if (watch_.signal().size() < 2) return;
    analysis::Spectrum s = analysis::averaged_spectrum(watch_.signal(), 1.0 / in_mesh_period, spectrum_periods * phases,
                                                       analysis::Window::hann);
    const double kept = spectrum_orders / s.resolution;
    if (kept + 1.0 < static_cast<double>(s.amplitude.size())) s.amplitude.resize(static_cast<std::size_t>(kept) + 1);
    result_.spectrum = std::move(s.amplitude);
    result_.spectrum_resolution = s.resolution;
  }

  void keep_attractor(const analysis::PoincareSection& section) {
    if (orbit_) {
      const auto flow = flows_.classification(model_, integrator_);
      result_.attractor = analysis::record_of_orbit(*flow, *orbit_, result_.period, map_error(integrator_));
      classification_work_ += flow->right_hand_side_calls();
    } else {
      result_.attractor = analysis::record_of_section(section, result_.regime, result_.recurrence,
                                                      result_.lyapunov_max(), map_error(integrator_));
    }
  }

  analysis::Classification classify(std::vector<double>& from, const analysis::PoincareSection* seen) {
    ClassifiedState classified =
        classify_state(model_, from, recording_, integrator_, go_on_, seen, flows_.classification);
    classification_work_ += classified.right_hand_sides;
    result_.classified = classified.classification.evolution.reached();
    result_.regime = classified.classification.regime;
    result_.period = classified.classification.period;
    result_.evidence = classified.classification.evidence;
    return std::move(classified.classification);
  }

  /// The regime of a record that does not recur, by the growth of one tangent vector.
  analysis::Regime classify_by_growth() {
    if (recording_.growth_periods == 0 || !has_classification(model_) ||
        analysis::still_converging(result_.recurrence, recording_.recurrence_tolerance))
      return analysis::Regime::undecided;
    std::vector<double> onwards = state_;
    const auto flow = flows_.classification(model_, integrator_);
    constexpr int aligning = 16;
    const analysis::LargestExponent e = analysis::largest_exponent(
        *flow, onwards, {.aligning_periods = aligning, .periods = recording_.growth_periods}, {}, go_on_);
    classification_work_ += flow->right_hand_side_calls();
    if (!e.evolution.reached()) return analysis::Regime::undecided;
    return analysis::late_growth(e.growth) > analysis::neutral_growth ? analysis::Regime::chaotic
                                                                      : analysis::Regime::quasiperiodic;
  }

  model::DynamicModel model_;
  const RecordingOptions& recording_;
  integrate::IntegratorOptions integrator_;
  std::function<bool()> go_on_;
  const PointFlows& flows_;
  std::vector<double> state_;
  bool classifies_;
  bool adaptive_;
  PointResult result_;
  ResponseStatistics watch_;
  analysis::StrobeProgress strobe_;
  std::optional<analysis::PeriodicOrbit> orbit_;  ///< if the point is periodic by evidence
  long classification_work_ = 0;
};

/// Runs chains, each from its first point that is not done.
class ChainRunner {
 public:
  ChainRunner(const SweepPlan& plan, const RecordingOptions& recording, const integrate::IntegratorOptions& integrator,
              const ModelAtPoint& model_at, const SweepRun& run)
      : plan_(plan),
        recording_(recording),
        integrator_(integrator),
        model_at_(model_at),
        run_(run),
        coarse_(plan, integrator, model_at) {}

  /// One chain after another.
  void run_chains() {
    give_up_on_failure([this] {
      follow_all({{}, [](const std::function<bool()>& over) {
                    constexpr std::chrono::milliseconds pause{1};
                    while (!over()) std::this_thread::sleep_for(pause);
                  }});
    });
  }

  /// Several chains at once, in lanes that they share.
  /// @param thread  which of those side by side this is
  /// @param most    chains at once
  void run_chains_in_lanes(std::size_t thread, std::size_t most) {
    give_up_on_failure([&] {
      const integrate::StepLoops& kernels = integrate::step_loops(thread);
      // The same for every thread: which points have lanes does not depend on who came first.
      const model::DynamicModel like = model_at_(plan_.points.front());
      integrate::LanePool pool = stage_pool(like, integrator_, kernels);
      const Carrier carrier{flows_of(pool), [&](const std::function<bool()>& over) { pool.wait(over); }};
      // Some chains wait for a lane while others are classified: lanes of states and lanes of tangents then fill up.
      constexpr std::size_t chains_per_lane = 2;
      pool.run(std::min(most, chains_per_lane * pool.width()), [&] { follow_all(carrier); });
      if (run_.lane_use == nullptr) return;
      const std::scoped_lock lock(mutex_);
      run_.lane_use->room += pool.room();
      run_.lane_use->taken += pool.taken();
    });
  }

  [[nodiscard]] std::size_t finished() const { return finished_; }

 private:
  template <class F>
  void give_up_on_failure(F&& run) {
    try {
      run();
    } catch (...) {
      failed_ = true;  // the points in progress of the other chains are abandoned
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

  /// The flows that integrate the points of a chain.
  struct Carrier {
    PointFlows flows;
    std::function<void(const std::function<bool()>& over)> wait;
  };

  /// Advances to the chain's next point that is not done, with its start.
  /// @returns nothing at the chain's end
  std::optional<std::size_t> advance(const Chain& chain, std::size_t& next, std::vector<double>& start,
                                     const Carrier& carrier) {
    const std::size_t first = next;
    while (next < chain.size() && done(chain[next])) ++next;
    if (next == chain.size()) return std::nullopt;
    if (next == 0)
      start = coarse_.start_of(
          chain.front(), [this] { return !stopped(); }, carrier.flows.classification, carrier.wait);
    if (next > first) start = run_.end_state(chain[next - 1]);
    return chain[next];
  }

  void follow_all(const Carrier& carrier) {
    while (const auto chain = next_chain()) follow(plan_.chains[*chain], carrier);
  }

  void follow(const Chain& chain, const Carrier& carrier) {
    std::vector<double> start;
    for (std::size_t next = 0; !stopped(); ++next) {
      const auto index = advance(chain, next, start, carrier);
      if (!index || stopped()) return;
      const GridPoint point = plan_.points[*index];
      PointResult result = compute_point(
          point, model_at_(point), start, recording_, integrator_, [this] { return !stopped(); }, carrier.flows);
      if (stopped()) return;
      report(result);
      start = std::move(result.end_state);
    }
  }

  void report(const PointResult& result) {
    const std::scoped_lock lock(mutex_);
    if (run_.point_finished) run_.point_finished(result);
    ++finished_;
  }

  const SweepPlan& plan_;
  const RecordingOptions& recording_;
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

RecordingOptions by_recurrence_alone(RecordingOptions recording) {
  recording.classification_periods = 0;
  recording.transient = Transient::fixed;
  return recording;
}

bool still_converging(const PointSummary& result, const RecordingOptions& recording) {
  return result.outcome == integrate::Outcome::reached && !result.classified &&
         result.regime == analysis::Regime::undecided &&
         analysis::still_converging(result.recurrence, recording.recurrence_tolerance);
}

std::string regime_name(const PointSummary& result) {
  if (result.regime != analysis::Regime::periodic) return to_string(result.regime);
  return "period " + std::to_string(result.period);
}

std::string regime_text(const PointSummary& result) {
  const std::string name = regime_name(result);
  if (!result.classified) return name + " by recurrence alone";
  return result.evidence.note.empty() ? name : name + ": " + result.evidence.note;
}

std::vector<std::string> poincare_columns(const model::DynamicModel& model) {
  std::vector<std::string> names = model.state_names;
  for (const char* mesh : {"delta_sp_", "delta_rp_"})
    for (int i = 1; i <= model.planets; ++i)
      if (mesh[6] == 's' || model.has_ring()) names.push_back(mesh + std::to_string(i));
  return names;
}

analysis::PoincareSection section_of(const PointResult& result, std::size_t dimension) {
  analysis::PoincareSection section{dimension, {}};
  for (std::size_t row = 0; row < result.poincare_rows(); ++row) {
    const auto begin = result.poincare.begin() + static_cast<std::ptrdiff_t>(row * result.poincare_columns);
    section.states.insert(section.states.end(), begin, begin + static_cast<std::ptrdiff_t>(dimension));
  }
  return section;
}

void append_poincare_row(const model::DynamicModel& model, std::span<const double> y, model::MeshDeflections& d,
                         std::vector<double>& rows) {
  model.deflections(0.0, y.data(), d);
  rows.insert(rows.end(), y.begin(), y.end());
  rows.insert(rows.end(), d.sun_planet.begin(), d.sun_planet.end());
  if (model.has_ring()) rows.insert(rows.end(), d.ring_planet.begin(), d.ring_planet.end());
}

PointResult compute_point(const GridPoint& point, const model::DynamicModel& model, const std::vector<double>& start,
                          const RecordingOptions& recording, const integrate::IntegratorOptions& integrator,
                          const std::function<bool()>& go_on, const PointFlows& flows) {
  recording.validate();
  return PointRun(point, model, start, recording, integrator, go_on, flows).result();
}

PointResult compute_point_as_swept(const GridPoint& point, const model::DynamicModel& model,
                                   const std::vector<double>& start, const RecordingOptions& recording,
                                   const integrate::IntegratorOptions& integrator, const std::function<bool()>& go_on) {
  if (!in_lanes(integrator)) return compute_point(point, model, start, recording, integrator, go_on);
  integrate::LanePool pool = stage_pool(model, integrator, integrate::step_loops());
  PointResult result;
  pool.run(1, [&] { result = compute_point(point, model, start, recording, integrator, go_on, flows_of(pool)); });
  return result;
}

analysis::Estimate PointSummary::lyapunov_max() const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (!classified || outcome != integrate::Outcome::reached) return {none, none};
  return evidence.exponent * omega;
}

std::size_t run_sweep(const SweepPlan& plan, const RecordingOptions& recording,
                      const integrate::IntegratorOptions& integrator, const ModelAtPoint& model_at,
                      const SweepRun& run) {
  recording.validate();
  if (plan.points.empty()) return 0;
  ChainRunner runner(plan, recording, integrator, model_at, run);
  const auto threads_of_all = static_cast<std::size_t>(std::max({1, run.threads, run.threads_of_all}));
  const std::size_t share = (plan.chains.size() + threads_of_all - 1) / threads_of_all;
  const bool lanes = in_lanes(integrator);
  const std::size_t threads = std::min(plan.chains.size(), static_cast<std::size_t>(std::max(1, run.threads)));
  parallel_for(threads, run.threads, run.stop, [&](std::size_t thread) {
    if (lanes) {
      runner.run_chains_in_lanes(run.process + thread, share);
    } else {
      runner.run_chains();
    }
  });
  return runner.finished();
}

std::vector<PointResult> run_sweep_in_memory(const SweepPlan& plan, const RecordingOptions& recording,
                                             const integrate::IntegratorOptions& integrator,
                                             const ModelAtPoint& model_at, SweepRun run,
                                             std::map<std::size_t, PointResult> done) {
  std::map<std::size_t, std::vector<double>> ends;
  run.done.assign(plan.points.size(), false);
  for (const auto& [index, result] : done) {
    if (!(index < plan.points.size() && result.point == plan.points[index]))
      throw InputError("point " + std::to_string(index) + " of an earlier run is none of this sweep");
    run.done[index] = true;
    ends.emplace(index, result.end_state);
  }
  run.end_state = [&](std::size_t index) { return ends.at(index); };
  run.point_finished = [&, report = std::move(run.point_finished)](const PointResult& result) {
    if (report) report(result);
    done.emplace(result.point.index, result);
  };
  (void)run_sweep(plan, recording, integrator, model_at, run);
  std::vector<PointResult> ordered;
  for (auto& [index, result] : done) ordered.push_back(std::move(result));
  return ordered;
}

std::vector<PointResult> run_sweep_in_memory(const SweepPlan& plan, const RecordingOptions& recording,
                                             const integrate::IntegratorOptions& integrator, const ModelAt& model_at,
                                             SweepRun run, std::map<std::size_t, PointResult> done) {
  const ModelAtPoint at = [&model_at](const GridPoint& point) { return model_at(point.value); };
  return run_sweep_in_memory(plan, recording, integrator, at, std::move(run), std::move(done));
}

}  // namespace epicyclic::studies
