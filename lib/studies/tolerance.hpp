// Reliability of a result: several tolerances, methods and widths of the smooth clearance at each point.
//
// A point is periodic, of period n, if the study's own integrator classifies it so, as in any other study
// [studies/classification.hpp]:
//   its orbit y* by Newton's method at the reference tolerance, with the monodromy M;
//   each method and tolerance starts on y* and is integrated over one orbit:
//     error of the flow    e   = max | phi'_n(y*) - phi_n(y*) |
//     error of the orbit   e_o = max | y' - y* | ,  y' the method's own orbit, y' = y' + (I - M)^-1 (phi'_n(y') - y')
//     [A-tol]
//   the reported quantities on the study's orbit and on y*: the difference is their error bar. Beside it stands their
//     change with tables half as fine (friction and stiffness computed from the drawing or from an oil). The error of
//     interpolation is some 16 times less, has the same shape, and so the same resonances;
//   extrema are those at the output phases; their change at 16 times as many phases stands beside the error bar;
//   each width w: the orbit of the smoothed stage by Newton's method, its distance from y*, its quantities, and those
//     extrapolated to w -> 0 with the exponent that three widths in a row show.
// Any other point has no orbit to compare. It has its largest exponent, and mean and deviation of the Poincare points,
// each with its confidence interval [A-mean]. The study reports whether these overlap the reference's.
//
// Limits: e_o requires an orbit that persists. Near a bifurcation |I - M| is near 0, and e_o is then large.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/periodic_orbit.hpp"
#include "analysis/statistics.hpp"
#include "integrate/options.hpp"
#include "studies/crosscheck.hpp"
#include "studies/sweep.hpp"
#include "studies/tolerance_options.hpp"

namespace epicyclic::studies {

/// The reported quantities of a point.
inline constexpr std::array<const char*, 4> quantity_names = {"delta_sp_min", "delta_sp_max", "delta_rp_min",
                                                              "delta_rp_max"};
using Quantities = std::array<double, quantity_names.size()>;  ///< of planet 1, at the output phases [b_c]

/// One method at one tolerance on a periodic orbit.
struct LadderStep {
  std::string method;
  double tolerance = 0;
  integrate::Outcome outcome = integrate::Outcome::reached;
  double error = 0;         ///< e
  double orbit_error = 0;   ///< e_o; not a number if the iteration left the orbit
  Quantities quantities{};  ///< on the method's own orbit
  integrate::Work work{};   ///< of one orbit
  double seconds = 0;       ///< of one orbit, least of three; volatile: not part of any result
};

/// The orbit of the smoothed stage.
struct SmoothingStep {
  double width = 0;
  bool found = false;
  double distance = 0;  ///< from the orbit with exact clearance
  Quantities quantities{};
  integrate::Work work{};  ///< of one orbit with the study's integrator
};

/// One method at one tolerance if there is no orbit.
struct StatisticsStep {
  std::string method;
  double tolerance = 0;
  double width = 0;
  integrate::Outcome outcome = integrate::Outcome::reached;
  analysis::Estimate exponent;                        ///< per tau
  std::array<analysis::Estimate, 2> mean, deviation;  ///< of delta_sp_1 and delta_rp_1 at the section [b_c]
  long right_hand_sides = 0;
};

struct TolerancePoint {
  GridPoint point;
  PointResult study;  ///< by the study's own integrator
  std::string note;   ///< why there is no orbit, if there is none
  // of a periodic point
  int period = 0;  ///< 0: not periodic, or no orbit found
  std::vector<double> orbit;
  double reference_residual = 0;  ///< of the shooting
  double distance_from_orbit =
      0;  ///< of the study's last state from y*: the remainder of the transient, and the study's e_o
  double largest_multiplier = 0;  ///< modulus
  Quantities reference{};         ///< on y*
  Quantities reference_error{};   ///< difference to the reference by another method at the same tolerance
  Quantities table_error{};       ///< difference to those on the orbit of tables half as fine; 0 without such tables
  double table_displacement = 0;  ///< of that orbit
  Quantities between_phases{};    ///< of y*: by how much each extremum is greater at `finer_phases` times the phases
  std::vector<LadderStep> ladder;
  integrate::Work study_work{};  ///< of one orbit with the study's integrator and clearance
  std::vector<SmoothingStep> smoothing;
  Quantities extrapolated{};  ///< to w -> 0; not a number where the widths show no exponent
  Quantities exponent{};      ///< p in Q(w) - Q(0) ~ w^p
  // of any other
  std::vector<StatisticsStep> statistics;  ///< the reference first
};

/// Output phases for the check of an extremum, over those that determine it.
inline constexpr int finer_phases = 16;

/// Mesh periods before `chaotic_periods`: the tangent vector aligns with its direction of growth.
inline constexpr int aligning_periods = 100;

/// Cost of a step in right-hand sides, a Jacobian counted as `dimension` of them.
[[nodiscard]] double cost(const integrate::Work& work, std::size_t dimension);

/// The compared quantities of two steps.
inline constexpr std::array<const char*, 5> statistics_names = {"largest exponent", "mean delta_sp", "mean delta_rp",
                                                                "deviation delta_sp", "deviation delta_rp"};
[[nodiscard]] std::array<analysis::Estimate, statistics_names.size()> statistics_of(const StatisticsStep& step);

/// Those, by their places, whose intervals have no point in common. Of steps that were reached.
[[nodiscard]] std::vector<std::size_t> differing_statistics(const StatisticsStep& a, const StatisticsStep& b);

/// Both were reached, and all intervals overlap.
[[nodiscard]] bool statistics_agree(const StatisticsStep& a, const StatisticsStep& b);

/// Slope of log error over log tolerance, and over log right-hand sides, of one method: least squares over the steps
/// whose error is above `floor` and below 1e-2.
struct Slopes {
  std::string method;
  double over_tolerance = 0;
  double over_cost = 0;
  int steps = 0;  ///< that entered; slopes are not numbers for fewer than 3
};
[[nodiscard]] std::vector<Slopes> slopes(const std::vector<TolerancePoint>& points, std::size_t dimension,
                                         double floor);

/// The cheapest method and tolerance whose orbit error meets the target at every periodic point.
struct Recommendation {
  std::string method;
  double tolerance = 0;
  double cost_per_period = 0;  ///< mean over the points [right-hand sides]
  double largest_error = 0;
  bool smoothing_pays = false;  ///< some width has a bias below the target and saves right-hand sides
  double width = 0;             ///< the widest of those
  double saved = 0;             ///< share of the study's right-hand sides that it saves [-]
};
[[nodiscard]] std::optional<Recommendation> recommend(const std::vector<TolerancePoint>& points, std::size_t dimension,
                                                      double target);

/// One point. Its units (methods, tolerances, widths) run on several threads; the result does not depend on how many.
[[nodiscard]] TolerancePoint compute_tolerance_point(const PointResult& study, const RecordingOptions& recording,
                                                     const ToleranceOptions& options,
                                                     const integrate::IntegratorOptions& integrator,
                                                     double study_smoothing, const SmoothedModelAt& model_at,
                                                     int threads, const std::atomic<bool>* stop);

}  // namespace epicyclic::studies
