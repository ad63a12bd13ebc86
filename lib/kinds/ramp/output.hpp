// The files of a ramp.
//
//   ramp.csv     one row per window: speed, torque, statistics, amplitudes of the mesh orders
//   orders.csv   amplitude of delta_sp_1 over order and window
//   ramp.md      the results, in words
//   results.h5   the group /ramp with the columns of ramp.csv
//   figures/     response, orders, campbell_up, campbell_down
//
// All of it follows from the result alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/sweep_output.hpp"
#include "studies/ramp.hpp"

namespace epicyclic::kinds {

/// Data of a ramp for its files, besides its result.
struct RampOutput {
  studies::RampOptions options;
  std::string resolved_input;
  std::string title;
  double omega_sn = 0;        ///< [rad/s]
  gear::Speeds speeds{};      ///< at Omega = 1
  double carrier_torque = 0;  ///< over that on the sun
  bool has_ring = true;
  bool lubricated = false;  ///< friction follows the speed window by window
};

/// The tables. @throws OutputError
void write_ramp_tables(const std::filesystem::path& folder, const RampOutput& output,
                       const studies::RampResult& result);

/// One page of plain Markdown.
[[nodiscard]] std::string ramp_summary(const RampOutput& output, const studies::RampResult& result);

/// @throws OutputError when data or scripts cannot be written
[[nodiscard]] std::vector<reports::DrawnFigure> draw_ramp_figures(const std::filesystem::path& folder,
                                                                  const RampOutput& output,
                                                                  const studies::RampResult& result);

}  // namespace epicyclic::kinds
