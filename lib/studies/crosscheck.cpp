#include "studies/crosscheck.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "analysis/lyapunov.hpp"
#include "core/text.hpp"
#include "integrate/make_flow.hpp"
#include "studies/operating_point.hpp"
#include "studies/settled_orbit.hpp"
#include "studies/units.hpp"

namespace epicyclic::studies {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// Tolerances are tightened by this much, but not below what doubles can hold.
constexpr double tightening = 1e-2;
constexpr double tightest = 1e-13;
/// How long exponents are measured, in `continued_periods`: to recognise chaos, and to find weak chaos where nothing
/// else explains a difference.
constexpr int briefly = 5;
constexpr int at_length = 40;

bool reached(const PointResult& r) { return r.outcome == integrate::Outcome::reached; }

/// What is known of the reference's motion besides its record.
struct Known {
  SettledOrbit orbit;
  analysis::Estimate exponent{0.0,
                              std::numeric_limits<double>::infinity()};  ///< largest, per tau; if there is no orbit
};

/// Everything that explaining a point needs.
class Examiner {
 public:
  Examiner(const SweepOptions& sweep, const CrosscheckOptions& options, const std::vector<Variant>& variants,
           const SmoothedModelAt& model_at, const std::atomic<bool>* stop)
      : sweep_(sweep), options_(options), variants_(variants), model_at_(model_at), stop_(stop) {}

  void judge(const GridPoint& point, const std::vector<double>& start, const PointResult& reference, const Known& known,
             Comparison& c) const {
    if (!reached(reference) || !reached(c.result)) {
      c.distance = nan;
      c.verdict = reference.outcome == c.result.outcome ? Verdict::agree : Verdict::not_reached;
      c.detail = "reference: " + (reached(reference) ? "ok" : reference.message) +
                 "; variant: " + (reached(c.result) ? "ok" : c.result.message);
      return;
    }
    const std::size_t n = model_at_(point.value, variants_[0].clearance_smoothing).dimension;
    c.distance = distance(reference, c.result, n);
    if (same(reference, c.result, n)) return;
    if (reference.recurrence.period == 0 && c.result.recurrence.period == 0) {
      if (known.orbit.period > 0) {
        const SettledOrbit theirs = orbit_of(point, variants_[c.variant], c.result);
        if (known.orbit.period == theirs.period) {
          c.distance = apart(known.orbit.orbit.state, theirs.orbit.state);
          if (c.distance <= options_.orbit_tolerance) {
            c.detail = "both settle to one orbit of period " + std::to_string(theirs.period);
            return;
          }
        }
      } else {
        const analysis::Estimate theirs = exponent(point, variants_[c.variant].clearance_smoothing, c.result.end_state,
                                                   briefly * options_.continued_periods);
        if (known.exponent.low() > 0.0 && theirs.low() > 0.0) {
          c.distance = nan;
          c.detail = "both chaotic, largest exponents " + text_of(known.exponent) + " and " + text_of(theirs);
          return;
        }
      }
    }
    explain(point, start, reference, n, c);
  }

  [[nodiscard]] Known look_at(const GridPoint& point, const PointResult& reference) const {
    Known known{orbit_of(point, variants_[0], reference)};
    if (known.orbit.period == 0 && reached(reference))
      known.exponent =
          exponent(point, variants_[0].clearance_smoothing, reference.end_state, briefly * options_.continued_periods);
    return known;
  }

 private:
  [[nodiscard]] SettledOrbit orbit_of(const GridPoint& point, const Variant& v, const PointResult& motion) const {
    const auto flow = integrate::make_flow(vector_field(model_at_(point.value, v.clearance_smoothing)), v.integrator);
    return settled_orbit(*flow, motion);
  }

  static double apart(const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return most;
  }

  /// d of [A-cross].
  [[nodiscard]] static double distance(const PointResult& a, const PointResult& b, std::size_t n) {
    if (a.recurrence.period > 0 && a.recurrence.period == b.recurrence.period) return orbit_distance(a, b, n);
    double most = 0.0;
    for (std::size_t r = 0; r < std::min(a.poincare_rows(), b.poincare_rows()); ++r)
      for (std::size_t j = 0; j < n; ++j)
        most =
            std::max(most, std::abs(a.poincare[r * a.poincare_columns + j] - b.poincare[r * b.poincare_columns + j]));
    return most;
  }

  [[nodiscard]] bool same(const PointResult& a, const PointResult& b, std::size_t n) const {
    return a.recurrence.period == b.recurrence.period && distance(a, b, n) <= options_.orbit_tolerance;
  }

  static std::string text_of(const analysis::Estimate& e) {
    return short_text(e.value) + " +- " + short_text(e.half_width) + " per tau";
  }

  [[nodiscard]] PointResult compute(const GridPoint& point, const Variant& v, const std::vector<double>& start,
                                    int transient) const {
    SweepOptions sweep = sweep_;
    sweep.transient_periods = transient;
    return compute_point(point, model_at_(point.value, v.clearance_smoothing), start, sweep, v.integrator,
                         [this] { return stop_ == nullptr || !stop_->load(); });
  }

  static Variant tightened(Variant v) {
    v.integrator.relative_tolerance = std::max(tightest, tightening * v.integrator.relative_tolerance);
    v.integrator.absolute_tolerance = std::max(tightest, tightening * v.integrator.absolute_tolerance);
    v.integrator.max_steps_per_period *= 20;
    return v;
  }

  void explain(const GridPoint& point, const std::vector<double>& start, const PointResult& reference, std::size_t n,
               Comparison& c) const {
    const Variant& ours = variants_[0];
    const Variant& other = variants_[c.variant];
    const auto done = [&](Verdict verdict, std::string detail) {
      c.verdict = verdict;
      c.detail = std::move(detail);
    };

    // One answer continued with the other method, both ways.
    const int continued = options_.continued_periods;
    const PointResult theirs_on_ours = compute(point, other, reference.end_state, continued);
    const PointResult ours_on_theirs = compute(point, ours, c.result.end_state, continued);
    const bool both_periodic = reference.recurrence.period > 0 && c.result.recurrence.period > 0;
    const bool holds_ours = reached(theirs_on_ours) && same(reference, theirs_on_ours, n);
    const bool holds_theirs = reached(ours_on_theirs) && same(c.result, ours_on_theirs, n);
    // Two answers that both methods hold are two motions, unless they are one to within what the methods may differ by.
    constexpr double clearly = 1e3;
    const bool far = !(c.distance <= clearly * options_.orbit_tolerance);
    if (both_periodic && holds_ours && holds_theirs && far)
      return done(Verdict::coexisting, "each method stays on the other's orbit for " + std::to_string(continued) +
                                           " more periods; distance " + short_text(c.distance));

    const PointResult tight_ours = compute(point, tightened(ours), start, sweep_.transient_periods);
    if (other.clearance_smoothing != ours.clearance_smoothing) {
      Variant same_width = other;
      same_width.clearance_smoothing = ours.clearance_smoothing;
      const PointResult exact = compute(point, same_width, start, sweep_.transient_periods);
      if (reached(exact) && same(reference, exact, n))
        return done(Verdict::smoothing, "with the reference's width they agree");
    }
    const PointResult tight_theirs = compute(point, tightened(other), start, sweep_.transient_periods);
    if (reached(tight_ours) && reached(tight_theirs) && same(tight_ours, tight_theirs, n))
      return done(Verdict::tolerance, "at tolerances 100 times tighter the distance is " +
                                          short_text(distance(tight_ours, tight_theirs, n)));

    const analysis::Estimate chaos =
        exponent(point, ours.clearance_smoothing, reference.end_state, at_length * continued);
    if (chaos.low() > 0.0) return done(Verdict::chaos, "largest exponent " + text_of(chaos));

    // A long way from either, both methods at last on one motion?
    const int long_way = sweep_.transient_periods + 10 * continued;
    const PointResult late_ours = compute(point, ours, reference.end_state, long_way);
    const PointResult late_theirs = compute(point, other, c.result.end_state, long_way);
    if (reached(late_ours) && reached(late_theirs) && same(late_ours, late_theirs, n) &&
        late_ours.recurrence.period > 0)
      return done(Verdict::settling, "after " + std::to_string(long_way) + " more periods they agree, distance " +
                                         short_text(orbit_distance(late_ours, late_theirs, n)));
    if (late_ours.recurrence.period > 0 && late_theirs.recurrence.period > 0) {
      const PointResult crossed = compute(point, other, late_ours.end_state, continued);
      const PointResult crossed_back = compute(point, ours, late_theirs.end_state, continued);
      if (same(late_ours, crossed, n) && same(late_theirs, crossed_back, n))
        return done(Verdict::coexisting, "after " + std::to_string(long_way) +
                                             " more periods each method stays on the other's orbit; distance " +
                                             short_text(orbit_distance(late_ours, late_theirs, n)));
    }
    const analysis::Estimate theirs =
        exponent(point, other.clearance_smoothing, c.result.end_state, at_length * continued);
    if (theirs.low() > 0.0) return done(Verdict::chaos, "largest exponent of the variant's motion " + text_of(theirs));
    done(Verdict::unexplained, "distance " + short_text(c.distance) + ", periods " +
                                   std::to_string(reference.recurrence.period) + " and " +
                                   std::to_string(c.result.recurrence.period) + ", exponents " +
                                   short_text(chaos.value) + " and " + short_text(theirs.value));
  }

  /// Largest exponent per tau of the motion that a state is on; its interval is infinite if there is none. By the
  /// reference's method at no finer a tolerance than chaos can use: the motion is what matters, not how it was found.
  [[nodiscard]] analysis::Estimate exponent(const GridPoint& point, double clearance_smoothing,
                                            std::vector<double> state, int periods) const {
    const model::DynamicModel model = model_at_(point.value, clearance_smoothing);
    integrate::IntegratorOptions o = variants_[0].integrator;
    constexpr double fine = 1e-8;
    o.relative_tolerance = std::max(o.relative_tolerance, fine);
    o.absolute_tolerance = std::max(o.absolute_tolerance, fine);
    const auto flow = integrate::make_flow(vector_field(model), o);
    analysis::LargestExponent e = analysis::largest_exponent(*flow, state, {50, periods}, {},
                                                             [this] { return stop_ == nullptr || !stop_->load(); });
    if (!e.evolution.reached()) return {0.0, std::numeric_limits<double>::infinity()};
    return {e.per_s.value * model.omega, e.per_s.half_width * model.omega};
  }

  const SweepOptions& sweep_;
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
    case Verdict::settling:
      return "settling";
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
  const int period = a.recurrence.period;
  if (period == 0 || period != b.recurrence.period) return nan;
  const auto n = static_cast<std::size_t>(period);
  double least = std::numeric_limits<double>::infinity();
  const std::size_t rows = std::min(a.poincare_rows(), b.poincare_rows());
  if (rows < n) return nan;
  const std::size_t last = rows - n;
  for (std::size_t shift = 0; shift < n; ++shift) {
    double most = 0.0;
    for (std::size_t r = 0; r < n; ++r) {
      const double* x = a.poincare.data() + (last + r) * a.poincare_columns;
      const double* y = b.poincare.data() + (last + (r + shift) % n) * b.poincare_columns;
      for (std::size_t j = 0; j < dimension; ++j) most = std::max(most, std::abs(x[j] - y[j]));
    }
    least = std::min(least, most);
  }
  return least;
}

Crosscheck run_crosscheck(const SweepPlan& plan, const SweepOptions& sweep, const CrosscheckOptions& options,
                          const integrate::IntegratorOptions& integrator, double study_smoothing,
                          const SmoothedModelAt& model_at, CrosscheckRun run) {
  Crosscheck all;
  all.variants = crosscheck_variants(options, integrator, study_smoothing);
  std::mutex mutex;
  const auto tell = [&](std::size_t variant, const PointResult& r) {
    if (!run.point_finished) return;
    const std::scoped_lock lock(mutex);
    run.point_finished(variant, r);
  };

  SweepRun reference;
  reference.threads = run.threads;
  reference.stop = run.stop;
  for (const auto& [key, result] : run.done)
    if (key.first == 0) reference.done.emplace(key.second, result);
  reference.point_finished = [&](const PointResult& r) { tell(0, r); };
  all.reference = run_sweep(
      plan, sweep, all.variants[0].integrator,
      [&](double value) { return model_at(value, all.variants[0].clearance_smoothing); }, std::move(reference));
  if (all.reference.size() < plan.points.size()) return all;

  const Examiner examiner(sweep, options, all.variants, model_at, run.stop);
  std::vector<Known> known(plan.points.size());
  all.orbit_period.assign(plan.points.size(), 0);
  for_units(plan.points.size(), run.threads, run.stop, [&](std::size_t k) {
    known[k] = examiner.look_at(plan.points[k], all.reference[k]);
    all.orbit_period[k] = known[k].orbit.period;
  });

  // Where each point started: at the end of the one before in its chain, or cold.
  std::vector<std::vector<double>> starts(plan.points.size());
  for (const auto& chain : plan.chains)
    for (std::size_t k = 1; k < chain.size(); ++k) starts[chain[k]] = all.reference[chain[k - 1]].end_state;

  const std::size_t others = all.variants.size() - 1;
  std::vector<std::optional<Comparison>> comparisons(plan.points.size() * others);
  const auto stopped = [&] { return run.stop != nullptr && run.stop->load(); };
  for_units(comparisons.size(), run.threads, run.stop, [&](std::size_t unit) {
    Comparison c;
    c.point = unit / others;
    c.variant = 1 + unit % others;
    const GridPoint& point = plan.points[c.point];
    const Variant& v = all.variants[c.variant];
    const auto earlier = run.done.find({c.variant, c.point});
    if (earlier != run.done.end()) {
      c.result = earlier->second;
    } else {
      c.result = compute_point(point, model_at(point.value, v.clearance_smoothing), starts[c.point], sweep,
                               v.integrator, [&] { return !stopped(); });
      if (stopped()) return;
      tell(c.variant, c.result);
    }
    examiner.judge(point, starts[c.point], all.reference[c.point], known[c.point], c);
    if (!stopped()) comparisons[unit] = std::move(c);
  });
  for (auto& c : comparisons)
    if (c) all.comparisons.push_back(std::move(*c));
  return all;
}

}  // namespace epicyclic::studies
