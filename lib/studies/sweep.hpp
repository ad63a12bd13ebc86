// Bifurcation diagram by brute force: one parameter along a grid, up, down or both, with Poincare points at each value.
//
// Points are numbered along the first direction, then the second. A continued sweep is a chain per direction (or per
// segment of it). Each point starts from the end state of the point before, so that the sweep follows a branch and
// shows hysteresis. A point is a pure function of its value and initial state. So the result does not depend on the
// number of threads, and a sweep that was stopped resumes with the same bytes. If a point does not end in `reached`,
// the next one of its chain starts cold.
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/attractors.hpp"
#include "analysis/poincare.hpp"
#include "analysis/regime.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/options.hpp"
#include "model/dynamic_model.hpp"
#include "studies/classification.hpp"
#include "studies/response_statistics.hpp"
#include "studies/sweep_options.hpp"
#include "studies/sweep_plan.hpp"

namespace epicyclic::studies {

/// Raised when a change makes the same input give other numbers: results of two versions are never mixed in one folder.
inline constexpr int numerics_version = 25;

/// Mesh periods of a stretch of the spectra of points, and up to how many times the mesh frequency they are kept.
inline constexpr int spectrum_periods = 32;
inline constexpr int spectrum_orders = 8;

/// Points recorded without classification of their regimes: after a fixed transient, by recurrence.
[[nodiscard]] RecordingOptions by_recurrence_alone(RecordingOptions recording);

/// The record of a point without its Poincare section, which is the largest part.
struct PointSummary {
  GridPoint point;
  integrate::Outcome outcome = integrate::Outcome::reached;
  std::string message;              ///< of an outcome other than reached
  analysis::Recurrence recurrence;  ///< of the record; meaningful if reached

  /// The regime [analysis/regime.hpp]: periodic if it is proven, or by recurrence if the study uses recurrence alone.
  analysis::Regime regime = analysis::Regime::undecided;
  int period = 0;               ///< n, if periodic
  bool classified = false;      ///< by more than recurrence: the evidence is there
  analysis::Evidence evidence;  ///< per unit of the mesh phase
  StageRecord meshes;           ///< and bearings, over the record
  long rhs_evaluations = 0;
  std::vector<double> end_state;        ///< what the next point of a chain starts from
  std::vector<double> orbit;            ///< a state on the orbit if the point is periodic by evidence; if Keep::section
  analysis::AttractorRecord attractor;  ///< if Keep::attractor
  double omega = 0;                     ///< Omega: what is per unit of the mesh phase, times Omega, is per tau

  /// Largest Lyapunov exponent per tau; not a number where there is none.
  [[nodiscard]] analysis::Estimate lyapunov_max() const;

  /// Is the point classified as periodic by its orbit, although its record has not converged or is too short to show
  /// it?
  [[nodiscard]] bool is_unconverged() const {
    return classified && regime == analysis::Regime::periodic && recurrence.period == 0;
  }

  /// Has any mesh a tensile force?
  [[nodiscard]] bool has_tension() const {
    return std::max(StageRecord::tension(meshes.sun_planet), StageRecord::tension(meshes.ring_planet)) > 0.0;
  }
};

/// A point with its Poincare section.
struct PointResult : PointSummary {
  std::vector<double> poincare;  ///< rows of poincare_columns(): state, delta_sp_i, delta_rp_i; if Keep::section
  std::size_t poincare_columns = 0;

  /// Amplitudes of delta_sp_1 over the record at k spectrum_resolution times the mesh frequency, averaged over
  /// stretches [analysis::averaged_spectrum()] [b_c]; if Keep::section and reached.
  std::vector<double> spectrum;
  double spectrum_resolution = 0;

  [[nodiscard]] std::size_t poincare_rows() const {
    return poincare_columns == 0 ? 0 : poincare.size() / poincare_columns;
  }
};

/// Not periodic yet, but converging: a longer record would show the regime.
[[nodiscard]] bool still_converging(const PointSummary& result, const RecordingOptions& recording);

/// The regime of a point that was reached: "period 2", "chaotic".
[[nodiscard]] std::string regime_name(const PointSummary& result);

/// The regime of a point that was reached, with its evidence.
[[nodiscard]] std::string regime_text(const PointSummary& result);

/// Names of the columns of PointResult::poincare.
[[nodiscard]] std::vector<std::string> poincare_columns(const model::DynamicModel& model);

/// Appends a row of these columns.
/// @param y  the state at s = 0
/// @param d  used over and over
void append_poincare_row(const model::DynamicModel& model, std::span<const double> y, model::MeshDeflections& d,
                         std::vector<double>& rows);

/// The states of a point's section, without its deflections.
/// @param dimension  of the state
[[nodiscard]] analysis::PoincareSection section_of(const PointResult& result, std::size_t dimension);

/// The model at a value of the sweep parameter; called from several threads at once.
using ModelAt = std::function<model::DynamicModel(double value)>;

/// The model at a point that one value does not determine: of two values, or with a default start of the point's own;
/// called from several threads at once.
using ModelAtPoint = std::function<model::DynamicModel(const GridPoint& point)>;

/// The flows that integrate a point.
struct PointFlows {
  integrate::FlowMaker strobe = integrate::make_flow;                 ///< over the transient and the record
  integrate::FlowMaker classification = make_flow_of_one_trajectory;  ///< for the classification
};

/// Computes one point.
/// @param start  end state of the point before; empty: the model's default start
[[nodiscard]] PointResult compute_point(const GridPoint& point, const model::DynamicModel& model,
                                        const std::vector<double>& start, const RecordingOptions& recording,
                                        const integrate::IntegratorOptions& integrator,
                                        const std::function<bool()>& go_on, const PointFlows& flows = {});

/// A point as a sweep computes it, to the last bit: with a method of lanes, its classification uses lanes, too.
[[nodiscard]] PointResult compute_point_as_swept(const GridPoint& point, const model::DynamicModel& model,
                                                 const std::vector<double>& start, const RecordingOptions& recording,
                                                 const integrate::IntegratorOptions& integrator,
                                                 const std::function<bool()>& go_on);

/// Use of the shared lanes: the room for evaluations of the right-hand side, and how many evaluations belonged to a
/// trajectory.
struct LaneUse {
  std::size_t room = 0;
  std::size_t taken = 0;

  /// The used part of the room; nothing if there were no lanes.
  [[nodiscard]] std::optional<double> occupancy() const {
    if (room == 0) return std::nullopt;
    return static_cast<double>(taken) / static_cast<double>(room);
  }
};

/// How a sweep is run; no member changes a result. Results are not kept here: a sweep may be larger than memory.
struct SweepRun {
  int threads = 1;
  const std::atomic<bool>* stop = nullptr;  ///< set to true: return soon, without the points in progress

  std::vector<bool> done;  ///< points of an earlier run, by index; empty: none
  /// The end state of such a point; several threads may call it at once. Needed if chains have more than one point.
  std::function<std::vector<double>(std::size_t index)> end_state;

  std::function<void(const PointResult&)> point_finished;  ///< called for each new point, one at a time

  LaneUse* lane_use = nullptr;  ///< added to by all threads of this process, if it is wanted

  /// The next chain to compute, nothing if there are no more. Several threads may call it at once. Without this
  /// function, all chains are computed, in order.
  std::function<std::optional<std::size_t>()> next_chain;
  int threads_of_all = 0;   ///< of all processes that take chains from next_chain; 0: only those here
  std::size_t process = 0;  ///< which of them this is
};

/// @returns how many points are new; fewer than were missing only if stopped, or if others took chains
/// @throws the first exception of a point or of a function of `run`
[[nodiscard]] std::size_t run_sweep(const SweepPlan& plan, const RecordingOptions& recording,
                                    const integrate::IntegratorOptions& integrator, const ModelAtPoint& model_at,
                                    const SweepRun& run);

/// Runs a sweep of few points, which are kept in memory.
/// @throws the first exception of a point or of a function of `run`; InputError if one of `done` is not of this plan
/// @param done  points of an earlier run
/// @returns points in order of their index; incomplete only if stopped
[[nodiscard]] std::vector<PointResult> run_sweep_in_memory(const SweepPlan& plan, const RecordingOptions& recording,
                                                           const integrate::IntegratorOptions& integrator,
                                                           const ModelAtPoint& model_at, SweepRun run,
                                                           std::map<std::size_t, PointResult> done = {});
[[nodiscard]] std::vector<PointResult> run_sweep_in_memory(const SweepPlan& plan, const RecordingOptions& recording,
                                                           const integrate::IntegratorOptions& integrator,
                                                           const ModelAt& model_at, SweepRun run,
                                                           std::map<std::size_t, PointResult> done = {});

}  // namespace epicyclic::studies
