// Vector fields with known answers, for integrators.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "integrate/flow.hpp"

namespace epicyclic::problems {

/// Four nonlinear equations with explicit time and a known solution: Hairer, Norsett and Wanner, Solving Ordinary
/// Differential Equations I, exercise on y_1' = 2 s y_2^(1/5) y_4 ...
inline integrate::VectorField smooth_nonlinear() {
  integrate::VectorField f;
  f.dimension = 4;
  f.right_hand_side = [](std::size_t, double s, const double* y, double* d) {
    d[0] = 2.0 * s * std::pow(y[1], 0.2) * y[3];
    d[1] = 10.0 * s * std::exp(5.0 * (y[2] - 1.0)) * y[3];
    d[2] = 2.0 * s * y[3];
    d[3] = -2.0 * s * std::log(y[0]);
  };
  return f;
}

inline std::array<double, 4> smooth_nonlinear_solution(double s) {
  const double sine = std::sin(s * s);
  return {std::exp(sine), std::exp(5.0 * sine), sine + 1.0, std::cos(s * s)};
}

/// y' = -2 s y^(3/2), y = 4 / (2 + s^2)^2: slow enough for pairs of high order to show it above rounding.
inline integrate::VectorField smooth_bell() {
  integrate::VectorField f;
  f.dimension = 1;
  f.right_hand_side = [](std::size_t, double s, const double* y, double* d) {
    d[0] = -2.0 * s * y[0] * std::sqrt(y[0]);
  };
  return f;
}

inline double smooth_bell_solution(double s) { return 4.0 / ((2.0 + s * s) * (2.0 + s * s)); }

/// y' = -y^2 / 5 + c_k (1 + s), c = +1, -2, 0.5 on three segments of the period 1: jumps at 0, 0.3 and 0.7124.
inline integrate::VectorField jumping(bool declared) {
  integrate::VectorField f;
  f.dimension = 1;
  f.period = 1.0;
  static constexpr std::array<double, 3> at = {0.0, 0.3, 0.7124};
  static constexpr std::array<double, 3> c = {1.0, -2.0, 0.5};
  const auto slope = [](std::size_t k, double s, const double* y, double* d) {
    d[0] = -0.2 * y[0] * y[0] + c[k] * (1.0 + std::sin(2.0 * std::numbers::pi * s));
  };
  if (declared) {
    f.breakpoints.assign(at.begin(), at.end());
    f.right_hand_side = slope;
  } else {
    f.right_hand_side = [slope](std::size_t, double s, const double* y, double* d) {
      const double phase = s - std::floor(s);
      slope(phase < at[1] ? 0 : phase < at[2] ? 1 : 2, s, y, d);
    };
  }
  return f;
}

/// x'' + 2 z x' + f(x) = F_m + E W^2 sin W t, half gap 1, in s = W t: the gear clearance oscillator of validation.md
/// section 4. State x, dx/dt.
inline integrate::VectorField clearance_oscillator(double w) {
  integrate::VectorField f;
  f.dimension = 2;
  f.period = 2.0 * std::numbers::pi;
  f.right_hand_side = [w](std::size_t, double s, const double* y, double* d) {
    constexpr double z = 0.05;
    constexpr double mean = 0.1;
    constexpr double e = 0.05;
    const double gap = y[0] > 1.0 ? y[0] - 1.0 : y[0] < -1.0 ? y[0] + 1.0 : 0.0;
    d[0] = y[1] / w;
    d[1] = (mean + e * w * w * std::sin(s) - 2.0 * z * y[1] - gap) / w;
  };
  return f;
}

}  // namespace epicyclic::problems
