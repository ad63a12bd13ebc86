// Operating points of the clearance oscillator where a regime is easily told wrongly, drawn anew from a seed, each with
// what its exact solver says: next to folds and flips, next to basin boundaries, and anywhere.
//
// A fold or flip is found by following an orbit in W with Newton's method and exact tangents until its largest
// multiplier leaves the unit circle or there is no orbit any more, and by halving steps there to 1e-9. A basin boundary
// is found by halving the distance of two starts that end on different attractors.
//
// The truth is where the motion is after 24 000 periods in long double, and the orbit that Newton's method finds there.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/random_numbers.hpp"
#include "problems/clearance_exact.hpp"
#include "problems/clearance_points.hpp"

namespace epicyclic::problems {

/// An orbit of the exact solver.
template <class Real>
struct ExactOrbit {
  std::array<Real, 2> state{};
  int period = 0;         ///< least one
  double multiplier = 0;  ///< largest modulus
  double leading = 0;     ///< real part of that multiplier
};

/// Newton's method with exact tangents for a point of an orbit of period n.
/// @param near  the orbit may be this far from the start, in the largest component
/// @returns nothing if there is none; the orbit's period is n, which need not be the least
template <class Real>
std::optional<ExactOrbit<Real>> exact_orbit(const BasicClearanceExact<Real, Real>& exact, std::array<Real, 2> x, int n,
                                            double near) {
  const std::array<Real, 2> start = x;
  const Real rounding = 1e4 * std::numeric_limits<Real>::epsilon();
  for (int k = 0; k < 30; ++k) {
    std::array<Real, 4> m = {1, 0, 0, 1};
    const auto end = exact.periods(x, n, &m);
    const Real f = end[0] - x[0];
    const Real g = end[1] - x[1];
    if (std::max(std::abs(f), std::abs(g)) < rounding) {
      const double trace = static_cast<double>(m[0] + m[3]);
      const double det = static_cast<double>(m[0] * m[3] - m[1] * m[2]);
      const std::complex<double> root = std::sqrt(std::complex<double>(trace * trace / 4 - det));
      const std::complex<double> one = trace / 2 + (trace < 0 ? -root : root);
      const std::complex<double> other = trace / 2 - (trace < 0 ? -root : root);
      const std::complex<double> largest = std::abs(one) >= std::abs(other) ? one : other;
      return ExactOrbit<Real>{x, n, std::abs(largest), largest.real()};
    }
    // (M - I) d = -F
    const Real a = m[0] - 1;
    const Real d = m[3] - 1;
    const Real det = a * d - m[1] * m[2];
    if (det == 0) return std::nullopt;
    x[0] += (-f * d + g * m[1]) / det;
    x[1] += (-g * a + f * m[2]) / det;
    if (!(std::max(std::abs(x[0] - start[0]), std::abs(x[1] - start[1])) < near)) return std::nullopt;
  }
  return std::nullopt;
}

/// The orbit of the least period up to `longest` that attracts and that a motion has come to.
/// @param near  how far the motion may still be from it
template <class Real>
std::optional<ExactOrbit<Real>> attracting_orbit_at(const BasicClearanceExact<Real, Real>& exact,
                                                    const std::array<Real, 2>& state, int longest, double near) {
  auto y = state;
  for (int n = 1; n <= longest; ++n) {
    y = exact.periods(y, 1);
    if (std::max(std::abs(y[0] - state[0]), std::abs(y[1] - state[1])) > near) continue;
    auto orbit = exact_orbit(exact, state, n, near);
    if (!orbit || orbit->multiplier >= 1.0) continue;
    // A motion that comes and goes about a flip's orbit returns after twice its period first.
    auto on = orbit->state;
    for (int d = 1; d < n; ++d) {
      on = exact.periods(on, 1);
      const bool closed = std::max(std::abs(on[0] - orbit->state[0]), std::abs(on[1] - orbit->state[1])) < 1e-9;
      if (n % d == 0 && closed) return exact_orbit(exact, orbit->state, d, near);
    }
    return orbit;
  }
  return std::nullopt;
}

enum class Hardness { fold, flip, boundary, anywhere };

inline std::string to_string(Hardness kind) {
  switch (kind) {
    case Hardness::fold:
      return "fold";
    case Hardness::flip:
      return "flip";
    case Hardness::boundary:
      return "boundary";
    case Hardness::anywhere:
      break;
  }
  return "anywhere";
}

/// What the exact solver says of a start.
struct ExactTruth {
  int period = 0;                 ///< of the attractor; 0 if none up to the longest one
  double multiplier = 0;          ///< largest modulus, if periodic
  double growth = 0;              ///< of a tangent vector, per period, over the last quarter [-]
  std::array<double, 2> state{};  ///< a point of the attractor
  bool sensitive = false;         ///< starts as near as an integrator's error end elsewhere: any attractor is right
  bool may_be_chaos = false;      ///< one of those does not end on an orbit
};

struct HardPoint {
  Hardness kind = Hardness::anywhere;
  ClearancePoint at;
  std::array<double, 2> start{};
  ExactTruth truth;
};

namespace hard_points {

using Draft = BasicClearanceExact<double, double>;
using Proof = BasicClearanceExact<long double, long double>;
using State = Draft::State;

inline constexpr int truth_periods = 24000;
inline constexpr int longest_truth = 64;        ///< periods that are looked for
inline constexpr double arrived = 1e-3;         ///< what multipliers of 0.9998 leave of a transient is less
inline constexpr double forgotten = 14.0;       ///< growth of a start's errors by e^14: of 1e-8 by 1e6
inline constexpr double chaotic_growth = 2e-3;  ///< per period: e^24 in half of the truth

inline Draft draft(const ClearancePoint& p) { return Draft(p.w, p.z, p.mean, p.e); }

/// Where a start is after 24 000 periods, or ten times as many if it is on no orbit then, and not chaotic.
inline ExactTruth truth_of(const ClearancePoint& p, const State& start) {
  const Proof exact(p.w, p.z, p.mean, p.e);
  ExactTruth truth;
  Proof::State y = {start[0], start[1]};
  Proof::Matrix m = {1, 0, 0, 1};
  double grown = 0.0;
  double least = 0.0;
  for (int turn = 0; turn < 10 && truth.period == 0 && !(truth.growth > chaotic_growth); ++turn) {
    for (int k = 0; k < truth_periods; ++k) {
      y = exact.periods(y, 1, &m);
      const long double size = std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2] + m[3] * m[3]);
      for (long double& x : m) x /= size;
      grown += static_cast<double>(std::log(size));
      least = std::min(least, grown);
      truth.sensitive |= grown - least > forgotten;
      if (k == truth_periods / 2) truth.growth = grown;
    }
    truth.growth = (grown - truth.growth) / (truth_periods - truth_periods / 2);
    if (const auto orbit = attracting_orbit_at(exact, y, longest_truth, arrived)) {
      truth.period = orbit->period;
      truth.multiplier = orbit->multiplier;
      y = orbit->state;
    }
  }
  truth.state = {static_cast<double>(y[0]), static_cast<double>(y[1])};
  return truth;
}

/// Are these two ends on one attractor? Chaotic ones are.
inline bool same_attractor(const ClearancePoint& p, const ExactTruth& a, const ExactTruth& b) {
  if (a.period != b.period) return false;
  if (a.period == 0) return true;
  State y = b.state;
  for (int k = 0; k < a.period; ++k) {
    if (std::max(std::abs(y[0] - a.state[0]), std::abs(y[1] - a.state[1])) < 1e-6) return true;
    y = draft(p).periods(y, 1);
  }
  return false;
}

/// What a start comes to, without the proof: for searching.
inline ExactTruth draft_truth(const ClearancePoint& p, const State& start, int periods = 3000, int longest = 16) {
  const Draft exact = draft(p);
  const State y = exact.periods(start, periods);
  ExactTruth truth;
  truth.state = y;
  if (const auto orbit = attracting_orbit_at(exact, y, longest, arrived)) {
    truth.period = orbit->period;
    truth.multiplier = orbit->multiplier;
    truth.state = orbit->state;
  }
  return truth;
}

/// Numbers of one point, in order.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : seed_(seed) {}
  double between(double low, double high) { return low + (high - low) * random_uniform(seed_, ++number_); }
  /// Uniform in the logarithm.
  double scale(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  State start() {
    const double x = between(-1.5, 2.5);
    return {x, between(-1.0, 1.0)};
  }

 private:
  std::uint64_t seed_;
  std::uint64_t number_ = 0;
};

inline ClearancePoint any_point(Draws& draws) {
  ClearancePoint p;
  p.z = draws.scale(0.02, 0.07);
  p.mean = draws.between(0.05, 0.15);
  p.e = draws.between(0.05, 0.3);
  p.w = draws.between(0.5, 2.1);
  return p;
}

/// Next to where an attracting orbit ends or loses its stability.
inline std::optional<HardPoint> near_bifurcation(Draws& draws) {
  HardPoint h;
  h.at = any_point(draws);
  const ExactTruth from = draft_truth(h.at, draws.start());
  double step = draws.between(0.0, 1.0) < 0.5 ? 1e-3 : -1e-3;
  const double offset = draws.scale(1e-6, 1e-2);
  const double side = draws.between(0.0, 1.0);
  const double away = draws.scale(1e-4, 0.5);
  const double turn = draws.between(0.0, 6.283185307179586);
  if (from.period == 0) return std::nullopt;
  State orbit = from.state;
  double leading = from.multiplier;
  for (int k = 0; k < 2000 && std::abs(step) > 1e-9; ++k) {
    ClearancePoint next = h.at;
    next.w += step;
    if (next.w < 0.4 || next.w > 2.4) return std::nullopt;
    const auto found = exact_orbit(draft(next), orbit, from.period, 0.05);
    if (!found || found->multiplier >= 1.0) {
      step *= 0.5;
      continue;
    }
    h.at = next;
    orbit = found->state;
    leading = found->leading;
  }
  if (std::abs(step) > 1e-9 || std::abs(leading) < 0.9) return std::nullopt;
  h.kind = leading < 0.0 ? Hardness::flip : Hardness::fold;
  // Before it for the most part; behind it what has just been born, or a motion that passes where an orbit was.
  const double sign = step > 0.0 ? 1.0 : -1.0;
  h.at.w += side < 0.75 ? -sign * offset : sign * offset;
  const State on = draft(h.at).periods(orbit, side < 0.75 ? 2000 : 50);
  h.start = {on[0] + away * std::cos(turn), on[1] + away * std::sin(turn)};
  return h;
}

/// Next to the boundary of two basins.
inline std::optional<HardPoint> near_boundary(Draws& draws) {
  HardPoint h;
  h.kind = Hardness::boundary;
  h.at = any_point(draws);
  State a = draws.start();
  const ExactTruth of_a = draft_truth(h.at, a);
  const double offset = draws.scale(1e-4, 1e-1);
  for (int k = 0; k < 6; ++k) {
    State b = draws.start();
    const ExactTruth of_b = draft_truth(h.at, b);
    if (same_attractor(h.at, of_a, of_b) || of_a.period == 0 || of_b.period == 0) continue;
    const double length = std::max(std::abs(b[0] - a[0]), std::abs(b[1] - a[1]));
    const State whole = {(b[0] - a[0]) / length, (b[1] - a[1]) / length};
    double inside = 0.0;
    double outside = length;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (inside + outside);
      const State y = {a[0] + middle * whole[0], a[1] + middle * whole[1]};
      (same_attractor(h.at, of_a, draft_truth(h.at, y)) ? inside : outside) = middle;
    }
    const double at = std::max(0.0, inside - offset);
    h.start = {a[0] + at * whole[0], a[1] + at * whole[1]};
    return h;
  }
  return std::nullopt;
}

/// What starts come to that an integrator's error may make of one.
inline void look_beside(HardPoint& h) {
  for (const double by : {0.0, 1e-6, -1e-6, 1e-7, -1e-8})
    for (std::size_t i = 0; i < 2; ++i) {
      State y = h.start;
      y[i] += by;
      const ExactTruth beside = draft_truth(h.at, y, truth_periods, longest_truth);
      h.truth.sensitive |= !same_attractor(h.at, h.truth, beside);
      h.truth.may_be_chaos |= beside.period == 0;
    }
}

}  // namespace hard_points

/// The n-th point of a seed: a pure function of both.
/// Of five, three lie next to folds and flips, one next to a boundary, and one anywhere.
inline HardPoint hard_point(std::uint64_t seed, std::size_t n) {
  using namespace hard_points;
  for (std::uint64_t attempt = 0;; ++attempt) {
    Draws draws(random_bits(seed, 1000 * n + attempt + 1));
    std::optional<HardPoint> h;
    if (n % 5 < 3) {
      h = near_bifurcation(draws);
    } else if (n % 5 == 3) {
      h = near_boundary(draws);
    } else {
      h.emplace();
      h->at = any_point(draws);
      h->start = draws.start();
    }
    if (!h) continue;
    h->truth = truth_of(h->at, h->start);
    if (h->truth.period == 0 && !(h->truth.growth > chaotic_growth)) continue;  // not known
    look_beside(*h);
    return *h;
  }
}

}  // namespace epicyclic::problems
