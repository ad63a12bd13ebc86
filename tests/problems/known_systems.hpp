// Vector fields with known answers, for integrators.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <type_traits>

#include "core/dual.hpp"
#include "core/scalar.hpp"
#include "integrate/flow.hpp"
#include "integrate/make_field.hpp"

namespace epicyclic::problems {

/// Four nonlinear equations with explicit time and a known solution: Hairer, Norsett and Wanner, Solving Ordinary
/// Differential Equations I, exercise on y_1' = 2 s y_2^(1/5) y_4 ...
inline VectorField smooth_nonlinear() {
  return integrate::make_field(4, 0.0, [](std::size_t, double s, const auto* y, auto* d) {
    using std::exp;
    using std::log;
    using std::pow;
    d[0] = 2.0 * s * pow(y[1], 0.2) * y[3];
    d[1] = 10.0 * s * exp(5.0 * (y[2] - 1.0)) * y[3];
    d[2] = 2.0 * s * y[3];
    d[3] = -2.0 * s * log(y[0]);
  });
}

inline std::array<double, 4> smooth_nonlinear_solution(double s) {
  const double sine = std::sin(s * s);
  return {std::exp(sine), std::exp(5.0 * sine), sine + 1.0, std::cos(s * s)};
}

/// y' = -2 s y^(3/2), y = 4 / (2 + s^2)^2: slow enough for pairs of high order to show it above rounding.
inline VectorField smooth_bell() {
  return integrate::make_field(
      1, 0.0, [](std::size_t, double s, const auto* y, auto* d) { d[0] = -2.0 * s * power_3_2(y[0]); });
}

inline double smooth_bell_solution(double s) { return 4.0 / ((2.0 + s * s) * (2.0 + s * s)); }

/// y' = cos^3 s - y^3 - sin s, y = cos s: smooth, nonlinear and damped, for as long as one likes.
inline VectorField smooth_follower() {
  return integrate::make_field(1, 0.0, [](std::size_t, double s, const auto* y, auto* d) {
    const double c = std::cos(s);
    d[0] = c * c * c - y[0] * y[0] * y[0] - std::sin(s);
  });
}

/// y' = -y^2 / 5 + c_k (1 + s), c = +1, -2, 0.5 on three segments of the period 1: jumps at 0, 0.3 and 0.7124.
inline VectorField jumping(bool declared) {
  constexpr std::array<double, 3> at = {0.0, 0.3, 0.7124};
  const auto slope = [c = std::array<double, 3>{1.0, -2.0, 0.5}](std::size_t k, double s, const auto* y, auto* d) {
    d[0] = -0.2 * y[0] * y[0] + c[k] * (1.0 + std::sin(2.0 * std::numbers::pi * s));
  };
  if (declared) {
    VectorField f = integrate::make_field(1, 1.0, slope);
    f.breakpoints.assign(at.begin(), at.end());
    return f;
  }
  return integrate::make_field(1, 1.0, [slope, at](std::size_t, double s, const auto* y, auto* d) {
    const double phase = s - std::floor(s);
    slope(phase < at[1] ? 0 : phase < at[2] ? 1 : 2, s, y, d);
  });
}

/// Lorenz's equations at 10, r, 8/3; without a period. Divergence -41/3 everywhere.
inline VectorField lorenz(double r = 28.0) {
  return integrate::make_field(3, 0.0, [r](std::size_t, double, const auto* y, auto* d) {
    d[0] = 10.0 * (y[1] - y[0]);
    d[1] = y[0] * (r - y[2]) - y[1];
    d[2] = y[0] * y[1] - 8.0 / 3.0 * y[2];
  });
}

/// Roessler's equations at 0.2, 0.2, 5.7; without a period. Divergence x - 5.5.
inline VectorField roessler() {
  return integrate::make_field(3, 0.0, [](std::size_t, double, const auto* y, auto* d) {
    d[0] = -1.0 * y[1] - y[2];
    d[1] = y[0] + 0.2 * y[1];
    d[2] = 0.2 + y[2] * (y[0] - 5.7);
  });
}

/// Van der Pol's oscillator forced at W, x'' - mu (1 - x^2) x' + x = F cos W t, in s = W t; state x, dx/dt. Far from
/// W = 1 and its multiples, and F small, its motion is a torus.
inline VectorField van_der_pol(double mu, double f, double w) {
  return integrate::make_field(2, 2.0 * std::numbers::pi, [mu, f, w](std::size_t, double s, const auto* y, auto* d) {
    d[0] = y[1] / w;
    d[1] = (mu * (1.0 - y[0] * y[0]) * y[1] - y[0] + f * std::cos(s)) / w;
  });
}

struct ClearanceConstants {
  double z = 0.05;
  double mean = 0.1;  ///< F_m
  double e = 0.05;
};

/// The gear clearance oscillator of docs/theory/published_results.md, section 4,
///   x'' + 2 z x' + f(x) = F_m + E W^2 sin W t , half gap 1, f exact or of width `smoothing`,
/// in s = W t. State x, dx/dt. Its parameter is W.
inline VectorField clearance_oscillator(double w, double smoothing = 0.0, const ClearanceConstants& constants = {}) {
  const auto equation = [smoothing, constants](const auto& omega, double s, const auto& x, const auto& v) {
    using T = std::remove_cvref_t<decltype(x)>;
    using std::sqrt;
    const T below = x - 1.0;
    const T above = x + 1.0;
    const T exact = select(x > T(1.0), below, select(x < T(-1.0), above, T(0.0)));
    const double w2 = smoothing * smoothing;
    const T f = smoothing > 0.0 ? T(x + 0.5 * (sqrt(below * below + w2) - sqrt(above * above + w2))) : exact;
    const auto& [z, mean, e] = constants;
    return (mean + e * omega * omega * std::sin(s) - 2.0 * z * v - f) / omega;
  };
  const FieldFamily family = integrate::make_field_family(
      2, 2.0 * std::numbers::pi, [equation](const auto& omega, std::size_t, double s, const auto* y, auto* d) {
        d[0] = y[1] / omega;
        d[1] = equation(omega, s, y[0], y[1]);
      });
  VectorField field = family(w);
  field.surfaces = {2, [w](double, const double* y, double* values, double* rates) {
                      values[0] = y[0] - 1.0;
                      values[1] = y[0] + 1.0;
                      rates[0] = rates[1] = y[1] / w;
                    }};
  return field;
}

/// Duffing x'' + damping x' + alpha x + x^3 = g cos W t (docs/theory/published_results.md, sections 3 and 4) in t,
/// period 2 pi / W. State x, dx/dt. Its parameter is g.
inline FieldFamily duffing(double damping, double alpha, double w) {
  return integrate::make_field_family(
      2, 2.0 * std::numbers::pi / w, [damping, alpha, w](const auto& g, std::size_t, double t, const auto* y, auto* d) {
        d[0] = y[1];
        d[1] = g * std::cos(w * t) - damping * y[1] - alpha * y[0] - y[0] * y[0] * y[0];
      });
}
inline VectorField duffing(double damping, double alpha, double g, double w) { return duffing(damping, alpha, w)(g); }

/// Duffing x'' + damping x' + alpha x + x^3 = g cos s in s = W t. State x, dx/dt. Its parameter is W.
inline FieldFamily duffing_in_frequency(double damping, double alpha, double g) {
  return integrate::make_field_family(
      2, 2.0 * std::numbers::pi, [damping, alpha, g](const auto& w, std::size_t, double s, const auto* y, auto* d) {
        d[0] = y[1] / w;
        d[1] = (g * std::cos(s) - damping * y[1] - alpha * y[0] - y[0] * y[0] * y[0]) / w;
      });
}

/// The normal form of a Hopf bifurcation, z' = (p + i w) z - |z|^2 z, about a forced motion: z = y - (cos s, sin s).
/// The orbit (cos s, sin s) of period 2 pi has the multipliers exp(2 pi (p +- i w)): Neimark-Sacker at p = 0 exactly.
/// Its parameter is p.
inline FieldFamily forced_hopf(double w) {
  return integrate::make_field_family(2, 2.0 * std::numbers::pi,
                                      [w](const auto& p, std::size_t, double s, const auto* y, auto* d) {
                                        using T = std::remove_cvref_t<decltype(d[0])>;
                                        const T a = y[0] - std::cos(s);
                                        const T b = y[1] - std::sin(s);
                                        const T r2 = a * a + b * b;
                                        d[0] = p * a - w * b - r2 * a - std::sin(s);
                                        d[1] = w * a + p * b - r2 * b + std::cos(s);
                                      });
}

/// N alike parts, y_i' = p w_i - (p + 1) mean(w) - w_i^3 - sin s about the motion w_i = y_i - cos s = 0. That orbit has
/// the multiplier exp(-2 pi) of all parts alike and N - 1 times exp(2 pi p): a pitchfork of all others at p = 0
/// exactly, that breaks the symmetry. Its parameter is p.
template <std::size_t N>
FieldFamily alike_parts() {
  return integrate::make_field_family(N, 2.0 * std::numbers::pi,
                                      [](const auto& p, std::size_t, double s, const auto* y, auto* d) {
                                        using T = std::remove_cvref_t<decltype(d[0])>;
                                        T sum(0.0);
                                        for (std::size_t i = 0; i < N; ++i) sum = sum + (y[i] - std::cos(s));
                                        const T mean = sum * (1.0 / static_cast<double>(N));
                                        for (std::size_t i = 0; i < N; ++i) {
                                          const T w = y[i] - std::cos(s);
                                          d[i] = p * w - (p + 1.0) * mean - w * w * w - std::sin(s);
                                        }
                                      });
}

/// w' = (1 - w^2 - p^2) / 10 about the motion y = cos s + w: orbits w^2 + p^2 = 1, a closed branch with folds at p = -1
/// and 1 and the multiplier exp(-0.4 pi w). Its parameter is p.
inline FieldFamily closed_branch() {
  return integrate::make_field_family(1, 2.0 * std::numbers::pi,
                                      [](const auto& p, std::size_t, double s, const auto* y, auto* d) {
                                        using T = std::remove_cvref_t<decltype(d[0])>;
                                        const T w = y[0] - std::cos(s);
                                        d[0] = 0.1 * (1.0 - w * w - p * p) - std::sin(s);
                                      });
}

}  // namespace epicyclic::problems
