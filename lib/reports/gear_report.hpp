// Every number of a gear set with symbol, unit, formula and origin: geometry.csv and the page gear.md.
#pragma once

#include <string>
#include <vector>

#include "gear/ehl_friction.hpp"
#include "gear/gear_set.hpp"
#include "input/study_input.hpp"
#include "model/modes.hpp"
#include "model/scales.hpp"

namespace epicyclic::reports {

/// One number of the summary.
struct Quantity {
  std::string group;   ///< heading under which it stands
  std::string name;    ///< snake_case, unique
  std::string symbol;  ///< as in the field's literature
  double value = 0;
  std::string unit;     ///< "mm", "-", ...
  std::string formula;  ///< tag of lib/EQUATIONS.md, or where it is from
};

/// Geometry, contact, stiffness, masses, tolerances of the set.
/// @param stage  with catalogue data, from which `set` was made
[[nodiscard]] std::vector<Quantity> gear_quantities(const gear::GearSet& set, const gear::Stage& stage);

/// Scales, and speeds, torques and forces at an operating point; without load or teeth the scales only.
[[nodiscard]] std::vector<Quantity> operating_quantities(const gear::Stage& stage, double mesh_frequency_ratio);

/// name,value,unit,symbol,formula,group
[[nodiscard]] std::string quantities_csv(const std::vector<Quantity>& quantities);

/// A natural frequency over the ranges that the origins of estimated values state [Hz].
struct ModeRange {
  double from, to;
};

/// One for each of the modes of the input's stage; empty if no value of the modes has a range.
///
/// Each frequency rises with every stiffness and falls with every mass (Courant and Fischer). So its least value is
/// that of the softest and heaviest stage, and its greatest that of the stiffest and lightest. For equally spaced,
/// alike planets each type of modes is a problem of its own: the k-th mode of its type is followed. Else it is the k-th
/// of all.
[[nodiscard]] std::vector<ModeRange> mode_ranges(const input::LoadedInput& input,
                                                 const std::vector<model::Mode>& modes);

/// Texts of the page besides its numbers.
struct GearPage {
  std::string title;
  std::vector<std::string> verdicts;  ///< plain sentences, e.g. where the paths of contact lie
  std::vector<std::string> warnings;
  std::vector<Quantity> quantities;
  std::vector<std::string> figures;      ///< stems in the folder figures
  std::vector<std::string> files;        ///< data files beside the page
  std::vector<ModeRange> mode_ranges{};  ///< of each mode; empty where no estimated value has a range
  std::string transmission_error{};      ///< its section; empty without a load
};

/// The page: verdicts, warnings, quantities, modes, all values of the resolved input with their origins, figures.
[[nodiscard]] std::string gear_page(const GearPage& page, const input::LoadedInput& input,
                                    const std::vector<model::Mode>& modes, const model::Scales& scales);

/// One sentence on teeth, speeds, torque and mesh stiffness at an operating point.
/// @param stage  passes gear::problems_for_dynamics()
[[nodiscard]] std::string operation_verdict(const gear::Stage& stage, double mesh_frequency_ratio);

/// Who drives whom, and which flanks are loaded; empty if the sun drives with a positive torque.
[[nodiscard]] std::string drive_words(const gear::Stage& stage);

/// Amplitudes of the transmission error against the static deflection of both meshes at an operating point.
/// @param stage  passes gear::problems_for_dynamics()
[[nodiscard]] std::string error_words(const gear::Stage& stage, double mesh_frequency_ratio);

/// A sentence on the mode with the most uncertain frequency.
/// @param ranges  of the modes; one at least
[[nodiscard]] std::string range_words(const std::vector<ModeRange>& ranges);

/// Sentences on where the paths of contact lie relative to their pitch points.
[[nodiscard]] std::vector<std::string> contact_verdicts(const gear::GearSet& set, const gear::Stage& stage);

}  // namespace epicyclic::reports
