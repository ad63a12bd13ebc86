// Checks whether conditions could hold, and could fail: a condition that decides nothing is refused.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>
#include <vector>

#include "claims/judging.hpp"
#include "claims/option_checks.hpp"
#include "core/text.hpp"

namespace epicyclic::claims {

using namespace studies;

namespace {

std::string kind_name(ConditionKind kind) {
  for (const auto& [name, one] : condition_kinds)
    if (one == kind) return std::string(name);
  return {};
}

bool is_never_negative(const std::string& quantity) {
  return quantity.ends_with("_range") || quantity.ends_with("_rms") || quantity == "planet_spread" ||
         quantity.starts_with("dynamic_factor") || quantity == "load_sharing_max";
}

/// The words for regimes that a condition has, each with its key.
std::vector<std::pair<std::string, std::string>> regime_words(const Condition& c) {
  std::vector<std::pair<std::string, std::string>> words = {
      {"regime", c.regime}, {"regime_after", c.regime_after}, {"leads_to", c.leads_to}};
  std::erase_if(words, [](const auto& word) { return word.second.empty(); });
  for (std::size_t k = 0; k < c.regimes.size(); ++k) words.emplace_back("regimes/" + std::to_string(k), c.regimes[k]);
  return words;
}

/// All regimes that a full classification distinguishes.
std::vector<ClaimRegime> all_regimes(int period_max) {
  std::vector<ClaimRegime> all;
  for (int period = 1; period <= period_max; ++period) all.push_back({analysis::Regime::periodic, period, true});
  for (const auto regime : {analysis::Regime::quasiperiodic, analysis::Regime::chaotic, analysis::Regime::undecided})
    all.push_back({regime, 0, true});
  return all;
}

/// Is there a regime that both words describe?
bool can_be_both(const std::string& a, const std::string& b, int period_max) {
  return std::ranges::any_of(all_regimes(period_max), [&](const ClaimRegime& m) { return m.is(a) && m.is(b); });
}

/// Does the other word describe each regime of the one word, too?
bool is_always(const std::string& a, const std::string& b, int period_max) {
  return std::ranges::all_of(all_regimes(period_max), [&](const ClaimRegime& m) { return !m.is(a) || m.is(b); });
}

}  // namespace

void check_sweep_name(ProblemList& problems, const std::string& place, const std::string& name, const Names& sweeps) {
  if (!sweeps.contains(name)) problems.refuse(place, "is \"" + name + "\", which is no sweep of the study");
}

void check_stage_name(ProblemList& problems, const std::string& place, const std::string& name, const Names& stages) {
  if (!stages.contains(name)) problems.refuse(place, "is \"" + name + "\", which is no stage of the study");
}

namespace {

/// Published numbers: values and their places, or frequencies and their tolerances.
void check_data(ProblemList& problems, const std::string& place, const Condition& c) {
  if (c.kind == ConditionKind::curve) {
    if (c.data.size() != c.data_at.size())
      problems.refuse(place + "/data", "has " + std::to_string(c.data.size()) + " numbers, and data_at has " +
                                           std::to_string(c.data_at.size()) + ": there must be one for each");
    if (!c.data.empty() && std::ranges::all_of(c.data, [](double x) { return x == 0.0; }))
      problems.refuse(place + "/data",
                      "is 0 everywhere: the tolerance is a part of the largest value; bound the quantity "
                      "by a condition of kind \"value\"");
  }
  if (c.tolerance_Hz.size() > 1 && c.tolerance_Hz.size() != c.frequencies_Hz.size())
    problems.refuse(place + "/tolerance_Hz", "has " + std::to_string(c.tolerance_Hz.size()) +
                                                 " numbers, must be one, or one for each of the " +
                                                 std::to_string(c.frequencies_Hz.size()) + " frequencies_Hz");
}

}  // namespace

void check_condition(ProblemList& problems, const std::string& place, const Condition& c, const Names& sweeps,
                     const Names& stages) {
  using enum ConditionKind;
  const std::string kind = kind_name(c.kind);
  const auto of = [&](std::initializer_list<ConditionKind> kinds) {
    return std::ranges::find(kinds, c.kind) != kinds.end();
  };
  // A key that the kind does not read would be a condition that its writer believes in and nobody judges.
  const auto wants = [&](bool given, bool needed, bool allowed, const char* key) {
    if (needed && !given)
      problems.refuse(place + "/" + key, "is missing; a condition of kind \"" + kind + "\" needs it");
    if (given && !allowed) problems.refuse(place + "/" + key, "is not read by a condition of kind \"" + kind + "\"");
  };
  if (c.kind == decreasing) {
    wants(!c.sweep.empty(), false, false, "sweep");
    if (c.sweeps.size() < 2) problems.refuse(place + "/sweeps", "must name two sweeps at least");
    for (std::size_t k = 0; k < c.sweeps.size(); ++k)
      check_sweep_name(problems, place + "/sweeps/" + std::to_string(k), c.sweeps[k], sweeps);
  } else if (c.kind == frequencies) {
    wants(!c.sweep.empty(), false, false, "sweep");
    wants(!c.sweeps.empty(), false, false, "sweeps");
    check_stage_name(problems, place + "/stage", c.stage, stages);
  } else {
    wants(!c.sweeps.empty(), false, false, "sweeps");
    check_sweep_name(problems, place + "/sweep", c.sweep, sweeps);
  }
  wants(c.from.has_value(), false, !of({curve, frequencies}), "from");
  wants(c.to.has_value(), false, !of({curve, frequencies}), "to");
  wants(!c.data_at.empty(), c.kind == curve, c.kind == curve, "data_at");
  wants(!c.data.empty(), c.kind == curve, c.kind == curve, "data");
  wants(c.tolerance.has_value(), c.kind == curve, c.kind == curve, "tolerance");
  wants(c.direction.has_value(), false, c.kind == curve, "direction");
  if (c.kind != frequencies) wants(!c.stage.empty(), false, false, "stage");
  wants(!c.mode_type.empty(), false, c.kind == frequencies, "mode_type");
  wants(!c.frequencies_Hz.empty(), c.kind == frequencies, c.kind == frequencies, "frequencies_Hz");
  wants(!c.tolerance_Hz.empty(), c.kind == frequencies, c.kind == frequencies, "tolerance_Hz");
  wants(c.multiplicity.has_value(), false, c.kind == frequencies, "multiplicity");
  check_data(problems, place, c);
  wants(!c.regime.empty(), of({share, count, change}), of({share, count, change, value, jump, decreasing}), "regime");
  wants(!c.regime_after.empty(), c.kind == change, c.kind == change, "regime_after");
  wants(!c.leads_to.empty(), false, c.kind == change, "leads_to");
  wants(!c.regimes.empty(), c.kind == sequence, c.kind == sequence, "regimes");
  wants(!c.within.empty(), c.kind == change, c.kind == change, "within");
  const bool has_quantity = of({value, reduction, peaks, jump, decreasing, curve});
  wants(!c.quantity.empty(), has_quantity, has_quantity, "quantity");
  wants(!c.peak_locations.empty(), c.kind == peaks, c.kind == peaks, "peak_locations");
  wants(c.correlation.has_value(), false, c.kind == agreement, "correlation");
  wants(c.which.has_value(), false, c.kind == change, "which");
  wants(c.statistic.has_value(), false, c.kind == value, "statistic");
  wants(c.location_tolerance.has_value(), false, c.kind == peaks, "location_tolerance");
  wants(c.prominence.has_value(), false, c.kind == peaks, "prominence");
  const bool bounded = of({share, count, value, variation});
  wants(c.at_least.has_value(), of({reduction, jump, agreement}), bounded || of({reduction, jump, agreement, curve}),
        "at_least");
  wants(c.at_most.has_value(), false, bounded, "at_most");
  if (bounded && !c.at_least && !c.at_most)
    problems.refuse(place, "needs \"at_least\" or \"at_most\": it bounds nothing");
  if (c.at_least && c.at_most && !(*c.at_least <= *c.at_most))
    problems.refuse(place + "/at_least", "is " + short_text(*c.at_least, 17) + ", must be <= at_most");
  // Parts of 1; beyond them a condition would never hold, or always.
  if (of({share, agreement, variation, jump, curve})) {
    if (c.at_least && !(*c.at_least > 0.0 && *c.at_least <= 1.0))
      problems.refuse(place + "/at_least", "is " + short_text(*c.at_least, 17) + ", must be > 0 and <= 1: a part of 1");
    if (c.at_most && !(*c.at_most >= 0.0 && *c.at_most < 1.0))
      problems.refuse(place + "/at_most", "is " + short_text(*c.at_most, 17) + ", must be >= 0 and < 1: a part of 1");
  }
  if (c.kind == count) {
    if (c.at_least && !(*c.at_least > 0.0))
      problems.refuse(place + "/at_least", "is " + short_text(*c.at_least, 17) + ", must be > 0");
    if (c.at_most && !(*c.at_most >= 0.0))
      problems.refuse(place + "/at_most", "is " + short_text(*c.at_most, 17) + ", must be >= 0");
  }
  if (c.prominence && !(*c.prominence > 0.0))
    problems.refuse(place + "/prominence", "is 0, must be > 0: any point has it");
  if (c.correlation && !(*c.correlation > 0.0))
    problems.refuse(place + "/correlation", "is " + short_text(*c.correlation, 17) + ", must be > 0");
  if (c.kind == count && c.at_least && c.at_most && std::ceil(*c.at_least) > std::floor(*c.at_most))
    problems.refuse(place + "/at_most", "is " + short_text(*c.at_most, 17) + ": no number of points is from " +
                                            short_text(*c.at_least, 17) + " to that");
  if (c.kind == reduction && c.at_least && !(*c.at_least > 1.0)) problems.refuse(place + "/at_least", "must be > 1");
  if (c.kind == value && is_never_negative(c.quantity)) {
    if (c.at_least && !c.at_most && !(*c.at_least > 0.0))
      problems.refuse(place + "/at_least",
                      "is " + short_text(*c.at_least, 17) + ", must be > 0: " + c.quantity + " is never below 0");
    if (c.at_most && *c.at_most < 0.0)
      problems.refuse(place + "/at_most",
                      "is " + short_text(*c.at_most, 17) + ", must be >= 0: " + c.quantity + " is never below 0");
  }
  if (c.from && c.to && !(*c.from <= *c.to))
    problems.refuse(place + "/from", "is " + short_text(*c.from, 17) + ", must be <= to = " + short_text(*c.to, 17));
  if (!c.within.empty() && (c.within.size() != 2 || !(c.within[0] < c.within[1])))
    problems.refuse(place + "/within", "must be two values, the first below the second");
  for (const auto& [key, word] : regime_words(c))
    if (!is_regime_word(word))
      problems.refuse(place + "/" + key,
                      "is \"" + word +
                          "\", must be \"period N\", periodic, multi-period, quasiperiodic, chaotic, "
                          "aperiodic, or \"not \" and one of these");
  for (std::size_t k = 0; k + 1 < c.peak_locations.size(); ++k) {
    const double tolerance = c.location_tolerance.value_or(default_location_tolerance);
    if (!(c.peak_locations[k] * (1.0 + tolerance) < c.peak_locations[k + 1] * (1.0 - tolerance)))
      problems.refuse(place + "/peak_locations/" + std::to_string(k + 1),
                      "is " + short_text(c.peak_locations[k + 1], 17) +
                          ", must lie above the one before it by more than location_tolerance = " +
                          short_text(tolerance, 17) + " of both: one maximum would be counted twice");
  }
}

namespace {

/// A sweep's grid as one of the evaluations uses it.
struct Grid {
  const char* points_key;
  int points;
  std::vector<double> values;  ///< within the part of the condition
};

/// Is a parameter searched or drawn, so that screenings judge claims, too?
bool has_screening(const ClaimsOptions& options) { return options.space.dimension() > 0; }

/// The part of a sweep that a condition refers to, in each evaluation.
struct PartOfSweep {
  double from, to;
  std::vector<Grid> grids;

  PartOfSweep(const Condition& c, const ClaimSweep& sweep, const ClaimsOptions& options)
      : from(std::max(sweep.axis.from, c.from.value_or(sweep.axis.from))),
        to(std::min(sweep.axis.to, c.to.value_or(sweep.axis.to))) {
    for (const auto& [points, key] :
         {std::pair(sweep.axis.points, "points"), std::pair(sweep.screening_points, "screening_points"),
          std::pair(sweep.survey_points, "survey_points")}) {
      if (!grids.empty() && !has_screening(options)) break;
      Axis axis = sweep.axis;
      axis.points = std::min(points, axis.points);
      Grid grid{key, axis.points, axis_values(axis)};
      std::erase_if(grid.values, [&](double v) { return !is_at_least(v, from) || !is_at_most(v, to); });
      grids.push_back(std::move(grid));
    }
  }

  [[nodiscard]] std::string text() const { return short_text(from, 6) + " to " + short_text(to, 6); }
};

/// Points that a condition has to find in its part, so that it can hold.
std::size_t points_needed(const Condition& c) {
  using enum ConditionKind;
  switch (c.kind) {
    case change:
    case variation:
    case reduction:
      return 2;
    case agreement:
      return c.correlation ? 3 : 1;  // two ranges always correlate by 1 or -1
    case peaks:
    case jump:
      return 3;
    case sequence:
      return c.regimes.size();
    case count:
      return static_cast<std::size_t>(std::max(1.0, std::ceil(c.at_least.value_or(1.0))));
    default:
      return 1;
  }
}

/// Requirements of a condition on one grid: points in its part, and places and bounds among them.
void check_grid(ProblemList& problems, const std::string& place, const Condition& c, const std::string& sweep,
                const std::string& range, const Grid& grid) {
  const std::string words =
      "\"" + sweep + "\" with its grid of " + std::to_string(grid.points) + " (" + grid.points_key + ")";
  const std::size_t there = grid.values.size();
  if (there < points_needed(c)) {
    problems.refuse(place, "needs " + std::to_string(points_needed(c)) + " points within " + range + "; " + words +
                               " has " + std::to_string(there));
    return;
  }
  if (c.kind == ConditionKind::count && c.at_most && *c.at_most >= static_cast<double>(there))
    problems.refuse(place + "/at_most", "is " + short_text(*c.at_most, 17) + "; " + words + " has " +
                                            std::to_string(there) + " points there: it would always hold");
  if (c.within.size() == 2) {
    bool any = false;
    for (std::size_t k = 0; k + 1 < there; ++k) {
      const double middle = 0.5 * (grid.values[k] + grid.values[k + 1]);
      any = any || (is_at_least(middle, c.within[0]) && is_at_most(middle, c.within[1]));
    }
    if (!any) problems.refuse(place + "/within", "has no middle of two points; " + words + ": it would never hold");
  }
  const double tolerance = c.location_tolerance.value_or(default_location_tolerance);
  for (std::size_t k = 0; k < c.peak_locations.size(); ++k) {
    const auto near = [&](double v) { return std::abs(v - c.peak_locations[k]) <= tolerance * c.peak_locations[k]; };
    if (there < 3 || std::none_of(grid.values.begin() + 1, grid.values.end() - 1, near))
      problems.refuse(place + "/peak_locations/" + std::to_string(k), "is " + short_text(c.peak_locations[k], 17) +
                                                                          ", near which " + words +
                                                                          " has no point that could be a maximum");
  }
}

/// A number of points is a bound on one grid: of another one it would be another claim.
void check_counted(ProblemList& problems, const std::string& place, const Condition& c, const std::string& sweep,
                   const std::vector<Grid>& grids) {
  if (c.kind != ConditionKind::count) return;
  for (const Grid& grid : grids) {
    if (grid.values.size() == grids.front().values.size()) continue;
    for (const auto& [key, bound, harmless] :
         {std::tuple("at_least", c.at_least, 1.0), std::tuple("at_most", c.at_most, 0.0)})
      if (bound && *bound > harmless)
        problems.refuse(place + "/" + key, "is " + short_text(*bound, 17) + " of the " +
                                               std::to_string(grids.front().values.size()) + " points that \"" + sweep +
                                               "\" has there; by " + grid.points_key + " it has " +
                                               std::to_string(grid.values.size()) +
                                               ", of which the bound would be another one: a \"share\" is the same of "
                                               "both");
    return;
  }
}

/// Requirements of a condition on one of its sweeps.
void check_part(ProblemList& problems, const std::string& place, const Condition& c, const ClaimSweep& sweep,
                const ClaimsOptions& options) {
  const Axis& axis = sweep.axis;
  if (!(axis.from < axis.to)) return;
  const PartOfSweep part(c, sweep, options);
  if (part.from > part.to) {
    problems.refuse(place, "selects values at which \"" + sweep.name + "\" has no point: it goes from " +
                               short_text(axis.from, 6) + " to " + short_text(axis.to, 6));
    return;
  }
  if (c.within.size() == 2 && (c.within[1] < part.from || c.within[0] > part.to)) {
    problems.refuse(place + "/within", "lies outside the part that is evaluated, " + part.text());
    return;
  }
  const std::size_t before = problems.count();
  for (std::size_t k = 0; k < c.peak_locations.size(); ++k)
    if (!(c.peak_locations[k] >= part.from && c.peak_locations[k] <= part.to && c.peak_locations[k] > 0.0))
      problems.refuse(place + "/peak_locations/" + std::to_string(k),
                      "is " + short_text(c.peak_locations[k], 17) + ", must be > 0 and within " + part.text());
  for (std::size_t k = 0; k < c.data_at.size(); ++k)
    if (!is_at_least(c.data_at[k], part.from) || !is_at_most(c.data_at[k], part.to))
      problems.refuse(place + "/data_at/" + std::to_string(k),
                      "is " + short_text(c.data_at[k], 17) + ", must be within " + part.text());
  if (c.direction && std::ranges::find(sweep.directions, *c.direction) == sweep.directions.end())
    problems.refuse(place + "/direction", "is no direction of the sweep \"" + sweep.name + "\"");
  if (c.direction && std::ranges::find(options.starts, Start::cold) != options.starts.end())
    problems.refuse(place + "/direction", "needs \"starts\": [\"continued\"]: cold starts have no direction");
  check_counted(problems, place, c, sweep.name, part.grids);
  for (const Grid& grid : part.grids)
    if (problems.count() == before) check_grid(problems, place, c, sweep.name, part.text(), grid);
  if (options.recording.classification_periods == 0) {
    const int recorded = sweep.recorded_periods.value_or(options.recording.recorded_periods);
    for (const auto& [key, word] : regime_words(c))
      if (2 * period_of_word(word) > recorded)
        problems.refuse(place + "/" + key,
                        "is \"" + word + "\", which takes twice as many recorded_periods to be seen; the sweep \"" +
                            sweep.name + "\" has " + std::to_string(recorded) + ", and classification_periods = 0");
  }
}

/// Requirements of a condition on the records of each evaluation, for any sweep.
void check_screening(ProblemList& problems, const std::string& place, const Condition& c,
                     const ClaimsOptions& options) {
  const bool is_printed = options.has_reading(Reading::printed);
  for (const auto& [key, word] : regime_words(c)) {
    if (is_printed && period_of_word(word) > options.printed.period_max)
      problems.refuse(place + "/" + key, "is \"" + word + "\", more than the printed/period_max = " +
                                             std::to_string(options.printed.period_max) +
                                             " clusters that a reader of a diagram counts");
    const int period = period_of_word(word);
    if (period > options.recording.period_max)
      problems.refuse(place + "/" + key, "is \"" + word + "\", longer than period_max = " +
                                             std::to_string(options.recording.period_max) + ": it is not sought");
    else if (has_screening(options) &&
             2 * period > std::min(options.screening.recorded_periods, options.survey.recording.recorded_periods))
      problems.refuse(place + "/" + key, "is \"" + word +
                                             "\", which takes twice as many recorded_periods to be seen; " +
                                             "`screening` or `survey` record fewer");
  }
  if (options.recording.classification_periods == 0 && options.is_scored(Reading::evidence))
    for (const auto& [key, word] : regime_words(c))
      if (needs_evidence(word))
        problems.refuse(
            place + "/" + key,
            "is \"" + word +
                "\", which needs classification_periods > 0: without them, what does not recur is undecided");
  if (c.kind == ConditionKind::change && is_regime_word(c.regime) && is_regime_word(c.regime_after) &&
      can_be_both(c.regime, c.regime_after, options.recording.period_max))
    problems.refuse(place + "/regime_after", "is \"" + c.regime_after + "\", which an attractor that is \"" + c.regime +
                                                 "\" can be, too: nothing would have to change");
  if (c.kind == ConditionKind::change && is_regime_word(c.regime) && is_regime_word(c.leads_to) &&
      is_always(c.leads_to, c.regime, options.recording.period_max))
    problems.refuse(place + "/leads_to", "is \"" + c.leads_to + "\", which every attractor is that is \"" + c.regime +
                                             "\", too: it is not met before that comes back");
  if (c.quantity != "lyapunov_max") return;
  const std::string nobody = "is \"lyapunov_max\", which is not computed with ";
  if (options.recording.classification_periods == 0)
    problems.refuse(place + "/quantity", nobody + "classification_periods = 0");
  else if (!has_screening(options))
    return;
  else if (options.screening.classification_periods == 0)
    problems.refuse(place + "/quantity", nobody + "`screening/classification_periods` = 0, its default");
  else if (options.survey.recording.classification_periods == 0)
    problems.refuse(place + "/quantity", nobody + "`survey/screening/classification_periods` = 0, its default");
}

/// Sweeps are compared at their common values: in each evaluation at least half of those of the coarsest sweep.
void check_common_values(ProblemList& problems, const std::string& place, const Condition& c,
                         const std::vector<const ClaimSweep*>& sweeps, const ClaimsOptions& options) {
  std::vector<PartOfSweep> parts;
  for (const ClaimSweep* sweep : sweeps) parts.emplace_back(c, *sweep, options);
  for (std::size_t g = 0; g < parts.front().grids.size(); ++g) {
    std::size_t fewest = parts.front().grids[g].values.size();
    for (const PartOfSweep& part : parts) fewest = std::min(fewest, part.grids[g].values.size());
    const auto is_common = [&](double v) {
      return std::ranges::all_of(parts, [&](const PartOfSweep& part) {
        const std::vector<double>& values = part.grids[g].values;  // rise
        const auto above = std::ranges::lower_bound(values, v);
        return (above != values.end() && is_same_value(v, *above)) ||
               (above != values.begin() && is_same_value(v, *std::prev(above)));
      });
    };
    const auto common = static_cast<std::size_t>(std::ranges::count_if(parts.front().grids[g].values, is_common));
    if (common == 0 || 2 * common < fewest)
      problems.refuse(place + "/sweeps", "are compared at the values that all of them have; by " +
                                             std::string(parts.front().grids[g].points_key) + " that is " +
                                             std::to_string(common) + " of " + std::to_string(fewest) +
                                             " that the coarsest has there");
  }
}

}  // namespace

void check_grids(ProblemList& problems, const std::string& place, const Condition& c, const ClaimsOptions& options) {
  std::vector<const ClaimSweep*> sweeps;
  if (c.kind == ConditionKind::frequencies) {
    if (has_screening(options))
      problems.refuse(place + "/kind",
                      "is \"frequencies\", which is judged for the stage as it is given; a study with "
                      "parameters or choices judges other stages");
    return;
  }
  const std::vector<std::string> names = c.kind == ConditionKind::decreasing ? c.sweeps : std::vector{c.sweep};
  for (const std::string& name : names) {
    const auto sweep = std::ranges::find(options.sweeps, name, &ClaimSweep::name);
    if (sweep == options.sweeps.end()) return;
    sweeps.push_back(&*sweep);
  }
  check_screening(problems, place, c, options);
  for (const ClaimSweep* sweep : sweeps) {
    const std::size_t before = problems.count();
    check_part(problems, place, c, *sweep, options);
    if (problems.count() > before) return;
  }
  if (sweeps.size() > 1) check_common_values(problems, place, c, sweeps, options);
}

}  // namespace epicyclic::claims
