// One operating point with everything that analysis can say of it: regime and its evidence, histories and phase
// portraits with forces, Poincare sections, spectra, Lyapunov exponents with their checks, the orbit with its
// multipliers.
//
//   dynamic mesh-force ratio   F_i / F_0 ,  F_0 = T_D / (N r_bs)                                            [S-force]
//   load sharing               L_i = N F_i / sum_j F_j , as means over time: N mean(F_i) / sum_j mean(F_j)  [S-share]
//
// F_i is the normal force of a mesh with its damping [M-27], F_0 the static one of the sun-planet meshes. Where a train
// accelerates (boundary `as_printed`) the mean forces are shares of inertia, not F_0 (docs/theory/model.md, section 4).
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/lyapunov.hpp"
#include "analysis/periodic_orbit.hpp"
#include "analysis/spectrum.hpp"
#include "studies/remembered_flow.hpp"
#include "studies/run_options.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::studies {

/// Uniform samples of all signals: rows one behind the other, `columns` long.
struct History {
  std::vector<std::string> columns;  ///< "periods" (mesh periods since the record began), "tau", then signals
  std::vector<std::string> units;    ///< one for each column: "1", "b_c", "b_c per tau", "N"
  std::vector<double> values;
  int phases = 0;  ///< rows per mesh period

  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
  /// Column by name, or columns.size().
  [[nodiscard]] std::size_t index_of(const std::string& column) const;
  [[nodiscard]] std::vector<double> column(const std::string& name) const;
};

/// delta_sp_1 against its rate over the last mesh periods of the history, so dense that a line through them has no
/// corner to be seen.
struct Portrait {
  int phases = 0;                        ///< samples per mesh period: a multiple of the history's
  std::vector<double> deflection, rate;  ///< [b_c], [b_c per tau]
};

/// Mesh periods of the portrait of a response that does not repeat: with more, a line fills the plane.
inline constexpr int portrait_periods = 64;

/// One mesh over the record.
struct MeshSummary {
  std::string name;                                     ///< "sp_1", "rp_3"
  double force_mean = 0, force_min = 0, force_max = 0;  ///< F [N]
  double force_ratio_max = 0;                           ///< max F / F_0 [-]
  Course quasi_static;                                  ///< F of the quasi-static solution [N]
  double kv = 0;                                        ///< K_v [S-kv] [-]; not a number where it is not known
  double load_sharing = 0;                              ///< of the means [S-share] [-]
  double drive = 0, loss = 0, back = 0;                 ///< parts of the time [-]
  double tensile_force_max = 0;                         ///< largest tension [model::tensile_force()] [N]
  double tension_time = 0;                              ///< part of the time that there is tension [-]
  int contact_losses = 0;                               ///< times that the drive flank was left, per record
};

/// Spectrum of one signal.
struct SignalSpectrum {
  std::string signal;           ///< column of the history
  std::string unit;             ///< "um" or "N"
  bool exact = false;           ///< over whole periods of a periodic orbit without a window; else by a flat-top window
  analysis::Spectrum spectrum;  ///< frequency in mesh frequencies
  std::vector<analysis::Harmonic> lines{};  ///< if exact: p / n with their labels
  std::vector<analysis::Peak> peaks{};      ///< else
  std::vector<model::Shaft> shafts{};       ///< whose orders are between those of the mesh
};

/// "1 + 2/27 (sun)": a frequency that is not a multiple of the mesh frequency, by the order of the one shaft that it
/// belongs to; empty if there is none.
/// @param tolerance  of the frequency, in mesh frequencies
[[nodiscard]] std::string shaft_order_words(double frequency, const std::vector<model::Shaft>& shafts,
                                            double tolerance);

/// What the full Lyapunov spectrum is checked against.
struct ExponentChecks {
  int intervals = 0;                    ///< mesh periods that sum and divergence are taken over
  double sum = 0;                       ///< of all exponents, per tau
  double divergence = 0;                ///< mean of the field's, along the same trajectory, per tau
  std::optional<double> multipliers{};  ///< periodic: largest difference from log |multiplier| / period, per tau
  int inside = 0;    ///< exponents whose interval holds log |multiplier| / period, to the checks' tolerance
  int compared = 0;  ///< exponents compared with multipliers
  std::optional<double> step_control{};  ///< largest difference from exponents without error control of tangents
};

struct RunResult {
  PointResult point;
  History history;  ///< whole record
  Portrait portrait{};
  std::vector<MeshSummary> meshes;  ///< sun-planet meshes, then ring-planet meshes
  double static_force = 0;          ///< F_0 [N]
  std::vector<SignalSpectrum> spectra;
  std::vector<double> section_deflection,
      section_rate;                      ///< delta_sp_1 [b_c] and its rate at each row of point.poincare
  analysis::PoincareSection crossing;    ///< states where delta_sp_1 rises through b (contact is made)
  std::vector<double> crossing_phase;    ///< mesh phase in [0, 2 pi) of each
  std::vector<double> crossing_rate;     ///< delta_sp_1' of each [b_c per tau]
  analysis::LyapunovSpectrum exponents;  ///< per unit of s; empty if none were requested
  std::optional<ExponentChecks> checks{};
  double dimension = 0;                          ///< Kaplan and Yorke's
  double dimension_low = 0, dimension_high = 0;  ///< the same at both ends of all exponents' intervals
  std::optional<analysis::Estimate>
      transverse{};  ///< exponent transverse to the synchronous subspace, per tau; if the stage is symmetric
  std::optional<analysis::PeriodicOrbit> orbit{};  ///< if periodic
  /// Distance of the orbit from that with tables half as fine, which exceeds the effect of interpolation in the tables.
  /// For a periodic orbit with such tables [b_c, b_c per tau].
  std::optional<double> table_displacement{};
  double friction_table_error = 0;  ///< of friction over normal force between the rows of its tables [-]
  std::optional<analysis::FloquetMultipliers> multipliers{};  ///< if periodic
  int mesh_periods = 1;  ///< after which errors repeat: between two points of the section
  double omega = 0;      ///< Omega: exponents per s times Omega are per tau
  double omega_sn = 0;   ///< of the scale of time [rad/s]
};

/// Flows of a run whose results can be kept: all that take long, once the point is known.
enum class RunPart : std::size_t { exponents = 1, divergence, step_control, transverse };

/// Where a run keeps what it has computed, for a session that goes on from there. Called by several threads, each with
/// parts of its own.
struct RunMemory {
  std::optional<PointResult> point{};                      ///< of an earlier session
  std::function<void(const PointResult&)> keep = nullptr;  ///< the point of this one
  std::function<FlowMemory(RunPart)> of = nullptr;         ///< each part is requested once
};

/// How a run is computed; none of it changes a result.
struct RunControl {
  int threads = 1;                        ///< more than 2 are of no use
  std::function<bool()> go_on = nullptr;  ///< called now and then, by all threads; false ends the run
  /// Sees what is begun, and which mesh period of exponent_intervals() it is; by all threads.
  std::function<void(const char* what, int exponent_interval)> at = nullptr;
  RunMemory memory{};  ///< without functions: nothing is kept
};

/// Mesh periods that all Lyapunov exponents are computed over: those that align the vectors, and those that are
/// counted.
[[nodiscard]] int exponent_intervals(const RunOptions& options);

/// @returns nothing if ended; of a point that is not reached, the point alone
[[nodiscard]] std::optional<RunResult> run_operating_point(const model::DynamicModel& model,
                                                           const RecordingOptions& recording, const RunOptions& options,
                                                           const integrate::IntegratorOptions& integrator,
                                                           const RunControl& control = {});

}  // namespace epicyclic::studies
