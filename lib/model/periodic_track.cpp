#include "model/periodic_track.hpp"

#include <memory>
#include <string>

#include <gsl/gsl_interp.h>

#include "core/difference.hpp"
#include "core/errors.hpp"

namespace epicyclic::model {

namespace {

// Slopes of Steffen's interpolant at the rows, or of the straight line through two.
std::vector<double> slopes(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() == 2) return std::vector<double>(2, (y[1] - y[0]) / (x[1] - x[0]));
  // GSL aborts the program on rows that do not rise, so they are looked at first.
  for (std::size_t k = 1; k < x.size(); ++k)
    if (!(x[k] > x[k - 1])) throw InputError("table over the phase: phases of neighbouring rows cannot be told apart");
  const std::unique_ptr<gsl_interp, decltype(&gsl_interp_free)> interpolant(
      gsl_interp_alloc(gsl_interp_steffen, x.size()), &gsl_interp_free);
  gsl_interp_init(interpolant.get(), x.data(), y.data(), x.size());
  std::vector<double> result(x.size());
  for (std::size_t k = 0; k < x.size(); ++k)
    gsl_interp_eval_deriv_e(interpolant.get(), x.data(), y.data(), x[k], nullptr, &result[k]);
  return result;
}

double wrapped(double phase) { return phase - std::floor(phase); }

}  // namespace

template <std::size_t K>
PeriodicTrack<K>::PeriodicTrack(const std::vector<TrackRow<K>>& given_rows,
                                const std::vector<double>& given_breakpoints, double lead) {
  using Row = TrackRow<K>;
  std::vector<Row> rows = given_rows;
  for (Row& r : rows) r.phase += lead;

  const auto shifted = [](Row r, double turns) {
    r.phase += turns;
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
    append_piece(extended);
    starts_.erase(starts_.begin(), starts_.begin() + neighbours);
    cubics_.erase(cubics_.begin(), cubics_.begin() + neighbours);
    starts_.resize(n);
    cubics_.resize(n);
    pieces_ = {piece(0, n - 1)};
    return;
  }

  const std::size_t breaks = given_breakpoints.size();
  for (std::size_t b = 0; b < breaks; ++b) {
    const double from = given_breakpoints[b] + lead;
    const bool wraps = b + 1 == breaks;
    const double to = wraps ? (given_breakpoints[0] + lead) + 1.0 : given_breakpoints[b + 1] + lead;
    std::vector<Row> piece;
    for (int turn = 0; turn < 2; ++turn)
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const Row r = shifted(rows[k], turn);
        const bool twin_before = k > 0 && rows[k - 1].phase == rows[k].phase;
        const bool twin_after = k + 1 < rows.size() && rows[k + 1].phase == rows[k].phase;
        const bool starts_here = r.phase == from && !twin_after;
        const bool ends_here = r.phase == to && !twin_before;
        if (starts_here || ends_here || (r.phase > from && r.phase < to)) piece.push_back(r);
      }
    append_piece(piece);
    breakpoints_.push_back(wrapped(from));
  }
  std::sort(breakpoints_.begin(), breakpoints_.end());
}

template <std::size_t K>
TrackPiece PeriodicTrack<K>::piece(std::size_t lo, std::size_t hi) const {
  const double width = starts_[hi] - starts_[lo];
  TrackPiece p{lo, hi, starts_[lo], hi > lo ? static_cast<double>(hi - lo) / width : 0.0, true};
  constexpr double rounding = 1e-9;  // of an interval
  for (std::size_t k = lo; k <= hi; ++k) {
    const double off = (starts_[k] - p.start) * p.intervals_per_phase - static_cast<double>(k - lo);
    p.even = p.even && std::abs(off) <= rounding;
  }
  return p;
}

template <std::size_t K>
void PeriodicTrack<K>::append_piece(const std::vector<TrackRow<K>>& rows) {
  if (rows.size() < 2)
    throw InputError("table over the phase: a piece between two breakpoints needs a row at each of its ends");
  const std::size_t first = starts_.size();
  std::vector<double> x;
  for (const auto& r : rows) x.push_back(r.phase);
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    starts_.push_back(x[k]);
    cubics_.emplace_back();
  }
  for (std::size_t j = 0; j < K; ++j) {
    std::vector<double> y;
    for (const auto& r : rows) y.push_back(r.value[j]);
    const std::vector<double> slope = slopes(x, y);
    for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
      const double h = x[k + 1] - x[k];
      const double secant = (y[k + 1] - y[k]) / h;
      Cubics<K>& c = cubics_[first + k];
      c[0][j] = y[k];
      c[1][j] = slope[k];
      c[2][j] = (3.0 * secant - 2.0 * slope[k] - slope[k + 1]) / h;
      c[3][j] = (slope[k] + slope[k + 1] - 2.0 * secant) / (h * h);
    }
  }
  pieces_.push_back(piece(first, starts_.size() - 1));
}

template <std::size_t K>
TrackPlace PeriodicTrack<K>::place(double phase) const {
  const double origin = starts_.front();
  // One smooth curve has no sides: its centre is that of its period.
  if (breakpoints_.empty()) return {pieces_.front(), origin + 0.5};
  const double x = phase - std::floor(phase - origin);
  std::size_t k = 0;
  while (k + 1 < pieces_.size() && x >= starts_[pieces_[k + 1].lo]) ++k;
  return {pieces_[k], x};
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

template class PeriodicTrack<1>;
template class PeriodicTrack<3>;

}  // namespace epicyclic::model
