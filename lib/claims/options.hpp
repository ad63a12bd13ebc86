// What a publication says of a stage, as data: sweeps, and claims that are conditions on what the sweeps show.
//
// A claim holds where all of its conditions do. Each condition is a number that is measured of a sweep and a bound on
// it; how far it is from holding is a cost between 0 and 1, so that the same data score a stage (reproduce) and lead a
// search for its unstated parameters (calibrate).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "claims/parameter_space.hpp"
#include "studies/recording_options.hpp"
#include "studies/sweep_options.hpp"

namespace epicyclic::claims {

/// A number of the study in place of another one, by the name of a parameter or a JSON pointer: a value, or as another
/// number of the input is.
struct SetValue {
  std::string parameter;
  std::optional<double> value;
  std::string same_as;  ///< JSON pointer
};

/// A sweep that conditions speak of.
struct ClaimSweep {
  std::string name;
  studies::Axis axis = {studies::speed_parameter, 0.2, 3.5, 661};
  std::vector<SetValue> at;  ///< what differs from the study besides
  std::vector<studies::Direction> directions = {studies::Direction::up};
  std::optional<int> recorded_periods;  ///< where not the study's: extrema of chaos take long records
  int screening_points = 30;            ///< of a brief look, cold
  int survey_points = 60;               ///< of a survey's look, cold
  int screening_round = 0;  ///< a brief look takes sweeps of a round only if those of earlier rounds leave hope
};

enum class ConditionKind {
  share,       ///< part of the points that move so
  count,       ///< number of points that move so
  change,      ///< value where one motion gives way to another
  sequence,    ///< motions met one after the other
  value,       ///< a statistic of a quantity
  reduction,   ///< ratio of a quantity's first value to its last; never above the first
  peaks,       ///< local maxima of a quantity at given values
  jump,        ///< a discontinuity of a quantity of one motion, or two motions of it side by side
  variation,   ///< largest relative change of the motion's Poincare range between neighbours; a new motion counts 1
  agreement,   ///< share of points where both kinds of mesh show the same motion, and correlation of their ranges
  decreasing,  ///< the largest value of a quantity falls from sweep to sweep
};

inline constexpr std::array<std::pair<std::string_view, ConditionKind>, 11> condition_kinds = {
    {{"share", ConditionKind::share},
     {"count", ConditionKind::count},
     {"change", ConditionKind::change},
     {"sequence", ConditionKind::sequence},
     {"value", ConditionKind::value},
     {"reduction", ConditionKind::reduction},
     {"peaks", ConditionKind::peaks},
     {"jump", ConditionKind::jump},
     {"variation", ConditionKind::variation},
     {"agreement", ConditionKind::agreement},
     {"decreasing", ConditionKind::decreasing}}};

/// Of a condition on peaks that does not say.
inline constexpr double default_location_tolerance = 0.1;
inline constexpr double default_prominence = 0.1;

enum class Which { first, last };
enum class Statistic { min, mean, max };

/// A condition on a sweep. Which members speak depends on the kind [studies/claims.cpp]; validate() asks for them.
struct Condition {
  ConditionKind kind = ConditionKind::share;
  std::string sweep;
  std::vector<std::string> sweeps;   ///< decreasing: one after another
  std::optional<double> from, to;    ///< part of the sweep [of its parameter]; the whole if not given
  std::string regime;                ///< share, count, change (before it), jump, decreasing (of the first sweep)
  std::string regime_after;          ///< change: the motion after it
  std::string leads_to;              ///< change: what is met before `regime` comes back, if given
  std::vector<std::string> regimes;  ///< sequence
  std::optional<Which> which;        ///< change: of several, along the rising parameter; the first if not given
  std::vector<double> within;        ///< change: least and greatest value
  std::optional<double> at_least, at_most;
  std::string quantity;                      ///< of claim_quantities
  std::optional<Statistic> statistic;        ///< value: the largest if not given
  std::vector<double> peak_locations;        ///< peaks
  std::optional<double> location_tolerance;  ///< peaks: relative distance from a place
  std::optional<double> prominence;          ///< peaks: in parts of the largest value
  std::optional<double> correlation;         ///< agreement: of the two ranges
};

/// Quantities of a point that conditions speak of, of planet 1 where they are of a mesh. [b_c], exponent per tau.
inline constexpr std::array<std::string_view, 17> claim_quantities = {
    "delta_sp_range",    "delta_rp_range",    "delta_sp_max",           "delta_rp_max",
    "poincare_sp_range", "poincare_rp_range", "planet_spread",          "lyapunov_max",
    "delta_sp_rms",      "delta_rp_rms",      "transmission_error_rms", "transmission_error_range",
    "force_sp_max",      "force_rp_max",      "dynamic_factor_sp",      "dynamic_factor_rp",
    "load_sharing_max"};

struct Claim {
  std::string name;       ///< "C01"
  std::string text;       ///< what is claimed
  std::string where;      ///< "Fig. 12"
  std::string published;  ///< the value that is published
  double weight = 1;      ///< of its cost in a search
  std::vector<Condition> conditions;
};

enum class MeshSide { sun_planet, ring_planet };

/// A bifurcation diagram of the deflection of planet 1's mesh.
struct ClaimPanel {
  std::string sweep;
  MeshSide mesh = MeshSide::sun_planet;
  std::string title;
};

/// A figure of panels under each other that have one parameter, as the publication has them.
struct ClaimFigure {
  std::string name;  ///< of its file
  std::string title;
  std::vector<ClaimPanel> panels;
};

/// How candidates and draws are looked at: cold starts, short records, the sweeps' brief grids.
struct Screening {
  int transient_periods = 160;
  int recorded_periods = 32;
  int classification_periods = 0;  ///< 0: regimes are told by a glance, from recurrence and growth
  int growth_periods = 64;         ///< of that glance; 0: what does not recur within the record counts as chaotic
  double relative_tolerance = 1e-5;
};

/// Draws from the ranges: how robust is what is claimed to what is not said?
struct SurveyOptions {
  int draws = 1000;
  int seed = 1;
  int confirmed = 0;  ///< of the draws: held against whole sweeps too, to see whether their looks can be trusted
  Screening recording;
};

enum class SearchMethod {
  differential_evolution,  ///< looks everywhere
  covariance_adaptation,   ///< goes on from the stage as it is given
};

/// What the cost of conditions on motions goes by where they fail.
enum class SearchLead {
  regimes,      ///< how many points move as they should, and where they do
  multipliers,  ///< those of the orbit of period 1 along the sweeps [studies/period_one.hpp]
};

struct SearchOptions {
  SearchMethod method = SearchMethod::differential_evolution;
  SearchLead regime_cost = SearchLead::regimes;
  double spread = 0.15;  ///< covariance adaptation: of its first candidates, in parts of the ranges
  int seed = 1;
  int islands = 4;
  int population = 24;          ///< candidates on an island, at least 7
  int candidates = 10000;       ///< evaluated in all by the islands
  int migration_interval = 10;  ///< generations between exchanges of the best candidates
  int refinement = 400;         ///< candidates of the local refinement of the best
  int confirmed = 0;            ///< of the best: held against whole sweeps, and the one that meets most is the result
  int profile = 9;              ///< values of each parameter in the profile of the score
};

struct ClaimsOptions {
  studies::RecordingOptions recording;
  std::vector<studies::Start> starts = {studies::Start::continued,
                                        studies::Start::cold};  ///< the first is the verdict, others stand beside it
  std::vector<ClaimSweep> sweeps;
  std::vector<Claim> claims;
  std::vector<ClaimFigure> figures;
  Screening screening;
  ParameterSpace space;
  SearchOptions search;
  SurveyOptions survey;

  /// A sweep of the claims in full, from one kind of start.
  [[nodiscard]] studies::SweepOptions whole_sweep(const ClaimSweep& sweep, studies::Start start) const;

  /// What is wrong, each at its place below the study: ("/claims/3/conditions/0/regime", "is ..., must be ...").
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> problems() const;
};

/// Is it a motion that conditions can name: "period 3", "periodic", "multi-period" (periodic, of 2 or more mesh
/// periods), "quasiperiodic", "chaotic", "aperiodic" (either of them), or "not " and one of these?
[[nodiscard]] bool is_motion_word(std::string_view word);

/// N of "period N", also behind "not "; 0 of other words.
[[nodiscard]] int motion_period(std::string_view word);

/// Does it, or what it denies, name a motion that recurrence alone does not tell: a torus, chaos?
[[nodiscard]] bool is_told_by_evidence(std::string_view word);

}  // namespace epicyclic::claims
