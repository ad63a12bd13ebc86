#include "studies/crosscheck.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "analysis/lyapunov.hpp"
#include "core/largest_difference.hpp"
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
/// How long motions are followed, in `continued_periods`: to recognise chaos, and to find weak chaos, a torus or a slow
/// transient where nothing else explains a difference.
constexpr int briefly = 5;
constexpr int at_length = 40;
/// How much longer, in `continued_periods`, a motion may wander before it comes to its orbit.
constexpr int patience = 360;
/// Chaos and orbits are followed no more finely than this: the motion is what matters, not its phase.
constexpr double fine_enough = 1e-8;

bool reached(const PointResult& r) { return r.outcome == integrate::Outcome::reached; }

/// Where a motion goes.
struct Course {
  analysis::Estimate exponent{0.0, std::numeric_limits<double>::infinity()};  ///< largest, per tau
  double late_growth = 0;             ///< log of a tangent vector's growth over the last half
  analysis::PoincareSection section;  ///< of the last half
  std::vector<double> state;          ///< the last one; empty if it was not reached

  [[nodiscard]] bool chaotic() const { return exponent.low() > 0.0; }
  /// Nearby motions neither part nor meet.
  [[nodiscard]] bool neutral() const { return !state.empty() && std::abs(late_growth) <= analysis::neutral_growth; }
};

/// What is known of the reference's motion besides its record.
struct Known {
  SettledOrbit orbit;
  Course course{};  ///< followed briefly, at length where that leaves it open; empty if there is an orbit
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
          c.distance = largest_difference(known.orbit.orbit.state, theirs.orbit.state);
          if (c.distance <= options_.orbit_tolerance) {
            c.detail = "both settle to one orbit of period " + std::to_string(theirs.period);
            return;
          }
        }
      } else if (known.course.chaotic()) {
        const Course theirs = follow(point, variants_[c.variant], c.result.end_state, briefly);
        if (theirs.chaotic()) {
          c.distance = nan;
          c.detail =
              "both chaotic, largest exponents " + text_of(known.course.exponent) + " and " + text_of(theirs.exponent);
          return;
        }
      }
    }
    explain(point, start, reference, known, n, c);
  }

  [[nodiscard]] Known look_at(const GridPoint& point, const PointResult& reference) const {
    Known known{orbit_of(point, variants_[0], reference)};
    if (known.orbit.period > 0 || !reached(reference)) return known;
    known.course = follow(point, variants_[0], reference.end_state, briefly);
    if (!known.course.chaotic()) known.course = follow(point, variants_[0], reference.end_state, at_length);
    return known;
  }

 private:
  [[nodiscard]] SettledOrbit orbit_of(const GridPoint& point, const Variant& v, const PointResult& motion) const {
    return settled_orbit(*flow_of(point, v), motion);
  }

  [[nodiscard]] std::unique_ptr<integrate::Flow> flow_of(const GridPoint& point, const Variant& v) const {
    return integrate::make_flow(vector_field(model_at_(point.value, v.clearance_smoothing)), v.integrator);
  }

  /// d of [A-cross].
  [[nodiscard]] static double distance(const PointResult& a, const PointResult& b, std::size_t n) {
    if (a.recurrence.period > 0 && a.recurrence.period == b.recurrence.period) return orbit_distance(a, b, n);
    double most = 0.0;
    for (std::size_t r = 0; r < std::min(a.poincare_rows(), b.poincare_rows()); ++r)
      most = std::max(most, largest_difference({a.poincare.data() + r * a.poincare_columns, n},
                                               {b.poincare.data() + r * b.poincare_columns, n}));
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

  static Variant coarsened(Variant v) {
    v.integrator.relative_tolerance = std::max(fine_enough, v.integrator.relative_tolerance);
    v.integrator.absolute_tolerance = std::max(fine_enough, v.integrator.absolute_tolerance);
    return v;
  }

  void explain(const GridPoint& point, const std::vector<double>& start, const PointResult& reference,
               const Known& known, std::size_t n, Comparison& c) const {
    const Variant& ours = variants_[0];
    const Variant& other = variants_[c.variant];
    const auto done = [&](Verdict verdict, std::string detail) {
      c.verdict = verdict;
      c.detail = std::move(detail);
    };

    // One answer continued with the other method, both ways. Two answers that both methods hold are two motions, unless
    // they are one to within what the methods may differ by.
    const bool both_periodic = reference.recurrence.period > 0 && c.result.recurrence.period > 0;
    constexpr double clearly = 1e3;
    if (both_periodic && !(c.distance <= clearly * options_.orbit_tolerance)) {
      const int continued = options_.continued_periods;
      if (holds(point, other, reference, continued, n) && holds(point, ours, c.result, continued, n))
        return done(Verdict::coexisting, "each method stays on the other's orbit for " + std::to_string(continued) +
                                             " more periods; distance " + short_text(c.distance));
    }

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

    // Followed for long, from either.
    const bool followed = known.orbit.period == 0;
    const Course course = followed ? known.course : follow(point, ours, reference.end_state, at_length);
    if (course.chaotic()) return done(Verdict::chaos, "largest exponent " + text_of(course.exponent));
    const Course theirs = follow(point, other, c.result.end_state, at_length);
    if (theirs.chaotic())
      return done(Verdict::chaos, "largest exponent of the variant's motion " + text_of(theirs.exponent) +
                                      ", of the reference's " + text_of(course.exponent));
    if (course.neutral() && theirs.neutral()) {
      const double off =
          std::max(farthest_from(course.section, theirs.section), farthest_from(theirs.section, course.section));
      const double wide = extent(course.section);
      constexpr double same_set = 0.05;
      if (off <= same_set * wide)
        return done(Verdict::torus, "states of one set that is " + short_text(wide) + " wide, none farther than " +
                                        short_text(off) + " from the other method's; tangents grow by e^" +
                                        short_text(course.late_growth) + " and e^" + short_text(theirs.late_growth) +
                                        " in " + std::to_string(course.section.size()) + " periods");
    }

    // Both at last on one orbit, or each on an orbit that the other method has, too?
    std::vector<double> our_state = course.state;
    std::vector<double> their_state = theirs.state;
    int followed_for = at_length * options_.continued_periods;
    for (const int more : {sweep_.transient_periods, patience * options_.continued_periods}) {
      if (our_state.empty() || their_state.empty()) break;
      followed_for += more;
      const PointResult our_motion = compute(point, coarsened(ours), our_state, more);
      const PointResult their_motion = compute(point, coarsened(other), their_state, more);
      our_state = our_motion.end_state;
      their_state = their_motion.end_state;
      const SettledOrbit our_orbit = orbit_of(point, ours, our_motion);
      const SettledOrbit their_orbit = orbit_of(point, other, their_motion);
      if (our_orbit.period == 0 || their_orbit.period == 0) continue;
      const double d = nearest_phase(point, ours, our_orbit, their_orbit);
      const std::string after = "after " + std::to_string(followed_for) + " more periods ";
      if (d <= options_.orbit_tolerance)
        return done(Verdict::settling, after + "both settle to an orbit of period " + std::to_string(our_orbit.period) +
                                           ", distance " + short_text(d));
      if (has_orbit(point, other, our_orbit) && has_orbit(point, ours, their_orbit))
        return done(Verdict::coexisting, after + "they are on two orbits, of periods " +
                                             std::to_string(our_orbit.period) + " and " +
                                             std::to_string(their_orbit.period) + ", both attracting by both methods");
    }
    done(Verdict::unexplained, "distance " + short_text(c.distance) + ", periods " +
                                   std::to_string(reference.recurrence.period) + " and " +
                                   std::to_string(c.result.recurrence.period) + ", exponents " +
                                   text_of(course.exponent) + " and " + text_of(theirs.exponent));
  }

  /// Does a method stay on the motion that another has found?
  [[nodiscard]] bool holds(const GridPoint& point, const Variant& v, const PointResult& found, int periods,
                           std::size_t n) const {
    const PointResult on = compute(point, v, found.end_state, periods);
    return reached(on) && same(found, on, n);
  }

  /// Has a method the same attracting orbit that another has found?
  [[nodiscard]] bool has_orbit(const GridPoint& point, const Variant& v, const SettledOrbit& found) const {
    const auto flow = flow_of(point, v);
    const analysis::PeriodicOrbit own = analysis::find_periodic_orbit(*flow, found.orbit.state, found.period);
    return own.found() && largest_difference(own.state, found.orbit.state) <= options_.orbit_tolerance &&
           largest_multiplier(own) < 1.0;
  }

  /// Distance of an orbit's first state from the nearest of the other orbit's; infinite for different periods.
  [[nodiscard]] double nearest_phase(const GridPoint& point, const Variant& v, const SettledOrbit& a,
                                     const SettledOrbit& b) const {
    double nearest = std::numeric_limits<double>::infinity();
    if (a.period != b.period) return nearest;
    const auto flow = flow_of(point, v);
    std::vector<double> y = a.orbit.state;
    for (int k = 0; k < a.period; ++k) {
      nearest = std::min(nearest, largest_difference(y, b.orbit.state));
      if (!flow->evolve(y, 0.0, flow->field().period).reached()) break;
    }
    return nearest;
  }

  /// Follows the motion that a state is on by the variant's method, for a number of continuations.
  [[nodiscard]] Course follow(const GridPoint& point, const Variant& v, std::vector<double> state, int times) const {
    const model::DynamicModel model = model_at_(point.value, v.clearance_smoothing);
    const auto flow = integrate::make_flow(vector_field(model), coarsened(v).integrator);
    const int periods = times * options_.continued_periods;
    const auto half = static_cast<std::size_t>(periods / 2);
    Course course;
    course.section.dimension = model.dimension;
    const analysis::LargestExponent e = analysis::largest_exponent(
        *flow, state, {50, periods},
        [&](std::size_t k, double, std::span<const double> y) {
          if (k >= half) course.section.states.insert(course.section.states.end(), y.begin(), y.end());
        },
        [this] { return stop_ == nullptr || !stop_->load(); });
    if (!e.evolution.reached() || e.growth.size() < static_cast<std::size_t>(periods)) return course;
    course.exponent = e.per_s * model.omega;
    course.late_growth = analysis::late_growth(e.growth);
    course.state = std::move(state);
    return course;
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
      most = std::max(most, largest_difference({x, dimension}, {y, dimension}));
    }
    least = std::min(least, most);
  }
  return least;
}

Crosscheck run_crosscheck(const SweepPlan& plan, const SweepOptions& as_given, const CrosscheckOptions& options,
                          const integrate::IntegratorOptions& integrator, double study_smoothing,
                          const SmoothedModelAt& model_at, CrosscheckRun run) {
  const SweepOptions sweep = by_recurrence_alone(as_given);
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
  std::map<std::size_t, PointResult> known_reference;
  for (const auto& [key, result] : run.done)
    if (key.first == 0) known_reference.emplace(key.second, result);
  reference.point_finished = [&](const PointResult& r) { tell(0, r); };
  all.reference = run_sweep_in_memory(
      plan, sweep, all.variants[0].integrator,
      [&](double value) { return model_at(value, all.variants[0].clearance_smoothing); }, std::move(reference),
      std::move(known_reference));
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
