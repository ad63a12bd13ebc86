#include "studies/crosscheck.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "analysis/poincare.hpp"
#include "core/largest_difference.hpp"
#include "core/text.hpp"
#include "integrate/make_flow.hpp"
#include "studies/converged_orbit.hpp"
#include "studies/parallel_for.hpp"

namespace epicyclic::studies {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// Tolerances are tightened by this factor, but not below the precision of doubles.
constexpr double tightening = 1e-2;
constexpr double tightest = 1e-13;
/// How long trajectories are continued if their regimes leave a difference open, in `continued_periods`.
constexpr int at_length = 40;
constexpr int patience = 360;
/// Their tolerance is no smaller than this: the attractor matters, not the phase.
constexpr double fine_enough = 1e-8;
/// Two tori are one if no state of either is farther from the other than this part of their extent.
constexpr double same_set = 0.05;
/// Two orbits count as two attractors if they are so many tolerances apart. Below it, they are one orbit, to within the
/// differences of the methods.
constexpr double clearly = 1e3;

using analysis::Regime;

bool reached(const PointResult& r) { return r.outcome == integrate::Outcome::reached; }
bool chaotic(const PointResult& r) { return r.regime == Regime::chaotic; }
bool periodic(const PointResult& r) { return r.regime == Regime::periodic; }
bool torus(const PointResult& r) { return r.regime == Regime::quasiperiodic; }

/// Everything that explaining a point needs.
class Examiner {
 public:
  Examiner(const RecordingOptions& recording, const CrosscheckOptions& options, const std::vector<Variant>& variants,
           const SmoothedModelAt& model_at, const std::atomic<bool>* stop)
      : recording_(recording), options_(options), variants_(variants), model_at_(model_at), stop_(stop) {}

  void judge(const GridPoint& point, const std::vector<double>& start, const PointResult& reference,
             Comparison& c) const {
    if (!reached(reference) || !reached(c.result)) {
      c.distance = nan;
      c.verdict = Verdict::not_reached;
      c.detail = "reference: " + (reached(reference) ? "ok" : reference.message) +
                 "; variant: " + (reached(c.result) ? "ok" : c.result.message);
      return;
    }
    const Pair both{point, variants_[0], reference, variants_[c.variant], c.result};
    c.distance = distance(both);
    if (chaotic(reference) && chaotic(c.result)) {
      c.distance = nan;
      c.detail = "both chaotic, largest exponents " + exponent_of(reference) + " and " + exponent_of(c.result);
    }
    if (same(both)) return;
    explain(both, start, c);
  }

 private:
  /// Two answers at one point.
  struct Pair {
    const GridPoint& point;
    const Variant& ours;
    const PointResult& our_result;
    const Variant& other;
    const PointResult& their_result;
  };

  [[nodiscard]] std::unique_ptr<integrate::Flow> flow_of(const GridPoint& point, const Variant& v) const {
    return integrate::make_flow(model_at_(point.value, v.clearance_smoothing), v.integrator);
  }

  [[nodiscard]] ConvergedOrbit orbit_of(const GridPoint& point, const Variant& v, const PointResult& result) const {
    return converged_orbit(*flow_of(point, v), result);
  }

  /// d of [A-cross]; without an orbit, the distance of one record from the other.
  [[nodiscard]] double distance(const Pair& both) const {
    const PointResult& a = both.our_result;
    const PointResult& b = both.their_result;
    const std::size_t n = a.end_state.size();
    const double recorded = orbit_distance(a, b, n);
    if (recorded <= options_.orbit_tolerance) return recorded;
    // Records may not have converged: the orbits themselves are compared.
    if (periodic(a) && periodic(b) && converges(both.point, both.ours, a) && converges(both.point, both.other, b))
      if (const double d = orbits_apart(both); std::isfinite(d)) return d;
    if (!std::isnan(recorded)) return recorded;
    double most = 0.0;
    for (std::size_t r = 0; r < std::min(a.poincare_rows(), b.poincare_rows()); ++r)
      most = std::max(most, largest_difference({a.poincare.data() + r * a.poincare_columns, n},
                                               {b.poincare.data() + r * b.poincare_columns, n}));
    return most;
  }

  /// One regime, and one orbit, state by state; if both are chaotic, one growth rate, to within both intervals.
  [[nodiscard]] bool same(const Pair& both) const {
    if (chaotic(both.our_result) && chaotic(both.their_result))
      return overlap(both.our_result.lyapunov_max(), both.their_result.lyapunov_max());
    return both.our_result.regime == both.their_result.regime && both.our_result.period == both.their_result.period &&
           distance(both) <= options_.orbit_tolerance;
  }

  static std::string exponent_of(const PointResult& r) {
    const analysis::Estimate e = r.lyapunov_max();
    return with_error(e.value, e.half_width) + " per tau";
  }

  [[nodiscard]] PointResult compute(const GridPoint& point, const Variant& v, const std::vector<double>& start,
                                    const RecordingOptions& recording) const {
    return compute_point_as_swept(point, model_at_(point.value, v.clearance_smoothing), start, recording, v.integrator,
                                  [this] { return stop_ == nullptr || !stop_->load(); });
  }

  /// The result of the trajectory from a state, some periods later.
  [[nodiscard]] PointResult later(const GridPoint& point, const Variant& v, const std::vector<double>& start,
                                  int periods) const {
    RecordingOptions recording = recording_;
    recording.transient = Transient::fixed;
    recording.transient_periods = periods;
    return compute(point, v, start, recording);
  }

  static Variant tightened(Variant v) {
    v.integrator.relative_tolerance = std::max(tightest, tightening * v.integrator.relative_tolerance);
    v.integrator.absolute_tolerance = std::max(tightest, tightening * v.integrator.absolute_tolerance);
    v.integrator.max_steps_per_period *= 20;
    return v;
  }

  static Variant coarsened(Variant v) {
    v.integrator.relative_tolerance = std::max(fine_enough, v.integrator.relative_tolerance);
    v.integrator.absolute_tolerance = std::max(fine_enough, v.integrator.absolute_tolerance);
    return v;
  }

  static void conclude(Comparison& c, Verdict verdict, std::string detail) {
    c.verdict = verdict;
    c.detail = std::move(detail);
  }

  void explain(const Pair& both, const std::vector<double>& start, Comparison& c) const {
    const auto& [point, ours, reference, other, result] = both;
    const auto done = [&](Verdict verdict, std::string detail) { conclude(c, verdict, std::move(detail)); };
    // The result of a finished study must repeat by its own method.
    if (periodic(reference))
      if (const PointResult again = compute(point, ours, start, recording_);
          !same({point, ours, reference, ours, again}))
        return done(Verdict::unexplained, "the reference gives another result when repeated: " +
                                              regime_text(reference) + ", and now " + regime_text(again));
    if (const double d = c.distance > clearly * options_.orbit_tolerance ? one_orbit(both) : nan;
        d <= options_.orbit_tolerance)
      return done(Verdict::transient, "both converge to one orbit of period " + std::to_string(reference.period) +
                                          ", distance " + short_text(d) + "; a record had not converged to it");
    if (torus(reference) && torus(result))
      if (const std::string one = one_torus(both); !one.empty()) return done(Verdict::torus, one);
    const bool near = periodic(reference) && periodic(result) && c.distance <= clearly * options_.orbit_tolerance;
    if (!near && is_classified(reference) && is_classified(result)) {
      if (const std::string two = two_attractors(both); !two.empty()) return done(Verdict::coexisting, two);
    }

    const Variant tight_ours = tightened(ours);
    const PointResult our_tight = compute(point, tight_ours, start, recording_);
    if (other.clearance_smoothing != ours.clearance_smoothing) {
      Variant same_width = other;
      same_width.clearance_smoothing = ours.clearance_smoothing;
      const PointResult exact = compute(point, same_width, start, recording_);
      if (reached(exact) && same({point, ours, reference, same_width, exact}))
        return done(Verdict::smoothing, "with the reference's width they agree");
    }
    const Variant tight_other = tightened(other);
    const PointResult their_tight = compute(point, tight_other, start, recording_);
    const Pair tight{point, tight_ours, our_tight, tight_other, their_tight};
    if (reached(our_tight) && reached(their_tight) && same(tight))
      return done(Verdict::tolerance,
                  chaotic(our_tight)
                      ? "at tolerances 100 times tighter both have the same largest exponent"
                      : "at tolerances 100 times tighter the distance is " + short_text(distance(tight)));
    follow(both, c);
  }

  /// The long-term result of both trajectories, each continued by its own method.
  void follow(const Pair& both, Comparison& c) const {
    const auto& [point, ours, reference, other, result] = both;
    const auto done = [&](Verdict verdict, std::string detail) { conclude(c, verdict, std::move(detail)); };
    PointResult our_last = reference;
    PointResult their_last = result;
    int followed_for = 0;
    for (const int times : {at_length, patience}) {
      const int more = times * options_.continued_periods;
      const Variant our_coarse = coarsened(ours);
      const Variant their_coarse = coarsened(other);
      our_last = later(point, our_coarse, our_last.end_state, more);
      their_last = later(point, their_coarse, their_last.end_state, more);
      if (!reached(our_last) || !reached(their_last)) break;
      followed_for += more;
      const std::string after = "after " + std::to_string(followed_for) + " more periods ";
      const Pair last{point, ours, our_last, other, their_last};
      if (chaotic(our_last) && chaotic(their_last) && same(last))
        return done(Verdict::chaos, after + "both are chaotic, largest exponents " + exponent_of(our_last) + " and " +
                                        exponent_of(their_last));
      if (torus(our_last) && torus(their_last))
        if (const std::string one = one_torus(last); !one.empty()) return done(Verdict::torus, after + one);
      if (periodic(our_last) && periodic(their_last)) {
        const double d = orbits_apart(last);
        if (d <= options_.orbit_tolerance)
          return done(Verdict::transient, after + "both converge to an orbit of period " +
                                              std::to_string(our_last.period) + ", distance " + short_text(d));
      }
      if (is_classified(our_last) && is_classified(their_last))
        if (const std::string two = two_attractors(last); !two.empty()) return done(Verdict::coexisting, after + two);
    }
    const std::string regimes = "reference " + regime_text(reference) + "; variant " + regime_text(result);
    if (chaotic(our_last) != chaotic(their_last))
      return done(Verdict::chaos,
                  "largest exponents " + exponent_of(our_last) + " and " + exponent_of(their_last) + "; " + regimes);
    // The growth is so slow that one record shows it and the other does not: the measured exponents agree.
    const auto undecided = [](const PointResult& r) { return reached(r) && r.regime == Regime::undecided; };
    if (((chaotic(reference) && undecided(result)) || (undecided(reference) && chaotic(result))) &&
        overlap(reference.lyapunov_max(), result.lyapunov_max()))
      return done(Verdict::chaos,
                  "one is undecided, and the largest exponents agree by their intervals: " + exponent_of(reference) +
                      " and " + exponent_of(result) + "; " + regimes + "; continued, neither is classified as chaotic");
    if (chaotic(our_last) && chaotic(their_last))
      return done(Verdict::unexplained, "both are chaotic and their exponents differ by more than their intervals, " +
                                            exponent_of(our_last) + " and " + exponent_of(their_last) + "; " + regimes);
    done(Verdict::unexplained, "distance " + short_text(c.distance) + "; " + regimes);
  }

  static bool is_classified(const PointResult& r) { return r.regime != Regime::undecided; }

  /// In words, or empty.
  [[nodiscard]] std::string two_attractors(const Pair& both) const {
    const auto& [point, ours, a, other, b] = both;
    if (chaotic(a) && chaotic(b)) return {};
    if (periodic(a) && periodic(b) && orbits_apart(both) <= clearly * options_.orbit_tolerance) return {};
    if (!holds(point, other, ours, a) || !holds(point, ours, other, b)) return {};
    return "each method stays on the other's attractor for " + std::to_string(options_.continued_periods) +
           " more periods: " + regime_name(a) + " and " + regime_name(b) +
           (periodic(a) && periodic(b) && a.period == b.period ? ", distance " + short_text(orbits_apart(both)) : "");
  }

  /// Does a method stay on the attractor that another has found?
  [[nodiscard]] bool holds(const GridPoint& point, const Variant& v, const Variant& by,
                           const PointResult& found) const {
    const PointResult on =
        later(point, v, found.orbit.empty() ? found.end_state : found.orbit, options_.continued_periods);
    const Pair both{point, by, found, v, on};
    return reached(on) && on.regime == found.regime && on.period == found.period &&
           (!periodic(found) || orbits_apart(both) <= clearly * options_.orbit_tolerance) &&
           (!torus(found) || !one_torus(both).empty());
  }

  /// Do two tori fill one set of states? In words, or empty.
  [[nodiscard]] std::string one_torus(const Pair& both) const {
    const analysis::PoincareSection a = long_section(both.point, both.ours, both.our_result.end_state);
    const analysis::PoincareSection b = long_section(both.point, both.other, both.their_result.end_state);
    if (a.size() == 0 || b.size() == 0) return {};
    const double off = std::max(farthest_from(a, b), farthest_from(b, a));
    const double wide = extent(a);
    if (!(off <= same_set * wide)) return {};
    return "both quasiperiodic, on one set of states that is " + short_text(wide) + " wide, none farther than " +
           short_text(off) + " from the other method's in " + std::to_string(a.size()) + " periods";
  }

  [[nodiscard]] analysis::PoincareSection long_section(const GridPoint& point, const Variant& v,
                                                       std::vector<double> state) const {
    const auto flow = flow_of(point, coarsened(v));
    const int half = at_length * options_.continued_periods / 2;
    return analysis::strobe(
               *flow, state, {.transient_periods = half, .recorded_periods = half, .phases = 1}, [](auto&&...) {},
               [this] { return stop_ == nullptr || !stop_->load(); })
        .section;
  }

  /// Is a periodic point's record on its orbit, or does it approach the orbit as fast as the orbit's multipliers say? A
  /// wrong record keeps its distance.
  [[nodiscard]] bool converges(const GridPoint& point, const Variant& v, const PointResult& result) const {
    const ConvergedOrbit s = orbit_of(point, v, result);
    const std::size_t rows = result.poincare_rows();
    if (s.period == 0 || rows < 2) return false;
    const std::size_t n = s.orbit.state.size();
    const auto flow = flow_of(point, v);
    std::vector<std::vector<double>> cycle{s.orbit.state};
    while (cycle.size() < static_cast<std::size_t>(s.period)) {
      cycle.push_back(cycle.back());
      if (!flow->evolve(cycle.back(), 0.0, flow->field().period).reached()) return false;
    }
    const auto farthest = [&](std::size_t from, std::size_t to) {
      double most = 0.0;
      for (std::size_t r = from; r < to; ++r) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& y : cycle)
          nearest = std::min(nearest, largest_difference({result.poincare.data() + r * result.poincare_columns, n}, y));
        most = std::max(most, nearest);
      }
      return most;
    };
    const std::size_t half = rows / 2;
    const double last = farthest(half, rows);
    const double contraction = std::pow(s.largest_multiplier, static_cast<double>(half) / s.period);
    return last <= options_.orbit_tolerance || last <= 0.5 * (1.0 + contraction) * farthest(0, half);
  }

  /// Distance of two periodic points' orbits, each found by its own method. Infinite if they have none, or other
  /// periods.
  [[nodiscard]] double orbits_apart(const Pair& both) const {
    double nearest = std::numeric_limits<double>::infinity();
    const ConvergedOrbit a = orbit_of(both.point, both.ours, both.our_result);
    const ConvergedOrbit b = orbit_of(both.point, both.other, both.their_result);
    if (a.period == 0 || a.period != b.period) return nearest;
    const auto flow = flow_of(both.point, both.ours);
    std::vector<double> y = a.orbit.state;
    for (int k = 0; k < a.period; ++k) {
      nearest = std::min(nearest, largest_difference(y, b.orbit.state));
      if (!flow->evolve(y, 0.0, flow->field().period).reached()) break;
    }
    return nearest;
  }

  /// orbits_apart() of orbits that seem to be one, if the distance is due to the tolerances and vanishes at tighter
  /// ones. Else infinite.
  [[nodiscard]] double one_orbit(const Pair& both) const {
    const auto& [point, ours, a, other, b] = both;
    constexpr double unlike = std::numeric_limits<double>::infinity();
    if (!periodic(a) || !periodic(b)) return unlike;
    const double d = orbits_apart(both);
    if (d <= options_.orbit_tolerance) return d;
    if (d > clearly * options_.orbit_tolerance) return unlike;
    return orbits_apart({point, tightened(ours), a, tightened(other), b});
  }

  const RecordingOptions& recording_;
  const CrosscheckOptions& options_;
  const std::vector<Variant>& variants_;
  const SmoothedModelAt& model_at_;
  const std::atomic<bool>* stop_;
};

}  // namespace

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::agree:
      return "agree";
    case Verdict::coexisting:
      return "coexisting";
    case Verdict::tolerance:
      return "tolerance";
    case Verdict::smoothing:
      return "smoothing";
    case Verdict::transient:
      return "transient";
    case Verdict::torus:
      return "torus";
    case Verdict::chaos:
      return "chaos";
    case Verdict::not_reached:
      return "not_reached";
    case Verdict::unexplained:
      break;
  }
  return "unexplained";
}

std::vector<Variant> crosscheck_variants(const CrosscheckOptions& options,
                                         const integrate::IntegratorOptions& integrator, double study_smoothing) {
  std::vector<Variant> variants;
  for (const std::string& method : options.methods) {
    Variant v{integrator, study_smoothing, method};
    v.integrator.method = method;
    if (!variants.empty()) v.integrator.locate_contacts = false;
    if (!variants.empty() && method != integrator.method) {
      // All methods step over a feature that none evaluates, and then they agree: the others take shorter steps.
      constexpr double shorter = 0.01;
      double& longest = v.integrator.max_step_periods;
      longest = longest > 0.0 ? std::min(longest, shorter) : shorter;
    }
    variants.push_back(std::move(v));
  }
  for (const double width : options.clearance_smoothings) {
    Variant v = variants.front();
    v.clearance_smoothing = width;
    v.label += " w=" + short_text(width);
    variants.push_back(std::move(v));
  }
  return variants;
}

double orbit_distance(const PointResult& a, const PointResult& b, std::size_t dimension) {
  const auto period_of = [](const PointResult& r) {
    return r.recurrence.period > 0 && periodic(r) ? r.period : r.recurrence.period;
  };
  const int period = period_of(a);
  if (period == 0 || period != period_of(b)) return nan;
  const auto rows = [least = std::min(a.poincare_rows(), b.poincare_rows())](const PointResult& r) {
    return std::span(r.poincare).first(least * r.poincare_columns);
  };
  return analysis::cycle_distance(rows(a), rows(b), a.poincare_columns, dimension, static_cast<std::size_t>(period));
}

namespace {

/// The reference's points by the other variants.
/// @param starts  of each point
/// @param done    results of an earlier run
/// @param report  receives the others, one at a time
void compare_with_others(Crosscheck& all, const std::vector<std::vector<double>>& starts,
                         const RecordingOptions& recording, const CrosscheckOptions& options,
                         const SmoothedModelAt& model_at, const CrosscheckRun& run,
                         const std::function<void(std::size_t variant, const PointResult&)>& report) {
  const Examiner examiner(recording, options, all.variants, model_at, run.stop);
  const std::size_t others = all.variants.size() - 1;
  std::vector<std::optional<Comparison>> comparisons(all.reference.size() * others);
  const auto stopped = [&] { return run.stop != nullptr && run.stop->load(); };
  parallel_for(comparisons.size(), run.threads, run.stop, [&](std::size_t unit) {
    Comparison c;
    c.point = unit / others;
    c.variant = 1 + unit % others;
    const PointResult& reference = all.reference[c.point];
    const std::vector<double>& start = starts[c.point];
    const Variant& v = all.variants[c.variant];
    const auto earlier = run.done.find({c.variant, reference.point.index});
    if (earlier != run.done.end()) {
      c.result = earlier->second;
    } else {
      c.result = compute_point_as_swept(reference.point, model_at(reference.point.value, v.clearance_smoothing), start,
                                        recording, v.integrator, [&] { return !stopped(); });
      if (stopped()) return;
      report(c.variant, c.result);
    }
    examiner.judge(reference.point, start, reference, c);
    if (!stopped()) comparisons[unit] = std::move(c);
  });
  for (auto& c : comparisons)
    if (c) all.comparisons.push_back(std::move(*c));
}

/// Reports results to the run, one at a time.
class Reporter {
 public:
  explicit Reporter(const CrosscheckRun& run) : run_(run) {}
  void operator()(std::size_t variant, const PointResult& r) {
    if (!run_.point_finished) return;
    const std::scoped_lock lock(mutex_);
    run_.point_finished(variant, r);
  }

 private:
  const CrosscheckRun& run_;
  std::mutex mutex_;
};

}  // namespace

Crosscheck run_crosscheck(const SweepPlan& plan, const RecordingOptions& recording, const CrosscheckOptions& options,
                          const integrate::IntegratorOptions& integrator, double study_smoothing,
                          const SmoothedModelAt& model_at, const CrosscheckRun& run) {
  options.validate();
  Crosscheck all;
  all.variants = crosscheck_variants(options, integrator, study_smoothing);
  Reporter report(run);

  SweepRun reference;
  reference.threads = run.threads;
  reference.stop = run.stop;
  std::map<std::size_t, PointResult> known_reference;
  for (const auto& [key, result] : run.done)
    if (key.first == 0) known_reference.emplace(key.second, result);
  reference.point_finished = [&](const PointResult& r) { report(0, r); };
  all.reference = run_sweep_in_memory(
      plan, recording, all.variants[0].integrator,
      [&](double value) { return model_at(value, all.variants[0].clearance_smoothing); }, std::move(reference),
      std::move(known_reference));
  if (all.reference.size() < plan.points.size()) return all;

  // The start of each point: the end of the one before in its chain, or cold.
  std::vector<std::vector<double>> starts(plan.points.size());
  for (const auto& chain : plan.chains)
    for (std::size_t k = 1; k < chain.size(); ++k) starts[chain[k]] = all.reference[chain[k - 1]].end_state;

  compare_with_others(all, starts, recording, options, model_at, run, std::ref(report));
  return all;
}

namespace {

/// How many of `count` each group gets. Groups with members left get one each in cyclic order, the largest group first.
std::vector<std::size_t> shares(std::size_t count, const std::vector<std::size_t>& sizes) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  std::vector<std::size_t> share(sizes.size());
  for (std::size_t before = count + 1; count > 0 && count < before;) {
    before = count;
    for (const std::size_t g : order) {
      if (count == 0 || share[g] == sizes[g]) continue;
      ++share[g];
      --count;
    }
  }
  return share;
}

}  // namespace

std::vector<std::size_t> points_of_each_regime(const SweepOptions& sweep, const PointSource& finished) {
  std::map<Regime, std::map<int, std::vector<std::size_t>>> by_regime;  // by regime and period
  const SweepPlan plan = plan_sweep(sweep);
  for (const Chain& chain : plan.chains)
    for (std::size_t k = sweep.start == Start::cold ? 0 : 1; k < chain.size(); ++k) {
      const PointSummary r = finished.read_summary(chain[k]);
      if (r.outcome == integrate::Outcome::reached && r.regime != Regime::undecided)
        by_regime[r.regime][r.period].push_back(chain[k]);
    }
  std::vector<std::size_t> of_regime;
  for (const auto& [regime, periods] : by_regime) {
    of_regime.push_back(0);
    for (const auto& [period, points] : periods) of_regime.back() += points.size();
  }
  const auto of_each = shares(static_cast<std::size_t>(sweep.check.points), of_regime);
  std::vector<std::size_t> chosen;
  std::size_t g = 0;
  for (const auto& [regime, periods] : by_regime) {
    std::vector<std::size_t> of_period;
    for (const auto& [period, points] : periods) of_period.push_back(points.size());
    const auto counts = shares(of_each[g++], of_period);
    std::size_t p = 0;
    for (const auto& [period, points] : periods) {
      const std::size_t count = counts[p++];
      for (std::size_t k = 0; k < count; ++k) chosen.push_back(points[(2 * k + 1) * points.size() / (2 * count)]);
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

Crosscheck run_check_of_sweep(const SweepOptions& sweep, const PointSource& finished,
                              const integrate::IntegratorOptions& integrator, double study_smoothing,
                              const SmoothedModelAt& model_at, const CrosscheckRun& run) {
  sweep.validate();
  CrosscheckOptions options;
  options.methods = {integrator.method};
  options.methods.insert(options.methods.end(), sweep.check.methods.begin(), sweep.check.methods.end());
  options.orbit_tolerance = sweep.check.orbit_tolerance;
  Crosscheck all;
  all.variants = crosscheck_variants(options, integrator, study_smoothing);
  const SweepPlan plan = plan_sweep(sweep);
  std::vector<std::size_t> before(plan.points.size(), plan.points.size());
  for (const Chain& chain : plan.chains)
    for (std::size_t k = 1; k < chain.size(); ++k) before[chain[k]] = chain[k - 1];
  std::vector<std::vector<double>> starts;
  for (const std::size_t point : points_of_each_regime(sweep, finished)) {
    all.reference.push_back(finished.read(point));
    starts.emplace_back();
    if (before[point] < plan.points.size()) starts.back() = finished.read_summary(before[point]).end_state;
  }
  Reporter report(run);
  compare_with_others(all, starts, sweep.recording, options, model_at, run, std::ref(report));
  return all;
}

}  // namespace epicyclic::studies
