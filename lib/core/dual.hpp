// Dual numbers: a value with its derivatives along M directions, each of them a plain number or lanes of numbers.
//
//   x = a + sum_j a_j eps_j ,  eps_i eps_j = 0   =>   f(x) = f(a) + f'(a) sum_j a_j eps_j
//
// Seed eps_j with the j-th unit vector and a function evaluates its own Jacobian; seed it with a tangent vector and the
// function evaluates a directional derivative. Exact to rounding: nothing is differenced.
//
// Smoothness: select() follows the branch that the value takes, so a kink has the one-sided derivative of that branch.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "core/scalar.hpp"

namespace epicyclic {

/// f(0), ..., f(M - 1), each with a constant: the compiler keeps derivatives in registers only if it sees no loop.
template <std::size_t M, class F>
constexpr void directions(const F& f) {
  [&]<std::size_t... J>(std::index_sequence<J...>) { (f(J), ...); }
  (std::make_index_sequence<M>());
}

/// Value and M derivatives. Converts from a value, and from double, as a constant.
/// @tparam V  double, or Lanes: each lane then has a value of its own, and its own derivatives
template <std::size_t M, class V = double>
struct Dual {
  /// What has no derivatives.
  template <class B>
  static constexpr bool constant = std::is_same_v<B, V> || std::is_arithmetic_v<B>;

  V value;
  std::array<V, M> derivative;

  constexpr Dual() requires(std::is_same_v<V, double>) : value(0.0), derivative{} {}
  Dual() requires(!std::is_same_v<V, double>) = default;  // not set to anything, as lanes are not
  constexpr Dual(V v) : value(v) {  // NOLINT(google-explicit-constructor): a constant is a dual number
    derivative.fill(V(0.0));
  }
  constexpr Dual(double v) requires(!std::is_same_v<V, double>)  // NOLINT(google-explicit-constructor)
      : Dual(V(v)) {}

  /// The variable of direction j.
  [[nodiscard]] static constexpr Dual variable(V v, std::size_t j) {
    Dual x(v);
    x.derivative[j] = 1.0;
    return x;
  }

  /// Chain rule: f(value) with the slope f'(value).
  [[nodiscard]] constexpr Dual chained(const V& f, const V& slope) const {
    Dual r(f);
    directions<M>([&](std::size_t j) { r.derivative[j] = slope * derivative[j]; });
    return r;
  }

  constexpr Dual& operator+=(const Dual& b) {
    value += b.value;
    directions<M>([&](std::size_t j) { derivative[j] += b.derivative[j]; });
    return *this;
  }
  constexpr Dual& operator-=(const Dual& b) {
    value -= b.value;
    directions<M>([&](std::size_t j) { derivative[j] -= b.derivative[j]; });
    return *this;
  }
  constexpr Dual& operator*=(const Dual& b) {
    directions<M>([&](std::size_t j) { derivative[j] = derivative[j] * b.value + value * b.derivative[j]; });
    value *= b.value;
    return *this;
  }
  constexpr Dual& operator/=(const Dual& b) {
    const V inverse = 1.0 / b.value;
    value /= b.value;  // not times the inverse: values are those of the same text on doubles, to the last bit
    directions<M>([&](std::size_t j) { derivative[j] = (derivative[j] - value * b.derivative[j]) * inverse; });
    return *this;
  }

  // With a constant the derivatives of the constant are not multiplied out: half of a product's operations.
  template <class B>
  constexpr Dual& operator+=(B b) requires(constant<B>) {
    value += b;
    return *this;
  }
  template <class B>
  constexpr Dual& operator-=(B b) requires(constant<B>) {
    value -= b;
    return *this;
  }
  template <class B>
  constexpr Dual& operator*=(B b) requires(constant<B>) {
    value *= b;
    directions<M>([&](std::size_t j) { derivative[j] *= b; });
    return *this;
  }
  template <class B>
  constexpr Dual& operator/=(B b) requires(constant<B>) {
    const V inverse = 1.0 / V(b);
    directions<M>([&](std::size_t j) { derivative[j] *= inverse; });
    value /= b;
    return *this;
  }

  friend constexpr Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend constexpr Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend constexpr Dual operator*(Dual a, const Dual& b) { return a *= b; }
  friend constexpr Dual operator/(Dual a, const Dual& b) { return a /= b; }
  template <class B>
  friend constexpr Dual operator+(Dual a, B b) requires(constant<B>) {
    return a += b;
  }
  template <class B>
  friend constexpr Dual operator-(Dual a, B b) requires(constant<B>) {
    return a -= b;
  }
  template <class B>
  friend constexpr Dual operator*(Dual a, B b) requires(constant<B>) {
    return a *= b;
  }
  template <class B>
  friend constexpr Dual operator/(Dual a, B b) requires(constant<B>) {
    return a /= b;
  }
  template <class A>
  friend constexpr Dual operator+(A a, Dual b) requires(constant<A>) {
    return b += a;
  }
  template <class A>
  friend constexpr Dual operator-(A a, const Dual& b) requires(constant<A>) {
    return -b + a;
  }
  template <class A>
  friend constexpr Dual operator*(A a, Dual b) requires(constant<A>) {
    return b *= a;
  }
  template <class A>
  friend constexpr Dual operator/(A a, const Dual& b) requires(constant<A>) {
    return Dual(a) /= b;
  }
  friend constexpr Dual operator-(const Dual& a) { return a.chained(-a.value, -1.0); }

  friend constexpr auto operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend constexpr auto operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
};

/// M of a dual number; 0 of any other.
template <class T>
inline constexpr std::size_t directions_of = 0;
template <std::size_t M, class V>
inline constexpr std::size_t directions_of<Dual<M, V>> = M;
template <class T>
inline constexpr bool is_dual = directions_of<T> > 0;
template <std::size_t M, class V>
inline constexpr bool is_lanes<Dual<M, V>> = is_lanes<V>;

template <std::size_t M, class V>
[[nodiscard]] constexpr const V& value_of(const Dual<M, V>& x) {
  return x.value;
}

template <std::size_t M, class V>
[[nodiscard]] constexpr Dual<M, V> chained(const Dual<M, V>& x, const V& f, const V& slope) {
  return x.chained(f, slope);
}

/// @param mask  what a comparison gives
template <std::size_t M, class V, class Mask>
[[nodiscard]] constexpr Dual<M, V> select(const Mask& mask, const Dual<M, V>& a, const Dual<M, V>& b) {
  if constexpr (std::is_same_v<Mask, bool>) {
    return mask ? a : b;
  } else {
    Dual<M, V> r(select(mask, a.value, b.value));
    directions<M>([&](std::size_t j) { r.derivative[j] = select(mask, a.derivative[j], b.derivative[j]); });
    return r;
  }
}

template <std::size_t M, class V>
[[nodiscard]] Dual<M, V> sqrt(const Dual<M, V>& x) {
  using std::sqrt;
  const V root = sqrt(x.value);
  return x.chained(root, 0.5 / root);
}

template <std::size_t M>
[[nodiscard]] Dual<M> exp(const Dual<M>& x) {
  const double e = std::exp(x.value);
  return x.chained(e, e);
}

template <std::size_t M>
[[nodiscard]] Dual<M> log(const Dual<M>& x) {
  return x.chained(std::log(x.value), 1.0 / x.value);
}

template <std::size_t M>
[[nodiscard]] Dual<M> sin(const Dual<M>& x) {
  return x.chained(std::sin(x.value), std::cos(x.value));
}

template <std::size_t M>
[[nodiscard]] Dual<M> cos(const Dual<M>& x) {
  return x.chained(std::cos(x.value), -std::sin(x.value));
}

/// x^p of x > 0.
template <std::size_t M>
[[nodiscard]] Dual<M> pow(const Dual<M>& x, double p) {
  const double power = std::pow(x.value, p);
  return x.chained(power, p * power / x.value);
}

template <std::size_t M, class V>
[[nodiscard]] Dual<M, V> power_3_2(const Dual<M, V>& x) {
  using std::sqrt;
  const V root = sqrt(x.value);
  return x.chained(x.value * root, 1.5 * root);
}

template <std::size_t M>
[[nodiscard]] SineCosine<Dual<M>> sine_cosine(const Dual<M>& x) {
  const double s = std::sin(x.value);
  const double c = std::cos(x.value);
  return {x.chained(s, c), x.chained(c, -s)};
}

}  // namespace epicyclic
