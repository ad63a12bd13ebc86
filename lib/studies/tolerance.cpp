#include "studies/tolerance.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>

#include "analysis/lyapunov.hpp"
#include "core/fit.hpp"
#include "core/largest_difference.hpp"
#include "integrate/make_flow.hpp"
#include "studies/converged_orbit.hpp"
#include "studies/parallel_for.hpp"
#include "studies/response_statistics.hpp"

namespace epicyclic::studies {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double period = 2.0 * std::numbers::pi;
/// The reference, and the method that estimates its error: other tables, other orders.
constexpr const char* reference_method = "arkode-verner65";
constexpr const char* second_method = "arkode-dopri5";

Quantities all_nan() {
  Quantities q;
  q.fill(nan);
  return q;
}

integrate::IntegratorOptions with(const integrate::IntegratorOptions& base, const std::string& method, double rtol,
                                  double atol) {
  integrate::IntegratorOptions o = base;
  o.method = method;
  o.relative_tolerance = rtol;
  o.absolute_tolerance = atol;
  o.locate_contacts = o.locate_contacts && method == base.method;
  constexpr long plenty = 10'000'000;  // the finest tolerances of low orders take more steps than a study would allow
  o.max_steps_per_period = std::max(o.max_steps_per_period, plenty);
  return o;
}

integrate::Work difference(const integrate::Work& after, const integrate::Work& before) {
  return {after.right_hand_sides - before.right_hand_sides,
          after.tangent_right_hand_sides - before.tangent_right_hand_sides, after.jacobians - before.jacobians,
          after.steps - before.steps};
}

/// Integrates the state over n periods. After an outcome other than reached, it is the last state.
integrate::Evolution advance(integrate::Flow& flow, std::vector<double>& y, int n) {
  flow.forget();
  integrate::Evolution e;
  for (int k = 0; k < n; ++k) {
    e = flow.evolve(y, 0.0, period);
    if (!e.reached()) break;
  }
  return e;
}

/// The reported quantities of n periods from y.
/// @param phases  of a period at which they are taken
Quantities quantities_of(integrate::Flow& flow, const model::DynamicModel& model, std::vector<double> y, int n,
                         const std::vector<double>& phases) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Quantities q = {infinity, -infinity, infinity, -infinity};
  model::MeshDeflections d;
  flow.forget();
  for (int k = 0; k < n; ++k) {
    const auto e = flow.evolve(y, 0.0, period, phases, [&](std::size_t, double s, std::span<const double> at) {
      model.deflections(s, at.data(), d);
      q[0] = std::min(q[0], d.sun_planet[0]);
      q[1] = std::max(q[1], d.sun_planet[0]);
      q[2] = std::min(q[2], d.ring_planet[0]);
      q[3] = std::max(q[3], d.ring_planet[0]);
    });
    if (!e.reached()) return all_nan();
  }
  return q;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Q(w) = Q_0 + c w^p through three widths in a row. They are the ones nearest to zero whose differences have one sign
/// and exceed their errors.
void extrapolate(TolerancePoint& point, std::size_t k) {
  point.extrapolated[k] = nan;
  point.exponent[k] = nan;
  const auto& s = point.smoothing;
  for (std::size_t last = s.size(); last-- > 2;) {
    const SmoothingStep& a = s[last - 2];
    const SmoothingStep& b = s[last - 1];
    const SmoothingStep& c = s[last];
    if (!a.found || !b.found || !c.found) continue;
    const double ab = a.quantities[k] - b.quantities[k];
    const double bc = b.quantities[k] - c.quantities[k];
    constexpr double known_to = 1e-9;
    if (!(ab * bc > 0.0) || std::abs(bc) < known_to) continue;
    // (a^p - b^p) / (b^p - c^p) = ab / bc for p, by bisection: the left side rises with p.
    const auto ratio = [&](double p) {
      return (std::pow(a.width, p) - std::pow(b.width, p)) / (std::pow(b.width, p) - std::pow(c.width, p));
    };
    double low = 0.05;
    double high = 8.0;
    if (ratio(low) > ab / bc || ratio(high) < ab / bc) continue;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (ratio(middle) < ab / bc ? low : high) = middle;
    }
    const double p = low;
    point.exponent[k] = p;
    point.extrapolated[k] = c.quantities[k] - bc * std::pow(c.width, p) / (std::pow(b.width, p) - std::pow(c.width, p));
    return;
  }
}

class PointStudy {
 public:
  PointStudy(TolerancePoint& out, const RecordingOptions& recording, const ToleranceOptions& options,
             const integrate::IntegratorOptions& integrator, double study_smoothing, const SmoothedModelAt& model_at,
             int threads, const std::atomic<bool>* stop)
      : out_(out),
        recording_(recording),
        options_(options),
        integrator_(integrator),
        study_smoothing_(study_smoothing),
        model_at_(model_at),
        threads_(threads),
        stop_(stop),
        model_(model_at(out.point.value, study_smoothing)),
        phases_(recording_phases(model_, recording.output_phases).s) {}

  void run() {
    if (out_.study.outcome != integrate::Outcome::reached) {
      out_.note = "the study's own integrator has no answer: " + out_.study.message;
      return;
    }
    if (find_reference()) {
      climb();
      smooth();
      for (std::size_t k = 0; k < quantity_names.size(); ++k) extrapolate(out_, k);
      return;
    }
    if (!has_classification(model_)) {
      out_.note += "; no statistics either: forces jump at contact, and there are no tangents for an exponent";
      return;
    }
    out_.note += "; statistics in place of an orbit";
    if (out_.study.regime == analysis::Regime::undecided)
      out_.note +=
          ", of a response that may not have reached its attractor: their intervals state how they vary, not their "
          "limits";
    gather();
  }

 private:
  [[nodiscard]] std::unique_ptr<integrate::Flow> flow(const integrate::IntegratorOptions& o,
                                                      const model::DynamicModel& model) const {
    return integrate::make_flow(model, o);
  }
  [[nodiscard]] integrate::IntegratorOptions reference_options(const char* method) const {
    return with(integrator_, method, options_.reference_tolerance, options_.reference_tolerance);
  }
  /// Absolute tolerance in the study's ratio to the relative one.
  [[nodiscard]] integrate::IntegratorOptions step_options(const std::string& method, double tolerance) const {
    return with(integrator_, method, tolerance,
                tolerance * integrator_.absolute_tolerance / integrator_.relative_tolerance);
  }

  bool find_reference() {
    const auto reference = flow(reference_options(reference_method), model_);
    ConvergedOrbit converged = converged_orbit(*reference, out_.study);
    out_.note = converged.note;
    if (converged.period == 0) return false;
    const int n = out_.period = converged.period;
    known_ = std::move(converged.orbit);
    out_.distance_from_orbit = converged.distance;
    out_.largest_multiplier = converged.largest_multiplier;
    out_.orbit = known_.state;
    out_.reference_residual = *std::min_element(known_.residuals.begin(), known_.residuals.end());
    out_.reference = quantities_of(*reference, model_, known_.state, n, phases_);
    const Quantities finer = quantities_of(*reference, model_, known_.state, n,
                                           recording_phases(model_, recording_.output_phases, finer_phases).s);
    for (std::size_t k = 0; k < finer.size(); ++k) out_.between_phases[k] = finer[k] - out_.reference[k];
    end_ = known_.state;
    (void)advance(*reference, end_, n);
    const auto second = flow(reference_options(second_method), model_);
    const std::vector<double> other = analysis::displaced_orbit(*second, known_, n, 2);
    const Quantities again = other.empty() ? all_nan() : quantities_of(*second, model_, other, n, phases_);
    for (std::size_t k = 0; k < again.size(); ++k) out_.reference_error[k] = std::abs(again[k] - out_.reference[k]);
    if (model_.with_halved_tables) measure_tables();
    return true;
  }

  void measure_tables() {
    const model::DynamicModel halved = model_.with_halved_tables();
    const auto reference = flow(reference_options(reference_method), halved);
    const std::vector<double> moved = analysis::displaced_orbit(*reference, known_, out_.period, 2);
    const Quantities there = moved.empty() ? all_nan() : quantities_of(*reference, halved, moved, out_.period, phases_);
    for (std::size_t k = 0; k < there.size(); ++k) out_.table_error[k] = std::abs(there[k] - out_.reference[k]);
    out_.table_displacement = moved.empty() ? nan : largest_difference(moved, known_.state);
  }

  void climb() {
    const std::size_t tolerances = options_.tolerances.size();
    out_.ladder.resize(options_.methods.size() * tolerances);
    parallel_for(out_.ladder.size(), threads_, stop_, [&](std::size_t unit) {
      LadderStep& step = out_.ladder[unit];
      step.method = options_.methods[unit / tolerances];
      step.tolerance = options_.tolerances[unit % tolerances];
      step.seconds = std::numeric_limits<double>::infinity();
      step.error = step.orbit_error = nan;
      step.quantities = all_nan();
      const auto own = flow(step_options(step.method, step.tolerance), model_);
      constexpr int repeats = 3;
      for (int r = 0; r < repeats; ++r) {
        std::vector<double> y = known_.state;
        const integrate::Work before = own->work();
        const auto start = std::chrono::steady_clock::now();
        const integrate::Evolution e = advance(*own, y, out_.period);
        step.seconds = std::min(step.seconds, seconds_since(start));
        step.work = difference(own->work(), before);
        step.outcome = e.outcome;
        if (!e.reached()) return;
        step.error = largest_difference(y, end_);
      }
      const std::vector<double> orbit = analysis::displaced_orbit(*own, known_, out_.period, 2);
      if (orbit.empty()) return;
      const double distance = largest_difference(orbit, known_.state);
      constexpr double another_orbit = 1.0;
      if (!(distance < another_orbit)) return;
      step.orbit_error = distance;
      step.quantities = quantities_of(*own, model_, orbit, out_.period, phases_);
    });
  }

  void smooth() {
    {
      const auto own = flow(integrator_, model_);
      std::vector<double> y = known_.state;
      (void)advance(*own, y, out_.period);
      out_.study_work = own->work();
    }
    out_.smoothing.resize(options_.clearance_smoothings.size());
    // The orbit with exact clearance, which is the reference's unless the study itself is smoothed.
    std::vector<double> exact = known_.state;
    if (study_smoothing_ != 0.0) {
      const model::DynamicModel model = model_at_(out_.point.value, 0.0);
      const auto sharp = flow(reference_options(reference_method), model);
      const analysis::PeriodicOrbit orbit = analysis::find_periodic_orbit(*sharp, known_.state, out_.period);
      if (orbit.found()) exact = orbit.state;
    }
    parallel_for(out_.smoothing.size(), threads_, stop_, [&](std::size_t unit) {
      SmoothingStep& step = out_.smoothing[unit];
      step.width = options_.clearance_smoothings[unit];
      step.distance = nan;
      step.quantities = all_nan();
      const model::DynamicModel model = model_at_(out_.point.value, step.width);
      constexpr double fine = 1e-12;
      const auto tight = flow(with(integrator_, reference_method, fine, fine), model);
      const analysis::PeriodicOrbit orbit =
          analysis::find_periodic_orbit(*tight, known_.state, out_.period, {.iterations = 20, .residual = 1e-10});
      if (!orbit.found()) return;
      step.found = true;
      step.distance = largest_difference(orbit.state, exact);
      step.quantities = quantities_of(*tight, model, orbit.state, out_.period, phases_);
      const auto own = flow(integrator_, model);
      std::vector<double> y = orbit.state;
      (void)advance(*own, y, out_.period);
      step.work = own->work();
    });
  }

  void gather() {
    const auto add = [&](const std::string& method, double tolerance, double width) {
      for (const StatisticsStep& s : out_.statistics)
        if (s.method == method && s.tolerance == tolerance && s.width == width) return;
      StatisticsStep step;
      step.method = method;
      step.tolerance = tolerance;
      step.width = width;
      out_.statistics.push_back(std::move(step));
    };
    // Chaos forgets its start within some hundred periods: a finer tolerance than this gives other numbers, not better
    // ones.
    constexpr double fine = 1e-10;
    add(reference_method, fine, study_smoothing_);
    for (const double tolerance : options_.tolerances)
      if (tolerance >= fine) add(integrator_.method, tolerance, study_smoothing_);
    for (const std::string& method : options_.methods) add(method, integrator_.relative_tolerance, study_smoothing_);
    for (const double width : options_.clearance_smoothings)
      add(integrator_.method, integrator_.relative_tolerance, width);

    parallel_for(out_.statistics.size(), threads_, stop_, [&](std::size_t unit) {
      StatisticsStep& step = out_.statistics[unit];
      const model::DynamicModel model = model_at_(out_.point.value, step.width);
      const auto own = flow(step_options(step.method, step.tolerance), model);
      std::vector<double> y = out_.study.end_state;
      std::array<std::vector<double>, 2> series;
      model::MeshDeflections d;
      const analysis::LargestExponent e = analysis::largest_exponent(
          *own, y, {aligning_periods, options_.chaotic_periods},
          [&](std::size_t, double, std::span<const double> at) {
            model.deflections(0.0, at.data(), d);
            series[0].push_back(d.sun_planet[0]);
            series[1].push_back(d.ring_planet[0]);
          },
          [&] { return stop_ == nullptr || !stop_->load(); });
      step.outcome = e.evolution.outcome;
      step.right_hand_sides = own->right_hand_side_calls();
      if (!e.evolution.reached() || series[0].empty()) return;
      step.exponent = e.per_s * model.omega;
      for (std::size_t k = 0; k < series.size(); ++k) {
        step.mean[k] = analysis::series_mean(series[k]);
        step.deviation[k] = analysis::series_deviation(series[k]);
      }
    });
  }

  TolerancePoint& out_;
  const RecordingOptions& recording_;
  const ToleranceOptions& options_;
  const integrate::IntegratorOptions& integrator_;
  double study_smoothing_;
  const SmoothedModelAt& model_at_;
  int threads_;
  const std::atomic<bool>* stop_;
  model::DynamicModel model_;
  std::vector<double> phases_;  ///< of a mesh period at which the study records
  analysis::PeriodicOrbit known_;
  std::vector<double> end_;  ///< of the reference after one orbit: y* up to the shooting's residual
};

}  // namespace

double cost(const integrate::Work& work, std::size_t dimension) {
  return static_cast<double>(work.right_hand_sides) +
         static_cast<double>(work.jacobians) * static_cast<double>(dimension);
}

std::array<analysis::Estimate, statistics_names.size()> statistics_of(const StatisticsStep& step) {
  return {step.exponent, step.mean[0], step.mean[1], step.deviation[0], step.deviation[1]};
}

std::vector<std::size_t> differing_statistics(const StatisticsStep& a, const StatisticsStep& b) {
  std::vector<std::size_t> differing;
  const auto ours = statistics_of(a);
  const auto theirs = statistics_of(b);
  for (std::size_t k = 0; k < ours.size(); ++k)
    if (!analysis::overlap(ours[k], theirs[k])) differing.push_back(k);
  return differing;
}

bool statistics_agree(const StatisticsStep& a, const StatisticsStep& b) {
  return a.outcome == integrate::Outcome::reached && b.outcome == integrate::Outcome::reached &&
         differing_statistics(a, b).empty();
}

std::vector<Slopes> slopes(const std::vector<TolerancePoint>& points, std::size_t dimension, double floor) {
  constexpr double ceiling = 1e-2;
  struct Lines {
    PooledSlope over_tolerance, over_cost;
  };
  std::vector<Slopes> all;
  std::map<std::string, Lines> lines;
  for (const TolerancePoint& p : points) {
    struct Logarithms {
      std::vector<double> tolerance, cost, error;
    };
    std::map<std::string, Logarithms> own;
    for (const LadderStep& s : p.ladder) {
      if (lines.try_emplace(s.method).second) all.push_back({s.method, nan, nan, 0});
      if (!(s.error > floor && s.error < ceiling)) continue;
      Logarithms& l = own[s.method];
      l.tolerance.push_back(std::log(s.tolerance));
      l.cost.push_back(std::log(cost(s.work, dimension)));
      l.error.push_back(std::log(s.error));
    }
    // Points differ in level, not in slope.
    for (const auto& [method, l] : own) {
      lines[method].over_tolerance.add(l.tolerance, l.error);
      lines[method].over_cost.add(l.cost, l.error);
    }
  }
  for (Slopes& one : all) {
    const Lines& l = lines[one.method];
    one.over_tolerance = l.over_tolerance.slope();
    one.over_cost = l.over_cost.slope();
    one.steps = static_cast<int>(l.over_cost.points());
  }
  return all;
}

std::optional<Recommendation> recommend(const std::vector<TolerancePoint>& points, std::size_t dimension,
                                        double target) {
  struct Sum {
    double cost = 0;
    double error = 0;
    std::size_t points = 0;
  };
  std::map<std::pair<std::string, double>, Sum> sums;
  std::map<double, Sum, std::greater<>> widths;  // widest first
  double study_cost = 0.0;
  std::size_t periodic = 0;
  for (const TolerancePoint& p : points) {
    if (p.period == 0) continue;
    ++periodic;
    study_cost += cost(p.study_work, dimension) / p.period;
    for (const LadderStep& s : p.ladder) {
      if (!(s.orbit_error <= target)) continue;
      Sum& sum = sums[{s.method, s.tolerance}];
      sum.cost += cost(s.work, dimension) / p.period;
      sum.error = std::max(sum.error, s.orbit_error);
      ++sum.points;
    }
    for (const SmoothingStep& s : p.smoothing) {
      if (!(s.found && s.distance <= target)) continue;
      Sum& sum = widths[s.width];
      sum.cost += cost(s.work, dimension) / p.period;
      ++sum.points;
    }
  }
  std::optional<Recommendation> best;
  for (const auto& [key, sum] : sums) {
    if (sum.points < periodic) continue;
    const double mean = sum.cost / static_cast<double>(periodic);
    if (!best || mean < best->cost_per_period)
      best = Recommendation{key.first, key.second, mean, sum.error, false, 0.0, 0.0};
  }
  if (!best) return best;
  for (const auto& [width, sum] : widths) {
    if (sum.points < periodic || sum.cost >= study_cost || best->smoothing_pays) continue;
    best->smoothing_pays = true;
    best->width = width;
    best->saved = 1.0 - sum.cost / study_cost;
  }
  return best;
}

TolerancePoint compute_tolerance_point(const PointResult& study, const RecordingOptions& recording,
                                       const ToleranceOptions& options, const integrate::IntegratorOptions& integrator,
                                       double study_smoothing, const SmoothedModelAt& model_at, int threads,
                                       const std::atomic<bool>* stop) {
  recording.validate();
  options.validate();
  TolerancePoint point;
  point.point = study.point;
  point.study = study;
  point.extrapolated = point.exponent = all_nan();
  PointStudy(point, recording, options, integrator, study_smoothing, model_at, threads, stop).run();
  return point;
}

}  // namespace epicyclic::studies
