// Systems with two parameters whose loci of special points are known in closed form, all about the motion cos s.
//
// An autonomous system about a forced motion has orbits that are its equilibria, with multipliers exp(2 pi x) of the
// eigenvalues x there. In a frame that makes half a turn a period they are -exp(2 pi x): flips at x = 0.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <type_traits>
#include <vector>

#include "analysis/locus.hpp"
#include "integrate/make_field.hpp"
#include "problems/branches.hpp"

namespace epicyclic::problems {

/// Fields over two parameters.
using FieldPlane = std::function<VectorField(double first, double second)>;

inline analysis::PlaneOfFlows plane_flows(const FieldPlane& fields, double tolerance) {
  return [fields, tolerance](double first, double second) {
    return integrate::make_flow(fields(first, second), exactly(tolerance));
  };
}

/// By a tenth of the tolerance and twice the pieces.
inline std::vector<analysis::LocusRefinement> finer_planes(const FieldPlane& fields, double tolerance) {
  return {{plane_flows(fields, 0.1 * tolerance), 1}, {plane_flows(fields, 0.1 * tolerance), 2}};
}

/// f(p, q, w, dw): dw/ds of the N deviations from (cos s, 0, 0 ...), p with its derivative.
template <std::size_t N, class F>
FieldPlane about_a_forced_motion(F f) {
  return [f](double first, double second) {
    return integrate::make_field_family(N, 2.0 * std::numbers::pi,
                                        [f, second](const auto& p, std::size_t, double s, const auto* y, auto* d) {
                                          using T = std::remove_cvref_t<decltype(d[0])>;
                                          T w[N];
                                          for (std::size_t i = 0; i < N; ++i) w[i] = y[i];
                                          w[0] = w[0] - std::cos(s);
                                          f(p, second, s, w, d);
                                          d[0] = d[0] - std::sin(s);
                                        })(first);
  };
}

/// w' = q + p w - w^3 at the rate 1/10: folds p = 3 w^2, q = -2 w^3, a cusp at (0, 0).
inline FieldPlane cusp_of_folds() {
  return about_a_forced_motion<1>([](const auto& p, double q, double, const auto* w, auto* d) {
    d[0] = 0.1 * (q + p * w[0] - w[0] * w[0] * w[0]);
  });
}

/// a' = b, b' = p + q a + a^2 + a b. Folds at p = q^2 / 4, a = -q / 2, with the second multiplier exp(2 pi a): 1:1 at
/// (0, 0). Neimark-Sacker points at p = 0, q < 0 on a = 0, of the angle 2 pi sqrt(-q): 1:4 at q = -1/16, 1:3 at -1/9,
/// and their end in 1:1 at q = 0.
inline FieldPlane double_one() {
  return about_a_forced_motion<2>([](const auto& p, double q, double, const auto* w, auto* d) {
    d[0] = 1.0 * w[1];
    d[1] = p + q * w[0] + w[0] * w[0] + w[0] * w[1];
  });
}

/// In a frame that makes half a turn a period, v' = (0 1; -p q) v: flips at p = 0, 1:2 there at q = 0. Neimark-Sacker
/// points at q = 0, p > 0, of the angle pi - 2 pi sqrt(p): 1:3 at p = 1/36, 1:4 at 1/16, and their end in 1:2 at p = 0.
/// @param w, d  two components
template <class P, class Q, class T, class D>
void half_turning(const P& p, const Q& q, double s, const T* w, D* d) {
  const double c = std::cos(0.5 * s);
  const double n = std::sin(0.5 * s);
  const D a = c * w[0] + n * w[1];
  const D b = c * w[1] - n * w[0];
  const D da = 1.0 * b;
  const D db = q * b - p * a;
  d[0] = c * da - n * db - 0.5 * w[1];
  d[1] = n * da + c * db + 0.5 * w[0];
}

inline FieldPlane double_minus_one() {
  return about_a_forced_motion<2>(
      [](const auto& p, double q, double s, const auto* w, auto* d) { half_turning(p, q, s, w, d); });
}

/// The same with p and q exchanged, so that the tori are crossed along p.
inline FieldPlane double_minus_one_turned() {
  return about_a_forced_motion<2>(
      [](const auto& p, double q, double s, const auto* w, auto* d) { half_turning(q, p, s, w, d); });
}

/// Folds of cusp_of_folds() beside flips at p = 0.3: fold-flips at p = 0.3, w^2 = 0.1.
inline FieldPlane folds_and_flips() {
  return about_a_forced_motion<3>([](const auto& p, double q, double s, const auto* w, auto* d) {
    d[0] = 0.1 * (q + p * w[0] - w[0] * w[0] * w[0]);
    half_turning(0.3 * (p - 0.3), -0.2, s, w + 1, d + 1);
  });
}

/// Folds of cusp_of_folds() beside tori at p = 0.3.
inline FieldPlane folds_and_tori() {
  return about_a_forced_motion<3>([](const auto& p, double q, double, const auto* w, auto* d) {
    d[0] = 0.1 * (q + p * w[0] - w[0] * w[0] * w[0]);
    d[1] = 0.1 * (p - 0.3) * w[1] - 0.2 * w[2];
    d[2] = 0.2 * w[1] + 0.1 * (p - 0.3) * w[2];
  });
}

/// Flips at p = 0 beside tori at p + q = 0.1.
inline FieldPlane flips_and_tori() {
  return about_a_forced_motion<4>([](const auto& p, double q, double s, const auto* w, auto* d) {
    half_turning(p, -0.3, s, w, d);
    d[2] = (p + q - 0.1) * w[2] - 0.2 * w[3];
    d[3] = 0.2 * w[2] + (p + q - 0.1) * w[3];
  });
}

/// Mathieu's equation w'' + 2 p w' + (q / 4 - cos(s) / 2) w = 0, its parameter q_M = 1: flips cross p = 0 at its
/// characteristic values b1 and a1, each a 1:2, on a closed curve; Neimark-Sacker points lie on p = 0 between a0, a
/// 1:1, and b1, a 1:2.
inline FieldPlane mathieu() {
  return about_a_forced_motion<2>([](const auto& p, double q, double s, const auto* w, auto* d) {
    d[0] = 1.0 * w[1];
    d[1] = -2.0 * p * w[1] - (0.25 * q - 0.5 * std::cos(s)) * w[0];
  });
}

/// Duffing's oscillator over the force, at a frequency; and over the frequency, at a force.
inline FieldPlane duffing_over_force(double damping, double alpha) {
  return [=](double g, double w) { return duffing(damping, alpha, w)(g); };
}
inline FieldPlane duffing_over_frequency(double damping, double alpha) {
  return [=](double w, double g) { return duffing_in_frequency(damping, alpha, g)(w); };
}

/// N alike parts that all move alike, each pulled by what the next one is ahead of the one before. That motion has the
/// multiplier exp(-2 pi) of all parts alike, with N = 2 the other one exp(2 pi (p - r q^2)), with N = 3 the others
/// exp(2 pi (p - r q^2 +- i t q sqrt 3)).
/// @param bend  r
/// @param turn  t
template <std::size_t N>
FieldPlane alike_parts_over(double bend, double turn) {
  return [bend, turn](double first, double second) {
    return integrate::make_field_family(
        N, 2.0 * std::numbers::pi,
        [bend, turn, q = second](const auto& p, std::size_t, double s, const auto* y, auto* d) {
          using T = std::remove_cvref_t<decltype(d[0])>;
          T x[N];
          T sum(0.0);
          for (std::size_t i = 0; i < N; ++i) {
            x[i] = y[i] - std::cos(s);
            sum = sum + x[i];
          }
          const T mean = sum * (1.0 / static_cast<double>(N));
          for (std::size_t i = 0; i < N; ++i)
            d[i] = (p - bend * q * q) * (x[i] - mean) - mean - x[i] * x[i] * x[i] +
                   turn * q * (x[(i + 1) % N] - x[(i + N - 1) % N]) - std::sin(s);
        })(first);
  };
}

/// The clearance oscillator over W and E; exact, its contacts stepped onto.
inline analysis::PlaneOfFlows clearance_plane(double tolerance) {
  return [tolerance](double w, double e) { return clearance_flows(e, tolerance)(w); };
}

}  // namespace epicyclic::problems
