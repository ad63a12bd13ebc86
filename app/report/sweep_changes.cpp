#include "sweep_changes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/errors.hpp"
#include "studies/orbit_across.hpp"
#include "studies/parallel_for.hpp"

namespace epicyclic::app {

namespace {

/// Longer orbits are left out, and those behind so many mesh periods of orbits: a page is to be written in seconds.
constexpr int period_max = 16;
constexpr int periods_max = 160;
/// Two points at one value with these parts of a difference between their largest multipliers have one orbit.
constexpr double same_multiplier = 1e-3;

using Neighbours = std::pair<const studies::PointSummary*, const studies::PointSummary*>;

/// The point with the orbit first; nothing if neither has one.
/// @param before  comes first in the sweep
std::optional<Neighbours> with_orbit(const studies::PointSummary* before, const studies::PointSummary* behind) {
  const auto has = [](const studies::PointSummary* p) { return p->period > 0 && !p->orbit.empty(); };
  if (!has(before) && !has(behind)) return std::nullopt;
  const bool is_second = !has(before) || (has(behind) && before->period % behind->period == 0);
  return is_second ? Neighbours{behind, before} : Neighbours{before, behind};
}

double value_at(const Neighbours& pair, double part) {
  return std::lerp(pair.first->point.value, pair.second->point.value, part);
}

std::optional<studies::OrbitAcross> follow(const Neighbours& pair, const studies::ModelAtPoint& model_at,
                                           const integrate::IntegratorOptions& integrator) {
  const studies::PointSummary& point = *pair.first;
  const auto field_at = [&](double part) -> VectorField {
    studies::GridPoint between = part < 1.0 ? point.point : pair.second->point;
    between.value = value_at(pair, part);
    return model_at(between);
  };
  try {
    return studies::orbit_across(field_at, std::span(point.orbit).first(model_at(point.point).dimension), point.period,
                                 integrator);
  } catch (const SolverError&) {
    return std::nullopt;  // the change is listed without it
  }
}

/// Both directions often have the same change.
bool same_change(const Neighbours& known, const Neighbours& of) {
  const double largest = known.first->evidence.largest_multiplier;
  return of.first->point.value == known.first->point.value && of.second->point.value == known.second->point.value &&
         of.first->period == known.first->period && largest > 0.0 &&
         std::abs(of.first->evidence.largest_multiplier - largest) <= same_multiplier * largest;
}

}  // namespace

ChangeMultipliers change_multipliers(std::span<const studies::PointSummary> points,
                                     const studies::ModelAtPoint& model_at,
                                     const integrate::IntegratorOptions& integrator,
                                     const std::function<void()>& stop_here, int threads) {
  ChangeMultipliers changes;
  std::vector<Neighbours> followed;  // each once
  struct Row {
    Neighbours pair;
    std::size_t orbit;  // of those that are followed
  };
  std::vector<Row> rows;
  int periods = 0;
  for (const studies::Direction direction : {studies::Direction::up, studies::Direction::down}) {
    std::vector<const studies::PointSummary*> along;
    for (const studies::PointSummary& p : points)
      if (p.point.direction == direction && p.outcome == integrate::Outcome::reached) along.push_back(&p);
    std::ranges::stable_sort(along, {}, [](const auto* p) { return p->point.value; });
    if (direction == studies::Direction::down) std::ranges::reverse(along);
    for (std::size_t k = 1; k < along.size(); ++k) {
      if (along[k]->regime == along[k - 1]->regime && along[k]->period == along[k - 1]->period) continue;
      const auto pair = with_orbit(along[k - 1], along[k]);
      if (!pair) continue;
      const int period = pair->first->period;
      const auto same = std::ranges::find_if(followed, [&](const Neighbours& one) { return same_change(one, *pair); });
      if (same == followed.end()) {
        if (period > period_max || periods + period > periods_max) {
          ++changes.left_out;
          continue;
        }
        periods += period;
      }
      rows.push_back({*pair, static_cast<std::size_t>(same - followed.begin())});
      if (same == followed.end()) followed.push_back(*pair);
    }
  }
  std::vector<std::optional<studies::OrbitAcross>> orbits(followed.size());
  studies::parallel_for(followed.size(), threads, nullptr, [&](std::size_t k) {
    stop_here();
    orbits[k] = follow(followed[k], model_at, integrator);
  });
  for (const auto& [pair, orbit] : rows) {
    const auto& across = orbits[orbit];
    if (!across) continue;
    const std::array<double, ChangeMultipliers::names.size()> row = {static_cast<double>(pair.first->point.index),
                                                                     static_cast<double>(pair.second->point.index),
                                                                     across->here.real(),
                                                                     across->here.imag(),
                                                                     across->found ? 1.0 : 0.0,
                                                                     static_cast<double>(across->unstable),
                                                                     across->one_kind ? 1.0 : 0.0,
                                                                     across->there.real(),
                                                                     across->there.imag(),
                                                                     value_at(pair, across->part),
                                                                     across->fold ? 1.0 : 0.0};
    for (std::size_t i = 0; i < row.size(); ++i) changes.columns[i].push_back(row[i]);
  }
  return changes;
}

}  // namespace epicyclic::app
