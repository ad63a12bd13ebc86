// Dual numbers: a value with its derivatives along M directions.
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
#include <utility>

#include "core/scalar.hpp"

namespace epicyclic {

/// f(0), ..., f(M - 1), each with a constant: the compiler keeps derivatives in registers only if it sees no loop.
template <std::size_t M, class F>
constexpr void directions(const F& f) {
  [&]<std::size_t... J>(std::index_sequence<J...>) { (f(J), ...); }
  (std::make_index_sequence<M>());
}

/// Value and M derivatives. Converts from double as a constant.
template <std::size_t M>
struct Dual {
  double value = 0;
  std::array<double, M> derivative{};

  constexpr Dual() = default;
  constexpr Dual(double v) : value(v) {}  // NOLINT(google-explicit-constructor): a constant is a dual number

  /// The variable of direction j.
  [[nodiscard]] static constexpr Dual variable(double v, std::size_t j) {
    Dual x(v);
    x.derivative[j] = 1.0;
    return x;
  }

  /// Chain rule: f(value) with the slope f'(value).
  [[nodiscard]] constexpr Dual chained(double f, double slope) const {
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
    const double inverse = 1.0 / b.value;
    value /= b.value;  // not times the inverse: values are those of the same text on doubles, to the last bit
    directions<M>([&](std::size_t j) { derivative[j] = (derivative[j] - value * b.derivative[j]) * inverse; });
    return *this;
  }

  // With a constant the derivatives of the constant are not multiplied out: half of a product's operations.
  constexpr Dual& operator+=(double b) {
    value += b;
    return *this;
  }
  constexpr Dual& operator-=(double b) {
    value -= b;
    return *this;
  }
  constexpr Dual& operator*=(double b) {
    directions<M>([&](std::size_t j) { derivative[j] *= b; });
    value *= b;
    return *this;
  }
  constexpr Dual& operator/=(double b) {
    const double inverse = 1.0 / b;
    directions<M>([&](std::size_t j) { derivative[j] *= inverse; });
    value /= b;
    return *this;
  }

  friend constexpr Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend constexpr Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend constexpr Dual operator*(Dual a, const Dual& b) { return a *= b; }
  friend constexpr Dual operator/(Dual a, const Dual& b) { return a /= b; }
  friend constexpr Dual operator+(Dual a, double b) { return a += b; }
  friend constexpr Dual operator-(Dual a, double b) { return a -= b; }
  friend constexpr Dual operator*(Dual a, double b) { return a *= b; }
  friend constexpr Dual operator/(Dual a, double b) { return a /= b; }
  friend constexpr Dual operator+(double a, Dual b) { return b += a; }
  friend constexpr Dual operator-(double a, const Dual& b) { return -b + a; }
  friend constexpr Dual operator*(double a, Dual b) { return b *= a; }
  friend constexpr Dual operator/(double a, const Dual& b) { return Dual(a) /= b; }
  friend constexpr Dual operator-(const Dual& a) { return a.chained(-a.value, -1.0); }

  friend constexpr bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend constexpr bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
};

template <class T>
inline constexpr bool is_dual = false;
template <std::size_t M>
inline constexpr bool is_dual<Dual<M>> = true;

template <std::size_t M>
[[nodiscard]] constexpr double value_of(const Dual<M>& x) {
  return x.value;
}

template <std::size_t M>
[[nodiscard]] constexpr Dual<M> chained(const Dual<M>& x, double f, double slope) {
  return x.chained(f, slope);
}

template <std::size_t M>
[[nodiscard]] constexpr Dual<M> select(bool mask, const Dual<M>& a, const Dual<M>& b) {
  return mask ? a : b;
}

template <std::size_t M>
[[nodiscard]] Dual<M> sqrt(const Dual<M>& x) {
  const double root = std::sqrt(x.value);
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

template <std::size_t M>
[[nodiscard]] Dual<M> power_3_2(const Dual<M>& x) {
  const double root = std::sqrt(x.value);
  return x.chained(x.value * root, 1.5 * root);
}

template <std::size_t M>
[[nodiscard]] SineCosine<Dual<M>> sine_cosine(const Dual<M>& x) {
  const double s = std::sin(x.value);
  const double c = std::cos(x.value);
  return {x.chained(s, c), x.chained(c, -s)};
}

}  // namespace epicyclic
