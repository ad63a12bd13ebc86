// Bifurcation diagram by brute force: one parameter along a grid, up, down or both, the motion strobed at each value.
//
// Points are numbered along the first direction, then the second. A carried sweep is a chain per direction (or per
// segment of it): a point starts from the end state of the one before, so that it follows a branch and shows
// hysteresis. A point is a pure function of its value and start state, hence the result does not depend on the number
// of threads, and a sweep that was stopped goes on with the same bytes. A point that does not end in `reached` makes
// the next one of its chain start cold.
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
#include "studies/motion.hpp"
#include "studies/response_statistics.hpp"
#include "studies/sweep_options.hpp"
#include "studies/sweep_plan.hpp"

namespace epicyclic::studies {

/// Raised when a change makes the same input give other numbers: results of two versions are never mixed in one folder.
inline constexpr int numerics_version = 24;

/// Mesh periods of a stretch of the spectra of points, and up to how many times the mesh frequency they are kept.
inline constexpr int spectrum_periods = 32;
inline constexpr int spectrum_orders = 8;

/// How points are looked at without the classification of their regimes: after a fixed transient, by recurrence.
[[nodiscard]] RecordingOptions by_recurrence_alone(RecordingOptions recording);

/// What is recorded of a point but its Poincare section, which is most of a record.
struct PointSummary {
  GridPoint point;
  integrate::Outcome outcome = integrate::Outcome::reached;
  std::string message;              ///< of an outcome other than reached
  analysis::Recurrence recurrence;  ///< of the record; meaningful if reached

  /// What the motion is [analysis/regime.hpp]: periodic where it is proven, or where nothing but recurrence was asked.
  analysis::Regime regime = analysis::Regime::undecided;
  int period = 0;               ///< n, if periodic
  bool classified = false;      ///< by more than recurrence: the evidence is there
  analysis::Evidence evidence;  ///< per unit of the mesh phase
  StageRecord meshes;           ///< and bearings, over the record
  long rhs_evaluations = 0;
  std::vector<double> end_state;  ///< what the next point of a chain starts from
  std::vector<double> orbit;      ///< a state on the orbit of a motion that is periodic by evidence; if Keep::section
  analysis::AttractorRecord attractor;  ///< if Keep::attractor
  double omega = 0;                     ///< Omega: what is per unit of the mesh phase, times Omega, is per tau

  /// Largest Lyapunov exponent per tau; not a number where there is none.
  [[nodiscard]] analysis::Estimate lyapunov_max() const;

  /// Is it told periodic by its orbit, while the record is still on its way to it, or too short to show it?
  [[nodiscard]] bool is_unsettled() const {
    return classified && regime == analysis::Regime::periodic && recurrence.period == 0;
  }

  /// Does any mesh pull?
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

/// Not periodic yet, but on its way: a longer look would tell the regime.
[[nodiscard]] bool still_converging(const PointSummary& result, const RecordingOptions& recording);

/// What a point that was reached moves like: "period 2", "chaotic".
[[nodiscard]] std::string regime_name(const PointSummary& result);

/// What a point that was reached moves like, with what the regime rests on.
[[nodiscard]] std::string motion_text(const PointSummary& result);

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

/// The model at a point where a value does not say all: of two values, or with a default start of the point's own;
/// called from several threads at once.
using ModelAtPoint = std::function<model::DynamicModel(const GridPoint& point)>;

/// What carries the motion of a point.
struct PointFlows {
  integrate::FlowMaker strobe = integrate::make_flow;         ///< over the transient and the record
  integrate::FlowMaker motion = make_flow_of_one_trajectory;  ///< while it is told what it is
};

/// Computes one point.
/// @param start  end state of the point before; empty: the model's default start
[[nodiscard]] PointResult compute_point(const GridPoint& point, const model::DynamicModel& model,
                                        const std::vector<double>& start, const RecordingOptions& recording,
                                        const integrate::IntegratorOptions& integrator,
                                        const std::function<bool()>& go_on, const PointFlows& flows = {});

/// A point as a sweep computes it, to the last bit: by a method of lanes all that is told of the motion is told in
/// lanes.
[[nodiscard]] PointResult compute_point_as_swept(const GridPoint& point, const model::DynamicModel& model,
                                                 const std::vector<double>& start, const RecordingOptions& recording,
                                                 const integrate::IntegratorOptions& integrator,
                                                 const std::function<bool()>& go_on);

/// What lanes that motions share did: of all evaluations of the right-hand side, how many there was room for in the
/// lanes, and how many of them were of a motion.
struct LaneUse {
  std::size_t room = 0;
  std::size_t taken = 0;

  /// The part of the room that was taken; nothing where there were no lanes.
  [[nodiscard]] std::optional<double> occupancy() const {
    if (room == 0) return std::nullopt;
    return static_cast<double>(taken) / static_cast<double>(room);
  }
};

/// How a sweep is run; none of it changes a result. Results are not kept here: a sweep may be larger than memory.
struct SweepRun {
  int threads = 1;
  const std::atomic<bool>* stop = nullptr;  ///< set to true: return soon, without the points under way

  std::vector<bool> done;  ///< points of an earlier run, by index; empty: none
  /// Where such a point ended; asked by several threads at once. Needed if chains have more than one point.
  std::function<std::vector<double>(std::size_t index)> end_state;

  std::function<void(const PointResult&)> point_finished;  ///< called for each new point, one at a time

  LaneUse* lane_use = nullptr;  ///< added to by all threads of this process, if it is wanted

  /// The next chain to compute, nothing if there are no more; asked by several threads at once. Where there is none,
  /// all chains, in order.
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
