// A stage and studies to begin with: the values of a drawing. Values that no drawing gives are typical of machines;
// their origins state the reason and the range.
//
//   rims      planet 3 m (ISO 6336-3 counts a rim of 1.2 tooth depths, 2.7 m, as solid), ring 4 m (1.75 depths, 3.9 m)
//   supports  as parts of the mesh stiffness, 20 N/(mm um) of face width (ISO 6336-1): of ring and carrier those of the
//             benchmark of Lin and Parker, 0.2 and 2 in torsion
//   planets'  bearings  [G-roller] under the load of both meshes: rollers of a fifth of the bore on a pin of 0.6 of it,
//             0.8 of the width long
//   clearance group N of ISO 5753-1, of a ball bearing on a shaft as thick as the sun's root circle
//   torque    60 N/mm2 times module and face width on each mesh, some 1 GPa on the flanks of case-hardened gears
//   backlash  j_bn = 2/3 (60 um + 0.5 um/mm a + 30 um/mm m), the least that ISO/TR 10064-2 recommends
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace epicyclic::input {

/// The values of the drawing, and the keys that it does not give: `assumed`.
struct Drawing {
  std::string name = "stage";
  bool pair = false;  ///< of a lone pair: gear 1 in the place of the sun, gear 2 in that of the planet; one "planet"
  int sun_teeth = 21, planet_teeth = 28;
  std::optional<int> ring_teeth{};  ///< none: z_s + 2 z_p
  double module_mm = 3;
  double pressure_angle_deg = 20;
  std::array<double, 3> profile_shift{};  ///< sun, planet, ring
  double width_mm = 30;
  int planets = 3;
  std::vector<double> angles_deg{};   ///< of the planets; none: as even as can be
  std::optional<double> torque_Nm{};  ///< on the sun; none: by the size
  std::optional<double> speed_rpm{};  ///< rated, of the sun; none: studies are in Omega
  std::set<std::string> assumed{};  ///< keys of gears and planets that stand at the values above, which no drawing gave

  [[nodiscard]] int ring() const { return ring_teeth.value_or(sun_teeth + 2 * planet_teeth); }
};

/// Torque on the sun: as given, or a usual load for teeth of that size [N m].
[[nodiscard]] double torque_Nm(const Drawing& drawing);

/// Angles at which the teeth fit, as near to even spacing as possible [deg]. None if even spacing fits or if angles are
/// given.
[[nodiscard]] std::vector<double> assembly_angles(const Drawing& drawing);

/// The stage as a file: ring held, carrier free; planets are spaced evenly, or as nearly so as they can be assembled.
/// Or the pair, whose gears only rotate.
/// @throws InputError for impossible gears
[[nodiscard]] nlohmann::ordered_json starter_stage(const Drawing& drawing);

/// A sweep over the speed, and a run of one, of the stage in a file beside them.
[[nodiscard]] nlohmann::ordered_json starter_sweep(const Drawing& drawing, const std::string& stage_file);
[[nodiscard]] nlohmann::ordered_json starter_run(const Drawing& drawing, const std::string& stage_file);

}  // namespace epicyclic::input
