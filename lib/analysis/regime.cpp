#include "analysis/regime.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "analysis/lyapunov.hpp"
#include "analysis/zero_one_test.hpp"
#include "core/errors.hpp"
#include "core/largest_difference.hpp"
#include "core/text.hpp"

namespace epicyclic::analysis {

namespace {

/// Votes of the 0-1 test. Between them it abstains.
constexpr double regular_vote = 0.3;
constexpr double chaotic_vote = 0.5;
constexpr int least_look = 16;
/// Periods that an exponent's interval needs; the 0-1 test needs twice as many, and takes the look before along.
constexpr int growth_look = 128;
/// A recurrence error up to this part of the extent is that of a motion all but on its orbit.
constexpr double settled = 0.01;
/// Periods whose recurrence errors are this near recur alike: the shortest is sought.
constexpr double alike = 10.0;
/// A found orbit's residual is at most this part of the motion's own recurrence error, or so many times what was asked:
/// kinks make an integrator's map rough.
constexpr double least_gain = 0.1;
constexpr double rough_map = 30.0;
/// With a multiplier's error above this part of its distance from 1, tangents of the orbit's own are worth their price.
constexpr double own_tangents = 0.1;
/// An orbit that was sought in vain is sought again when the motion has come nearer to it by this factor.
constexpr double nearer = 0.5;
/// Looked at for each period of an orbit that is sought: all attempts together then cost about as much as the looks.
constexpr int periods_per_orbit = 256;
/// Periods over which e^2 is told from a small exponent.
constexpr int torus_look = 1024;

void check(const integrate::Flow& flow, const RegimeOptions& o) {
  if (!(flow.field().period > 0.0)) throw DomainError("regimes are told of fields with a period");
  if (o.look < least_look) throw DomainError("look = " + std::to_string(o.look) + ", must be >= 16");
  if (o.budget < o.look) throw DomainError("budget = " + std::to_string(o.budget) + ", must be >= look");
  if (o.longest_period < 1) throw DomainError("longest_period must be >= 1");
  if (o.observable >= flow.field().dimension) throw DomainError("observable is not a component of the state");
}

class Classifier {
 public:
  Classifier(integrate::Flow& flow, std::span<double> state, const RegimeOptions& options,
             const std::function<bool()>& go_on)
      : flow_(flow), state_(state), options_(options), go_on_(go_on) {}

  Classification run(const PoincareSection* before) {
    check(flow_, options_);
    Evidence& seen = result_.evidence;
    int first = options_.look;
    if (before != nullptr && before->size() > 0) {
      section_ = *before;
      for (std::size_t k = 0; k < section_.size(); ++k) series_.push_back(section_.point(k)[options_.observable]);
      look_before_ = 0;
      first_ = static_cast<int>(section_.size());
      find_recurrence();
      // What does not nearly recur is most likely chaotic, which growth tells for less than Newton's method fails.
      if (is_periodic(settled)) return std::move(result_);
      // As long a look as growth can be told from.
      first = std::max(first, growth_look);
    }
    for (int look = first;; look *= 2) {
      look = std::min(look, options_.budget - seen.periods);
      if (look < least_look) break;
      if (!record(look)) return std::move(result_);
      if (is_chaotic() || is_periodic(options_.near)) return std::move(result_);
      if (!go_on_()) break;
      if (is_torus()) return std::move(result_);
      // Where vectors neither grow nor shrink, no look tells anything that is not long.
      if (std::abs(seen.late_growth) <= neutral_growth && growth_.size() >= growth_look)
        look = std::max(look, (torus_look - static_cast<int>(growth_.size())) / 2);
    }
    result_.regime = Regime::undecided;
    if (seen.note.empty()) seen.note = "nothing is proven";
    seen.note += " after " + std::to_string(seen.periods) + " periods";
    return std::move(result_);
  }

 private:
  /// One look: the state, a tangent vector and the section.
  bool record(int periods) {
    section_ = {};
    section_.dimension = state_.size();
    // The look before goes along: it is of the same motion.
    series_.erase(series_.begin(), series_.begin() + static_cast<std::ptrdiff_t>(look_before_));
    look_before_ = series_.size();
    result_.evidence.note.clear();
    LyapunovOptions options;
    options.aligning_periods = 0;
    options.periods = periods;
    LargestExponent e = largest_exponent(
        flow_, state_, options,
        [&](std::size_t, double, std::span<const double> y) {
          section_.states.insert(section_.states.end(), y.begin(), y.end());
          series_.push_back(y[options_.observable]);
        },
        go_on_);
    result_.evolution = e.evolution;
    result_.evidence.periods += static_cast<int>(e.growth.size());
    growth_.insert(growth_.end(), e.growth.begin(), e.growth.end());
    result_.evidence.late_growth = late_growth(e.growth);
    if (!result_.evolution.reached() || e.growth.size() < static_cast<std::size_t>(periods)) return false;
    // Orbits are told from where the motion is now, not from where a long look began.
    section_.keep_last(growth_look);
    find_recurrence();
    return true;
  }

  void find_recurrence() {
    scale_ = std::numeric_limits<double>::min();
    for (const double x : section_.states) scale_ = std::max(scale_, std::abs(x));
    result_.evidence.recurrence = recurrence(section_, options_.longest_period, options_.residual * scale_);
  }

  /// What an integrator may leave of an orbit.
  [[nodiscard]] double noise() const { return 1e3 * options_.residual * scale_; }

  /// @param part  of the section's extent, up to which a recurrence error makes a candidate
  bool is_periodic(double part) {
    const Recurrence& r = result_.evidence.recurrence;
    // What nearly recurs is tried, and where nothing moves much everything nearly recurs.
    const double wide = extent(section_);
    const double near = wide <= options_.near * scale_ ? wide : part * wide;
    if (r.period == 0 && !(r.error <= near)) return false;
    const auto shortest = [&](double error) {
      int n = 1;
      while (n < r.best_period && recurrence_error(section_, static_cast<std::size_t>(n)) > error) ++n;
      return n;
    };
    if (r.period > 0) return settles_to_orbit_of(r.period);
    // None is sought that costs more than the looks so far, unless the motion is all but on it. Beside a torus many
    // long ones nearly close, and the short one in its middle is no candidate twice.
    const int affordable = std::max(1, (first_ + result_.evidence.periods) / periods_per_orbit);
    const int n = shortest(alike * r.error);
    if (r.error <= settled * wide) {
      const int closed = shortest(settled * wide);
      const int early = shortest(options_.near * wide);
      return (early < closed && early <= affordable && settles_to_orbit_of(early)) || settles_to_orbit_of(closed) ||
             (n > closed && settles_to_orbit_of(n));
    }
    // Shorter ones come first: an orbit of period 1 recurs after 2.
    for (int d = 1; d <= std::min(n, affordable); ++d)
      if (n % d == 0 && settles_to_orbit_of(d)) return true;
    return false;
  }

  bool settles_to_orbit_of(int n) {
    Evidence& seen = result_.evidence;
    const auto vain = in_vain_.try_emplace(n, std::numeric_limits<double>::infinity()).first;
    const double distance_now = recurrence_error(section_, static_cast<std::size_t>(n));
    if (distance_now > nearer * vain->second) return false;
    const auto last = section_.point(section_.size() - 1);
    OrbitOptions o;
    o.residual = options_.residual * scale_;
    o.keep_tangents = true;
    o.iterations = 6;  // what attracts is near and found in three
    integrate::Flow& exact = options_.exact == nullptr ? flow_ : *options_.exact;
    PeriodicOrbit orbit = find_periodic_orbit(exact, last, n, o);
    // On a torus, too, the motion comes back after n periods, and Newton's method gains nothing on that.
    const auto gains = [&] {
      const double residual = *std::min_element(orbit.residuals.begin(), orbit.residuals.end());
      return residual <= std::max(least_gain * distance_now, rough_map * o.residual);
    };
    if (!orbit.found() || !gains()) {
      flow_.forget();
      vain->second = distance_now;
      return false;
    }
    if (const int least = least_period(exact, orbit.state, n); least < n) {
      if (settles_to_orbit_of(least)) return true;
      if (std::isfinite(in_vain_[least])) vain->second = distance_now;
      return false;
    }
    // n + 1 pieces end within periods: other steps of the integrator all along.
    integrate::Flow& other = options_.coarser == nullptr ? exact : *options_.coarser;
    const int pieces = options_.coarser == nullptr ? n + 1 : 1;
    const PeriodicOrbit second = find_periodic_orbit(other, orbit.state, n, {.iterations = 1, .pieces = pieces});
    flow_.forget();
    if (second.pieces.empty()) return false;
    const auto multipliers_of = [&](const PeriodicOrbit& first) {
      const Multipliers m = floquet_multipliers(first, second);
      return std::pair{std::abs(m.values.front()), *std::max_element(m.errors.begin(), m.errors.end())};
    };
    auto [multiplier, error] = multipliers_of(orbit);
    if (error > own_tangents * std::abs(1.0 - multiplier)) {
      // The tangents that Newton's method kept are too far from the orbit.
      PeriodicOrbit own = find_periodic_orbit(exact, orbit.state, n, {.iterations = 1});
      if (!own.pieces.empty()) orbit = std::move(own);
      std::tie(multiplier, error) = multipliers_of(orbit);
    }
    const std::string name = "orbit of period " + std::to_string(n);
    if (!(multiplier + error < 1.0 - options_.neutral)) {
      seen.note = "the " + name + " near by does not attract (multiplier " + short_text(multiplier) + " +- " +
                  short_text(error) + ")";
      if (multiplier - error > 1.0) vain->second = distance_now;
      return false;
    }
    // [A-settled], by the flow that the orbit belongs to: looks may be rougher.
    std::vector<double> onwards(last.begin(), last.end());
    exact.forget();
    for (int k = 0; k < n; ++k)
      if (!exact.evolve(onwards, 0.0, exact.field().period).reached()) return false;
    Eigen::VectorXd from(static_cast<Eigen::Index>(last.size()));
    Eigen::VectorXd to(from.size());
    for (std::size_t i = 0; i < last.size(); ++i) {
      from(static_cast<Eigen::Index>(i)) = last[i] - orbit.state[i];
      to(static_cast<Eigen::Index>(i)) = onwards[i] - orbit.state[i];
    }
    const double distance = from.lpNorm<Eigen::Infinity>();
    const double off = (to - orbit.monodromy * from).lpNorm<Eigen::Infinity>();
    if (off > 0.1 * distance && off > noise()) {
      seen.note = "not yet drawn to the " + name + " that is " + short_text(distance) + " away";
      return false;
    }
    result_.regime = Regime::periodic;
    result_.period = n;
    seen.residual = *std::min_element(orbit.residuals.begin(), orbit.residuals.end());
    seen.largest_multiplier = multiplier;
    seen.multiplier_error = error;
    // Of a multiplier that is nothing but error, the logarithm says no more than that.
    const double time = n * flow_.field().period;
    seen.exponent = {std::log(multiplier) / time, std::log1p(error / multiplier) / time};
    seen.zero_one.reset();
    seen.note = "drawn to the " + name + " from " + short_text(distance) + " away";
    result_.orbit = std::move(orbit);
    return true;
  }

  /// The least divisor d of n after which an orbit closes: one of period 1 is one of period 12, too.
  int least_period(integrate::Flow& flow, const std::vector<double>& orbit, int n) {
    std::vector<double> y = orbit;
    flow.forget();
    for (int d = 1; d < n; ++d) {
      if (!flow.evolve(y, 0.0, flow.field().period).reached()) break;
      if (n % d == 0 && largest_difference(y, orbit) <= noise()) return d;
    }
    return n;
  }

  bool is_chaotic() {
    Evidence& seen = result_.evidence;
    // The first quarter is left to the vector's turning and to what is left of the transient.
    const std::span<const double> counted = std::span(growth_).subspan(growth_.size() / 4);
    seen.exponent = series_mean(counted) / flow_.field().period;
    seen.zero_one.reset();
    if (series_.size() < 2 * static_cast<std::size_t>(growth_look)) return false;
    const double k = zero_one_test(series_, noise());
    seen.zero_one = k;
    const bool grows = seen.exponent.low() > 0.0 && seen.late_growth > neutral_growth;
    const bool clearly = seen.exponent.value > 3.0 * seen.exponent.half_width;
    const bool votes = k > chaotic_vote;
    const bool abstains = k > regular_vote;
    if (!grows) return false;
    if (!votes && !(clearly && seen.late_growth > (abstains ? 4.0 : 8.0) * neutral_growth)) return false;
    result_.regime = Regime::chaotic;
    seen.note = "exponent positive by its interval, 0-1 test " + short_text(k);
    return true;
  }

  bool is_torus() {
    Evidence& seen = result_.evidence;
    // What is drawn to an orbit slowly shrinks for long before it recurs.
    const bool settles = seen.exponent.value + 3.0 * seen.exponent.half_width < 0.0;
    if (growth_.size() >= static_cast<std::size_t>(torus_look) && std::abs(late_growth(growth_)) <= neutral_growth &&
        !settles && seen.zero_one && *seen.zero_one < regular_vote) {
      result_.regime = Regime::quasiperiodic;
      seen.note = "tangents neither grow nor shrink, 0-1 test " + short_text(*seen.zero_one);
      return true;
    }
    if (seen.note.empty())
      seen.note = "exponent " + short_text(seen.exponent.value) + " +- " + short_text(seen.exponent.half_width) +
                  " per radian of the phase, " +
                  (seen.zero_one ? "0-1 test " + short_text(*seen.zero_one) : "too few periods for a 0-1 test");
    return false;
  }

  integrate::Flow& flow_;
  std::span<double> state_;
  const RegimeOptions& options_;
  const std::function<bool()>& go_on_;
  Classification result_;
  PoincareSection section_;
  int first_ = 0;                  ///< periods of the section that was seen before
  double scale_ = 0;               ///< largest component of the section
  std::map<int, double> in_vain_;  ///< recurrence error after n periods when an orbit of period n was sought in vain
  std::vector<double> growth_;     ///< g_k of all looks
  std::vector<double> series_;     ///< the observable over the look before and this one
  std::size_t look_before_ = 0;    ///< how many of them are of the look before
};

}  // namespace

std::string to_string(Regime regime) {
  switch (regime) {
    case Regime::periodic:
      return "periodic";
    case Regime::quasiperiodic:
      return "quasiperiodic";
    case Regime::chaotic:
      return "chaotic";
    case Regime::undecided:
      break;
  }
  return "undecided";
}

Classification classify(integrate::Flow& flow, std::span<double> state, const RegimeOptions& options,
                        const std::function<bool()>& go_on, const PoincareSection* seen) {
  return Classifier(flow, state, options, go_on).run(seen);
}

}  // namespace epicyclic::analysis
