// The clearance oscillator of known_systems.hpp in closed form: x(t) piece by piece, the crossings by bisection.
//
//   drive, back   x'' + 2 z x' + (x -+ 1) = F + A sin Wt    x = F +- 1 + P cos Wt + Q sin Wt + e^-zt (c1 cos wt + c2
//   sin wt) gap           x'' + 2 z x'            = F + A sin Wt    x = a + F t/2z + P cos Wt + Q sin Wt + b e^-2zt
//
// Exact to rounding of long double as long as no two crossings lie within a thousandth of a forcing period.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace epicyclic::problems {

class ClearanceExact {
 public:
  using Real = long double;

  explicit ClearanceExact(double w, double z = 0.05, double mean = 0.1, double e = 0.05)
      : w_(w), z_(z), mean_(mean), amplitude_(Real(e) * w_ * w_) {}

  /// The state x, dx/dt carried from phase `from` to phase `to` (s = W t).
  [[nodiscard]] std::array<double, 2> evolve(std::array<double, 2> state, double from, double to) const {
    Real t = Real(from) / w_;
    const Real end = Real(to) / w_;
    const Real look = 2 * std::numbers::pi_v<Real> / w_ / 1000;
    State y = {state[0], state[1]};
    int side = side_of(y);
    while (t < end) {
      Real next = std::min(t + look, end);
      const State there = piece(side, t, y, next);
      if (inside(side, there[0])) {
        y = there;
        t = next;
        continue;
      }
      Real low = t;
      for (int k = 0; k < 200 && low < next; ++k) {
        const Real middle = (low + next) / 2;
        if (middle == low || middle == next) break;
        (inside(side, piece(side, t, y, middle)[0]) ? low : next) = middle;
      }
      y = piece(side, t, y, next);
      t = next;
      side = side != 0 ? 0 : y[0] > 0 ? 1 : -1;
    }
    return {static_cast<double>(y[0]), static_cast<double>(y[1])};
  }

  /// Number of forcing periods in [from, to] is not limited; used from a start until transients are gone.
  [[nodiscard]] std::array<double, 2> periods(std::array<double, 2> state, int count) const {
    for (int k = 0; k < count; ++k) state = evolve(state, 0.0, 2.0 * std::numbers::pi);
    return state;
  }

 private:
  using State = std::array<Real, 2>;

  static int side_of(const State& y) { return y[0] > 1 ? 1 : y[0] < -1 ? -1 : 0; }
  static bool inside(int side, Real x) { return side == 0 ? x <= 1 && x >= -1 : side * x >= 1; }

  [[nodiscard]] State piece(int side, Real t0, const State& y0, Real t) const {
    const Real c0 = std::cos(w_ * t0);
    const Real s0 = std::sin(w_ * t0);
    const Real c1 = std::cos(w_ * t);
    const Real s1 = std::sin(w_ * t);
    const Real dt = t - t0;
    if (side == 0) {
      const Real q = -amplitude_ / (w_ * w_ + 4 * z_ * z_);
      const Real p = 2 * z_ * q / w_;
      const Real drift = mean_ / (2 * z_);
      const Real v_h = y0[1] - (drift - p * w_ * s0 + q * w_ * c0);
      const Real decay = std::exp(-2 * z_ * dt);
      const Real x = y0[0] + drift * dt + p * (c1 - c0) + q * (s1 - s0) - v_h / (2 * z_) * std::expm1(-2 * z_ * dt);
      return {x, drift - p * w_ * s1 + q * w_ * c1 + v_h * decay};
    }
    const Real stiff = 1 - w_ * w_;
    const Real d = stiff * stiff + 4 * z_ * z_ * w_ * w_;
    const Real q = amplitude_ * stiff / d;
    const Real p = -2 * z_ * w_ * amplitude_ / d;
    const Real centre = mean_ + side;
    const Real wd = std::sqrt(1 - z_ * z_);
    const Real x_h = y0[0] - (centre + p * c0 + q * s0);
    const Real v_h = y0[1] - (-p * w_ * s0 + q * w_ * c0);
    const Real b = (v_h + z_ * x_h) / wd;
    const Real decay = std::exp(-z_ * dt);
    const Real c = std::cos(wd * dt);
    const Real s = std::sin(wd * dt);
    return {centre + p * c1 + q * s1 + decay * (x_h * c + b * s),
            -p * w_ * s1 + q * w_ * c1 + decay * ((b * wd - z_ * x_h) * c - (x_h * wd + z_ * b) * s)};
  }

  Real w_, z_, mean_, amplitude_;
};

}  // namespace epicyclic::problems
