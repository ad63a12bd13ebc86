// The files of a run of one operating point, besides points.csv and poincare.csv (reports/sweep_output.hpp).
//
//   history.csv      the last mesh periods of the record: states, deflections, forces, load sharing of the planets
//   spectrum.csv     amplitude and phase of each signal's lines: at p / n of the mesh frequency for a periodic orbit
//   exponents.csv    running means of the Lyapunov exponents, per tau
//   multipliers.csv  of the periodic orbit, by falling modulus
//   crossing.csv     states where contact of the first sun-planet mesh is made
//   summary.md       the results, in words
//   results.h5       everything
//   figures/         history, phase_portrait, poincare_section, poincare_crossing, spectrum, spectrum_force, exponents,
//                    multipliers, contact, mesh_force
//
// Results that do not exist have no table and no figure. All of it follows from the result alone and is the same, byte
// for byte, for the same study.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "model/options.hpp"
#include "reports/sweep_output.hpp"
#include "studies/run.hpp"

namespace epicyclic::kinds {

/// Data of a run for its files, besides its result.
struct RunOutput {
  reports::SweepOutput points;
  studies::RunOptions options;
  double half_gap_sp = 0;  ///< b_sp [b_c]
  double half_gap_rp = 0;  ///< b_rp [b_c]
  model::GapDamping gap_damping = model::GapDamping::always;
  std::vector<std::string> start;  ///< where it started and what else is known there, a sentence each; none by default
  bool start_is_chaotic = false;   ///< it continues a chaotic response of the same equations of motion
};

/// Highest frequency in spectrum.csv [mesh frequencies]; results.h5 has all.
inline constexpr double tabulated_frequency = 20.0;

/// The tables. @throws OutputError
void write_run_tables(const std::filesystem::path& folder, const RunOutput& output, const studies::RunResult& result);

/// @throws OutputError
void write_run_h5(const std::filesystem::path& file, const RunOutput& output, const studies::RunResult& result);

/// One page of plain Markdown, in lines of at most 100 columns.
[[nodiscard]] std::string run_summary(const RunOutput& output, const studies::RunResult& result);

/// @param figures_folder  made if need be
/// @throws OutputError when data or scripts cannot be written
[[nodiscard]] std::vector<reports::DrawnFigure> draw_run_figures(const std::filesystem::path& figures_folder,
                                                                 const RunOutput& output,
                                                                 const studies::RunResult& result);

/// Is there something to write or draw? A failed integration has growth, but no exponents.
[[nodiscard]] bool has_exponents(const studies::RunResult& result);
[[nodiscard]] bool has_multipliers(const studies::RunResult& result);
[[nodiscard]] bool has_crossing(const studies::RunResult& result);

/// "1 mesh period", "2 mesh periods".
[[nodiscard]] std::string mesh_periods(int n);

/// First row of the last `periods` mesh periods of a record; 0 when it is no longer than that.
[[nodiscard]] std::size_t first_row(const studies::History& history, int periods);

/// Bins that the mean fills through a flat-top window, whose main lobe is that wide on one side.
inline constexpr std::size_t mean_bins = 5;

/// A line of a spectrum.
struct SpectralLine {
  std::string label;     ///< times the mesh frequency: "1", "3/2"; of a peak that need not be a ratio, "1.382"
  double frequency = 0;  ///< [mesh frequencies]
  double amplitude = 0;  ///< in the signal's unit
  bool of_mesh = false;  ///< a harmonic of the mesh frequency itself
};

/// The `most` largest lines by falling amplitude, the mean left out. Lines below 1e-9 of the largest are rounding.
[[nodiscard]] std::vector<SpectralLine> strongest_lines(const studies::SignalSpectrum& signal, std::size_t most);

}  // namespace epicyclic::kinds
