// Natural frequencies and mode shapes of the linear stage, and their types.
//
//   K phi = omega^2 M phi ,  K = sum_i [ k_sp l_spi l_spi' + k_rp l_rpi l_rpi' + k_p (l_x l_x' + l_y l_y') ] + supports
//   [M-K]
//
// l: the rows of the deflections (model/right_hand_side.hpp), mean stiffness, gaps closed, no rotation. Supports and
// planet bearings may be 0, finite or rigid; a rigid one is a constraint, and an orthogonal basis spans the
// displacements left free. Source: Lin and Parker, J. Vib. Acoust. 121 (1999) 316, whose classification is used:
//
//   rotational     central members only rotate        translational  central members only translate
//   planet         only planets move                  other          none of these (unequal spacing)
//
// Types follow from the shapes, by the share of M-weighted displacement. If frequencies of two types coincide, their
// subspace is split first. Limits: undamped, no gyroscopic terms.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "gear/stage.hpp"
#include "model/layout.hpp"
#include "model/scales.hpp"

namespace epicyclic::model {

enum class ModeType { rotational, translational, planet, other };

[[nodiscard]] std::string_view to_string(ModeType type);

/// All shapes of one type at one frequency.
struct Mode {
  double frequency_ratio = 0;  ///< omega / omega_sn; exactly 0 for a rigid-body mode
  ModeType type = ModeType::other;
  int multiplicity = 1;
  Eigen::MatrixXd shapes;  ///< (3N + 9) x multiplicity, slots of Layout::full, shape' M shape = 1 (M in m_0)
};

/// The elastic elements of a stage.
enum class Element {
  sun_planet_mesh,
  ring_planet_mesh,
  planet_bearing,
  sun_support,
  sun_torsion,
  ring_support,
  ring_torsion,
  carrier_support,
  carrier_torsion,
};
inline constexpr std::size_t element_count = 9;

[[nodiscard]] std::string_view to_string(Element element);

/// One spring: its energy is k (l' q)^2 / 2.
struct Spring {
  Element element;
  double stiffness;     ///< [m_0 omega_sn^2]
  Eigen::VectorXd row;  ///< l
};

/// Mass matrix (diagonal) and stiffness matrix of the full coordinates, rigid supports left out of K.
struct LinearStage {
  Eigen::VectorXd mass;         ///< 3N + 9 [m_0]
  Eigen::MatrixXd stiffness;    ///< (3N + 9) x (3N + 9) [m_0 omega_sn^2]
  Eigen::MatrixXd constraints;  ///< c x (3N + 9): rows whose product with every possible displacement is 0
  std::vector<Spring> springs;  ///< those that make up the stiffness
};

/// @param stage  passes gear::problems_for_modes()
[[nodiscard]] LinearStage linear_stage(const gear::Stage& stage, const Scales& scales);

/// Displacements whose shares of the kinetic energy are separate.
enum class MemberDisplacement {
  sun_translation,
  sun_rotation,
  planet_translation,
  planet_rotation,
  ring_translation,
  ring_rotation,
  carrier_translation,
  carrier_rotation,
};
inline constexpr std::size_t displacement_count = 8;

[[nodiscard]] std::string_view to_string(MemberDisplacement displacement);

/// Shares of a mode's elastic and kinetic energy; each kind adds up to 1 (elastic: 0 for rigid-body modes). Means over
/// the shapes of a multiple mode, which do not depend on the choice of shapes.
struct ModalEnergies {
  std::array<double, element_count> elastic{};
  std::array<double, displacement_count> kinetic{};
};

/// @param planets  N
[[nodiscard]] ModalEnergies modal_energies(const LinearStage& linear, const Mode& mode, int planets);

/// All modes, rising frequency.
[[nodiscard]] std::vector<Mode> modes(const gear::Stage& stage, const Scales& scales);

}  // namespace epicyclic::model
