// What the mesh phase alone decides of the stage: errors, stiffness and friction of the meshes, before any state is
// known.
//
//   e_i = sum_h [a_hi cos h s + b_hi sin h s] + e_0,i ,  e_i' = Omega sum_h h [b_hi cos h s - a_hi sin h s]   [M-e]
//   and terms in s / teeth with a member's rotation                                                       [M-shaft]
//   k_i(s), A_i(s), B_i(s)  by harmonics or tables on the mesh's own phase s / 2 pi + turns_i                 [M-27]
//   e(s), e' = Omega de/ds  by a table, added to the harmonics                                           [M-e-curve]
//
// The slopes of a Runge-Kutta step are taken at phases that are known when the step begins; lanes make their
// coefficients all at once, because this is mostly waiting for one's own results.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <type_traits>

#include "core/row.hpp"
#include "core/scalar.hpp"
#include "model/layout.hpp"
#include "model/parameters.hpp"

namespace epicyclic::model {

/// cos h s and sin h s, h = 1 ... H, by the angle-addition theorem.
template <class T>
struct HarmonicBasis {
  std::array<T, gear::harmonics_max> cosine, sine;

  HarmonicBasis(const SineCosine<T>& first, std::size_t harmonics) {
    cosine[0] = first.cosine;
    sine[0] = first.sine;
    for (std::size_t h = 1; h < harmonics; ++h) {
      cosine[h] = cosine[h - 1] * first.cosine - sine[h - 1] * first.sine;
      sine[h] = sine[h - 1] * first.cosine + cosine[h - 1] * first.sine;
    }
  }
};

/// Of one kind of mesh.
template <class P, std::size_t N>
struct MeshCoefficients {
  Row<P, N> error, error_rate;                        ///< e, e' [b_c, b_c per tau]
  Row<P, N> stiffness;                                ///< k_i(s)
  Row<P, N> friction, moment_driving, moment_driven;  ///< A, B_1 / r_b1, B_2 / r_b2; only with friction
  /// Planets that mesh in phase have one stiffness and one friction, and lanes take them once, as those of planet 0.
  /// This saves nothing if one register holds all planets. If constants have derivatives, the values are each planet's
  /// own.
  bool shared = false;

  MeshCoefficients() = default;

  /// What harmonics decide.
  MeshCoefficients(const Parameters<P, N>& p, const MeshParameters<P, N>& mesh, const HarmonicBasis<P>& basis)
      : error(mesh.error_cos * basis.cosine[0] + mesh.error_sin * basis.sine[0] + mesh.error_mean),
        error_rate(p.omega * (mesh.error_sin * basis.cosine[0] - mesh.error_cos * basis.sine[0])),
        shared(is_lanes<P> && mesh.in_phase) {
    for (std::size_t h = 1; h <= mesh.further_error_cos.size(); ++h) {
      const Row<P, N>& a = mesh.further_error_cos[h - 1];
      const Row<P, N>& b = mesh.further_error_sin[h - 1];
      error += a * basis.cosine[h] + b * basis.sine[h];
      error_rate += static_cast<double>(h + 1) * p.omega * (b * basis.cosine[h] - a * basis.sine[h]);
    }
    if (mesh.stiffness_curve) return;
    if (is_lanes<P> && shared) {
      P k = mesh.stiffness;
      for (std::size_t h = 0; h < mesh.harmonics; ++h)
        k += mesh.stiffness_cos[h][0] * basis.cosine[h] + mesh.stiffness_sin[h][0] * basis.sine[h];
      stiffness.set(0, k);
    } else {
      stiffness = mesh.stiffness;
      for (std::size_t h = 0; h < mesh.harmonics; ++h)
        stiffness += mesh.stiffness_cos[h] * basis.cosine[h] + mesh.stiffness_sin[h] * basis.sine[h];
    }
  }

  /// What rotations of the members add [M-shaft].
  void add_shaft_errors(const P& omega, const MeshParameters<P, N>& mesh, const P& s) {
    for (const ShaftErrors<P, N>& shaft : mesh.shafts) {
      const std::size_t harmonics = shaft.cosine.size();
      const HarmonicBasis<P> rotation(sine_cosine(shaft.order * s), harmonics);
      P rate = P(0.0);
      for (std::size_t h = 0; h < harmonics; ++h) {
        rate += omega * shaft.order;
        error += shaft.cosine[h] * rotation.cosine[h] + shaft.sine[h] * rotation.sine[h];
        error_rate += rate * (shaft.sine[h] * rotation.cosine[h] - shaft.cosine[h] * rotation.sine[h]);
      }
    }
  }

  /// Adds the value of the table of the error, e and de/ds.
  template <class R>
  void add_error(std::size_t planet, const R& values, const P& omega) {
    error.set(planet, error[planet] + values[0]);
    error_rate.set(planet, error_rate[planet] + omega * values[1]);
  }

  /// What the table of the error does.
  /// @param places  those of the current segment
  void interpolate_error(const P& omega, const MeshParameters<P, N>& mesh, const MeshPlaces<N>& places, const P& s) {
    if (mesh.error_curve)
      for (std::size_t i = 0; i < N; ++i)
        add_error(i, mesh.error_curve->at(places.error[i], s * (0.5 * std::numbers::inv_pi) + mesh.phase_cycles[i]),
                  omega);
  }

  /// What all tables do; of lanes model/kernels/lane_phase_coefficients.hpp.
  void interpolate(const P& omega, const MeshParameters<P, N>& mesh, const MeshPlaces<N>& places, const P& s) {
    const auto own_phase = [&](std::size_t i) { return s * (0.5 * std::numbers::inv_pi) + mesh.phase_cycles[i]; };
    interpolate_error(omega, mesh, places, s);
    if (mesh.stiffness_curve)
      stiffness =
          Row<P, N>::of([&](std::size_t i) { return mesh.stiffness_curve->at(places.stiffness[i], own_phase(i))[0]; });
    if (mesh.friction) {
      std::array<FrictionRatios<P>, N> ratios;
      for (std::size_t i = 0; i < N; ++i) ratios[i] = mesh.friction->at(places.friction[i], own_phase(i));
      friction = Row<P, N>::of([&](std::size_t i) { return ratios[i].force; });
      moment_driving = Row<P, N>::of([&](std::size_t i) { return ratios[i].moment_driving; });
      moment_driven = Row<P, N>::of([&](std::size_t i) { return ratios[i].moment_driven; });
    }
  }

  /// Deflection of some planets' meshes, given their displacements along the line of action, and its rate.
  template <std::size_t G, class T>
  [[nodiscard]] Row<T, G> delta(const Planets<N, G>& planets, const Row<T, G>& displacement) const {
    return displacement - planets(error);
  }
  template <std::size_t G, class T>
  [[nodiscard]] Row<T, G> rate(const Planets<N, G>& planets, const Row<T, G>& velocity) const {
    return velocity - planets(error_rate);
  }

  /// One of the rows that planets may share, of some planets.
  template <std::size_t G>
  [[nodiscard]] Row<P, G> each(const Planets<N, G>& planets, const Row<P, N>& row) const {
    if (is_lanes<P> && shared) return Row<P, G>(row[0]);
    return planets(row);
  }
};

template <class P, std::size_t N>
[[nodiscard]] std::size_t harmonics_of(const Parameters<P, N>& p) {
  const auto of_errors = [](const auto& mesh) {
    return mesh.further_error_cos.empty() ? 0 : mesh.further_error_cos.size() + 1;
  };
  return std::max({p.sun_planet.harmonics, p.ring_planet.harmonics, p.torque_harmonics, of_errors(p.sun_planet),
                   of_errors(p.ring_planet)});
}

/// Torques on gear 1 and gear 2 of a pair over their means [M-pair].
template <class P>
struct TorqueRatios {
  P input, output;

  TorqueRatios() = default;
  template <std::size_t N>
  TorqueRatios(const Parameters<P, N>& p, const HarmonicBasis<P>& basis) : input(1.0), output(1.0) {
    for (std::size_t h = 0; h < p.torque_harmonics; ++h) {
      input += p.input_cos[h] * basis.cosine[h] + p.input_sin[h] * basis.sine[h];
      output += p.output_cos[h] * basis.cosine[h] + p.output_sin[h] * basis.sine[h];
    }
  }
};

/// A stage has constant torques.
struct ConstantTorques {
  ConstantTorques() = default;
  template <class P, std::size_t N>
  ConstantTorques(const Parameters<P, N>& /*p*/, const HarmonicBasis<P>& /*basis*/) {}
};

/// Of the stage.
template <class P, std::size_t N>
struct PhaseCoefficients {
  MeshCoefficients<P, N> sun_planet, ring_planet;
  [[no_unique_address]] std::conditional_t<N == 1, TorqueRatios<P>, ConstantTorques> torques;

  PhaseCoefficients() = default;

  /// Without the tables.
  PhaseCoefficients(const Parameters<P, N>& p, const HarmonicBasis<P>& basis, const P& s)
      : sun_planet(p, p.sun_planet, basis), ring_planet(p, p.ring_planet, basis), torques(p, basis) {
    if (p.mesh_periods > 1) [[unlikely]] {
      sun_planet.add_shaft_errors(p.omega, p.sun_planet, s);
      ring_planet.add_shaft_errors(p.omega, p.ring_planet, s);
    }
  }

  /// @param segment  of p, that of s
  PhaseCoefficients(const Parameters<P, N>& p, std::size_t segment, const P& s)
      : PhaseCoefficients(p, HarmonicBasis<P>(sine_cosine(s), harmonics_of(p)), s) {
    sun_planet.interpolate(p.omega, p.sun_planet, p.segments[segment].sun_planet, s);
    ring_planet.interpolate(p.omega, p.ring_planet, p.segments[segment].ring_planet, s);
  }
};

}  // namespace epicyclic::model
