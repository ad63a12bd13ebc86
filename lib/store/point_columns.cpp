#include "store/point_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace epicyclic::store {

namespace {

using studies::PointSummary;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

bool ok(const PointSummary& r) { return r.outcome == integrate::Outcome::reached; }

/// Periodic by an orbit and its multipliers.
bool proven(const PointSummary& r) { return ok(r) && r.classified && r.regime == analysis::Regime::periodic; }

/// Extrema that were never seen are none.
double seen(double x) { return std::isfinite(x) ? x : unknown; }

using Integer = PointColumn::Getter<std::int64_t>;
using Number = PointColumn::Getter<double>;
using Words = PointColumn::Getter<std::string>;

/// A number that a proven orbit has.
Number of_orbit(double analysis::Evidence::*member) {
  return [member](const PointSummary& r) { return proven(r) ? r.evidence.*member : unknown; };
}

/// Columns from the record of a point.
std::vector<PointColumn> of_points(const std::vector<StageColumn>& columns) {
  std::vector<PointColumn> all;
  for (const StageColumn& column : columns)
    all.push_back(column_of_part<PointSummary>(
        column, [](const PointSummary& r) -> const studies::StageRecord& { return r.meshes; }));
  return all;
}

}  // namespace

std::string status_word(integrate::Outcome outcome) {
  switch (outcome) {
    case integrate::Outcome::reached:
      return "ok";
    case integrate::Outcome::diverged:
      return "diverged";
    case integrate::Outcome::step_limit:
      return "step_limit";
    case integrate::Outcome::failed:
      return "failed";
  }
  return "failed";
}

std::string direction_word(studies::Direction direction) { return direction == studies::Direction::up ? "up" : "down"; }

std::string regime_word(const PointSummary& r) { return ok(r) ? to_string(r.regime) : ""; }

std::vector<PointColumn> point_columns_like(const PointSummary& point, const std::vector<PointColumn>& more) {
  return point_columns(point.meshes.sun_planet.size(), more, known_lives(point.meshes));
}

std::vector<PointColumn> point_columns(std::size_t planets, const std::vector<PointColumn>& more,
                                       const KnownLives& lives) {
  const auto integer = [](auto x) { return static_cast<std::int64_t>(x); };
  std::vector<PointColumn> all = {{"point", "1", "number of the point in the study, from 0",
                                   Integer([=](const PointSummary& r) { return integer(r.point.index); })},
                                  {"direction", "", "up or down: direction of the parameter along the chain",
                                   Words([](const PointSummary& r) { return direction_word(r.point.direction); })},
                                  {"value", "of the parameter", "of the parameter that is varied",
                                   Number([](const PointSummary& r) { return r.point.value; })}};
  all.insert(all.end(), more.begin(), more.end());
  const auto add = [&all](const char* name, const char* unit, const char* meaning, auto&& value) {
    all.push_back({name, unit, meaning, std::forward<decltype(value)>(value)});
  };
  const auto append = [&all](const std::vector<StageColumn>& columns) {
    for (PointColumn& column : of_points(columns)) all.push_back(std::move(column));
  };
  add("status", "", "ok, diverged, step_limit or failed",
      Words([](const PointSummary& r) { return status_word(r.outcome); }));
  add("regime", "", "periodic, quasiperiodic, chaotic or undecided; empty unless ok", Words(regime_word));
  add("period", "mesh periods", "n of a periodic orbit; 0 of others",
      Integer([=](const PointSummary& r) { return integer(ok(r) ? r.period : 0); }));
  add("lyapunov_max", "1 per tau", "largest Lyapunov exponent",
      Number([](const PointSummary& r) { return r.lyapunov_max().value; }));
  append(contact_columns());
  add("rhs_evaluations", "1", "right-hand sides that the point took",
      Integer([=](const PointSummary& r) { return integer(r.rhs_evaluations); }));
  add("recurrence_error", "b_c, b_c per tau", "largest difference of two states n periods apart, at the n of the least",
      Number([](const PointSummary& r) { return ok(r) ? seen(r.recurrence.error) : unknown; }));
  add("recurrence_error_late", "b_c, b_c per tau", "the same over the second half of the record",
      Number([](const PointSummary& r) { return ok(r) ? r.recurrence.late_error : unknown; }));
  append(stage_columns());
  add("lyapunov_max_error", "1 per tau", "half of the exponent's 95 % interval",
      Number([](const PointSummary& r) { return r.lyapunov_max().half_width; }));
  add("multiplier_max", "1", "largest modulus of the orbit's Floquet multipliers",
      of_orbit(&analysis::Evidence::largest_multiplier));
  add("multiplier_error", "1", "its error", of_orbit(&analysis::Evidence::multiplier_error));
  add("orbit_residual", "b_c, b_c per tau", "by which the orbit found does not close",
      of_orbit(&analysis::Evidence::residual));
  add("orbit_error", "b_c, b_c per tau", "how far it may be from the true one",
      of_orbit(&analysis::Evidence::orbit_error));
  add("zero_one", "1", "K of the 0-1 test, if it was made",
      Number([](const PointSummary& r) { return r.evidence.zero_one.value_or(unknown); }));
  add("classified_periods", "mesh periods", "integrated to classify the regime",
      Integer([=](const PointSummary& r) { return integer(r.evidence.periods); }));
  add("evidence", "", "for the regime, in words", Words([](const PointSummary& r) { return r.evidence.note; }));
  add("converged", "1", "0 if the orbit is periodic and the record has not converged to it, else 1",
      Integer([=](const PointSummary& r) { return integer(!ok(r) || !r.is_unconverged()); }));
  append(planet_columns(planets));
  append(life_columns(planets, lives));
  add("message", "", "what went wrong, of a point that was not reached",
      Words([](const PointSummary& r) { return r.message; }));
  if (planets == 1) std::erase_if(all, [](const PointColumn& column) { return !is_of_pair(column.name); });
  return all;
}

}  // namespace epicyclic::store
