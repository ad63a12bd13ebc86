// Coefficients at the phases of a step's slopes, W operating points side by side: model/phase_coefficients.hpp with
// lanes for scalars.
//
// Sine, cosine and the places in tables are chains of operations that wait for each other. So each operation runs for
// all slopes before the next one: a processor then works on several slopes at once.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <new>
#include <numbers>

#include "core/lanes.hpp"
#include "model/lane_parameters.hpp"
#include "model/phase_coefficients.hpp"

namespace epicyclic::model {

/// Slopes that are computed together: no pair of the lanes has more.
inline constexpr std::size_t slopes_together = 8;

/// Coefficients from the tables of one kind of mesh, for `count` slopes.
template <std::size_t N, std::size_t W>
void interpolate(const Lanes<W>& omega, const MeshParameters<Lanes<W>, N>& mesh, const LaneMeshPlaces<N, W>& places,
                 std::size_t count, const Lanes<W>* s, PhaseCoefficients<Lanes<W>, N>* phase_coefficients,
                 MeshCoefficients<Lanes<W>, N> PhaseCoefficients<Lanes<W>, N>::*kind) {
  const auto each = [&](std::size_t planet, const auto& place, const auto& take) {
    std::array<LaneInterval<W>, slopes_together> found;
    for (std::size_t k = 0; k < count; ++k)
      found[k] = place.find(s[k] * (0.5 * std::numbers::inv_pi) + mesh.phase_cycles[planet]);
    for (std::size_t k = 0; k < count; ++k) take(phase_coefficients[k].*kind, place.at(found[k]));
  };
  for (std::size_t i = 0; i < ((phase_coefficients->*kind).shared ? 1 : N); ++i) {
    if (mesh.stiffness_curve)
      each(i, places.stiffness[i], [i](auto& now, const auto& values) { now.stiffness.set(i, values[0]); });
    if (mesh.friction)
      each(i, places.friction[i], [i](auto& now, const auto& values) {
        now.friction.set(i, values[0]);
        now.moment_driving.set(i, values[1]);
        now.moment_driven.set(i, values[2]);
      });
  }
  // Errors are each planet's own; planets that mesh in phase have one value of the table.
  if (mesh.error_curve)
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t k = 0; k < count; ++k) {
        const auto& place = places.error[i];
        const LaneInterval<W> found = place.find(s[k] * (0.5 * std::numbers::inv_pi) + mesh.phase_cycles[i]);
        std::array<Lanes<W>, 2> values{Lanes<W>(0.0), Lanes<W>(0.0)};
        for (std::size_t lane = 0; lane < W; ++lane) {
          const Row<double, 3> row = place.in_lane(lane, found);
          values[0].set(lane, row[0]);
          values[1].set(lane, row[1]);
        }
        (phase_coefficients[k].*kind).add_error(i, values, omega);
      }
}

/// @param s         phases of `count` slopes, all in the lanes' segments
/// @param phase_coefficients  `count`, written without being read
template <std::size_t N, std::size_t W>
void make_phase_coefficients(const LaneParameters<N, W>& p, std::size_t count, const Lanes<W>* s,
                             PhaseCoefficients<Lanes<W>, N>* phase_coefficients) {
  const auto& constants = p.constants();
  const std::size_t harmonics = harmonics_of(constants);
  std::array<SineCosine<Lanes<W>>, slopes_together> angle;
  for (std::size_t first = 0; first < count; first += slopes_together) {
    const std::size_t together = std::min(slopes_together, count - first);
    for (std::size_t k = 0; k < together; ++k) angle[k] = sine_cosine(s[first + k]);
    for (std::size_t k = 0; k < together; ++k)
      new (phase_coefficients + first + k)
          PhaseCoefficients<Lanes<W>, N>(constants, HarmonicBasis<Lanes<W>>(angle[k], harmonics), s[first + k]);
    interpolate(constants.omega, constants.sun_planet, p.segment().sun_planet, together, s + first,
                phase_coefficients + first, &PhaseCoefficients<Lanes<W>, N>::sun_planet);
    interpolate(constants.omega, constants.ring_planet, p.segment().ring_planet, together, s + first,
                phase_coefficients + first, &PhaseCoefficients<Lanes<W>, N>::ring_planet);
  }
}

}  // namespace epicyclic::model
