// Oscillators on nothing but each other, which turn freely as a whole.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>

#include "core/scalar.hpp"
#include "integrate/make_field.hpp"
#include "integrate/make_flow.hpp"
#include "problems/branches.hpp"

namespace epicyclic::problems {

/// Two bodies of mass 1 with the clearance f between them, in s = W t,
///   x_1'' = -f(x_1 - x_2) / 2 - c (v_1 - v_2) - d v_1 + T_1 + E W^2 sin s
///   x_2'' = +f(x_1 - x_2) / 2 + c (v_1 - v_2) - d v_2 - T_2
/// so that r = x_1 - x_2 is that of clearance_oscillator() with 2 z = 2 c + d and F_m = T_1 + T_2, and v_1 + v_2 goes
/// to a drift of (T_1 - T_2) / d by a multiplier exp(-2 pi d / W), whatever r does. State x_1, x_2, v_1, v_2; its
/// parameter is W.
inline VectorField free_pair(double w, double e, double drift) {
  constexpr double d = 0.04, c = 0.03, sum = 0.1;
  const double first = 0.5 * (sum + drift * d), second = 0.5 * (sum - drift * d);
  const FieldFamily family = integrate::make_field_family(
      4, 2.0 * std::numbers::pi, [=](const auto& omega, std::size_t, double s, const auto* y, auto* dy) {
        using T = std::remove_cvref_t<decltype(dy[0])>;
        const T r = y[0] - y[1];
        const T v = y[2] - y[3];
        const T f = select(r > T(1.0), r - 1.0, select(r < T(-1.0), r + 1.0, T(0.0)));
        const T between = 0.5 * f + c * v;
        dy[0] = y[2] / omega;
        dy[1] = y[3] / omega;
        dy[2] = (first + e * omega * omega * std::sin(s) - between - d * y[2]) / omega;
        dy[3] = (between - d * y[3] - second) / omega;
      });
  VectorField field = family(w);
  field.surfaces = {2, [w](double, const double* y, double* values, double* rates) {
                      values[0] = y[0] - y[1] - 1.0;
                      values[1] = y[0] - y[1] + 1.0;
                      rates[0] = rates[1] = (y[2] - y[3]) / w;
                    }};
  return field;
}

inline integrate::FlowFamily free_pair_flows(double e, double drift, double tolerance) {
  integrate::IntegratorOptions o = exactly(tolerance);
  o.locate_contacts = true;
  return integrate::make_flow_family([e, drift](double w) { return free_pair(w, e, drift); }, o);
}

/// Three alike bodies in a ring, x_i'' = sum_j (-p r + r^3) - d v_i + T + sin s / 2 with r = x_j - x_i. They move as
/// one, drifting by T / d, with the multipliers exp(2 pi mu): mu = -d of all alike, and twice the roots of
/// mu^2 + d mu - 3 p = 0 of those that part, a pitchfork at p = 0 exactly. State x_1 ... x_3, v_1 ... v_3; its
/// parameter is p.
inline FieldFamily free_ring(double d, double t) {
  return integrate::make_field_family(6, 2.0 * std::numbers::pi,
                                      [d, t](const auto& p, std::size_t, double s, const auto* y, auto* dy) {
                                        using T = std::remove_cvref_t<decltype(dy[0])>;
                                        for (std::size_t i = 0; i < 3; ++i) {
                                          T force = T(t + 0.5 * std::sin(s)) - d * y[3 + i];
                                          for (std::size_t k = 1; k < 3; ++k) {
                                            const T r = y[(i + k) % 3] - y[i];
                                            force = force - p * r + r * r * r;
                                          }
                                          dy[i] = y[3 + i];
                                          dy[3 + i] = force;
                                        }
                                      });
}

}  // namespace epicyclic::problems
