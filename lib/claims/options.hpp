// Statements of a publication on a stage, as data: sweeps, and claims. Claims are conditions on the results of the
// sweeps.
//
// A claim holds if all of its conditions do. Each condition is a number that is measured in a sweep and a bound on it.
// Its distance from the bound is a cost between 0 and 1. The same data judge a stage (reproduce) and lead a search for
// its unstated parameters (calibrate).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "claims/parameter_space.hpp"
#include "claims/printed_diagram.hpp"
#include "studies/recording_options.hpp"
#include "studies/sweep_options.hpp"

namespace epicyclic::claims {

/// A number of the study that replaces another one, by the name of a parameter or a JSON pointer. It is a value, or
/// equal to another number of the input.
struct SetValue {
  std::string parameter;
  std::optional<double> value;
  std::string same_as;  ///< JSON pointer
};

/// The study's stage with other values, for conditions on its natural frequencies.
struct ClaimStage {
  std::string name;
  std::vector<OptionSet> sets;  ///< values of any kind that differ from the study
  std::vector<SetValue> at;     ///< numbers that differ from that
};

/// A sweep of the conditions.
struct ClaimSweep {
  std::string name;
  studies::Axis axis = {studies::speed_parameter, 0.2, 3.5, 661};
  std::vector<OptionSet> sets;  ///< values of any kind that differ from the study
  std::vector<SetValue> at;     ///< numbers that differ from that
  std::vector<studies::Direction> directions = {studies::Direction::up};
  std::optional<int> recorded_periods;  ///< if not the study's: extrema of chaos need long records
  int screening_points = 30;            ///< of a screening, cold
  int survey_points = 60;               ///< of a screening in a survey, cold
  int screening_round = 0;  ///< a screening computes sweeps of a round only if those of earlier rounds leave a chance
};

enum class ConditionKind {
  share,        ///< part of the points with this regime
  count,        ///< number of points with this regime
  change,       ///< value where one regime changes to another
  sequence,     ///< regimes that follow one another
  value,        ///< a statistic of a quantity
  reduction,    ///< ratio of a quantity's first value to its last; never above the first
  peaks,        ///< local maxima of a quantity at given values
  jump,         ///< a discontinuity of a quantity of one regime, or two attractors of one regime at the same value
  variation,    ///< largest relative change of the Poincare range between neighbours; a new regime counts 1
  agreement,    ///< share of points where both kinds of mesh have the same regime, and correlation of their ranges
  decreasing,   ///< the largest value of a quantity falls from sweep to sweep
  curve,        ///< a quantity at given values of the parameter, compared with published numbers
  frequencies,  ///< natural frequencies of a stage, compared with published ones
};

inline constexpr std::array<std::pair<std::string_view, ConditionKind>, 13> condition_kinds = {
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
     {"decreasing", ConditionKind::decreasing},
     {"curve", ConditionKind::curve},
     {"frequencies", ConditionKind::frequencies}}};

/// Default for a condition on peaks.
inline constexpr double default_location_tolerance = 0.1;
inline constexpr double default_prominence = 0.1;

enum class Which { first, last };
enum class Statistic { min, mean, max };

/// Types of modes; `other` if the planets are unlike or unevenly spaced [model/modes.hpp].
inline constexpr std::array<std::string_view, 4> mode_types = {"rotational", "translational", "planet", "other"};

/// A condition on a sweep. Its kind determines which members it uses [studies/claims.cpp]; validate() requires them.
struct Condition {
  ConditionKind kind = ConditionKind::share;
  std::string sweep;
  std::vector<std::string> sweeps;   ///< decreasing: one after another
  std::optional<double> from, to;    ///< part of the sweep [of its parameter]; the whole if not given
  std::string regime;                ///< share, count, change (before it), jump, decreasing (of the first sweep)
  std::string regime_after;          ///< change: the regime after it
  std::string leads_to;              ///< change: the regime that follows before `regime` returns, if given
  std::vector<std::string> regimes;  ///< sequence
  std::optional<Which> which;        ///< change: of several, along the rising parameter; the first if not given
  std::vector<double> within;        ///< change: least and greatest value
  std::optional<double> at_least, at_most;
  std::string quantity;                      ///< of claim_quantities, or a column of stages [claims/judging.hpp]
  std::optional<Statistic> statistic;        ///< value: the largest if not given
  std::vector<double> peak_locations;        ///< peaks
  std::optional<double> location_tolerance;  ///< peaks: relative distance from a place
  std::optional<double> prominence;          ///< peaks: in parts of the largest value
  std::optional<double> correlation;         ///< agreement: of the two ranges
  std::vector<double> data_at, data;         ///< curve: values of the parameter, and published values of the quantity
  std::optional<double> tolerance;           ///< curve: in parts of the largest published value
  std::optional<studies::Direction> direction;  ///< curve: of the sweep; the one of the verdicts if not given
  std::string stage;                            ///< frequencies: of ClaimsOptions::stages
  std::string mode_type;                        ///< frequencies: of mode_types; empty: all modes
  std::vector<double> frequencies_Hz;           ///< frequencies: all different ones of that type
  std::vector<double> tolerance_Hz;             ///< frequencies: one for all of them, or one each
  std::optional<int> multiplicity;              ///< frequencies: of each of them
};

/// Quantities of a point for conditions; those of a mesh are of planet 1. [b_c], exponent per tau.
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
  std::vector<Condition> as_printed = {};  ///< what a reader of the diagram accepts instead
};

/// Where the regimes of points come from.
enum class Reading {
  evidence,  ///< recurrence, orbits and exponents
  printed,   ///< the dots of a printed diagram [printed_diagram.hpp]
};

enum class MeshSide { sun_planet, ring_planet };

/// A bifurcation diagram of the deflection of planet 1's mesh. Or a quantity along a sweep in all its directions, or
/// the natural frequencies of a stage, each with the published numbers of the claims.
struct ClaimPanel {
  std::string sweep;
  MeshSide mesh = MeshSide::sun_planet;
  std::string quantity;  ///< instead of the diagram, along the sweep
  std::string stage;     ///< instead of a sweep: the natural frequencies of one of ClaimsOptions::stages
  std::string title;
};

/// A figure of panels below each other with one parameter, as the publication has them.
struct ClaimFigure {
  std::string name;  ///< of its file
  std::string title;
  std::vector<ClaimPanel> panels;
  std::string data = "published";  ///< word of the legend for what is compared with
};

/// How candidates and draws are evaluated: cold starts, short records, coarse grids of the sweeps.
struct Screening {
  int transient_periods = 160;
  int recorded_periods = 32;
  int classification_periods = 0;  ///< 0: regimes by recurrence and growth alone
  int growth_periods = 64;         ///< of the screening; 0: a record that does not recur counts as chaotic
  double relative_tolerance = 1e-5;
};

/// Draws from the ranges: do the claims depend on the unstated parameters?
struct SurveyOptions {
  int draws = 1000;
  int seed = 1;
  int confirmed = 0;                    ///< of the draws: also compared with whole sweeps, as a check of the screening
  Reading reading = Reading::evidence;  ///< of the claims
  Screening recording;
};

enum class SearchMethod {
  differential_evolution,  ///< global search
  covariance_adaptation,   ///< local search, from the given stage
};

/// What determines the cost of conditions on regimes that fail.
enum class SearchLead {
  regimes,      ///< number and location of the points with the claimed regimes
  multipliers,  ///< those of the orbit of period 1 along the sweeps [claims/period_one.hpp]
  dots,         ///< heights and gaps of the dots of the sweeps' diagrams [claims/printed_diagram.hpp]
};

struct SearchOptions {
  SearchMethod method = SearchMethod::differential_evolution;
  SearchLead regime_cost = SearchLead::regimes;
  Reading reading = Reading::evidence;  ///< of the claims
  double spread = 0.15;                 ///< covariance adaptation: of its first candidates, in parts of the ranges
  int seed = 1;
  int islands = 4;
  int population = 24;          ///< candidates on an island, at least 7
  int candidates = 10000;       ///< evaluated in all, by the islands
  int migration_interval = 10;  ///< generations between exchanges of the best candidates
  int refinement = 400;         ///< candidates of the local refinement of the best
  int confirmed = 0;  ///< of the best: compared with whole sweeps; the one that meets most claims is the result
  int profile = 9;    ///< values of each parameter in the profile of the score
};

struct ClaimsOptions {
  studies::RecordingOptions recording;
  std::vector<studies::Start> starts = {studies::Start::continued,
                                        studies::Start::cold};  ///< the first is the verdict, others stand beside it
  std::vector<Reading> readings = {Reading::evidence};          ///< the first is the verdict, others stand beside it
  PrintedDots printed;
  std::vector<ClaimSweep> sweeps;
  std::vector<ClaimStage> stages;
  std::vector<Claim> claims;
  std::vector<ClaimFigure> figures;
  Screening screening;
  ParameterSpace space;
  SearchOptions search;
  SurveyOptions survey;

  /// A sweep of the claims in full, from one kind of start.
  [[nodiscard]] studies::SweepOptions whole_sweep(const ClaimSweep& sweep, studies::Start start) const;

  /// Are claims read so by `reproduce`?
  [[nodiscard]] bool is_scored(Reading reading) const;

  /// Are claims read so, by `reproduce`, a search or a survey?
  [[nodiscard]] bool has_reading(Reading reading) const;

  /// Errors, each at its place below the study: ("/claims/3/conditions/0/regime", "is ..., must be ...").
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> problems() const;
};

/// Is it a word for a regime that conditions accept: "period 3", "periodic", "multi-period" (periodic, of 2 or more
/// mesh periods), "quasiperiodic", "chaotic", "aperiodic" (quasiperiodic or chaotic), or "not " and one of these?
[[nodiscard]] bool is_regime_word(std::string_view word);

/// N of "period N", also behind "not "; 0 of other words.
[[nodiscard]] int period_of_word(std::string_view word);

/// Does the word, without "not ", name a regime that recurrence alone does not determine: quasiperiodic, chaotic?
[[nodiscard]] bool needs_evidence(std::string_view word);

}  // namespace epicyclic::claims
