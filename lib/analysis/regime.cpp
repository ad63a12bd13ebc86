#include "analysis/regime.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

  Classification run() {
    check(flow_, options_);
    Evidence& seen = result_.evidence;
    for (int look = options_.look;; look *= 2) {
      look = std::min(look, options_.budget - seen.periods);
      if (look < least_look) break;
      if (!record(look)) return std::move(result_);
      if (is_periodic()) return std::move(result_);
      if (!go_on_()) break;
      if (decided_by_growth()) return std::move(result_);
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
    growth_.clear();
    series_.clear();
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
    growth_ = std::move(e.growth);
    if (!result_.evolution.reached() || growth_.size() < static_cast<std::size_t>(periods)) return false;
    scale_ = std::numeric_limits<double>::min();
    for (const double x : section_.states) scale_ = std::max(scale_, std::abs(x));
    result_.evidence.recurrence = recurrence(section_, options_.longest_period, options_.residual * scale_);
    return true;
  }

  /// What an integrator may leave of an orbit.
  [[nodiscard]] double noise() const { return 1e3 * options_.residual * scale_; }

  bool is_periodic() {
    const Recurrence& r = result_.evidence.recurrence;
    const double wide = extent(section_);
    const int n = r.period > 0                                                        ? r.period
                  : r.error <= options_.near * wide || wide <= options_.near * scale_ ? r.best_period
                                                                                      : 0;
    if (n == 0) return false;
    // Smaller periods that nearly recur, too, come first: an orbit of period 1 recurs after 2.
    for (int d = 1; d <= n; ++d)
      if (n % d == 0 && settles_to_orbit_of(d)) return true;
    return false;
  }

  bool settles_to_orbit_of(int n) {
    Evidence& seen = result_.evidence;
    const auto last = section_.point(section_.size() - 1);
    OrbitOptions o;
    o.residual = options_.residual * scale_;
    PeriodicOrbit orbit = find_periodic_orbit(flow_, last, n, o);
    flow_.forget();
    if (!orbit.found()) return false;
    const double multiplier = largest_multiplier(orbit);
    const std::string name = "orbit of period " + std::to_string(n);
    if (!(multiplier < 1.0 - options_.neutral)) {
      seen.note = "the " + name + " near by does not attract (multiplier " + short_text(multiplier) + ")";
      return false;
    }
    // [A-settled], with the motion's own points.
    const auto before = section_.point(section_.size() - 1 - static_cast<std::size_t>(n));
    Eigen::VectorXd from(static_cast<Eigen::Index>(before.size()));
    Eigen::VectorXd to(from.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      from(static_cast<Eigen::Index>(i)) = before[i] - orbit.state[i];
      to(static_cast<Eigen::Index>(i)) = last[i] - orbit.state[i];
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
    seen.exponent = {std::log(multiplier) / (n * flow_.field().period), 0.0};
    seen.zero_one = 0.0;
    seen.note = "drawn to the " + name + " from " + short_text(distance) + " away";
    result_.orbit = std::move(orbit);
    return true;
  }

  bool decided_by_growth() {
    Evidence& seen = result_.evidence;
    // The first quarter is left to the vector's turning and to what is left of the transient.
    const std::span<const double> counted = std::span(growth_).subspan(growth_.size() / 4);
    seen.exponent = batch_mean(counted);
    seen.exponent.value /= flow_.field().period;
    seen.exponent.half_width /= flow_.field().period;
    seen.late_growth = late_growth(growth_);
    constexpr std::size_t enough = 250;  // for the 0-1 test
    if (series_.size() < enough) return false;
    seen.zero_one = zero_one_test(series_, noise());
    if (seen.exponent.low() > 0.0 && seen.late_growth > neutral_growth && seen.zero_one > chaotic_vote) {
      result_.regime = Regime::chaotic;
      seen.note = "exponent positive by its interval, 0-1 test " + short_text(seen.zero_one);
      return true;
    }
    constexpr std::size_t long_enough = 1000;  // for e^2 to be told from a small exponent
    if (series_.size() >= long_enough && std::abs(seen.late_growth) <= neutral_growth && seen.zero_one < regular_vote) {
      result_.regime = Regime::quasiperiodic;
      seen.note = "tangents neither grow nor shrink, 0-1 test " + short_text(seen.zero_one);
      return true;
    }
    if (seen.note.empty())
      seen.note = "exponent " + short_text(seen.exponent.value) + " +- " + short_text(seen.exponent.half_width) +
                  ", 0-1 test " + short_text(seen.zero_one);
    return false;
  }

  integrate::Flow& flow_;
  std::span<double> state_;
  const RegimeOptions& options_;
  const std::function<bool()>& go_on_;
  Classification result_;
  PoincareSection section_;
  double scale_ = 0;  ///< largest component of the section
  std::vector<double> growth_;
  std::vector<double> series_;
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
                        const std::function<bool()>& go_on) {
  return Classifier(flow, state, options, go_on).run();
}

}  // namespace epicyclic::analysis
