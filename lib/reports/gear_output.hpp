// What `epicyclic gear` writes: tables as CSV, figures, and the page gear.md.
//
//   any stage         modes.csv mode_shapes.csv campbell.csv gear.md
//   catalogue data    geometry.csv stiffness.csv load_sharing.csv friction.csv friction_ratios.csv bearings.csv
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "input/study_input.hpp"

namespace epicyclic::reports {

struct GearOutput {
  std::string modes;                  ///< text of modes.csv
  std::string mode_summary;           ///< a table of the natural frequencies for a terminal
  std::vector<std::string> verdicts;  ///< plain sentences for people
  std::vector<std::string> warnings;
  std::vector<std::string> figures;  ///< stems of the figures that were drawn
  std::vector<std::string> undrawn;  ///< "stem: why not"
};

/// Numbers within their bounds can give results that are not finite. To be called before anything is written.
/// @throws InputError that names what of geometry, operating point and modes is not a finite number
void require_finite_numbers(const input::LoadedInput& input);

/// Tables of the natural modes, as modes.csv and mode_shapes.csv have them.
[[nodiscard]] std::string modes_table(const input::LoadedInput& input);
[[nodiscard]] std::string mode_shapes_table(const input::LoadedInput& input);

/// Writes everything to a folder; the operating point is the study's, Omega = 1 for a stage alone.
/// @throws OutputError
GearOutput write_gear_output(const std::filesystem::path& folder, const input::LoadedInput& input);

/// Modes, verdicts and warnings without the figures and files, and without what only they need.
[[nodiscard]] GearOutput gear_words(const input::LoadedInput& input);

}  // namespace epicyclic::reports
