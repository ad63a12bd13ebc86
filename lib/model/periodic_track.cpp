#include "model/periodic_track.hpp"

#include <algorithm>
#include <string>

#include "core/difference.hpp"
#include "core/errors.hpp"

namespace epicyclic::model {

namespace {

double wrapped(double phase) { return phase - std::floor(phase); }

}  // namespace

template <std::size_t K>
PeriodicTrack<K>::PeriodicTrack(const std::vector<TrackRow<K>>& given_rows,
                                const std::vector<double>& given_breakpoints, double lead, Interpolation interpolation,
                                std::span<const IntervalGrid> grids, double rows_per_feature) {
  using Row = TrackRow<K>;
  std::vector<Row> rows = given_rows;
  for (Row& r : rows) r.phase += lead;
  if (grids.empty()) {
    std::vector<double> phases;
    for (const Row& r : rows) phases.push_back(r.phase);
    spacing_ = RowSpacing(phases, rows_per_feature);
  }

  const auto shifted = [](Row r, double cycles) {
    r.phase += cycles;
    return r;
  };

  if (given_breakpoints.empty()) {
    // One smooth periodic curve: rows of the neighbouring periods give the slopes at the seam.
    constexpr std::size_t neighbours = 2;
    std::vector<Row> extended;
    const std::size_t n = rows.size();
    for (std::size_t k = 0; k < n + 1 + 2 * neighbours; ++k) {
      const std::size_t at = k + n * (neighbours + 1) - neighbours;
      extended.push_back(shifted(rows[at % n], static_cast<double>(at / n) - static_cast<double>(neighbours + 1)));
    }
    append_segment(extended, neighbours, interpolation, nullptr);
    return;
  }

  const std::size_t breaks = given_breakpoints.size();
  for (std::size_t b = 0; b < breaks; ++b) {
    const double from = given_breakpoints[b] + lead;
    const bool wraps = b + 1 == breaks;
    const double to = wraps ? (given_breakpoints[0] + lead) + 1.0 : given_breakpoints[b + 1] + lead;
    std::vector<Row> segment_rows;
    for (int cycle = 0; cycle < 2; ++cycle)
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row r = shifted(rows[k], cycle);
        const bool twin_before = k > 0 && rows[k - 1].phase == rows[k].phase;
        const bool twin_after = k + 1 < rows.size() && rows[k + 1].phase == rows[k].phase;
        const bool starts_here = r.phase == from && !twin_after;
        const bool ends_here = r.phase == to && !twin_before;
        if (starts_here || ends_here || (r.phase > from && r.phase < to)) segment_rows.push_back(r);
      }
    append_segment(segment_rows, 0, interpolation, grids.empty() ? nullptr : &grids[b]);
    breakpoints_.push_back(wrapped(from));
  }
  std::sort(breakpoints_.begin(), breakpoints_.end());
}

template <std::size_t K>
void PeriodicTrack<K>::append_segment(const std::vector<TrackRow<K>>& rows, std::size_t beyond,
                                      Interpolation interpolation, const IntervalGrid* grid) {
  if (rows.size() < 2 + 2 * beyond)
    throw InputError("table over the phase: an interval between two breakpoints needs a row at each of its ends");
  const std::size_t count = rows.size() - 1 - 2 * beyond;
  const double from = rows[beyond].phase;
  const double to = rows[beyond + count].phase;
  TrackSegment segment;
  segment.lo = starts_.size();
  segment.grid = grid != nullptr ? *grid : IntervalGrid::even(count);
  segment.start = from;
  segment.origin = segment.grid.from_end ? to : from;
  segment.slope = segment.grid.scale / (segment.grid.from_end ? from - to : to - from);
  if (segment.grid.count != count) throw InputError("table over the phase: rows that are not those of their grid");

  // In the order of the grid.
  std::vector<TrackRow<K>> ordered = rows;
  if (segment.grid.from_end) std::reverse(ordered.begin(), ordered.end());
  constexpr double rounding = 1e-9;  // of an interval
  constexpr double phase_rounding = 1e-12;
  segment.regular = true;
  for (std::size_t k = 0; k <= count; ++k) {
    const double off = std::abs(segment.place(ordered[beyond + k].phase) - segment.grid.node(k));
    if (grid != nullptr) {
      if (!(off <= phase_rounding * std::abs(segment.slope)))
        throw InputError("table over the phase: rows that are not those of their grid");
    } else {
      segment.regular = segment.regular && off <= rounding;  // intervals of an even grid are 1 long
    }
  }

  std::vector<double> x;
  for (std::size_t k = 0; k < ordered.size(); ++k) {
    const bool inside = k >= beyond && k <= beyond + count;
    x.push_back(!segment.regular ? ordered[k].phase
                : inside         ? segment.grid.node(k - beyond)
                                 : segment.place(ordered[k].phase));
  }
  for (std::size_t k = 0; k < count; ++k) {
    starts_.push_back(ordered[beyond + k].phase);
    cubics_.emplace_back();
  }
  for (std::size_t j = 0; j < K; ++j) {
    std::vector<double> y;
    for (const auto& r : ordered) y.push_back(r.value[j]);
    const std::vector<CubicCoefficients> c = cubics_through(interpolation, x, y, beyond, count);
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t power = 0; power < 4; ++power) cubics_[segment.lo + k][power][j] = c[k][power];
  }
  segments_.push_back(segment);
}

template <std::size_t K>
TrackPlace PeriodicTrack<K>::place(double phase) const {
  const double origin = segments_.front().start;
  // One smooth curve has no sides: its centre is that of its period.
  if (breakpoints_.empty()) return {segments_.front(), origin + 0.5};
  const double x = phase - std::floor(phase - origin);
  std::size_t k = 0;
  while (k + 1 < segments_.size() && x >= segments_[k + 1].start) ++k;
  return {segments_[k], x};
}

template <std::size_t K>
PeriodicTrack<K> PeriodicTrack<K>::with_parameter_derivative(const std::array<const PeriodicTrack*, 4>& near,
                                                             double h) const {
  for (const PeriodicTrack* other : near)
    if (other == nullptr || other->starts_ != starts_)
      throw InputError("the parameter moves rows of a table over the mesh phase; there is no derivative");
  PeriodicTrack track = *this;
  track.parameter_cubics_.resize(cubics_.size());
  for (std::size_t k = 0; k < cubics_.size(); ++k)
    for (std::size_t j = 0; j < K; ++j)
      for (std::size_t c = 0; c < 4; ++c) {
        const auto at = [&](std::size_t neighbour) { return near[neighbour]->cubics_[k][c][j]; };
        track.parameter_cubics_[k][c][j] = central_derivative({at(0), at(1), at(2), at(3)}, h);
      }
  return track;
}

PeriodicTrack<3> with_slope(PeriodicTrack<3> track, double unit) {
  for (const TrackSegment& segment : track.segments_) {
    // Cubics are in powers of the grid's v, if the intervals are regular, else of the phase.
    const double per_phase = unit * (segment.regular ? segment.slope : 1.0);
    for (std::size_t k = segment.lo; k <= segment.hi(); ++k) {
      Cubics<3>& c = track.cubics_[k];
      for (std::size_t power = 0; power < 3; ++power)
        c[power][1] = static_cast<double>(power + 1) * c[power + 1][0] * per_phase;
      c[3][1] = 0.0;
    }
  }
  return track;
}

template class PeriodicTrack<1>;
template class PeriodicTrack<3>;

}  // namespace epicyclic::model
