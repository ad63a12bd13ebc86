// Claims held against sweeps [studies/claims_options.hpp].
//
// Every condition gives a measured number, the error of it that the sweep's grid leaves, and a cost: 0 where it holds,
// else between 0.1 and 1, less the nearer it is. The cost of a claim is the mean of its conditions' costs, so that a
// search sees each of them; it holds where all do.
//
//   cost of a number x that has to be within [a, b]:  0.1 + 0.9 d / (d + w),  d the distance, w = b - a [C-cost]
//
// Where orbits of period 1 were followed, a condition on motions that fails costs the mean of that and of 0.1 + 0.9 l,
// l what points lack of their motions in the mean [P-lack]: all of them for a share; of a change those from the sweep's
// (or the condition's) ends to its bounds; for a number of points as many as there have to be, those that lack least,
// and one for each motion of a sequence; for a jump what the largest real multiplier is short of 1.
//
// A change between two motions is told halfway between the two points that it lies between, with half their distance as
// its error. Points that failed count as no motion at all, and against an upper bound. The Poincare range of period 1
// is 0. Grid values are those bounds that they differ from by rounding alone.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "claims/options.hpp"
#include "claims/period_one.hpp"
#include "studies/point_source.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::claims {

/// Of judge(): it changes when what is judged of the same points may change.
inline constexpr int judging_version = 4;

/// How long points were looked at: by a glance, what does not recur counts as chaotic, and what comes nearer and nearer
/// to recurring as periodic; in full, what evidence does not decide is of no motion.
enum class Depth { screening, in_full };

/// What a point moves like, as conditions see it.
struct ClaimRegime {
  analysis::Regime regime = analysis::Regime::undecided;
  int period = 0;           ///< if periodic
  bool classified = false;  ///< by more than a glance; otherwise what does not recur counts as chaotic

  /// @param word  of is_motion_word()
  [[nodiscard]] bool is(std::string_view word) const;
  [[nodiscard]] bool same(const ClaimRegime& other) const { return regime == other.regime && period == other.period; }
  [[nodiscard]] std::string text() const;
};

struct ClaimPoint {
  double value = 0;
  bool reached = false;
  bool converged =
      true;  ///< false where the motion is periodic and the record is on its way to it: it tells no extrema
  ClaimRegime response;
  ClaimRegime by_sun_mesh, by_ring_mesh;  ///< told from the deflection of planet 1's mesh alone
  std::array<double, claim_quantities.size()> quantities{};
  std::optional<PeriodOne> period_one;  ///< where it was followed

  [[nodiscard]] double quantity(std::string_view name) const;
};

/// @param result  with its Poincare section
[[nodiscard]] ClaimPoint claim_point(const studies::PointResult& result, const studies::RecordingOptions& recording,
                                     Depth depth);

/// A sweep's points by rising value.
struct ClaimSeries {
  std::vector<ClaimPoint> points;
  std::vector<ClaimPoint> other;  ///< at the same values from elsewhere (the other direction), if there are any
};

/// The direction that verdicts are on: up, or down where there is no other.
[[nodiscard]] studies::Direction judged_direction(const studies::PointSource& points);

/// A sweep's points in full, up and beside them those down, if there are any.
[[nodiscard]] ClaimSeries claim_series(const studies::PointSource& points, const studies::RecordingOptions& recording);

/// By the sweeps' names.
using ClaimRecord = std::map<std::string, ClaimSeries, std::less<>>;

/// As the texts of outcomes call points that are not `settled`.
inline constexpr std::string_view not_converged = "not converged";

struct ConditionOutcome {
  bool holds = false;
  double measured = 0;  ///< not a number where there is nothing to measure
  double error = 0;
  bool part_of_one = false;  ///< the text tells it, and so is the error to be told, in percent
  double cost = 1;
  std::string text;  ///< "chaotic from 0.6025 on, must be within 0.57 to 0.63"
};

/// @throws std::out_of_range when the record has not the condition's sweeps
[[nodiscard]] ConditionOutcome judge(const Condition& condition, const ClaimRecord& record);

struct ClaimOutcome {
  bool holds = false;
  double cost = 1;
  std::vector<ConditionOutcome> conditions;
  bool inert = false;  ///< along its sweeps nothing changes at all of what it speaks of, by symmetry, say
};

[[nodiscard]] ClaimOutcome judge(const Claim& claim, const ClaimRecord& record);

/// Names of the sweeps that a claim speaks of.
[[nodiscard]] std::vector<std::string> sweeps_of(const Claim& claim);

}  // namespace epicyclic::claims
