#include "analysis/regime.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "analysis/lyapunov.hpp"
#include "analysis/zero_one_test.hpp"
#include "core/errors.hpp"
#include "core/largest_difference.hpp"
#include "core/require.hpp"
#include "core/text.hpp"

namespace epicyclic::analysis {

namespace {

constexpr int least_window = 16;
/// Periods that an exponent's interval needs. The 0-1 test needs twice as many and uses the window before as well.
constexpr int growth_window = 128;
/// A recurrence error up to this part of the extent counts as that of a trajectory almost on its orbit.
constexpr double converged = 0.01;
/// Periods whose recurrence errors differ by less than this factor recur equally well: the shortest is tested.
constexpr double alike = 10.0;
/// The residual of an orbit is at most this part of the trajectory's own recurrence error, or this multiple of the
/// requested residual. Kinks make the map of an integrator rough.
constexpr double least_gain = 0.1;
constexpr double rough_map = 30.0;
/// If a multiplier's error is above this part of its distance from 1, the orbit's own tangents are computed.
constexpr double own_tangents = 0.1;
/// A failed search for an orbit is repeated when the recurrence error has fallen by this factor.
constexpr double nearer = 0.5;
/// Periods of windows for each period of an orbit that is searched: all searches together then cost about as much as
/// the windows.
constexpr int periods_per_orbit = 256;
/// Of the largest component, off something that repels: no attractor's basin is as narrow, and growth by e^7 shows it.
constexpr double push = 1e-3;
/// Growth is even if its interval is at most this part of it: in weak chaos vectors shrink and grow.
constexpr double even_part = 0.1;
/// Growth is slow if it is less than this in as many periods as the 0-1 test needs.
constexpr double slow_growth = 4.0 * neutral_growth;
/// Periods over which a growth of e^2 differs from a small exponent.
constexpr int torus_window = 1024;
/// Periods at one tolerance without growth of vectors, before a tighter tolerance is requested.
constexpr int periods_at_one_tolerance = 1024;
/// Periods from which on growth and the 0-1 test contradict each other: over fewer the test abstains or errs.
constexpr std::size_t contradiction_window = 512;
/// No flow resolves an orbit better than this, in parts of its largest component.
constexpr double least_residual = 1e-9;
/// A trajectory is a transient if its return error falls by this factor from each quarter of a window to the next.
constexpr double falling = 0.75;
/// The rotation along a torus is nowhere slower than this part of the fastest.
constexpr double least_rotation_rate = 0.01;
/// Within this factor two distances from an orbit count as equal: the slowest multipliers change the distance by less.
constexpr double as_near = 1.01;
/// Returns over which a trajectory is followed until it is as near again, and over which its monodromy predicts it.
constexpr int most_returns = 16;
constexpr int foreseen_returns = 256;

void check(const integrate::Flow& flow, const RegimeOptions& o) {
  (void)period_of(flow.field());
  o.validate();
  require(o.observable < flow.field().dimension, "observable", static_cast<double>(o.observable),
          "a component of the state");
}

class Classifier {
 public:
  Classifier(integrate::Flow& flow, std::span<double> state, const RegimeOptions& options,
             const std::function<bool()>& go_on)
      : options_(options),
        go_on_(go_on),
        state_(state),
        flow_(&flow),
        exact_(options.exact == nullptr ? &flow : options.exact),
        coarser_(options.coarser == nullptr ? exact_ : options.coarser),
        loose_(&flow),
        tight_(options.tight == nullptr ? &flow : options.tight),
        residual_(options.residual) {}

  Classification run(const PoincareSection* before) {
    check(*flow_, options_);
    Evidence& seen = result_.evidence;
    int first = options_.window;
    if (before != nullptr && before->size() > 0) {
      section_ = *before;
      for (std::size_t k = 0; k < section_.size(); ++k) series_.push_back(section_.point(k)[options_.observable]);
      previous_window_ = 0;
      first_ = static_cast<int>(section_.size());
      find_recurrence();
      // A trajectory without near recurrence is most likely chaotic. Growth shows that at a lower cost than a failure
      // of Newton's method.
      if (is_periodic(converged)) return std::move(result_);
      // As long a window as the test of growth needs.
      first = std::max(first, growth_window);
    } else {
      use_tight_tolerance();
    }
    for (int window = first;;) {
      window = std::min(window, options_.budget - seen.periods);
      if (window < least_window) break;
      const std::vector<double> start(state_.begin(), state_.end());
      if (!record(window)) return std::move(result_);
      contradicts_ = false;
      if (!grows() && use_tight_tolerance()) {
        // A trajectory without growth depends on its initial state. A window at the loose tolerance may have led it to
        // another attractor.
        std::copy(start.begin(), start.end(), state_.begin());
        continue;
      }
      // A long window may end on an orbit that it began far from.
      if (is_periodic(converged)) return std::move(result_);
      if (is_chaotic()) {
        if (outlasts()) return std::move(result_);
      } else if (is_periodic(options_.near)) {
        return std::move(result_);
      }
      if (!go_on_()) break;
      if (is_torus()) return std::move(result_);
      leave_what_repels();
      if (contradicts_ && growth_.size() >= contradiction_window && grows_weakly()) {
        use_tight_tolerance();
        returned_ = true;
      } else if (seen.late_growth > 4.0 * neutral_growth) {
        use_loose_tolerance();
      }
      if ((contradicts_ || !grows()) && level_periods_ >= periods_at_one_tolerance) tighten();
      window *= 2;
      // If vectors neither grow nor shrink, only a long window decides.
      if (std::abs(seen.late_growth) <= neutral_growth && growth_.size() >= growth_window)
        window = std::max(window, torus_window - static_cast<int>(growth_.size()));
    }
    result_.regime = Regime::undecided;
    if (seen.note.empty()) seen.note = "nothing is proven";
    seen.note += " after " + std::to_string(seen.periods) + " periods";
    if (!indistinct_.empty())
      seen.note += "; too near to an orbit of period " + std::to_string(*indistinct_.begin()) +
                   " to be distinguished from it: a bifurcation is near, and tighter tolerances can decide";
    return std::move(result_);
  }

 private:
  /// Did tangent vectors grow over the last window? Then the trajectory is a matter of chance in the end, and a looser
  /// tolerance is as good.
  [[nodiscard]] bool grows() const { return result_.evidence.late_growth > neutral_growth; }

  /// Windows use the tolerance of orbits from here on.
  /// @returns false if they already do
  bool use_tight_tolerance() {
    if (flow_ == tight_) return false;
    flow_ = tight_;
    forget_windows();
    return true;
  }

  /// Windows with growth use the looser tolerance, once. After a return from there they keep the tighter one.
  void use_loose_tolerance() {
    if (flow_ == loose_ || returned_) return;
    returned_ = true;
    flow_ = loose_;
    forget_windows();
  }

  /// The next tighter tolerance for all, if there is one.
  void tighten() {
    if (!options_.tighter) return;
    const std::optional<FlowsOfTolerance> next = options_.tighter();
    if (!next) return;
    constexpr double by = 0.01;
    flow_ = tight_ = next->windows;
    exact_ = next->exact;
    coarser_ = next->coarser;
    residual_ = std::max(by * residual_, std::min(residual_, least_residual));
    returned_ = true;
    in_vain_.clear();
    indistinct_.clear();
    level_periods_ = 0;
  }

  /// Growth and section of another flow do not count for this one.
  void forget_windows() {
    growth_.clear();
    series_.clear();
    previous_window_ = 0;
    level_periods_ = 0;
    if (left_at_) left_at_ = 0;
  }

  /// One window: the state, a tangent vector and the section.
  bool record(int periods) {
    section_ = {};
    section_.dimension = state_.size();
    // The series keeps the window before: it is of the same trajectory.
    series_.erase(series_.begin(), series_.begin() + static_cast<std::ptrdiff_t>(previous_window_));
    previous_window_ = series_.size();
    if (flow_ == exact_) flow_->forget();  // orbits have been sought with it since
    result_.evidence.note.clear();
    LyapunovOptions options;
    options.aligning_periods = 0;
    options.periods = periods;
    LargestExponent e = largest_exponent(
        *flow_, state_, options,
        [&](std::size_t, double, std::span<const double> y) {
          section_.states.insert(section_.states.end(), y.begin(), y.end());
          series_.push_back(y[options_.observable]);
        },
        go_on_);
    result_.evolution = e.evolution;
    result_.evidence.periods += static_cast<int>(e.growth.size());
    level_periods_ += static_cast<int>(e.growth.size());
    growth_.insert(growth_.end(), e.growth.begin(), e.growth.end());
    result_.evidence.late_growth = late_growth(e.growth);
    direction_ = std::move(e.direction);
    if (!result_.evolution.reached() || e.growth.size() < static_cast<std::size_t>(periods)) return false;
    whole_window_ = section_;
    // Orbits are tested at the current state of the trajectory, not at the beginning of a long window.
    section_.keep_last(growth_window);
    find_recurrence();
    return true;
  }

  void find_recurrence() {
    scale_ = std::numeric_limits<double>::min();
    for (const double x : section_.states) scale_ = std::max(scale_, std::abs(x));
    result_.evidence.recurrence = recurrence(section_, options_.longest_period, residual_ * scale_);
  }

  /// What an integrator may leave of an orbit.
  [[nodiscard]] double noise() const { return 1e3 * residual_ * scale_; }

  /// @param part  of the section's extent, up to which a recurrence error makes a candidate
  bool is_periodic(double part) {
    const Recurrence& r = result_.evidence.recurrence;
    const double wide = extent(section_);
    const double near = near_enough(part);
    if (r.period == 0 && !(r.error <= near)) return false;
    const auto shortest = [&](double error) {
      int n = 1;
      while (n < r.best_period && recurrence_error(section_, static_cast<std::size_t>(n)) > error) ++n;
      return n;
    };
    if (r.period > 0) return converges_to_orbit_of(r.period);
    // No search may cost more than the windows so far, unless the trajectory is almost on the orbit. Beside a torus
    // many long periods nearly close, and the short period in its middle is no candidate twice.
    const int affordable = std::max(1, (first_ + result_.evidence.periods) / periods_per_orbit);
    const int n = shortest(alike * r.error);
    if (r.error <= converged * wide) {
      const int closed = shortest(converged * wide);
      const int early = shortest(options_.near * wide);
      if ((early < closed && early <= affordable && converges_to_orbit_of(early)) || converges_to_orbit_of(closed) ||
          (n > closed && converges_to_orbit_of(n)))
        return true;
      // About an orbit next to a period doubling (flip) the distance oscillates: the trajectory recurs after twice the
      // orbit's period.
      for (int d = n / 2; d >= 1; --d)
        if (n % d == 0 && converges_to_orbit_of(d)) return true;
      return false;
    }
    // Shorter ones come first: an orbit of period 1 recurs after 2.
    for (int d = 1; d <= std::min(n, affordable); ++d)
      if (n % d == 0 && converges_to_orbit_of(d)) return true;
    return false;
  }

  /// The recurrence error up to which what nearly recurs is tried, for a part of the section's extent; where nothing
  /// moves much everything nearly recurs.
  [[nodiscard]] double near_enough(double part) const {
    const double wide = extent(section_);
    return wide <= options_.near * scale_ ? wide : part * wide;
  }

  /// What an integrator leaves of a residual.
  [[nodiscard]] double map_residual() const { return residual_ * scale_; }

  struct KnownOrbit {
    PeriodicOrbit orbit;
    PeriodicOrbit second;       ///< the same state with the tangents of other steps
    bool own_tangents = false;  ///< the orbit's monodromy is that of its state
  };

  /// An orbit of period n near the trajectory's last point, with its error [A-orbit-error].
  /// @param distance_now  the trajectory's recurrence error after n periods
  std::optional<KnownOrbit> seek(std::span<const double> last, int n, double distance_now) {
    integrate::Flow& exact = *exact_;
    // n + 1 shooting intervals end within periods, so that all steps of the integrator differ.
    integrate::Flow& other = *coarser_;
    const int shooting_intervals = coarser_ == exact_ ? n + 1 : 1;
    const auto tangents_of_others = [&](const PeriodicOrbit& orbit) {
      return find_periodic_orbit(
          other, orbit.state, n,
          {.iterations = 1, .residual = map_residual(), .shooting_intervals = shooting_intervals});
    };
    const auto residual = [](const PeriodicOrbit& orbit) {
      return *std::min_element(orbit.residuals.begin(), orbit.residuals.end());
    };
    OrbitOptions o;
    o.residual = map_residual();
    o.keep_tangents = true;
    o.iterations = 6;  // what attracts is near and found in three
    KnownOrbit known;
    known.orbit = find_periodic_orbit(exact, last, n, o);
    // A trajectory on a torus also returns after n periods. There Newton's method does not reduce the residual.
    const double rough = rough_map * o.residual;
    if (known.orbit.outcome == OrbitOutcome::not_reached ||
        residual(known.orbit) > std::min(std::sqrt(o.residual), std::max(least_gain * distance_now, rough)))
      return std::nullopt;
    known.second = tangents_of_others(known.orbit);
    if (known.second.interval_maps.empty()) return std::nullopt;
    known.orbit.error = orbit_error(known.second.monodromy, std::max(residual(known.orbit), o.residual));
    if (known.orbit.error <= noise()) return known;
    // Near a fold, or a period doubling (flip) of a part of n: the residual proves little, and kept tangents fail.
    o.keep_tangents = false;
    o.iterations = 24;
    known.orbit = find_periodic_orbit(exact, known.orbit.state, n, o);
    if (known.orbit.outcome == OrbitOutcome::not_reached || residual(known.orbit) > rough) {
      indistinct_.insert(n);  // nothing that is no orbit is neared so
      return std::nullopt;
    }
    known.own_tangents = true;
    known.second = tangents_of_others(known.orbit);
    if (known.second.interval_maps.empty()) return std::nullopt;
    return known;
  }

  bool converges_to_orbit_of(int n) {
    Evidence& seen = result_.evidence;
    attracted_ = false;
    const auto vain = in_vain_.try_emplace(n, std::numeric_limits<double>::infinity()).first;
    const double distance_now = recurrence_error(section_, static_cast<std::size_t>(n));
    if (distance_now > nearer * vain->second) return false;
    const auto last = section_.point(section_.size() - 1);
    integrate::Flow& exact = *exact_;
    std::optional<KnownOrbit> known = seek(last, n, distance_now);
    flow_->forget();
    if (!known) {
      vain->second = distance_now;
      return false;
    }
    PeriodicOrbit& orbit = known->orbit;
    // The trajectory may be within the error of the orbit. Then it cannot be distinguished from the orbit, nor from
    // orbits that branch off close by.
    const bool indistinct = largest_difference(last, orbit.state) <= closed_to(orbit);
    if (!indistinct) indistinct_.erase(n);
    if (const int least = least_period(exact, orbit, n); least < n) {
      if (converges_to_orbit_of(least)) return true;
      if (std::isfinite(in_vain_[least])) vain->second = distance_now;
      if (indistinct) indistinct_.insert(n);
      return false;
    }
    const auto [multiplier, error] = largest_multiplier_of(*known, exact, n);
    const std::string name = "orbit of period " + std::to_string(n);
    if (!(multiplier + error < 1.0 - options_.neutral)) {
      seen.note = "the " + name + " near by does not attract (multiplier " + short_text(multiplier) + " +- " +
                  short_text(error) + ")";
      if (multiplier - error > 1.0) vain->second = distance_now;
      if (indistinct) indistinct_.insert(n);
      return false;
    }
    const std::optional<Approach> approach = approach_to(orbit, exact, last, n);
    if (!approach) return false;
    const std::string distance = short_text(approach->distance);
    if (!approach->drawn) {
      attracted_ = true;
      seen.note = "not yet attracted to the " + name + " that is " + distance + " away";
      return false;
    }
    set_periodic(std::move(orbit), n, multiplier, error);
    seen.note = "attracted to the " + name + " from " + distance + " away";
    return true;
  }

  /// An orbit's points may be this far from it: ten times their error, which is a bound of first order.
  [[nodiscard]] double closed_to(const PeriodicOrbit& orbit) const {
    constexpr double safety = 10.0;
    return std::max(noise(), safety * orbit.error);
  }

  /// Modulus of an orbit's largest multiplier and its error, if necessary with tangents of the orbit's own.
  std::pair<double, double> largest_multiplier_of(KnownOrbit& known, integrate::Flow& exact, int n) const {
    const auto multipliers = [&] {
      const FloquetMultipliers m = floquet_multipliers(known.orbit, known.second);
      return std::pair{std::abs(m.values.front()), *std::max_element(m.errors.begin(), m.errors.end())};
    };
    const auto [multiplier, error] = multipliers();
    if (error <= own_tangents * std::abs(1.0 - multiplier) || known.own_tangents) return {multiplier, error};
    // The tangents that Newton's method kept are too far from the orbit.
    PeriodicOrbit own = find_periodic_orbit(exact, known.orbit.state, n, {.iterations = 1, .residual = map_residual()});
    if (!own.interval_maps.empty()) known.orbit = std::move(own);
    return multipliers();
  }

  /// [A-approach]
  struct Approach {
    double distance = 0;  ///< of the trajectory from the orbit
    bool drawn = false;
  };

  /// Uses the flow that the orbit belongs to: the flow of windows may be rougher.
  /// @returns nothing if the integration failed
  std::optional<Approach> approach_to(const PeriodicOrbit& orbit, integrate::Flow& exact, std::span<const double> last,
                                      int n) const {
    const auto size = static_cast<Eigen::Index>(last.size());
    const Eigen::Map<const Eigen::VectorXd> on_orbit(orbit.state.data(), size);
    std::vector<double> state(last.begin(), last.end());
    const Eigen::Map<const Eigen::VectorXd> now(state.data(), size);
    Eigen::VectorXd from = now - on_orbit;
    const double distance = from.lpNorm<Eigen::Infinity>();
    double farthest = distance;
    exact.forget();
    for (int return_count = 0; return_count < most_returns; ++return_count) {
      for (int k = 0; k < n; ++k)
        if (!exact.evolve(state, 0.0, exact.field().period).reached()) return std::nullopt;
      const Eigen::VectorXd to = now - on_orbit;
      const double off = (to - orbit.monodromy * from).lpNorm<Eigen::Infinity>();
      if (off > 0.1 * from.lpNorm<Eigen::Infinity>() && off > noise()) return Approach{distance, false};
      from = to;
      const double away = from.lpNorm<Eigen::Infinity>();
      farthest = std::max(farthest, away);
      const bool followed = away <= std::max(as_near * distance, noise()) || return_count + 1 == most_returns;
      if (followed && stays_within(2.0 * std::max(farthest, noise()), orbit.monodromy, from))
        return Approach{distance, true};
    }
    return Approach{distance, false};
  }

  /// Do the next returns leave a difference within these bounds, if they are as the monodromy has them?
  static bool stays_within(double bound, const Eigen::MatrixXd& monodromy, Eigen::VectorXd difference) {
    for (int k = 0; k < foreseen_returns; ++k) {
      difference = monodromy * difference;
      if (difference.lpNorm<Eigen::Infinity>() > bound) return false;
    }
    return true;
  }

  void set_periodic(PeriodicOrbit orbit, int n, double multiplier, double error) {
    Evidence& seen = result_.evidence;
    result_.regime = Regime::periodic;
    result_.period = n;
    seen.residual = *std::min_element(orbit.residuals.begin(), orbit.residuals.end());
    seen.orbit_error = orbit.error;
    seen.largest_multiplier = multiplier;
    seen.multiplier_error = error;
    // The error of the logarithm stays finite, even if the multiplier is smaller than its error.
    const double time = n * flow_->field().period;
    seen.exponent = {std::log(multiplier) / time, std::log1p(error / multiplier) / time};
    seen.zero_one.reset();
    result_.orbit = std::move(orbit);
  }

  /// The least divisor d of n of which an orbit is, too: it closes after d periods to within its error, or Newton's
  /// method, begun where it nearly closes, finds an orbit of period d that is the same to within the errors of both.
  int least_period(integrate::Flow& flow, const PeriodicOrbit& orbit, int n) {
    const double closed = closed_to(orbit);
    std::vector<int> nearly;
    std::vector<double> y = orbit.state;
    flow.forget();
    for (int d = 1; d < n; ++d) {
      if (!flow.evolve(y, 0.0, flow.field().period).reached()) break;
      if (n % d != 0) continue;
      const double open = largest_difference(y, orbit.state);
      if (open <= closed) return d;
      if (open <= converged * scale_) nearly.push_back(d);
    }
    for (const int d : nearly) {
      const PeriodicOrbit shorter = find_periodic_orbit(flow, orbit.state, d, {.residual = map_residual()});
      if (shorter.found() && largest_difference(shorter.state, orbit.state) <= std::max(closed, closed_to(shorter)))
        return d;
    }
    return n;
  }

  /// What the exponent counts. The first quarter is left to the alignment of the vector and to the end of the
  /// transient.
  [[nodiscard]] std::span<const double> counted_growth() const {
    return std::span(growth_).subspan(growth_.size() / 4);
  }

  bool is_chaotic() {
    Evidence& seen = result_.evidence;
    seen.exponent = series_mean(counted_growth()) / flow_->field().period;
    seen.zero_one.reset();
    if (series_.size() < 2 * static_cast<std::size_t>(growth_window)) return false;
    seen.zero_one = zero_one_test(series_, noise());
    if (!(seen.exponent.low() > 0.0 && seen.late_growth > neutral_growth)) return false;
    const double k = *(seen.zero_one = vote(*seen.zero_one));
    if (!left_at_ && grows_evenly()) return false;
    // After a push of 1e-3 a trajectory spirals away over a growth of e^7 and more. To the 0-1 test that is chaos.
    if (left_at_ && growth_since_left() < -std::log(push) + 4.0 * neutral_growth) return false;
    if (k > chaotic_vote) return true;
    if (k > regular_vote) return late_growth(growth_) > 4.0 * neutral_growth;
    // One of the two is mistaken. Growth is, where a loose tolerance passes kinks unseen: it is measured again.
    seen.note = "vectors grow, and the 0-1 test says regular (" + short_text(k) + ")";
    contradicts_ = true;
    return false;
  }

  /// The 0-1 test of a trajectory whose vectors grow. In chaos of several bands that the trajectory visits in sequence,
  /// the sequence hides the irregular part. If the section nearly recurs after n periods, the mean of each n-th point
  /// is subtracted, too.
  /// @param plain  the result of the test without that
  [[nodiscard]] double vote(double plain) const {
    const Recurrence& r = result_.evidence.recurrence;
    if (plain > chaotic_vote || r.best_period < 2 || !(r.error <= near_enough(options_.near))) return plain;
    const auto bands = static_cast<std::size_t>(r.best_period);
    std::vector<double> about(series_);
    for (std::size_t band = 0; band < bands; ++band) {
      double sum = 0.0;
      double count = 0.0;
      for (std::size_t k = band; k < series_.size(); k += bands) {
        sum += series_[k];
        count += 1.0;
      }
      for (std::size_t k = band; k < series_.size(); k += bands) about[k] -= sum / count;
    }
    return std::max(plain, zero_one_test(about, noise()));
  }

  /// Do vectors grow as they do beside a repelling set: slowly, and by the same factor all the time? The 0-1 test takes
  /// a transient to such a set for chaos.
  [[nodiscard]] bool grows_evenly() const {
    const auto& e = result_.evidence.exponent;
    return e.half_width < even_part * e.value && e.value * flow_->field().period * 2 * growth_window < slow_growth;
  }

  [[nodiscard]] double growth_since_left() const {
    return std::accumulate(growth_.begin() + static_cast<std::ptrdiff_t>(*left_at_), growth_.end(), 0.0);
  }

  /// Does apparent chaos last? Integrates on, without tangents if the 0-1 test is sure. If an orbit attracts near by,
  /// it integrates for the whole budget, since the trajectory may still reach the orbit.
  /// @returns true if the regime is known or the integration ended
  bool outlasts() {
    Evidence& seen = result_.evidence;
    const auto lasted = [&] { return first_ + seen.periods; };
    const int lasting = std::min(options_.lasting, options_.budget);
    const auto last_until = [&](int end) {
      while (lasted() < end)
        if (!advance(std::min(lasted(), end - lasted())) || is_periodic(converged)) return false;
      return true;
    };
    std::string beside;
    if (lasted() < lasting) {
      if (*seen.zero_one <= chaotic_vote) return false;
      const std::vector<Return> returns = close_returns();
      if (!last_until(lasting)) return true;
      if (const int n = attracting_period(returns); n > 0) {
        if (!last_until(first_ + options_.budget)) return true;
        beside = ", beside an orbit of period " + std::to_string(n) + " that attracts";
      }
      seen.zero_one = vote(zero_one_test(series_, noise()));
      if (*seen.zero_one <= chaotic_vote) {
        // The growth belongs to another response than this one.
        growth_.clear();
        if (left_at_) left_at_ = 0;
        return false;
      }
    }
    // Errors of a loose tolerance can keep a trajectory off an orbit that attracts from near by alone, if growth is
    // weak.
    if (grows_weakly() && use_tight_tolerance()) {
      returned_ = true;
      const int until = lasted() + lasting;
      if (!last_until(until - growth_window) || !last_until(until)) return true;
      seen.zero_one = vote(zero_one_test(series_, noise()));
      if (*seen.zero_one <= chaotic_vote || !still_grows()) return false;
    }
    result_.regime = Regime::chaotic;
    seen.note = "exponent positive by its interval, 0-1 test " + short_text(*seen.zero_one) + ", for " +
                std::to_string(lasted()) + " periods" + beside;
    return true;
  }

  /// By less than e^8 in 128 periods: errors of tangents at kinks are as large.
  [[nodiscard]] bool grows_weakly() const {
    return result_.evidence.exponent.value * flow_->field().period * growth_window < 4.0 * neutral_growth;
  }

  /// Does a vector grow over the next periods?
  bool still_grows() {
    std::vector<double> onwards(state_.begin(), state_.end());
    flow_->forget();
    constexpr int aligning = 16;
    const LargestExponent e =
        largest_exponent(*flow_, onwards, {.aligning_periods = aligning, .periods = growth_window}, {}, go_on_);
    return e.growth.size() == growth_window && std::accumulate(e.growth.begin(), e.growth.end(), 0.0) > neutral_growth;
  }

  /// A state that the trajectory nearly returns to after n periods, without growth of vectors in between.
  struct Return {
    std::vector<double> state;
    int n = 0;
    double distance = 0;
  };

  /// The closest for each n in the last window, the closest ones first. Near an orbit that attracts vectors shrink, and
  /// a trajectory that approaches one passes by.
  [[nodiscard]] std::vector<Return> close_returns() const {
    std::vector<Return> all;
    const std::size_t points = std::min(section_.size(), growth_.size());
    const std::size_t first_point = section_.size() - points;
    const std::span<const double> growth = std::span(growth_).last(points);
    const double near = options_.near * extent(section_);
    for (std::size_t n = 1; n <= static_cast<std::size_t>(options_.longest_period) && n < points; ++n) {
      Return best{{}, static_cast<int>(n), near};
      std::size_t at = points;
      for (std::size_t k = 0; k + n < points; ++k) {
        // From point k to point k + n.
        const double grown = std::accumulate(growth.begin() + static_cast<std::ptrdiff_t>(k + 1),
                                             growth.begin() + static_cast<std::ptrdiff_t>(k + n + 1), 0.0);
        const double d = largest_difference(section_.point(first_point + k), section_.point(first_point + k + n));
        if (grown > 0.0 || d > best.distance) continue;
        best.distance = d;
        at = first_point + k;
      }
      if (at == points) continue;
      const auto y = section_.point(at);
      best.state.assign(y.begin(), y.end());
      all.push_back(std::move(best));
    }
    std::sort(all.begin(), all.end(), [](const Return& a, const Return& b) { return a.distance < b.distance; });
    return all;
  }

  /// Newton's method from these, at a cost of at most a quarter of that of the trajectory.
  /// @returns n of an orbit that attracts; 0 if none is found
  int attracting_period(std::span<const Return> returns) {
    constexpr double part = 0.25;
    constexpr double tangents_per_state = 4.0;  // that cost as much as a state
    const double cost = 1.0 + static_cast<double>(state_.size()) / tangents_per_state;
    double left = part * (first_ + result_.evidence.periods) / cost;
    int found = 0;
    for (const Return& r : returns) {
      OrbitOptions o;
      o.residual = 1e2 * map_residual();  // windows are rougher than the search for orbits
      o.iterations = 1;
      left -= r.n;
      if (left < 0.0) break;
      PeriodicOrbit orbit = find_periodic_orbit(*flow_, r.state, r.n, o);
      // An orbit that attracts has no neighbours that part this fast.
      constexpr double fast = 5.0;
      if (orbit.interval_maps.empty() || largest_multiplier(orbit) > fast) continue;
      o.iterations = std::min(8, static_cast<int>(left) / r.n);
      if (o.iterations < 2) continue;
      orbit = find_periodic_orbit(*flow_, r.state, r.n, o);
      left -= static_cast<double>(orbit.residuals.size()) * r.n;
      if (!orbit.found() || largest_multiplier(orbit) >= 1.0) continue;
      found = r.n;
      break;
    }
    flow_->forget();
    return found;
  }

  /// A stretch without tangents; the section and the series are those of its end.
  /// @returns false if the integration ended early
  bool advance(int periods) {
    StrobeOptions o;
    o.recorded_periods = std::min(periods, growth_window);
    o.transient_periods = periods - o.recorded_periods;
    o.phases = 1;
    Strobe s = strobe(
        *flow_, state_, o, [](std::size_t, double, std::span<const double>) {}, go_on_);
    result_.evolution = s.evolution;
    if (s.section.size() < static_cast<std::size_t>(o.recorded_periods)) return false;
    result_.evidence.periods += periods;
    for (std::size_t k = 0; k < s.section.size(); ++k) series_.push_back(s.section.point(k)[options_.observable]);
    const auto most = 2 * static_cast<std::ptrdiff_t>(growth_window);
    if (std::ssize(series_) > most) series_.erase(series_.begin(), series_.end() - most);  // as before a window
    previous_window_ = 0;
    section_ = std::move(s.section);
    find_recurrence();
    return true;
  }

  /// If vectors grow and the section says regular, or if they grow evenly, the trajectory is on a repelling set. An
  /// example is a response with an unstable symmetry. Only rounding is small enough to keep the trajectory there. A
  /// push moves it off.
  void leave_what_repels() {
    const Evidence& seen = result_.evidence;
    if (left_at_ || direction_.empty() || !(seen.late_growth > neutral_growth) || !seen.zero_one ||
        (*seen.zero_one > regular_vote && !grows_evenly()))
      return;
    for (std::size_t i = 0; i < state_.size(); ++i) state_[i] += push * scale_ * direction_[i];
    in_vain_.clear();
    indistinct_.clear();
    left_at_ = growth_.size();
  }

  /// What excludes a torus whatever exponents say; empty if nothing does.
  std::string against_torus() {
    if (shrinks_areas())
      return "no torus: the map of one period shrinks all areas in the plane, and an invariant curve keeps its own";
    constexpr std::size_t parts = 4;
    const std::size_t length = whole_window_.size() / parts;
    const std::size_t dimension = whole_window_.dimension;
    std::array<PoincareSection, parts> part;
    for (std::size_t i = 0; i < parts; ++i) {
      const auto begin = whole_window_.states.begin() + static_cast<std::ptrdiff_t>(i * length * dimension);
      part[i] = {dimension, {begin, begin + static_cast<std::ptrdiff_t>(length * dimension)}};
    }
    const PoincareSection& late = part.back();
    std::size_t best = 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 1; 2 * n <= length; ++n) {
      const double error = recurrence_error(late, n);
      bool nearer_by_each = true;
      for (std::size_t i = 0; i + 1 < parts && nearer_by_each; ++i)
        nearer_by_each = recurrence_error(part[i + 1], n) <= falling * recurrence_error(part[i], n);
      if (error <= noise() || (nearer_by_each && error <= near_enough(options_.near)))
        return "no torus: the states return after " + std::to_string(n) + " periods, ever nearer";
      if (error < least) {
        least = error;
        best = n;
      }
    }
    double slowest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + best < late.size(); ++k)
      slowest = std::min(slowest, largest_difference(late.point(k), late.point(k + best)));
    if (slowest < least_rotation_rate * least)
      return "no torus: the states stay nearly at rest at a point of a cycle of " + std::to_string(best) + " periods";
    return {};
  }

  /// True in one dimension. True in two dimensions if the map of one period shrinks all areas about the trajectory, on
  /// a grid over the section. An attracting invariant curve would have to keep the area inside it.
  bool shrinks_areas() {
    const std::size_t dimension = state_.size();
    if (dimension == 1) return true;
    if (dimension > 2) return false;
    std::array<double, 2> low{};
    std::array<double, 2> high{};
    for (std::size_t j = 0; j < 2; ++j) {
      low[j] = high[j] = whole_window_.point(0)[j];
      for (std::size_t k = 1; k < whole_window_.size(); ++k) {
        low[j] = std::min(low[j], whole_window_.point(k)[j]);
        high[j] = std::max(high[j], whole_window_.point(k)[j]);
      }
    }
    constexpr int across = 5;
    bool all = true;
    for (int i = 0; i < across && all; ++i)
      for (int j = 0; j < across && all; ++j) {
        std::array<double, 2> y = {low[0] + (high[0] - low[0]) * i / (across - 1),
                                   low[1] + (high[1] - low[1]) * j / (across - 1)};
        std::array<double, 4> v = {1.0, 0.0, 0.0, 1.0};
        exact_->forget();
        all = exact_->evolve_tangents(y, v, 0.0, exact_->field().period).reached() &&
              v[0] * v[3] - v[1] * v[2] < 1.0 - options_.neutral;
      }
    exact_->forget();
    return all;
  }

  /// Does the interval of the exponent exclude growth by more than e^8 over all periods that it counts? Beside a torus
  /// they are bounded. In weak chaos they may neither grow nor shrink for hundreds of periods.
  [[nodiscard]] bool growth_is_bounded() const {
    const auto counted = static_cast<double>(counted_growth().size());
    return result_.evidence.exponent.high() * flow_->field().period * counted <= 4.0 * neutral_growth;
  }

  bool is_torus() {
    Evidence& seen = result_.evidence;
    // Near an orbit that attracts slowly, vectors shrink long before the trajectory recurs. Beside a torus with shear,
    // vectors grow in proportion to time, so a small positive exponent does not count.
    const bool decays = seen.exponent.value + 3.0 * seen.exponent.half_width < 0.0;
    if (growth_.size() >= static_cast<std::size_t>(torus_window) && std::abs(late_growth(growth_)) <= neutral_growth &&
        !decays && seen.zero_one && *seen.zero_one < regular_vote && growth_is_bounded()) {
      // Beside a period doubling (flip) of a long orbit all this holds, too. The search for that orbit has no limit of
      // cost.
      const Recurrence& r = seen.recurrence;
      if (r.best_period > 0 && r.error <= near_enough(options_.near) && converges_to_orbit_of(r.best_period))
        return true;
      if (attracted_ || indistinct_.count(r.best_period) > 0) return false;
      if (const std::string against = against_torus(); !against.empty()) {
        seen.note = against;
        return false;
      }
      result_.regime = Regime::quasiperiodic;
      seen.note = "tangents neither grow nor shrink, 0-1 test " + short_text(*seen.zero_one) +
                  ", the phase on the torus advances without recurrence";
      return true;
    }
    if (seen.note.empty())
      seen.note = "exponent " + short_text(seen.exponent.value) + " +- " + short_text(seen.exponent.half_width) +
                  " per radian of the phase, " +
                  (seen.zero_one ? "0-1 test " + short_text(*seen.zero_one) : "too few periods for a 0-1 test");
    return false;
  }

  const RegimeOptions& options_;
  const std::function<bool()>& go_on_;
  std::span<double> state_;
  integrate::Flow* flow_;     ///< of windows
  integrate::Flow* exact_;    ///< of orbits
  integrate::Flow* coarser_;  ///< of their multipliers' errors
  integrate::Flow* loose_;    ///< of windows with growth
  integrate::Flow* tight_;    ///< of windows without growth
  double residual_;           ///< of an orbit, in parts of its largest component
  bool contradicts_ = false;  ///< growth and the 0-1 test of the last window contradict each other
  bool returned_ = false;     ///< windows have been loose, or a tighter tolerance was requested
  int level_periods_ = 0;     ///< periods by this flow
  PoincareSection whole_window_;
  Classification result_;
  PoincareSection section_;
  int first_ = 0;                  ///< periods of the section that was seen before
  double scale_ = 0;               ///< largest component of the section
  std::map<int, double> in_vain_;  ///< recurrence error after n periods when an orbit of period n was sought in vain
  std::vector<double> growth_;     ///< g_k of all windows
  std::vector<double> series_;     ///< the observable over the window before and this one
  std::vector<double> direction_;  ///< of the tangent vector at the end of the last window
  bool attracted_ = false;  ///< the last orbit that was searched attracts, but the trajectory does not yet approach it
  std::set<int>
      indistinct_;  ///< periods of orbits that do not attract, and that the trajectory cannot be distinguished from
  std::optional<std::size_t> left_at_{};  ///< number of g_k that were known at the push off a repelling set
  std::size_t previous_window_ = 0;       ///< number of values of the window before
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

void RegimeOptions::validate() const {
  require(window >= least_window, "look", window, ">= " + std::to_string(least_window));
  require(budget >= window, "budget", budget, ">= " + std::to_string(window));
  require(lasting >= 0, "lasting", lasting, ">= 0");
  require(longest_period >= 1, "longest_period", longest_period, ">= 1");
  require(near >= 0.0, "near", near, ">= 0");
  require(residual > 0.0, "residual", residual, "> 0");
  require(neutral >= 0.0, "neutral", neutral, ">= 0");
}

Classification classify(integrate::Flow& flow, std::span<double> state, const RegimeOptions& options,
                        const std::function<bool()>& go_on, const PoincareSection* seen) {
  return Classifier(flow, state, options, go_on).run(seen);
}

}  // namespace epicyclic::analysis
