// Figures of `epicyclic gear`: mesh stiffness, load sharing of tooth pairs, friction, bearings, the teeth in mesh,
// natural modes.
//
// Teeth in mesh are placed by the geometry of the pair [F-mesh]. The pitch point is the origin, the axis of the driving
// member is below it, and the driving member rotates clockwise:
//
//   n = (cos alpha, sin alpha) ,  contact at  C(l) = (l - r_b1 tan alpha) n
//   centre lines of the teeth of a contact at l, as polar angles about their axes:
//     driving            pi/2 + alpha - l / r_b1   + alpha_21
//     driven, external  -pi/2 + alpha - h_2 / r_b2 + alpha_22
//     driven, internal   pi/2 + alpha - h_2 / r_b2 - alpha_22
//
// A flank begins on its base circle, at an arc from the tangent point that is as long as its contact line. Source:
// derived from [G-pair], [G-path]. Limits: nominal teeth, without thinning, deflection or modification.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "figures/gnuplot.hpp"
#include "gear/ehl_friction.hpp"
#include "gear/gear_set.hpp"
#include "gear/stage.hpp"
#include "reports/transmission_error_report.hpp"

namespace epicyclic::reports {

struct GearFigure {
  std::string stem;
  figures::FigureOutcome outcome;
};

/// Draws the figures from catalogue data, each as `folder`/STEM.{dat,gp,png,svg}: stiffness_sp, stiffness_rp,
/// load_sharing, friction, friction_ratio, bearing_stiffness, bearing_force, teeth_sp, teeth_rp. Without lubrication
/// there are no figures of friction, without bearings none of bearings; they are not in the result.
///
/// @param load   of the operating point that the friction figures show
/// @param stage  its name and the friction it uses, if that is a lubricated contact with load shares
/// @throws OutputError when data or script cannot be written
std::vector<GearFigure> draw_gear_set_figures(const std::filesystem::path& folder, const gear::GearSet& set,
                                              const gear::MeshLoad& load, const gear::Stage& stage);

/// Peak-to-peak and harmonics of the static transmission error over the torque, and the error over the mesh phase at
/// several torques, of each mesh.
[[nodiscard]] std::vector<GearFigure> draw_transmission_error_figures(const std::filesystem::path& folder,
                                                                      const std::vector<TransmissionErrorTable>& tables,
                                                                      const gear::Stage& stage);

/// Draws campbell and mode_shapes of any stage, lumped ones included.
/// @param stage  passes gear::problems_for_modes()
/// @throws OutputError when data or script cannot be written
std::vector<GearFigure> draw_mode_figures(const std::filesystem::path& folder, const gear::Stage& stage);

/// A point of a drawing [mm].
struct DrawnPoint {
  double x, y;
};

/// The teeth of a pair in mesh, seen along the axes. Lengths in mm, origin at the pitch point.
struct MeshDrawing {
  DrawnPoint driving_axis, driven_axis;
  /// Outline of some teeth around the contact, counter-clockwise about the member's axis. Where teeth touch, both
  /// outlines have a vertex.
  std::vector<DrawnPoint> driving, driven;
  DrawnPoint start, end;             ///< of the path of contact
  std::vector<DrawnPoint> contacts;  ///< of the pairs in contact
};

/// @param phase  of the mesh, in [0, 1), 0 where a pair enters
/// @param reach  the outlines cover at least this distance on both sides of the line of centres [mm]
[[nodiscard]] MeshDrawing mesh_drawing(const gear::Pair& pair, double phase, double reach_mm);

}  // namespace epicyclic::reports
