// Claims compared with sweeps [studies/claims_options.hpp].
//
// Every condition gives a measured number, its error due to the sweep's grid, and a cost. The cost is 0 if the
// condition holds. Else it is between 0.1 and 1, and falls as the number comes nearer. The cost of a claim is the mean
// of its conditions' costs, so that a search sees each of them. A claim holds if all its conditions hold.
//
//   cost of a number x that has to be within [a, b]:  0.1 + 0.9 d / (d + w),  d the distance, w = b - a [C-cost]
//
// If orbits of period 1 were followed, a condition on regimes that fails costs the mean of that and of 0.1 + 0.9 l.
// Here l is the mean of what points lack of their regimes [P-lack]. These points depend on the kind of condition:
//   share                all points
//   change               those from the ends of the sweep (or of the condition) to its bounds
//   number of points     as many as required, those that lack least
//   sequence             one point for each regime
//   jump                 what the largest real multiplier lacks to 1
//
// A change between two regimes is placed halfway between the two points that enclose it, with half their distance as
// its error. Failed points count as no regime at all, and against an upper bound. The Poincare range of period 1 is 0.
// Grid values equal a bound if they differ from it by rounding alone.
//
// As printed, points have the regimes that the dots of their bifurcation diagrams have, those of delta_sp,1 and, for
// the ring's mesh, of delta_rp,1. A claim also holds as printed if all its conditions `as_printed` hold.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "claims/options.hpp"
#include "claims/period_one.hpp"
#include "claims/printed_diagram.hpp"
#include "studies/point_source.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::claims {

/// Version of judge(): it is raised when the judgement of the same points may change.
inline constexpr int judging_version = 5;

/// How points were evaluated. In a screening, a record without recurrence counts as chaotic, and one that approaches
/// recurrence counts as periodic. In full, a regime that the evidence does not decide stays undecided.
enum class Depth { screening, in_full };

/// The regime of a point, as conditions use it.
struct ClaimRegime {
  analysis::Regime regime = analysis::Regime::undecided;
  int period = 0;           ///< if periodic
  bool classified = false;  ///< by more than a glance; otherwise what does not recur counts as chaotic
  bool drawn = false;       ///< as printed: chaotic is any cloud of dots

  /// @param word  of is_regime_word()
  [[nodiscard]] bool is(std::string_view word) const;
  [[nodiscard]] bool same(const ClaimRegime& other) const { return regime == other.regime && period == other.period; }
  [[nodiscard]] std::string text() const;
};

struct ClaimPoint {
  double value = 0;
  bool reached = false;
  bool converged =
      true;  ///< false if the response is periodic and the record has not converged: its extrema are unknown
  ClaimRegime response;
  ClaimRegime by_sun_mesh, by_ring_mesh;  ///< from the deflection of planet 1's mesh alone
  std::array<double, claim_quantities.size()> quantities{};
  std::vector<double> columns;                    ///< of column_quantities()
  std::vector<double> sun_section, ring_section;  ///< Poincare points of planet 1's meshes, rising [b_c]
  std::optional<PeriodOne> period_one;            ///< where it was followed
  std::optional<DotColumn> dots;                  ///< of the sun's mesh, where they lead a search
  /// Least and greatest Poincare point of the sun's mesh over the length of the axis; as printed only.
  std::optional<std::array<double, 2>> drawn;

  [[nodiscard]] double quantity(std::string_view name) const;
  double& quantity_of(std::string_view name);
  /// What it lacks of a regime, by period_one or dots.
  /// @returns nothing if neither is there, or if it does not determine the lack
  [[nodiscard]] std::optional<double> lacks(std::string_view word) const;
};

/// Further quantities of a point: the columns of numbers of a whole stage in points.csv, in their units.
[[nodiscard]] const std::vector<std::string>& column_quantities();

/// @param result  with its Poincare section
[[nodiscard]] ClaimPoint claim_point(const studies::PointResult& result, const studies::RecordingOptions& recording,
                                     Depth depth);

/// One natural frequency of a stage.
struct ClaimMode {
  double frequency_Hz = 0;
  std::string_view type;  ///< of mode_types
  int multiplicity = 1;
};

/// A sweep's points by rising value, or a stage's natural frequencies.
struct ClaimSeries {
  std::vector<ClaimPoint> points;
  std::vector<ClaimPoint> other;  ///< at the same values from elsewhere (the other direction), if there are any
  studies::Direction direction = studies::Direction::up;  ///< of the points
  std::vector<ClaimMode> modes;                           ///< by rising frequency
};

/// The direction of the verdicts: up, or down if there is no other.
[[nodiscard]] studies::Direction judged_direction(const studies::PointSource& points);

/// A sweep's points in full: those up, and beside them those down, if there are any.
[[nodiscard]] ClaimSeries claim_series(const studies::PointSource& points, const studies::RecordingOptions& recording);

/// The dots of all points of a series, on the axis of its points.
void add_dots(ClaimSeries& series, const PrintedDots& ink, double recurrence_tolerance);

/// A series with the regimes that a printed diagram shows.
[[nodiscard]] ClaimSeries as_printed(ClaimSeries series, const PrintedDots& ink, double recurrence_tolerance);

/// The natural frequencies that a condition is about, and those that are published.
struct ModeMatch {
  std::vector<std::size_t> modes;  ///< numbers of the stage's modes of that type
  std::vector<double> published;   ///< [Hz], rising
  std::vector<double> tolerance;   ///< of each [Hz]
};
[[nodiscard]] ModeMatch matched_modes(const Condition& condition, const std::vector<ClaimMode>& modes);

/// A quantity at a value of the parameter, linear between the neighbouring points.
/// @returns not a number outside the points, or next to one that failed
[[nodiscard]] double quantity_at(const std::vector<ClaimPoint>& points, std::string_view quantity, double value);

/// Series by the names of the sweeps and stages.
using ClaimRecord = std::map<std::string, ClaimSeries, std::less<>>;

/// A series as a reading has it; by evidence it is the series itself.
[[nodiscard]] ClaimSeries read_as(Reading reading, ClaimSeries series, const ClaimsOptions& options);

/// Name for points that are not `converged`, in the texts of outcomes.
inline constexpr std::string_view not_converged = "not converged";

struct ConditionOutcome {
  bool holds = false;
  double measured = 0;  ///< not a number if there is nothing to measure
  double error = 0;
  bool part_of_one = false;  ///< the text prints the number and the error in percent
  double cost = 1;
  std::string text;  ///< "chaotic from 0.6025 on, must be within 0.57 to 0.63"
};

/// @throws std::out_of_range if the record does not have the condition's sweeps
[[nodiscard]] ConditionOutcome judge(const Condition& condition, const ClaimRecord& record);

struct ClaimOutcome {
  bool holds = false;
  double cost = 1;
  std::vector<ConditionOutcome> conditions;
  bool inert = false;  ///< nothing that it depends on changes along its sweeps, by symmetry, say
};

/// @param record  of series of read_as()
[[nodiscard]] ClaimOutcome judge(const Claim& claim, const ClaimRecord& record, Reading reading = Reading::evidence);

/// Names of the sweeps of a claim.
[[nodiscard]] std::vector<std::string> sweeps_of(const Claim& claim);

}  // namespace epicyclic::claims
