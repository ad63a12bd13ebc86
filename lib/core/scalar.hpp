// The few functions that a kernel may call on its scalar besides + - * /, so that one text serves every scalar type:
//
//   double, long double   a value
//   Dual<M>               a value and its derivatives along M directions (core/dual.hpp)
//   Lanes<W>              W values side by side, one trajectory each (core/lanes.hpp)
//
// A kernel never branches on a scalar: comparisons give a mask (bool, or one per lane) and select() picks.
#pragma once

#include <cmath>
#include <concepts>

namespace epicyclic {

/// Values of several trajectories side by side (core/lanes.hpp).
template <class T>
inline constexpr bool is_lanes = false;

/// The value without derivatives.
template <std::floating_point T>
[[nodiscard]] constexpr T value_of(T x) {
  return x;
}

/// f(x) with the slope f'(x), of which a scalar without derivatives has no use.
template <std::floating_point T>
[[nodiscard]] constexpr T chained(T /*x*/, T f, T /*slope*/) {
  return f;
}

/// mask ? a : b
template <std::floating_point T>
[[nodiscard]] constexpr T select(bool mask, T a, T b) {
  return mask ? a : b;
}

/// x limited to [low, high].
template <class T>
[[nodiscard]] constexpr T limited(const T& x, const T& low, const T& high) {
  return select(x < low, low, select(x > high, high, x));
}

/// The whole number nearest to x, the even one of two, |x| < 2^51: a double of 2^52 has no room for a fraction.
[[nodiscard]] constexpr double nearest_whole(double x) {
  constexpr double no_fraction = 0x1.8p52;
  return (x + no_fraction) - no_fraction;
}

/// x^(3/2) of x >= 0. Written as one function because x * sqrt(x) has the derivative 0 * infinity at 0.
template <std::floating_point T>
[[nodiscard]] T power_3_2(T x) {
  return x * std::sqrt(x);
}

/// Sine and cosine of one angle.
template <class T>
struct SineCosine {
  T sine, cosine;
};

template <std::floating_point T>
[[nodiscard]] SineCosine<T> sine_cosine(T x) {
  return {std::sin(x), std::cos(x)};
}

using std::sqrt;

}  // namespace epicyclic
