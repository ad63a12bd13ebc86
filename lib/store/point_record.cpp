#include "store/point_record.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "store/record_archive.hpp"

namespace epicyclic::store {

namespace archive {

template <class A>
void pass(A& a, studies::Direction& x) {
  pass_enum(a, x, studies::Direction::down);
}
template <class A>
void pass(A& a, analysis::Regime& x) {
  pass_enum(a, x, analysis::Regime::undecided);
}
template <class A>
void pass(A& a, integrate::Outcome& x) {
  pass_enum(a, x, integrate::Outcome::failed);
}

/// An absent value is not a number.
template <class A>
void pass(A& a, std::optional<double>& x) {
  double value = x.value_or(std::numeric_limits<double>::quiet_NaN());
  pass(a, value);
  x = std::isnan(value) ? std::nullopt : std::optional(value);
}
template <class A>
void pass(A& a, analysis::Estimate& e) {
  pass_all(a, e.value, e.half_width);
}
template <class A>
void pass(A& a, analysis::Recurrence& r) {
  pass_all(a, r.period, r.best_period, r.error, r.late_error);
}
template <class A>
void pass(A& a, analysis::Evidence& e) {
  pass_all(a, e.periods, e.recurrence, e.residual, e.orbit_error, e.largest_multiplier, e.multiplier_error, e.exponent,
           e.late_growth, e.zero_one, e.note);
}
template <class A>
void pass(A& a, integrate::Work& w) {
  pass_all(a, w.right_hand_sides, w.tangent_right_hand_sides, w.jacobians, w.steps);
}
template <class A>
void pass(A& a, studies::Course& c) {
  pass_all(a, c.least, c.largest, c.mean, c.rms);
}
template <class A>
void pass(A& a, studies::MeshRecord& m) {
  pass_all(a, m.delta, m.force, m.drive, m.back, m.tension, m.tension_time, m.quasi_static);
}
template <class A>
void pass(A& a, gear::BearingLife& life) {
  pass_all(a, life.equivalent_load_N, life.million_revolutions, life.hours);
}
template <class A>
void pass(A& a, studies::StageRecord& r) {
  std::vector<gear::BearingLife> sun_life;
  if (r.sun_life) sun_life.push_back(*r.sun_life);
  pass_all(a, r.sun_planet, r.ring_planet, r.planet_spread, r.planet_bearing, r.planet_lives, r.sun_bearing, sun_life,
           r.transmission_error, r.sun_planet_harmonics, r.ring_planet_harmonics, r.transmission_error_harmonics,
           r.force_error, r.static_force, r.mesh_frequency, r.speeds.sun, r.speeds.carrier);
  a.require(sun_life.size() <= 1, "has several lives of the sun's bearing");
  r.sun_life = sun_life.empty() ? std::nullopt : std::optional(sun_life.front());
}
template <class A>
void pass(A& a, studies::GridPoint& p) {
  pass_all(a, p.index, p.direction, p.value, p.second_value);
}

template <class A>
void pass(A& a, analysis::AttractorRecord& r) {
  pass_all(a, r.regime, r.dimension);
  if (r.dimension == 0) return;  // none was kept
  pass_all(a, r.orbit, r.orbit_error, r.frequencies, r.means, r.deviations, r.exponent);
  a.require(r.orbit.size() % r.dimension == 0, "has an orbit that is not whole states");
  a.require(r.means.size() == r.deviations.size(), "has means without deviations");
}

/// All but the Poincare section.
template <class A>
void pass_summary(A& a, studies::PointResult& r) {
  pass_all(a, r.point, r.outcome, r.message, r.recurrence, r.regime, r.period, r.classified, r.evidence, r.meshes,
           r.rhs_evaluations, r.end_state, r.orbit, r.omega, r.poincare_columns, r.attractor);
}

template <class A>
void pass(A& a, studies::PointResult& r) {
  pass_summary(a, r);
  pass(a, r.spectrum);
  if (!r.spectrum.empty()) pass(a, r.spectrum_resolution);
  pass(a, r.poincare);
  a.require(r.poincare_columns == 0 ? r.poincare.empty() : r.poincare.size() % r.poincare_columns == 0,
            "has a Poincare section that is not whole rows");
}
template <class A>
void pass(A& a, studies::LadderStep& s) {
  pass_all(a, s.method, s.tolerance, s.outcome, s.error, s.orbit_error, s.quantities, s.work, s.seconds);
}
template <class A>
void pass(A& a, studies::SmoothingStep& s) {
  pass_all(a, s.width, s.found, s.distance, s.quantities, s.work);
}
template <class A>
void pass(A& a, studies::StatisticsStep& s) {
  pass_all(a, s.method, s.tolerance, s.width, s.outcome, s.exponent, s.mean, s.deviation, s.right_hand_sides);
}
template <class A>
void pass(A& a, studies::TolerancePoint& p) {
  pass_all(a, p.point, p.study, p.note, p.period, p.orbit, p.reference_residual, p.distance_from_orbit,
           p.largest_multiplier, p.reference, p.reference_error, p.table_error, p.table_displacement, p.between_phases,
           p.ladder, p.study_work, p.smoothing, p.extrapolated, p.exponent, p.statistics);
}

}  // namespace archive

std::vector<std::byte> encode_point(const studies::PointResult& result) { return archive::encode(result); }

studies::PointResult decode_point(std::span<const std::byte> record) {
  return archive::decode<studies::PointResult>(record);
}

std::optional<studies::PointSummary> decode_point_beginning(std::span<const std::byte> beginning) {
  archive::Decoder d(beginning);
  studies::PointResult result;
  try {
    archive::pass_summary(d, result);
  } catch (const DamagedData&) {
    // Cut off, or damaged: the check of the whole record decides.
    return std::nullopt;
  }
  return result;
}

std::vector<std::byte> encode_tolerance_point(const studies::TolerancePoint& point) { return archive::encode(point); }

studies::TolerancePoint decode_tolerance_point(std::span<const std::byte> record) {
  return archive::decode<studies::TolerancePoint>(record);
}

std::vector<std::byte> encode_numbers(std::span<const double> numbers) {
  return archive::encode(std::vector<double>(numbers.begin(), numbers.end()));
}

std::vector<double> decode_numbers(std::span<const std::byte> record, std::size_t count) {
  auto numbers = archive::decode<std::vector<double>>(record);
  if (numbers.size() != count)
    throw DamagedData(fmt::format("a journal record holds {} numbers where {} are due", numbers.size(), count));
  return numbers;
}

}  // namespace epicyclic::store
