#include "claims/judging.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>

#include "core/text.hpp"
#include "store/stage_columns.hpp"

namespace epicyclic::claims {

using namespace studies;

namespace {

using analysis::Regime;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
/// Bound of ranges that integration errors and incomplete convergence leave [b_c]; of a quantity, the relative bound.
constexpr double noise = 1e-6;
constexpr double step_of_failure = 0.1;  ///< a condition that just fails costs so much [C-cost]

std::string number(double x) { return short_text(x, 5); }

/// "period 12" -> 12; 0 for other words.
int period_in(std::string_view word) {
  constexpr std::string_view start = "period ";
  constexpr std::size_t most_digits = 4;
  if (!word.starts_with(start)) return 0;
  word.remove_prefix(start.size());
  if (word.empty() || word.size() > most_digits || word.front() == '0') return 0;
  int period = 0;
  for (const char c : word) {
    if (c < '0' || c > '9') return 0;
    period = 10 * period + (c - '0');
  }
  return period;
}

constexpr std::string_view negation = "not ";

std::string_view without_negation(std::string_view word) {
  if (word.starts_with(negation)) word.remove_prefix(negation.size());
  return word;
}

bool is_aperiodic_word(std::string_view word) {
  return word == "quasiperiodic" || word == "chaotic" || word == "aperiodic";
}

}  // namespace

int period_of_word(std::string_view word) { return period_in(without_negation(word)); }

bool needs_evidence(std::string_view word) { return is_aperiodic_word(without_negation(word)); }

bool is_regime_word(std::string_view word) {
  word = without_negation(word);
  return word == "periodic" || word == "multi-period" || is_aperiodic_word(word) || period_in(word) > 0;
}

bool ClaimRegime::is(std::string_view word) const {
  if (word.starts_with(negation)) return !is(word.substr(negation.size()));
  const bool periodic = regime == Regime::periodic;
  if (word == "periodic") return periodic;
  if (word == "multi-period") return periodic && period >= 2;
  if (word == "quasiperiodic") return regime == Regime::quasiperiodic || (drawn && regime == Regime::chaotic);
  if (word == "chaotic") return regime == Regime::chaotic || (regime == Regime::undecided && !classified);
  if (word == "aperiodic")
    return regime == Regime::chaotic || regime == Regime::quasiperiodic || (!periodic && !classified);
  return periodic && period == period_in(word);
}

std::string ClaimRegime::text() const {
  return regime == Regime::periodic ? "period " + std::to_string(period) : to_string(regime);
}

namespace {

/// Columns of numbers that are no claim_quantities.
const std::vector<store::StageColumn>& number_columns() {
  static const std::vector<store::StageColumn> columns = [] {
    std::vector<store::StageColumn> all;
    for (auto& list : {store::contact_columns(), store::stage_columns()})
      for (const store::StageColumn& column : list)
        if (std::holds_alternative<store::StageColumn::Getter<double>>(column.value) &&
            std::ranges::find(claim_quantities, std::string_view(column.name)) == claim_quantities.end())
          all.push_back(column);
    return all;
  }();
  return columns;
}

}  // namespace

const std::vector<std::string>& column_quantities() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const store::StageColumn& column : number_columns()) all.push_back(column.name);
    return all;
  }();
  return names;
}

double ClaimPoint::quantity(std::string_view name) const {
  const auto* const found = std::ranges::find(claim_quantities, name);
  if (found != claim_quantities.end()) return quantities[static_cast<std::size_t>(found - claim_quantities.begin())];
  const auto column = std::ranges::find(column_quantities(), name);
  return columns.at(static_cast<std::size_t>(column - column_quantities().begin()));
}

double& ClaimPoint::quantity_of(std::string_view name) {
  const auto* const found = std::ranges::find(claim_quantities, name);
  return quantities.at(static_cast<std::size_t>(found - claim_quantities.begin()));
}

std::optional<double> ClaimPoint::lacks(std::string_view word) const {
  if (period_one) return period_one->lacks(word);
  return dots ? dots->lacks(word) : std::nullopt;
}

namespace {

/// Does a short record that recurs nowhere converge to a periodic orbit? Next to a bifurcation the convergence takes
/// very long. A screening then takes the regime of the orbit that the record approaches. A chaotic record does not
/// return to within a small part of its extent over its whole length.
bool converges(const PointResult& result, const RecordingOptions& recording) {
  constexpr double small_part = 0.1;
  if (result.classified || result.regime == Regime::periodic || result.regime == Regime::chaotic) return false;
  if (result.recurrence.best_period < 1) return false;  // of a record too short to come back at all
  if (analysis::still_converging(result.recurrence, recording.recurrence_tolerance)) return true;
  const std::size_t dimension = result.poincare_columns - 2 * result.meshes.sun_planet.size();
  return result.recurrence.late_error <= small_part * analysis::extent(section_of(result, dimension));
}

}  // namespace

ClaimPoint claim_point(const PointResult& result, const RecordingOptions& recording, Depth depth) {
  const bool classified = depth == Depth::in_full || result.classified;
  ClaimPoint point;
  point.value = result.point.value;
  point.reached = result.outcome == integrate::Outcome::reached;
  if (!point.reached) return point;
  point.response = {result.regime, result.period, classified};
  if (!classified && converges(result, recording))
    point.response = {Regime::periodic, result.recurrence.best_period, false};
  point.converged = point.response.regime != Regime::periodic || result.recurrence.period > 0;
  const std::size_t planets = result.meshes.sun_planet.size();
  const std::size_t columns = result.poincare_columns;
  const auto column = [&](std::size_t of) {
    analysis::PoincareSection section{1, {}};
    for (std::size_t row = 0; row < result.poincare_rows(); ++row)
      section.states.push_back(result.poincare[row * columns + of]);
    return section;
  };
  const auto alone = [&](const analysis::PoincareSection& section) {
    const analysis::Recurrence r = analysis::recurrence(section, recording.period_max, recording.recurrence_tolerance);
    if (r.period > 0) return ClaimRegime{Regime::periodic, r.period, classified};
    if (analysis::still_converging(r, recording.recurrence_tolerance))
      return ClaimRegime{Regime::periodic, r.best_period, classified};
    // The record converges to an orbit, and the mesh has the period of that orbit.
    if (result.regime == Regime::periodic) return ClaimRegime{Regime::periodic, result.period, classified};
    return ClaimRegime{result.regime, 0, classified};
  };
  const analysis::PoincareSection sun = column(columns - 2 * planets);
  const analysis::PoincareSection ring = column(columns - planets);
  // Of period 1 the section is one point; its width is a remainder of the transient.
  const bool is_point = point.response.regime == Regime::periodic && point.response.period == 1;
  point.by_sun_mesh = alone(sun);
  point.by_ring_mesh = alone(ring);
  const MeshRecord& sp = result.meshes.sun_planet.front();
  const MeshRecord& rp = result.meshes.ring_planet.front();
  point.quantities = {sp.delta.range(),
                      rp.delta.range(),
                      sp.delta.largest,
                      rp.delta.largest,
                      is_point ? 0.0 : analysis::extent(sun),
                      is_point ? 0.0 : analysis::extent(ring),
                      result.meshes.planet_spread,
                      result.lyapunov_max().value,
                      sp.delta.rms,
                      rp.delta.rms,
                      result.meshes.transmission_error.rms,
                      result.meshes.transmission_error.range(),
                      sp.force.largest,
                      rp.force.largest,
                      result.meshes.dynamic_factor(result.meshes.sun_planet),
                      result.meshes.dynamic_factor(result.meshes.ring_planet),
                      result.meshes.largest_share()};
  for (const store::StageColumn& number_column : number_columns())
    point.columns.push_back(std::get<store::StageColumn::Getter<double>>(number_column.value)(result.meshes));
  const auto sorted = [](const analysis::PoincareSection& section) {
    std::vector<double> points = section.states;
    std::ranges::sort(points);
    return points;
  };
  point.sun_section = sorted(sun);
  point.ring_section = sorted(ring);
  return point;
}

Direction judged_direction(const PointSource& points) {
  for (std::size_t k = 0; k < points.count; ++k)
    if (points.read_summary(k).point.direction == Direction::up) return Direction::up;
  return Direction::down;
}

ClaimSeries claim_series(const PointSource& points, const RecordingOptions& recording) {
  const Direction judged = judged_direction(points);
  ClaimSeries series;
  series.direction = judged;
  for (std::size_t k = 0; k < points.count; ++k) {
    const PointResult result = points.read(k);
    auto& list = result.point.direction == judged ? series.points : series.other;
    list.push_back(claim_point(result, recording, Depth::in_full));
  }
  std::ranges::sort(series.points, {}, &ClaimPoint::value);
  std::ranges::sort(series.other, {}, &ClaimPoint::value);
  return series;
}

namespace {

/// Of a diagram of one mesh.
double axis_of(const std::vector<ClaimPoint>& points, std::vector<double> ClaimPoint::*section,
               double recurrence_tolerance) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const ClaimPoint& p : points) {
    if (!p.reached) continue;
    low = std::min(low, (p.*section).front());
    high = std::max(high, (p.*section).back());
  }
  return axis_length(low, high, recurrence_tolerance);
}

ClaimRegime regime_of(const DotColumn& dots) {
  const int period = dots.period();
  return {period > 0 ? Regime::periodic : Regime::chaotic, period, true, true};
}

}  // namespace

void add_dots(ClaimSeries& series, const PrintedDots& ink, double recurrence_tolerance) {
  const double axis = axis_of(series.points, &ClaimPoint::sun_section, recurrence_tolerance);
  for (std::vector<ClaimPoint>* list : {&series.points, &series.other})
    for (ClaimPoint& p : *list)
      if (p.reached) p.dots.emplace(p.sun_section, axis, ink);
}

ClaimSeries as_printed(ClaimSeries series, const PrintedDots& ink, double recurrence_tolerance) {
  const double sun_axis = axis_of(series.points, &ClaimPoint::sun_section, recurrence_tolerance);
  const double ring_axis = axis_of(series.points, &ClaimPoint::ring_section, recurrence_tolerance);
  for (std::vector<ClaimPoint>* list : {&series.points, &series.other})
    for (ClaimPoint& p : *list) {
      if (!p.reached) continue;
      p.by_sun_mesh = p.response = regime_of(DotColumn(p.sun_section, sun_axis, ink));
      p.by_ring_mesh = regime_of(DotColumn(p.ring_section, ring_axis, ink));
      const auto drawn_range = [](const std::vector<double>& section, const ClaimRegime& regime) {
        return regime.is("period 1") ? 0.0 : section.back() - section.front();
      };
      p.quantity_of("poincare_sp_range") = drawn_range(p.sun_section, p.by_sun_mesh);
      p.quantity_of("poincare_rp_range") = drawn_range(p.ring_section, p.by_ring_mesh);
      p.drawn = {p.sun_section.front() / sun_axis, p.sun_section.back() / sun_axis};
    }
  return series;
}

ClaimSeries read_as(Reading reading, ClaimSeries series, const ClaimsOptions& options) {
  if (reading == Reading::evidence || series.points.empty()) return series;
  return as_printed(std::move(series), options.printed, options.recording.recurrence_tolerance);
}

namespace {

/// [C-cost]; 0 within.
double cost_within(double x, double least, double most, double scale) {
  const double d = std::max({0.0, least - x, x - most});
  if (std::isnan(x)) return 1.0;
  if (!(d > 0.0)) return 0.0;
  return step_of_failure + (1.0 - step_of_failure) * d / (d + scale);
}

/// @param percent  bounds are parts of 1, printed in percent like the measured values
std::string bound_text(const Condition& c, bool percent = false) {
  const auto printed = [&](double bound) { return percent ? number(100.0 * bound) + " %" : number(bound); };
  if (c.at_least && c.at_most) return "must be " + printed(*c.at_least) + " to " + printed(*c.at_most);
  if (c.at_least) return "must be at least " + printed(*c.at_least);
  return "must be at most " + printed(c.at_most.value_or(0.0));
}

/// Judges a number by at_least and at_most.
/// @param scale  a distance that counts as far
void judge_bounds(const Condition& c, ConditionOutcome& o, double scale) {
  const double least = c.at_least.value_or(-std::numeric_limits<double>::infinity());
  const double most = c.at_most.value_or(std::numeric_limits<double>::infinity());
  o.holds = o.measured >= least && o.measured <= most;
  o.cost = o.holds ? 0.0 : cost_within(o.measured, least, most, scale);
}

/// The part of the sweep to which a condition refers.
std::span<const ClaimPoint> part_of(const std::vector<ClaimPoint>& points, const Condition& c) {
  const auto first =
      std::ranges::find_if(points, [&](const ClaimPoint& p) { return !c.from || is_at_least(p.value, *c.from); });
  const auto last =
      std::find_if(first, points.end(), [&](const ClaimPoint& p) { return c.to && !is_at_most(p.value, *c.to); });
  return {first, last};
}

std::size_t number_of(std::span<const ClaimPoint> part, bool (*is)(const ClaimPoint&)) {
  return static_cast<std::size_t>(std::ranges::count_if(part, is));
}

/// Evaluated in full, and still undecided.
bool is_undecided(const ClaimPoint& p) {
  return p.reached && p.response.classified && p.response.regime == Regime::undecided;
}

std::size_t failed_in(std::span<const ClaimPoint> part) {
  return number_of(part, [](const ClaimPoint& p) { return !p.reached; });
}

bool moves(const ClaimPoint& p, std::string_view word) { return p.reached && p.response.is(word); }

std::string range_text(std::span<const ClaimPoint> part) {
  return " of " + number(part.front().value) + " to " + number(part.back().value);
}

/// Likeness of a point's regime to the requested one, as a slope for a search: 1 if they are the same.
double likeness(const ClaimPoint& p, std::string_view word) {
  constexpr double same_kind = 0.5;  // not periodic, as wanted, but another kind
  constexpr double near_kind = 0.3;  // of several mesh periods
  if (!p.reached) return 0.0;
  if (p.response.is(word)) return 1.0;
  if (is_aperiodic_word(word)) {
    if (p.response.regime != Regime::periodic) return same_kind;
    return p.response.period > 1 ? near_kind : 0.0;
  }
  if (p.response.regime == Regime::periodic) return p.response.period > 1 && period_in(word) != 1 ? same_kind : 0.0;
  return near_kind;
}

double best_likeness(std::span<const ClaimPoint> part, std::string_view word) {
  double best = 0.0;
  for (const ClaimPoint& p : part) best = std::max(best, likeness(p, word));
  return best;
}

/// A condition that holds by the existing points, but not for any possible result of the failed ones.
void withdraw(ConditionOutcome& o) {
  if (!o.holds) return;
  o.holds = false;
  o.cost = step_of_failure;
}

/// The possible contribution of failed points counts against an upper bound.
/// @param unit  contribution of one of them
void judge_failed(const Condition& c, std::span<const ClaimPoint> part, double unit, ConditionOutcome& o) {
  const double more = unit * static_cast<double>(failed_in(part));
  if (c.at_most && o.measured + more > *c.at_most) withdraw(o);
}

/// "; 3 points failed"; empty for none.
std::string points_text(std::size_t points, std::string_view did) {
  if (points == 0) return {};
  return "; " + std::to_string(points) + (points == 1 ? " point " : " points ") + std::string(did);
}

/// What a condition's verdict may have missed: failed points; undecided points, if it depends on regimes; points whose
/// record had not converged, if it reads quantities.
std::string doubts_text(const Condition& c, std::span<const ClaimPoint> part) {
  using enum ConditionKind;
  const bool reads_regimes = !c.regime.empty() || !c.regimes.empty() || c.kind == variation || c.kind == agreement;
  const bool reads_quantities = !c.quantity.empty() || c.kind == variation || c.kind == agreement;
  std::string text = points_text(failed_in(part), "failed");
  if (reads_regimes) text += points_text(number_of(part, is_undecided), "undecided");
  if (reads_quantities)
    text += points_text(number_of(part, [](const auto& p) { return p.reached && !p.converged; }), not_converged);
  return text;
}

/// What points lack of a regime.
std::vector<double> lacks(std::span<const ClaimPoint> part, std::string_view word) {
  std::vector<double> all;
  for (const ClaimPoint& p : part)
    if (const auto lack = p.lacks(word)) all.push_back(*lack);
  return all;
}

/// Of the points that lack least, as many as that.
std::vector<double> least_lacks(std::span<const ClaimPoint> part, std::string_view word, std::size_t most) {
  std::vector<double> all = lacks(part, word);
  std::ranges::sort(all);
  all.resize(std::min(all.size(), most));
  return all;
}

/// The cost of a condition that fails, by what is lacking too. Multipliers may be as requested although the regime is
/// another one. The words for regimes then lead.
void lead(const std::vector<double>& lacking, ConditionOutcome& o) {
  if (o.holds || lacking.empty()) return;
  const double mean = std::accumulate(lacking.begin(), lacking.end(), 0.0) / static_cast<double>(lacking.size());
  o.cost = 0.5 * (o.cost + step_of_failure + (1.0 - step_of_failure) * mean);
}

void share(const Condition& c, std::span<const ClaimPoint> part, ConditionOutcome& o) {
  const auto n = static_cast<double>(part.size());
  o.measured = static_cast<double>(std::ranges::count_if(part, [&](const auto& p) { return moves(p, c.regime); })) / n;
  o.error = 0.5 / n;
  o.part_of_one = true;
  judge_bounds(c, o, 1.0);
  judge_failed(c, part, 1.0 / n, o);
  if (c.at_least && o.measured < *c.at_least) lead(lacks(part, c.regime), o);
  o.text = number(o.measured * 100.0) + " % " + c.regime + range_text(part) + ", " + bound_text(c, true);
}

void count(const Condition& c, std::span<const ClaimPoint> part, ConditionOutcome& o) {
  o.measured = static_cast<double>(std::ranges::count_if(part, [&](const auto& p) { return moves(p, c.regime); }));
  judge_bounds(c, o, static_cast<double>(part.size()));
  judge_failed(c, part, 1.0, o);
  if (!o.holds && c.at_least && o.measured == 0.0)
    o.cost = 1.0 - (1.0 - step_of_failure) * best_likeness(part, c.regime);
  if (c.at_least && o.measured < *c.at_least)
    lead(least_lacks(part, c.regime, static_cast<std::size_t>(std::ceil(*c.at_least))), o);
  o.text = number(o.measured) + (o.measured == 1.0 ? " point " : " points ") + c.regime + range_text(part) + ", " +
           bound_text(c);
}

/// What is lacking of a change within its bounds: the one regime before them, and the other beyond. For the first
/// change, the regime has to last up to the change, and the next one only has to begin. For the last change, it is the
/// reverse.
void lead_to_change(const Condition& c, std::span<const ClaimPoint> part, ConditionOutcome& o) {
  constexpr double beside = 2.0;  // times the bounds' width
  const double reach = beside * (c.within[1] - c.within[0]);
  const bool first = c.which.value_or(Which::first) == Which::first;
  const auto from = [&](double value) {
    return std::ranges::lower_bound(part, value, {}, &ClaimPoint::value) - part.begin();
  };
  const auto to = [&](double value) {
    return std::ranges::upper_bound(part, value, {}, &ClaimPoint::value) - part.begin();
  };
  const std::span before(part.begin() + (first ? 0 : from(c.within[0] - reach)), part.begin() + from(c.within[0]));
  const std::span after(part.begin() + to(c.within[1]), first ? part.begin() + to(c.within[1] + reach) : part.end());
  std::vector<double> all = lacks(before, c.regime);
  const std::vector<double> there = lacks(after, c.leads_to.empty() ? c.regime_after : c.leads_to);
  all.insert(all.end(), there.begin(), there.end());
  lead(all, o);
}

/// May a failed point hide an earlier change outside of the bounds (for the last change, a later one)? Or may the
/// regime before the change have returned before the regime after it was found?
/// @param k  the change is from this point to the next
bool may_be_another_change(const Condition& c, std::span<const ClaimPoint> part, std::size_t k) {
  const auto is_outside = [&](std::size_t a, std::size_t b) {
    const double middle = 0.5 * (part[a].value + part[b].value);
    return !is_at_least(middle, c.within[0]) || !is_at_most(middle, c.within[1]);
  };
  const bool first = c.which.value_or(Which::first) == Which::first;
  for (std::size_t j = first ? 0 : k + 2; j < (first ? k : part.size()); ++j)
    if (!part[j].reached && ((j > 0 && is_outside(j - 1, j)) || (j + 1 < part.size() && is_outside(j, j + 1))))
      return true;
  if (c.leads_to.empty()) return false;
  const std::span<const ClaimPoint> beyond = part.subspan(k + 1);
  const auto met = std::ranges::find_if(beyond, [&](const ClaimPoint& p) { return moves(p, c.leads_to); });
  return std::any_of(beyond.begin(), met, [](const ClaimPoint& p) { return !p.reached; });
}

void change(const Condition& c, std::span<const ClaimPoint> part, ConditionOutcome& o) {
  o.measured = none;
  std::size_t change_at = 0;
  // Of those within the bounds' neighbourhood a search is led by the nearest; the verdict is on the first or the last.
  for (std::size_t k = 0; k + 1 < part.size(); ++k) {
    if (!moves(part[k], c.regime) || !moves(part[k + 1], c.regime_after)) continue;
    if (!c.leads_to.empty()) {
      bool met = false;
      for (std::size_t j = k + 1; j < part.size() && !moves(part[j], c.regime); ++j)
        met = met || moves(part[j], c.leads_to);
      if (!met) continue;
    }
    o.measured = 0.5 * (part[k].value + part[k + 1].value);
    o.error = 0.5 * (part[k + 1].value - part[k].value);
    change_at = k;
    if (c.which.value_or(Which::first) == Which::first) break;
  }
  const std::string words =
      c.regime + " to " + c.regime_after + (c.leads_to.empty() ? "" : " that leads to " + c.leads_to);
  const std::string must = ", must be within " + number(c.within[0]) + " to " + number(c.within[1]);
  if (std::isnan(o.measured)) {
    o.cost = 1.0;
    o.text = "no change from " + words + range_text(part) + must;
    lead_to_change(c, part, o);
    return;
  }
  o.holds = is_at_least(o.measured, c.within[0]) && is_at_most(o.measured, c.within[1]);
  o.cost = o.holds ? 0.0 : cost_within(o.measured, c.within[0], c.within[1], c.within[1] - c.within[0]);
  if (o.holds && may_be_another_change(c, part, change_at)) withdraw(o);
  o.text = words + " at " + number(o.measured) + must;
  lead_to_change(c, part, o);
}

void sequence(const Condition& c, std::span<const ClaimPoint> part, ConditionOutcome& o) {
  std::size_t met = 0;
  std::string text;
  for (const ClaimPoint& p : part)
    if (met < c.regimes.size() && moves(p, c.regimes[met])) {
      text += (met == 0 ? "" : ", ") + c.regimes[met] + " at " + number(p.value);
      ++met;
    }
  o.measured = static_cast<double>(met);
  o.holds = met == c.regimes.size();
  o.cost = o.holds ? 0.0 : 1.0 - o.measured / static_cast<double>(c.regimes.size());
  std::vector<double> lacking;
  for (const std::string& word : c.regimes)
    for (const double lack : least_lacks(part, word, 1)) lacking.push_back(lack);
  if (lacking.size() == c.regimes.size()) lead(lacking, o);
  o.text = o.holds ? text : text + (text.empty() ? "no " : ", then no ") + c.regimes[met];
}

void value(const Condition& c, std::span<const ClaimPoint> part, ConditionOutcome& o) {
  std::vector<double> values;
  for (const ClaimPoint& p : part)
    if (p.reached && (c.regime.empty() || p.response.is(c.regime)) && !std::isnan(p.quantity(c.quantity)))
      values.push_back(p.quantity(c.quantity));
  o.measured = none;
  if (!values.empty()) {
    switch (c.statistic.value_or(Statistic::max)) {
      case Statistic::min:
        o.measured = std::ranges::min(values);
        break;
      case Statistic::max:
        o.measured = std::ranges::max(values);
        break;
      case Statistic::mean:
        o.measured = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    }
  }
  const double bound = std::abs(c.at_least.value_or(c.at_most.value_or(0.0)));
  judge_bounds(c, o, std::max(bound, std::numeric_limits<double>::min()));
  // A failed point can only raise the maximum and only lower the minimum; it can change the mean in both directions.
  const Statistic statistic = c.statistic.value_or(Statistic::max);
  const bool could_break = (c.at_most && statistic != Statistic::min) || (c.at_least && statistic != Statistic::max);
  if (could_break && failed_in(part) > 0) withdraw(o);
  const std::string of = range_text(part) + ", " + bound_text(c);
  o.text = values.empty() ? "no " + c.quantity + " of any point" + (c.regime.empty() ? "" : " " + c.regime) + of
                          : c.quantity + " " + number(o.measured) + of;
}

void falls(const Condition& c, std::span<const ClaimPoint> part, ConditionOutcome& o) {
  const double first = part.front().quantity(c.quantity);
  const double last = part.back().quantity(c.quantity);
  double most = first;
  double most_at = part.front().value;
  bool reached = true;
  for (const ClaimPoint& p : part) {
    reached = reached && p.reached;
    if (p.quantity(c.quantity) > most) {
      most = p.quantity(c.quantity);
      most_at = p.value;
    }
  }
  // The range of period 1 is 0: it has fallen by any factor. A quantity that is 0 at first cannot fall.
  const double factor = c.at_least.value_or(1.0);
  const double floor = std::max(last, std::numeric_limits<double>::epsilon());
  o.measured = first / floor;
  const bool fell = o.measured >= factor;
  const bool rises = most > first + noise * std::abs(first);
  o.holds = reached && fell && !rises && first > noise;
  if (!o.holds) {
    const double fell_short = fell ? 0.0 : 1.0 - std::log(std::max(1.0, o.measured)) / std::log(std::max(2.0, factor));
    const double rose = rises ? (most - first) / most : 0.0;
    o.cost = reached ? step_of_failure + (1.0 - step_of_failure) * std::max(fell_short, rose) : 1.0;
  }
  o.text = c.quantity + " " + number(first) + " at " + number(part.front().value) + ", " + number(last) + " at " +
           number(part.back().value) + (rises ? ", but " + number(most) + " at " + number(most_at) : std::string()) +
           ", must fall by a factor of " + number(factor) + " and never rise above the first";
}

/// A local maximum, of several the most prominent.
struct Peak {
  double prominence = 0.0;
  double at = none;
};

/// Of a quantity along a part of a sweep. Failed points are no maxima and bound none. Points behind a failed one do not
/// make a maximum prominent, as if the sweep ended there.
/// @param x  not a number if a point failed
Peak highest_peak(std::span<const ClaimPoint> part, const std::vector<double>& x, double low, double high) {
  const auto prominence_at = [&](std::size_t k) {
    double left = x[k];
    for (std::size_t j = k; j-- > 0 && x[j] <= x[k];) left = std::min(left, x[j]);
    double right = x[k];
    for (std::size_t j = k + 1; j < x.size() && x[j] <= x[k]; ++j) right = std::min(right, x[j]);
    return x[k] - std::max(left, right);
  };
  Peak best;
  for (std::size_t k = 1; k + 1 < x.size(); ++k) {
    if (!(part[k].value >= low && part[k].value <= high) || !(x[k] >= x[k - 1] && x[k] >= x[k + 1])) continue;
    if (const double p = prominence_at(k); p > best.prominence) best = {p, part[k].value};
  }
  return best;
}

void peaks(const Condition& c, std::span<const ClaimPoint> part, ConditionOutcome& o) {
  const double location_tolerance = c.location_tolerance.value_or(default_location_tolerance);
  const double prominence = c.prominence.value_or(default_prominence);
  std::vector<double> x;
  double most = 0.0;
  for (const ClaimPoint& p : part) {
    x.push_back(p.reached ? p.quantity(c.quantity) : none);
    if (p.reached) most = std::max(most, std::abs(x.back()));
  }
  double costs = 0.0;
  double met = 0.0;
  for (const double place : c.peak_locations) {
    const Peak best = highest_peak(part, x, place * (1.0 - location_tolerance), place * (1.0 + location_tolerance));
    const double relative = most > 0.0 ? best.prominence / most : 0.0;
    const bool peak = relative >= prominence;
    met += peak ? 1.0 : 0.0;
    costs += peak ? 0.0 : step_of_failure + (1.0 - step_of_failure) * (1.0 - relative / prominence);
    o.text += (o.text.empty() ? "" : "; ") + ("at " + number(place)) +
              (std::isnan(best.at) ? ": no maximum"
                                   : ": prominence " + number(100.0 * relative) + " % at " + number(best.at));
  }
  o.measured = met;
  o.holds = met == static_cast<double>(c.peak_locations.size());
  o.cost = o.holds ? 0.0 : costs / static_cast<double>(c.peak_locations.size());
  // The largest value, of which a prominence is a part, may have been at a point that failed.
  if (failed_in(part) > 0) withdraw(o);
  o.text += "; each must have " + number(100.0 * prominence) + " %";
}

/// A step is a jump if it is so many times its neighbours' steps: a flank of a resonance is no jump.
constexpr double beyond_neighbours = 3.0;

/// A step of a quantity from one point to the next.
struct Step {
  double size = 0.0;        ///< of the larger value
  double at = none;         ///< halfway
  double abruptness = 0.0;  ///< times the larger of the steps beside it
  bool side_by_side = false;

  [[nodiscard]] bool is_jump() const { return side_by_side || abruptness > beyond_neighbours; }
  /// A step that is not above its neighbours still leads a search, by its nearness to that.
  [[nodiscard]] double nearness() const {
    const double part = is_jump() ? 1.0 : abruptness / beyond_neighbours;
    return size * part * part;
  }
};

/// Steps of a quantity of one regime, between `from` and `to` of the condition.
class Steps {
 public:
  explicit Steps(const Condition& c) : c_(c) {}

  /// From each point to the next. The abruptness of a step is unknown if no neighbour counts, on either side.
  [[nodiscard]] std::vector<Step> along(const std::vector<ClaimPoint>& points) const {
    std::vector<Step> steps;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const double middle = 0.5 * (points[k].value + points[k + 1].value);
      if ((c_.from && !is_at_least(points[k].value, *c_.from)) || (c_.to && !is_at_most(points[k + 1].value, *c_.to)))
        continue;
      if (!counts(points[k]) || !counts(points[k + 1])) continue;
      std::optional<double> beside;
      if (k > 0 && counts(points[k - 1])) beside = step(points[k - 1], points[k]);
      if (k + 2 < points.size() && counts(points[k + 2]))
        beside = std::max(beside.value_or(0.0), step(points[k + 1], points[k + 2]));
      if (!beside) continue;
      // Steps below rounding are all alike.
      const double least = noise * std::max(std::abs(q(points[k])), std::abs(q(points[k + 1])));
      const double abruptness = step(points[k], points[k + 1]) / std::max({*beside, least, noise * noise});
      steps.push_back({relative(points[k], points[k + 1]), middle, abruptness, false});
    }
    return steps;
  }

  /// Between points of both directions at one value. Values that are not periodic differ from record to record. So do
  /// two records that converge to one orbit.
  [[nodiscard]] std::vector<Step> across(std::span<const ClaimPoint> part, const std::vector<ClaimPoint>& other) const {
    std::vector<Step> steps;
    const auto is_orbit = [&](const ClaimPoint& p) {
      return counts(p) && p.converged && p.response.regime == Regime::periodic;
    };
    for (const ClaimPoint& p : part) {
      const auto twin =
          std::ranges::find_if(other, [&](const ClaimPoint& one) { return is_same_value(one.value, p.value); });
      if (twin != other.end() && is_orbit(p) && is_orbit(*twin))
        steps.push_back({relative(p, *twin), p.value, 0.0, true});
    }
    return steps;
  }

 private:
  const Condition& c_;

  [[nodiscard]] double q(const ClaimPoint& p) const { return p.quantity(c_.quantity); }
  [[nodiscard]] bool counts(const ClaimPoint& p) const {
    return p.reached && (c_.regime.empty() || p.response.is(c_.regime));
  }
  [[nodiscard]] double step(const ClaimPoint& a, const ClaimPoint& b) const { return std::abs(q(b) - q(a)); }
  [[nodiscard]] double relative(const ClaimPoint& a, const ClaimPoint& b) const {
    const double larger = std::max(std::abs(q(a)), std::abs(q(b)));
    return larger > noise ? step(a, b) / larger : 0.0;
  }
};

void jump(const Condition& c, const ClaimSeries& series, std::span<const ClaimPoint> part, ConditionOutcome& o) {
  const Steps steps(c);
  std::vector<Step> all = steps.along(series.points);
  const std::vector<Step> across = steps.across(part, series.other);
  all.insert(all.end(), across.begin(), across.end());
  const double least = c.at_least.value_or(0.0);
  Step largest;  // jump
  Step nearest;  // to one
  for (const Step& one : all) {
    if (one.is_jump() && one.size > largest.size) largest = one;
    if (one.nearness() > nearest.nearness()) nearest = one;
  }
  o.measured = largest.size;
  judge_bounds(c, o, 1.0);
  if (!o.holds) o.cost = step_of_failure + (1.0 - step_of_failure) * (1.0 - std::min(1.0, nearest.nearness() / least));
  std::vector<double> short_of_fold;
  for (const ClaimPoint& p : part)
    if (p.period_one && p.period_one->found && (c.regime.empty() || c.regime == "period 1"))
      short_of_fold.push_back(std::max(0.0, 1.0 - p.period_one->fold));
  if (!short_of_fold.empty()) lead({std::ranges::min(short_of_fold)}, o);
  const auto step_text = [&](const Step& one) {
    return number(100.0 * one.size) + " % of " + c.quantity + " at " + number(one.at);
  };
  if (largest.size > 0.0) {
    o.text = step_text(largest) + (largest.side_by_side ? ", two attractors coexist" : "");
  } else {
    o.text = "none";
    if (nearest.size > 0.0)
      o.text += " (" + step_text(nearest) + " are " + number(nearest.abruptness) + " times the steps beside it)";
  }
  o.text += ", must be at least " + number(100.0 * least) + " %";
}

/// Of two neighbouring points: 1 for another regime, else the relative change of the Poincare range. A range below the
/// recurrence tolerance counts as none. As printed, the change of the least or the greatest dot over the axis. Neither
/// point may have failed.
double variation_between(const ClaimPoint& a, const ClaimPoint& b) {
  if (!a.response.same(b.response)) return 1.0;
  if (a.drawn && b.drawn)
    return std::max(std::abs((*a.drawn)[0] - (*b.drawn)[0]), std::abs((*a.drawn)[1] - (*b.drawn)[1]));
  // The section of period 1 is one point; this range is that of the oscillation in time.
  const bool point = a.response.is("period 1");
  const std::string_view name = point ? "delta_sp_range" : "poincare_sp_range";
  const double larger = std::max(a.quantity(name), b.quantity(name));
  return larger > noise ? std::abs(a.quantity(name) - b.quantity(name)) / larger : 0.0;
}

void variation(const Condition& c, std::span<const ClaimPoint> part, ConditionOutcome& o) {
  double at = none;
  if (part.size() < 2) {
    o.text = "a single point does not vary";
    return;
  }
  for (std::size_t k = 0; k + 1 < part.size(); ++k) {
    if (!part[k].reached || !part[k + 1].reached) continue;
    if (const double v = variation_between(part[k], part[k + 1]); v > o.measured) {
      o.measured = v;
      at = 0.5 * (part[k].value + part[k + 1].value);
    }
  }
  judge_bounds(c, o, 0.1);
  judge_failed(c, part, 1.0, o);
  if (!o.holds && c.at_least)
    o.cost = step_of_failure + (1.0 - step_of_failure) * (1.0 - std::min(1.0, o.measured / *c.at_least));
  o.text = "largest change between neighbours" + range_text(part) + " is " + number(100.0 * o.measured) + " %" +
           (std::isnan(at) ? "" : " at " + number(at)) + ", " + bound_text(c, true);
}

void alike(const Condition& c, std::span<const ClaimPoint> part, ConditionOutcome& o) {
  double same = 0.0;
  std::vector<double> sun;
  std::vector<double> ring;
  for (const ClaimPoint& p : part) {
    if (!p.reached) continue;
    // Both are undecided, and so not in agreement.
    const bool is_known = p.by_sun_mesh.regime != Regime::undecided || !p.by_sun_mesh.classified;
    same += is_known && p.by_sun_mesh.same(p.by_ring_mesh) ? 1.0 : 0.0;
    sun.push_back(p.quantity("poincare_sp_range"));
    ring.push_back(p.quantity("poincare_rp_range"));
  }
  o.measured = same / static_cast<double>(part.size());
  o.error = 0.5 / static_cast<double>(part.size());
  o.part_of_one = true;
  const double correlation = analysis::correlation(sun, ring);
  const auto varies = [](const std::vector<double>& ranges) {
    return std::ranges::any_of(ranges, [&](double range) { return range != ranges.front(); });
  };
  judge_bounds(c, o, 1.0);
  if (c.correlation) {
    o.holds = o.holds && correlation >= *c.correlation;
    o.cost =
        0.5 * (o.cost + (correlation >= *c.correlation ? 0.0 : cost_within(correlation, *c.correlation, 1.0, 1.0)));
  }
  o.text = "the same regime by both meshes at " + number(100.0 * o.measured) + " %, " +
           (varies(sun) && varies(ring) ? "ranges correlate by " + number(correlation)
                                        : std::string("ranges that do not vary and so do not correlate")) +
           ", " + bound_text(c, true) +
           (c.correlation ? " and correlate by at least " + number(*c.correlation) : std::string());
}

void decreasing(const Condition& c, const ClaimRecord& record, ConditionOutcome& o) {
  // Values common to all sweeps at which the first sweep has the regime.
  std::vector<std::span<const ClaimPoint>> parts;
  for (const std::string& sweep : c.sweeps) parts.push_back(part_of(record.at(sweep).points, c));
  std::vector<double> most(parts.size(), -std::numeric_limits<double>::infinity());
  std::size_t seen = 0;
  std::size_t failed = 0;
  std::size_t unconverged = 0;
  std::size_t undecided = 0;
  for (const ClaimPoint& first : parts.front()) {
    undecided += !c.regime.empty() && is_undecided(first) ? 1 : 0;
    if (first.reached && !c.regime.empty() && !first.response.is(c.regime)) continue;
    std::vector<const ClaimPoint*> there;
    for (const auto& part : parts) {
      const auto at =
          std::ranges::find_if(part, [&](const ClaimPoint& p) { return is_same_value(p.value, first.value); });
      if (at != part.end()) there.push_back(&*at);
    }
    if (there.size() < parts.size()) continue;
    const auto lost = std::ranges::count_if(there, [](const ClaimPoint* p) { return !p->reached; });
    failed += static_cast<std::size_t>(lost);
    if (lost > 0) continue;
    unconverged += std::ranges::any_of(there, [](const ClaimPoint* p) { return !p->converged; }) ? 1 : 0;
    ++seen;
    for (std::size_t s = 0; s < parts.size(); ++s) most[s] = std::max(most[s], there[s]->quantity(c.quantity));
  }
  o.measured = 0.0;
  if (seen == 0) {
    o.text = "no point that all sweeps have " + (c.regime.empty() ? "was computed" : "is " + c.regime) +
             points_text(failed, "failed") + points_text(undecided, "undecided");
    return;
  }
  if (!std::ranges::all_of(most, [](double x) { return std::isfinite(x); })) {
    o.text = "no " + c.quantity + " of any point";
    return;
  }
  const auto pairs = static_cast<double>(most.size() - 1);
  double rises = 0.0;
  for (std::size_t s = 0; s + 1 < most.size(); ++s) {
    const double size = std::max(std::abs(most[s]), std::numeric_limits<double>::min());
    const double rise = (most[s + 1] - most[s]) / size;
    if (rise < -noise)
      o.measured += 1.0;
    else
      rises += step_of_failure + std::clamp(rise, 0.0, 1.0 - step_of_failure);
  }
  o.holds = o.measured == pairs;
  o.cost = o.holds ? 0.0 : rises / pairs;
  // The largest value of any sweep may have been at a point that failed.
  if (failed > 0) withdraw(o);
  for (std::size_t s = 0; s < most.size(); ++s) o.text += (s == 0 ? "" : ", ") + number(most[s]);
  o.text = "largest " + c.quantity + " of " + std::to_string(seen) + (seen == 1 ? " value: " : " values: ") + o.text +
           ", must fall" + points_text(failed, "failed") + points_text(undecided, "undecided") +
           points_text(unconverged, std::string(not_converged) + " in one of them");
}

/// Published values of a quantity along a sweep.
void curve(const Condition& c, const ClaimSeries& series, ConditionOutcome& o) {
  const Direction direction = c.direction.value_or(series.direction);
  const std::vector<ClaimPoint>& points = direction == series.direction ? series.points : series.other;
  double scale = 0.0;
  for (const double published : c.data) scale = std::max(scale, std::abs(published));
  const double tolerance = c.tolerance.value_or(0.0);
  double within = 0.0;
  double costs = 0.0;
  double worst = -1.0;
  std::string at;
  for (std::size_t k = 0; k < c.data.size(); ++k) {
    const double there = quantity_at(points, c.quantity, c.data_at[k]);
    const double off = std::abs(there - c.data[k]) / scale;
    const bool is_within = off <= tolerance;
    within += is_within ? 1.0 : 0.0;
    costs += is_within ? 0.0 : cost_within(off, 0.0, tolerance, tolerance);
    if (off <= worst) continue;
    worst = std::isnan(off) ? std::numeric_limits<double>::infinity() : off;
    at = number(there) + " for " + number(c.data[k]) + " at " + number(c.data_at[k]);
  }
  const auto count = static_cast<double>(c.data.size());
  o.measured = within / count;
  o.part_of_one = true;
  o.holds = o.measured >= c.at_least.value_or(1.0);
  o.cost = o.holds ? 0.0 : costs / count;
  o.text = c.quantity + ": " + number(within) + " of " + number(count) + " values within " + number(100.0 * tolerance) +
           " % of the largest; " +
           (std::isfinite(worst) ? "most off by " + number(100.0 * worst) + " %" : std::string("not computed")) + ": " +
           at;
}

/// All natural frequencies of a type, each next to its published value.
void frequencies(const Condition& c, const std::vector<ClaimMode>& modes, ConditionOutcome& o) {
  const ModeMatch match = matched_modes(c, modes);
  const std::string kind = c.mode_type.empty() ? std::string() : c.mode_type + " ";
  if (match.modes.size() != match.published.size()) {
    o.measured = none;
    o.text = std::to_string(match.modes.size()) + " " + kind + "frequencies, " +
             std::to_string(match.published.size()) + " are published";
    return;
  }
  double worst = -1.0;
  bool within = true;
  std::string at;
  std::string other;
  for (std::size_t k = 0; k < match.modes.size(); ++k) {
    const ClaimMode& mode = modes[match.modes[k]];
    const double off = std::abs(mode.frequency_Hz - match.published[k]);
    // Published digits and tolerances are decimal numbers.
    within = within && is_at_most(off, match.tolerance[k]);
    if (c.multiplicity && mode.multiplicity != *c.multiplicity)
      other += "; " + number(mode.frequency_Hz) + " Hz has multiplicity " + std::to_string(mode.multiplicity);
    if (off <= worst) continue;
    worst = off;
    at = short_text(mode.frequency_Hz, 7) + " for " + short_text(match.published[k], 7) + " Hz";
  }
  o.measured = worst;
  o.holds = within && other.empty();
  o.cost = o.holds ? 0.0 : cost_within(worst, 0.0, match.tolerance.front(), match.tolerance.front());
  o.text = std::to_string(match.modes.size()) + " " + kind + "frequencies, most off by " + short_text(worst, 2) +
           " Hz: " + at + other;
}

/// Do all quantities of the conditions at these points equal those of the first, to within integration errors?
bool is_inert(const ClaimPoint& first, const std::vector<ClaimPoint>& points,
              const std::set<std::string, std::less<>>& quantities) {
  constexpr double nothing = 1e-5;  // of a quantity
  return std::ranges::all_of(points, [&](const ClaimPoint& p) {
    if (!first.reached || !p.reached || !p.response.same(first.response)) return false;
    const auto is_the_same = [&](const std::string& name) {
      const double a = first.quantity(name);
      const double b = p.quantity(name);
      return std::abs(a - b) <= nothing * std::max({noise, std::abs(a), std::abs(b)});
    };
    return variation_between(first, p) < nothing && std::ranges::all_of(quantities, is_the_same);
  });
}

/// Of a claim's conditions, those that are read along one of its sweeps.
std::set<std::string, std::less<>> quantities_along(const Claim& claim, const std::string& sweep) {
  std::set<std::string, std::less<>> quantities;
  for (const Condition& c : claim.conditions) {
    if (c.sweep != sweep && std::ranges::find(c.sweeps, sweep) == c.sweeps.end()) continue;
    if (!c.quantity.empty()) quantities.insert(c.quantity);
    if (c.kind == ConditionKind::agreement) quantities.insert({"poincare_sp_range", "poincare_rp_range"});
  }
  return quantities;
}

/// Sweeps that a claim's conditions compare with each other.
std::vector<std::string> compared_with_others(const Claim& claim) {
  std::vector<std::string> names;
  for (const Condition& c : claim.conditions) names.insert(names.end(), c.sweeps.begin(), c.sweeps.end());
  return names;
}

}  // namespace

ModeMatch matched_modes(const Condition& c, const std::vector<ClaimMode>& modes) {
  ModeMatch match;
  for (std::size_t k = 0; k < modes.size(); ++k)
    if (c.mode_type.empty() || modes[k].type == c.mode_type) match.modes.push_back(k);
  std::vector<std::pair<double, double>> published;
  for (std::size_t k = 0; k < c.frequencies_Hz.size(); ++k)
    published.emplace_back(c.frequencies_Hz[k], c.tolerance_Hz[c.tolerance_Hz.size() == 1 ? 0 : k]);
  std::ranges::sort(published);
  for (const auto& [frequency, tolerance] : published) {
    match.published.push_back(frequency);
    match.tolerance.push_back(tolerance);
  }
  return match;
}

double quantity_at(const std::vector<ClaimPoint>& points, std::string_view quantity, double value) {
  const auto right = std::ranges::find_if(points, [&](const ClaimPoint& p) { return is_at_least(p.value, value); });
  if (right == points.end() || !right->reached) return none;
  if (is_same_value(right->value, value)) return right->quantity(quantity);
  if (right == points.begin() || !std::prev(right)->reached) return none;
  const ClaimPoint& left = *std::prev(right);
  const double part = (value - left.value) / (right->value - left.value);
  return left.quantity(quantity) + part * (right->quantity(quantity) - left.quantity(quantity));
}

ConditionOutcome judge(const Condition& c, const ClaimRecord& record) {
  ConditionOutcome o;
  if (c.kind == ConditionKind::decreasing) {
    decreasing(c, record, o);
    return o;
  }
  if (c.kind == ConditionKind::frequencies) {
    frequencies(c, record.at(c.stage).modes, o);
    return o;
  }
  const ClaimSeries& series = record.at(c.sweep);
  if (c.kind == ConditionKind::curve) {
    curve(c, series, o);
    o.text += doubts_text(c, series.points);
    return o;
  }
  const std::span<const ClaimPoint> part = part_of(series.points, c);
  if (part.empty()) {
    o.measured = none;
    o.text = "no point of the sweep is there";
    return o;
  }
  switch (c.kind) {
    case ConditionKind::share:
      share(c, part, o);
      break;
    case ConditionKind::count:
      count(c, part, o);
      break;
    case ConditionKind::change:
      change(c, part, o);
      break;
    case ConditionKind::sequence:
      sequence(c, part, o);
      break;
    case ConditionKind::value:
      value(c, part, o);
      break;
    case ConditionKind::reduction:
      falls(c, part, o);
      break;
    case ConditionKind::peaks:
      peaks(c, part, o);
      break;
    case ConditionKind::jump:
      jump(c, series, part, o);
      break;
    case ConditionKind::variation:
      variation(c, part, o);
      break;
    case ConditionKind::agreement:
      alike(c, part, o);
      break;
    case ConditionKind::decreasing:
    case ConditionKind::curve:
    case ConditionKind::frequencies:
      break;
  }
  if (o.holds) o.cost = 0.0;
  o.text += doubts_text(c, part);
  return o;
}

namespace {

/// All conditions of a list have to hold.
ClaimOutcome judge_all(const std::vector<Condition>& conditions, const ClaimRecord& record) {
  ClaimOutcome outcome;
  outcome.holds = true;
  outcome.cost = 0.0;
  for (const Condition& condition : conditions) {
    outcome.conditions.push_back(judge(condition, record));
    outcome.holds = outcome.holds && outcome.conditions.back().holds;
    outcome.cost += outcome.conditions.back().cost / static_cast<double>(conditions.size());
  }
  return outcome;
}

}  // namespace

ClaimOutcome judge(const Claim& claim, const ClaimRecord& record, Reading reading) {
  ClaimOutcome outcome = judge_all(claim.conditions, record);
  if (reading == Reading::printed && !outcome.holds && !claim.as_printed.empty())
    if (ClaimOutcome instead = judge_all(claim.as_printed, record); instead.cost < outcome.cost)
      outcome = std::move(instead);
  const std::vector<std::string> sweeps = sweeps_of(claim);
  const std::vector<std::string> compared = compared_with_others(claim);
  outcome.inert = !sweeps.empty() && std::ranges::all_of(sweeps, [&](const std::string& name) {
    const ClaimSeries& series = record.at(name);
    const bool is_compared = std::ranges::find(compared, name) != compared.end();
    const std::vector<ClaimPoint>& beside = record.at(is_compared ? compared.front() : name).points;
    const auto quantities = quantities_along(claim, name);
    return !beside.empty() && is_inert(beside.front(), series.points, quantities) &&
           is_inert(beside.front(), series.other, quantities);
  });
  return outcome;
}

std::vector<std::string> sweeps_of(const Claim& claim) {
  std::set<std::string> names;
  for (const auto* conditions : {&claim.conditions, &claim.as_printed})
    for (const Condition& c : *conditions) {
      if (!c.sweep.empty()) names.insert(c.sweep);
      names.insert(c.sweeps.begin(), c.sweeps.end());
    }
  return {names.begin(), names.end()};
}

}  // namespace epicyclic::claims
