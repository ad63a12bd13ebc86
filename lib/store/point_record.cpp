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

#include "store/journal.hpp"

namespace epicyclic::store {

namespace {

/// Takes the bytes of what passes.
class Encoder {
 public:
  template <class T>
  void bytes_of(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
  }
  template <class List>
  void size_of(List& list, std::size_t /*least_bytes*/) {
    auto size = static_cast<std::uint64_t>(list.size());
    bytes_of(size);
  }
  void require(bool /*holds*/, const char* /*what*/) {}
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Gives what passes the bytes of a record.
class Decoder {
 public:
  explicit Decoder(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  void bytes_of(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    require(sizeof(T) <= bytes_.size() - at_, "is shorter than its contents");
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
  }
  /// @param least_bytes  of an element: no memory is asked for that the record cannot fill
  template <class List>
  void size_of(List& list, std::size_t least_bytes) {
    std::uint64_t size = 0;
    bytes_of(size);
    require(size <= (bytes_.size() - at_) / least_bytes, "is shorter than its contents");
    list.resize(static_cast<std::size_t>(size));
  }
  void require(bool holds, const char* what) {
    if (!holds) throw DamagedData(std::string("a journal record ") + what);
  }
  void finish() { require(at_ == bytes_.size(), "is longer than its contents"); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

// pass(archive, value): one description of a record for both directions.

/// A number of another type on the way than in memory, so that the record does not depend on the platform's widths.
template <class Wire, class A, class T>
void pass_as(A& a, T& value) {
  auto wire = static_cast<Wire>(value);
  a.bytes_of(wire);
  value = static_cast<T>(wire);
}

template <class A>
void pass(A& a, double& x) {
  a.bytes_of(x);
}
template <class A>
void pass(A& a, int& x) {
  pass_as<std::int32_t>(a, x);
}
template <class A>
void pass(A& a, long& x) {
  pass_as<std::int64_t>(a, x);
}
template <class A>
void pass(A& a, std::size_t& x) {
  pass_as<std::uint64_t>(a, x);
}
template <class A>
void pass(A& a, bool& x) {
  pass_as<std::uint8_t>(a, x);
}

template <class A, class E>
void pass_enum(A& a, E& value, E last) {
  auto wire = static_cast<std::uint8_t>(value);
  a.bytes_of(wire);
  a.require(wire <= static_cast<std::uint8_t>(last), "names a direction, an outcome or a regime that does not exist");
  value = static_cast<E>(wire);
}
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

template <class A>
void pass(A& a, std::string& text) {
  a.size_of(text, 1);
  for (char& c : text) a.bytes_of(c);
}

template <class A, class T, std::size_t n>
void pass(A& a, std::array<T, n>& values) {
  for (T& v : values) pass(a, v);
}

template <class A, class... T>
void pass_all(A& a, T&... values) {
  (pass(a, values), ...);
}

/// What there is not is no number.
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
void pass(A& a, studies::MeshRecord& m) {
  pass_all(a, m.delta_min, m.delta_max, m.pull, m.pull_time);
  auto seen = static_cast<std::uint8_t>((m.drive ? 1U : 0U) | (m.loss ? 2U : 0U) | (m.back ? 4U : 0U));
  a.bytes_of(seen);
  m.drive = (seen & 1U) != 0;
  m.loss = (seen & 2U) != 0;
  m.back = (seen & 4U) != 0;
}
template <class A>
void pass(A& a, studies::GridPoint& p) {
  pass_all(a, p.index, p.direction, p.value, p.second_value);
}

/// Elements take eight bytes at least.
template <class A, class T>
void pass(A& a, std::vector<T>& values) {
  a.size_of(values, sizeof(double));
  for (T& v : values) pass(a, v);
}

template <class A>
void pass(A& a, analysis::AttractorRecord& r) {
  pass_all(a, r.regime, r.dimension, r.orbit, r.orbit_error, r.waves, r.means, r.deviations, r.exponent);
  a.require(r.dimension == 0 ? r.orbit.empty() : r.orbit.size() % r.dimension == 0,
            "has an orbit that is not whole states");
  a.require(r.means.size() == r.deviations.size(), "has means without deviations");
}

/// All but the Poincare section.
template <class A>
void pass_brief(A& a, studies::PointResult& r) {
  pass_all(a, r.point, r.outcome, r.message, r.recurrence, r.regime, r.period, r.classified, r.evidence, r.sun_planet,
           r.ring_planet, r.planet_spread, r.rhs_evaluations, r.end_state, r.orbit, r.omega, r.poincare_columns,
           r.attractor);
}

template <class A>
void pass(A& a, studies::PointResult& r) {
  pass_brief(a, r);
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
  pass_all(a, p.point, p.study, p.note, p.period, p.orbit, p.reference_residual, p.settled_distance,
           p.largest_multiplier, p.reference, p.reference_error, p.table_error, p.table_displacement, p.ladder,
           p.study_work, p.smoothing, p.extrapolated, p.exponent, p.statistics);
}

template <class T>
std::vector<std::byte> encode(T value) {
  Encoder e;
  pass(e, value);
  return e.take();
}

template <class T>
T decode(std::span<const std::byte> record) {
  Decoder d(record);
  T value;
  pass(d, value);
  d.finish();
  return value;
}

}  // namespace

std::vector<std::byte> encode_point(const studies::PointResult& result) { return encode(result); }

studies::PointResult decode_point(std::span<const std::byte> record) { return decode<studies::PointResult>(record); }

std::optional<studies::PointSummary> decode_point_beginning(std::span<const std::byte> beginning) {
  Decoder d(beginning);
  studies::PointResult result;
  try {
    pass_brief(d, result);
  } catch (const DamagedData&) {
    // Cut off, or damaged: the whole record tells.
    return std::nullopt;
  }
  return result;
}

std::vector<std::byte> encode_tolerance_point(const studies::TolerancePoint& point) { return encode(point); }

studies::TolerancePoint decode_tolerance_point(std::span<const std::byte> record) {
  return decode<studies::TolerancePoint>(record);
}

}  // namespace epicyclic::store
