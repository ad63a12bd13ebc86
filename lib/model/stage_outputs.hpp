// Outputs of meshes and bearings at an instant, for several instants at once.
//
//   delta, F, k f(delta)  of each mesh [M-13], [M-14], [M-27];  |F_b| of the bearing between each planet and the
//   carrier and of the sun's;  the transmission error of the stage
//
//   TE = u_s + u_r - u_c (cos alpha_sp + cos alpha_rp) ,  rotations on the base circles                        [S-te]
//
// TE is the lead of the sun over its angle in a rigid train without errors, along its lines of action. It compares the
// driving member with the driven one if the carrier (boundary `as_printed`, `star`) or the ring (`fixed_ring`) stands.
// A rigid rotation of the whole train adds nothing. In relative coordinates it is w_s, with the torsion of the member
// that is supported.
//
// Outputs are evaluated at phases that repeat each period, `phases_together` of them side by side. Coefficients that
// depend on the phase alone are computed once. Limits: none of its own. Smoothness: as the forces,
// model/right_hand_side.hpp.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "core/scalar.hpp"

namespace epicyclic::model {

/// Instants side by side.
inline constexpr std::size_t phases_together = 8;

/// Positions of the numbers of one evaluation with N planets; forces in m_0 omega_sn^2 b_c, the rest in b_c.
struct OutputRows {
  std::size_t planets = 0;

  static constexpr std::size_t of_mesh = 3;
  static constexpr std::size_t of_planet = 2 * of_mesh + 1;

  struct Mesh {
    std::size_t first;
    [[nodiscard]] constexpr std::size_t delta() const { return first; }
    [[nodiscard]] constexpr std::size_t force() const { return first + 1; }    ///< F, damping included
    [[nodiscard]] constexpr std::size_t elastic() const { return first + 2; }  ///< k f(delta)
  };
  [[nodiscard]] constexpr Mesh sun_planet(std::size_t i) const { return {of_planet * i}; }
  [[nodiscard]] constexpr Mesh ring_planet(std::size_t i) const { return {of_planet * i + of_mesh}; }
  /// Magnitude of spring and damper between planet and carrier.
  [[nodiscard]] constexpr std::size_t planet_bearing(std::size_t i) const { return of_planet * i + 2 * of_mesh; }
  /// Magnitude of bearing and support damping.
  [[nodiscard]] constexpr std::size_t sun_bearing() const { return of_planet * planets; }
  [[nodiscard]] constexpr std::size_t transmission_error() const { return of_planet * planets + 1; }
  [[nodiscard]] constexpr std::size_t count() const { return of_planet * planets + 2; }
};

/// Tensile force of a mesh [S-tension]: the part of its damping that exceeds the elastic force of the loaded flank.
/// This is the back flank if that is in contact, otherwise the drive flank. Real teeth transmit no tensile force.
/// Damping causes it, through the open gap or just before contact is lost.
/// @param force  F, of which `elastic` is no damping
template <class T>
[[nodiscard]] T tensile_force(const T& delta, double half_gap, const T& elastic, const T& force) {
  const T nothing(0.0);
  const T sign = select(delta < T(-half_gap), T(-1.0), T(1.0));
  // A smoothed clearance has a little of the other flank's force in the gap: that is no tension.
  const T pressing = select(sign * elastic > nothing, sign * elastic, nothing);
  const T tension = -(pressing + sign * (force - elastic));
  return select(tension > nothing, tension, nothing);
}

/// Evaluates outputs at a group of phases: numbers `group` phases_together and on of those that it was made for.
///
/// @param states  the state at each of them, component by component: phases_together numbers each
/// @param rows    OutputRows::count() rows of as many numbers; undefined beyond the last phase
using StageOutputs = std::function<void(std::size_t group, const double* states, double* rows)>;

/// @param phases  in [0, 2 pi]
using StageOutputsAt = std::function<StageOutputs(std::span<const double> phases)>;

}  // namespace epicyclic::model
