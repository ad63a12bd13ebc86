// Parameters of W operating points side by side, one lane each, and where each lane is in its own tables.
//
// The points share what decides on the text of the equations (number of planets, laws, switches, harmonics); every
// constant, table and breakpoint is a lane's own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "core/lanes.hpp"
#include "model/layout.hpp"
#include "model/parameters.hpp"

namespace epicyclic::model {

/// The interval of its table that each lane is in.
template <std::size_t W>
struct LaneInterval {
  Lanes<W> x;           ///< phase without whole periods
  LaneWords<W> number;  ///< counted from the first one of the segment; a guess where intervals are on no grid
  Lanes<W> t;           ///< what is beyond its start, where they are
};

/// Where each lane is in one of its tables.
template <std::size_t K, std::size_t W>
struct LanePlace {
  using Track = PeriodicTrack<K>;

  std::array<const Track*, W> track{};
  std::array<TrackSegment, W> track_segments{};
  std::array<const Cubics<K>*, W> cubics{};
  Lanes<W> centre, origin, slope, offset, last;
  LaneWords<W> first_bits, shift;
  bool regular = false;  ///< in all lanes

  void set(std::size_t lane, const Track& of, const TrackPlace& place) {
    const TrackSegment& p = place.segment;
    track[lane] = &of;
    track_segments[lane] = p;
    cubics[lane] = of.cubics(p);
    centre.set(lane, place.centre);
    origin.set(lane, p.origin);
    slope.set(lane, p.slope);
    offset.set(lane, p.grid.offset);
    last.set(lane, p.grid.last());
    first_bits.set(lane, p.grid.first_bits());
    shift.set(lane, static_cast<std::uint64_t>(p.grid.shift));
    regular = true;
    for (std::size_t k = 0; k < W; ++k) regular = regular && track[k] != nullptr && track_segments[k].regular;
  }

  /// @param phase  each lane's, within half a period of its place, modulo whole periods
  [[nodiscard]] LaneInterval<W> find(const Lanes<W>& phase) const {
    LaneInterval<W> found;
    found.x = phase - nearest_whole(phase - centre);
    const Lanes<W> v = offset + (found.x - origin) * slope;
    // IntervalGrid::number() and node(); no number is at the offset.
    found.number = (min(max(v, offset), last).bits() - first_bits) >> shift;
    found.t = v - Lanes<W>::of_bits((found.number << shift) + first_bits);
    return found;
  }

  /// The K functions there: those of PeriodicTrack::at() to rounding.
  [[nodiscard]] std::array<Lanes<W>, K> at(const LaneInterval<W>& found) const {
    if (regular) {
      std::array<const Cubics<K>*, W> own;
      for (std::size_t lane = 0; lane < W; ++lane) own[lane] = cubics[lane] + found.number[lane];
      return cubics_at<W, K>(own, found.t);
    }
    std::array<Row<double, K>, W> rows;
    for (std::size_t lane = 0; lane < W; ++lane) rows[lane] = in_lane(lane, found);
    return transposed<W, K>(rows);
  }

  /// The same of one lane.
  [[nodiscard]] Row<double, K> in_lane(std::size_t lane, const LaneInterval<W>& found) const {
    const auto number = static_cast<std::size_t>(found.number[lane]);
    return track_segments[lane].regular ? cubics_at(cubics[lane][number], found.t[lane])
                                        : track[lane]->at(track_segments[lane], found.x[lane], number);
  }
};

/// One kind of mesh: each planet's places in the tables that there are.
template <std::size_t N, std::size_t W>
struct LaneMeshPlaces {
  std::array<LanePlace<1, W>, N> stiffness;
  std::array<LanePlace<3, W>, N> friction;
  std::array<LanePlace<3, W>, N> error;

  void set(std::size_t lane, const MeshParameters<double, N>& mesh, const MeshPlaces<N>& places) {
    for (std::size_t i = 0; i < N; ++i) {
      if (mesh.stiffness_curve) stiffness[i].set(lane, *mesh.stiffness_curve, places.stiffness[i]);
      if (mesh.friction) friction[i].set(lane, mesh.friction->track(), places.friction[i]);
      if (mesh.error_curve) error[i].set(lane, *mesh.error_curve, places.error[i]);
    }
  }
};

template <std::size_t N, std::size_t W>
struct LaneSegment {
  LaneMeshPlaces<N, W> sun_planet, ring_planet;
};

template <std::size_t N, std::size_t W>
class LaneParameters {
 public:
  using Point = std::shared_ptr<const Parameters<double, N>>;

  /// All lanes at one point.
  explicit LaneParameters(const Point& first);

  /// @throws InputError when the point does not have the structure of the first one
  void load(std::size_t lane, const Point& point);

  void set_segment(std::size_t lane, std::size_t segment);

  [[nodiscard]] const Parameters<Lanes<W>, N>& constants() const { return constants_; }
  [[nodiscard]] const LaneSegment<N, W>& segment() const { return segment_; }

 private:
  void check(const Parameters<double, N>& p) const;

  Parameters<Lanes<W>, N> constants_;
  LaneSegment<N, W> segment_;
  std::array<Point, W> points_;
};

template <std::size_t N, std::size_t W>
LaneParameters<N, W>::LaneParameters(const Point& first) : constants_(without_constants<Lanes<W>>(*first)) {
  for (std::size_t lane = 0; lane < W; ++lane) load(lane, first);
}

template <std::size_t N, std::size_t W>
void LaneParameters<N, W>::load(std::size_t lane, const Point& point) {
  check(*point);
  const std::vector<double> values = constant_values(*point);
  auto next = values.begin();
  for_each_constant(constants_, [&](Lanes<W>& x) { x.set(lane, *next++); });
  points_[lane] = point;
  set_segment(lane, 0);
}

template <std::size_t N, std::size_t W>
void LaneParameters<N, W>::set_segment(std::size_t lane, std::size_t segment) {
  const Parameters<double, N>& p = *points_[lane];
  segment_.sun_planet.set(lane, p.sun_planet, p.segments[segment].sun_planet);
  segment_.ring_planet.set(lane, p.ring_planet, p.segments[segment].ring_planet);
}

template <std::size_t N, std::size_t W>
void LaneParameters<N, W>::check(const Parameters<double, N>& p) const {
  const auto& own = constants_;
  const auto mesh_fits = [](const MeshParameters<double, N>& m, const MeshParameters<Lanes<W>, N>& to) {
    bool alike = m.harmonics == to.harmonics && (m.friction != nullptr) == (to.friction != nullptr) &&
                 (m.stiffness_curve != nullptr) == (to.stiffness_curve != nullptr) &&
                 (m.error_curve != nullptr) == (to.error_curve != nullptr) &&
                 m.further_error_cos.size() == to.further_error_cos.size();
    for (std::size_t i = 0; i < N; ++i) alike = alike && m.phase_cycles[i] == to.phase_cycles[i];
    alike = alike && m.shafts.size() == to.shafts.size();
    for (std::size_t k = 0; alike && k < m.shafts.size(); ++k)
      alike = m.shafts[k].cosine.size() == to.shafts[k].cosine.size();
    return alike;
  };
  if (!mesh_fits(p.sun_planet, own.sun_planet) || !mesh_fits(p.ring_planet, own.ring_planet) ||
      p.sun_law != own.sun_law || p.planet_gap != own.planet_gap || p.gyroscopic_relative != own.gyroscopic_relative ||
      p.gyroscopic_carrier_row != own.gyroscopic_carrier_row || p.smooth != own.smooth ||
      p.gap_damping != own.gap_damping || p.boundary != own.boundary || p.mesh_periods != own.mesh_periods)
    throw InputError("operating points of different structure cannot run side by side");
}

// Compiled once, in lane_parameters.cpp.
#define EPICYCLIC_LANES_OF(N)                 \
  extern template class LaneParameters<N, 2>; \
  extern template class LaneParameters<N, 4>; \
  extern template class LaneParameters<N, 8>;
EPICYCLIC_FOR_PLANETS(EPICYCLIC_LANES_OF)
#undef EPICYCLIC_LANES_OF

}  // namespace epicyclic::model
