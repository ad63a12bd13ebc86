// The clearance oscillator of known_systems.hpp in closed form: x(t) piece by piece, and the tangents.
//
//   drive, back   x'' + 2 z x' + (x -+ 1) = F + A sin Wt    x = F +- 1 + P cos Wt + Q sin Wt + e^-zt (c1 cos wt + c2
//   sin wt) gap           x'' + 2 z x'            = F + A sin Wt    x = a + F t/2z + P cos Wt + Q sin Wt + b e^-2zt
//
// The force is continuous, so that tangents pass a crossing as they are. Crossings are found between looks, 40 in the
// shorter of a forcing period and 2 pi, and about each extremum between two looks, which two crossings would hide in.
// Exact to rounding as long as no two extrema lie within a look.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace epicyclic::problems {

/// @tparam Real    what it is exact in
/// @tparam Stored  what states are between two calls
template <class Real, class Stored = double>
class BasicClearanceExact {
 public:
  using State = std::array<Stored, 2>;
  /// d state(end) / d state(start), row by row.
  using Matrix = std::array<Stored, 4>;

  explicit BasicClearanceExact(double w, double z = 0.05, double mean = 0.1, double e = 0.05)
      : w_(Real(w)), z_(Real(z)), mean_(Real(mean)), amplitude_(Real(e) * w_ * w_) {}

  /// The state x, dx/dt carried from phase `from` to phase `to` (s = W t).
  /// @param tangents  multiplied from the left; may be null
  [[nodiscard]] State evolve(State state, double from, double to, Matrix* tangents = nullptr) const {
    const Real end = Real(to) / w_;
    const Real length = end - Real(from) / w_;
    const Real look = 2 * std::numbers::pi_v<Real> / std::max(w_, Real(1)) / 40;
    const int looks = static_cast<int>(std::ceil(length / look));
    Piece piece(*this, side_of(state[0]), Real(from) / w_, {Real(state[0]), Real(state[1])});
    Real before = piece.start;  // inside the piece
    Exact there = piece.state;
    for (int k = 1; k <= looks;) {
      const Real next = k == looks ? end : Real(from) / w_ + length * k / looks;
      const Exact ahead = piece.at(next);
      const Real out = leaves(piece, before, there, next, ahead);
      if (out > next) {
        before = next;
        there = ahead;
        ++k;
        continue;
      }
      const Real crossing = crosses(piece, before, out);
      if (tangents != nullptr) piece.carry(crossing, *tangents);
      const Exact y = piece.at(crossing);
      piece = Piece(*this, piece.side != 0 ? 0 : y[0] > 0 ? 1 : -1, crossing, y);
      before = crossing;
      there = y;
      if (crossing >= next) ++k;
    }
    if (tangents != nullptr) piece.carry(end, *tangents);
    return {static_cast<Stored>(there[0]), static_cast<Stored>(there[1])};
  }

  /// Number of forcing periods in [from, to] is not limited; used from a start until transients are gone.
  [[nodiscard]] State periods(State state, int count, Matrix* tangents = nullptr) const {
    for (int k = 0; k < count; ++k) state = evolve(state, 0.0, 2.0 * std::numbers::pi, tangents);
    return state;
  }

 private:
  using Exact = std::array<Real, 2>;

  static int side_of(Real x) { return x > 1 ? 1 : x < -1 ? -1 : 0; }
  static bool inside(int side, Real x) { return side == 0 ? x <= 1 && x >= -1 : side * x >= 1; }

  /// The motion on one side of its kinks, from `start` on.
  struct Piece {
    Piece(const BasicClearanceExact& of, int side_now, Real t, const Exact& y)
        : o(&of), side(side_now), start(t), state(y), c0(std::cos(of.w_ * t)), s0(std::sin(of.w_ * t)) {
      const Real w = o->w_;
      const Real z = o->z_;
      wd = std::sqrt(1 - z * z);
      if (side == 0) {
        q = -o->amplitude_ / (w * w + 4 * z * z);
        p = 2 * z * q / w;
        centre = o->mean_ / (2 * z);  // a drift
        x_h = 0;
        v_h = y[1] - (centre - p * w * s0 + q * w * c0);
      } else {
        const Real stiff = 1 - w * w;
        const Real d = stiff * stiff + 4 * z * z * w * w;
        q = o->amplitude_ * stiff / d;
        p = -2 * z * w * o->amplitude_ / d;
        centre = o->mean_ + side;
        x_h = y[0] - (centre + p * c0 + q * s0);
        v_h = y[1] - (-p * w * s0 + q * w * c0);
      }
    }

    [[nodiscard]] Exact at(Real t) const {
      const Real w = o->w_;
      const Real c1 = std::cos(w * t);
      const Real s1 = std::sin(w * t);
      const auto m = homogeneous(t - start);
      const Exact h = {m[0] * x_h + m[1] * v_h, m[2] * x_h + m[3] * v_h};
      if (side == 0)
        return {state[0] + centre * (t - start) + p * (c1 - c0) + q * (s1 - s0) + h[0],
                centre - p * w * s1 + q * w * c1 + h[1]};
      return {centre + p * c1 + q * s1 + h[0], -p * w * s1 + q * w * c1 + h[1]};
    }

    void carry(Real t, Matrix& tangents) const {
      const auto m = homogeneous(t - start);
      const Matrix v = tangents;
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
          tangents[2 * i + j] = static_cast<Stored>(m[2 * i] * Real(v[j]) + m[2 * i + 1] * Real(v[2 + j]));
    }

    [[nodiscard]] std::array<Real, 4> homogeneous(Real dt) const {
      const Real z = o->z_;
      if (side == 0) {
        const Real lost = std::expm1(-2 * z * dt);
        return {1, -lost / (2 * z), 0, 1 + lost};
      }
      const Real decay = std::exp(-z * dt);
      const Real c = std::cos(wd * dt);
      const Real s = std::sin(wd * dt) / wd;
      return {decay * (c + z * s), decay * s, -decay * s, decay * (c - z * s)};
    }

    const BasicClearanceExact* o;
    int side;
    Real start;
    Exact state;
    Real c0, s0, wd = 0, p = 0, q = 0, centre = 0, x_h = 0, v_h = 0;
  };

  /// A time in (a, b] when the motion is outside its piece; later than b if there is none.
  static Real leaves(const Piece& piece, Real a, const Exact& ya, Real b, const Exact& yb) {
    if (!inside(piece.side, yb[0])) return b;
    if ((ya[1] < 0) == (yb[1] < 0)) return b + 1;
    // Only what turns back before a kink and is near it may have been beyond.
    const bool lowest = ya[1] < 0;
    if (piece.side != 0 && (piece.side > 0) != lowest) return b + 1;
    const Real kink = piece.side != 0 ? piece.side : lowest ? -1 : 1;
    const Real reach = 2 * std::max(std::abs(ya[1]), std::abs(yb[1])) * (b - a);
    if (std::min(std::abs(ya[0] - kink), std::abs(yb[0] - kink)) > reach) return b + 1;
    const Real turn = last_before(a, b, [&](Real t) { return (piece.at(t)[1] < 0) == lowest; });
    return inside(piece.side, piece.at(turn)[0]) ? b + 1 : turn;
  }

  /// When the motion, inside its piece at a and outside at b, leaves it: Newton's method kept between the two.
  static Real crosses(const Piece& piece, Real a, Real b) {
    const Real kink = piece.side != 0 ? piece.side : piece.at(b)[0] > 0 ? 1 : -1;
    const Real rounding = 4 * std::numeric_limits<Real>::epsilon() * (1 + std::abs(b));
    Real t = (a + b) / 2;
    for (int k = 0; k < 200 && b - a > rounding; ++k) {
      const Exact y = piece.at(t);
      (inside(piece.side, y[0]) ? a : b) = t;
      Real next = t - (y[0] - kink) / y[1];
      // The other end comes as near.
      if (std::abs(next - t) <= rounding) next = a == t ? t + rounding : t - rounding;
      t = next > a && next < b ? next : (a + b) / 2;
    }
    return b;
  }

  /// The end, to rounding, of where something holds that does at a and does not at b: the first time it does not.
  template <class F>
  static Real last_before(Real a, Real b, F&& holds) {
    for (int k = 0; k < 200; ++k) {
      const Real middle = (a + b) / 2;
      if (middle == a || middle == b) break;
      (holds(middle) ? a : b) = middle;
    }
    return b;
  }

  Real w_, z_, mean_, amplitude_;
};

using ClearanceExact = BasicClearanceExact<long double>;

}  // namespace epicyclic::problems
