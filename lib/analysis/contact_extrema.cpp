#include "analysis/contact_extrema.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>

#include "analysis/shooting.hpp"
#include "core/root_finding.hpp"

namespace epicyclic::analysis {

namespace {

constexpr int samples_per_period = 128;

std::span<double> span_of(Eigen::VectorXd& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

/// One surface at one sample.
struct Sample {
  double s = 0, value = 0, rate = 0;
};

/// Extremum of the cubic through two samples whose rates differ in sign.
double cubic_extremum(const Sample& a, const Sample& b, bool least) {
  const double h = b.s - a.s;
  // v(x) = a + h a' x + c2 x^2 + c3 x^3, x in [0, 1].
  const double c1 = h * a.rate;
  const double c2 = 3.0 * (b.value - a.value) - 2.0 * c1 - h * b.rate;
  const double c3 = 2.0 * (a.value - b.value) + c1 + h * b.rate;
  const auto value = [&](double x) { return a.value + x * (c1 + x * (c2 + x * c3)); };
  double best = least ? std::min(a.value, b.value) : std::max(a.value, b.value);
  const double root = std::sqrt(std::max(0.0, c2 * c2 - 3.0 * c1 * c3));
  for (const double x : {(-c2 + root) / (3.0 * c3), (-c2 - root) / (3.0 * c3), -c1 / (2.0 * c2)})
    if (x > 0.0 && x < 1.0) best = least ? std::min(best, value(x)) : std::max(best, value(x));
  return best;
}

/// Passes every pair of neighbouring samples on a stretch to a function.
class Watch {
 public:
  explicit Watch(integrate::Flow& flow)
      : flow_(flow), count_(flow.field().surfaces.count), values_(count_), rates_(count_) {}

  /// @param see  see(surface, before, after)
  template <class See>
  bool stretch(const Stretch& of, const See& see) {
    const int windows =
        std::max(1, static_cast<int>(std::ceil(samples_per_period * (of.to - of.from) / flow_.field().period - 1e-9)));
    std::vector<double> at;
    for (int k = 1; k <= windows; ++k) at.push_back(k == windows ? of.to : of.from + (of.to - of.from) * k / windows);
    std::vector<Sample> before(count_);
    take(of.from, of.state.data(), before);
    std::vector<Sample> now(count_);
    Eigen::VectorXd y = of.state;
    const auto observe = [&](std::size_t, double s, std::span<const double> state) {
      take(s, state.data(), now);
      for (std::size_t i = 0; i < count_; ++i) see(i, before[i], now[i]);
      std::swap(before, now);
    };
    return flow_.evolve(span_of(y), of.from, of.to, at, observe).reached();
  }

  Sample sample(std::size_t surface, double s, const double* y) {
    flow_.field().surfaces.evaluate(s, y, values_.data(), rates_.data());
    return {s, values_[surface], rates_[surface]};
  }

 private:
  void take(double s, const double* y, std::vector<Sample>& to) {
    flow_.field().surfaces.evaluate(s, y, values_.data(), rates_.data());
    for (std::size_t i = 0; i < count_; ++i) to[i] = {s, values_[i], rates_[i]};
  }

  integrate::Flow& flow_;
  std::size_t count_;
  std::vector<double> values_, rates_;
};

/// Is there a place between where the value is least, or greatest?
bool has_extremum(const Sample& a, const Sample& b, bool least) {
  return least ? a.rate <= 0.0 && b.rate >= 0.0 : a.rate >= 0.0 && b.rate <= 0.0;
}

}  // namespace

std::optional<ContactExtrema> contact_extrema(const OrbitFamily& family, const CurvePoint& orbit) {
  const auto flow = family.flows(orbit.value);
  const std::size_t count = flow->field().surfaces.count;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  ContactExtrema e{std::vector<double>(count, infinite), std::vector<double>(count, -infinite)};
  if (count == 0) return e;
  const std::vector<Stretch> all = stretches(*flow, orbit.states, family.period);
  if (all.empty()) return std::nullopt;
  Watch watch(*flow);
  for (const Stretch& stretch : all) {
    const bool reached = watch.stretch(stretch, [&](std::size_t i, const Sample& a, const Sample& b) {
      e.least[i] = std::min({e.least[i], a.value, b.value});
      e.greatest[i] = std::max({e.greatest[i], a.value, b.value});
      if (has_extremum(a, b, true)) e.least[i] = std::min(e.least[i], cubic_extremum(a, b, true));
      if (has_extremum(a, b, false)) e.greatest[i] = std::max(e.greatest[i], cubic_extremum(a, b, false));
    });
    if (!reached) return std::nullopt;
  }
  return e;
}

std::optional<double> contact_extremum(const OrbitFamily& family, const CurvePoint& orbit, std::size_t surface,
                                       bool least) {
  const auto flow = family.flows(orbit.value);
  const std::vector<Stretch> all = stretches(*flow, orbit.states, family.period);
  if (all.empty()) return std::nullopt;
  Watch watch(*flow);
  // The samples about the extremum, and their stretch.
  double best = least ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  const Stretch* on = nullptr;
  double low = 0.0;
  double high = 0.0;
  const auto better = [&](double value) { return least ? value < best : value > best; };
  // Between two stretches the trajectory is only as continuous as the orbit is closed: an extremum there may be on
  // neither.
  std::optional<Sample> begun, ended;
  const auto meet = [&](const Sample& end, const Sample& begin) {
    const double value = 0.5 * (end.value + begin.value);
    if (!has_extremum(end, begin, least) || !better(value)) return;
    best = value;
    on = nullptr;
  };
  for (const Stretch& stretch : all) {
    bool first = true;
    const bool reached = watch.stretch(stretch, [&](std::size_t i, const Sample& a, const Sample& b) {
      if (i != surface) return;
      if (!begun) begun = a;
      if (first && ended) meet(*ended, a);
      first = false;
      ended = b;
      if (!has_extremum(a, b, least)) return;
      const double value = cubic_extremum(a, b, least);
      if (!better(value)) return;
      best = value;
      on = &stretch;
      low = a.s;
      high = b.s;
    });
    if (!reached) return std::nullopt;
  }
  if (ended) meet(*ended, *begun);
  if (!std::isfinite(best)) return std::nullopt;
  if (on == nullptr) return best;
  Eigen::VectorXd at_low = on->state;
  flow->forget();
  if (low > on->from && !flow->evolve(span_of(at_low), on->from, low).reached()) return std::nullopt;
  const auto sample_at = [&](double s) {
    Eigen::VectorXd y = at_low;
    flow->forget();
    if (s > low && !flow->evolve(span_of(y), low, s).reached()) return Sample{s, std::nan(""), std::nan("")};
    return watch.sample(surface, s, y.data());
  };
  const Sample first = sample_at(low);
  const Sample last = sample_at(high);
  // The value is flat at the resolution of the interpolation between samples: one end is the extremum.
  if (!(first.rate * last.rate < 0.0))
    return least ? std::min(first.value, last.value) : std::max(first.value, last.value);
  // The value is off by the square of what the place is.
  constexpr double width = 1e-7;
  return sample_at(find_root([&](double s) { return sample_at(s).rate; }, low, high, width * (high - low))).value;
}

}  // namespace epicyclic::analysis
